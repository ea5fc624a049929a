//! Writes the numbers of a report as comma separated values, and reads tables back.

use super::measured::{Measured, PageMeasured, Table, Trial};
use crate::compare::Difference;
use render::Sampling;
use render::film::{Pattern, PixelFilter, Supersample};

const COLUMNS: [&str; 20] = [
    "page",
    "width",
    "height",
    "filter",
    "rays_in_a_pixel",
    "region",
    "pixels",
    "rmse",
    "max",
    "p999",
    "bias",
    "truth_noise",
    "settled",
    "wall_s",
    "cpu_s",
    "tables_s",
    "rays",
    "texels",
    "peak_bytes",
    "threads",
];

/// Returns one row for each page, method and region; the region of the whole picture (`whole`) comes
/// first.
///
/// Errors are in linear light, where white is 1. `truth_noise` is about the error of the truth itself
/// in the same region; it is subtracted from `rmse`, as squares. `settled` says whether `truth_noise`
/// is at most a tenth of `rmse`. In that case the two pictures whose mean is the truth differ by at
/// most a fifth of `rmse`.
#[must_use]
pub fn trials(measured: &Measured) -> String {
    let mut text = line(COLUMNS.iter().copied());
    for page in &measured.pages {
        for trial in &page.trials {
            text += &row(page, trial, "whole", &trial.whole, page.truth.noise, measured.threads);
            let regions = page.regions.iter().zip(&trial.by_region);
            for ((region, error), &noise) in regions.zip(&page.truth.noise_by_region) {
                text += &row(page, trial, region.name, error, noise, measured.threads);
            }
        }
    }
    text
}

fn row(
    page: &PageMeasured,
    trial: &Trial,
    region: &str,
    error: &Difference,
    noise: f64,
    threads: usize,
) -> String {
    let cost = &trial.cost;
    let seconds = |seconds: f64| format!("{seconds:.6}");
    let light = |light: f64| format!("{light:.4e}");
    let cells = [
        page.name.clone(),
        page.size.0.to_string(),
        page.size.1.to_string(),
        trial.method.filter.to_string(),
        rays(trial.method.sampling),
        region.into(),
        error.pixels.to_string(),
        light(error.rmse),
        light(error.max),
        light(error.p999),
        light(error.bias),
        light(noise),
        (error.rmse >= 10.0 * noise).to_string(),
        seconds(cost.wall),
        seconds(cost.cpu),
        seconds(cost.tables),
        cost.rays.to_string(),
        cost.texels.to_string(),
        cost.peak_bytes.to_string(),
        threads.to_string(),
    ];
    line(cells.iter().map(String::as_str))
}

/// Returns the rays of a pixel in the words of the flags of `render`: `3` for `--samples 3`, or the
/// name of the thesis's supersampling.
fn rays(sampling: Sampling) -> String {
    match sampling {
        Sampling::Supersample(Supersample::Image) => "supersample=image".into(),
        Sampling::Supersample(Supersample::Rays) => "supersample=rays".into(),
        Sampling::Grid { samples, pattern, pixel_filter } => {
            let mut text = samples.to_string();
            if let Pattern::Jitter { seed } = pattern {
                text += &format!(" jitter {seed}");
            }
            if pixel_filter == PixelFilter::Tent {
                text += " tent";
            }
            text
        }
    }
}

/// Returns one table, with the names of its columns in the first line.
#[must_use]
pub fn table(table: &Table) -> String {
    let rows = std::iter::once(&table.columns).chain(&table.rows);
    rows.map(|row| line(row.iter().map(String::as_str))).collect()
}

/// Returns a line of cells. Cells with commas, quotation marks or line breaks are quoted.
fn line<'a>(cells: impl Iterator<Item = &'a str>) -> String {
    let quoted = |cell: &str| {
        if cell.contains([',', '"', '\n']) {
            format!("\"{}\"", cell.replace('"', "\"\""))
        } else {
            cell.to_string()
        }
    };
    cells.map(quoted).collect::<Vec<String>>().join(",") + "\n"
}

/// Reads the columns and rows of a text of comma separated values. Cells must not contain line breaks.
#[must_use]
pub fn read(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let mut rows = text.lines().filter(|line| !line.is_empty()).map(cells);
    (rows.next().unwrap_or_default(), rows.collect())
}

fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        let last = cells.len() - 1;
        match c {
            '"' if quoted && rest.next_if_eq(&'"').is_some() => cells[last].push('"'),
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells[last].push(c),
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let rows =
            vec![vec!["box, 1 px".into(), "a \"b\"".into()], vec![String::new(), "3".into()]];
        let (columns, drawing) = (vec!["method".to_string(), "x".to_string()], None);
        let (title, about) = (String::new(), String::new());
        let whole = Table { name: "t", title, about, command: None, columns, rows, drawing };
        let text = table(&whole);
        assert_eq!(text, "method,x\n\"box, 1 px\",\"a \"\"b\"\"\"\n,3\n");
        assert_eq!(read(&text), (whole.columns, whole.rows));
    }

    #[test]
    fn rays_are_called_as_flags_call_them() {
        let jittered = Sampling::Grid {
            samples: 4,
            pattern: Pattern::Jitter { seed: 7 },
            pixel_filter: PixelFilter::Tent,
        };
        assert_eq!(rays(Sampling::regular(3)), "3");
        assert_eq!(rays(jittered), "4 jitter 7 tent");
        assert_eq!(rays(Sampling::Supersample(Supersample::Rays)), "supersample=rays");
    }
}
