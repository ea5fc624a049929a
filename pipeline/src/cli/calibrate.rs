//! `pipeline report --calibrate`: compares requested and stated errors with true ones.

use super::bar::Bar;
use super::named::{self, NamedJob};
use super::{OTHER_FOLDER, make_folder};
use crate::PipelineError;
use crate::calibrate::{self, Summary, by_request, interval, measure, scenes};
use crate::run::{self, Options};
use files::exit::{say, wrote};
use files::{CommonArguments, Report};
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// The file of the page.
const FILE: &str = "calibration.html";

/// Width and height of the pictures if none are given.
const SIDE: u32 = 64;

/// Random scenes if no number is given.
pub const SCENES: usize = 200;

/// Measures pages and random scenes, and writes the page of the results into `folder`.
pub fn calibrate(
    names: &[String],
    count: usize,
    size: Option<(u32, u32)>,
    folder: &Path,
    common: &CommonArguments,
) -> Result<(), Report> {
    let ledger = common.ledger();
    let all = ["all".to_string()];
    let jobs = named::jobs(if names.is_empty() { &all } else { names }, &[], &ledger)?;
    let side = size.map_or(SIDE, |(width, _)| width);
    let options = Options {
        folder: folder.into(),
        size: (side, side),
        keep: false,
        clobber: common.clobber(),
    };
    make_folder(folder)?;
    let path = folder.join(FILE);
    ledger.claim(&path, OTHER_FOLDER)?;
    let pool = common.pool()?;
    let (bar, began) = (Bar::new(common.quiet), Instant::now());
    let total = jobs.len() + count;
    let mut measured = Vec::with_capacity(total);
    pool.install(|| -> Result<(), PipelineError> {
        for NamedJob { job, source, .. } in &jobs {
            bar.tell(&job.name, measured.len(), total);
            let scene = run::scene(job, *source, &options, &|_| {})?;
            measured.push(measure::scene(&job.name, &scene, side));
        }
        for number in 0..count as u64 {
            let name = format!("random-{number}");
            bar.tell(&name, measured.len(), total);
            measured.push(measure::scene(&name, &scenes::scene(number)?, side));
        }
        Ok(())
    })?;
    bar.clear();
    let mut output = ledger.create(&path)?;
    let text = calibrate::page(&measured, side);
    output.write_all(text.as_bytes()).map_err(|source| output.failed(source))?;
    output.commit()?;
    if !common.quiet {
        for (request, cases) in by_request(&measured) {
            say(line(request, Summary::of(&cases)));
        }
        wrote(&path, None, began.elapsed());
    }
    Ok(())
}

/// Returns a line about the cases of one request.
fn line(request: Option<f64>, summary: Option<Summary>) -> String {
    let name = request.map_or("audits alone".into(), |error| format!("error {error}"));
    let Some(summary) = summary else { return format!("{name}: no picture") };
    let Summary { cases, covered, certainly_above, missed, of_bound, rays, seconds, .. } = summary;
    let [low, high] = interval(covered, cases);
    format!(
        "{name}: {covered} of {cases} below the bound ({:.1} to {:.1} %), {certainly_above} surely above, \
         {missed} missed; true error {:.2} bounds in the middle, {:.2} at most; {:.2} rays per pixel, \
         audit {:.2}, {seconds:.1} s",
        100.0 * low,
        100.0 * high,
        of_bound[0],
        of_bound[1],
        rays[0],
        rays[1]
    )
}
