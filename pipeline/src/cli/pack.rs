//! `pipeline pack`: collects all inputs of a job in a folder, for another machine.

use super::named;
use super::{OTHER_FOLDER, make_folder};
use crate::collected;
use clap::Args;
use files::exit::say;
use files::{Batch, Exit, Failure, Ledger, Report, input};
use std::io::Write;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Arguments of `pipeline pack`.
#[derive(Debug, Args)]
pub struct PackArguments {
    /// The job: a page by name, or a job file
    #[arg(value_name = "NAME|FILE.json")]
    job: String,
    /// The folder for the files; created if it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Print only errors
    #[arg(short, long)]
    quiet: bool,
    /// Fail if one of the files exists
    #[arg(long)]
    no_clobber: bool,
}

/// An input that a folder cannot hold.
#[derive(Debug, Error)]
enum PackError {
    /// A file of the job names another one by a path from the root.
    #[error(
        "{0} is named by a path from the root, which another machine does not have: name it relative to the file that \
         names it, and pack again"
    )]
    FromRoot(String),
}

impl Failure for PackError {
    fn exit(&self) -> Exit {
        Exit::Malformed
    }
}

/// Writes all files that the job reads, with the folders between them, and reads them again from there.
pub fn pack(arguments: &PackArguments) -> Result<(), Report> {
    let ledger = Ledger::new(!arguments.no_clobber);
    let jobs = named::jobs(std::slice::from_ref(&arguments.job), &[], &ledger)?;
    let Some(named) = jobs.into_iter().next() else { return Ok(()) };
    let files = collected::files(&named.path, named.source)?;
    let (folder, count) = (&arguments.output, files.len());
    let below = |path: &Path| folder.join(path);
    let placed = collected::placed(files.keys());
    let mut outputs = Vec::with_capacity(count);
    for (path, bytes) in placed.iter().zip(files.values()) {
        let target = below(path);
        make_folder(target.parent().unwrap_or(folder))?;
        let mut output = ledger.output(&target, OTHER_FOLDER)?;
        output.write_all(bytes).map_err(|source| output.failed(source))?;
        outputs.push(output);
    }
    Batch::commit(outputs)?;
    let job = input::normalized(&named.path);
    let job = files.keys().zip(&placed).find(|(path, _)| **path == job);
    let job = job.map_or_else(PathBuf::new, |(_, path)| below(path));
    if let Some(outside) = collected::outside(&job, folder)? {
        return Err(PackError::FromRoot(input::name_of(&outside)).into());
    }
    if !arguments.quiet {
        say(format_args!("wrote {count} files to {}", folder.display()));
        say(format_args!("make its pictures: pipeline run {} -o out", job.display()));
    }
    Ok(())
}
