//! Rays of a group in the coordinates of one tree, and the intervals that contain all of them.
//!
//! A box that the intervals miss is missed by every ray: Boulos et al., *Packet-based Whitted and
//! Distribution Ray Tracing*, Graphics Interface 2007, section 3. The directions of a
//! bundle have the same signs along each axis, and the same axes after shearing.
//!
//! The intervals contain the rays' numbers in `f32`, so that the bounds of `frame.rs` hold: an interval
//! rounds less often than the test of one ray.

use super::frame::{Frame, TreeRay};
use super::lanes::{FOUR, FOURS, Lanes, MOST};
use crate::ray::Ray;
use glam::DVec3;

/// Number of rays that are tested together.
pub const EIGHT: usize = 8;

/// Number of eights of rays.
const EIGHTS: usize = MOST / EIGHT;

/// One number of each ray.
pub type Numbers = [[f32; EIGHT]; EIGHTS];

/// Rays in the coordinates of a tree.
#[derive(Debug)]
pub struct Bundle {
    /// Number of rays.
    pub count: usize,
    /// Start of each ray along the sheared axes.
    pub origin: [Numbers; 3],
    /// [`TreeRay::shear`] of each ray.
    pub shear: [Numbers; 3],
    /// Distance in the tree within which hits of each ray count; minus infinity for a ray that is
    /// finished.
    pub limit: Numbers,
    /// The largest limit.
    pub farthest: f32,
    /// [`TreeRay::near`] of all rays.
    pub near: [usize; 3],
    /// [`TreeRay::axes`] of all rays.
    pub axes: [usize; 3],
    /// The least and the largest inverse of the directions, along each axis.
    pub inverse: [[f32; 3]; 2],
    /// Starts from which near sides are nearest, and far sides farthest, along each axis.
    pub from: [[f32; 3]; 2],
    /// The largest [`TreeRay::rounding`].
    pub rounding: f32,
    /// Distance of each ray from which distances in the tree count, in scene units.
    starts: [f64; MOST],
    /// Units of the tree per scene unit.
    per_unit: f64,
}

