//! The reasons why a mesh file cannot be read.

use crate::scene::obj::ObjError;
use crate::shape::mesh::MeshError;
use files::{Exit, Failure, FileError, MemoryError};
use thiserror::Error;

/// The reason why a mesh file of any format cannot be read.
#[derive(Debug, Error)]
pub enum MeshFileError {
    /// The file is an OBJ and not valid.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// A line of a text file is at fault.
    #[error("{file}:{line}: found {found}, expected {expected}")]
    Line {
        /// Name of the file.
        file: String,
        /// Number of the line, from 1.
        line: usize,
        /// The found text, in words.
        found: String,
        /// The expected text, in words.
        expected: String,
    },
    /// Bytes of a binary file are at fault.
    #[error("{file}: at byte {offset}: found {found}, expected {expected}")]
    Byte {
        /// Name of the file.
        file: String,
        /// Offset of the first of these bytes, from 0.
        offset: usize,
        /// The found value, in words.
        found: String,
        /// The expected value, in words.
        expected: String,
    },
    /// A part of a glTF file is at fault, or the file as a whole.
    #[error("{file}: found {found}, expected {expected}")]
    Part {
        /// Name of the file.
        file: String,
        /// The found value, with its JSON path.
        found: String,
        /// The expected value, in words.
        expected: String,
    },
    /// The file is valid, but its arrays are not a mesh.
    #[error("{file}: {source}")]
    Mesh {
        /// Name of the file.
        file: String,
        /// The fault of the arrays.
        source: MeshError,
    },
    /// A file that a glTF names cannot be read.
    #[error("{file}: {source}")]
    Beside {
        /// Name of the glTF file.
        file: String,
        /// The fault of the other file.
        source: FileError,
    },
    /// The mesh takes more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}

impl Failure for MeshFileError {
    fn exit(&self) -> Exit {
        match self {
            Self::Obj(error) => error.exit(),
            Self::Beside { source, .. } => source.exit(),
            Self::Memory(error) => error.exit(),
            Self::Line { .. } | Self::Byte { .. } | Self::Part { .. } | Self::Mesh { .. } => {
                Exit::Malformed
            }
        }
    }
}
