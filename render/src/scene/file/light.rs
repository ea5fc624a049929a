//! `lights` of a scene file.

use super::color::{ColorFile, white};
use crate::scene::schema;
use schemars::JsonSchema;
use serde::Deserialize;

/// One of `lights`. Lights have no size, and their shadows sharp edges.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LightFile {
    /// A light at a point.
    Point(PointLightFile),
    /// A light as far away as the sun.
    Directional(DirectionalLightFile),
}

/// A point light. It does not light a surface exactly where it is.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointLightFile {
    /// Where it is, in the unit of length.
    pub position: [f64; 3],
    /// How bright it is, at least 0; 1 if left out.
    #[serde(default = "white")]
    pub color: ColorFile,
    /// How it fades with distance; equally bright everywhere if left out.
    pub falloff: Option<FalloffFile>,
}

/// A light as far away as the sun.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DirectionalLightFile {
    /// The way that its light goes, of any length but 0: `[0, -1, 0]` shines straight down.
    pub direction: [f64; 3],
    /// How bright it is, at least 0; 1 if left out.
    #[serde(default = "white")]
    pub color: ColorFile,
}

/// How a light fades: its colour is multiplied by `1 / (constant + linear x + quadratic x^2)` with
/// `x = distance / reference`, and by a million at most. `{"quadratic": 1, "reference": 4}` is the
/// inverse square of a light that has its colour at a distance of 4.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FalloffFile {
    /// The part that stays, 0 to 1e30; 0 if left out. Of the three at least one must be above 0.
    #[serde(default)]
    #[schemars(transform = schema::range(0.0..=schema::LARGEST))]
    pub constant: f64,
    /// The part that grows with the distance, 0 to 1e30; 0 if left out.
    #[serde(default)]
    #[schemars(transform = schema::range(0.0..=schema::LARGEST))]
    pub linear: f64,
    /// The part that grows with its square, 0 to 1e30; 0 if left out.
    #[serde(default)]
    #[schemars(transform = schema::range(0.0..=schema::LARGEST))]
    pub quadratic: f64,
    /// The distance at which `x` is 1, in the scene's unit of length, above 0: 1e-30 to 1e30; 1 if left out.
    #[serde(default = "one")]
    #[schemars(transform = schema::positive)]
    pub reference: f64,
}

fn one() -> f64 {
    1.0
}
