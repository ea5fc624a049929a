//! Writes the files of a report.

use super::document;
use super::measured::Measured;
use super::plot;
use super::words;
use crate::PipelineError;
use files::{Batch, Output};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The file name of the HTML page.
const DOCUMENT: &str = "report.html";

/// Returns the file names of a report of these pages: the HTML page, and the plot of each page.
pub fn files<'a>(pages: impl Iterator<Item = &'a str>) -> Vec<String> {
    std::iter::once(DOCUMENT.into()).chain(pages.map(|page| format!("{page}.svg"))).collect()
}

/// Writes `report.html`, and for each page its plot as `PAGE.svg`, into an existing folder, as a part
/// of a batch. Returns the paths of the files, in the order in which they were written.
///
/// # Errors
/// When a file cannot be written, or exists and `clobber` is false; when a picture cannot be encoded.
pub fn write(
    measured: &Measured,
    folder: &Path,
    clobber: bool,
    batch: &Batch<'_>,
) -> Result<Vec<PathBuf>, PipelineError> {
    let claims = words::claims(measured);
    let mut contents = vec![document::document(measured, &claims)?];
    contents.extend(measured.pages.iter().map(|page| {
        let chart = plot::trials::whole(page);
        chart.file(&document::about_plot(page))
    }));
    let names = files(measured.pages.iter().map(|page| page.name.as_str()));
    let paths: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
    for (path, text) in paths.iter().zip(contents) {
        let mut output = Output::create(path, clobber)?;
        output.write_all(text.as_bytes()).map_err(|source| output.failed(source))?;
        batch.replace(output)?;
    }
    Ok(paths)
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
        write(measured, folder, clobber, &batch)
    }

    fn example() -> Measured {
        let regions: [(&str, &fixture::Law<'_>); 2] =
            [("far floor", &fixture::floor), ("silhouettes", &fixture::edges)];
        fixture::measured(vec![
            fixture::page("floor", &fixture::floor, &regions),
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
        assert_eq!(names, ["report.html", "floor.svg", "edges.svg"]);
        let text = fs::read_to_string(&paths[0]).unwrap();
        for outside in ["<script", "<link", "@import", "src=\"http", "href=\"http", "url("] {
            assert!(!text.contains(outside), "{outside}");
        }
        for claim in words::claims(&measured) {
            // Tags surround the text in bold.
            let (_, end) = claim.text.split_once(" where ").unwrap_or(("", &claim.text));
            assert!(text.contains(&document::set(end)), "{}", claim.text);
        }
        for page in &measured.pages {
            assert!(text.contains(&page.title) && text.contains(&format!("id=\"{}\"", page.name)));
            assert!(
                page.trials.iter().all(|trial| text.contains(&document::set(&trial.method.name())))
            );
            assert!(page.regions.iter().all(|region| text.contains(region.name)));
        }
        assert!(!text.contains("NaN") && text.contains("The table filters"));
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
