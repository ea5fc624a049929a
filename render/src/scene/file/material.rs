//! The key `materials` of a scene file.

use super::bump::BumpFile;
use super::color::{ColorFile, SurfaceColorFile};
use super::keywords;
use schemars::JsonSchema;
use serde::Deserialize;

/// The material of a surface.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MaterialFile {
    /// Colour of the surface, at least 0, or `"vertex"` for the colours that the vertices of a mesh have. A
    /// texture is multiplied by it. If left out, surfaces without a texture show the colours of vertices, and all
    /// others are 1.
    pub color: Option<SurfaceColorFile>,
    /// Light of its own that the surface adds to the light that it reflects, at least 0; 0 if left out. It
    /// lights no other surface.
    pub emission: ColorFile,
    /// Share of the ambient light that the surface reflects, 0 to 1; 1 if left out.
    #[schemars(transform = keywords::range(0.0..=1.0))]
    pub ambient: f64,
    /// Share of the light of lights that the surface reflects diffusely, 0 to 1; 0.9 if left out.
    #[schemars(transform = keywords::range(0.0..=1.0))]
    pub diffuse: f64,
    /// Strength of the highlight, 0 to 1; 0 if left out.
    #[schemars(transform = keywords::range(0.0..=1.0))]
    pub specular: f64,
    /// Phong's exponent of the highlight, 1 to 1e6; 50 if left out. A larger exponent makes a
    /// smaller highlight.
    #[schemars(transform = keywords::range(1.0..=1e6))]
    pub shininess: f64,
    /// Weight of the mirrored ray, 0 to 1; 0 if left out.
    #[schemars(transform = keywords::range(0.0..=1.0))]
    pub reflectivity: f64,
    /// Weight of the refracted ray, 0 to 1; 0 if left out.
    #[schemars(transform = keywords::range(0.0..=1.0))]
    pub transparency: f64,
    /// Index of refraction of the inside, 0.1 to 10; 1.5 if left out. The index of air is 1.
    #[schemars(transform = keywords::range(0.1..=10.0))]
    pub index_of_refraction: f64,
    /// True if Fresnel's equations divide the light: the weight of the mirrored ray is multiplied
    /// by their reflectance, and the weight of the refracted ray by the rest; false if left out.
    pub fresnel: bool,
    /// Relief that perturbs the normals; none if left out.
    pub bump: Option<BumpFile>,
    /// Absorption of light inside a closed object, per unit of length, at least 0; 0 if left out.
    /// After a distance `d` light is multiplied by `exp(-absorption d)`.
    pub absorption: ColorFile,
    /// Priority where transparent closed objects overlap, 0 to 255; 0 if left out. The object of
    /// the highest priority fills the overlap; of equal priorities, the object that a ray entered
    /// last.
    #[schemars(transform = keywords::range(0..=255))]
    pub priority: u8,
    /// Colours by the angle to the normal: `[degrees, colour]`, rising from 0 to 90, linear
    /// between; none if left out. The light of each light is multiplied by the colour at the
    /// light's angle, and the mirrored ray by the colour at the view's angle.
    pub by_angle: Option<Vec<(f64, ColorFile)>>,
    /// A thin film whose interference gives the colours by angle. Not allowed together with
    /// `by_angle`.
    pub thin_film: Option<ThinFilmFile>,
}

/// A thin film. Its colours are scaled so that the brightest up to 60 degrees is 1.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThinFilmFile {
    /// Thickness in nanometres, 1 to 5000.
    #[schemars(transform = keywords::range(1.0..=5000.0))]
    pub thickness_nm: f64,
    /// Index of refraction of the film, 1 to 5; 1.33 (soap) if left out.
    #[serde(default = "soap")]
    #[schemars(transform = keywords::range(1.0..=5.0))]
    pub index: f64,
    /// Index of refraction of the medium behind the film, 1 to 5; 1 (air) if left out.
    #[serde(default = "air")]
    #[schemars(transform = keywords::range(1.0..=5.0))]
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
            color: None,
            emission: ColorFile([0.0; 3]),
            ambient: 1.0,
            diffuse: 0.9,
            specular: 0.0,
            shininess: 50.0,
            reflectivity: 0.0,
            transparency: 0.0,
            index_of_refraction: 1.5,
            fresnel: false,
            bump: None,
            absorption: ColorFile([0.0; 3]),
            priority: 0,
            by_angle: None,
            thin_film: None,
        }
    }
}
