//! `lights` of a scene file.

use super::color::{ColorFile, white};
use serde::Deserialize;

/// One of `lights`.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub enum LightFile {
    Point(PointLightFile),
}

/// A point light.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct PointLightFile {
    pub position: [f64; 3],
    #[serde(default = "white")]
    pub color: ColorFile,
}
