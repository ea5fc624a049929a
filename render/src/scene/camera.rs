//! The camera, which turns positions on the film into rays.

use crate::differential::{self, RayDifferential};
use crate::ray::Ray;
use glam::{DVec2, DVec3};

/// Sine of the angle between `up` and the view below which both count as parallel. A smaller number
/// would leave few digits for the direction across. A larger number would refuse valid cameras.
const PARALLEL: f64 = 1e-9;

/// A pinhole camera.
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
    /// Half the picture's height at distance 1, positive.
    half_height: f64,
}

impl Camera {
    /// Creates a camera at `eye` that looks at `target`. `field_of_view` is the angle between the
    /// lower and the upper edge of the picture, in radians, in (0, pi). Returns `None` if the eye is
    /// at the target, or if `up` points along the view.
    #[must_use]
    pub fn new(eye: DVec3, target: DVec3, up: DVec3, field_of_view: f64) -> Option<Self> {
        let forward = (target - eye).try_normalize()?;
        let across = forward.cross(up.try_normalize()?);
        if across.length() < PARALLEL {
            return None;
        }
        let right = across.normalize();
        let half_height = (0.5 * field_of_view).tan();
        Some(Self { eye, right, up: right.cross(forward), forward, half_height })
    }

    /// Position of the camera, in scene space.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// Returns the ray through a position on a film of `size` pixels.
    #[must_use]
    pub fn ray(&self, position: DVec2, size: DVec2) -> Ray {
        Ray::from_eye(self.eye, self.toward(position, size).normalize())
    }

    /// Returns the differential of [`Camera::ray`] for a step of `step` pixels across and down the
    /// film.
    #[must_use]
    pub fn differential(&self, position: DVec2, size: DVec2, step: f64) -> RayDifferential {
        let per_step = 2.0 * step / size.y * self.half_height;
        let changes = [per_step * self.right, -per_step * self.up];
        let direction = differential::normalized(self.toward(position, size), changes);
        RayDifferential { origin: [DVec3::ZERO; 2], direction }
    }

    /// Returns the vector from the eye to a position on the film at distance 1.
    fn toward(&self, position: DVec2, size: DVec2) -> DVec3 {
        let x = (2.0 * position.x - size.x) / size.y * self.half_height;
        let y = (size.y - 2.0 * position.y) / size.y * self.half_height;
        self.forward + x * self.right + y * self.up
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
    fn a_view_without_direction_is_refused() {
        let camera = |target, up| Camera::new(DVec3::ZERO, target, up, 1.0);
        assert!(camera(DVec3::ZERO, DVec3::Y).is_none());
        assert!(camera(DVec3::Y, DVec3::Y).is_none());
        assert!(camera(DVec3::X, DVec3::ZERO).is_none());
    }
}
