//! What a surface is made of (thesis 4.5; Whitted 1980).

use super::AngleRamp;
use crate::color::Color;
use std::sync::Arc;

/// How a surface answers light, and what it is filled with.
///
/// The local colour is `C * (ambient * La + diffuse * sum F L (N.L)) + specular * sum F L (R.L)^shininess`
/// with `C` the texture, or the material's colour, or their product, and `F` the colour that
/// [`Material::by_angle`] has at the light's angle; reflected and refracted light come on top with
/// the weights below.
#[derive(Debug, Clone, PartialEq)]
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
    /// Index of refraction of the inside; outside is what the ray was in, or 1.
    pub index_of_refraction: f64,
    /// Whether the two weights are multiplied by Fresnel's share and its rest.
    pub fresnel: bool,
    /// What turns its normals, an index into the scene's bumps.
    pub bump: Option<usize>,
    /// Absorption of the inside: after a way `d` light is multiplied by `exp(-absorption d)`
    /// (Beer's law). Not negative, per unit of length.
    pub absorption: Color,
    /// Where volumes overlap, the one of the highest priority is there.
    pub priority: u8,
    /// Colour by the angle to the normal: of the light, for what it brings; of the view, for the
    /// mirrored ray.
    pub by_angle: Option<Arc<AngleRamp>>,
}

impl Default for Material {
    /// White, matt and opaque: what a scene file leaves out.
    fn default() -> Self {
        Self {
            color: Color::ONE,
            ambient: 1.0,
            diffuse: 0.9,
            specular: 0.0,
            shininess: 50.0,
            reflectivity: 0.0,
            transparency: 0.0,
            index_of_refraction: 1.5,
            fresnel: false,
            absorption: Color::ZERO,
            priority: 0,
            by_angle: None,
            bump: None,
        }
    }
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
    /// The part of light that a way of this length through the inside leaves, in each channel
    /// (Beer's law). An endless way leaves what is not absorbed at all.
    #[must_use]
    pub fn transmittance(&self, way: f64) -> Color {
        if self.absorption == Color::ZERO {
            return Color::ONE;
        }
        let channel = |a: f64| if a == 0.0 { 1.0 } else { (-a * way).exp() };
        let [red, green, blue] = self.absorption.to_array().map(channel);
        Color::new(red, green, blue)
    }

    /// The colour by the angle whose cosine this is; white for most materials.
    #[must_use]
    pub fn tint(&self, cosine: f64) -> Color {
        self.by_angle.as_ref().map_or(Color::ONE, |ramp| ramp.at(cosine))
    }
}
