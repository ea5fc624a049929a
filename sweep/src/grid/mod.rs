//! The contour x trajectory grid, which `sweep` makes and `triangulate` reads.

pub mod area;
mod cells;
pub mod file;
mod lid;
pub mod near;
mod quality;
mod row;
mod seam;
mod unit;

pub use area::{Area, PlacedArea};
pub use cells::Cell;
pub use lid::{End, Lid};
pub use quality::{Fold, Tolerance};
pub use row::Row;
pub use seam::Seam;
pub use unit::Unit;

use glam::{DVec3, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Largest number of cells of one grid: 3.6 GB of points and normals, and twice as much if it is one cell wide.
pub const MOST_CELLS: usize = 100_000_000;

/// A swept surface as a grid of points, row-major by station: an object, or a patch of an object of several
/// sweeps.
///
/// A *station* is one contour placed on the trajectory, and is a row of the grid. `u` runs along the contour
/// (columns), `v` along the trajectory (rows), both over `[0, 1]`.
///
/// ```text
///   v ^   row 2   o---o---o---o        position (row, col) = positions[row * cols + col]
///     |   row 1   o---o---o---o
///     |   row 0   o---o---o---o        seen from outside, u runs to the right and v up:
///     +-------> u    col 0 1 2 3       S_u x S_v points outward
/// ```
///
/// In a closed direction the first row or column is not repeated at the end. The cell after the last row or
/// column leads back to the first, over a seam that [`Seam`] describes. A *crease* (a corner of the contour)
/// is two columns at the same positions with the same `u`, each with the normals of one side. Where a contour
/// meets the axis of a rotation, all rows share one position (a pole).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GridMesh {
    /// The object's name, from the spec; one word.
    pub name: String,
    /// How the last column leads back to the first; never mirrored.
    pub seam_u: Seam,
    /// How the last row leads back to the first.
    pub seam_v: Seam,
    /// Shift in columns between the last row and the first, below `cols`; see [`Seam`]. 0 if the trajectory
    /// is open.
    pub shift: usize,
    /// The texture id, if the patch has its own.
    pub texture: Option<u32>,
    /// The surface id, if the patch has its own.
    pub surface: Option<u32>,
    /// Areas with textures of their own; later areas cover earlier ones.
    pub areas: Vec<Area>,
    /// Flat ends, if the patch is the last of those that they close.
    pub lids: Vec<Lid>,
    /// True if the first, and if the last row is pressed to a line, where points in one place are one point.
    pub pressed: [bool; 2],
    /// Where the surface folds back on itself, if that was measured.
    pub fold: Option<Fold>,
    /// The requested and the measured distance from the surface, if requested.
    pub tolerance: Option<Tolerance>,
    /// The unit of length, if the spec states one.
    pub unit: Option<Unit>,
    /// How texture coordinates lie on the surface.
    pub uv: UvLayout,
    /// `u` of each column, not decreasing, from 0; up to 1 if open, below 1 if closed.
    pub u: Vec<f64>,
    /// `v` of each row, not decreasing, from 0; up to 1 if open, below 1 if closed.
    pub v: Vec<f64>,
    /// Points in the spec's unit, `rows * cols` of them, row by row.
    pub positions: Vec<DVec3>,
    /// Unit normals, outward for a counter-clockwise contour, one per position.
    pub normals: Vec<Vec3>,
}

/// How texture coordinates lie on the surface: the grid direction that runs across the picture, and the
/// repeats.
///
/// With `contour` across, the texture coordinates are `(s, t) = (u, v)`. With `trajectory` across, they are
/// turned a quarter, `(s, t) = (1 - v, u)`, so that a picture stands upright on a vessel. Seen from outside,
/// neither is mirrored.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct UvLayout {
    /// The grid direction that runs across the picture.
    pub across: Across,
    /// Repeats of the picture, across and up; above 0.
    #[schemars(transform = crate::limits::range(crate::limits::REPEATS))]
    pub repeat: [f64; 2],
    /// The quantity that `u` and `v` of the grid are proportional to.
    #[serde(skip_serializing_if = "By::is_length")]
    pub by: By,
}

/// A quantity that `u` and `v` of a grid can be proportional to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum By {
    /// Arc length, so that a picture lies evenly.
    #[default]
    Length,
    /// The curves' own parameters: each segment of a Bezier, and each piece between free points, has an equal
    /// share of the picture.
    Parameter,
}

impl By {
    fn is_length(&self) -> bool {
        *self == Self::Length
    }
}

/// A direction of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Across {
    /// Along the contour, `u`.
    Contour,
    /// Along the trajectory, against the direction of `v`.
    Trajectory,
}

impl Default for UvLayout {
    fn default() -> Self {
        Self { across: Across::Contour, repeat: [1.0, 1.0], by: By::Length }
    }
}

impl GridMesh {
    /// Returns the number of rows, which are stations.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.v.len()
    }

    /// Returns the number of columns, which are points of a station.
    #[must_use]
    pub fn cols(&self) -> usize {
        self.u.len()
    }
}
/// Returns the number of bytes of the points and normals of a grid.
#[must_use]
pub fn bytes(rows: usize, cols: usize) -> u64 {
    const POINT: u64 = (size_of::<DVec3>() + size_of::<Vec3>()) as u64;
    (rows as u64).saturating_mul(cols as u64).saturating_mul(POINT)
}
