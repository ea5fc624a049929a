//! The picture book: pages with their pictures, modes, costs and errors, as one HTML file.
//!
//! Each page is rendered as [`crate::run()`] renders it ([`Plate`]). The book shows parts of each
//! picture pixel by pixel, in each mode and beside the truth ([`Detail`], [`crate::truth`]). It also
//! shows the time of each stage and the files of the job. The book refers to nothing outside itself.
//! Its pictures and errors are the same in every run; its times are measured.

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

/// The file name of the book.
pub const FILE: &str = "book.html";

/// The name of the page whose picture opens the book, if the book has that page.
const FRONTISPIECE: &str = "frontispiece";

/// A job for the book.
#[derive(Debug, Clone, Copy)]
pub struct Entry<'a> {
    /// The job.
    pub job: &'a Job,
    /// The path of the job's file.
    pub path: &'a Path,
    /// The source of the job's file and of the files that it names.
    pub source: &'a dyn Source,
    /// The argument that names the job on the command line of `pipeline run`.
    pub argument: &'a str,
}

/// Options of the book.
#[derive(Debug, Clone)]
pub struct Options {
    /// Width and height of each picture, in pixels.
    pub size: (u32, u32),
    /// Rays along each side of a pixel of a truth, for each of two seeds. 0 leaves out truths and
    /// errors.
    pub truth: u32,
}

/// Makes the book. Pages with figures of the thesis come first, by figure number, then the
/// frontispiece, then the others in the order of `entries`. `tell` is called after each page.
///
/// # Errors
/// On the first error in a job or in one of its files.
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

/// Returns a name as part of an anchor, with hyphens for all characters but ASCII letters and digits.
fn word(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect()
}
