//! Writes the numbers of flicker as comma separated values.

use super::{PanMeasured, Trial};
use crate::report::rows::{light, samples, sampling, seconds};
use serde::Serialize;

/// One method on one pan. The names of the fields are those of the columns.
#[derive(Debug, Serialize)]
struct Row<'a> {
    pan: &'a str,
    width: u32,
    height: u32,
    frames: u32,
    filter: String,
    sampling: &'static str,
    samples: Option<u32>,
    split: Option<f64>,
    #[serde(serialize_with = "light")]
    error: f64,
    #[serde(serialize_with = "light")]
    steady: f64,
    #[serde(serialize_with = "light")]
    changing: f64,
    #[serde(serialize_with = "light")]
    changing_least: f64,
    #[serde(serialize_with = "light")]
    step: f64,
    #[serde(serialize_with = "light")]
    step_least: f64,
    truth_samples: u32,
    #[serde(serialize_with = "seconds")]
    cpu_s: f64,
    #[serde(serialize_with = "seconds")]
    once_cpu_s: f64,
    threads: usize,
}

/// Returns one row for each pan and method.
///
/// # Panics
/// Never: every value is a number or a word, and a text in memory takes all of them.
#[must_use]
pub fn csv(pans: &[PanMeasured], threads: usize) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for pan in pans {
        for trial in &pan.trials {
            writer.serialize(row(pan, trial, threads)).expect("a row has no nested values");
        }
    }
    writer.into_inner().expect("memory takes every byte")
}

fn row<'a>(pan: &'a PanMeasured, trial: &Trial, threads: usize) -> Row<'a> {
    let Trial { method, parts, cpu, once_cpu } = trial;
    let (width, height) = pan.plan.size;
    Row {
        pan: pan.name,
        width,
        height,
        frames: pan.plan.frames,
        filter: method.filter.to_string(),
        sampling: sampling(method.sampling),
        samples: samples(method.sampling),
        split: method.areas().and_then(|(_, threshold)| threshold),
        error: parts.error.rms,
        steady: parts.steady.rms,
        changing: parts.changing.rms,
        changing_least: parts.changing.least,
        step: parts.step.rms,
        step_least: parts.step.least,
        truth_samples: pan.plan.truth_samples,
        cpu_s: *cpu,
        once_cpu_s: *once_cpu,
        threads,
    }
}

/// The columns with their units and meanings.
const COLUMNS: [[&str; 3]; 18] = [
    ["pan", "", "name of the pan: direct, mirror or glass"],
    ["width", "pixels", "width of the pictures"],
    ["height", "pixels", "height of the pictures"],
    ["frames", "", "frames of the pan"],
    ["filter", "", "texture filter, as --filter of render"],
    ["sampling", "", "where the rays are, as --sampling of render"],
    [
        "samples",
        "",
        "rays or areas along each side of a pixel; empty for the thesis's supersampling",
    ],
    ["split", "", "threshold above which an area splits; empty if none does"],
    ["error", "linear light, white is 1", "root mean square of the errors of all frames"],
    ["steady", "linear light", "root mean square of the mean of the errors over the frames"],
    ["changing", "linear light", "root mean square of the difference of the errors from this mean"],
    ["changing_least", "linear light", "a smaller changing part cannot be measured"],
    [
        "step",
        "linear light",
        "root mean square of the change of the errors to the next frame, over the root of 2",
    ],
    ["step_least", "linear light", "a smaller step cannot be measured"],
    ["truth_samples", "", "rays along each side of a pixel of each of the two pictures of a truth"],
    [
        "cpu_s",
        "seconds",
        "processor time of a frame without what all frames share, median of the frames",
    ],
    [
        "once_cpu_s",
        "seconds",
        "processor time of what all frames share and no method before has built",
    ],
    ["threads", "", "threads that made the pictures"],
];

/// Returns the table of the columns.
///
/// # Panics
/// Never: every value is a word, and a text in memory takes all of them.
#[must_use]
pub fn columns() -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in [["column", "unit", "meaning"]].iter().chain(&COLUMNS) {
        writer.write_record(row).expect("a row has no nested values");
    }
    writer.into_inner().expect("memory takes every byte")
}

#[cfg(test)]
mod tests {
    use super::super::Plan;
    use super::super::parts::Parts;
    use super::*;

    #[test]
    fn a_row_has_the_columns_of_the_table() {
        let trial = |method| Trial { method, parts: Parts::default(), cpu: 0.25, once_cpu: 0.5 };
        let trials: Vec<Trial> = super::super::methods().into_iter().map(trial).collect();
        let count = trials.len();
        let pan = PanMeasured { name: "glass", title: "", plan: Plan::full(), trials };
        let text = csv(&[pan], 3);
        let mut reader = csv::Reader::from_reader(text.as_slice());
        let columns = reader.headers().unwrap().clone();
        assert!(columns.iter().eq(COLUMNS.iter().map(|column| column[0])), "{columns:?}");
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), count);
        let expected = ["glass", "96", "64", "24", "point", "thesis", "1", "", "0.0000e0"];
        assert!(rows[0].iter().take(9).eq(expected), "{:?}", rows[0]);
        assert!(rows[0].iter().skip(15).eq(["0.250000", "0.500000", "3"]), "{:?}", rows[0]);
        assert!(super::columns().starts_with(b"column,unit,meaning\npan,,\"name of the pan: "));
    }
}
