//! The tests of [`super::kernel`] with AVX2 and FMA instructions, and the choice between both.
//!
//! No other file has `unsafe` code. Here it loads vectors from arrays, and calls functions that are
//! compiled for AVX2 and FMA after the processor was found to have both.

use super::kernel::{Kernel, Portable};

/// Work that runs with a kernel. `run` is inlined, so that its code may use the kernel's instructions.
pub trait Task {
    /// The result.
    type Out;
    /// Does the work.
    fn run<K: Kernel>(&mut self, kernel: K) -> Self::Out;
}

/// The instructions that rays use.
#[derive(Debug, Clone, Copy)]
pub enum Instructions {
    /// Instructions that every processor has.
    Portable,
    /// AVX2 and FMA. A value exists only if the processor has them.
    #[cfg(target_arch = "x86_64")]
    Avx2(avx2::Avx2),
}

impl Instructions {
    /// Returns the fastest instructions that the processor has.
    #[must_use]
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = avx2::Avx2::detect() {
            return Self::Avx2(avx2);
        }
        Self::Portable
    }

    /// Runs a task with these instructions.
    #[inline]
    pub fn run<T: Task>(self, task: &mut T) -> T::Out {
        match self {
            Self::Portable => task.run(Portable),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(avx2) => avx2.dispatch(task),
        }
    }
}

/// The kernel for x86-64 processors.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code, reason = "the only module with vector instructions")]
mod avx2 {
    use super::Task;
    use crate::accel::block::Block;
    use crate::accel::frame::TreeRay;
    use crate::accel::kernel::{Kernel, Tolerance};
    use crate::accel::node::{Node, WIDTH};
    use std::arch::x86_64::{
        __m128, __m256, _CMP_LE_OQ, _mm_and_ps, _mm_cmpge_ps, _mm_cmple_ps, _mm_fmsub_ps,
        _mm_fnmadd_ps, _mm_loadu_ps, _mm_max_ps, _mm_min_ps, _mm_movemask_ps, _mm_mul_ps,
        _mm_or_ps, _mm_set1_ps, _mm_sub_ps, _mm256_cmp_ps, _mm256_fmsub_ps, _mm256_loadu_ps,
        _mm256_max_ps, _mm256_min_ps, _mm256_movemask_ps, _mm256_set1_ps, _mm256_setzero_ps,
        _mm256_storeu_ps,
    };

    /// Proof that the processor has AVX2 and FMA: only [`Avx2::detect`] makes a value.
    #[derive(Debug, Clone, Copy)]
    pub struct Avx2(());

    impl Avx2 {
        /// Returns a value if the processor has the instructions.
        #[must_use]
        pub fn detect() -> Option<Self> {
            (is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"))
                .then_some(Self(()))
        }

        /// Runs a task compiled with the instructions.
        #[inline]
        pub fn dispatch<T: Task>(self, task: &mut T) -> T::Out {
            #[target_feature(enable = "avx2,fma")]
            fn inner<T: Task>(kernel: Avx2, task: &mut T) -> T::Out {
                task.run(kernel)
            }
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA.
            unsafe { inner(self, task) }
        }
    }

    // The functions below are inlined into `inner` before the instructions are chosen. Closures would
    // be compiled on their own, without the instructions.

    #[inline(always)]
    fn load8(from: &[f32; 8]) -> __m256 {
        // SAFETY: the array holds eight numbers, and the load needs no alignment. Callers have AVX.
        unsafe { _mm256_loadu_ps(from.as_ptr()) }
    }

    /// The distances of the sides of eight boxes along one axis.
    #[inline(always)]
    fn distances(sides: &[f32; 8], inverse: f32, start: f32) -> __m256 {
        // SAFETY: callers have AVX and FMA.
        unsafe { _mm256_fmsub_ps(load8(sides), _mm256_set1_ps(inverse), _mm256_set1_ps(start)) }
    }

    #[inline(always)]
    fn from(corners: &[f32; 4], origin: f32) -> __m128 {
        // SAFETY: the array holds four numbers, and the load needs no alignment.
        unsafe { _mm_sub_ps(_mm_loadu_ps(corners.as_ptr()), _mm_set1_ps(origin)) }
    }

    /// Removes from coordinates the part that the shear adds.
    #[inline(always)]
    fn sheared(place: __m128, shear: f32, depth: __m128) -> __m128 {
        // SAFETY: callers have FMA.
        unsafe { _mm_fnmadd_ps(_mm_set1_ps(shear), depth, place) }
    }

