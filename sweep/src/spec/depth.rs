//! Depth modulation as it is written: a relief on the contour.

use super::Law;
use crate::limits::{self, SMALLEST};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A relief on the contour, from waves, a picture or both.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key mode, terms or image, and fade")]
#[schemars(transform = limits::terms_or_image)]
pub struct Depth {
    /// How the relief changes the contour.
    pub mode: DepthMode,
    /// Waves that add up to the relief.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub terms: Vec<DepthTerm>,
    /// Heights from a picture, added to the waves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<DepthImage>,
    /// Length of the contour along which the relief fades at corners and ends, in the unit of length. If left out, the
    /// relief fades only where the surface would tear, along a twentieth of the contour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::positive)]
    pub fade: Option<f64>,
}

/// Heights from a picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys file and amp, and any of repeat, zero"
)]
pub struct DepthImage {
    /// A grey PNG file; its path is relative to the spec's folder.
    pub file: String,
    /// Height of white above black: a factor in `factor` mode, a length in `offset` mode.
    pub amp: f64,
    /// Repeats of the picture, across and up, above 0 and at most a million; whole numbers along closed
    /// curves.
    #[serde(default = "once")]
    #[schemars(transform = limits::range(SMALLEST..=1e6))]
    pub repeat: [f64; 2],
    /// The grey that leaves the contour unchanged: 0 is black, 1 is white.
    #[serde(default = "half")]
    pub zero: f64,
}

/// How a relief changes the contour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DepthMode {
    /// Multiplies the contour by 1 plus the relief.
    Factor,
    /// Moves the contour along its outer normal by the relief.
    Offset,
}

/// One wave of a relief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key amp, and any of u, v, phase_deg, along"
)]
pub struct DepthTerm {
    /// Amplitude: a factor in `factor` mode, a length in `offset` mode.
    pub amp: f64,
    /// Number of waves along the contour; a whole number if the contour is closed.
    #[serde(default)]
    #[schemars(transform = limits::range(-1e6..=1e6))]
    pub u: f64,
    /// Number of waves along the trajectory; a whole number if the trajectory is closed.
    #[serde(default)]
    #[schemars(transform = limits::range(-1e6..=1e6))]
    pub v: f64,
    /// Phase of the sine at the start of both curves, in degrees.
    #[serde(default)]
    pub phase_deg: f64,
    /// Factor of the amplitude along the trajectory; 1 if left out.
    #[serde(default = "one")]
    pub along: Law,
}

fn once() -> [f64; 2] {
    [1.0, 1.0]
}

fn half() -> f64 {
    0.5
}

fn one() -> Law {
    Law::Number(1.0)
}
