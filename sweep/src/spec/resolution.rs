//! The resolution of a surface, as it is written.
//!
//! `mesh` either counts cells, `{"rows": R, "cols": C}`, or gives bounds that the cells must keep. With
//! bounds, as few cells as possible are placed, more where the surface bends:
//!
//! | key         | meaning                                                                        |
//! |-------------|--------------------------------------------------------------------------------|
//! | `tol`       | the largest distance between the triangles and the surface, in the unit of length |
//! | `angle_deg` | the largest angle between a triangle and the true normals at its corners, below 90 |
//! | `pixels`    | instead of `tol`: the largest distance in pixels of the picture of a `camera`   |
//! | `camera`    | `eye`, `target`, `up` (y) and `fov_deg` as in a scene, and `size`, the picture's width and height in pixels |
//! | `max_quads` | the largest number of cells, 2,000,000 if not given                            |
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
//! At least one of `tol`, `angle_deg` and `pixels` must be given; `angle_deg` can be combined with either of
//! the others. `angle_deg` bounds how a surface of flat triangles looks. Where normals are interpolated, a
//! distance is mostly enough. A triangle outside the picture or behind the camera may be off by 16 times as
//! many pixels, because mirrors and shadows still show it. Without a `camera`, `pipeline run` takes that of
//! the scene; `sweep` by itself refuses `pixels` without a `camera`. Distances are measured at the middle of
//! each cell, of its sides and of its triangles, and hold there. If `max_quads` or the surface (a cusp, a
//! fold) does not allow the tolerance, the closest mesh found is made, and a note says how close it is.

use crate::grid::MOST_CELLS;
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The largest number of cells if a spec gives none.
pub const MAX_QUADS: usize = 2_000_000;

/// Resolution of a surface: counts of cells, or a tolerance.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys rows and cols, or with any of tol, angle_deg, pixels"
)]
#[schemars(rename = "Mesh", transform = limits::cells_or_tolerance)]
pub struct Resolution {
    /// Number of cells along the trajectory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::range(1..=MOST_CELLS))]
    pub rows: Option<usize>,
    /// Number of cells along the contour. Cells without width at creases are not counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::range(1..=MOST_CELLS))]
    pub cols: Option<usize>,
    /// Largest distance between triangles and surface, in the unit of length; above 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::below(1e60))]
    pub tol: Option<f64>,
    /// Largest angle between a triangle and the true normals at its corners, in degrees above 0 and below 90.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::below(90.0))]
    pub angle_deg: Option<f64>,
    /// Largest distance between triangles and surface, in pixels of the camera's picture; above 0. Not
    /// allowed with `tol`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::below(1e6))]
    pub pixels: Option<f64>,
    /// The camera whose pixels `pixels` counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// Largest number of cells; 2,000,000 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::range(1..=MOST_CELLS))]
    pub max_quads: Option<usize>,
}

/// A camera and the size of its picture.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys eye, target, fov_deg, size, and up if it is not y"
)]
pub struct Camera {
    /// Position of the camera, `[x, y, z]`.
    pub eye: [f64; 3],
    /// The point that the camera looks at, `[x, y, z]`.
    pub target: [f64; 3],
    /// Direction that points up in the picture, as near as the view allows.
    #[serde(default = "super::up")]
    pub up: [f64; 3],
    /// Vertical field of view, from the lower to the upper edge of the picture, in degrees above 0 and below
    /// 180.
    #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 180.0))]
    pub fov_deg: f64,
    /// Width and height of the picture in pixels.
    #[schemars(transform = limits::range(1..=u32::MAX))]
    pub size: [u32; 2],
}

impl Resolution {
    /// Merges `overrides` into this resolution. Counts (`rows`, `cols`) replace a tolerance, and a tolerance
    /// replaces counts.
    ///
    /// A distance (`tol` or `pixels`) replaces both distances of this resolution. The camera of `overrides` is used
    /// only if the result has `pixels` and this resolution has no camera.
    #[must_use]
    pub fn overridden_by(&self, overrides: &Self) -> Self {
        let counted = overrides.rows.is_some() || overrides.cols.is_some();
        let near = overrides.tol.is_some() || overrides.pixels.is_some();
        let tolerance = near || overrides.angle_deg.is_some();
        let old = |kept: bool| if kept { self.clone() } else { Self::default() };
        let (cells, bounds) = (old(!tolerance), old(!counted));
        let distance = old(!counted && !near);
        let pixels = overrides.pixels.or(distance.pixels);
        let camera = match pixels {
            Some(_) => bounds.camera.or(overrides.camera),
            None if overrides.tol.is_some() => None,
            None => bounds.camera,
        };
        Self {
            rows: overrides.rows.or(cells.rows),
            cols: overrides.cols.or(cells.cols),
            tol: overrides.tol.or(distance.tol),
            angle_deg: overrides.angle_deg.or(bounds.angle_deg),
            pixels,
            camera,
            max_quads: overrides.max_quads.or(bounds.max_quads),
        }
    }
}
