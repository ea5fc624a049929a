//! The grid file, `tb-grid` version 1: the data piped from `sweep` to `triangulate`.
//!
//! A file is one grid or several in sequence: the patches of an object, or several objects. A grid is a
//! header line of JSON, the rows in the order of `v`, and a footer that distinguishes a whole file from one
//! that was cut or damaged. The rows are binary (36 bytes a point), or JSON text for people and diffs; the
//! header has the same form in both. A strip of two rows and three columns, as text:
//!
//! ```json
//! {"format":"tb-grid","version":1,"encoding":"json","endian":"little","name":"strip","rows":2,"cols":3,"seam_u":"open","seam_v":"open","uv":{"across":"contour","repeat":[1.0,1.0]},"u":[0.0,0.5,1.0]}
//! [0.0,0,[[0.0,0.0,0.0],[1.0,0.0,0.0],[2.0,0.0,0.0]],[[0.0,0.0,1.0],[0.0,0.0,1.0],[0.0,0.0,1.0]]]
//! [1.0,0,[[0.0,1.0,0.0],[1.0,1.0,0.0],[2.0,1.0,0.0]],[[0.0,0.0,1.0],[0.0,0.0,1.0],[0.0,0.0,1.0]]]
//! {"rows":2,"crc32":1421911981}
//! ```
//!
//! A header may hold more keys than this one. A key with its default value is left out:
//!
//! | key         | default  | what                                                          |
//! |-------------|----------|---------------------------------------------------------------|
//! | `seam_v`    |          | `open`, `closed`, or `mirror`: the last row leads to the first, read in reverse |
//! | `patch`     | `[1, 1]` | number of this patch in its object, from 1, and how many there are; with it, a file cut between two patches is noticed |
//! | `texture`, `surface` | none | ids of the patch                                     |
//! | `areas`     | `[]`     | `{"area": A, "v": [from, to]}` each: an [`Area`](crate::grid::Area), and `v` at its ends |
//! | `fold`      | none     | `{"worst": x, "rows": n, "fits": f}`: a [`Fold`](crate::grid::Fold) |
//! | `tolerance` | none     | `{"asked": x, "reached": x, ...}`: a [`Tolerance`](crate::grid::Tolerance) |
//! | `lids`      | `[]`     | flat ends: a [`Lid`](crate::grid::Lid) each, of this patch and of patches before it |
//! | `pressed`   | `[false, false]` | whether the first and the last row are pressed to a line, where opposite columns meet |
//! | `unit`      | none     | unit of length: `um`, `mm`, `cm`, `in`, `ft` or `m`            |
//! | `shift`     | 0        | shift of the seam in columns; see [`Seam`](crate::grid::Seam) |
//!
//! A row is `[v, flags, positions, normals]`; each number is written with the fewest digits that read back to
//! the same bits. A binary row holds the same values in the same order, little-endian and without padding:
//!
//! | bytes       | what                                                            |
//! |-------------|-----------------------------------------------------------------|
//! | 8           | `v`, f64                                                        |
//! | 1           | flags, 0 in version 1; reserved for: 1 pole, 2 crease, 4 cap    |
//! | 24 x cols   | positions, x y z each f64                                       |
//! | 12 x cols   | normals, x y z each f32                                         |
//!
//! The binary footer is the number of rows (u64) and the CRC-32 (u32, the one of zip and PNG) of every byte
//! before the footer. As text the footer is the last line; its CRC-32 is that of all lines before it with
//! their newlines. After the footer comes the next grid, or the end of the file.
//!
//! [`GridReader`] holds one row at a time, so `triangulate` processes a grid of any length with a few rows in
//! memory. The reader checks everything it reads. A row is returned before its checksum is known. So results
//! made from the rows are valid only after [`GridReader::next_row`] has returned `None`, and all grids of the
//! file only after [`GridReader::next_patch`] has returned `false`.

mod binary;
mod buffer;
mod edges;
mod error;
mod header;
mod line;
mod patch;
mod reader;
mod stranger;
mod text;
mod writer;

pub use error::GridError;
pub use header::Header;
pub(crate) use header::MAX_COLS;
pub use line::schema;
pub use patch::Patch;
pub use reader::{GridReader, read, read_all};
pub use writer::Writer;

use crate::grid::GridMesh;
use std::io::{self, Write};

/// Encoding of the rows.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Encoding {
    /// Little-endian binary numbers: small and fast.
    Binary,
    /// One JSON array for each row, for people and diffs; reads back to the same bits.
    Json,
}

/// Writes a grid, as the only patch of its object.
///
/// `out` gets one write for each row and need not be buffered.
///
/// # Errors
/// When writing to `out` fails. A grid that no reader accepts (an array of the wrong length, a number that is
/// not finite, `u` or `v` out of order) is [`io::ErrorKind::InvalidInput`].
pub fn write(grid: &GridMesh, encoding: Encoding, out: &mut impl Write) -> io::Result<()> {
    write_all(std::slice::from_ref(grid), encoding, out)
}

/// Writes the patches of an object one after another.
///
/// # Errors
/// As [`write()`], and when there is no patch.
pub fn write_all(grids: &[GridMesh], encoding: Encoding, out: &mut impl Write) -> io::Result<()> {
    if grids.is_empty() {
        return Err(refused("found no patch, expected at least one"));
    }
    for (index, grid) in grids.iter().enumerate() {
        write_patch(grid, Patch { number: index + 1, of: grids.len() }, encoding, out)?;
    }
    Ok(())
}

fn write_patch(
    grid: &GridMesh,
    patch: Patch,
    encoding: Encoding,
    out: &mut impl Write,
) -> io::Result<()> {
    if let Some((number, key, message)) = grid.area_fault() {
        return Err(refused(&format!("areas[{number}].{key}: {message}")));
    }
    let points = grid.rows().saturating_mul(grid.cols());
    if grid.positions.len() != points || grid.normals.len() != points {
        return Err(refused(&format!(
            "found {} positions and {} normals, expected {points} of each",
            grid.positions.len(),
            grid.normals.len()
        )));
    }
    let mut writer = Writer::new(&Header { patch, ..Header::of(grid) }, encoding, out)?;
    for row in grid.row_views() {
        writer.row(&row)?;
    }
    writer.finish()
}

/// The data after the rows of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Footer {
    rows: u64,
    /// CRC-32 of every byte before the footer.
    crc32: u32,
}

fn refused(fault: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, format!("the grid cannot be written: {fault}"))
}

#[cfg(test)]
mod patches;
#[cfg(test)]
mod round_trip;
#[cfg(test)]
mod tests;
