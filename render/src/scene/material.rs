//! What a surface is made of (thesis 4.5; Whitted 1980).

use crate::color::Color;

/// How a surface answers light.
///
/// The local colour is `C * (ambient * La + diffuse * sum L (N.L)) + specular * sum L (R.L)^shininess`
/// with `C` the texture, or the material's colour, or their product; reflected and refracted light
/// come on top with the weights below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Linear colour of the surface; multiplies a texture.
    pub color: Color,
    /// Share of the ambient light, in `[0, 1]`.
    pub ambient: f64,
    /// Share of diffuse light, in `[0, 1]`.
    pub diffuse: f64,
    /// Strength of the highlight, in `[0, 1]`; white, not tinted by the surface.
    pub specular: f64,
    /// Phong's exponent: the larger, the smaller the highlight.
    pub shininess: f64,
    /// Weight of reflected light, in `[0, 1]`.
    pub reflectivity: f64,
    /// Weight of refracted light, in `[0, 1]`; a light behind it is dimmed by it.
    pub transparency: f64,
    /// Index of refraction of the inside; 1 outside.
    pub index_of_refraction: f64,
    /// Whether the two weights are multiplied by Fresnel's share and its rest.
    pub fresnel: bool,
    /// What turns its normals, an index into the scene's bumps.
    pub bump: Option<usize>,
}

impl Material {
    /// Whether a texture, or the colour itself, has any influence.
    #[must_use]
    pub fn shows_color(&self) -> bool {
        self.ambient > 0.0 || self.diffuse > 0.0
    }

    /// Whether lights have any influence.
    #[must_use]
    pub fn sees_lights(&self) -> bool {
        self.diffuse > 0.0 || self.specular > 0.0
    }
}
