//! The camera, which turns positions on the film into rays.

use crate::differential::{self, RayDifferential};
use crate::ray::Ray;
use glam::{DVec2, DVec3};

/// Sine of the angle between `up` and the view below which both count as parallel. A smaller number
/// would leave few digits for the direction across. A larger number would refuse valid cameras.
const PARALLEL: f64 = 1e-9;

/// A pinhole camera, or an orthographic one, whose rays are parallel.
///
/// ```text
///   film, in pixels        (0, 0) is the upper left corner of the picture,
///   +------> x             pixel (i, j) covers [i, i+1) x [j, j+1);
///   |                      positions outside the picture have rays too
///   v y
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    eye: DVec3,
    /// Unit axes of the view: to the right, up, and forward.
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Half the picture's height, positive: at distance 1 of a pinhole camera, and at any distance of an
    /// orthographic one.
    half_height: f64,
    is_orthographic: bool,
}

impl Camera {
    /// Creates a camera at `eye` that looks at `target`. `field_of_view` is the angle between the
    /// lower and the upper edge of the picture, in radians, in (0, pi). Returns `None` if the eye is
    /// at the target, or if `up` points along the view.
    #[must_use]
    pub fn new(eye: DVec3, target: DVec3, up: DVec3, field_of_view: f64) -> Option<Self> {
        Self::with(eye, target, up, (0.5 * field_of_view).tan(), false)
    }

    /// Creates an orthographic camera whose picture is `height` scene units high, positive. Rays start in
    /// the plane through the eye across the view. Returns `None` as [`Camera::new`] does.
    #[must_use]
    pub fn orthographic(eye: DVec3, target: DVec3, up: DVec3, height: f64) -> Option<Self> {
        Self::with(eye, target, up, 0.5 * height, true)
    }

    fn with(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        half_height: f64,
        is_orthographic: bool,
    ) -> Option<Self> {
        let forward = (target - eye).try_normalize()?;
        let across = forward.cross(up.try_normalize()?);
        if across.length() < PARALLEL {
            return None;
        }
        let right = across.normalize();
        let up = right.cross(forward);
        Some(Self { eye, right, up, forward, half_height, is_orthographic })
    }

    /// Position of the camera, in scene space.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// Returns whether rays are parallel.
    #[must_use]
    pub fn is_orthographic(&self) -> bool {
        self.is_orthographic
    }

    /// Returns the distance from the start of a ray through a point to the point, in scene units.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        let from = point - self.eye;
        if self.is_orthographic { from.dot(self.forward) } else { from.length() }
    }

    /// Returns the ray through a position on a film of `size` pixels.
    #[must_use]
    pub fn ray(&self, position: DVec2, size: DVec2) -> Ray {
        if self.is_orthographic {
            return Ray::from_eye(self.eye + self.across(position, size), self.forward);
        }
        Ray::from_eye(self.eye, (self.forward + self.across(position, size)).normalize())
    }

    /// Returns the differential of [`Camera::ray`] for a step of `step` pixels across and down the
    /// film.
    #[must_use]
    pub fn differential(&self, position: DVec2, size: DVec2, step: f64) -> RayDifferential {
        let per_step = 2.0 * step / size.y * self.half_height;
        let changes = [per_step * self.right, -per_step * self.up];
        if self.is_orthographic {
            return RayDifferential { origin: changes, direction: [DVec3::ZERO; 2] };
        }
        let toward = self.forward + self.across(position, size);
        let direction = differential::normalized(toward, changes);
        RayDifferential { origin: [DVec3::ZERO; 2], direction }
    }

    /// Returns the vector from the middle of the film to a position on it. The film of a pinhole camera
    /// is at distance 1.
    fn across(&self, position: DVec2, size: DVec2) -> DVec3 {
        let x = (2.0 * position.x - size.x) / size.y * self.half_height;
        let y = (size.y - 2.0 * position.y) / size.y * self.half_height;
        x * self.right + y * self.up
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_is_upright_and_not_mirrored() {
        let eye = DVec3::new(0.0, 0.0, 5.0);
        let camera = Camera::new(eye, DVec3::ZERO, DVec3::Y, 90f64.to_radians()).unwrap();
        let size = DVec2::new(200.0, 100.0);
        let middle = camera.ray(DVec2::new(100.0, 50.0), size).direction;
        assert!(middle.abs_diff_eq(DVec3::NEG_Z, 1e-15));
        let upper_right = camera.ray(DVec2::new(200.0, 0.0), size).direction;
        assert!(upper_right.abs_diff_eq(DVec3::new(2.0, 1.0, -1.0).normalize(), 1e-15));
    }

    #[test]
    fn an_orthographic_camera_has_parallel_rays_and_pixels_of_one_size() {
        let eye = DVec3::new(1.0, 2.0, 5.0);
        let camera = Camera::orthographic(eye, eye - DVec3::Z, DVec3::Y, 3.0).unwrap();
        let size = DVec2::new(200.0, 100.0);
        let corner = camera.ray(DVec2::new(200.0, 0.0), size);
        assert!(corner.origin.abs_diff_eq(DVec3::new(4.0, 3.5, 5.0), 1e-15));
        assert_eq!(corner.direction, DVec3::NEG_Z);
        assert_eq!(camera.distance(DVec3::new(7.0, -3.0, 1.0)), 4.0);
        let here = DVec2::new(31.0, 77.0);
        let RayDifferential { origin, direction } = camera.differential(here, size, 0.5);
        assert_eq!(direction, [DVec3::ZERO; 2]);
        for (change, step) in origin.into_iter().zip([DVec2::X, DVec2::Y]) {
            let moved = camera.ray(here + 0.5 * step, size).origin - camera.ray(here, size).origin;
            assert!(change.abs_diff_eq(moved, 1e-15), "{change} {moved}");
        }
    }

    #[test]
    fn a_view_without_direction_is_refused() {
        let camera = |target, up| Camera::new(DVec3::ZERO, target, up, 1.0);
        assert!(camera(DVec3::ZERO, DVec3::Y).is_none());
        assert!(camera(DVec3::Y, DVec3::Y).is_none());
        assert!(camera(DVec3::X, DVec3::ZERO).is_none());
    }
}
