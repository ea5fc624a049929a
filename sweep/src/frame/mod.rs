//! Frames: a point on a curve with two directions across the curve, carried along it.
//!
//! ```text
//!        w2 ^   contour (x, y) lies on (w1, w2);
//!           |   w1 x w2 = T, which points at the reader
//!           |
//!           T-------> w1
//! ```
//!
//! A frame is carried from one point to the next by double reflection (W. Wang, B. Juettler, D. Zheng, Y.
//! Liu, "Computation of rotation minimizing frames", 2008). One reflection takes the first point to the
//! second. Another takes the reflected tangent to the tangent at the second point. With exact tangents the
//! global error is of order 4 in the step. With chords instead of tangents it would be of order 2, so curves
//! supply their exact tangents. [`Frames`] are the frames along a whole curve; [`Directed`] are frames that a
//! direction fixes instead.

mod along;
mod directed;

pub use along::Frames;
pub use directed::{Directed, Lack};

use crate::curve::Local3;
use crate::curve::vector::LEAST_SINE;
use glam::{DVec2, DVec3};

/// Cosines that differ by less than this number are equal. With a larger number, axes that differ
/// visibly would count as equally aligned. With a smaller number, rounding of the tangent would
/// choose between equally aligned axes.
const EQUALLY_ALIGNED: f64 = 1e-6;

/// A point on a curve with the tangent and two directions across it, three orthogonal unit vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The point on the curve, in the unit of length.
    pub origin: DVec3,
    /// Direction of the curve, `T`.
    pub tangent: DVec3,
    /// Direction of the contour's x, `w1`.
    pub normal: DVec3,
    /// Direction of the contour's y, `w2`; `w1 x w2 = T`.
    pub binormal: DVec3,
}

impl Frame {
    /// Returns the frame at `local` whose `w1` is nearest to `direction`, which may have any length.
    ///
    /// `None` if the direction is parallel to the tangent, to a sine of [`LEAST_SINE`].
    pub fn toward(local: &Local3, direction: DVec3) -> Option<Self> {
        let across = direction - local.tangent * direction.dot(local.tangent);
        let normal = across.try_normalize()?;
        // This close to the tangent, cancellation leaves no correct digits of the direction.
        (across.length() > LEAST_SINE * direction.length()).then(|| Self::new(local, normal))
    }

    /// Returns the frame whose `w1` is nearest to the coordinate axis least aligned with the tangent.
    ///
    /// Among axes that are equally aligned, x comes before y and y before z. A line along z has its contour
    /// on (x, y), one along y on (x, -z), one along x on (y, z).
    pub fn seed(local: &Local3) -> Self {
        let aligned = local.tangent.abs();
        // Rounding must not choose between equally aligned axes.
        let least = aligned.min_element() + EQUALLY_ALIGNED;
        let axis = if aligned.x <= least {
            DVec3::X
        } else if aligned.y <= least {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let across = axis - local.tangent * axis.dot(local.tangent);
        Self::new(local, across.normalize())
    }

    fn new(local: &Local3, normal: DVec3) -> Self {
        let binormal = local.tangent.cross(normal);
        Self { origin: local.position, tangent: local.tangent, normal, binormal }
    }

    /// Returns this frame carried to `local` by one double reflection.
    fn carried_to(&self, local: &Local3) -> Self {
        let chord = local.position - self.origin;
        // A chord that is not along the curve is pure rounding, between two points that coincide. Reflection
        // in it could mirror the frame, so the limit of short chords replaces it.
        let mean = self.tangent + local.tangent;
        let along = chord.dot(mean).abs() > 0.5 * chord.length() * mean.length();
        let chord = if along { chord } else { mean };
        let reflected = |v: DVec3| v - chord * (2.0 * chord.dot(v) / chord.length_squared());
        let (normal, tangent) = (reflected(self.normal), reflected(self.tangent));
        let second = local.tangent - tangent;
        let length_sq = second.length_squared();
        let normal = if length_sq > 0.0 {
            normal - second * (2.0 * second.dot(normal) / length_sq)
        } else {
            normal
        };
        // Rounding errors accumulate over many steps, so each step removes its own.
        let across = normal - local.tangent * normal.dot(local.tangent);
        Self::new(local, across.try_normalize().unwrap_or(self.normal))
    }

    /// Returns the frame turned about its tangent by `angle` radians, from `w1` toward `w2`.
    fn turned(&self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self {
            normal: self.normal * cos + self.binormal * sin,
            binormal: self.binormal * cos - self.normal * sin,
            ..*self
        }
    }

    /// Returns the components of a vector on `(w1, w2)`.
    pub(crate) fn across(&self, direction: DVec3) -> DVec2 {
        DVec2::new(direction.dot(self.normal), direction.dot(self.binormal))
    }

    /// Returns the angle about the tangent from `w1` to `direction`, in radians from -pi to pi.
    fn angle_to(&self, direction: DVec3) -> f64 {
        direction.dot(self.binormal).atan2(direction.dot(self.normal))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seed_is_the_axis_least_aligned() {
        let seed = |tangent: DVec3| {
            let local = Local3::straight(DVec3::ZERO, tangent);
            let frame = Frame::seed(&local);
            (frame.normal, frame.binormal)
        };
        assert_eq!(seed(DVec3::Z), (DVec3::X, DVec3::Y));
        assert_eq!(seed(DVec3::Y), (DVec3::X, DVec3::NEG_Z));
        assert_eq!(seed(DVec3::X), (DVec3::Y, DVec3::Z));
        assert_eq!(seed(DVec3::new(1e-9, 1.0, 0.0).normalize()).1.z, -1.0);
    }

    #[test]
    fn a_direction_along_the_curve_gives_no_frame() {
        let tangent = DVec3::new(0.6, 0.0, 0.8);
        let local = Local3::straight(DVec3::ONE, tangent);
        assert!(Frame::toward(&local, local.tangent * 3.0).is_none());
        assert!(Frame::toward(&local, DVec3::ZERO).is_none());
    }

    #[test]
    fn rounding_of_a_point_does_not_mirror_the_frame() {
        let at = |position| Local3::straight(position, DVec3::X);
        let frame = Frame::toward(&at(DVec3::ONE), DVec3::Y).unwrap();
        for off in [DVec3::Y, DVec3::new(1e-3, 1.0, 0.0), DVec3::new(1.0, 1.0, 1.0)] {
            let moved = frame.carried_to(&at(DVec3::ONE + off * 4.0 * f64::EPSILON));
            assert!((moved.normal - DVec3::Y).length() < 1e-15, "{off}");
        }
    }

    #[test]
    fn a_point_that_stays_turns_the_frame_with_its_tangent() {
        let local = |tangent| Local3::straight(DVec3::ONE, tangent);
        let frame = Frame::toward(&local(DVec3::X), DVec3::Y).unwrap();
        let turned = frame.carried_to(&local(DVec3::Y));
        assert!((turned.normal - DVec3::NEG_X).length() < 1e-15);
    }
}
