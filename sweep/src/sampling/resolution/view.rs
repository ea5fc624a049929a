//! Size of a pixel at a point seen by a camera.

use crate::curve::vector::LEAST_SINE;
use glam::DVec3;

/// Factor by which a pixel may be larger outside the picture. A surface not seen directly may be seen in a
/// mirror or cast a shadow, where sixteen pixels are coarse but still show its shape.
const UNSEEN: f64 = 16.0;

/// Factor by which the seen region exceeds the picture, for cells that reach into the picture.
const MARGIN: f64 = 1.1;

/// Least distance from the eye, as a fraction of the distance to the target. Without it, a surface through
/// the eye would need pixels of no size.
const NEAREST: f64 = 1e-3;

/// A pinhole camera and the size of its picture, as in a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    eye: DVec3,
    /// Unit axis of the view to the right.
    right: DVec3,
    /// Unit axis of the view upward.
    up: DVec3,
    /// Unit axis of the view forward.
    forward: DVec3,
    /// Half the picture's width and height at distance 1 from the eye.
    half: [f64; 2],
    /// Side of a pixel at distance 1 from the eye.
    pixel: f64,
    /// Least distance from the eye for the size of a pixel, in the unit of length.
    nearest: f64,
}

impl View {
    /// Returns a camera at `eye` that looks at `target`. `field_of_view` is the angle in radians between the
    /// lower and the upper edge of a picture of `size` pixels, `[width, height]`. `None` if the eye is at the
    /// target or `up` is parallel to the view.
    #[must_use]
    pub fn new(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        field_of_view: f64,
        size: [u32; 2],
    ) -> Option<Self> {
        let forward = (target - eye).try_normalize()?;
        let across = forward.cross(up.try_normalize()?);
        // An up vector this close to the view leaves no correct digits for the direction across.
        if across.length() < LEAST_SINE {
            return None;
        }
        let right = across.normalize();
        let [width, height] = size.map(f64::from);
        let half_height = (0.5 * field_of_view).tan();
        Some(Self {
            eye,
            right,
            up: right.cross(forward),
            forward,
            half: [half_height * width / height, half_height],
            pixel: 2.0 * half_height / height,
            nearest: NEAREST * (target - eye).length(),
        })
    }

    /// Returns the side of a pixel at a point, in the unit of length. Behind the eye and outside the picture
    /// it is sixteen times the side at the point's distance.
    #[must_use]
    pub fn pixel_at(&self, point: DVec3) -> f64 {
        let to = point - self.eye;
        let depth = to.dot(self.forward);
        let within = |axis: DVec3, half: f64| to.dot(axis).abs() <= MARGIN * half * depth;
        if depth > 0.0 && within(self.right, self.half[0]) && within(self.up, self.half[1]) {
            self.pixel * depth.max(self.nearest)
        } else {
            UNSEEN * self.pixel * to.length().max(self.nearest)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_grow_with_depth_and_are_coarse_where_nothing_is_seen() {
        let eye = DVec3::new(0.0, 0.0, 5.0);
        let view = |up| View::new(eye, DVec3::ZERO, up, 90f64.to_radians(), [200, 100]);
        let view = view(DVec3::Y).unwrap();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-14 * b;
        assert!(near(view.pixel_at(DVec3::ZERO), 0.1));
        assert!(near(view.pixel_at(DVec3::new(9.9, 4.9, 0.0)), 0.1), "depth, not distance");
        assert!(near(view.pixel_at(DVec3::Z * -5.0), 0.2));
        assert!(near(view.pixel_at(DVec3::Z * 10.0), 1.6), "behind the eye");
        assert!(view.pixel_at(DVec3::Y * 6.0) > 1.6, "above the picture");
        assert!(view.pixel_at(eye) > 0.0);
        assert_eq!(View::new(eye, eye, DVec3::Y, 1.0, [1, 1]), None);
        assert_eq!(View::new(eye, DVec3::ZERO, DVec3::Z, 1.0, [1, 1]), None);
    }
}
