//! The two tests that rays spend their time in: eight boxes, and four triangles at once.
//!
//! Both tests only reject. What they accept is decided in `f64` ([`super::leaf::Probe`]), so that hits
//! do not depend on the instructions that a test uses. A [`Kernel`] is one implementation:
//! [`Portable`] here, and [`super::simd`] with vector instructions of the processor.
//!
//! **Four triangles.** A triangle is sheared into a space where the ray runs along the last axis, as in
//! [`crate::shape::triangle`]. Let `d` bound the error of the sheared coordinates, and let `L` be the
//! longest side of the triangle's box. A ray that meets the triangle passes its corners within
//! `2 L`. Each edge function is a difference of two products of such coordinates. Its error is below
//! `8 d L + 2 d^2` for the coordinates, and below `2^-20 L^2 < 2 d L` for the products. The tests
//! therefore accept edge functions whose sign is wrong by up to `12 d (L + d)`.

use super::block::{Block, LANES};
use super::bundle::{Bundle, EIGHT};
use super::frame::TreeRay;
use super::lanes::{FOUR, Lanes, MOST, Met, Target};
use super::node::{Node, WIDTH};
use super::simd::Task;

/// An implementation of both tests.
pub trait Kernel: Copy {
    /// Returns for each box of a node the distance at which the ray enters it, and a mask of the boxes
    /// that it enters within `limit`. Distances are those of [`TreeRay::distance`].
    fn boxes(self, node: &Node, ray: &TreeRay, limit: f32) -> ([f32; WIDTH], u32);

    /// Returns a mask of the triangles that the ray may hit within `limit`. `longest` is the longest
    /// side of their boxes.
    fn triangles(self, block: &Block, ray: &TreeRay, longest: f32, limit: f32) -> u32;

    /// Returns for each box of a node a distance at or before which all rays of a bundle enter it, and a
    /// mask of the boxes that some ray may enter within its limit.
    fn boxes_of_all(self, node: &Node, bundle: &Bundle) -> ([f32; WIDTH], u32);

    /// Returns a mask of the rays of a bundle that may hit triangle `lane` of a block within their limits.
    fn rays(self, block: &Block, lane: usize, bundle: &Bundle, tolerance: Tolerance) -> u64;

    /// Returns the hits of four rays with a triangle, as `Probe::meet_triangle` finds them. The rays are
    /// those from `FOUR * four` on.
    fn four(self, lanes: &Lanes, four: usize, target: &Target) -> Met;

    /// Runs a task with the kernel's instructions, in a function of its own.
    fn apart<T: Task>(self, task: &mut T) -> T::Out;
}

/// Bounds of the test of four triangles.
#[derive(Debug, Clone, Copy)]
pub struct Tolerance {
    /// Bound on the error of an edge function.
    pub edge: f32,
    /// Bound on the error of the distance of a corner.
    pub depth: f32,
}

impl Tolerance {
    /// Returns the bounds for triangles whose boxes are at most `longest` long.
    #[must_use]
    #[inline]
    pub fn of(ray: &TreeRay, longest: f32) -> Self {
        Self::of_rounding(ray.rounding, longest)
    }

    /// Returns the bounds for rays whose sheared coordinates are off by at most `rounding`.
    #[must_use]
    #[inline]
    pub fn of_rounding(rounding: f32, longest: f32) -> Self {
        // The smallest normal number exceeds the error of products that underflow.
        let edge = 12.0 * rounding * (longest + rounding) + f32::MIN_POSITIVE;
        Self { edge, depth: 4.0 * rounding }
    }
}

/// Both tests without vector instructions of a certain processor.
#[derive(Debug, Clone, Copy)]
pub struct Portable;

impl Kernel for Portable {
    #[inline(never)]
    fn apart<T: Task>(self, task: &mut T) -> T::Out {
        task.run(self)
    }

    #[inline]
    fn boxes(self, node: &Node, ray: &TreeRay, limit: f32) -> ([f32; WIDTH], u32) {
        let mut enter = [0.0f32; WIDTH];
        let mut leave = [limit; WIDTH];
        for axis in 0..3 {
            let near = &node.sides[axis][ray.near[axis] & 1];
            let far = &node.sides[axis][!ray.near[axis] & 1];
            let inverse = ray.inverse[axis];
            for k in 0..WIDTH {
                let a = near[k] * inverse - ray.near_start[axis];
                let b = far[k] * inverse - ray.far_start[axis];
                enter[k] = if a > enter[k] { a } else { enter[k] };
                leave[k] = if b < leave[k] { b } else { leave[k] };
            }
        }
        let mask = (0..WIDTH).map(|k| u32::from(enter[k] <= leave[k]) << k).sum();
        (enter, mask)
    }

    #[inline]
    fn triangles(self, block: &Block, ray: &TreeRay, longest: f32, limit: f32) -> u32 {
        let Tolerance { edge, depth } = Tolerance::of(ray, longest);
        let mut mask = 0;
        for lane in 0..LANES {
            let from = |corner: usize, axis: usize| {
                block.corners[corner][ray.axes[axis]][lane] - ray.origin[axis]
            };
            let depths = [0, 1, 2].map(|corner| from(corner, 2));
            let [ax, bx, cx] = [0, 1, 2].map(|k| from(k, 0) - ray.shear[0] * depths[k]);
            let [ay, by, cy] = [0, 1, 2].map(|k| from(k, 1) - ray.shear[1] * depths[k]);
            let [az, bz, cz] = depths.map(|depth| ray.shear[2] * depth);
            let [a, b, c] = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
            // Each condition is false for the NaN of an absent triangle.
            let front = (a >= -edge) & (b >= -edge) & (c >= -edge);
            let back = (a <= edge) & (b <= edge) & (c <= edge);
            let beyond = limit + depth;
            let near = (az <= beyond) | (bz <= beyond) | (cz <= beyond);
            let ahead = (az >= -depth) | (bz >= -depth) | (cz >= -depth);
            mask |= u32::from((front | back) & near & ahead) << lane;
        }
        mask
    }

