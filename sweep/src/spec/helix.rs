//! A helix as it is written.
//!
//! `radius` and `rise` are numbers or laws of the turns: conical springs, springs with closed ends, tapered threads.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "spring",
//!   "contour": { "circle": 0.4 },
//!   "trajectory": { "helix": { "radius": { "keys": [[0, 4], [1, 3]], "ease": "smooth" },
//!     "rise": { "keys": [[0, 0.85], [0.2, 0.85], [0.3, 2], [0.7, 2], [0.8, 0.85], [1, 0.85]], "ease": "smooth" }, "turns": 7 } },
//!   "mesh": { "rows": 200, "cols": 12 }
//! }
//! ```

use super::Law;
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A helix about an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys radius, rise, turns, and any of start_deg, center, axis"
)]
pub struct Helix {
    /// Distance of the contour's origin from the axis, in the unit of length; above 0. A law runs over the turns.
    pub radius: Law,
    /// Rise along the axis in one turn, in the unit of length; below 0 the helix descends. A law runs over the turns.
    pub rise: Law,
    /// Number of turns, not 0, from -1,000,000 to 1,000,000. A helix that rises is right-handed if the number is above 0,
    /// and left-handed below.
    #[schemars(transform = limits::range(-1e6..=1e6))]
    #[schemars(extend("not" = {"const": 0}))]
    pub turns: f64,
    /// Angle about the axis at which the helix starts, in degrees, right-handed.
    #[serde(default)]
    pub start_deg: f64,
    /// The point of the axis at the height of the start.
    #[serde(default)]
    pub center: [f64; 3],
    /// The direction of the axis, of any length.
    #[serde(default = "super::up")]
    pub axis: [f64; 3],
}
