//! Caps as they are written: the closures of the two ends of a sweep.
//!
//! `caps` close the ends of an open trajectory. `"flat"` closes an end in its own
//! plane. `"round"` closes it by a dome (half a sphere on a circle), and `{"dome": h}` by a dome of height h.
//! `{"pole": h}` closes it by a cone of height h. `v` runs over the caps too, by length. The laws run over
//! the trajectory alone.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "bullet",
//!   "contour": { "circle": 0.4 },
//!   "trajectory": { "line": [[0, 0, 0], [0, 1, 0]] },
//!   "caps": { "start": "flat", "end": { "dome": 0.8 } },
//!   "mesh": { "rows": 40, "cols": 32 }
//! }
//! ```
//!
//! A cap shrinks its section toward a point that sees the whole outline of the section. Where there is no such point (a
//! U, an outline with holes) and at the ends of a partial rotation, only flat caps are possible: they are triangles
//! between the points of the outlines. An outline that crosses itself is refused. So is an open contour, except one of a
//! rotation that starts and ends on the axis.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The closures of the ends of a sweep.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default, expecting = "an object with any of the keys start, end")]
pub struct Caps {
    /// The cap at the start of the trajectory.
    pub start: Option<Cap>,
    /// The cap at the end of the trajectory.
    pub end: Option<Cap>,
}

/// The closure of one end of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Cap {
    /// A flat cap in the plane of the section.
    Flat,
    /// A dome whose height is the mean distance of the section's outline from its centre: on a circle, half a
    /// sphere.
    Round,
    /// A dome of this height, in the unit of length; above 0.
    Dome(#[schemars(transform = limits::positive)] f64),
    /// A cone of this height, in the unit of length; above 0. Its tip is a pole.
    Pole(#[schemars(transform = limits::positive)] f64),
}
