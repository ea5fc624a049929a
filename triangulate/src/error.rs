//! Reasons why a grid cannot be turned into triangles.

use files::words::shown;
use files::{Exit, Failure, FileError, MemoryError};
use glam::DVec3;
use std::io;
use sweep::grid::file::GridError;
use thiserror::Error;

/// A grid that could not be turned into triangles, or triangles that could not be written.
#[derive(Debug, Error)]
pub enum TriangulateError {
    /// The grid file is cut short, damaged, or not a grid file.
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
    /// The grid was expected on standard input, but standard input is a terminal.
    #[error(
        "found a terminal on standard input, expected a grid: name a grid file, or write \
         `sweep SPEC.json | triangulate`"
    )]
    Terminal,
    /// The grid has more points than the mesh can number with 32 bits.
    #[error(
        "{}: found {rows} x {cols} points, expected at most {limit}: a mesh numbers its vertices with \
         32 bits",
        shown(object)
    )]
    TooMany {
        /// The object's name.
        object: String,
        /// Number of stations.
        rows: usize,
        /// Number of points on a station.
        cols: usize,
        /// The largest number of points that can be numbered.
        limit: u64,
    },
    /// The grid has too few points for a surface.
    #[error("{}: found {rows} rows of {cols} columns, expected at least 2 of each", shown(object))]
    TooFew {
        /// The object's name.
        object: String,
        /// Number of stations.
        rows: usize,
        /// Number of points on a station.
        cols: usize,
    },
    /// A grid in memory with a seam or a shift that no surface has.
    #[error("{}: {fault}", shown(object))]
    Seam {
        /// The object's name.
        object: String,
        /// The found and the expected value, in words.
        fault: String,
    },
    /// A grid in memory with an area that does not lie on it.
    #[error("{}: {fault}", shown(object))]
    Area {
        /// The object's name.
        object: String,
        /// The key of the area, the found and the expected value.
        fault: String,
    },
    /// A lid whose corners are not the columns of its patches.
    #[error("{}: {fault}", shown(object))]
    Lid {
        /// The object's name.
        object: String,
        /// The found and the expected numbers.
        fault: String,
    },
    /// A number that does not fit in f32, the number type of a mesh.
    #[error(
        "{}: row {row}, column {col}: found the {what} ({:?}, {:?}, {:?}), expected numbers within 3.4e38, \
         which is what an OBJ holds", shown(object), found.x, found.y, found.z
    )]
    Number {
        /// The object's name.
        object: String,
        /// The row, from 1.
        row: usize,
        /// The column, from 1.
        col: usize,
        /// `position` or `normal`.
        what: &'static str,
        /// Its three coordinates.
        found: DVec3,
    },
    /// The picture repeats more than 1e30 times, far below the end of f32.
    #[error(
        "{}: found a picture that repeats {found:?} times, expected at most 1e30 times",
        shown(object)
    )]
    Repeat {
        /// The object's name.
        object: String,
        /// The larger of the two repeat counts, across and up.
        found: f64,
    },
    /// A grid in memory whose arrays do not fit each other.
    #[error(
        "{}: found a grid with {positions} positions and {normals} normals, expected {expected} of each",
        shown(object)
    )]
    Arrays {
        /// The object's name.
        object: String,
        /// Number of positions.
        positions: usize,
        /// Number of normals.
        normals: usize,
        /// Rows times columns.
        expected: usize,
    },
    /// Rows that do not match the header.
    #[error(
        "{}: found row {row} with {cols} points, expected {rows} rows of {expected} points",
        shown(object)
    )]
    Rows {
        /// The object's name.
        object: String,
        /// The row, from 1.
        row: usize,
        /// Number of points on the row.
        cols: usize,
        /// Number of rows according to the header.
        rows: usize,
        /// Number of points on a row according to the header.
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
            | Self::Lid { .. }
            | Self::Number { .. }
            | Self::Repeat { .. }
            | Self::Arrays { .. }
            | Self::Rows { .. } => Exit::Malformed,
        }
    }
}
