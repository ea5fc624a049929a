//! Materials (thesis 4.5; Whitted 1980).

use super::AngleRamp;
use crate::color::Color;
use std::sync::Arc;

/// The reflection and transmission of light by a surface, and the medium inside.
///
/// The local colour is `C * (ambient * La + diffuse * sum F L (N.L)) + specular * sum F L (R.L)^shininess`
/// plus the emission, where `C` is the material's colour times its texture, `La` the ambient light, and `F` the colour of
/// [`Material::by_angle`] at the light's angle. Reflected and refracted light are added with the
/// weights below.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Colour of the surface, linear RGB, each channel at least 0. A texture is multiplied by it.
    pub color: Color,
    /// The use of the colours of a mesh's vertices.
    pub vertex_colors: VertexColors,
    /// Light of its own, linear RGB, each channel at least 0. It is added to the local colour and lights no other
    /// surface.
    pub emission: Color,
    /// Share of the ambient light that is reflected, in `[0, 1]`.
    pub ambient: f64,
    /// Share of the light of lights that is reflected diffusely, in `[0, 1]`.
    pub diffuse: f64,
    /// Strength of the highlight, in `[0, 1]`. The highlight is not multiplied by the surface's
    /// colour.
    pub specular: f64,
    /// Phong's exponent, 1 to 1e6. A larger exponent makes a smaller highlight.
    pub shininess: f64,
    /// Weight of the reflected ray, in `[0, 1]`.
    pub reflectivity: f64,
    /// Weight of the refracted ray, in `[0, 1]`. Shadow rays through the surface are multiplied by
    /// it.
    pub transparency: f64,
    /// Index of refraction of the inside, 0.1 to 10. The index of air is 1.
    pub index_of_refraction: f64,
    /// True if the reflected weight is multiplied by Fresnel's reflectance, and the refracted
    /// weight by the rest.
    pub fresnel: bool,
    /// Index of the bump that perturbs the normals, in the scene's `procedural.bumps`.
    pub bump: Option<usize>,
    /// Absorption of the inside, per scene unit, each channel at least 0. After a distance `d` light
    /// is multiplied by `exp(-absorption d)` (Beer's law).
    pub absorption: Color,
    /// Priority where volumes overlap: the volume of the highest priority fills the overlap.
    pub priority: u8,
    /// Colours by the angle to the normal. The light of each light is multiplied by the colour at the
    /// light's angle, and the mirrored ray by the colour at the view's angle.
    pub by_angle: Option<Arc<AngleRamp>>,
}

/// The surfaces of a material whose colour is also multiplied by the colours of a mesh's vertices, where the mesh
/// has some.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum VertexColors {
    /// No surface.
    #[default]
    Never,
    /// Surfaces without a texture: the material states no colour.
    Untextured,
    /// All surfaces.
    Always,
}

impl VertexColors {
    /// Returns whether a surface shows the colours of vertices. `textured` is true if it has a texture.
    #[must_use]
    pub fn show(self, textured: bool) -> bool {
        match self {
            Self::Never => false,
            Self::Untextured => !textured,
            Self::Always => true,
        }
    }
}

impl Default for Material {
    /// A white, matt and opaque material: the defaults of a scene file.
    fn default() -> Self {
        Self {
            color: Color::ONE,
            vertex_colors: VertexColors::Never,
            emission: Color::ZERO,
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
    /// Returns whether the colour and the texture have any influence.
    #[must_use]
    pub fn shows_color(&self) -> bool {
        self.ambient > 0.0 || self.diffuse > 0.0
    }

    /// Returns whether lights have any influence.
    #[must_use]
    pub fn sees_lights(&self) -> bool {
        self.diffuse > 0.0 || self.specular > 0.0
    }
    /// Returns the transmittance of the inside over a distance in scene units, in `[0, 1]` for each
    /// channel (Beer's law). Over an infinite distance only channels without absorption remain.
    #[must_use]
    pub fn transmittance(&self, distance: f64) -> Color {
        if self.absorption == Color::ZERO {
            return Color::ONE;
        }
        let channel = |a: f64| if a == 0.0 { 1.0 } else { (-a * distance).exp() };
        let [red, green, blue] = self.absorption.to_array().map(channel);
        Color::new(red, green, blue)
    }

    /// Returns the colour of [`Material::by_angle`] at the angle with this cosine, or white without
    /// such colours.
    #[must_use]
    pub fn tint(&self, cosine: f64) -> Color {
        self.by_angle.as_ref().map_or(Color::ONE, |ramp| ramp.at(cosine))
    }
}
