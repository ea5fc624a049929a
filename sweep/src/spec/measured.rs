//! Measured and computed trajectories, as they are written.
//!
//! Points of a `free` or `polyline` trajectory may have numbers of their own, one for each point:
//!
//! | key       | meaning                                                                              |
//! |-----------|--------------------------------------------------------------------------------------|
//! | `radii`   | factors of the contour at the points, above 0: the radii of a contour `{"circle": 1}` |
//! | `scales`  | factors `[x, y]` of the contour at the points                                        |
//! | `twists`  | turns of the contour at the points, in degrees                                       |
//!
//! Between the points of a polyline the numbers change linearly, and between free points smoothly, without overshoot.
//! `radii` and `scales` stand for `scale`, and `twists` for `twist`; only one of the two is given.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "vessel",
//!   "contour": { "circle": 1 },
//!   "trajectory": { "polyline": {
//!     "points": [[0, 0, 0], [1.2, 0.4, 0], [1.3, 0.5, 0.1], [2.6, 0.2, 0.9], [3.9, 1.1, 1.2], [4.0, 1.0, 1.5], [5.6, 1.4, 1.6]],
//!     "radii": [0.3, 0.28, 0.27, 0.25, 0.24, 0.23, 0.2], "corners": { "round": 0.4 } } },
//!   "mesh": { "tol": 0.01 }
//! }
//! ```
//!
//! Free points with a `fit` are measured: a curve of few cubics passes within that distance of every point. It has no
//! corners. Numbers of the points lie where the curve passes the points.
//!
//! # Formulas
//!
//! `formula` gives x, y and z as formulas of `t`, which runs over an interval. A formula has numbers, `t`, `pi`, `tau`,
//! `+ - * / ^`, parentheses, and the functions sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, ln, sqrt,
//! abs, min and max. Angles are in radians. A curve that ends where it starts, in the same direction, is closed by
//! `"closed": true`. The knot below winds 3 times around the hole of a
//! torus and 7 times through it:
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "knot",
//!   "contour": { "circle": 0.15 },
//!   "trajectory": { "formula": {
//!     "x": "(2 + 0.8 * cos(7 * t)) * cos(3 * t)",
//!     "y": "0.8 * sin(7 * t)",
//!     "z": "-(2 + 0.8 * cos(7 * t)) * sin(3 * t)",
//!     "t": [0, 6.283185307179586], "closed": true } },
//!   "mesh": { "rows": 300, "cols": 16 }
//! }
//! ```

use super::{Corners, Csv};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Points that a trajectory passes through, each with numbers of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key points or csv, and any of closed, fit, radii, scales, twists, corners"
)]
#[schemars(transform = limits::loop_of_three, transform = limits::points_or_csv)]
pub struct Measured {
    /// True if the curve returns from the last point to the first, which is not repeated.
    #[serde(default)]
    pub closed: bool,
    /// The points `[x, y, z]`: at least two, or three if closed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(transform = limits::at_least(2))]
    pub points: Vec<[f64; 3]>,
    /// A table with the points, in place of `points`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub csv: Option<Csv>,
    /// Largest distance of a point from the curve, in the unit of length, above 0. If left out, the curve passes through
    /// all points. Only of a `free` curve.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::positive)]
    pub fit: Option<f64>,
    /// Factors of the contour, above 0, one for each point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::positive_items)]
    pub radii: Option<Vec<f64>>,
    /// Factors of the contour's x and y, one pair for each point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scales: Option<Vec<[f64; 2]>>,
    /// Turns of the contour in degrees, one for each point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twists: Option<Vec<f64>>,
    /// Treatment of the corners of a polyline; if left out, corners are errors. A `free` curve has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corners: Option<Corners>,
}

/// A curve whose coordinates are formulas.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys x, y, z and t, and closed if it is"
)]
pub struct FormulaCurve {
    /// The formula of x, with the variable `t`.
    pub x: String,
    /// The formula of y.
    pub y: String,
    /// The formula of z.
    pub z: String,
    /// The values of `t` at the start and at the end, rising.
    pub t: [f64; 2],
    /// True if the curve ends where it starts, in the same direction.
    #[serde(default)]
    pub closed: bool,
}
