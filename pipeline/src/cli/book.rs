//! `pipeline book`: the picture book.

use super::named::{self, NamedJob};
use super::{OTHER_FOLDER, make_folder};
use crate::book::{self, Entry, Options};
use clap::Args;
use files::CommonArguments;
use files::MemoryError;
use files::Report;
use files::exit::wrote_about;
use files::memory::{Reserved, of_process};
use files::progress::Progress;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Arguments of `pipeline book`.
#[derive(Debug, Args)]
pub struct BookArguments {
    /// Pages by name, pages by the number of a figure that they show, or job files [default: all
    /// pages]
    #[arg(value_name = "NAME|all|A.N|FILE.json")]
    jobs: Vec<String>,
    /// The folder for the book; created if it is missing
    #[arg(short, long, value_name = "DIR", default_value = "book")]
    output: PathBuf,
    /// Pixels across and down of each picture
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = render::film::size)]
    size: (u32, u32),
    /// Rays along each side of a pixel of a truth, for each of two seeds; 0 omits truths and errors
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(0..=256))]
    truth: u32,
    #[command(flatten)]
    common: CommonArguments,
}

/// Reserves memory for the page: for the pictures as PNG files, as base64, and in the text of the
/// page, whose buffer grows by doubling.
fn reserve_page(jobs: &[NamedJob], size: (u32, u32)) -> Result<Reserved<'static>, MemoryError> {
    const OF_PIXEL: u64 = 3 + 4 + 2 * 4;
    let pictures: u64 = jobs.iter().map(|named| named.job.modes.len() as u64).sum();
    let pixels = u64::from(size.0) * u64::from(size.1) * pictures;
    let what = || format!("a page with {pictures} pictures of {}x{} pixels", size.0, size.1);
    of_process().reserve(pixels.saturating_mul(OF_PIXEL), what)
}

/// Makes the book.
pub fn book(arguments: &BookArguments) -> Result<(), Report> {
    arguments.common.begin();
    let ledger = arguments.common.ledger();
    let jobs = if arguments.jobs.is_empty() {
        named::jobs(&["all".to_owned()], &[], &ledger)?
    } else {
        named::jobs(&arguments.jobs, &[], &ledger)?
    };
    make_folder(&arguments.output)?;
    let path = arguments.output.join(book::FILE);
    ledger.claim(&path, OTHER_FOLDER)?;
    let options = Options { size: arguments.size, truth: arguments.truth };
    let names: Vec<String> = jobs.iter().map(NamedJob::whole).collect();
    let entries: Vec<Entry<'_>> = jobs
        .iter()
        .zip(&names)
        .map(|(NamedJob { job, path, source, .. }, argument)| Entry {
            job,
            path,
            source: *source,
            argument,
        })
        .collect();
    let _reserved = reserve_page(&jobs, arguments.size)?;
    let started = Instant::now();
    let progress = Progress::new("book", arguments.common.quiet);
    let done = AtomicUsize::new(0);
    let text = arguments.common.pool()?.install(|| {
        book::book(&entries, &options, &|_| {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.tell(done, entries.len());
        })
    })?;
    drop(progress);
    ledger.create(&path)?.commit_all(text.as_bytes())?;
    if !arguments.common.quiet {
        let megabytes = text.len() as f64 / 1e6;
        let pages = entries.len();
        let content = format!("{pages} pages, {megabytes:.1} MB");
        wrote_about(&path, &content, started.elapsed());
    }
    Ok(())
}
