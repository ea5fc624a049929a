//! The error of this crate.

use files::{Exit, Failure, JsonError, MemoryError};
use thiserror::Error;

/// The reason for which a spec or a requested resolution is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SweepError {
    /// The text is not JSON, is not a spec, or has a value out of its range.
    #[error(transparent)]
    Malformed(#[from] JsonError),
    /// The spec is well formed, but no surface has its values.
    #[error("{0}")]
    Geometry(JsonError),
    /// A file that the spec names cannot be read. The exit code is that of the reason.
    #[error("{0}")]
    Named(JsonError, Exit),
    /// A file that the spec names is larger than the reader accepts.
    #[error("{0}")]
    TooLarge(JsonError),
    /// The resolution that replaces that of the spec is refused.
    #[error("{0}")]
    Resolution(String),
    /// A point of the surface is not finite.
    #[error("{0}: a point of the surface is not finite: its sizes differ too much for each other")]
    NotFinite(String),
    /// The outlines of an end cross each other with the columns that the grid has.
    #[error(
        "{0}: the outlines of an end cross each other, with the number of columns that they have; more cols, or a smaller \
         tol, keep them apart"
    )]
    Lids(String),
    /// The grid needs more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}

impl Failure for SweepError {
    fn exit(&self) -> Exit {
        match self {
            Self::Malformed(_) => Exit::Malformed,
            Self::Geometry(_) => Exit::Geometry,
            Self::Resolution(_) => Exit::Use,
            Self::NotFinite(_) | Self::Lids(_) => Exit::Geometry,
            Self::Named(_, exit) => *exit,
            Self::Memory(_) | Self::TooLarge(_) => Exit::Resource,
        }
    }
}
