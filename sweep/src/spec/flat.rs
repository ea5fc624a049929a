//! A trajectory drawn flat, as it is written.
//!
//! `{"flat": {"curve": CONTOUR, "z": LAW}}` is a trajectory whose x and y are those of a curve in the plane,
//! written as contours are (but run through as it is drawn), and whose z is a law of the fraction of that
//! curve's length. A closed curve wants a law that ends as it starts. Keys of a linear law are corners of the
//! trajectory.
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
use crate::schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A curve in the plane with a height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys curve and z")]
pub struct Flat {
    /// Gives x and y; any contour but a circle, of which an SVG path can draw one.
    #[schemars(transform = schema::without(&["circle", "sections"]))]
    pub curve: Contour,
    /// Gives z, by the fraction of the curve's length.
    pub z: Law,
}
