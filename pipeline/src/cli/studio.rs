//! `pipeline studio`: serves the page on which curves are edited beside their picture.

use crate::pages;
use crate::studio::board::Board;
use crate::studio::folder::Folder;
use crate::studio::{routes, server, start, token};
use clap::Args;
use clap::builder::TypedValueParser;
use files::words::shown;
use files::{Exit, Failure, FileError, Ledger, Output, Report};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use thiserror::Error;

/// Arguments of `pipeline studio`.
#[derive(Debug, Args)]
pub struct StudioArguments {
    /// A job, scene or spec, whose name ends in .json, or a built-in page by name, of which a copy is
    /// opened. Without it the start page is shown
    #[arg(value_name = "FILE.json|NAME")]
    file: Option<String>,
    /// The port of the local address [default: any free port]
    #[arg(long, value_name = "P", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// The folder whose files may be read and written [default: the working folder, or that of a file
    /// elsewhere]
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Most memory to use, in bytes or with k, M or G [default: 90 % of the free memory]
    #[arg(long, value_name = "BYTES", value_parser = files::memory::bytes)]
    max_memory: Option<u64>,
    /// Worker threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024).map(usize::from))]
    threads: Option<usize>,
}

/// A file that the studio cannot open.
#[derive(Debug, Error)]
#[error("{0}")]
struct OpenError(String);

impl Failure for OpenError {
    fn exit(&self) -> Exit {
        Exit::Malformed
    }
}

/// Opens the file, prints the address of the page on standard output, and serves the page until the program is ended.
pub fn studio(arguments: &StudioArguments) -> Result<(), Report> {
    files::memory::allow(arguments.max_memory);
    let named = arguments.file.as_deref();
    let is_file = |name: &&str| Path::new(name).extension().is_some_and(|end| end == "json");
    let file = named.filter(is_file);
    let (folder, file) = place(arguments.folder.as_deref(), file.map(Path::new))?;
    let board = Arc::new(Board::new(folder));
    let file = match named.filter(|name| !is_file(name)) {
        Some(page) => Some(copy(&board.folder, page)?),
        None => file,
    };
    if let Some(file) = file {
        routes::open_file(&board, &file).map_err(OpenError)?;
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(arguments.threads.unwrap_or(0))
        .build()
        .map_err(|error| server::ServerError::System(error.to_string()))?;
    let token = match arguments.port {
        0 => token::drawn()?,
        _ => token::kept(&board.folder)?,
    };
    let announce = |address: &str| {
        Output::create(Path::new("-"), true)?.commit_all(format!("{address}\n").as_bytes())
    };
    server::serve(&board, &Arc::new(pool), arguments.port, &token, announce)
}

/// Returns the folder to open, and the path of the file in it.
fn place(folder: Option<&Path>, file: Option<&Path>) -> Result<(Folder, Option<String>), Report> {
    let working = Folder::open(folder.unwrap_or(Path::new(".")))?;
    let Some(file) = file else { return Ok((working, None)) };
    // The error of a missing file names it as the user did.
    Ledger::new(true).argument(file, "")?;
    let failed = |source| FileError::Read { name: file.display().to_string(), source };
    let whole = file.canonicalize().map_err(failed)?;
    let own = match folder {
        None if !whole.starts_with(working.root()) => {
            Folder::open(whole.parent().unwrap_or(Path::new("/")))?
        }
        _ => working,
    };
    match whole.strip_prefix(own.root()) {
        Ok(path) => {
            let path = path.display().to_string();
            Ok((own, Some(path)))
        }
        Err(_) => {
            let words =
                format!("{} is not in the folder of --folder", shown(&file.to_string_lossy()));
            Err(OpenError(words).into())
        }
    }
}

/// Returns the job of the copy of a page, which is made if there is none.
fn copy(folder: &Folder, page: &str) -> Result<String, Report> {
    let job = pages::page(page)?;
    let made = Path::new(&job.name).join("pages").join(format!("{}.json", job.name));
    if folder.stamp(&made).is_some() {
        return Ok(made.display().to_string());
    }
    let copied = start::copy(folder, page).map_err(OpenError);
    copied.map_err(|error| -> Report { error.into() })
}
