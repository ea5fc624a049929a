//! The coordinates of a tree, and rays prepared for one tree.
//!
//! Coordinates of a tree are `f32`, counted from a point near the tree in units of a power of two, so
//! that all lie in [-1, 1]. A ray is first moved to where it enters the tree, so that all of its
//! numbers are as small as the tree.
//!
//! **Nothing missed.** [`SlabRay::crosses`] and `Probe::settle` decide in `f64` about boxes and
//! triangles. The tests in `f32` only reject, and accept all of those. Boxes are rounded outwards
//! and widened by more than the roundings of the test. In units of `2^-24` these are 1 for the start,
//! 1 for its move by the widening, 1 for its product with the inverse, 2 for the inverse, 1 for the
//! product of the side, and 2 for the difference. Their sum is 8. The bound is 16. For the sheared
//! coordinates of a triangle they are 1 for the start, 1 for the corner, 2 for their difference, the
//! same 4 for the part that shearing adds, 2 for the shear, 1 for its product and 2 for the sum: 13.
//! Roundings in `f64` are added as parts of the ray's scale.

use super::slabs::SlabRay;
use crate::shape::triangle::ShearedRay;
use glam::{DVec3, Vec3, Vec3A};

/// Bound on the roundings of one coordinate, in units of a tree.
const ROUNDING: f64 = 16.0 / (1u32 << 24) as f64;

/// The coordinates of a tree.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// Origin of the coordinates, in scene space.
    pub middle: DVec3,
    /// The same point with -0 for 0. Unlike the sum with 0, the sum with -0 keeps the sign of -0.
    back: DVec3,
    /// Unit of the coordinates in scene units, a power of two.
    pub unit: f64,
    /// Units of the tree per scene unit.
    per_unit: f64,
}

impl Frame {
    /// The frame of boxes within `bounds`.
    #[must_use]
    pub fn around(bounds: [DVec3; 2]) -> Self {
        Self::at(0.5 * bounds[0] + 0.5 * bounds[1], bounds)
    }

    /// The frame of corners with coordinates in `f32` within `bounds`. Their coordinates in the frame
    /// are exact in `f32`, unless they are smaller than 2^-126 units.
    ///
    /// The difference of two numbers of which neither is more than twice the other is exact
    /// (Sterbenz). Where this does not hold for an axis, the origin is 0.
    #[must_use]
    pub fn exact(bounds: [DVec3; 2]) -> Self {
        let [low, high] = bounds.map(|corner| corner.to_array());
        let middle = [0, 1, 2].map(|axis| {
            let middle = f64::from((0.5 * (low[axis] + high[axis])) as f32);
            let (near, far) =
                if middle < 0.0 { (-high[axis], -low[axis]) } else { (low[axis], high[axis]) };
            let close = 2.0 * near >= middle.abs() && far <= 2.0 * middle.abs();
            if close { middle } else { 0.0 }
        });
        Self::at(DVec3::from(middle), bounds)
    }

    fn at(middle: DVec3, [low, high]: [DVec3; 2]) -> Self {
        let reach = (low - middle).abs().max((high - middle).abs()).max_element();
        let back = DVec3::select(middle.cmpeq(DVec3::ZERO), DVec3::splat(-0.0), middle);
        let unit = power_of_two(reach);
        Self { middle, back, unit, per_unit: unit.recip() }
    }

    /// Returns the smallest box of `f32` in the frame around a box in scene space.
    #[must_use]
    pub fn box_around(&self, [low, high]: [DVec3; 2]) -> [[f32; 3]; 2] {
        let down =
            |x: f64| if f64::from(x as f32) <= x { x as f32 } else { (x as f32).next_down() };
        let up = |x: f64| if f64::from(x as f32) >= x { x as f32 } else { (x as f32).next_up() };
        let low = (low - self.middle) * self.per_unit;
        let high = (high - self.middle) * self.per_unit;
        [low.to_array().map(down), high.to_array().map(up)]
    }

