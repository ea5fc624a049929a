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
    use crate::accel::bundle::{Bundle, EIGHT};
    use crate::accel::frame::TreeRay;
    use crate::accel::kernel::{Kernel, Tolerance};
    use crate::accel::lanes::{FOUR, Lanes, MOST, Met, Target};
    use crate::accel::node::{Node, WIDTH};
    use std::arch::x86_64::{
        __m128, __m256, __m256d, _CMP_EQ_OQ, _CMP_GE_OQ, _CMP_GT_OQ, _CMP_LE_OQ, _CMP_LT_OQ,
        _mm_and_ps, _mm_cmpge_ps, _mm_cmple_ps, _mm_fmsub_ps, _mm_fnmadd_ps, _mm_loadu_ps,
        _mm_max_ps, _mm_min_ps, _mm_movemask_ps, _mm_mul_ps, _mm_or_ps, _mm_set1_ps, _mm_sub_ps,
        _mm256_add_pd, _mm256_add_ps, _mm256_and_ps, _mm256_andnot_pd, _mm256_cmp_pd,
        _mm256_cmp_ps, _mm256_div_pd, _mm256_fmsub_ps, _mm256_fnmadd_ps, _mm256_loadu_pd,
        _mm256_loadu_ps, _mm256_max_pd, _mm256_max_ps, _mm256_min_pd, _mm256_min_ps,
        _mm256_movemask_pd, _mm256_movemask_ps, _mm256_mul_pd, _mm256_mul_ps, _mm256_or_ps,
        _mm256_set1_pd, _mm256_set1_ps, _mm256_setzero_pd, _mm256_setzero_ps, _mm256_storeu_pd,
        _mm256_storeu_ps, _mm256_sub_pd, _mm256_sub_ps,
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

    #[inline(always)]
    fn load4(from: &[f64; FOUR]) -> __m256d {
        // SAFETY: the array holds four numbers, and the load needs no alignment. Callers have AVX.
        unsafe { _mm256_loadu_pd(from.as_ptr()) }
    }

    #[inline(always)]
    fn store4(numbers: __m256d) -> [f64; FOUR] {
        let mut out = [0.0; FOUR];
        // SAFETY: the array holds four numbers, and the store needs no alignment. Callers have AVX.
        unsafe { _mm256_storeu_pd(out.as_mut_ptr(), numbers) };
        out
    }

    /// The distances of the near sides of eight boxes from the nearest start, and of the far sides from
    /// the farthest, along one axis: the least and the largest.
    #[inline(always)]
    fn interval(node: &Node, bundle: &Bundle, axis: usize) -> (__m256, __m256) {
        let side = bundle.near[axis] & 1;
        // SAFETY: callers have AVX.
        unsafe {
            let near = load8(&node.sides[axis][side]);
            let far = load8(&node.sides[axis][side ^ 1]);
            let near = _mm256_sub_ps(near, _mm256_set1_ps(bundle.from[0][axis]));
            let far = _mm256_sub_ps(far, _mm256_set1_ps(bundle.from[1][axis]));
            let least = _mm256_set1_ps(bundle.inverse[0][axis]);
            let most = _mm256_set1_ps(bundle.inverse[1][axis]);
            let enter = _mm256_min_ps(_mm256_mul_ps(near, least), _mm256_mul_ps(near, most));
            let leave = _mm256_max_ps(_mm256_mul_ps(far, least), _mm256_mul_ps(far, most));
            (enter, leave)
        }
    }

    /// The distances of the two sides of a box along one axis, the nearer first.
    #[inline(always)]
    fn slab(lanes: &Lanes, four: usize, target: &Target, axis: usize) -> (__m256d, __m256d) {
        // SAFETY: callers have AVX.
        unsafe {
            let inverse = load4(&lanes.inverse[axis][four]);
            let (above, below) = (load4(&lanes.above[axis][four]), load4(&lanes.below[axis][four]));
            let low = _mm256_sub_pd(_mm256_set1_pd(target.low[axis]), above);
            let high = _mm256_sub_pd(_mm256_set1_pd(target.high[axis]), below);
            let (low, high) = (_mm256_mul_pd(low, inverse), _mm256_mul_pd(high, inverse));
            (_mm256_min_pd(low, high), _mm256_max_pd(low, high))
        }
    }

    #[inline(always)]
    fn bits(mask: __m256d) -> u32 {
        // SAFETY: callers have AVX.
        unsafe { _mm256_movemask_pd(mask) as u32 }
    }

    /// The difference of two products, each rounded alone.
    #[inline(always)]
    fn cross(ax: __m256d, by: __m256d, ay: __m256d, bx: __m256d) -> __m256d {
        // SAFETY: callers have AVX.
        unsafe { _mm256_sub_pd(_mm256_mul_pd(ax, by), _mm256_mul_pd(ay, bx)) }
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

        #[inline(always)]
        fn boxes_of_all(self, node: &Node, bundle: &Bundle) -> ([f32; WIDTH], u32) {
            let (near_x, far_x) = interval(node, bundle, 0);
            let (near_y, far_y) = interval(node, bundle, 1);
            let (near_z, far_z) = interval(node, bundle, 2);
            let mut distances = [0.0; WIDTH];
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA. The array
            // holds eight numbers, and the store needs no alignment.
            unsafe {
                let near_z = _mm256_max_ps(near_z, _mm256_setzero_ps());
                let enter = _mm256_max_ps(_mm256_max_ps(near_x, near_y), near_z);
                let far_z = _mm256_min_ps(far_z, _mm256_set1_ps(bundle.farthest));
                let leave = _mm256_min_ps(_mm256_min_ps(far_x, far_y), far_z);
                let mask = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(enter, leave));
                _mm256_storeu_ps(distances.as_mut_ptr(), enter);
                (distances, mask as u32)
            }
        }

        #[inline(always)]
        fn rays(self, block: &Block, lane: usize, bundle: &Bundle, tolerance: Tolerance) -> u64 {
            let [x, y, z] = [bundle.axes[0].min(2), bundle.axes[1].min(2), bundle.axes[2].min(2)];
            let (lane, [first, second, third]) = (lane & 3, &block.corners);
            let mut mask = 0;
            let mut eight = 0;
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA.
            unsafe {
                let of = _mm256_set1_ps;
                let edges = of(tolerance.edge);
                let edges_below = of(-tolerance.edge);
                let ahead = of(-tolerance.depth);
                let slack = of(tolerance.depth);
                let (pax, pay, paz) = (of(first[x][lane]), of(first[y][lane]), of(first[z][lane]));
                let (pbx, pby, pbz) =
                    (of(second[x][lane]), of(second[y][lane]), of(second[z][lane]));
                let (pcx, pcy, pcz) = (of(third[x][lane]), of(third[y][lane]), of(third[z][lane]));
                while eight < MOST / EIGHT {
                    let oz = load8(&bundle.origin[2][eight]);
                    let (da, db, dc) =
                        (_mm256_sub_ps(paz, oz), _mm256_sub_ps(pbz, oz), _mm256_sub_ps(pcz, oz));
                    let (ox, sx) =
                        (load8(&bundle.origin[0][eight]), load8(&bundle.shear[0][eight]));
                    let ax = _mm256_fnmadd_ps(sx, da, _mm256_sub_ps(pax, ox));
                    let bx = _mm256_fnmadd_ps(sx, db, _mm256_sub_ps(pbx, ox));
                    let cx = _mm256_fnmadd_ps(sx, dc, _mm256_sub_ps(pcx, ox));
                    let (oy, sy) =
                        (load8(&bundle.origin[1][eight]), load8(&bundle.shear[1][eight]));
                    let ay = _mm256_fnmadd_ps(sy, da, _mm256_sub_ps(pay, oy));
                    let by = _mm256_fnmadd_ps(sy, db, _mm256_sub_ps(pby, oy));
                    let cy = _mm256_fnmadd_ps(sy, dc, _mm256_sub_ps(pcy, oy));
                    let a = _mm256_fmsub_ps(cx, by, _mm256_mul_ps(cy, bx));
                    let b = _mm256_fmsub_ps(ax, cy, _mm256_mul_ps(ay, cx));
                    let c = _mm256_fmsub_ps(bx, ay, _mm256_mul_ps(by, ax));
                    let least = _mm256_min_ps(_mm256_min_ps(a, b), c);
                    let most = _mm256_max_ps(_mm256_max_ps(a, b), c);
                    let sz = load8(&bundle.shear[2][eight]);
                    let (az, bz, cz) =
                        (_mm256_mul_ps(sz, da), _mm256_mul_ps(sz, db), _mm256_mul_ps(sz, dc));
                    let nearest = _mm256_min_ps(_mm256_min_ps(az, bz), cz);
                    let farthest = _mm256_max_ps(_mm256_max_ps(az, bz), cz);
                    let front = _mm256_cmp_ps::<_CMP_GE_OQ>(least, edges_below);
                    let back = _mm256_cmp_ps::<_CMP_LE_OQ>(most, edges);
                    let limit = _mm256_add_ps(load8(&bundle.limit[eight]), slack);
                    let near = _mm256_cmp_ps::<_CMP_LE_OQ>(nearest, limit);
                    let far = _mm256_cmp_ps::<_CMP_GE_OQ>(farthest, ahead);
                    let crossed = _mm256_or_ps(front, back);
                    let hit = _mm256_and_ps(crossed, _mm256_and_ps(near, far));
                    mask |= (_mm256_movemask_ps(hit) as u32 as u64) << (EIGHT * eight);
                    eight += 1;
                }
            }
            mask
        }

        #[inline(always)]
        fn four(self, lanes: &Lanes, four: usize, target: &Target) -> Met {
            let four = four % (MOST / FOUR);
            let [x, y, z] = [lanes.axes[0].min(2), lanes.axes[1].min(2), lanes.axes[2].min(2)];
            let (px, py, pz) = (target.corners[x], target.corners[y], target.corners[z]);
            let (near_x, far_x) = slab(lanes, four, target, 0);
            let (near_y, far_y) = slab(lanes, four, target, 1);
            let (near_z, far_z) = slab(lanes, four, target, 2);
            // SAFETY: a value of this type exists only if the processor has AVX2 and FMA.
            unsafe {
                let of = _mm256_set1_pd;
                let oz = load4(&lanes.origin[z][four]);
                let da = _mm256_sub_pd(of(pz.x), oz);
                let db = _mm256_sub_pd(of(pz.y), oz);
                let dc = _mm256_sub_pd(of(pz.z), oz);
                let sz = load4(&lanes.shear[2][four]);
                let (az, bz, cz) =
                    (_mm256_mul_pd(sz, da), _mm256_mul_pd(sz, db), _mm256_mul_pd(sz, dc));
                let (ox, sx) = (load4(&lanes.origin[x][four]), load4(&lanes.shear[0][four]));
                let ax = _mm256_sub_pd(_mm256_sub_pd(of(px.x), ox), _mm256_mul_pd(sx, da));
                let bx = _mm256_sub_pd(_mm256_sub_pd(of(px.y), ox), _mm256_mul_pd(sx, db));
                let cx = _mm256_sub_pd(_mm256_sub_pd(of(px.z), ox), _mm256_mul_pd(sx, dc));
                let (oy, sy) = (load4(&lanes.origin[y][four]), load4(&lanes.shear[1][four]));
                let ay = _mm256_sub_pd(_mm256_sub_pd(of(py.x), oy), _mm256_mul_pd(sy, da));
                let by = _mm256_sub_pd(_mm256_sub_pd(of(py.y), oy), _mm256_mul_pd(sy, db));
                let cy = _mm256_sub_pd(_mm256_sub_pd(of(py.z), oy), _mm256_mul_pd(sy, dc));
                let (a, b, c) =
                    (cross(cx, by, cy, bx), cross(ax, cy, ay, cx), cross(bx, ay, by, ax));
                let area = _mm256_add_pd(_mm256_add_pd(a, b), c);
                let wa = _mm256_div_pd(a, area);
                let wb = _mm256_div_pd(b, area);
                let wc = _mm256_div_pd(c, area);
                let t = _mm256_add_pd(_mm256_mul_pd(wa, az), _mm256_mul_pd(wb, bz));
                let t = _mm256_add_pd(t, _mm256_mul_pd(wc, cz));
                let zero = _mm256_setzero_pd();
                let enter =
                    _mm256_max_pd(_mm256_max_pd(near_x, near_y), _mm256_max_pd(near_z, zero));
                let leave = _mm256_min_pd(_mm256_min_pd(far_x, far_y), far_z);
                let clamped = _mm256_min_pd(_mm256_max_pd(t, enter), leave);
                let t_max = load4(&lanes.t_max[four]);
                let limit = _mm256_add_pd(t_max, load4(&lanes.slack[four]));
                let least = _mm256_min_pd(_mm256_min_pd(a, b), c);
                let most = _mm256_max_pd(_mm256_max_pd(a, b), c);
                let nearest = _mm256_min_pd(_mm256_min_pd(az, bz), cz);
                let beyond = bits(_mm256_cmp_pd::<_CMP_GT_OQ>(nearest, limit));
                let negative = bits(_mm256_cmp_pd::<_CMP_LT_OQ>(least, zero));
                let positive = bits(_mm256_cmp_pd::<_CMP_GT_OQ>(most, zero));
                let empty = bits(_mm256_cmp_pd::<_CMP_EQ_OQ>(area, zero));
                let crossed = bits(_mm256_cmp_pd::<_CMP_LE_OQ>(enter, leave));
                let ahead = bits(_mm256_cmp_pd::<_CMP_GT_OQ>(t, zero));
                let met = bits(_mm256_cmp_pd::<_CMP_GT_OQ>(clamped, zero));
                let within = bits(_mm256_cmp_pd::<_CMP_LE_OQ>(clamped, t_max));
                let missed = beyond | (negative & positive) | empty;
                let sign = of(-0.0);
                let apart = _mm256_mul_pd(t, _mm256_andnot_pd(sign, area));
                let off = _mm256_mul_pd(of(target.off), _mm256_andnot_pd(sign, sz));
                Met {
                    clear: bits(_mm256_cmp_pd::<_CMP_GT_OQ>(apart, off)),
                    mask: !missed & crossed & ahead & met & within,
                    t: store4(clamped),
                    weights: [store4(wb), store4(wc)],
                }
            }
        }
    }
}
