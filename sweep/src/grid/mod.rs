//! The contour x trajectory grid: what `sweep` makes and `triangulate` reads.

pub mod area;
pub mod file;
mod quality;
mod row;
mod seam;

pub use area::{Area, PlacedArea};
pub use quality::{Fold, Tolerance};
pub use row::Row;
pub use seam::Seam;

use glam::{DVec3, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A swept surface as a grid of points, row-major by station: an object, or a patch of one that is
/// several sweeps.
///
/// A *station* is one contour placed on the trajectory; it is a row. `u` runs along the contour
/// (columns), `v` along the trajectory (rows), both over `[0, 1]`.
///
/// ```text
///   v ^   row 2   o---o---o---o        position (row, col) = positions[row * cols + col]
///     |   row 1   o---o---o---o
///     |   row 0   o---o---o---o        seen from outside, u runs to the right and v up:
///     +-------> u    col 0 1 2 3       S_u x S_v points outward
/// ```
///
/// In a closed direction the first row or column is not repeated at the end: the cell after the
/// last one leads back to the first, over a seam that [`Seam`] describes. A *crease* (a corner of the contour) is a column given twice,
/// at the same positions with the same `u`, once with the normals of each side.
/// Where a contour meets the axis of a rotational sweep all rows share one position (a pole).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GridMesh {
    /// The object's name, from the spec; one word per OBJ object.
    pub name: String,
    /// Whether the contour leads back to its start; never mirrored.
    pub seam_u: Seam,
    /// Whether the trajectory leads back to its start.
    pub seam_v: Seam,
    /// Columns by which the contour comes back turned in itself, below `cols`; 0 where it does not
    /// come back.
    pub shift: usize,
    /// The texture id, where the patch has one of its own.
    pub texture: Option<u32>,
    /// The surface id, where the patch has one of its own.
    pub surface: Option<u32>,
    /// Parts with pictures of their own; later ones lie on earlier ones.
    pub areas: Vec<Area>,
    /// Where it folds back on itself, if that was looked for.
    pub fold: Option<Fold>,
    /// How near to the surface it is, if that was asked.
    pub tolerance: Option<Tolerance>,
    /// How a picture lies on the surface.
    pub uv: UvLayout,
    /// `u` of each column, not decreasing, from 0; up to 1 when open, below 1 when closed.
    pub u: Vec<f64>,
    /// `v` of each row, not decreasing, from 0; up to 1 when open, below 1 when closed.
    pub v: Vec<f64>,
    /// Points in the spec's unit, `rows * cols` of them.
    pub positions: Vec<DVec3>,
    /// Unit normals, outward for a counter-clockwise contour, one per position.
    pub normals: Vec<Vec3>,
}

/// How a picture lies on the surface: which grid direction runs across it, and how often it
/// repeats.
///
/// Across the contour, the picture's coordinates are `(s, t) = (u, v)`. Across the trajectory it is
/// turned a quarter, `(s, t) = (1 - v, u)`, so that it stands upright on a vessel; seen from
/// outside, neither is mirrored.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct UvLayout {
    /// The grid direction that runs across the picture.
    pub across: Across,
    /// How often the picture repeats, across and up; above 0.
    #[schemars(transform = crate::schema::range(crate::schema::REPEATS))]
    pub repeat: [f64; 2],
    /// What `u` and `v` of the grid count.
    #[serde(skip_serializing_if = "By::is_length")]
    pub by: By,
}

/// What `u` and `v` of a grid count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum By {
    /// Fractions of length: a picture lies evenly.
    #[default]
    Length,
    /// The curves' own parameters: each segment of a Bezier, and each piece between free points, has an
    /// equal share of the picture.
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
    /// Along the trajectory, against `v`.
    Trajectory,
}

impl Default for UvLayout {
    fn default() -> Self {
        Self { across: Across::Contour, repeat: [1.0, 1.0], by: By::Length }
    }
}

impl GridMesh {
    /// Number of stations.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.v.len()
    }

    /// Number of points on a station.
    #[must_use]
    pub fn cols(&self) -> usize {
        self.u.len()
    }
}
/// Bytes of the points and normals of a grid.
#[must_use]
pub fn bytes(rows: usize, cols: usize) -> u64 {
    const POINT: u64 = (size_of::<DVec3>() + size_of::<Vec3>()) as u64;
    (rows as u64).saturating_mul(cols as u64).saturating_mul(POINT)
}
