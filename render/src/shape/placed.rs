//! A shape that is put somewhere by an affine map: a sphere becomes an ellipsoid, a box is turned.
//!
//! The shape stays what it is; rays are brought to its own space and what they find is brought
//! back. Distances along a ray keep their ratios on the way, so the nearest hit stays the nearest.

use super::{Placement, Shape, Start, SurfacePoint};
use glam::DVec3;

/// Roundings of the largest coordinate by which the computed box of a placed shape is widened.
const ROUNDINGS: f64 = 16.0;

/// A shape and its placement; made by [`Shape::placed`].
#[derive(Debug, Clone)]
pub struct Placed {
    shape: Box<Shape>,
    placement: Placement,
    /// The most by which a length grows on the way to the shape's own space.
    growth: f64,
}

impl Placed {
    /// A curved shape or a box, placed.
    pub(super) fn new(shape: Shape, placement: Placement) -> Self {
        let columns = placement.to_own().matrix3.to_cols_array();
        let growth = columns.into_iter().map(|x| x * x).sum::<f64>().sqrt();
        Self { shape: Box::new(shape), placement, growth }
    }

    /// The shape in its own space.
    #[must_use]
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// As [`Shape::intersect`], in the scene's space.
    #[must_use]
    pub fn intersect(&self, origin: DVec3, direction: DVec3, start: Start) -> Option<(f64, u32)> {
        let to_own = self.placement.to_own();
        let along = to_own.transform_vector3(direction);
        let length = along.length();
        let start = Start { skin: self.growth * start.skin, ..start };
        let origin = to_own.transform_point3(origin);
        let (t, face) = self.shape.intersect(origin, along / length, start)?;
        let t = t / length;
        (t > 0.0 && t < f64::INFINITY).then_some((t, face))
    }

    /// As [`Shape::surface_point`], in the scene's space.
    #[must_use]
    pub fn surface_point(&self, face: u32, near: DVec3) -> SurfacePoint {
        let near = self.placement.to_own().transform_point3(near);
        let own = self.shape.surface_point(face, [0.0; 2], near);
        let turned = |normal: DVec3| self.placement.normal(normal).normalize_or(DVec3::Y);
        SurfacePoint {
            position: self.placement.to_scene().transform_point3(own.position),
            geometric_normal: turned(own.geometric_normal),
            shading_normal: turned(own.shading_normal),
            ..own
        }
    }

    /// Lower and upper corner of its box.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let to_scene = self.placement.to_scene();
        let [low, high] = match &*self.shape {
            // An ellipsoid reaches as far along an axis as that row of the map is long.
            Shape::Sphere(sphere) => {
                let rows = to_scene.matrix3.transpose();
                let rows = [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec3::length);
                let reach = sphere.radius * DVec3::from(rows);
                let middle = to_scene.transform_point3(sphere.center);
                [middle - reach, middle + reach]
            }
            shape => self.placement.bounds(shape.bounds().unwrap_or([DVec3::ZERO; 2])),
        };
        let widening = ROUNDINGS * f64::EPSILON * self.extent();
        [low - widening, high + widening]
    }

    /// The largest coordinate, without its sign, that its points are computed from.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let own = DVec3::splat(self.shape.extent());
        let [low, high] = self.placement.bounds([-own, own]);
        low.abs().max(high.abs()).max_element()
    }
}