    /// Returns the coordinates of a corner in the frame.
    #[must_use]
    pub fn corner(&self, corner: [f32; 3]) -> [f32; 3] {
        let own = (DVec3::from(corner.map(f64::from)) - self.middle) * self.per_unit;
        own.as_vec3().to_array()
    }

    /// Returns the corner in scene space that has these coordinates.
    #[must_use]
    #[inline]
    pub fn scene(&self, own: [f32; 3]) -> DVec3 {
        // Both operations are exact where the coordinates in the frame are.
        Vec3::from(own).as_dvec3() * self.unit + self.back
    }
}

/// Returns the smallest power of two that is not less than `reach`, within the range in which the
/// inverse is finite; 1 for 0.
fn power_of_two(reach: f64) -> f64 {
    if reach == 0.0 {
        return 1.0;
    }
    let reach = reach.max(f64::MIN_POSITIVE);
    // Without its fraction, a number is the largest power of two that is not greater.
    let power = f64::from_bits(reach.to_bits() & (0x7ff << 52));
    let largest = 2f64.powi(1023);
    if power < reach && power < largest { 2.0 * power } else { power }
}

/// A ray prepared for the tests of one tree, in the tree's frame.
#[derive(Debug, Clone, Copy)]
pub struct TreeRay {
    /// Distance at which the ray enters the tree, in scene units; distances in the tree count from
    /// it.
    start: f64,
    /// Units of the tree per scene unit.
    per_unit: f64,
    /// Start of the ray in the tree.
    pub origin: [f32; 3],
    /// One over the direction; where a component is zero, a huge number of its sign.
    pub inverse: [f32; 3],
    /// The side of a box that the ray meets first, along each axis: 0 the lower, 1 the upper.
    pub near: [usize; 3],
    /// Start of the ray times the inverse, moved for the near sides so that they come nearer.
    pub near_start: [f32; 3],
    /// Start of the ray times the inverse, moved for the far sides so that they lie farther.
    pub far_start: [f32; 3],
    /// The axes of the sheared space: the last is that of the direction's largest component.
    pub axes: [usize; 3],
    /// Components of the direction along the first two axes, and 1, over that of the last.
    pub shear: [f32; 3],
    /// Bound on the error of sheared coordinates.
    pub rounding: f32,
}

impl TreeRay {
    /// Prepares a ray that enters the tree at the distance `start`.
    #[must_use]
    #[inline(always)]
    pub fn new(frame: &Frame, ray: &SlabRay, sheared: &ShearedRay, start: f64) -> Self {
        let per_unit = frame.per_unit;
        let rounding = (ROUNDING + 64.0 * f64::EPSILON * ray.scale * per_unit) as f32;
        // Beyond 8 every box is crossed. A start that is off by less lies in [-1, 1].
        let widening = rounding.min(8.0);
        let place = (ray.origin - frame.middle + start * ray.direction) * per_unit;
        let origin = place.as_vec3a().clamp(Vec3A::splat(-2.0), Vec3A::splat(2.0));
        // Where the clamp applies, the ray stays on one side of all planes in the tree.
        let inverse = ray.inverse.as_vec3a().clamp(Vec3A::splat(-1e30), Vec3A::splat(1e30));
        let (start_times, moved) = (origin * inverse, widening * inverse.abs());
        let upper = |component: f32| (component.to_bits() >> 31) as usize;
        let [x, y, z] = sheared.shear();
        Self {
            start,
            per_unit,
            origin: origin.to_array(),
            inverse: inverse.to_array(),
            near: [upper(inverse.x), upper(inverse.y), upper(inverse.z)],
            near_start: (start_times + moved).to_array(),
            far_start: (start_times - moved).to_array(),
            axes: sheared.axes(),
            shear: [x as f32, y as f32, z as f32],
            rounding,
        }
    }

    /// Converts a distance along the ray into one in the tree, rounded up.
    #[must_use]
    #[inline(always)]
    pub fn distance(&self, t: f64) -> f32 {
        // A part of 2^-22 exceeds the roundings of the conversion.
        let distance = ((t - self.start) * self.per_unit) as f32;
        distance + distance.abs() * (2.0 * f32::EPSILON)
    }
}
