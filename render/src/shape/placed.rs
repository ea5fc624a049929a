//! A shape that is placed by an affine map: a sphere becomes an ellipsoid, and a box is rotated.
//!
//! The shape itself stays unchanged. Rays are transformed to the shape's own space, and hits are
//! transformed back. The map keeps the ratios of distances along a ray, so the nearest hit stays
//! the nearest.

use super::gradient_changes::Extension;
use super::{Changes, Placement, Shape, Start, SurfacePoint};
use crate::differential;
use glam::DVec3;

/// Margin of the bounding box of a placed shape, in roundings of the largest coordinate.
const ROUNDINGS: f64 = 16.0;

/// A shape and its placement. [`Shape::placed`] creates it.
#[derive(Debug, Clone)]
pub struct Placed {
    shape: Box<Shape>,
    placement: Placement,
    /// Upper bound of the factor by which the map to own space lengthens a vector.
    growth: f64,
}

impl Placed {
    /// Places a curved shape or a box.
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

    /// Finds a hit as [`Shape::intersect`] does, in scene space.
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

    /// Returns the unit normal as [`Shape::geometric_normal`] does, in scene space.
    #[must_use]
    pub fn normal(&self, face: u32, near: DVec3) -> DVec3 {
        let near = self.placement.to_own().transform_point3(near);
        let own = self.shape.geometric_normal(face, near);
        self.placement.normal(own).normalize_or(DVec3::Y)
    }

    /// Returns a surface point as [`Shape::surface_point`] does, in scene space.
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

    /// Returns gradients as [`Shape::uv_gradients`] does, in scene space.
    #[must_use]
    pub fn uv_gradients(&self, face: u32, position: DVec3) -> [DVec3; 2] {
        let to_own = self.placement.to_own();
        let near = to_own.transform_point3(position);
        let normal = self.normal(face, position);
        self.shape.uv_gradients(face, near).map(|own| {
            let gradient = to_own.matrix3.transpose() * own;
            gradient - gradient.dot(normal) * normal
        })
    }

    /// Returns changes as [`Shape::changes`] does, in scene space.
    #[must_use]
    pub fn changes(&self, face: u32, point: &SurfacePoint, steps: [DVec3; 2]) -> Changes {
        let to_own = self.placement.to_own();
        // Normals are transformed to own space by the transpose of the map to the scene. The shape
        // has no interpolated normals, so this one is also the normal for shading.
        let back = self.placement.to_scene().matrix3.transpose() * point.geometric_normal;
        let normal = back.normalize_or(DVec3::Y);
        let own = SurfacePoint {
            position: to_own.transform_point3(point.position),
            geometric_normal: normal,
            shading_normal: normal,
            ..*point
        };
        let own_steps = steps.map(|step| to_own.transform_vector3(step));
        let Changes { uv, normal: changes } = self.shape.changes(face, [0.0; 2], &own, own_steps);
        let turned = |normal: DVec3| self.placement.normal(normal);
        Changes { uv, normal: differential::normalized(turned(normal), changes.map(turned)) }
    }

    /// Returns the texture coordinates as functions of scene space.
    pub(super) fn extensions(&self, position: DVec3, steps: [DVec3; 2]) -> Option<[Extension; 2]> {
        let to_own = self.placement.to_own();
        let own_steps = steps.map(|step| to_own.transform_vector3(step));
        let own = self.shape.extensions(to_own.transform_point3(position), own_steps)?;
        Some(own.map(|own| own.seen_from(|vector| to_own.matrix3.transpose() * vector)))
    }

