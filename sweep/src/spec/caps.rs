//! Caps as they are written.
//!
//! `caps` close the ends of an open trajectory whose contour is closed: `"flat"` in the plane of the
//! end, `"round"` by a dome (half a sphere on a circle), `{"dome": h}` by one of height h,
//! `{"pole": h}` by a cone of height h. `v` runs over the caps too, by length; the laws do
//! not, and keep to the trajectory.
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
//! A cap gathers its section to one place in it that sees all of it, so a section that has none (a
//! figure of eight, a U) is refused.

use crate::schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What closes the ends of a sweep.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default, expecting = "an object with any of the keys start, end")]
pub struct Caps {
    /// At the start of the trajectory.
    pub start: Option<Cap>,
    /// At its end.
    pub end: Option<Cap>,
}

/// What closes one end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Cap {
    /// The plane of the section.
    Flat,
    /// A dome as high as the section's points are from its centre in the mean: on a circle, half a
    /// sphere.
    Round,
    /// A dome of this height, in the unit of length; above 0.
    Dome(#[schemars(transform = schema::positive)] f64),
    /// A cone of this height, to a pole; above 0.
    Pole(#[schemars(transform = schema::positive)] f64),
}
