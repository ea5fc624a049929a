//! Prints notes, statistics, and the findings of `--check`.

use super::UseError;
use files::exit::say;
use files::{Output, Report, words};
use std::num::NonZeroUsize;
use std::path::Path;
use sweep::check::measures::Measures;
use sweep::check::resolution::aliases;
use sweep::check::{self, Finding, Severity};
use sweep::{GridMesh, Object, Sweep};

/// Prints a note for each property of the sweep that is legal and most often not intended.
pub fn note(sweep: &Sweep) {
    let folds = sweep.survey().findings().into_iter();
    let folds = folds.filter(|finding| finding.severity == Severity::Wrong);
    for finding in folds.chain(aliases(sweep)) {
        say(format_args!("sweep: note: {}: {}", words::shown(sweep.name()), finding.message));
    }
    if let Some(missed) = sweep.missed() {
        say(format_args!("sweep: note: {}: {missed}", words::shown(sweep.name())));
    }
}

/// Prints the sizes of a sweep and the accuracy that it reached.
pub fn stats(sweep: &Sweep) {
    say(format_args!("object      {}", words::shown(sweep.name())));
    say(format_args!("cells       {} x {} (rows x cols)", sweep.rows(), sweep.cols()));
    let [rows, cols] = sweep.points();
    say(format_args!("points      {rows} x {cols}, {}", rows * cols));
    if let Some(reached) = sweep.reached() {
        say(format_args!("distance    {:.4e} to the surface", reached.tol));
        if let Some(pixels) = reached.pixels {
            say(format_args!("pixels      {pixels:.4} to the surface"));
        }
        say(format_args!("angle       {:.3} degrees to the normals", reached.angle_deg));
        say(format_args!("quads       {}, after {} rounds", reached.quads, reached.rounds));
    }
    say(format_args!("creases     {}", sweep.contour().creases()));
    say(format_args!("contour     {} long", sweep.contour().length()));
    for (segments, reached) in sweep.contour().fits() {
        say(format_args!("fit         {segments} segments, {reached:.4e} from the points"));
    }
    if sweep.trajectory().is_rotation() {
        say("trajectory  a rotation");
    } else {
        say(format_args!("trajectory  {} long", sweep.trajectory().length()));
    }
}

/// Prints one line for the object, one for each part and one for each finding, on standard output.
///
/// # Errors
/// When standard output cannot be written, or when a finding is wrong.
pub fn print_check(
    name: &str,
    object: &Object,
    grids: &[GridMesh],
    findings: &[Finding],
) -> Result<(), Report> {
    let parts = object.parts().iter().zip(grids).map(|(part, grid)| check::summary(part, grid));
    let whole = Measures::of(object, grids).line(object.name(), object.unit());
    let lines = std::iter::once(whole).chain(parts).chain(findings.iter().map(Finding::to_string));
    let text: String = lines.map(|line| format!("{}\n", words::line(&line))).collect();
    Output::create(Path::new("-"), true)?.commit_all(text.as_bytes())?;
    let wrong = findings.iter().filter(|finding| finding.severity == Severity::Wrong).count();
    match NonZeroUsize::new(wrong) {
        Some(count) => Err(UseError::Wrong { name: name.into(), count }.into()),
        None => Ok(()),
    }
}