    /// Lower and upper corner of the bounding box, in scene space.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let to_scene = self.placement.to_scene();
        let [low, high] = match &*self.shape {
            // The half-width of an ellipsoid along an axis is the length of the map's row times the
            // radius.
            Shape::Sphere(sphere) => {
                let rows = to_scene.matrix3.transpose();
                let rows = [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec3::length);
                let reach = sphere.radius * DVec3::from(rows);
                let middle = to_scene.transform_point3(sphere.center);
                [middle - reach, middle + reach]
            }
            shape @ (Shape::Quad(_)
            | Shape::Mesh(_)
            | Shape::Cuboid(_)
            | Shape::Superquadric(_)
            | Shape::Placed(_)
            | Shape::Instance(_)) => {
                self.placement.bounds(shape.bounds().unwrap_or([DVec3::ZERO; 2]))
            }
        };
        let widening = ROUNDINGS * f64::EPSILON * self.extent();
        [low - widening, high + widening]
    }

    /// Largest absolute value of the coordinates from which the shape's points are computed.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let own = DVec3::splat(self.shape.extent());
        let [low, high] = self.placement.bounds([-own, own]);
        low.abs().max(high.abs()).max_element()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Cuboid, Quad, Sphere, Superquadric};
    use glam::{DAffine3, DMat3, DVec2};
    use proptest::prelude::*;

    const FREE: Start = Start { left_face: None, skin: 0.0 };

    fn vector(size: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-size..size).prop_map(DVec3::from)
    }

    /// Rotated, sheared, stretched, mirrored and moved placements, not flatter than a hundredth.
    fn placement() -> impl Strategy<Value = Placement> {
        let linear = (vector(2.0), vector(2.0), vector(2.0));
        (linear, vector(10.0)).prop_filter_map("not flat", |((x, y, z), shift)| {
            let linear = DMat3::from_cols(x, y, z);
            let thick = linear.determinant().abs() > 0.01;
            thick.then(|| Placement::new(DAffine3::from_mat3_translation(linear, shift)).unwrap())
        })
    }

    fn solid() -> impl Strategy<Value = Shape> {
        let center = DVec3::new(0.1, -0.3, 0.2);
        let superquadric = (0.1..3.0f64, 0.1..3.0f64).prop_map(move |(e1, e2)| {
            let radii = DVec3::new(0.6, 0.9, 1.1);
            Shape::Superquadric(Superquadric::new(center, radii, [e1, e2], None).unwrap())
        });
        let cuboid = Cuboid::new(DVec3::new(-1.0, -0.5, -0.8), DVec3::new(0.7, 0.9, 1.0)).unwrap();
        prop_oneof![
            Just(Shape::Sphere(Sphere { center, radius: 0.8 })),
            Just(Shape::Cuboid(cuboid)),
            superquadric,
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// A hit on a placed shape equals the hit of the transformed ray on the shape, transformed
        /// back. Its normal is perpendicular to the surface and points out, also after mirroring. A
        /// ray that leaves the surface does not meet its start.
        #[test]
        fn a_hit_lies_on_the_placed_surface(
            solid in solid(), placement in placement(), from in vector(30.0), aim in vector(0.6),
        ) {
            let Ok(shape) = solid.clone().placed(&placement) else { unreachable!() };
            let target = placement.to_scene().transform_point3(aim);
            let direction = (target - from).normalize();
            prop_assume!(from.distance(target) > 12.0);
            let Some((t, face)) = shape.intersect(from, direction, FREE) else { return Ok(()) };
            let point = shape.surface_point(face, [0.0; 2], from + t * direction);
            let back = placement.to_own().transform_point3(point.position);
            let own = solid.surface_point(face, [0.0; 2], back);
            // The tolerance is a hundred roundings of coordinates up to 40, which the inverse map
            // magnifies a hundred times at most.
            prop_assert!(own.position.distance(back) < 1e-10, "{} {back}", own.position);
            // Longitudes near a pole magnify the rounding further, by up to a thousand times.
            prop_assert!((own.uv - point.uv).abs().max_element() < 1e-6 || own.uv.y > 0.99 || own.uv.y < 0.01
                || (own.uv.x - point.uv.x).abs() > 0.99);
            prop_assert!(point.position.distance(from + t * direction) < 1e-9);

            let normal = point.geometric_normal;
            prop_assert!((normal.length() - 1.0).abs() < 1e-14);
            let (a, b) = own.geometric_normal.any_orthonormal_pair();
            for tangent in [a, b].map(|own| placement.to_scene().transform_vector3(own)) {
                prop_assert!(normal.dot(tangent.normalize()).abs() < 1e-9);
            }
            let outward = placement.to_own().transform_vector3(normal).dot(own.geometric_normal);
            prop_assert!(outward > 0.0, "{outward}");

            let [low, high] = shape.bounds().unwrap();
            prop_assert!(point.position.cmpge(low).all() && point.position.cmple(high).all());
            prop_assert!(shape.extent() >= point.position.abs().max_element());

            // The rounding that the renderer uses.
            let skin = 64.0 * f64::EPSILON * (2.0 * shape.extent() + point.position.abs().max_element());
            let start = Start { left_face: Some(face), skin };
            let next = shape.intersect(point.position, normal, start);
            let convex = !matches!(&solid, Shape::Superquadric(_));
            prop_assert!(next.is_none() || !convex, "{next:?}");
            if let Some((t, face)) = shape.intersect(point.position, direction, start) {
                let there = shape.surface_point(face, [0.0; 2], point.position + t * direction);
                prop_assert!(t > skin && there.position.distance(point.position) > skin);
            }
        }

        /// A placed rectangle, and a placed plane, keep the point's texture coordinates and the
        /// outer side.
        #[test]
        fn a_placed_rectangle_keeps_its_picture_and_its_outside(
            placement in placement(), a in 0.0..1.0f64, b in 0.0..1.0f64, bounded in any::<bool>(),
        ) {
            let edges = [DVec3::new(1.0, 0.2, 0.0), DVec3::new(-0.1, 1.0, 0.3)];
            let quad = Quad::new(DVec3::ONE, edges[0], edges[1], DVec2::new(2.0, 3.0), bounded).unwrap();
            let moved = quad.placed(&placement).unwrap();
            let own = DVec3::ONE + a * edges[0] + b * edges[1];
            let point = moved.surface_point(placement.to_scene().transform_point3(own));
            prop_assert!(point.uv.abs_diff_eq(DVec2::new(2.0 * a, 3.0 * b), 1e-9), "{}", point.uv);
            let outward = quad.surface_point(own).geometric_normal;
            let above = placement.to_scene().transform_point3(own + outward) - point.position;
            prop_assert!(above.dot(point.geometric_normal) > 0.0);
        }
    }

    #[test]
    fn a_stretched_sphere_is_the_ellipsoid() {
        let radii = DVec3::new(2.0, 0.5, 3.0);
        let placement = Placement::new(DAffine3::from_scale(radii)).unwrap();
        let sphere = Shape::Sphere(Sphere { center: DVec3::ZERO, radius: 1.0 });
        let ellipsoid = sphere.placed(&placement).unwrap();
        for k in 0..1000 {
            let angle = f64::from(k) * 0.7;
            let from = DVec3::new(5.0 * angle.cos(), 4.0 * (0.3 * angle).sin(), 6.0 * angle.sin());
            let direction = (DVec3::new(0.3, 0.1, -0.4) - from).normalize();
            // Solves |(from + t direction) / radii| = 1 by the quadratic formula.
            let (o, d) = (from / radii, direction / radii);
            let (a, b, c) = (d.length_squared(), o.dot(d), o.length_squared() - 1.0);
            let truth = (-b - (b * b - a * c).sqrt()) / a;
            let (t, face) = ellipsoid.intersect(from, direction, FREE).unwrap();
            assert!((t - truth).abs() < 1e-12, "{t} {truth}");
            let point = ellipsoid.surface_point(face, [0.0; 2], from + t * direction);
            let normal = (point.position / (radii * radii)).normalize();
            assert!(point.geometric_normal.abs_diff_eq(normal, 1e-12));
        }
        let bounds = ellipsoid.bounds().unwrap();
        assert!(bounds[1].abs_diff_eq(radii, 1e-13) && bounds[1].cmpge(radii).all());
    }
}
