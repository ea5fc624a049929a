//! `materials` of a scene file.

use super::color::{ColorFile, white};
use serde::Deserialize;

/// One of `materials`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MaterialFile {
    /// Linear colour, at least 0; multiplies the texture, or stands for it. Default 1.
    pub color: ColorFile,
    /// Share of the ambient light, 0 to 1; default 1.
    pub ambient: f64,
    /// Share of diffuse light, 0 to 1; default 0.9.
    pub diffuse: f64,
    /// Strength of the highlight, 0 to 1; default 0.
    pub specular: f64,
    /// Phong's exponent of the highlight, 1 to 1e6; default 50.
    pub shininess: f64,
    /// Weight of the mirrored ray, 0 to 1; default 0.
    pub reflectivity: f64,
    /// Weight of the refracted ray, 0 to 1; default 0.
    pub transparency: f64,
    /// Index of refraction of the inside, 0.1 to 10; default 1.5.
    pub index_of_refraction: f64,
    /// Whether both weights take Fresnel's share and its rest; default false.
    pub fresnel: bool,
    /// How the inside of a closed object absorbs light, per unit of length and at least 0: a way `d`
    /// leaves `exp(-absorption d)` of it. Default 0.
    pub absorption: ColorFile,
    /// Where transparent closed objects overlap, the one of the highest priority is there, and of
    /// equals the one that a ray entered last; 0 to 255, default 0.
    pub priority: u8,
    /// Colours by the angle between light and normal: `[degrees, colour]`, ascending from 0 to 90,
    /// linear between. They multiply what each light brings, and at the angle of the view the
    /// mirrored ray. Default none.
    pub by_angle: Option<Vec<(f64, ColorFile)>>,
    /// A thin film whose interference gives the colours by the angle; not together with `by_angle`.
    pub thin_film: Option<ThinFilmFile>,
}

/// A thin film. Its colours are scaled so that the brightest up to 60 degrees is 1.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThinFilmFile {
    /// Thickness in nanometres, 1 to 5000.
    pub thickness_nm: f64,
    /// Index of refraction of the film, 1 to 5; default 1.33, soap.
    #[serde(default = "soap")]
    pub index: f64,
    /// Index of refraction of what it lies on, 1 to 5; default 1, a film in air.
    #[serde(default = "air")]
    pub base_index: f64,
}

fn soap() -> f64 {
    1.33
}

fn air() -> f64 {
    1.0
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
            absorption: ColorFile([0.0; 3]),
            priority: 0,
            by_angle: None,
            thin_film: None,
        }
    }
}
