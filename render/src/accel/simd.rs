//! The tests of [`super::kernel`] with AVX2 and FMA instructions, and the choice between both.
//!
//! This is the only file with `unsafe` code. It uses `unsafe` for two reasons: to load vectors from
//! arrays, and to call functions that need instructions which the processor has.

use super::kernel::{Kernel, Portable};

/// Work that runs with a kernel. `run` is inlined, so that its code may use the kernel's instructions.
pub trait Task {
    /// The result.
    type Out;
    /// Does the work.
    fn run<K: Kernel>(self, kernel: K) -> Self::Out;
}

/// The instructions that rays use.
#[derive(Debug, Clone, Copy)]
pub enum Instructions {
    /// Those that every processor has.
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
    pub fn run<T: Task>(self, task: T) -> T::Out {
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
    use super::super::block::Block;
    use super::super::frame::TreeRay;
    use super::super::kernel::{Kernel, Tolerance};
    use super::super::node::{Node, WIDTH};
    use super::Task;
    use std::arch::x86_64::*;

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
        pub fn dispatch<T: Task>(self, task: T) -> T::Out {
            #[target_feature(enable = "avx2,fma")]
            fn inner<T: Task>(kernel: Avx2, task: T) -> T::Out {
                task.run(kernel)
            }
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA.
            unsafe { inner(self, task) }
        }
    }

    #[inline(always)]
    fn load8(from: &[f32; 8]) -> __m256 {
        // SAFETY: the array holds eight numbers; the load needs no alignment. The processor has AVX
        // where an `Avx2` exists, and only its methods call this function.
        unsafe { _mm256_loadu_ps(from.as_ptr()) }
    }

    #[inline(always)]
    fn load4(from: &[f32; 4]) -> __m128 {
        // SAFETY: the array holds four numbers; the load needs no alignment. Every x86-64 processor
        // has SSE.
        unsafe { _mm_loadu_ps(from.as_ptr()) }
    }

    impl Kernel for Avx2 {
        #[inline(always)]
        fn boxes(self, node: &Node, ray: &TreeRay, limit: f32) -> ([f32; WIDTH], u32) {
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA. The store
            // writes an array of eight numbers.
            unsafe {
                let side =
                    |axis: usize, far: usize| load8(&node.sides[axis][(ray.near[axis] ^ far) & 1]);
                let near = |axis: usize| {
                    let inverse = _mm256_set1_ps(ray.inverse[axis]);
                    _mm256_fmsub_ps(side(axis, 0), inverse, _mm256_set1_ps(ray.near_start[axis]))
                };
                let far = |axis: usize| {
                    let inverse = _mm256_set1_ps(ray.inverse[axis]);
                    _mm256_fmsub_ps(side(axis, 1), inverse, _mm256_set1_ps(ray.far_start[axis]))
                };
                let enter = _mm256_max_ps(
                    _mm256_max_ps(near(0), near(1)),
                    _mm256_max_ps(near(2), _mm256_setzero_ps()),
                );
                let leave = _mm256_min_ps(
                    _mm256_min_ps(far(0), far(1)),
                    _mm256_min_ps(far(2), _mm256_set1_ps(limit)),
                );
                let mask = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave));
                let mut distances = [0.0; WIDTH];
                _mm256_storeu_ps(distances.as_mut_ptr(), enter);
                (distances, mask as u32)
            }
        }

        #[inline(always)]
        fn triangles(self, block: &Block, ray: &TreeRay, longest: f32, limit: f32) -> u32 {
            let Tolerance { edge, depth } = Tolerance::of(ray, longest);
            let [x, y, z] = ray.axes.map(|axis| axis.min(2));
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA.
            unsafe {
                let from = |corner: usize, axis: usize| {
                    _mm_sub_ps(load4(&block.corners[corner][axis]), _mm_set1_ps(ray.origin[axis]))
                };
                let [sx, sy, sz] = ray.shear.map(|shear| _mm_set1_ps(shear));
                let [da, db, dc] = [from(0, z), from(1, z), from(2, z)];
                let (ax, ay) =
                    (_mm_fnmadd_ps(sx, da, from(0, x)), _mm_fnmadd_ps(sy, da, from(0, y)));
                let (bx, by) =
                    (_mm_fnmadd_ps(sx, db, from(1, x)), _mm_fnmadd_ps(sy, db, from(1, y)));
                let (cx, cy) =
                    (_mm_fnmadd_ps(sx, dc, from(2, x)), _mm_fnmadd_ps(sy, dc, from(2, y)));
                let a = _mm_fmsub_ps(cx, by, _mm_mul_ps(cy, bx));
                let b = _mm_fmsub_ps(ax, cy, _mm_mul_ps(ay, cx));
                let c = _mm_fmsub_ps(bx, ay, _mm_mul_ps(by, ax));
                let least = |a, b, c| _mm_min_ps(_mm_min_ps(a, b), c);
                let most = |a, b, c| _mm_max_ps(_mm_max_ps(a, b), c);
                let mixed = _mm_and_ps(
                    _mm_cmplt_ps(least(a, b, c), _mm_set1_ps(-edge)),
                    _mm_cmpgt_ps(most(a, b, c), _mm_set1_ps(edge)),
                );
                let (az, bz, cz) = (_mm_mul_ps(sz, da), _mm_mul_ps(sz, db), _mm_mul_ps(sz, dc));
                let far = _mm_cmpgt_ps(least(az, bz, cz), _mm_set1_ps(limit + depth));
                let behind = _mm_cmplt_ps(most(az, bz, cz), _mm_set1_ps(-depth));
                let miss = _mm_or_ps(mixed, _mm_or_ps(far, behind));
                !_mm_movemask_ps(miss) as u32 & 0xf
            }
        }
    }
}
