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

use super::noise::Noise;
use super::placement::Placement;
use super::turbulence::Octaves;
use super::wall::Wall;
use glam::{DAffine3, DVec3};

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
}

impl Bump {
    /// The unit normal `normal` of a scene's point, perturbed; it is left alone where the sum
    /// vanishes.
    ///
    /// The sum is taken in the object's own space, where the relief lies, and carried back as
    /// normals are: an object that is stretched stretches its relief.
    #[must_use]
    pub fn normal(&self, to_own_space: &DAffine3, point: DVec3, normal: DVec3) -> DVec3 {
        // Normals go to the scene by the transpose of the way to own space.
        let to_scene = to_own_space.matrix3.transpose();
        let own = (to_scene.inverse() * normal).normalize_or_zero();
        let np = self.perturbation(to_own_space.transform_point3(point), own);
        (to_scene * (own + self.strength * np)).try_normalize().unwrap_or(normal)
    }

    /// `Np` of eq. 2.1 at a point of own space whose normal is `normal`.
    fn perturbation(&self, point: DVec3, normal: DVec3) -> DVec3 {
        let at = self.placement.to_texture(point);
        let gradient = match &self.relief {
            Relief::Noise(octaves) => octaves.fractal_gradient(at),
            Relief::Turbulence(octaves) => octaves.turbulence_gradient(at),
            Relief::Wall(wall) => wall.gradient(at),
            Relief::Dnoise(noise) => {
                return self.placement.gradient(noise.dnoise(at)).normalize_or_zero();
            }
        };
        let gradient = self.placement.gradient(gradient);
        normal * normal.dot(gradient) - gradient
    }
}
