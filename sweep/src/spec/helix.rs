//! A helix as it is written.

use crate::schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A helix about an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys radius, rise, turns, and any of center, axis"
)]
pub struct Helix {
    /// The distance of the contour's origin from the axis; positive.
    #[schemars(transform = schema::positive)]
    pub radius: f64,
    /// The way along the axis in one turn.
    pub rise: f64,
    /// Turns, at most a million, of any number but 0; below 0 they go the other way round.
    #[schemars(transform = schema::range(-1e6..=1e6))]
    #[schemars(extend("not" = {"const": 0}))]
    pub turns: f64,
    /// Where the axis is met at the height of the start.
    #[serde(default)]
    pub center: [f64; 3],
    /// The direction of the axis, of any length.
    #[serde(default = "super::up")]
    pub axis: [f64; 3],
}
