//! `lights` of a scene file.

use super::color::{ColorFile, white};
use serde::Deserialize;

/// One of `lights`. Lights have no size, and their shadows sharp edges.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub enum LightFile {
    Point(PointLightFile),
    Directional(DirectionalLightFile),
}

/// A point light. It does not light a surface exactly where it is.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointLightFile {
    /// Where it is.
    pub position: [f64; 3],
    /// How bright it is, at least 0; default 1.
    #[serde(default = "white")]
    pub color: ColorFile,
    /// How it fades with distance; without it, it is equally bright everywhere.
    pub falloff: Option<FalloffFile>,
}

/// A light as far away as the sun.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DirectionalLightFile {
    /// The way that its light goes, of any length but 0: `[0, -1, 0]` shines straight down.
    pub direction: [f64; 3],
    /// How bright it is, at least 0; default 1.
    #[serde(default = "white")]
    pub color: ColorFile,
}

/// How a light fades: its colour is multiplied by `1 / (constant + linear x + quadratic x^2)` with
/// `x = distance / reference`, and by a million at most. `{"quadratic": 1, "reference": 4}` is the
/// inverse square of a light that has its colour at a distance of 4.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FalloffFile {
    /// At least 0, default 0; of the three at least one must be more than 0.
    #[serde(default)]
    pub constant: f64,
    /// At least 0, default 0.
    #[serde(default)]
    pub linear: f64,
    /// At least 0, default 0.
    #[serde(default)]
    pub quadratic: f64,
    /// The distance at which `x` is 1, in the scene's unit of length; more than 0, default 1.
    #[serde(default = "one")]
    pub reference: f64,
}

fn one() -> f64 {
    1.0
}
