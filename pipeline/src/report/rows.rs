//! Writes the numbers of a report as comma separated values.

use super::measured::{Measured, PageMeasured, Trial};
use compare::Difference;
use render::Sampling;
use render::film::{Pattern, PixelFilter, Supersample};
use serde::{Serialize, Serializer};

/// One method on one page in one region. The names of the fields are those of the columns.
#[derive(Debug, Serialize)]
struct Row<'a> {
    page: &'a str,
    width: u32,
    height: u32,
    filter: String,
    sampling: &'static str,
    rays_in_a_pixel: String,
    split: String,
    region: &'a str,
    pixels: usize,
    #[serde(serialize_with = "light")]
    rmse: f64,
    #[serde(serialize_with = "light")]
    max: f64,
    #[serde(serialize_with = "light")]
    p999: f64,
    #[serde(serialize_with = "light")]
    bias: f64,
    #[serde(serialize_with = "light")]
    truth_noise: f64,
    settled: bool,
    #[serde(serialize_with = "seconds")]
    wall_s: f64,
    #[serde(serialize_with = "seconds")]
    cpu_s: f64,
    #[serde(serialize_with = "seconds")]
    tables_s: f64,
    rays: u64,
    texels: u64,
    peak_bytes: usize,
    threads: usize,
}

/// Returns one row for each page, method and region; the region of the whole picture (`whole`) comes
/// first.
///
/// Errors are in linear light, where white is 1. `truth_noise` is about the error of the truth itself
/// in the same region; it is subtracted from `rmse`, as squares. `settled` says whether `truth_noise`
/// is at most a tenth of `rmse`. In that case the two pictures whose mean is the truth differ by at
/// most a fifth of `rmse`.
///
/// # Panics
/// Never: every value is a number, a word or a truth value, and a text in memory takes all of them.
#[must_use]
pub fn csv(measured: &Measured) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut put = |row: Row<'_>| writer.serialize(row).expect("a row has no nested values");
    for page in &measured.pages {
        for trial in &page.trials {
            let row = |region, error, noise| Row {
                threads: measured.threads,
                ..Row::new(page, trial, region, error, noise)
            };
            put(row("whole", &trial.whole, page.truth.noise));
            let regions = page.regions.iter().zip(&trial.by_region);
            for ((region, error), &noise) in regions.zip(&page.truth.noise_by_region) {
                put(row(region.name, error, noise));
            }
        }
    }
    writer.into_inner().expect("memory takes every byte")
}

impl<'a> Row<'a> {
    fn new(
        page: &'a PageMeasured,
        trial: &Trial,
        region: &'a str,
        error: &Difference,
        noise: f64,
    ) -> Self {
        let (cost, areas) = (&trial.cost, trial.method.areas());
        Self {
            page: &page.name,
            width: page.size.0,
            height: page.size.1,
            filter: trial.method.filter.to_string(),
            sampling: if areas.is_some() { "area" } else { "thesis" },
            rays_in_a_pixel: rays(trial.method.sampling),
            split: areas.map_or(String::new(), |(_, threshold)| {
                threshold.map_or("none".into(), |threshold| threshold.to_string())
            }),
            region,
            pixels: error.pixels,
            rmse: error.rmse,
            max: error.max,
            p999: error.p999,
            bias: error.bias,
            truth_noise: noise,
            settled: error.rmse >= 10.0 * noise,
            wall_s: cost.wall,
            cpu_s: cost.cpu,
            tables_s: cost.tables,
            rays: cost.rays,
            texels: cost.texels,
            peak_bytes: cost.peak_bytes,
            threads: 0,
        }
    }
}

/// Writes an error with five significant digits.
fn light<S: Serializer>(light: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{light:.4e}"))
}

/// Writes a time in whole microseconds.
fn seconds<S: Serializer>(seconds: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{seconds:.6}"))
}

/// Returns the rays of a pixel in the words of the flags of `render`: `3` for `--samples 3`, or the
/// name of the thesis's supersampling. Other weights than equal ones are named after the number.
fn rays(sampling: Sampling) -> String {
    match sampling {
        Sampling::Supersample(Supersample::Image) => "supersample=image".into(),
        Sampling::Supersample(Supersample::Rays) => "supersample=rays".into(),
        Sampling::Grid { samples, pattern, pixel_filter } => {
            let mut text = samples.to_string();
            if let Pattern::Jitter { seed } = pattern {
                text += &format!(" jitter {seed}");
            }
            text + weights(pixel_filter)
        }
        Sampling::Area { samples, pixel_filter, .. } => samples.to_string() + weights(pixel_filter),
    }
}

fn weights(pixel_filter: PixelFilter) -> &'static str {
    match pixel_filter {
        PixelFilter::Box => "",
        PixelFilter::Tent => " tent",
        PixelFilter::Gaussian => " gaussian",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn a_row_has_the_numbers_of_its_trial() {
        let regions: [(&str, &fixture::Law<'_>); 1] = [("far floor", &fixture::edges)];
        let page = fixture::with_areas("a, b", &fixture::floor, &regions);
        let rows = 2 * page.trials.len();
        let text = csv(&fixture::measured(vec![page]));
        let mut reader = csv::Reader::from_reader(text.as_slice());
        let columns = reader.headers().unwrap().clone();
        let records: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert_eq!((columns.len(), records.len()), (22, rows));
        let expected = [
            "a, b",
            "96",
            "64",
            "point",
            "thesis",
            "1",
            "",
            "far floor",
            "1536",
            "2.1200e-1",
            "8.4800e-1",
            "6.3600e-1",
            "0.0000e0",
            "5.0000e-4",
            "true",
            "0.009000",
            "0.018000",
            "0.010000",
            "6144",
            "24576",
            "1048576",
            "2",
        ];
        assert_eq!(records[1], csv::StringRecord::from(expected.as_slice()));
        // The columns of the method, of the three last methods by areas: rays, and splitting.
        let ends = [6, 4, 2].map(|k| {
            let record = &records[records.len() - k];
            [3, 4, 5, 6].map(|column| record[column].to_string())
        });
        assert_eq!(ends[0], ["exact", "area", "1", "0.01"]);
        assert_eq!(ends[1], ["exact", "area", "2", "none"]);
        assert_eq!(ends[2], ["exact", "area", "2", "0.1"]);
    }

    #[test]
    fn rays_are_called_as_flags_call_them() {
        let jittered = Sampling::Grid {
            samples: 4,
            pattern: Pattern::Jitter { seed: 7 },
            pixel_filter: PixelFilter::Tent,
        };
        assert_eq!(rays(Sampling::regular(3)), "3");
        let pixel_filter = PixelFilter::Gaussian;
        assert_eq!(
            rays(Sampling::Area { samples: 2, pixel_filter, threshold: None }),
            "2 gaussian"
        );
        assert_eq!(rays(jittered), "4 jitter 7 tent");
        assert_eq!(rays(Sampling::Supersample(Supersample::Rays)), "supersample=rays");
    }
}
