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
use super::frame::TreeRay;
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
        // The smallest normal number exceeds the error of products that underflow.
        let edge = 12.0 * ray.rounding * (longest + ray.rounding) + f32::MIN_POSITIVE;
        Self { edge, depth: 4.0 * ray.rounding }
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
}
