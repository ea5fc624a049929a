//! The edge of the four programs: what they read, what they write, how they fail.
//!
//! | module     | what                                                                     |
//! |------------|--------------------------------------------------------------------------|
//! | [`json`]   | JSON into typed values; every complaint has file, line, column and path  |
//! | [`input`]  | bytes from a file, from standard input, or from pages built in           |
//! | [`names`]  | JSON objects of names that a user chose, each once                       |
//! | [`output`] | a file that is replaced only when it is whole, or standard output        |
//! | [`progress`] | a bar on standard error, for work that takes longer than a second        |
//! | [`stop`]   | no temporary file stays when a program is interrupted                   |
//! | [`exit`]   | the exit codes, and the one place that prints an error                   |
//!
//! It knows nothing of curves, meshes or pictures, and the libraries above it never print.

pub mod exit;
pub mod input;
pub mod json;
pub mod names;
pub mod output;
pub mod progress;
pub mod stop;
mod words;

pub use exit::{Exit, Failure, Report};
pub use input::{Disk, Embedded, Source};
pub use json::JsonError;
pub use output::Output;

use std::io;
use thiserror::Error;

/// A file that could not be read or written.
#[derive(Debug, Error)]
pub enum FileError {
    /// The file, or standard input, could not be read.
    #[error("cannot read {name}: {source}")]
    Read {
        /// The file as the user named it, or `<stdin>`.
        name: String,
        /// What the system said.
        source: io::Error,
    },
    /// The file, or standard output, could not be written.
    #[error("cannot write {name}: {source}")]
    Write {
        /// The file as the user named it, or `<stdout>`.
        name: String,
        /// What the system said.
        source: io::Error,
    },
    /// The output exists and the user asked that nothing be replaced.
    #[error("{name} exists and --no-clobber was given: remove it or choose another name")]
    Exists {
        /// The file as the user named it.
        name: String,
    },
    /// The program that read our standard output has gone.
    #[error("the reader of standard output closed it")]
    ClosedPipe,
}

impl Failure for FileError {
    fn exit(&self) -> Exit {
        match self {
            Self::ClosedPipe => Exit::ClosedPipe,
            _ => Exit::ReadWrite,
        }
    }
}
