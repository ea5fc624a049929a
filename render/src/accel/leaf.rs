//! Pieces of surface as the structures store them, and the only test of a ray against a piece.
//!
//! A hit lies where the ray crosses the box of its piece. Cheap conditions are tested first: whether
//! the piece can lie before `t_max`, then the hit itself, and last whether the ray starts on the
//! piece. The order of the conditions does not change the result.

use super::Accel;
use super::slabs::SlabRay;
use crate::ray::{Hit, Piece, Ray};
use crate::shape::triangle::{self, Corners, ShearedRay};
use crate::shape::{Shape, Start};
use glam::{DVec3, DVec4};

/// A triangle, or a shape that is one piece.
#[derive(Debug, Clone, Copy)]
pub struct Leaf {
    object: u32,
    /// Index of the triangle in its mesh, or [`WHOLE`].
    triangle: u32,
    /// Corners of the triangle; 0 for a whole shape.
    corners: [[f32; 3]; 3],
}

/// Stands for the triangle's index in a leaf that is a whole shape. No mesh has so many triangles
/// ([`crate::shape::Mesh::check`]).
const WHOLE: u32 = u32::MAX;

impl Leaf {
    /// A triangle of a mesh.
    #[must_use]
    pub fn of_triangle(piece: Piece, corners: [[f32; 3]; 3]) -> Self {
        Self { object: piece.object, triangle: piece.triangle, corners }
    }

    /// A shape that is one piece.
    #[must_use]
    pub fn whole(object: u32) -> Self {
        Self { object, triangle: WHOLE, corners: [[0.0; 3]; 3] }
    }

    /// Returns the same triangle of another object.
    #[must_use]
    pub fn of_object(&self, object: u32) -> Self {
        Self { object, ..*self }
    }

    /// Index of the object.
    #[must_use]
    pub fn object(&self) -> u32 {
        self.object
    }
}

/// A ray prepared for tests against leaves.
#[derive(Debug)]
pub struct Probe<'a> {
    ray: &'a Ray,
    sheared: ShearedRay,
    /// The ray, prepared for tests against boxes.
    pub slabs: SlabRay,
    /// Rounding of the start and of the object together, in the space of an instance; `None` in the
    /// scene's space.
    whole_skin: Option<f64>,
    /// Bound on the error of distances to corners, in scene units.
    slack: f64,
}

impl<'a> Probe<'a> {
    /// Prepares a ray.
    #[must_use]
    #[inline(always)]
    pub fn new(accel: &Accel<'_>, ray: &'a Ray) -> Self {
        let slabs = SlabRay::new(ray.origin, ray.direction, accel.extent);
        let sheared = ShearedRay::with_inverse(ray.origin, ray.direction, slabs.inverse);
        Self { ray, sheared, slabs, whole_skin: None, slack: slabs.slack() }
    }

    /// Prepares a ray in the space of an instance. `extent` is that of [`SlabRay::new`], and `skin` the
    /// distance from the start within which a surface coincides with the start, both in own units.
    #[must_use]
    #[inline(always)]
    pub fn within(ray: &'a Ray, extent: f64, skin: f64) -> Self {
        let slabs = SlabRay::new(ray.origin, ray.direction, extent);
        let sheared = ShearedRay::with_inverse(ray.origin, ray.direction, slabs.inverse);
        Self { ray, sheared, slabs, whole_skin: Some(skin), slack: slabs.slack() }
    }

    /// Returns the distance from the start within which a surface of this object coincides with
    /// the start.
    #[must_use]
    #[inline(always)]
    pub fn skin(&self, accel: &Accel<'_>, object: u32) -> f64 {
        self.whole_skin.unwrap_or_else(|| Self::skin_of(accel, self.ray, object))
    }

    /// Returns the distance as [`Probe::skin`] does, for a ray in scene space.
    #[must_use]
    #[inline(always)]
    pub fn skin_of(accel: &Accel<'_>, ray: &Ray, object: u32) -> f64 {
        match ray.leaving {
            Some(from) => {
                accel.rounding(from.object, ray.origin) + accel.rounding(object, DVec3::ZERO)
            }
            // A start that is meant to lie on a surface is off it by the rounding of its own
            // coordinates.
            None => super::EYE_ROUNDINGS / super::ROUNDINGS * accel.rounding(object, ray.origin),
        }
    }

    /// Returns the hit of the ray with a leaf, with `t` in `(0, t_max]`. The existence and the
    /// position of a hit do not depend on `t_max`.
    #[inline]
    pub fn meet(&self, accel: &Accel<'_>, leaf: &Leaf, t_max: f64) -> Option<Hit> {
        if leaf.triangle == WHOLE {
            return self.meet_shape(accel, leaf.object, t_max);
        }
        let piece = Piece { object: leaf.object, triangle: leaf.triangle };
        let corners = triangle::by_axis(&leaf.corners, accel.offset(leaf.object));
        self.meet_triangle(accel, piece, &corners, t_max)
    }

    /// Returns the hit of the ray with a triangle, as [`Probe::meet`] does.
    #[inline(always)]
    pub fn meet_triangle(
        &self,
        accel: &Accel<'_>,
        piece: Piece,
        corners: &Corners,
        t_max: f64,
    ) -> Option<Hit> {
        if self.ray.leaving == Some(piece) {
            return None;
        }
        // The box of a triangle whose corners all lie beyond this distance is entered beyond `t_max`.
        let limit = t_max + self.slack;
        let ((t, barycentric), area) = self.sheared.intersect(corners, limit)?;
        let [x, y, z] = corners;
        let low = DVec4::new(x.min_element(), y.min_element(), z.min_element(), 0.0);
        let high = DVec4::new(x.max_element(), y.max_element(), z.max_element(), f64::INFINITY);
        let [enter, leave] = self.slabs.crosses_padded([low, high])?;
        let clamped = t.clamp(enter, leave);
        if !(clamped > 0.0 && clamped <= t_max) {
            return None;
        }
        let skin = self.skin(accel, piece.object);
        let size = (high - low).truncate().extend(0.0);
        if !self.sheared.starts_off(t, area, size, skin) && self.sheared.starts_on(corners, skin) {
            return None;
        }
        Some(Hit { t: clamped, piece, barycentric })
    }

    /// Returns the hit of the ray with a shape that is one piece, as [`Probe::meet`] does.
    pub fn meet_shape(&self, accel: &Accel<'_>, object: u32, t_max: f64) -> Option<Hit> {
        let shape = accel.shapes[object as usize];
        let left = self.ray.leaving.filter(|from| from.object == object);
        if left.is_some() && matches!(shape, Shape::Quad(_)) {
            return None;
        }
        let range = match accel.bounds[object as usize] {
            Some(bounds) => Some(self.slabs.crosses(bounds)?),
            None => None,
        };
        if range.is_some_and(|[enter, _]| enter > t_max) {
            return None;
        }
        let left_face = left.map(|from| from.triangle);
        let start = Start { left_face, skin: self.skin(accel, object) };
        let (t, triangle) = shape.intersect(self.ray.origin, self.ray.direction, start)?;
        let t = range.map_or(t, |[enter, leave]| t.clamp(enter, leave));
        let hit = Hit { t, piece: Piece { object, triangle }, barycentric: [0.0; 2] };
        (t > 0.0 && t <= t_max).then_some(hit)
    }
}
