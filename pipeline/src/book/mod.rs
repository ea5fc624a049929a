//! The picture book: pages with their pictures, modes, costs and errors, as one file of HTML.
//!
//! Each page of it is made as [`crate::run()`] makes it ([`Plate`]), and looked at closely: parts of it
//! pixel by pixel in each mode beside what they ought to be ([`Detail`], [`crate::truth`]), where its time went,
//! and its files. The book refers to nothing outside of it. Its pictures and errors are the same whenever
//! it is made; its times are measured.

pub mod argument;
pub mod detail;
pub mod front;
pub mod image;
pub mod leaf;
pub mod plate;
pub mod sources;

pub use detail::Detail;
pub use plate::Plate;

use crate::html::styled_page;
use crate::{Job, PipelineError, run};
use files::Source;
use maud::html;
use std::path::Path;

const STYLE: &str = include_str!("style.css");

/// What the file is called.
pub const FILE: &str = "book.html";

/// The page that is the book's first picture, if it is in it.
const FRONTISPIECE: &str = "frontispiece";

/// A job for the book.
#[derive(Debug, Clone, Copy)]
pub struct Entry<'a> {
    /// The job.
    pub job: &'a Job,
    /// Its file.
    pub path: &'a Path,
    /// Where it and its files are.
    pub source: &'a dyn Source,
    /// What `pipeline run` calls it.
    pub argument: &'a str,
}

/// How the book is made.
#[derive(Debug, Clone)]
pub struct Options {
    /// Pixels across and down of each picture.
    pub size: (u32, u32),
    /// Rays along each side of a pixel of a truth, for each of two seeds; 0 for no truths and no errors.
    pub truth: u32,
}

/// Makes the book: the figures of the thesis in their order, then the others as they come. `tell` is told of each
/// page that is made.
///
/// # Errors
/// On the first thing that is wrong with a job or one of its files.
pub fn book(
    entries: &[Entry<'_>],
    options: &Options,
    tell: &dyn Fn(&Job),
) -> Result<String, PipelineError> {
    let mut entries = entries.to_vec();
    entries.sort_by_key(|entry| match entry.job.figures().first() {
        Some(figure) => *figure,
        None if entry.job.name == FRONTISPIECE => u8::MAX - 1,
        None => u8::MAX,
    });
    let run_options = run::Options {
        folder: Default::default(),
        size: options.size,
        keep: false,
        clobber: false,
    };
    let mut front = front::Front::new(options);
    let mut leaves = Vec::new();
    for (k, entry) in entries.iter().enumerate() {
        let plate = Plate::make(entry, &run_options, options.truth)?;
        let id = format!("{}-{k}", word(&entry.job.name));
        front.take(entry, &plate, &id, entry.job.name == FRONTISPIECE)?;
        leaves.push(leaf::leaf(entry, &plate, &id, options)?);
        tell(entry.job);
    }
    let body = html! {
        (front.print())
        main { @for leaf in &leaves { (leaf) } }
    };
    Ok(styled_page("Topobook: the picture book", STYLE, &body))
}

/// A name as part of an anchor: letters, digits and hyphens.
fn word(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect()
}
