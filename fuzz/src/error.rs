//! The error of the program.

use crate::seeds::SeedError;
use thiserror::Error;

/// A reason why the fuzzer could not work.
#[derive(Debug, Error)]
pub enum FuzzError {
    /// The seeds cannot be read.
    #[error(transparent)]
    Seed(#[from] SeedError),
    /// A pipe or process failed.
    #[error("a child process cannot be started, or its pipe failed: {0}")]
    Io(#[from] std::io::Error),
    /// A child ended before it tried anything.
    #[error("a child process {0}")]
    Worker(String),
    /// A line that is not part of the protocol.
    #[error("found {0:?} between parent and child, expected a request or an answer")]
    Protocol(String),
    /// A file cannot be read or written.
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: String,
        /// The error of the operating system.
        source: std::io::Error,
    },
}
