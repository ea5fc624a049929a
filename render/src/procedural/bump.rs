//! Bump mapping (J. F. Blinn 1978; thesis 2.2, eq. 2.1 and 2.2, fig. 2.2).
//!
//! The normal `Ns` of a surface becomes `Ns + k Np`, normalised, where `Np` is a perturbation. Here
//! a perturbation is given by a height `h`, and `Np` is minus the part of its gradient along the
//! surface. To first order in `k` the result is the normal of the surface displaced outward by
//! `k h`. A bump and a true displacement of the same relief therefore have the same shading and
//! differ only in their outlines. The thesis's own perturbation, `dnoise`, is added unchanged.
//!
//! The slopes of a bump determine its shading. Slopes of trilinear noise jump at the faces of its
//! cells, which appear as creases. Bumps are therefore interpolated smoothly unless the scene
//! requests linear interpolation.

use super::heights::Heights;
use super::noise::Noise;
use super::normal_map::{NormalMap, tangents};
use super::placement::Placement;
use super::turbulence::Octaves;
use super::wall::Wall;
use glam::{DAffine3, DVec2, DVec3};

/// A relief that perturbs normals.
#[derive(Debug, Clone, PartialEq)]
pub struct Bump {
    /// The perturbation.
    pub relief: Relief,
    /// `k`. For heights it is the length of a height of 1, in the object's own space; a negative
    /// value makes dents. For `dnoise` and for the slopes of a normal map it is a plain factor.
    pub strength: f64,
    /// Position of the relief in the object.
    pub placement: Placement,
}

/// The perturbation of a relief.
///
/// A new relief provides, and the compiler leads to each `match`:
///
/// - a height and its exact gradient, both continuous, or a vector that is added to the normal;
/// - its key in scene files: a field of [`BumpFile`](crate::scene::file::bump::BumpFile) and a variant
///   of `ReliefKind` there;
/// - tests: the gradient equals differences of the height, and the normal is that of the displaced
///   surface as the strength goes to 0 (`tests.rs` of this folder).
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
    /// A picture of normals over texture coordinates.
    Normals(NormalMap),
}

/// A point whose normal is perturbed, in scene space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Position of the point.
    pub point: DVec3,
    /// Unit normal at the point.
    pub normal: DVec3,
    /// Texture coordinates of the point.
    pub uv: DVec2,
    /// Gradients of both texture coordinates along the surface. Only pictures use them.
    pub uv_gradients: [DVec3; 2],
}

impl Bump {
    /// Returns whether the relief uses texture coordinates.
    #[must_use]
    pub fn wants_uv(&self) -> bool {
        match self.relief {
            Relief::Picture(_) | Relief::Normals(_) => true,
            Relief::Noise(_) | Relief::Turbulence(_) | Relief::Wall(_) | Relief::Dnoise(_) => false,
        }
    }

    /// Memory in bytes that [`Bump::averaged`] adds when it is first called: the moments of a
    /// picture's slopes, 27 bytes per texel; 0 for reliefs that are no picture.
    #[must_use]
    pub fn moments_bytes(&self) -> u64 {
        match &self.relief {
            Relief::Picture(heights) => heights.moments_bytes(),
            Relief::Normals(map) => map.moments_bytes(),
            Relief::Noise(_) | Relief::Turbulence(_) | Relief::Wall(_) | Relief::Dnoise(_) => 0,
        }
    }

    /// Returns the perturbed unit normal at `place`, in scene space. The normal is unchanged where
    /// the sum vanishes.
    ///
    /// The sum is taken in the object's own space, where the relief is defined, and transformed
    /// back as normals are. A stretched object therefore stretches its relief.
    #[must_use]
    pub fn normal(&self, to_own_space: &DAffine3, place: &Place) -> DVec3 {
        // Normals are transformed to the scene by the transpose of the map to own space.
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

    /// Computes `Np` of eq. 2.1 at a point of own space.
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
            Relief::Normals(map) => {
                let slopes = map.slopes(place.uv);
                let [along_u, along_v] = tangents(place.uv_gradients);
                let gradient = slopes.x * along_u + slopes.y * along_v;
                return normal * normal.dot(gradient) - gradient;
            }
        };
        let gradient = self.placement.gradient(in_texture);
        normal * normal.dot(gradient) - gradient
    }
}
