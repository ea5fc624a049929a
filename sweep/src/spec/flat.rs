//! A plane curve with a height as a trajectory, as it is written.
//!
//! `{"flat": {"curve": CONTOUR, "z": LAW}}` is a trajectory whose x and y are those of a plane curve. The
//! curve is written like a contour, but keeps the direction in which it is drawn. The z of the trajectory is
//! a law of the fraction of the plane curve's length. The law of a closed curve must end with the value it
//! starts with. Keys of a linear law are corners of the trajectory, which are errors.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "eight",
//!   "contour": { "circle": 0.2 },
//!   "trajectory": { "flat": {
//!     "curve": { "svg": "M0 0C2 -3 5 -3 5 0S2 3 0 0S-5 -3 -5 0S-2 3 0 0Z" },
//!     "z": { "keys": [[0, 0.5], [0.5, -0.5], [1, 0.5]], "ease": "smooth" } } },
//!   "mesh": { "rows": 120, "cols": 16 }
//! }
//! ```

use super::{Contour, Law};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A plane curve with a height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys curve and z")]
pub struct Flat {
    /// The curve that gives x and y: any contour except `circle`, `sections` and `loops`, which is not moved. An
    /// SVG path can draw a circle. A path that does not end with `Z` is open.
    #[schemars(transform = limits::without(&["circle", "sections", "loops", "rule", "center", "offset"]))]
    pub curve: Contour,
    /// The law that gives z, by the fraction of the curve's length.
    pub z: Law,
}
