//! The key `lights` of a scene file.

use super::color::{ColorFile, white};
use super::keywords;
use crate::scene::limits;
use schemars::JsonSchema;
use serde::Deserialize;

/// A light. Lights have no size, so their shadows have sharp edges.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LightFile {
    /// A light at a point.
    Point(PointLightFile),
    /// A light at a point that shines into a cone.
    Spot(SpotLightFile),
    /// A light as far away as the sun, with parallel rays.
    Directional(DirectionalLightFile),
}

/// A light at a point that shines into a cone with a smooth edge.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpotLightFile {
    /// Position of the light, in the unit of length.
    pub position: [f64; 3],
    /// Direction of the axis in which the light travels, of any length but 0.
    pub direction: [f64; 3],
    /// Angle between the axis and the edge of the cone, beyond which there is no light, in degrees, above
    /// 0 and at most 180.
    #[schemars(transform = keywords::range(0.0..=180.0))]
    pub outer_deg: f64,
    /// Angle from the axis up to which the light has its full brightness, in degrees, 0 to `outer_deg`;
    /// four fifths of `outer_deg` if left out.
    #[schemars(transform = keywords::range(0.0..=180.0))]
    pub inner_deg: Option<f64>,
    /// Brightness of the light, at least 0; 1 if left out.
    #[serde(default = "white")]
    pub color: ColorFile,
    /// Fading with distance; without it the light is equally bright everywhere in the cone.
    pub falloff: Option<FalloffFile>,
}

/// A point light. It does not light a surface point at its own position.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointLightFile {
    /// Position of the light, in the unit of length.
    pub position: [f64; 3],
    /// Brightness of the light, at least 0; 1 if left out.
    #[serde(default = "white")]
    pub color: ColorFile,
    /// Fading with distance; without it the light is equally bright everywhere.
    pub falloff: Option<FalloffFile>,
}

/// A light as far away as the sun, with parallel rays.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DirectionalLightFile {
    /// Direction in which the light travels, of any length but 0: `[0, -1, 0]` shines straight
    /// down.
    pub direction: [f64; 3],
    /// Brightness of the light, at least 0; 1 if left out.
    #[serde(default = "white")]
    pub color: ColorFile,
}

/// Fading of a light with distance. The light's colour is multiplied by
/// `1 / (constant + linear x + quadratic x^2)` with `x = distance / reference`, and by a million at
/// most. `{"quadratic": 1, "reference": 4}` is the inverse square of a light that has its colour at
/// a distance of 4.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FalloffFile {
    /// Constant term, 0 to 1e30; 0 if left out. At least one of the three terms must be above 0.
    #[serde(default)]
    #[schemars(transform = keywords::range(0.0..=limits::LARGEST))]
    pub constant: f64,
    /// Coefficient of the distance `x`, 0 to 1e30; 0 if left out.
    #[serde(default)]
    #[schemars(transform = keywords::range(0.0..=limits::LARGEST))]
    pub linear: f64,
    /// Coefficient of the squared distance `x^2`, 0 to 1e30; 0 if left out.
    #[serde(default)]
    #[schemars(transform = keywords::range(0.0..=limits::LARGEST))]
    pub quadratic: f64,
    /// Distance at which `x` is 1, in the unit of length, above 0: 1e-30 to 1e30; 1 if left out.
    #[serde(default = "one")]
    #[schemars(transform = keywords::positive)]
    pub reference: f64,
}

fn one() -> f64 {
    1.0
}