    fn boxes_of_all(self, node: &Node, bundle: &Bundle) -> ([f32; WIDTH], u32) {
        let mut enter = [0.0f32; WIDTH];
        let mut leave = [bundle.farthest; WIDTH];
        for axis in 0..3 {
            let near = &node.sides[axis][bundle.near[axis] & 1];
            let far = &node.sides[axis][!bundle.near[axis] & 1];
            let [least, most] = [bundle.inverse[0][axis], bundle.inverse[1][axis]];
            for k in 0..WIDTH {
                let (a, b) = (near[k] - bundle.from[0][axis], far[k] - bundle.from[1][axis]);
                enter[k] = enter[k].max((a * least).min(a * most));
                leave[k] = leave[k].min((b * least).max(b * most));
            }
        }
        let mask = (0..WIDTH).map(|k| u32::from(enter[k] <= leave[k]) << k).sum();
        (enter, mask)
    }

    fn rays(self, block: &Block, lane: usize, bundle: &Bundle, tolerance: Tolerance) -> u64 {
        let Tolerance { edge, depth } = tolerance;
        let [x, y, z] = bundle.axes.map(|axis| axis.min(2));
        let corner = |k: usize| [x, y, z].map(|axis| block.corners[k][axis][lane & (LANES - 1)]);
        let corners = [corner(0), corner(1), corner(2)];
        let mut mask = 0u64;
        for k in 0..MOST {
            let of = |numbers: &[[f32; EIGHT]; MOST / EIGHT]| numbers[k / EIGHT][k % EIGHT];
            let origin = [0, 1, 2].map(|axis| of(&bundle.origin[axis]));
            let shear = [0, 1, 2].map(|axis| of(&bundle.shear[axis]));
            let sheared = corners.map(|corner| {
                let depth = corner[2] - origin[2];
                let x = corner[0] - origin[0] - shear[0] * depth;
                let y = corner[1] - origin[1] - shear[1] * depth;
                [x, y, shear[2] * depth]
            });
            let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = sheared;
            let [a, b, c] = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
            let front = (a >= -edge) & (b >= -edge) & (c >= -edge);
            let back = (a <= edge) & (b <= edge) & (c <= edge);
            let beyond = of(&bundle.limit) + depth;
            let near = (az <= beyond) | (bz <= beyond) | (cz <= beyond);
            let ahead = (az >= -depth) | (bz >= -depth) | (cz >= -depth);
            mask |= u64::from((front | back) & near & ahead) << k;
        }
        mask
    }

    fn four(self, lanes: &Lanes, four: usize, target: &Target) -> Met {
        let mut met = Met { mask: 0, t: [0.0; FOUR], clear: 0, weights: [[0.0; FOUR]; 2] };
        let [x, y, z] = lanes.axes.map(|axis| axis.min(2));
        let four = four % (MOST / FOUR);
        let corners = &target.corners;
        for k in 0..FOUR {
            let origin = |axis: usize| lanes.origin[axis][four][k];
            let [sx, sy, sz] = [0, 1, 2].map(|axis| lanes.shear[axis][four][k]);
            let from = |axis: usize| {
                let (corners, origin) = (corners[axis], origin(axis));
                [corners.x - origin, corners.y - origin, corners.z - origin]
            };
            let depths = from(z);
            let [az, bz, cz] = depths.map(|depth| sz * depth);
            let ([ax, bx, cx], [ay, by, cy]) = (from(x), from(y));
            let [ax, bx, cx] = [ax - sx * depths[0], bx - sx * depths[1], cx - sx * depths[2]];
            let [ay, by, cy] = [ay - sy * depths[0], by - sy * depths[1], cy - sy * depths[2]];
            let [a, b, c] = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
            let area = a + b + c;
            let [wa, wb, wc] = [a / area, b / area, c / area];
            let t = wa * az + wb * bz + wc * cz;
            let (mut enter, mut leave) = (0.0f64, f64::INFINITY);
            for axis in 0..3 {
                let inverse = lanes.inverse[axis][four][k];
                let low = (target.low[axis] - lanes.above[axis][four][k]) * inverse;
                let high = (target.high[axis] - lanes.below[axis][four][k]) * inverse;
                (enter, leave) = (enter.max(low.min(high)), leave.min(low.max(high)));
            }
            let late = if t < enter { enter } else { t };
            let clamped = if late > leave { leave } else { late };
            let t_max = lanes.t_max[four][k];
            let limit = t_max + lanes.slack[four][k];
            let beyond = (az > limit) & (bz > limit) & (cz > limit);
            let negative = (a < 0.0) | (b < 0.0) | (c < 0.0);
            let positive = (a > 0.0) | (b > 0.0) | (c > 0.0);
            let missed = beyond | (negative & positive) | (area == 0.0) | (enter > leave);
            let hit = !missed & (t > 0.0) & (clamped > 0.0) & (clamped <= t_max);
            met.mask |= u32::from(hit) << k;
            met.clear |= u32::from(t * area.abs() > target.off * sz.abs()) << k;
            met.t[k] = clamped;
            (met.weights[0][k], met.weights[1][k]) = (wb, wc);
        }
        met
    }
}
