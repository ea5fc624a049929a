//! Depth modulation as it is written.

use super::Law;
use serde::{Deserialize, Serialize};

/// A relief on the contour.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys mode and terms")]
pub struct Depth {
    /// What the sum of the terms does to the contour.
    pub mode: DepthMode,
    /// Waves; at least one.
    pub terms: Vec<DepthTerm>,
}

/// What a relief does to the contour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DepthMode {
    /// Multiplies it by one more than the relief.
    Factor,
    /// Moves it along its outer normal.
    Offset,
}

/// One wave of a relief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key amp, and any of u, v, phase_deg, along"
)]
pub struct DepthTerm {
    /// Its height: a part of the contour for a factor, a length for an offset.
    pub amp: f64,
    /// Waves along the contour; a whole number on a closed one.
    #[serde(default)]
    pub u: f64,
    /// Waves along the trajectory; a whole number on a closed one.
    #[serde(default)]
    pub v: f64,
    /// Where the sine begins.
    #[serde(default)]
    pub phase_deg: f64,
    /// Factor of the height along the trajectory.
    #[serde(default = "one")]
    pub along: Law,
}

fn one() -> Law {
    Law::Number(1.0)
}
