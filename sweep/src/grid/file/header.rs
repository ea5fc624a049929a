//! The header line: everything about a grid but its rows.

use super::Encoding;
use crate::grid::row::{Fault, check_parameter};
use crate::{GridMesh, grid::Seam, grid::UvLayout};
use serde::{Deserialize, Serialize};
use std::io;

/// The `format` of the header line.
pub(super) const FORMAT: &str = "tb-grid";
/// The `version` of the header line.
pub(super) const VERSION: u32 = 1;
/// The longest station: it bounds the memory that a reader gives a file it cannot trust yet.
/// A row of this length is 36 MiB; the finest pictures need a thousandth of it.
pub(super) const MAX_COLS: usize = 1 << 20;
/// Rows are counted with 32 bits, as in the OBJ that is made of them.
const MAX_ROWS: usize = u32::MAX as usize;

/// Everything about a grid but its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// The object's name.
    pub name: String,
    /// Number of stations.
    pub rows: usize,
    /// Whether the contour leads back to its start.
    pub seam_u: Seam,
    /// Whether the trajectory leads back to its start.
    pub seam_v: Seam,
    /// How a picture lies on the surface.
    pub uv: UvLayout,
    /// `u` of each column.
    pub u: Vec<f64>,
}

/// The header as its line has it.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Line {
    format: String,
    version: u32,
    pub encoding: Encoding,
    endian: Endian,
    name: String,
    rows: usize,
    cols: usize,
    seam_u: Seam,
    seam_v: Seam,
    uv: UvLayout,
    u: Vec<f64>,
}

/// The byte order of binary rows. There is one, and the file says so.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Endian {
    Little,
}

impl Header {
    /// The header of a grid in memory.
    #[must_use]
    pub fn of(grid: &GridMesh) -> Self {
        Self {
            name: grid.name.clone(),
            rows: grid.rows(),
            seam_u: grid.seam_u,
            seam_v: grid.seam_v,
            uv: grid.uv,
            u: grid.u.clone(),
        }
    }

    /// Number of points on a station.
    #[must_use]
    pub fn cols(&self) -> usize {
        self.u.len()
    }

    /// The header line with its newline.
    pub(super) fn line(&self, encoding: Encoding) -> io::Result<Vec<u8>> {
        let line = Line {
            format: FORMAT.into(),
            version: VERSION,
            encoding,
            endian: Endian::Little,
            name: self.name.clone(),
            rows: self.rows,
            cols: self.cols(),
            seam_u: self.seam_u,
            seam_v: self.seam_v,
            uv: self.uv,
            u: self.u.clone(),
        };
        let mut bytes = serde_json::to_vec(&line)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    /// Checks what the types do not say.
    pub(super) fn check(&self) -> Result<(), Fault> {
        for (place, count, seam, limit) in [
            ("rows", self.rows, self.seam_v, MAX_ROWS),
            ("cols", self.cols(), self.seam_u, MAX_COLS),
        ] {
            let least = if seam == Seam::Closed { 3 } else { 2 };
            if !(least..=limit).contains(&count) {
                let message = format!("found {count}, expected from {least} to {limit}");
                return Err(Fault {
                    place: place.into(),
                    message,
                });
            }
        }
        for (i, found) in self.uv.repeat.iter().enumerate() {
            if !(found.is_finite() && *found > 0.0) {
                let message = format!("found {found}, expected a positive number");
                return Err(Fault {
                    place: format!("uv.repeat[{i}]"),
                    message,
                });
            }
        }
        let mut before = None;
        for (i, &found) in self.u.iter().enumerate() {
            check_parameter(found, before, self.seam_u).map_err(|message| Fault {
                place: format!("u[{i}]"),
                message,
            })?;
            before = Some(found);
        }
        Ok(())
    }
}