impl Bundle {
    /// The rays of a group in the frame of a tree with these bounds. `extent` is that of
    /// [`TreeRay::new`].
    #[must_use]
    #[inline(always)]
    pub fn new(
        lanes: &Lanes,
        rays: &[(Ray, f64)],
        (frame, bounds): (&Frame, [DVec3; 2]),
        extent: f64,
    ) -> Self {
        let none = [[0.0; EIGHT]; EIGHTS];
        let mut bundle = Self {
            count: 0,
            origin: [none; 3],
            shear: [none; 3],
            limit: [[f32::NEG_INFINITY; EIGHT]; EIGHTS],
            farthest: f32::NEG_INFINITY,
            near: lanes.near,
            axes: lanes.axes,
            inverse: [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]],
            from: [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]],
            rounding: 0.0,
            starts: [0.0; MOST],
            per_unit: frame.per_unit(),
        };
        if !bundle.put_near(lanes, frame) {
            for k in 0..lanes.count.min(MOST) {
                let (ray, t_max) = (&rays[lanes.number(k)].0, lanes.t_max(k));
                let own = TreeRay::along(frame, bounds, ray, extent, lanes.axes);
                if let Some(own) = own.filter(|_| t_max >= 0.0) {
                    bundle.put(k, &own, t_max);
                }
            }
        }
        bundle.settle();
        bundle.widen();
        bundle
    }

    /// Sets all rays, or returns false if some ray starts so far away that [`TreeRay::along`] moves its
    /// start. The numbers are those of [`TreeRay::along`].
    #[inline(always)]
    fn put_near(&mut self, lanes: &Lanes, frame: &Frame) -> bool {
        let mut reach = [0.0; FOUR];
        let mut scale = [0.0; FOUR];
        for sheared in 0..3 {
            let axis = self.axes[sheared] % 3;
            let middle = frame.middle[axis];
            for four in 0..FOURS {
                let origin = &lanes.origin[axis][four];
                for k in 0..FOUR {
                    let place = (origin[k] - middle) * self.per_unit;
                    reach[k] = if place.abs() > reach[k] { place.abs() } else { reach[k] };
                    self.origin[sheared][four / 2][four % 2 * FOUR + k] = place as f32;
                }
            }
        }
        for four in &lanes.scale {
            for k in 0..FOUR {
                scale[k] = if four[k] > scale[k] { four[k] } else { scale[k] };
            }
        }
        let reach = reach.into_iter().fold(0.0, f64::max);
        if reach > TreeRay::NEAR {
            return false;
        }
        let scale = scale.into_iter().fold(0.0, f64::max);
        self.rounding = TreeRay::rounding_of(reach, scale * self.per_unit);
        let last = self.axes[2] % 3;
        for sheared in 0..3 {
            let axis = self.axes[sheared] % 3;
            let (mut least, mut most) = ([f32::INFINITY; FOUR], [f32::NEG_INFINITY; FOUR]);
            for four in 0..FOURS {
                let (direction, over) =
                    (&lanes.direction[axis][four], &lanes.direction[last][four]);
                for k in 0..FOUR {
                    let (along, over) = (direction[k] as f32, over[k] as f32);
                    let inverse = 1.0 / along;
                    let inverse = if inverse > 1e30 { 1e30 } else { inverse };
                    let inverse = if inverse < -1e30 { -1e30 } else { inverse };
                    least[k] = if inverse < least[k] { inverse } else { least[k] };
                    most[k] = if inverse > most[k] { inverse } else { most[k] };
                    let part = if sheared == 2 { 1.0 } else { along };
                    self.shear[sheared][four / 2][four % 2 * FOUR + k] = part * (1.0 / over);
                }
            }
            self.inverse[0][axis] = least.into_iter().fold(f32::INFINITY, f32::min);
            self.inverse[1][axis] = most.into_iter().fold(f32::NEG_INFINITY, f32::max);
            let (mut least, mut most) = ([f32::INFINITY; EIGHT], [f32::NEG_INFINITY; EIGHT]);
            for eight in &self.origin[sheared] {
                for k in 0..EIGHT {
                    least[k] = if eight[k] < least[k] { eight[k] } else { least[k] };
                    most[k] = if eight[k] > most[k] { eight[k] } else { most[k] };
                }
            }
            self.from[0][axis] = least.into_iter().fold(f32::INFINITY, f32::min);
            self.from[1][axis] = most.into_iter().fold(f32::NEG_INFINITY, f32::max);
        }
        for k in 0..lanes.count.min(MOST) {
            let t_max = lanes.t_max(k);
            self.count += usize::from(t_max >= 0.0);
            self.shorten(k, t_max);
        }
        true
    }

    /// Sets ray `k`, whose hits count within `t_max`.
    #[inline(always)]
    fn put(&mut self, k: usize, ray: &TreeRay, t_max: f64) {
        let (eight, lane) = (k / EIGHT % EIGHTS, k % EIGHT);
        self.count += 1;
        for sheared in 0..3 {
            let axis = ray.axes[sheared] % 3;
            let (start, inverse) = (ray.origin[sheared], ray.inverse[axis]);
            self.origin[sheared][eight][lane] = start;
            self.shear[sheared][eight][lane] = ray.shear[sheared];
            self.inverse[0][axis] = self.inverse[0][axis].min(inverse);
            self.inverse[1][axis] = self.inverse[1][axis].max(inverse);
            self.from[0][axis] = self.from[0][axis].min(start);
            self.from[1][axis] = self.from[1][axis].max(start);
        }
        self.rounding = self.rounding.max(ray.rounding);
        self.starts[k % MOST] = ray.start();
        self.shorten(k, t_max);
    }

    /// Widens the intervals of the starts by the roundings.
    #[inline(always)]
    fn widen(&mut self) {
        let widening = self.rounding.min(8.0);
        for axis in 0..3 {
            let [low, high] = [self.from[0][axis] - widening, self.from[1][axis] + widening];
            // Near sides are nearest to the start that has come farthest along the axis.
            let [near, far] = if self.near[axis] == 0 { [high, low] } else { [low, high] };
            (self.from[0][axis], self.from[1][axis]) = (near, far);
        }
    }

    /// Sets the distance within which hits of ray `k` count; below 0 for a ray that is finished.
    #[inline(always)]
    pub fn shorten(&mut self, k: usize, t_max: f64) {
        let limit = if t_max >= 0.0 {
            TreeRay::distance_from(self.starts[k % MOST], self.per_unit, t_max)
        } else {
            f32::NEG_INFINITY
        };
        self.limit[k / EIGHT % EIGHTS][k % EIGHT] = limit;
    }

    /// Finds the largest limit after limits have changed.
    #[inline(always)]
    pub fn settle(&mut self) {
        let mut most = [f32::NEG_INFINITY; EIGHT];
        for eight in &self.limit {
            for (most, limit) in most.iter_mut().zip(eight) {
                *most = if *limit > *most { *limit } else { *most };
            }
        }
        self.farthest = f32::NEG_INFINITY;
        for most in most {
            self.farthest = if most > self.farthest { most } else { self.farthest };
        }
    }
}
