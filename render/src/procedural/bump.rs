//! Bump mapping (J. F. Blinn 1978; thesis 2.2, eq. 2.1 and 2.2, fig. 2.2).
//!
//! The normal `Ns` of a surface becomes `Ns + k Np`, normalised, with `Np` from a perturbation. Here
//! a perturbation is a height `h`, and `Np` is minus the part of its gradient along the surface: the
//! normal, to first order in `k`, of the surface that would be pushed out by `k h`. So a bump and a
//! true displacement of the same relief have the same shading, and only the outline tells them
//! apart. The thesis's own perturbation, `dnoise`, is added as it is.
//!
//! Slopes are what is seen of a bump. Those of trilinear noise jump at the faces of its cells, which
//! shows as creases; so bumps are interpolated smoothly unless the linear way is asked for.

use super::heights::Heights;
use super::noise::Noise;
use super::placement::Placement;
use super::turbulence::Octaves;
use super::wall::Wall;
use glam::{DAffine3, DVec2, DVec3};

/// What turns normals.
#[derive(Debug, Clone, PartialEq)]
pub struct Bump {
    /// The perturbation.
    pub relief: Relief,
    /// `k`: for heights, the length in the object's own space of a height of 1, below 0 for dents;
    /// for `dnoise` a number.
    pub strength: f64,
    /// Where the relief lies in the object.
    pub placement: Placement,
}

/// A perturbation.
#[derive(Debug, Clone, PartialEq)]
pub enum Relief {
    /// The fractal sum of noise as a height.
    Noise(Octaves),
    /// Turbulence as a height.
    Turbulence(Octaves),
    /// The wall's height.
    Wall(Wall),
    /// The vectors of fig. 2.3.
    Dnoise(Noise),
    /// A picture as heights over texture coordinates.
    Picture(Heights),
}

/// Where a normal is to be turned, in the scene's space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The point.
    pub point: DVec3,
    /// Its unit normal.
    pub normal: DVec3,
    /// Its texture coordinates.
    pub uv: DVec2,
    /// How they change along the surface: their gradients. Used by pictures only.
    pub uv_gradients: [DVec3; 2],
}

impl Bump {
    /// Whether it looks at texture coordinates.
    #[must_use]
    pub fn wants_uv(&self) -> bool {
        matches!(self.relief, Relief::Picture(_))
    }

    /// The unit normal of a place, perturbed; it is left alone where the sum vanishes.
    ///
    /// The sum is taken in the object's own space, where the relief lies, and carried back as
    /// normals are: an object that is stretched stretches its relief.
    #[must_use]
    pub fn normal(&self, to_own_space: &DAffine3, place: &Place) -> DVec3 {
        // Normals go to the scene by the transpose of the way to own space.
        let to_scene = to_own_space.matrix3.transpose();
        let to_own = to_scene.inverse();
        let own = Place {
            point: to_own_space.transform_point3(place.point),
            normal: (to_own * place.normal).normalize_or_zero(),
            uv: place.uv,
            uv_gradients: place.uv_gradients.map(|gradient| to_own * gradient),
        };
        let np = self.perturbation(&own);
        (to_scene * (own.normal + self.strength * np)).try_normalize().unwrap_or(place.normal)
    }

    /// `Np` of eq. 2.1 at a place of own space.
    fn perturbation(&self, place: &Place) -> DVec3 {
        let normal = place.normal;
        let at = self.placement.to_texture(place.point);
        let in_texture = match &self.relief {
            Relief::Noise(octaves) => octaves.fractal_gradient(at),
            Relief::Turbulence(octaves) => octaves.turbulence_gradient(at),
            Relief::Wall(wall) => wall.gradient(at),
            Relief::Dnoise(noise) => {
                return self.placement.gradient(noise.dnoise(at)).normalize_or_zero();
            }
            Relief::Picture(heights) => {
                let slopes = heights.slopes(place.uv);
                let [along_u, along_v] = place.uv_gradients;
                let gradient = slopes.x * along_u + slopes.y * along_v;
                return normal * normal.dot(gradient) - gradient;
            }
        };
        let gradient = self.placement.gradient(in_texture);
        normal * normal.dot(gradient) - gradient
    }
}
