//! `pipeline list`: lists the built-in pages.

use crate::job::figure;
use crate::pages;
use files::{Output, Report};
use std::path::Path;

/// Prints one line for each page: first the pages of the thesis, with the numbers of their figures, then
/// the others.
pub fn list() -> Result<(), Report> {
    let rows: Vec<[String; 3]> = pages::in_order()?
        .into_iter()
        .map(|job| {
            let figures = figure::listed(&job.figures());
            [job.name, figures, job.title]
        })
        .collect();
    let wide = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let (names, figures) = (wide(0).unwrap_or(0), wide(1).unwrap_or(0));
    let mut text = String::new();
    for [name, numbers, title] in &rows {
        text.push_str(&format!("{name:<names$}  {numbers:<figures$}  {title}\n"));
    }
    Ok(Output::create(Path::new("-"), true)?.commit_all(files::words::printed(&text).as_bytes())?)
}
