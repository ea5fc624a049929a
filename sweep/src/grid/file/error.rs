//! What can be wrong with a grid file.

use super::Patch;
use files::input::STDIN;
use files::{Exit, Failure, JsonError, MemoryError};
use std::io;
use thiserror::Error;

/// A grid that could not be read. Rows are counted from 1 in messages.
#[derive(Debug, Error)]
pub enum GridError {
    /// The system did not give the bytes.
    #[error("cannot read {name}: {source}")]
    Read {
        /// The file as the user named it, or `<stdin>`.
        name: String,
        /// What the system said.
        source: io::Error,
    },
    /// The rows take more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// There is not one byte.
    #[error("{name} is empty, expected a grid: {} wrote nothing", writer_of(name))]
    Empty {
        /// The file as the user named it.
        name: String,
    },
    /// The first bytes are those of something else.
    #[error("{name} is not a grid: {found}")]
    NotAGrid {
        /// The file as the user named it.
        name: String,
        /// What it looks like, and what to do with it.
        found: String,
    },
    /// The header line has no end.
    #[error(
        "{name}: the header line is cut short: the program that wrote it stopped early after \
         {bytes} bytes"
    )]
    HeaderCut {
        /// The file as the user named it.
        name: String,
        /// Bytes that are there.
        bytes: usize,
    },
    /// A line goes on and on.
    #[error("{name}: line {line} is longer than {limit} bytes, expected {expected}")]
    LongLine {
        /// The file as the user named it.
        name: String,
        /// The line, from 1.
        line: usize,
        /// The longest line a grid of this size can have.
        limit: usize,
        /// What the line should have been.
        expected: &'static str,
    },
    /// A grid of another time.
    #[error(
        "{name}: found a grid of version {found}, expected version {expected}: make it anew with \
         the `sweep` that came with this program"
    )]
    Version {
        /// The file as the user named it.
        name: String,
        /// Its version.
        found: u64,
        /// Ours.
        expected: u64,
    },
    /// A wrong value in the header or in a row of a text grid.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// The file ends inside a row, or before it.
    #[error("{name}: row {row} of {rows} is cut short: the program that wrote it stopped early")]
    RowCut {
        /// The file as the user named it.
        name: String,
        /// The row, from 1.
        row: usize,
        /// Rows according to the header.
        rows: usize,
    },
    /// A row holds a number that no grid holds.
    #[error("{name}: row {row} of {rows}: {place}: {message}")]
    Row {
        /// The file as the user named it.
        name: String,
        /// The row, from 1.
        row: usize,
        /// Rows according to the header.
        rows: usize,
        /// The value, as `v` or `the position of column 3`.
        place: String,
        /// What was found and what was expected.
        message: String,
    },
    /// The file ends after the last row.
    #[error(
        "{name}: the row count and checksum behind the last of {rows} rows are cut short: the \
         program that wrote it stopped early"
    )]
    FooterCut {
        /// The file as the user named it.
        name: String,
        /// Rows according to the header.
        rows: usize,
    },
    /// Header and footer disagree.
    #[error(
        "{name}: found {found} rows in the closing count, expected the {expected} of the header: \
         the file was damaged on its way"
    )]
    Count {
        /// The file as the user named it.
        name: String,
        /// Rows according to the footer.
        found: u64,
        /// Rows according to the header.
        expected: usize,
    },
    /// The checksum does not fit the bytes.
    #[error(
        "{name}: found the checksum {found:08x}, expected {expected:08x} for these bytes: the \
         file was changed or damaged after it was written"
    )]
    Checksum {
        /// The file as the user named it.
        name: String,
        /// The CRC-32 in the footer.
        found: u32,
        /// The CRC-32 of the bytes before it.
        expected: u32,
    },
    /// Something stands behind the last footer.
    #[error("{name}: found bytes behind the end of the grid, expected another grid or nothing")]
    Trailing {
        /// The file as the user named it.
        name: String,
    },
    /// The file ends between two patches.
    #[error(
        "{name}: {patch} is missing, the grid is cut short: the program that wrote it stopped early"
    )]
    PatchCut {
        /// The file as the user named it.
        name: String,
        /// The one that should have followed.
        patch: Patch,
    },
    /// Patches that do not follow each other.
    #[error("{name}: found {found}, expected {expected}: the file was put together wrongly")]
    PatchOrder {
        /// The file as the user named it.
        name: String,
        /// The one that is there.
        found: Patch,
        /// The one that should be.
        expected: Patch,
    },
    /// Several grids where one is wanted.
    #[error("{name}: found several grids, expected one")]
    Several {
        /// The file as the user named it.
        name: String,
    },
}

/// Who should have written the file.
fn writer_of(name: &str) -> &'static str {
    if name == STDIN { "the program before the pipe" } else { "the program that made it" }
}

impl Failure for GridError {
    fn exit(&self) -> Exit {
        match self {
            Self::Read { .. } => Exit::ReadWrite,
            Self::Memory(error) => error.exit(),
            _ => Exit::Malformed,
        }
    }
}
