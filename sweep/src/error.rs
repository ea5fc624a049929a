//! Why a sweep cannot be made.

use files::{Exit, Failure, JsonError, MemoryError};
use thiserror::Error;

/// What is wrong with a spec or with the resolution asked for.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SweepError {
    /// The spec is not JSON, not a spec, or holds a value that means nothing.
    #[error(transparent)]
    Malformed(#[from] JsonError),
    /// The spec is well formed, but its surface does not exist.
    #[error("{0}")]
    Geometry(JsonError),
    /// A file that the spec names cannot be read, with the exit code of the reason.
    #[error("{0}")]
    Named(JsonError, Exit),
    /// A file that the spec names holds more than is taken.
    #[error("{0}")]
    TooLarge(JsonError),
    /// The rows or columns asked for beside the spec cannot be made.
    #[error("{0}")]
    Resolution(String),
    /// The grid takes more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}

impl Failure for SweepError {
    fn exit(&self) -> Exit {
        match self {
            Self::Malformed(_) => Exit::Malformed,
            Self::Geometry(_) => Exit::Geometry,
            Self::Resolution(_) => Exit::Use,
            Self::Named(_, exit) => *exit,
            Self::Memory(_) | Self::TooLarge(_) => Exit::Resource,
        }
    }
}
