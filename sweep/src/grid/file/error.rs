//! Errors in a grid file.

use super::Patch;
use files::input::STDIN;
use files::{Exit, Failure, JsonError, MemoryError};
use std::io;
use thiserror::Error;

/// An error that prevented reading a grid. Messages count rows from 1.
#[derive(Debug, Error)]
pub enum GridError {
    /// The system could not read the file.
    #[error("cannot read {name}: {source}")]
    Read {
        /// The file as the user named it, or `<stdin>`.
        name: String,
        /// The error of the system.
        source: io::Error,
    },
    /// The rows need more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The file has no bytes.
    #[error("{name} is empty, expected a grid: {} wrote nothing", writer_of(name))]
    Empty {
        /// The file as the user named it.
        name: String,
    },
    /// The file is something other than a grid.
    #[error("{name} is not a grid: {found}")]
    NotAGrid {
        /// The file as the user named it.
        name: String,
        /// The kind of file that the bytes resemble, and the remedy.
        found: String,
    },
    /// The file ends inside the header line.
    #[error(
        "{name}: the header line is cut short: the program that wrote it stopped early after \
         {bytes} bytes"
    )]
    HeaderCut {
        /// The file as the user named it.
        name: String,
        /// Number of bytes read.
        bytes: usize,
    },
    /// A line is longer than any line of a grid.
    #[error("{name}: line {line} is longer than {limit} bytes, expected {expected}")]
    LongLine {
        /// The file as the user named it.
        name: String,
        /// The line, from 1.
        line: usize,
        /// The longest line that a grid of this size can have.
        limit: usize,
        /// The kind of line that was expected.
        expected: &'static str,
    },
    /// The grid has an unsupported version.
    #[error(
        "{name}: found a grid of version {found}, expected version {expected}: make the grid \
         again with the `sweep` of this program's release"
    )]
    Version {
        /// The file as the user named it.
        name: String,
        /// The version of the grid.
        found: u64,
        /// The supported version.
        expected: u64,
    },
    /// The header or a row of a text grid has a wrong value.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// The file ends inside a row, or before it.
    #[error("{name}: row {row} of {rows} is cut short: the program that wrote it stopped early")]
    RowCut {
        /// The file as the user named it.
        name: String,
        /// The row, from 1.
        row: usize,
        /// Number of rows according to the header.
        rows: usize,
    },
    /// A row holds a number that is not valid in a grid.
    #[error("{name}: row {row} of {rows}: {subject}: {message}")]
    Row {
        /// The file as the user named it.
        name: String,
        /// The row, from 1.
        row: usize,
        /// Number of rows according to the header.
        rows: usize,
        /// Name of the value, such as `v` or `the position of column 3`.
        subject: String,
        /// The found and the expected value, in words.
        message: String,
    },
    /// The file ends after the last row, before the end of the footer.
    #[error(
        "{name}: the row count and checksum after the last of {rows} rows are cut short: the \
         program that wrote it stopped early"
    )]
    FooterCut {
        /// The file as the user named it.
        name: String,
        /// Number of rows according to the header.
        rows: usize,
    },
    /// Header and footer have different numbers of rows.
    #[error(
        "{name}: found {found} rows in the closing count, expected the {expected} of the header: \
         the file was damaged after it was written"
    )]
    Count {
        /// The file as the user named it.
        name: String,
        /// Number of rows according to the footer.
        found: u64,
        /// Number of rows according to the header.
        expected: usize,
    },
    /// The checksum does not match the bytes.
    #[error(
        "{name}: found the checksum {found:08x}, expected {expected:08x} for these bytes: the \
         file was changed or damaged after it was written"
    )]
    Checksum {
        /// The file as the user named it.
        name: String,
        /// The CRC-32 in the footer.
        found: u32,
        /// The CRC-32 of the bytes before the footer.
        expected: u32,
    },
    /// Bytes follow the last footer.
    #[error("{name}: found bytes after the end of the grid, expected another grid or nothing")]
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
        /// The patch that should have followed.
        patch: Patch,
    },
    /// Patches do not follow in order.
    #[error("{name}: found {found}, expected {expected}: the patches are not in their order")]
    PatchOrder {
        /// The file as the user named it.
        name: String,
        /// The patch that was found.
        found: Patch,
        /// The patch that was expected.
        expected: Patch,
    },
    /// The file has several grids where one is expected.
    #[error("{name}: found several grids, expected one")]
    Several {
        /// The file as the user named it.
        name: String,
    },
}

/// Returns a description of the program that should have written the file.
fn writer_of(name: &str) -> &'static str {
    if name == STDIN { "the program before the pipe" } else { "the program that made it" }
}

impl Failure for GridError {
    fn exit(&self) -> Exit {
        match self {
            Self::Read { .. } => Exit::ReadWrite,
            Self::Memory(error) => error.exit(),
            Self::Empty { .. }
            | Self::NotAGrid { .. }
            | Self::HeaderCut { .. }
            | Self::LongLine { .. }
            | Self::Version { .. }
            | Self::Json(_)
            | Self::RowCut { .. }
            | Self::Row { .. }
            | Self::FooterCut { .. }
            | Self::Count { .. }
            | Self::Checksum { .. }
            | Self::Trailing { .. }
            | Self::PatchCut { .. }
            | Self::PatchOrder { .. }
            | Self::Several { .. } => Exit::Malformed,
        }
    }
}
