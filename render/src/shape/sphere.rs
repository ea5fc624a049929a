//! The sphere as a shape.

use super::gradient_changes::Extension;
use super::{Changes, SurfacePoint};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A sphere with its poles along y.
///
/// Texture coordinates: `u` is the longitude, [0, 1], increasing eastward (from +z towards +x). It
/// is one half at +z and has its seam at -z. `v` is the latitude, 0 at the south pole (-y) and 1 at
/// the north pole. A map is not mirrored as seen from outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Centre of the sphere, in scene units.
    pub center: DVec3,
    /// Radius of the sphere, in scene units, positive.
    pub radius: f64,
}

impl Sphere {
    /// Returns the nearest distance above 0 at which the ray meets the sphere. `direction` is unit.
    ///
    /// If the ray starts within `skin` of the sphere, or `leaves` it, the start is one root. The
    /// other root is then computed without cancellation, and it counts if it is beyond the skin.
    #[must_use]
    pub fn intersect(
        &self,
        origin: DVec3,
        direction: DVec3,
        leaves: bool,
        skin: f64,
    ) -> Option<f64> {
        // Lengths are in units of the radius, whose square may leave the range of numbers.
        let to_center = (self.center - origin) / self.radius;
        let along = to_center.dot(direction);
        // |d^2 - 1| is twice the distance |d - 1| from the surface.
        let off = to_center.length_squared() - 1.0;
        if leaves || off.abs() < 2.0 * (skin / self.radius) {
            let far = 2.0 * along * self.radius;
            return (far > skin).then_some(far);
        }
        // The vector from the centre to the ray gives their distance without cancellation far away.
        let aside = to_center - along * direction;
        let half_chord_sq = 1.0 - aside.length_squared();
        if half_chord_sq < 0.0 {
            return None;
        }
        let half_chord = half_chord_sq.sqrt();
        let roots = [along - half_chord, along + half_chord].map(|t| t * self.radius);
        roots.into_iter().find(|&t| t > 0.0)
    }

    /// Returns the unit normal at a hit, outward. `near` is the hit as computed along the ray.
    #[must_use]
    pub fn normal(&self, near: DVec3) -> DVec3 {
        ((near - self.center) / self.radius).normalize()
    }

    /// Returns the surface point at a hit. `near` is the hit as computed along the ray.
    #[must_use]
    pub fn surface_point(&self, near: DVec3) -> SurfacePoint {
        let normal = self.normal(near);
        let longitude = 0.5 - f64::atan2(-normal.x, normal.z) / TAU;
        let latitude = 0.5 + normal.y.clamp(-1.0, 1.0).asin() / PI;
        SurfacePoint {
            position: self.center + self.radius * normal,
            geometric_normal: normal,
            shading_normal: normal,
            uv: DVec2::new(longitude, latitude),
            part: 0,
        }
    }

    /// Returns the gradients of the texture coordinates at a point of the sphere. Both are zero at
    /// a pole.
    #[must_use]
    pub fn uv_gradients(&self, position: DVec3) -> [DVec3; 2] {
        let normal = (position - self.center).normalize_or_zero();
        let Some(east) = DVec3::Y.cross(normal).try_normalize() else { return [DVec3::ZERO; 2] };
        let north = normal.cross(east);
        let parallel = self.radius * normal.x.hypot(normal.z);
        [east / (TAU * parallel), north / (PI * self.radius)]
    }

    /// Returns changes as [`Shape::changes`](super::Shape::changes) does, where the outward unit
    /// normal is `normal`. Those of the texture coordinates are zero at a pole.
    #[must_use]
    pub fn changes(&self, normal: DVec3, steps: [DVec3; 2]) -> Changes {
        let DVec3 { x, z, .. } = normal;
        let parallel_sq = x * x + z * z;
        let changes = steps.map(|step| step / self.radius);
        let uv = if parallel_sq > 0.0 {
            let (around, up) = (TAU * parallel_sq, PI * parallel_sq.sqrt());
            changes.map(|n| DVec2::new((z * n.x - x * n.z) / around, n.y / up))
        } else {
            [DVec2::ZERO; 2]
        };
        Changes { uv, normal: changes }
    }

    /// Returns the texture coordinates as functions of space.
    pub(super) fn extensions(&self, position: DVec3, steps: [DVec3; 2]) -> [Extension; 2] {
        let point = position - self.center;
        let (distance, bends) = Extension::from_axis(point, steps);
        [Extension::around(point, steps, TAU), Extension::up(point.y, distance, bends, steps, PI)]
    }

    /// Returns the period of the texture coordinates, which jump by 1 across the seam meridian.
    #[must_use]
    pub fn seam(&self) -> super::SeamPeriod {
        DVec2::new(1.0, 0.0)
    }

    /// Lower and upper corner of the bounding box.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        [self.center - self.radius, self.center + self.radius]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UNIT: Sphere = Sphere { center: DVec3::ZERO, radius: 1.0 };

    #[test]
    fn a_ray_through_the_centre_meets_both_sides() {
        let origin = DVec3::new(0.0, 0.0, 3.0);
        assert_eq!(UNIT.intersect(origin, DVec3::NEG_Z, false, 0.0), Some(2.0));
        assert_eq!(UNIT.intersect(DVec3::ZERO, DVec3::X, false, 0.0), Some(1.0));
        assert_eq!(UNIT.intersect(origin, DVec3::Z, false, 0.0), None);
    }

    #[test]
    fn a_map_seen_from_outside_is_not_mirrored() {
        let middle = UNIT.surface_point(DVec3::Z).uv;
        let right = UNIT.surface_point(DVec3::new(0.1, 0.0, 1.0)).uv;
        let up = UNIT.surface_point(DVec3::new(0.0, 0.1, 1.0)).uv;
        assert!(right.x > middle.x && up.y > middle.y);
        assert_eq!(middle, DVec2::new(0.5, 0.5));
    }

    proptest! {
        /// The far hit of a ray that leaves a sphere lies on the sphere, however large or far it
        /// is.
        #[test]
        fn a_ray_that_leaves_lands_on_the_sphere(
            center in prop::array::uniform3(-1e6..1e6f64), log_radius in -3.0..6.0f64,
            from in prop::array::uniform3(-1.0..1.0f64), to in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let sphere = Sphere { center: center.into(), radius: 10f64.powf(log_radius) };
            let (from, to) = (DVec3::from(from), DVec3::from(to));
            prop_assume!(from.length() > 0.1 && to.length() > 0.1 && from.angle_between(to) > 0.3);
            let start = sphere.surface_point(sphere.center + from).position;
            let target = sphere.surface_point(sphere.center + to).position;
            let direction = (target - start).normalize();
            let t = sphere.intersect(start, direction, true, 0.0).unwrap();
            let miss = (start + t * direction).distance(target);
            // A few roundings of the coordinates, which a chord of 0.3 rad magnifies sevenfold.
            let rounding = f64::EPSILON * (sphere.center.abs().max_element() + sphere.radius);
            prop_assert!(miss <= 64.0 * rounding, "{miss} against {rounding}");
        }
    }
}
