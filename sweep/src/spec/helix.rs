//! A helix as it is written.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A helix about an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys radius, rise, turns, and any of center, axis"
)]
pub struct Helix {
    /// Distance of the contour's origin from the axis, in the unit of length; positive.
    #[schemars(transform = limits::positive)]
    pub radius: f64,
    /// Rise along the axis in one turn, in the unit of length; below 0 the helix descends.
    pub rise: f64,
    /// Number of turns, not 0, from -1,000,000 to 1,000,000. A negative number reverses the direction of
    /// rotation.
    #[schemars(transform = limits::range(-1e6..=1e6))]
    #[schemars(extend("not" = {"const": 0}))]
    pub turns: f64,
    /// The point of the axis at the height of the start.
    #[serde(default)]
    pub center: [f64; 3],
    /// The direction of the axis, of any length.
    #[serde(default = "super::up")]
    pub axis: [f64; 3],
}
