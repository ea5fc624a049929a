//! The rays of a group, prepared for the hit function of four rays and one triangle in `f64`.
//!
//! Each operation of that function is that of `Probe::meet_triangle`, in the same order and rounded
//! alone, so that the results are equal to the last bit ([`super::kernel::Kernel::four`]). Where a ray
//! may start on the triangle, the function for one ray decides.

use super::slabs::SlabRay;
use crate::ray::Ray;
use crate::shape::triangle::{Corners, ShearedRay};
use glam::{DVec3, DVec4};

/// Largest number of rays of a group. If larger, the intervals that contain the rays are wider. If
/// smaller, more groups test the same boxes.
pub const MOST: usize = 64;

/// Number of rays that are tested together.
pub const FOUR: usize = 4;

/// Number of fours of rays.
pub const FOURS: usize = MOST / FOUR;

/// One number of each ray.
pub type Numbers = [[f64; FOUR]; FOURS];

/// Rays with the same signs of their directions, and the same axes after shearing.
#[derive(Debug)]
pub struct Lanes {
    /// Number of rays.
    pub count: usize,
    /// Index of each ray in its group.
    pub numbers: [u8; MOST],
    /// The axes after shearing.
    pub axes: [usize; 3],
    /// For each axis 1 if the directions point down it, else 0.
    pub near: [usize; 3],
    /// Start of each ray, along the axes of space.
    pub origin: [Numbers; 3],
    /// Direction of each ray, along the axes of space.
    pub direction: [Numbers; 3],
    /// Components of the direction of each ray along the first two sheared axes, and 1, over that of the
    /// last.
    pub shear: [Numbers; 3],
    /// [`SlabRay::inverse`] of each ray.
    pub inverse: [Numbers; 3],
    /// Start of each ray, moved up by the widening of boxes.
    pub above: [Numbers; 3],
    /// Start of each ray, moved down by the widening of boxes.
    pub below: [Numbers; 3],
    /// [`SlabRay::slack`] of each ray.
    pub slack: Numbers,
    /// [`SlabRay::scale`] of each ray.
    pub scale: Numbers,
    /// Distance within which hits of each ray count; below 0 for a ray that is finished.
    pub t_max: Numbers,
}

/// A triangle as four rays meet it.
#[derive(Debug)]
pub struct Target {
    /// The corners.
    pub corners: Corners,
    /// Lower corner of the box; the fourth component is 0.
    pub low: DVec4,
    /// Upper corner of the box; the fourth component is infinity.
    pub high: DVec4,
    /// A ray certainly starts off the triangle if its distance times the sum of the edge functions exceeds
    /// this number times one over the direction's largest component.
    pub off: f64,
}

/// The hits of four rays with a triangle.
#[derive(Debug)]
pub struct Met {
    /// A mask of the rays that meet the triangle.
    pub mask: u32,
    /// Distances of the hits.
    pub t: [f64; FOUR],
    /// A mask of the rays that certainly do not start on the triangle.
    pub clear: u32,
    /// Weights of the second and third corner.
    pub weights: [[f64; FOUR]; 2],
}

impl Lanes {
    /// No rays.
    #[must_use]
    #[inline(always)]
    pub fn none() -> Self {
        let none = [[0.0; FOUR]; FOURS];
        Self {
            count: 0,
            numbers: [0; MOST],
            axes: [0, 1, 2],
            near: [0; 3],
            origin: [none; 3],
            direction: [none; 3],
            shear: [none; 3],
            inverse: [none; 3],
            above: [none; 3],
            below: [none; 3],
            slack: none,
            scale: none,
            t_max: [[-1.0; FOUR]; FOURS],
        }
    }

    /// Takes the first of the rays in the mask `left`, and all that are like it, out of the mask. `extent`
    /// is that of [`SlabRay::new`].
    #[inline(always)]
    pub fn take(&mut self, rays: &[(Ray, f64)], left: &mut u64, extent: f64) {
        self.count = 0;
        let first = left.trailing_zeros() as usize % MOST;
        let Some((like, _)) = rays.get(first) else {
            *left = 0;
            return;
        };
        self.axes = axes_of(like.direction);
        self.near = near_of(like.direction);
        for (number, (ray, t_max)) in rays.iter().enumerate().take(MOST).skip(first) {
            if *left >> number & 1 == 0
                || near_of(ray.direction) != self.near
                || axes_of(ray.direction) != self.axes
            {
                continue;
            }
            *left &= !(1 << number);
            self.numbers[self.count % MOST] = number as u8;
            self.put(self.count, ray, *t_max);
            self.count += 1;
        }
        // Copies of a ray fill the lanes that are left, and are finished.
        for k in self.count..MOST {
            self.put(k, like, -1.0);
        }
        self.derive(extent);
    }

    #[inline(always)]
    fn put(&mut self, k: usize, ray: &Ray, t_max: f64) {
        let (four, lane) = (k / FOUR % FOURS, k % FOUR);
        let (origin, direction) = (&ray.origin, &ray.direction);
        self.origin[0][four][lane] = origin.x;
        self.origin[1][four][lane] = origin.y;
        self.origin[2][four][lane] = origin.z;
        self.direction[0][four][lane] = direction.x;
        self.direction[1][four][lane] = direction.y;
        self.direction[2][four][lane] = direction.z;
        self.t_max[four][lane] = t_max;
    }

