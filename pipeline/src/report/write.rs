//! Writes the files of a report.

use super::accompanying::{self, Accompanying};
use super::advice;
use super::document;
use super::measured::Measured;
use super::plot;
use super::rows;
use crate::PipelineError;
use files::{Batch, Output};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The file name of the HTML page.
const DOCUMENT: &str = "report.html";

/// The file name of the table of columns.
const COLUMNS: &str = "columns.csv";

/// The file name of the numbers of all pages.
const NUMBERS: &str = "report.csv";

/// Returns the file names of a report of these pages: the numbers, their columns, the accompanying tables, the HTML
/// page, and the plot of each page.
pub fn files<'a>(pages: impl Iterator<Item = &'a str>) -> Vec<String> {
    let tables = accompanying::ALL.iter().map(Accompanying::file);
    let fixed = [NUMBERS.into(), COLUMNS.into()].into_iter().chain(tables).chain([DOCUMENT.into()]);
    fixed.chain(pages.map(|page| format!("{page}.svg"))).collect()
}

/// Writes the numbers of the pages measured so far as `report.csv`, as a part of a batch. An existing
/// file is replaced.
///
/// # Errors
/// When the file cannot be written.
pub fn write_numbers(
    measured: &Measured,
    folder: &Path,
    batch: &Batch<'_>,
) -> Result<(), PipelineError> {
    write_file(&folder.join(NUMBERS), &rows::csv(measured), true, batch)
}

/// Writes the files of a report into an existing folder, as a part of a batch. [`write_numbers`] has
/// written the first. Returns the paths of all files in the order of [`files()`].
///
/// # Errors
/// When a file cannot be written, or exists and `clobber` is false; when a picture cannot be encoded.
pub fn write(
    measured: &Measured,
    folder: &Path,
    clobber: bool,
    batch: &Batch<'_>,
) -> Result<Vec<PathBuf>, PipelineError> {
    let advice = advice::sentences(measured);
    let columns = String::from_utf8_lossy(&rows::columns()).into_owned();
    let tables = accompanying::ALL.iter().map(|own| own.table.to_owned());
    let mut contents: Vec<String> = std::iter::once(columns).chain(tables).collect();
    contents.push(document::document(measured, &advice)?);
    contents.extend(measured.pages.iter().map(|page| {
        let chart = plot::trials::whole(page);
        chart.file(&document::about_plot(page))
    }));
    let names = files(measured.pages.iter().map(|page| page.name.as_str()));
    let paths: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
    for (path, text) in paths.iter().skip(1).zip(contents) {
        write_file(path, text.as_bytes(), clobber, batch)?;
    }
    Ok(paths)
}

fn write_file(
    path: &Path,
    content: &[u8],
    clobber: bool,
    batch: &Batch<'_>,
) -> Result<(), PipelineError> {
    let mut output = Output::create(path, clobber)?;
    output.write_all(content).map_err(|source| output.failed(source))?;
    Ok(batch.replace(output)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;
    use std::fs;

    fn written(
        measured: &Measured,
        folder: &Path,
        clobber: bool,
    ) -> Result<Vec<PathBuf>, PipelineError> {
        let batch = Batch::new(folder, "report", &[]).unwrap();
        write_numbers(measured, folder, &batch)?;
        write(measured, folder, clobber, &batch)
    }

    fn example() -> Measured {
        let regions: [(&str, &fixture::Law<'_>); 2] =
            [("far floor", &fixture::floor), ("silhouettes", &fixture::edges)];
        fixture::measured(vec![
            fixture::with_areas("floor", &fixture::floor, &regions),
            fixture::page("edges", &fixture::edges, &regions[1..]),
        ])
    }

    #[test]
    fn a_report_stands_alone_and_has_every_page_region_method_and_sentence() {
        let folder = tempfile::tempdir().unwrap();
        let measured = example();
        if let Ok(look) = std::env::var("LOOK") {
            written(&measured, Path::new(&look), true).unwrap();
        }
        let paths = written(&measured, folder.path(), false).unwrap();
        let names: Vec<_> = paths.iter().map(|path| path.file_name().unwrap()).collect();
        let expected = [
            "report.csv",
            "columns.csv",
            "filters.csv",
            "tessellation.csv",
            "mapping.csv",
            "report.html",
            "floor.svg",
            "edges.svg",
        ];
        assert_eq!(names, expected);
        assert!(paths.iter().all(|path| path.is_file()));
        let text = fs::read_to_string(&paths[5]).unwrap();
        for outside in ["<script", "<link", "@import", "src=\"http", "href=\"http", "url("] {
            assert!(!text.contains(outside), "{outside}");
        }
        for sentence in advice::sentences(&measured) {
            assert!(text.contains(&document::set(&sentence.text)), "{}", sentence.text);
        }
        for page in &measured.pages {
            assert!(text.contains(&page.title) && text.contains(&format!("id=\"{}\"", page.name)));
            assert!(
                page.trials.iter().all(|trial| text.contains(&document::set(&trial.method.name())))
            );
            assert!(page.regions.iter().all(|region| text.contains(region.name)));
        }
        assert!(!text.contains("NaN"));
    }

    #[test]
    fn files_are_replaced_only_if_that_is_allowed() {
        let folder = tempfile::tempdir().unwrap();
        let measured = fixture::measured(Vec::new());
        written(&measured, folder.path(), false).unwrap();
        assert!(written(&measured, folder.path(), false).is_err());
        let before = fs::read(folder.path().join("report.html")).unwrap();
        written(&measured, folder.path(), true).unwrap();
        assert_eq!(before, fs::read(folder.path().join("report.html")).unwrap());
    }
}
