//! `materials` of a scene file.

use super::bump::BumpFile;
use super::color::{ColorFile, white};
use crate::scene::schema;
use schemars::JsonSchema;
use serde::Deserialize;

/// What a surface is made of.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MaterialFile {
    /// Multiplies the texture, or stands for it; at least 0; 1 if left out.
    pub color: ColorFile,
    /// Share of the ambient light, 0 to 1; 1 if left out.
    #[schemars(transform = schema::range(0.0..=1.0))]
    pub ambient: f64,
    /// Share of the lights, 0 to 1; 0.9 if left out.
    #[schemars(transform = schema::range(0.0..=1.0))]
    pub diffuse: f64,
    /// Strength of the highlight, 0 to 1; 0 if left out.
    #[schemars(transform = schema::range(0.0..=1.0))]
    pub specular: f64,
    /// Phong's exponent of the highlight, 1 to 1e6: the larger, the smaller the highlight; 50 if
    /// left out.
    #[schemars(transform = schema::range(1.0..=1e6))]
    pub shininess: f64,
    /// Weight of the mirrored ray, 0 to 1; 0 if left out.
    #[schemars(transform = schema::range(0.0..=1.0))]
    pub reflectivity: f64,
    /// Weight of the refracted ray, 0 to 1; 0 if left out.
    #[schemars(transform = schema::range(0.0..=1.0))]
    pub transparency: f64,
    /// Index of refraction of the inside, 0.1 to 10, where that of the outside is 1; 1.5 if left out.
    #[schemars(transform = schema::range(0.1..=10.0))]
    pub index_of_refraction: f64,
    /// Whether the weights of the mirrored and the refracted ray are multiplied by Fresnel's share and
    /// its rest; false if left out.
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
