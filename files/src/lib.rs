//! The edge of the four programs: their inputs, their outputs, and their failures.
//!
//! | module        | what                                                                  |
//! |---------------|-----------------------------------------------------------------------|
//! | [`json`]      | JSON into typed values; every complaint has file, line, column and path |
//! | [`input`]     | bytes from a file, from standard input, or from pages built in        |
//! | [`ledger`]    | inputs and outputs of a program: no output replaces an input          |
//! | [`names`]     | JSON objects of names that a user chose, each once                    |
//! | [`note`]      | the key for sentences that the readers ignore                         |
//! | [`arguments`] | arguments that all programs have: memory, threads, progress           |
//! | [`place`]     | places in JSON: steps that move, turn and stretch                     |
//! | [`output`]    | a file that is replaced only when it is whole, or standard output     |
//! | [`batch`]     | files that belong together, and a marker while some are old           |
//! | [`extension`] | names of outputs that contradict the content of the file              |
//! | [`progress`]  | a bar or lines on standard error, for work that takes longer than a second |
//! | [`shell`]     | completions for shells, and pages for `man`                           |
//! | [`stop`]      | no temporary file stays when a program is interrupted                 |
//! | [`exit`]      | the exit codes, and the only function that prints an error            |
//! | [`memory`]    | a budget of bytes, which are reserved before they are allocated       |
//! | [`picture`]   | the bytes of a picture file into a picture, without a panic           |
//! | [`words`]     | names and values in messages: cut, and without invisible characters   |
//! | [`setting`]   | values of a JSON file that the command line sets                      |
//! | [`variants`]  | rows of a table, each with values that the command line would set    |
//! | [`check`]     | the findings of `--check`, and the weight of each                     |
//! | [`schema`]    | JSON Schema of the file formats                                       |
//! | [`svg`]       | drawings as SVG                                                       |
//!
//! The crate contains no curves and no meshes, and of pictures only their decoding. The libraries
//! above this crate never print.
//!
//! A complaint about a value in a JSON text has its position:
//!
//! ```
//! use files::json::Document;
//!
//! let document = Document::new("ball.json", b"{ \"radius\": -2 }")?;
//! let fault = document.fault("radius", "found -2, expected a number above 0");
//! assert_eq!(fault.to_string(), "ball.json:1:13: radius: found -2, expected a number above 0");
//! # Ok::<(), files::JsonError>(())
//! ```

pub mod arguments;
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
pub mod note;
pub mod output;
pub mod picture;
pub mod place;
pub mod progress;
pub mod schema;
pub mod setting;
pub mod shell;
#[cfg(target_os = "linux")]
mod stdout;
pub mod stop;
pub mod svg;
mod target;
pub mod variants;
pub mod watch;
pub mod words;

pub use arguments::{CommonArguments, ThreadsError};
pub use batch::Batch;
pub use exit::{Exit, Failure, Report};
pub use input::{Disk, Embedded, Source};
pub use json::JsonError;
pub use ledger::Ledger;
pub use memory::{Budget, MemoryError};
pub use output::Output;
pub use place::Place;
pub use setting::Setting;
pub use variants::Variant;

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
    /// The path leads to a file that is not a regular one.
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
    #[error("cannot write {}: {source}{}", words::shown(name), remedy(source))]
    Write {
        /// The file as the user named it, or `<stdout>`.
        name: String,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The output exists, and the user forbade replacements.
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
    /// The command line sets a value that the file has no place for.
    #[error(transparent)]
    Setting(#[from] setting::SettingError),
    /// The program that read our standard output has closed it.
    #[error("the reader of standard output closed it")]
    ClosedPipe,
}

/// Returns what to do about a file that cannot be written, if it is known.
fn remedy(error: &io::Error) -> &'static str {
    if error.kind() == io::ErrorKind::NotFound { ": make its folder first" } else { "" }
}

impl Failure for FileError {
    fn exit(&self) -> Exit {
        match self {
            Self::Clash(error) => error.exit(),
            Self::ClosedPipe => Exit::ClosedPipe,
            Self::Memory(error) => error.exit(),
            Self::Setting(error) => error.exit(),
            _ => Exit::ReadWrite,
        }
    }
}
