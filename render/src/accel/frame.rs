//! The coordinates of a tree, and rays prepared for one tree.
//!
//! Coordinates of a tree are `f32`, counted from a point near the tree in units of a power of two, so
//! that all lie in [-1, 1]. A ray that starts far away is first moved to where it enters the tree, so
//! that its numbers are about as small as the tree.
//!
//! **Nothing missed.** [`SlabRay::crosses`] and `Probe::settle` decide in `f64` about boxes and
//! triangles. The tests in `f32` only reject, and accept all of those. Boxes are rounded outwards
//! and widened by more than the roundings of the test. Let the ray start within `r` units, `r` at least
//! 1. The roundings of a box in units of `2^-24 r` are:
//!
//! - 1 for the start, 1 for its product with the inverse, and 1 for its move by the widening;
//! - 4 for the inverse (2 for each of start and side), 1 for the product of the side, and 2 for the
//!   difference: 10 in all.
//!
//! The roundings of the sheared coordinates of a triangle are:
//!
//! - 1 for the start, 1 for the corner, 2 for their difference, and the same 4 for the part that
//!   shearing adds;
//! - 6 for the shear, 2 for its product and 2 for the sum: 18 in all.
//!
//! The bound is 24. Roundings in `f64` are added as parts of the ray's scale.

use super::slabs::SlabRay;
use crate::ray::Ray;
use crate::shape::triangle::Corners;
use glam::{DVec3, Vec3A, Vec4};

/// Bound on the roundings of one coordinate, in units of a tree.
const ROUNDING: f64 = 24.0 / (1u32 << 24) as f64;