    /// Computes the numbers of [`ShearedRay::new`] and [`SlabRay::new`] for all rays.
    #[inline(always)]
    fn derive(&mut self, extent: f64) {
        let [x, y, z] = [self.axes[0] % 3, self.axes[1] % 3, self.axes[2] % 3];
        for four in 0..FOURS {
            let [ox, oy, oz] = [self.origin[0][four], self.origin[1][four], self.origin[2][four]];
            let mut widening = [0.0; FOUR];
            for k in 0..FOUR {
                let scale = greater(greater(ox[k].abs(), oy[k].abs()), oz[k].abs()) + extent;
                self.scale[four][k] = scale;
                self.slack[four][k] = SlabRay::SLACK * scale;
                widening[k] = SlabRay::WIDENING * scale;
            }
            for axis in 0..3 {
                let (origin, direction) = (self.origin[axis][four], self.direction[axis][four]);
                for k in 0..FOUR {
                    self.above[axis][four][k] = origin[k] + widening[k];
                    self.below[axis][four][k] = origin[k] - widening[k];
                    let inverse = 1.0 / direction[k];
                    let huge = SlabRay::ZERO.recip().copysign(direction[k]);
                    let zero = direction[k].abs() <= SlabRay::ZERO;
                    self.inverse[axis][four][k] = if zero { huge } else { inverse };
                }
            }
            let (dx, dy) = (self.direction[x][four], self.direction[y][four]);
            let over = self.inverse[z][four];
            for k in 0..FOUR {
                self.shear[0][four][k] = dx[k] * over[k];
                self.shear[1][four][k] = dy[k] * over[k];
            }
            self.shear[2][four] = over;
        }
    }

    /// Returns the index in the group of ray `k`.
    #[must_use]
    #[inline(always)]
    pub fn number(&self, k: usize) -> usize {
        usize::from(self.numbers[k % MOST])
    }

    /// Distance within which hits of ray `k` count.
    #[must_use]
    #[inline(always)]
    pub fn t_max(&self, k: usize) -> f64 {
        self.t_max[k / FOUR % FOURS][k % FOUR]
    }

    /// Sets the distance within which hits of ray `k` count.
    #[inline(always)]
    pub fn shorten(&mut self, k: usize, t_max: f64) {
        self.t_max[k / FOUR % FOURS][k % FOUR] = t_max;
    }

    /// The largest distance within which hits count; below 0 if all rays are finished.
    #[must_use]
    pub fn farthest(&self) -> f64 {
        self.t_max.iter().flatten().copied().fold(-1.0, f64::max)
    }

    /// Returns a distance at or before which each ray enters a box, or `None` if no ray meets the box.
    ///
    /// The ends of the intervals are numbers of rays, and each operation of [`SlabRay::crosses`] is
    /// monotone with its rounding. A box that the intervals miss is missed by each ray.
    #[must_use]
    pub fn crosses(&self, around: &Around, [low, high]: &[DVec3; 2]) -> Option<f64> {
        let (mut enter, mut leave) = (0.0f64, f64::INFINITY);
        for axis in 0..3 {
            let down = self.near[axis] == 1;
            let (near, far) = if down { (high, low) } else { (low, high) };
            let (nearest, farthest) =
                (near[axis] - around.near[axis], far[axis] - around.far[axis]);
            let [a, b] = [around.inverse[0][axis], around.inverse[1][axis]];
            enter = enter.max((nearest * a).min(nearest * b));
            leave = leave.min((farthest * a).max(farthest * b));
        }
        (enter <= leave).then_some(enter)
    }

    /// Returns the intervals that contain all rays.
    #[must_use]
    pub fn around(&self) -> Around {
        let mut around = Around {
            inverse: [DVec3::INFINITY, DVec3::NEG_INFINITY],
            near: DVec3::ZERO,
            far: DVec3::ZERO,
        };
        for axis in 0..3 {
            [around.inverse[0][axis], around.inverse[1][axis]] = interval(&self.inverse[axis]);
            // Lower sides are seen from starts moved up, and upper sides from starts moved down.
            let ([above, below], up) =
                ([interval(&self.above[axis]), interval(&self.below[axis])], self.near[axis] == 0);
            (around.near[axis], around.far[axis]) =
                if up { (above[1], below[0]) } else { (below[0], above[1]) };
        }
        around
    }
}

/// Intervals that contain all rays of a group, in scene space.
#[derive(Debug)]
pub struct Around {
    /// The least and the largest inverse of the directions.
    inverse: [DVec3; 2],
    /// Starts from which near sides are nearest.
    near: DVec3,
    /// Starts from which far sides are farthest.
    far: DVec3,
}

/// The axes of [`ShearedRay`] for a direction.
#[inline(always)]
fn axes_of(direction: DVec3) -> [usize; 3] {
    ShearedRay::axes_of(direction)
}

/// For each axis 1 if a direction points down it, else 0.
#[inline(always)]
fn near_of(direction: DVec3) -> [usize; 3] {
    let down = |x: f64| (x.to_bits() >> 63) as usize;
    [down(direction.x), down(direction.y), down(direction.z)]
}

#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The least and the largest number.
#[inline(always)]
fn interval(numbers: &Numbers) -> [f64; 2] {
    let (mut least, mut most) = ([f64::INFINITY; FOUR], [f64::NEG_INFINITY; FOUR]);
    for four in numbers {
        for k in 0..FOUR {
            least[k] = if four[k] < least[k] { four[k] } else { least[k] };
            most[k] = if four[k] > most[k] { four[k] } else { most[k] };
        }
    }
    let least = least.into_iter().fold(f64::INFINITY, f64::min);
    [least, most.into_iter().fold(f64::NEG_INFINITY, f64::max)]
}
