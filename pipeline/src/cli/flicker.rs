//! `pipeline report --flicker`: measures the part of the errors that changes from frame to frame.

use super::bar::Bar;

use super::{OTHER_FOLDER, make_folder};
use crate::report::flicker::{self, PanMeasured, Plan, pans};
use files::exit::say;
use files::{Batch, CommonArguments, Report};
use std::io::Write;
use std::path::Path;

/// The files of the numbers and of their columns.
const FILES: [&str; 2] = ["flicker.csv", "flicker-columns.csv"];

/// Measures all pans and writes numbers and plots into `folder`.
pub fn flicker(plan: &Plan, folder: &Path, common: &CommonArguments) -> Result<(), Report> {
    let ledger = common.ledger();
    let pans = pans::all()?;
    make_folder(folder)?;
    let plots = pans.iter().map(|pan| format!("flicker-{}.svg", pan.name));
    let files = FILES.map(String::from).into_iter().chain(plots);
    let files: Vec<_> = files.map(|file| folder.join(file)).collect();
    for file in &files {
        ledger.claim(file, OTHER_FOLDER)?;
    }
    let pool = common.pool()?;
    let mut measured: Vec<PanMeasured> = Vec::new();
    for pan in &pans {
        let bar = Bar::new(common.quiet);
        let tell = |doing: &str, done: usize, total: usize| {
            bar.tell(&format!("{}: {doing}", pan.name), done, total);
        };
        let of_pan = pool.install(|| flicker::pan(pan, plan, &tell))?;
        bar.clear();
        if !common.quiet {
            say(table(&of_pan));
        }
        measured.push(of_pan);
    }
    let threads = pool.current_num_threads();
    let charts = measured.iter().map(|pan| pan.chart().file(&line(pan)).into_bytes());
    let contents = [flicker::csv(&measured, threads), flicker::columns()].into_iter().chain(charts);
    let batch = Batch::new(folder, "flicker", &files)?;
    for (file, content) in files.iter().zip(contents) {
        let mut output = ledger.create(file)?;
        output.write_all(&content).map_err(|source| output.failed(source))?;
        batch.replace(output)?;
    }
    batch.finish()?;
    if !common.quiet {
        files.iter().for_each(|path| say(path.display()));
    }
    Ok(())
}

/// Returns the numbers of a pan as lines.
fn table(pan: &PanMeasured) -> String {
    let head = format!("{:<24}  error    steady   changing  step     ms per frame", pan.name);
    let rows = pan.trials.iter().map(|trial| {
        let parts = &trial.parts;
        let [error, steady, changing, step] =
            [parts.error, parts.steady, parts.changing, parts.step].map(|part| part.rms);
        format!(
            "  {:<22}  {error:.5}  {steady:.5}  {changing:.5}   {step:.5}  {:.1}",
            trial.method.name(),
            1e3 * trial.cpu
        )
    });
    let rows: Vec<String> = std::iter::once(head).chain(rows).chain([line(pan)]).collect();
    rows.join("\n")
}

/// Returns a sentence about exact averages and 16 rays at equal time.
fn line(pan: &PanMeasured) -> String {
    match (pan.at_equal_time(), pan.ratio()) {
        (Some([rays, exact]), Some(ratio)) => format!(
            "{}: the changing part of {} is {ratio:.1} times that of {} (least measurable {:.5}), in {:.2} of its \
             processor time",
            pan.name,
            rays.method.name(),
            exact.method.name(),
            exact.parts.changing.least,
            exact.cpu / rays.cpu,
        ),
        _ => format!("{}: no exact average takes at most the time of 16 rays", pan.name),
    }
}
