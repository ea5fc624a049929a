//! The nearest camera of a given direction that sees a whole mesh.
//!
//! A corner p is on the film of an eye e if its distance to the right of e is at most t times its depth:
//! |(p - e) r| <= t (p - e) f. The same holds to the left, above and below. The largest p r - t p f and -p r - t p f over all corners
//! therefore limit the depth e f, and their difference gives e r. So two passes over the corners find the eye.

use super::direction;
use super::view::{Up, View};
use glam::DVec3;

/// Angle between the lower and the upper edge of the picture, in degrees. A larger angle would distort what is near.
pub const FOV_DEG: f64 = 30.0;

/// Part of the film that a mesh may fill across and down.
const FILLED: f64 = 0.84;

/// Least distance of the eye from the nearest corner, in radii. A long object that points at the camera would otherwise
/// be seen from too near.
const NEAREST: f64 = 1.0;

/// A sphere that contains a mesh: around the middle of its box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Middle of the box.
    pub center: DVec3,
    /// Distance of the farthest corner from the middle, above 0. A mesh that is a single point has a radius of 1.
    pub radius: f64,
}

impl Sphere {
    /// Returns the sphere around these corners; `None` if there are none.
    #[must_use]
    pub fn around(corners: impl Iterator<Item = DVec3> + Clone) -> Option<Self> {
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] =
            corners.clone().fold(empty, |[low, high], at| [low.min(at), high.max(at)]);
        if low.x > high.x {
            return None;
        }
        let center = low.midpoint(high);
        let radius = corners.map(|at| at.distance(center)).fold(0.0, f64::max);
        Some(Self { center, radius: if radius > 0.0 { radius } else { 1.0 } })
    }
}

/// The directions of a camera, unit vectors: to the right and up in the picture, and forward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// To the right.
    pub right: DVec3,
    /// Upwards.
    pub up: DVec3,
    /// Into the picture.
    pub forward: DVec3,
}

impl Frame {
    /// Returns the directions of a camera with this view.
    #[must_use]
    pub fn of(view: View, up: Up) -> Self {
        let axes = up.axes();
        let (azimuth, elevation) = (view.azimuth_deg.to_radians(), view.elevation_deg.to_radians());
        let forward = -direction(axes, azimuth, elevation);
        // The direction that the camera takes if its elevation grows.
        let up = direction(axes, azimuth, elevation + std::f64::consts::FRAC_PI_2);
        Self { right: forward.cross(up), up, forward }
    }

    /// Returns the eye of the nearest camera that sees all corners. `aspect` is the picture's width over its height.
    #[must_use]
    pub fn eye(&self, corners: impl Iterator<Item = DVec3>, sphere: &Sphere, aspect: f64) -> DVec3 {
        let half = (0.5 * FOV_DEG).to_radians().tan() * FILLED;
        let slopes = [half * aspect, half];
        let axes = [self.right, self.up];
        // The largest distance beyond each plane through the middle of the sphere.
        let mut most = [[f64::NEG_INFINITY; 2]; 2];
        let mut near = f64::INFINITY;
        for corner in corners {
            let at = corner - sphere.center;
            let depth = at.dot(self.forward);
            near = near.min(depth);
            for ((most, axis), slope) in most.iter_mut().zip(axes).zip(slopes) {
                let across = at.dot(axis);
                most[0] = most[0].max(across - slope * depth);
                most[1] = most[1].max(-across - slope * depth);
            }
        }
        let depths = most.iter().zip(slopes).map(|([a, b], slope)| -(a + b) / (2.0 * slope));
        let depth = depths.fold(near - NEAREST * sphere.radius, f64::min);
        let [across, above] = most.map(|[a, b]| 0.5 * (a - b));
        sphere.center + across * self.right + above * self.up + depth * self.forward
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    /// The place of a point on the film, where -1 to 1 is from edge to edge.
    fn on_film(frame: &Frame, eye: DVec3, aspect: f64, point: DVec3) -> DVec2 {
        let at = point - eye;
        let half = (0.5 * FOV_DEG).to_radians().tan() * at.dot(frame.forward);
        DVec2::new(at.dot(frame.right) / (half * aspect), at.dot(frame.up) / half)
    }

    #[test]
    fn a_mesh_fills_the_film_in_one_direction_and_is_in_its_middle_in_both() {
        for (size, offset) in [(1.0, 0.0), (1e-6, 5.0), (1e9, -3e9)] {
            let box_corners = (0..8).map(|k| {
                let bit = |b: i32| f64::from((k >> b) & 1);
                size * DVec3::new(bit(0), 2.5 * bit(1), 0.3 * bit(2)) + offset
            });
            for (aspect, view) in
                [(1.0, "30,20"), (2.0, "front"), (0.5, "top"), (1.0, "-120,-89"), (3.0, "left")]
            {
                let frame = Frame::of(view.parse().unwrap(), Up::Y);
                let sphere = Sphere::around(box_corners.clone()).unwrap();
                let eye = frame.eye(box_corners.clone(), &sphere, aspect);
                let places = box_corners.clone().map(|at| on_film(&frame, eye, aspect, at));
                let [low, high] = places
                    .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[l, h], at| {
                        [l.min(at), h.max(at)]
                    });
                assert!((high.max_element() - FILLED).abs() < 1e-6, "{view} {low} {high}");
                // The binding direction is filled on both sides.
                let filled = if high.x > high.y { [low.x, high.x] } else { [low.y, high.y] };
                assert!((filled[0] + filled[1]).abs() < 1e-6, "{view} {low} {high}");
                assert!(low.min_element() >= -FILLED - 1e-6, "{view} {low}");
            }
        }
    }

    #[test]
    fn a_camera_above_has_the_front_at_the_lower_edge() {
        let frame = Frame::of("top".parse().unwrap(), Up::Y);
        assert!(frame.up.abs_diff_eq(DVec3::NEG_Z, 1e-15), "{}", frame.up);
        assert!(frame.right.abs_diff_eq(DVec3::X, 1e-15));
    }

    #[test]
    fn a_point_is_seen_from_a_distance() {
        let point = [DVec3::new(1.0, 2.0, 3.0)];
        let sphere = Sphere::around(point.into_iter()).unwrap();
        let frame = Frame::of(View::default(), Up::Z);
        let eye = frame.eye(point.into_iter(), &sphere, 1.0);
        assert!((eye - point[0]).abs_diff_eq(-frame.forward, 1e-12), "{eye}");
        assert_eq!(Sphere::around(std::iter::empty()), None);
    }
}
