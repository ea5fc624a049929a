//! How finely a surface is cut, as it is written.
//!
//! `mesh` either counts cells, `{"rows": R, "cols": C}`, or asks for what they have to keep; then as
//! few cells as will do are placed where the surface bends:
//!
//! | key         | meaning                                                                        |
//! |-------------|--------------------------------------------------------------------------------|
//! | `tol`       | the largest distance between the triangles and the surface, in the unit of length |
//! | `angle_deg` | the largest angle between a triangle and the true normals at its corners, below 90 |
//! | `pixels`    | in place of `tol`: the largest distance in pixels of the picture of a `camera`  |
//! | `camera`    | `eye`, `target`, `up` (y) and `fov_deg` as in a scene, and `size`, the picture's pixels across and down |
//! | `max_quads` | cells at most, 2,000,000 if not given                                          |
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "knob",
//!   "contour": { "circle": 0.5 },
//!   "trajectory": { "line": [[0, 0, 0], [0, 1, 0]] },
//!   "scale": { "keys": [[0, 0.4], [0.6, 1], [1, 0.7]], "ease": "smooth" },
//!   "mesh": { "pixels": 0.25, "angle_deg": 8, "max_quads": 50000,
//!             "camera": { "eye": [0, 1, 4], "target": [0, 0.5, 0], "fov_deg": 40, "size": [512, 512] } }
//! }
//! ```
//!
//! `tol`, `angle_deg` or `pixels` must be there; `angle_deg` goes with each of the others. It bounds how a surface
//! of flat triangles looks; where normals are interpolated a distance is mostly enough. A triangle
//! that leaves the picture or lies behind the camera may be off by 16 times as many pixels: mirrors
//! and shadows show it still. Without a `camera`, `pipeline run` takes that of the scene;
//! `sweep` by itself refuses `pixels` then. Distances are measured in the middle of each cell, of its
//! sides and of its triangles, and hold there. When `max_quads` or the surface (a cusp, a fold) do not
//! let the tolerance be kept, the closest is made and a note says how close that is.

use crate::{MOST_CELLS, schema};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cells at most where a spec does not say.
pub const MAX_QUADS: usize = 2_000_000;

/// How finely a surface is cut.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys rows and cols, or with any of tol, angle_deg, pixels"
)]
#[schemars(transform = schema::cells_or_tolerance)]
pub struct Mesh {
    /// Cells along the trajectory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::range(1..=MOST_CELLS))]
    pub rows: Option<usize>,
    /// Cells along the contour; the cells without width at creases come on top.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::range(1..=MOST_CELLS))]
    pub cols: Option<usize>,
    /// The largest distance between triangles and surface, in the unit of length; above 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::below(1e60))]
    pub tol: Option<f64>,
    /// The largest angle between triangles and surface, in degrees above 0 and below 90.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::below(90.0))]
    pub angle_deg: Option<f64>,
    /// The largest distance in pixels of the camera's picture; above 0. Not beside `tol`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::below(1e6))]
    pub pixels: Option<f64>,
    /// Whose pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// Cells at most; 2,000,000 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::range(1..=MOST_CELLS))]
    pub max_quads: Option<usize>,
}

/// A camera and the size of its picture.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys eye, target, fov_deg, size, and up if it is not y"
)]
pub struct Camera {
    /// Where it stands.
    pub eye: [f64; 3],
    /// What it looks at.
    pub target: [f64; 3],
    /// What is up in the picture, as near as it can be.
    #[serde(default = "super::up")]
    pub up: [f64; 3],
    /// The angle between the lower and the upper edge of the picture, in degrees above 0 and below 180.
    #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 180.0))]
    pub fov_deg: f64,
    /// Pixels across and down.
    #[schemars(transform = schema::range(1..=u32::MAX))]
    pub size: [u32; 2],
}

impl Mesh {
    /// This with every key of another in its place; rows and columns, and a tolerance, each take the
    /// place of the other. A camera is taken only where pixels are asked for and there is none.
    #[must_use]
    pub fn or_rather(&self, other: &Self) -> Self {
        let counted = other.rows.is_some() || other.cols.is_some();
        let near = other.tol.is_some() || other.pixels.is_some();
        let tolerance = near || other.angle_deg.is_some();
        let old = |kept: bool| if kept { self.clone() } else { Self::default() };
        let (cells, bounds) = (old(!tolerance), old(!counted));
        let distance = old(!counted && !near);
        let pixels = other.pixels.or(distance.pixels);
        let camera = match pixels {
            Some(_) => bounds.camera.or(other.camera),
            None if other.tol.is_some() => None,
            None => bounds.camera,
        };
        Self {
            rows: other.rows.or(cells.rows),
            cols: other.cols.or(cells.cols),
            tol: other.tol.or(distance.tol),
            angle_deg: other.angle_deg.or(bounds.angle_deg),
            pixels,
            camera,
            max_quads: other.max_quads.or(bounds.max_quads),
        }
    }
}
