//! `lights` of a scene file.

use super::color::{ColorFile, white};
use schemars::JsonSchema;
use serde::Deserialize;

/// One of `lights`.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LightFile {
    /// A light at a point.
    Point(PointLightFile),
}

/// A light at a point, equally bright at every distance.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointLightFile {
    /// Where it is, in the unit of length.
    pub position: [f64; 3],
    /// How bright it is, at least 0; 1 if left out.
    #[serde(default = "white")]
    pub color: ColorFile,
}