/// The coordinates of a tree.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    /// Origin of the coordinates, in scene space.
    pub middle: DVec3,
    /// The origin with each zero as -0: a sum with -0 keeps the sign of a -0, and a sum with 0 does not.
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
            let close = middle != 0.0 && 2.0 * near >= middle.abs() && far <= 2.0 * middle.abs();
            if close { middle } else { 0.0 }
        });
        Self::at(DVec3::from(middle), bounds)
    }

    /// Returns the frame with its origin moved by `offset`, in scene space.
    #[must_use]
    pub fn moved(self, offset: DVec3) -> Self {
        let middle = self.middle + offset;
        let back = DVec3::select(middle.cmpeq(DVec3::ZERO), DVec3::splat(-0.0), middle);
        Self { middle, back, ..self }
    }

    fn at(middle: DVec3, [low, high]: [DVec3; 2]) -> Self {
        let reach = (low - middle).abs().max((high - middle).abs()).max_element();
        let back = DVec3::select(middle.cmpeq(DVec3::ZERO), DVec3::splat(-0.0), middle);
        let unit = power_of_two(reach);
        Self { middle, back, unit, per_unit: unit.recip() }
    }

    /// Units of the tree per scene unit.
    #[must_use]
    pub fn per_unit(&self) -> f64 {
        self.per_unit
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

    /// Returns the corners in scene space that have these coordinates.
    #[must_use]
    #[inline(always)]
    pub fn scene(&self, [x, y, z]: [Vec4; 3]) -> Corners {
        // Both operations are exact where the coordinates in the frame are.
        let scene = |own: Vec4, back: f64| own.as_dvec4() * self.unit + back;
        [scene(x, self.back.x), scene(y, self.back.y), scene(z, self.back.z)]
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
    /// Distance from which distances in the tree count, in scene units.
    start: f64,
    /// Units of the tree per scene unit.
    per_unit: f64,
    /// One over the direction; where a component is zero, a huge number of its sign.
    pub inverse: Vec3A,
    /// Start of the ray times the inverse, moved for the near sides so that they come nearer.
    pub near_start: Vec3A,
    /// Start of the ray times the inverse, moved for the far sides so that they lie farther.
    pub far_start: Vec3A,
    /// The side of a box that the ray meets first, along each axis: 0 the lower, 1 the upper.
    pub near: [usize; 3],
    /// The axes of the sheared space: the last is that of the direction's largest component.
    pub axes: [usize; 3],
    /// Start of the ray along these axes.
    pub origin: Vec3A,
    /// Components of the direction along the first two axes, and 1, over that of the last.
    pub shear: Vec3A,
    /// Bound on the error of sheared coordinates.
    pub rounding: f32,
}

impl TreeRay {
    /// A ray that starts within this distance along each axis, in units of a tree, is not moved.
    ///
    /// If larger, the tests reject less, since their roundings grow with the distance. If smaller, more
    /// rays compute where they enter the tree.
    pub const NEAR: f64 = 8.0;

    /// Prepares a ray for a tree with these bounds, or returns `None` if it misses the tree. `extent`
    /// is that of [`SlabRay::new`].
    #[must_use]
    #[inline(always)]
    pub fn new(frame: &Frame, bounds: [DVec3; 2], ray: &Ray, extent: f64) -> Option<Self> {
        let size = ray.direction.as_vec3a().abs();
        let axes = if size.x > size.y && size.x > size.z {
            [1, 2, 0]
        } else if size.y > size.z {
            [2, 0, 1]
        } else {
            [0, 1, 2]
        };
        Self::along(frame, bounds, ray, extent, axes)
    }

    /// Prepares a ray as [`TreeRay::new`] does, with given axes of the sheared space. No component of the
    /// direction exceeds that along the last axis by more than a rounding.
    #[must_use]
    #[inline(always)]
    pub fn along(
        frame: &Frame,
        bounds: [DVec3; 2],
        ray: &Ray,
        extent: f64,
        [x, y, z]: [usize; 3],
    ) -> Option<Self> {
        let mut start = 0.0;
        let mut place = (ray.origin - frame.middle) * frame.per_unit;
        let mut reach = place.abs().max_element();
        if reach > Self::NEAR {
            start = SlabRay::new(ray.origin, ray.direction, extent).crosses(bounds)?[0];
            place += start * frame.per_unit * ray.direction;
            reach = 1.0;
        }
        let scale = ray.origin.abs().max_element() + extent;
        let rounding = Self::rounding_of(reach, scale * frame.per_unit);
        // Beyond 8 units every box is crossed. A start that is off by less lies within 2 NEAR.
        let widening = rounding.min(8.0);
        let most = Vec3A::splat(2.0 * Self::NEAR as f32);
        let origin = place.as_vec3a().clamp(-most, most);
        let direction = ray.direction.as_vec3a();
        // Where the clamp applies, the ray stays on one side of all planes in the tree.
        let inverse = direction.recip().clamp(Vec3A::splat(-1e30), Vec3A::splat(1e30));
        let (start_times, moved) = (origin * inverse, widening * inverse.abs());
        let upper = |component: f32| (component.to_bits() >> 31) as usize;
        let over = inverse[z];
        Some(Self {
            start,
            per_unit: frame.per_unit,
            inverse,
            near_start: start_times + moved,
            far_start: start_times - moved,
            near: [upper(inverse.x), upper(inverse.y), upper(inverse.z)],
            axes: [x, y, z],
            origin: Vec3A::new(origin[x], origin[y], origin[z]),
            shear: Vec3A::new(direction[x], direction[y], 1.0) * over,
            rounding,
        })
    }

    /// Returns the bound on the error of sheared coordinates. `reach` is the largest coordinate of the
    /// start, and `scale` that of [`SlabRay`], in units of the tree.
    #[must_use]
    #[inline(always)]
    pub fn rounding_of(reach: f64, scale: f64) -> f32 {
        (ROUNDING * reach.max(1.0) + 64.0 * f64::EPSILON * scale) as f32
    }

    /// Distance from which distances in the tree count, in scene units.
    #[must_use]
    #[inline(always)]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Converts a distance along the ray into one in the tree, rounded up.
    #[must_use]
    #[inline(always)]
    pub fn distance(&self, t: f64) -> f32 {
        Self::distance_from(self.start, self.per_unit, t)
    }

    /// Converts a distance as [`TreeRay::distance`] does, for a ray whose distances in the tree count from
    /// `start`.
    #[must_use]
    #[inline(always)]
    pub fn distance_from(start: f64, per_unit: f64, t: f64) -> f32 {
        // A part of 2^-22 exceeds the roundings of the conversion.
        let distance = ((t - start) * per_unit) as f32;
        distance + distance.abs() * (2.0 * f32::EPSILON)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_unit_is_the_next_power_of_two() {
        let units = [0.0, 1.0, 1.5, 0.3, 1e-320, 1.5e308].map(power_of_two);
        assert_eq!(units, [1.0, 1.0, 2.0, 0.5, f64::MIN_POSITIVE, 2f64.powi(1023)]);
    }

    proptest! {
        /// Corners come back from the frame to the last bit, the sign of zeros included, wherever the
        /// mesh lies. Their coordinates in the frame are at most 1.
        #[test]
        fn corners_are_exact_in_the_frame(
            corners in prop::collection::vec(prop::array::uniform3(prop_oneof![
                -1.0..1.0f32, Just(0.0f32), Just(-0.0f32), (-8i8..8).prop_map(f32::from),
            ]), 1..20),
            size in prop::sample::select(vec![1.0f32, 1e-30, 1e30, 0.001]),
            shift in prop::sample::select(vec![[0.0f32; 3], [300.0, -200.0, 1e7], [1.0, -1.5, 0.5]]),
        ) {
            let moved = |p: [f32; 3]| [0, 1, 2].map(|axis| {
                if shift[axis] == 0.0 { size * p[axis] } else { size * p[axis] + shift[axis] }
            });
            let corners: Vec<[f32; 3]> = corners.into_iter().map(moved).collect();
            let places = corners.iter().map(|p| DVec3::from(p.map(f64::from)));
            let bounds = places.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |all, p| {
                [all[0].min(p), all[1].max(p)]
            });
            let frame = Frame::exact(bounds);
            for corner in corners {
                let own = frame.corner(corner);
                prop_assert!(own.iter().all(|x| x.abs() <= 1.0), "{:?}", own);
                let small = |x: f32| x != 0.0 && x.abs() < f32::MIN_POSITIVE;
                prop_assume!(!own.into_iter().any(small));
                let back = frame.scene(own.map(Vec4::splat));
                let back = back.map(|axis| (axis.x as f32).to_bits());
                prop_assert_eq!(back, corner.map(f32::to_bits));
            }
        }
    }
}
