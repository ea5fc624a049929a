//! Rays against boxes along the axes.
//!
//! The hit function and every structure use this one test. The test is monotone: each of its steps
//! rounds, but rounding keeps order. A ray therefore crosses a box for at least as long as any box
//! inside it, and a structure never loses a piece whose own box the ray crosses.
//!
//! The triangle test works on coordinates relative to the ray's origin and is inexact by their
//! rounding. A ray that misses a box by this error may still hit a triangle in the box. Boxes are
//! therefore widened, for each ray, by a bound on the error.

use glam::{DVec3, DVec4};

/// A ray prepared for tests against boxes.
#[derive(Debug, Clone, Copy)]
pub struct SlabRay {
    /// Start of the ray.
    pub origin: DVec3,
    /// Direction of the ray, a unit vector.
    pub direction: DVec3,
    /// One over the direction; where a component is zero, a huge number of its sign.
    pub inverse: DVec3,
    /// The largest absolute coordinate of the origin and of all boxes. Roundings are parts of it.
    pub scale: f64,
    /// The origin moved up and down by the widening, which is equivalent to widening every box.
    above: DVec3,
    below: DVec3,
}

impl SlabRay {
    /// Components of a direction up to this size are treated as zero, since their inverse would
    /// overflow.
    pub const ZERO: f64 = 1e-300;

    /// Widening of boxes, as a part of the scale.
    ///
    /// Shearing rounds each coordinate four times. The bound is twice that, and three roundings of the box
    /// test.
    pub const WIDENING: f64 = 16.0 * f64::EPSILON;

    /// Bound of [`SlabRay::slack`], as a part of the scale: twice the widening along the ray, and the
    /// roundings of the distances.
    pub const SLACK: f64 = 64.0 * f64::EPSILON;

    /// Prepares the ray for boxes whose absolute coordinates are at most `extent`.
    #[must_use]
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3, extent: f64) -> Self {
        // A zero component gets a huge finite inverse: no product is NaN, even on a box's face.
        let inverse = DVec3::select(
            direction.abs().cmpgt(DVec3::splat(Self::ZERO)),
            direction.recip(),
            DVec3::splat(Self::ZERO.recip()).copysign(direction),
        );
        let scale = origin.abs().max_element() + extent;
        let widening = Self::WIDENING * scale;
        let (above, below) = (origin + widening, origin - widening);
        Self { origin, direction, inverse, scale, above, below }
    }

    /// Returns a bound on the error of distances to planes across the direction's largest component,
    /// in scene units.
    #[must_use]
    pub fn slack(&self) -> f64 {
        Self::SLACK * self.scale
    }

    /// Returns the distances at which the ray enters and leaves the box, from its start on, or
    /// `None` if the ray does not meet it.
    #[must_use]
    #[inline]
    pub fn crosses(&self, [low, high]: [DVec3; 2]) -> Option<[f64; 2]> {
        self.crosses_padded([low.extend(0.0), high.extend(f64::INFINITY)])
    }

    /// Returns the distances as [`SlabRay::crosses`] does. The fourth components of the corners are 0
    /// and infinity: the half line from the start on.
    #[must_use]
    #[inline(always)]
    pub fn crosses_padded(&self, [low, high]: [DVec4; 2]) -> Option<[f64; 2]> {
        let inverse = self.inverse.extend(1.0);
        let low = (low - self.above.extend(0.0)) * inverse;
        let high = (high - self.below.extend(0.0)) * inverse;
        let enter = low.min(high).max_element();
        let leave = low.max(high).min_element();
        (enter <= leave).then_some([enter, leave])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_along_a_face_crosses_the_box_whatever_the_sign_of_its_zeros() {
        let unit = [DVec3::ZERO, DVec3::ONE];
        for zero in [0.0, -0.0] {
            for y in [0.0, -0.0, 0.5, 1.0] {
                let ray = SlabRay::new(DVec3::new(-1.0, y, 1.0), DVec3::new(1.0, zero, zero), 1.0);
                let [enter, leave] = ray.crosses(unit).unwrap();
                assert!((enter - 1.0).abs() < 1e-14 && (leave - 2.0).abs() < 1e-14);
            }
            let beside = DVec3::new(-1.0, -1e-9, 0.5);
            let ray = SlabRay::new(beside, DVec3::new(1.0, zero, zero), 1.0);
            assert_eq!(ray.crosses(unit), None);
        }
    }

    #[test]
    fn a_box_behind_the_ray_is_not_crossed_and_one_around_it_is_entered_at_once() {
        let behind = SlabRay::new(DVec3::new(3.0, 0.5, 0.5), DVec3::X, 1.0);
        assert_eq!(behind.crosses([DVec3::ZERO, DVec3::ONE]), None);
        let inside = SlabRay::new(DVec3::splat(0.25), DVec3::X, 1.0);
        assert_eq!(inside.crosses([DVec3::ZERO, DVec3::ONE]).unwrap()[0], 0.0);
    }
}
