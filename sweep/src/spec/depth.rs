//! Depth modulation as it is written.

use super::Law;
use crate::schema::{self, SMALLEST};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A relief on the contour.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key mode, and terms or image")]
#[schemars(transform = schema::terms_or_image)]
pub struct Depth {
    /// What the sum of the terms does to the contour.
    pub mode: DepthMode,
    /// Waves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub terms: Vec<DepthTerm>,
    /// Heights from a picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<DepthImage>,
}

/// Heights from a picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys file and amp, and any of repeat, zero"
)]
pub struct DepthImage {
    /// A grey PNG file, from the spec's folder.
    pub file: String,
    /// Height of white above black: a part of the contour for a factor, a length for an offset.
    pub amp: f64,
    /// How often the picture repeats, across and up, above 0 and at most a million; whole numbers along closed curves.
    #[serde(default = "once")]
    #[schemars(transform = schema::range(SMALLEST..=1e6))]
    pub repeat: [f64; 2],
    /// The grey that leaves the contour as it is: 0 is black, 1 is white.
    #[serde(default = "half")]
    pub zero: f64,
}

/// What a relief does to the contour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DepthMode {
    /// Multiplies it by one more than the relief.
    Factor,
    /// Moves it along its outer normal.
    Offset,
}

/// One wave of a relief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key amp, and any of u, v, phase_deg, along"
)]
pub struct DepthTerm {
    /// Its height: a part of the contour for a factor, a length for an offset.
    pub amp: f64,
    /// Waves along the contour; a whole number on a closed one.
    #[serde(default)]
    #[schemars(transform = schema::range(-1e6..=1e6))]
    pub u: f64,
    /// Waves along the trajectory; a whole number on a closed one.
    #[serde(default)]
    #[schemars(transform = schema::range(-1e6..=1e6))]
    pub v: f64,
    /// Where the sine begins, in degrees.
    #[serde(default)]
    pub phase_deg: f64,
    /// Factor of the height along the trajectory.
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