    /// The edge function of two corners.
    #[inline(always)]
    fn edge(ax: __m128, by: __m128, ay: __m128, bx: __m128) -> __m128 {
        // SAFETY: callers have FMA.
        unsafe { _mm_fmsub_ps(ax, by, _mm_mul_ps(ay, bx)) }
    }

    impl Kernel for Avx2 {
        #[inline(always)]
        fn apart<T: Task>(self, task: &mut T) -> T::Out {
            #[target_feature(enable = "avx2,fma")]
            #[inline(never)]
            fn inner<T: Task>(kernel: Avx2, task: &mut T) -> T::Out {
                task.run(kernel)
            }
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA.
            unsafe { inner(self, task) }
        }

        #[inline(always)]
        fn boxes(self, node: &Node, ray: &TreeRay, limit: f32) -> ([f32; WIDTH], u32) {
            let ([x, y, z], [nx, ny, nz]) = (&node.sides, ray.near);
            let (nx, ny, nz) = (nx & 1, ny & 1, nz & 1);
            let (inverse, near, far) = (ray.inverse, ray.near_start, ray.far_start);
            let near_x = distances(&x[nx], inverse.x, near.x);
            let near_y = distances(&y[ny], inverse.y, near.y);
            let near_z = distances(&z[nz], inverse.z, near.z);
            let far_x = distances(&x[nx ^ 1], inverse.x, far.x);
            let far_y = distances(&y[ny ^ 1], inverse.y, far.y);
            let far_z = distances(&z[nz ^ 1], inverse.z, far.z);
            let mut distances = [0.0; WIDTH];
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA. The array
            // holds eight numbers, and the store needs no alignment.
            unsafe {
                let near_z = _mm256_max_ps(near_z, _mm256_setzero_ps());
                let enter = _mm256_max_ps(_mm256_max_ps(near_x, near_y), near_z);
                let far_z = _mm256_min_ps(far_z, _mm256_set1_ps(limit));
                let leave = _mm256_min_ps(_mm256_min_ps(far_x, far_y), far_z);
                let mask = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave));
                _mm256_storeu_ps(distances.as_mut_ptr(), enter);
                (distances, mask as u32)
            }
        }

        #[inline(always)]
        fn triangles(self, block: &Block, ray: &TreeRay, longest: f32, limit: f32) -> u32 {
            let tolerance = Tolerance::of(ray, longest);
            let [x, y, z] = [ray.axes[0].min(2), ray.axes[1].min(2), ray.axes[2].min(2)];
            let (ox, oy, oz) = (ray.origin.x, ray.origin.y, ray.origin.z);
            let (sx, sy, sz) = (ray.shear.x, ray.shear.y, ray.shear.z);
            let [first, second, third] = &block.corners;
            let (da, db, dc) = (from(&first[z], oz), from(&second[z], oz), from(&third[z], oz));
            let ax = sheared(from(&first[x], ox), sx, da);
            let ay = sheared(from(&first[y], oy), sy, da);
            let bx = sheared(from(&second[x], ox), sx, db);
            let by = sheared(from(&second[y], oy), sy, db);
            let cx = sheared(from(&third[x], ox), sx, dc);
            let cy = sheared(from(&third[y], oy), sy, dc);
            let (a, b, c) = (edge(cx, by, cy, bx), edge(ax, cy, ay, cx), edge(bx, ay, by, ax));
            // SAFETY: every x86-64 processor has these instructions.
            unsafe {
                let least = _mm_min_ps(_mm_min_ps(a, b), c);
                let most = _mm_max_ps(_mm_max_ps(a, b), c);
                // Each condition is false for the NaN of an absent triangle.
                let front = _mm_cmpge_ps(least, _mm_set1_ps(-tolerance.edge));
                let back = _mm_cmple_ps(most, _mm_set1_ps(tolerance.edge));
                let sz = _mm_set1_ps(sz);
                let (az, bz, cz) = (_mm_mul_ps(sz, da), _mm_mul_ps(sz, db), _mm_mul_ps(sz, dc));
                let nearest = _mm_min_ps(_mm_min_ps(az, bz), cz);
                let farthest = _mm_max_ps(_mm_max_ps(az, bz), cz);
                let near = _mm_cmple_ps(nearest, _mm_set1_ps(limit + tolerance.depth));
                let ahead = _mm_cmpge_ps(farthest, _mm_set1_ps(-tolerance.depth));
                let hit = _mm_and_ps(_mm_or_ps(front, back), _mm_and_ps(near, ahead));
                _mm_movemask_ps(hit) as u32
            }
        }
    }
}
