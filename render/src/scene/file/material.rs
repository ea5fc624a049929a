//! `materials` of a scene file.

use super::bump::BumpFile;
use super::color::{ColorFile, white};
use serde::Deserialize;

/// One of `materials`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct MaterialFile {
    pub color: ColorFile,
    pub ambient: f64,
    pub diffuse: f64,
    pub specular: f64,
    pub shininess: f64,
    pub reflectivity: f64,
    pub transparency: f64,
    pub index_of_refraction: f64,
    pub fresnel: bool,
    /// How normals are turned; not at all by default.
    pub bump: Option<BumpFile>,
}

impl Default for MaterialFile {
    fn default() -> Self {
        Self {
            color: white(),
            ambient: 1.0,
            diffuse: 0.9,
            specular: 0.0,
            shininess: 50.0,
            reflectivity: 0.0,
            transparency: 0.0,
            index_of_refraction: 1.5,
            fresnel: false,
            bump: None,
        }
    }
}
