//! Why a grid does not become triangles.

use files::{Exit, Failure, FileError, MemoryError};
use glam::DVec3;
use std::io;
use sweep::grid::file::GridError;
use thiserror::Error;

/// A grid that could not be made into triangles, or triangles that could not be written.
#[derive(Debug, Error)]
pub enum TriangulateError {
    /// The grid file is cut, damaged or none.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A file could not be opened or replaced.
    #[error(transparent)]
    File(#[from] FileError),
    /// The mesh takes more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The mesh could not be written.
    #[error("cannot write the mesh: {0}")]
    Write(#[source] io::Error),
    /// The grid was to come through a pipe, and there is none.
    #[error(
        "found a terminal on standard input, expected a grid: name a grid file, or write \
         `sweep SPEC.json | triangulate`"
    )]
    Terminal,
    /// The grid is too long for the mesh's 32 bit numbering.
    #[error(
        "{object}: found {rows} x {cols} points, expected at most {limit}: a mesh numbers its vertices with \
         32 bits"
    )]
    TooMany {
        /// The object's name.
        object: String,
        /// Stations.
        rows: usize,
        /// Points on a station.
        cols: usize,
        /// The most that can be numbered.
        limit: u64,
    },
    /// Too few points for a surface.
    #[error("{object}: found {rows} rows of {cols} columns, expected at least 2 of each")]
    TooFew {
        /// The object's name.
        object: String,
        /// Stations.
        rows: usize,
        /// Points on a station.
        cols: usize,
    },
    /// A grid in memory that leads back to its start as none can.
    #[error("{object}: {fault}")]
    Seam {
        /// The object's name.
        object: String,
        /// What was found and what was expected.
        fault: String,
    },
    /// A grid in memory with an area that is not on it.
    #[error("{object}: {fault}")]
    Area {
        /// The object's name.
        object: String,
        /// The place, what was found and what was expected.
        fault: String,
    },
    /// A number that a mesh of f32 does not hold.
    #[error(
        "{object}: row {row}, column {col}: found the {what} ({:?}, {:?}, {:?}), expected numbers within 3.4e38, \
         which is what an OBJ holds", found.x, found.y, found.z
    )]
    Number {
        /// The object's name.
        object: String,
        /// The row, from 1.
        row: usize,
        /// The column, from 1.
        col: usize,
        /// Position or normal.
        what: &'static str,
        /// Its value.
        found: DVec3,
    },
    /// The picture repeats more often than f32 can count.
    #[error("{object}: found a picture that repeats {found:?} times, expected at most 1e30 times")]
    Repeat {
        /// The object's name.
        object: String,
        /// The larger of the two numbers.
        found: f64,
    },
    /// A grid in memory whose arrays do not fit each other.
    #[error(
        "{object}: found a grid with {positions} positions and {normals} normals, expected {expected} of each"
    )]
    Arrays {
        /// The object's name.
        object: String,
        /// Length of the positions.
        positions: usize,
        /// Length of the normals.
        normals: usize,
        /// Rows times columns.
        expected: usize,
    },
    /// Rows that do not fit the header.
    #[error(
        "{object}: found row {row} with {cols} points, expected {rows} rows of {expected} points"
    )]
    Rows {
        /// The object's name.
        object: String,
        /// The row, from 1.
        row: usize,
        /// Points on it.
        cols: usize,
        /// Rows according to the header.
        rows: usize,
        /// Points on a station according to the header.
        expected: usize,
    },
}

impl Failure for TriangulateError {
    fn exit(&self) -> Exit {
        match self {
            Self::Grid(error) => error.exit(),
            Self::File(error) => error.exit(),
            Self::Memory(error) => error.exit(),
            Self::Write(error) if error.kind() == io::ErrorKind::BrokenPipe => Exit::ClosedPipe,
            Self::Write(_) => Exit::ReadWrite,
            Self::Terminal => Exit::Use,
            Self::TooMany { .. } => Exit::Resource,
            Self::TooFew { .. }
            | Self::Seam { .. }
            | Self::Area { .. }
            | Self::Number { .. }
            | Self::Repeat { .. }
            | Self::Arrays { .. }
            | Self::Rows { .. } => Exit::Malformed,
        }
    }
}
