//! Trajectories about an axis, as they are written: a circle and a rotation.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A circle or an arc in space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key radius, and any of center, axis, angle_deg"
)]
pub struct Circle {
    /// Distance of the contour's origin from the centre, in the unit of length; positive.
    #[schemars(transform = limits::positive)]
    pub radius: f64,
    /// The centre `[x, y, z]`.
    #[serde(default)]
    pub center: [f64; 3],
    /// The direction of the contour's y, of any length.
    #[serde(default = "super::up")]
    pub axis: [f64; 3],
    /// Angle of the arc in degrees, above 0 and at most 360, which is a closed circle.
    #[serde(default = "full_turn")]
    #[schemars(transform = limits::above(0.0, 360.0))]
    pub angle_deg: f64,
}

/// A rotation of the contour about an axis in its plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with any of the keys angle_deg, origin, axis")]
pub struct Rotation {
    /// Angle of the rotation in degrees, above 0 and at most 360, which is closed.
    #[serde(default = "full_turn")]
    #[schemars(transform = limits::above(0.0, 360.0))]
    pub angle_deg: f64,
    /// Position of the contour's origin, `[x, y, z]`.
    #[serde(default)]
    pub origin: [f64; 3],
    /// The direction of the contour's y, of any length.
    #[serde(default = "super::up")]
    pub axis: [f64; 3],
}

fn full_turn() -> f64 {
    360.0
}
