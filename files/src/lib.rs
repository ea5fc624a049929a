//! The edge of the four programs: their inputs, their outputs, and their failures.
//!
//! | module        | what                                                                  |
//! |---------------|-----------------------------------------------------------------------|
//! | [`json`]      | JSON into typed values; every complaint has file, line, column and path |
//! | [`input`]     | bytes from a file, from standard input, or from pages built in        |
//! | [`ledger`]    | what a program reads and will write: no output replaces an input      |
//! | [`names`]     | JSON objects of names that a user chose, each once                    |
//! | [`output`]    | a file that is replaced only when it is whole, or standard output     |
//! | [`batch`]     | files that belong together, and a marker while some are old           |
//! | [`extension`] | names of outputs that say what the file does not hold                 |
//! | [`progress`]  | a bar on standard error, for work that takes longer than a second     |
//! | [`stop`]      | no temporary file stays when a program is interrupted                 |
//! | [`exit`]      | the exit codes, and the one place that prints an error                |
//! | [`memory`]    | a budget of bytes, which are asked for before they are taken          |
//! | [`picture`]   | the bytes of a picture file into a picture, which never panics        |
//! | [`words`]     | what messages show of names and values                                |
//! | [`check`]     | what `--check` finds, and how much each finding weighs                |
//! | [`schema`]    | JSON Schema of the file formats                                       |
//! | [`svg`]       | drawings as SVG                                                       |
//!
//! The crate knows nothing of curves or meshes, and of pictures only how to decode them. The libraries
//! above this crate never print.

pub mod batch;
pub mod check;
pub mod exit;
pub mod extension;
mod identity;
pub mod input;
pub mod json;
pub mod ledger;
pub mod memory;
pub mod names;
pub mod output;
pub mod picture;
pub mod progress;
pub mod schema;
#[cfg(target_os = "linux")]
mod stdout;
pub mod stop;
pub mod svg;
mod target;
pub mod words;

pub use batch::Batch;
pub use exit::{Exit, Failure, Report};
pub use input::{Disk, Embedded, Source};
pub use json::JsonError;
pub use ledger::Ledger;
pub use memory::{Budget, MemoryError};
pub use output::Output;

use std::io;
use thiserror::Error;

/// A file that could not be read or written.
#[derive(Debug, Error)]
pub enum FileError {
    /// The file, or standard input, could not be read.
    #[error("cannot read {}: {source}", words::shown(name))]
    Read {
        /// The file as the user named it, or `<stdin>`.
        name: String,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The path leads to something else than a regular file.
    #[error(
        "cannot read {}: it is {found}, expected a regular file (only - may be a pipe)",
        words::shown(name)
    )]
    NotRegular {
        /// The file as the user named it.
        name: String,
        /// The kind of file, such as `a pipe`.
        found: &'static str,
    },
    /// The file takes more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The file, or standard output, could not be written.
    #[error("cannot write {}: {source}", words::shown(name))]
    Write {
        /// The file as the user named it, or `<stdout>`.
        name: String,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The output exists and the user asked that nothing be replaced.
    #[error(
        "{} exists and --no-clobber was given: remove it or choose another name",
        words::shown(name)
    )]
    Exists {
        /// The file as the user named it.
        name: String,
    },
    /// The file was named for two purposes, of which one would destroy the other.
    #[error(transparent)]
    Clash(#[from] ledger::Clash),
    /// The program that read our standard output has closed it.
    #[error("the reader of standard output closed it")]
    ClosedPipe,
}

impl Failure for FileError {
    fn exit(&self) -> Exit {
        match self {
            Self::Clash(error) => error.exit(),
            Self::ClosedPipe => Exit::ClosedPipe,
            Self::Memory(error) => error.exit(),
            _ => Exit::ReadWrite,
        }
    }
}
