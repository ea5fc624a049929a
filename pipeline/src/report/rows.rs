//! Writes the numbers of a report as comma separated values.

use super::measured::{Measured, PageMeasured, Trial};
use compare::Difference;
use render::Sampling;
use render::film::Supersample;
use serde::{Serialize, Serializer};

/// One method on one page in one region. The names of the fields are those of the columns.
#[derive(Debug, Serialize)]
struct Row<'a> {
    page: &'a str,
    width: u32,
    height: u32,
    filter: String,
    sampling: &'static str,
    samples: Option<u32>,
    split: Option<f64>,
    #[serde(serialize_with = "light")]
    rays_per_pixel: f64,
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
    once_wall_s: f64,
    #[serde(serialize_with = "seconds")]
    once_cpu_s: f64,
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
            sampling: sampling(trial.method.sampling),
            samples: samples(trial.method.sampling),
            split: areas.and_then(|(_, threshold)| threshold),
            rays_per_pixel: cost.primary_rays as f64
                / (f64::from(page.size.0) * f64::from(page.size.1)),
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
            once_wall_s: cost.once_wall,
            once_cpu_s: cost.once_cpu,
            tables_s: cost.tables,
            rays: cost.rays,
            texels: cost.texels,
            peak_bytes: cost.peak_bytes,
            threads: 0,
        }
    }
}

/// Writes an error with five significant digits.
pub(super) fn light<S: Serializer>(light: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{light:.4e}"))
}

/// Writes a time in whole microseconds.
pub(super) fn seconds<S: Serializer>(seconds: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{seconds:.6}"))
}

/// Returns the name of a method of choosing rays: `area`, `thesis`, or a form of the thesis's supersampling.
pub(super) fn sampling(sampling: Sampling) -> &'static str {
    match sampling {
        Sampling::Supersample(Supersample::Image) => "supersample-image",
        Sampling::Supersample(Supersample::Rays) => "supersample-rays",
        Sampling::Grid { .. } => "thesis",
        Sampling::Area { .. } => "area",
    }
}

/// Returns the rays or areas along each side of a pixel; `None` if the method fixes them.
pub(super) fn samples(sampling: Sampling) -> Option<u32> {
    match sampling {
        Sampling::Supersample(_) => None,
        Sampling::Grid { samples, .. } | Sampling::Area { samples, .. } => Some(samples),
    }
}

/// The columns in their order, each with its unit and its meaning. `columns.csv` beside a report holds this table.
pub const COLUMNS: [(&str, &str, &str); 25] = [
    ("page", "", "name of the page"),
    ("width", "pixels", "width of the picture"),
    ("height", "pixels", "height of the picture"),
    ("filter", "", "texture filter, as --filter of render names it"),
    (
        "sampling",
        "",
        "area: areas around single rays; thesis: rays on a lattice; supersample-image and supersample-rays: the \
         thesis's nine weights",
    ),
    ("samples", "", "rays or areas along each side of a pixel; empty if the method fixes them"),
    ("split", "linear light", "threshold above which pixels split; empty if they do not"),
    ("rays_per_pixel", "", "rays from the eye, in the mean of the pixels"),
    ("region", "", "whole: the picture; otherwise the part of it that the errors are about"),
    ("pixels", "pixels", "pixels of the region"),
    ("rmse", "linear light", "root mean square error, without the noise of the truth"),
    ("max", "linear light", "largest error of a channel"),
    ("p999", "linear light", "error that 99.9 % of the pixels do not exceed"),
    ("bias", "linear light", "mean of picture minus truth"),
    (
        "truth_noise",
        "linear light",
        "estimated error of the truth in the region; 0 for a given truth",
    ),
    ("settled", "true or false", "true if truth_noise is at most a tenth of rmse"),
    ("wall_s", "seconds", "time of the first picture"),
    ("cpu_s", "seconds", "processor time of the first picture, over all threads"),
    ("once_wall_s", "seconds", "part of wall_s that further pictures of the scene do not need"),
    ("once_cpu_s", "seconds", "part of cpu_s that further pictures of the scene do not need"),
    ("tables_s", "seconds", "part of once_wall_s for tables and pyramids of textures"),
    ("rays", "", "rays of all kinds, with shadow rays"),
    ("texels", "", "texels and table entries that were read"),
    ("peak_bytes", "bytes", "most memory held at once beyond that of the scene"),
    ("threads", "", "threads that made the picture"),
];

/// Returns the table of the columns.
///
/// # Panics
/// Never: every value is a word, and a text in memory takes all of them.
#[must_use]
pub fn columns() -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let rows = [("column", "unit", "meaning")].into_iter().chain(COLUMNS);
    for row in rows {
        writer.serialize(row).expect("a row has no nested values");
    }
    writer.into_inner().expect("memory takes every byte")
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
        assert_eq!((columns.len(), records.len()), (COLUMNS.len(), rows));
        assert!(columns.iter().eq(COLUMNS.iter().map(|column| column.0)), "{columns:?}");
        let expected = [
            "a, b",
            "96",
            "64",
            "point",
            "thesis",
            "1",
            "",
            "1.0000e0",
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
            "0.000000",
            "0.000000",
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
        assert_eq!(ends[1], ["exact", "area", "2", ""]);
        assert_eq!(ends[2], ["exact", "area", "2", "0.1"]);
    }

    #[test]
    fn numbers_are_numbers() {
        let text = csv(&fixture::measured(vec![fixture::page("a", &fixture::floor, &[])]));
        let mut reader = csv::Reader::from_reader(text.as_slice());
        let columns = reader.headers().unwrap().clone();
        let words = ["page", "filter", "sampling", "region", "settled"];
        for record in reader.records().map(Result::unwrap) {
            for (column, value) in columns.iter().zip(&record) {
                let is_number = value.is_empty() || value.parse::<f64>().is_ok();
                assert!(is_number != words.contains(&column), "{column}: {value}");
            }
        }
        let table = String::from_utf8(super::columns()).unwrap();
        assert!(table.starts_with("column,unit,meaning\npage,,name of the page\n"), "{table}");
    }
}
