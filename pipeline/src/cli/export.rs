//! `pipeline export`: writes the files of a built-in page into a folder, as a starting point.

use super::{OTHER_FOLDER, make_folder};
use crate::{collected, pages};
use clap::Args;
use files::exit::say;
use files::{Batch, Ledger, Report};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Arguments of `pipeline export`.
#[derive(Debug, Args)]
pub struct ExportArguments {
    /// The page, by name
    #[arg(value_name = "PAGE")]
    page: String,
    /// The folder for the files; created if it is missing [default: the name of the page]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print only errors
    #[arg(short, long)]
    quiet: bool,
    /// Fail if one of the files exists
    #[arg(long)]
    no_clobber: bool,
}

/// Writes the job, the scene, the specs and the textures of a page, in the folders that they have among the examples.
pub fn export(arguments: &ExportArguments) -> Result<(), Report> {
    // The error of an unknown name suggests a similar one.
    let job = pages::page(&arguments.page)?;
    let folder = arguments.output.clone().unwrap_or_else(|| PathBuf::from(&job.name));
    let files = collected::files(&pages::path(&job.name), &pages::FILES)?;
    let ledger = Ledger::new(!arguments.no_clobber);
    let mut outputs = Vec::with_capacity(files.len());
    for (path, bytes) in &files {
        let target = folder.join(below_examples(path));
        make_folder(target.parent().unwrap_or(&folder))?;
        let mut output = ledger.output(&target, OTHER_FOLDER)?;
        output.write_all(bytes).map_err(|source| output.failed(source))?;
        outputs.push(output);
    }
    let remark = Batch::commit(outputs)?;
    if !arguments.quiet {
        if let Some(remark) = remark {
            say(format_args!("pipeline: note: {remark}"));
        }
        for path in files.keys() {
            say(format_args!("wrote {}", folder.join(below_examples(path)).display()));
        }
        let own = folder.join(below_examples(&pages::path(&job.name)));
        say(format_args!("make its pictures: pipeline run {} -o out", own.display()));
    }
    Ok(())
}

/// Returns the path of a built-in file without the folder that all of them are in.
fn below_examples(path: &Path) -> &Path {
    path.strip_prefix("examples").unwrap_or(path)
}
