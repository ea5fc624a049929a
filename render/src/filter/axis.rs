//! One axis of a repeated integration filter: its table entries and their weights.
//!
//! The method is Heckbert, *Filtering by Repeated Integration*, SIGGRAPH 1986. Let `T(i)` be the
//! texels of one row. `D_1(i)` is the sum of the texels before `i`, and `D_n(i)` is the sum of
//! `D_{n-1}` before `i`. The differences of `D_n` are therefore `D_{n-1}`, down to `D_0 = T`. The
//! texture is constant on each texel, and its n-fold integral at `i + f` is, for `f` in `[0, 1)`,
//!
//! ```text
//!   F_1(i + f) = D_1(i) + f T(i)
//!   F_2(i + f) = D_2(i) + (1/2 + f) D_1(i) + f^2/2 T(i)
//!   F_3(i + f) = D_3(i) + (1 + f) D_2(i) + (1/6 + f/2 + f^2/2) D_1(i) + f^3/6 T(i)
//! ```
//!
//! The average under the B-spline of order `n` and step `h`, centred at `x`, is an n-th difference
//! of this integral. It is exact for real `x` and `h`. The B-spline is a box of width `h` (n = 1),
//! a tent of half-width `h` (n = 2) or a quadratic of half-width `3h/2` (n = 3):
//!
//! ```text
//!   h^-n  sum_k  c_k F_n(p_k),    p_k = x + (k - n/2) h,    c_k = (-1)^(n-k) C(n,k)
//! ```
//!
//! The `c_k` of both axes multiply to the grid coefficients of thesis fig. 3.9.
//!
//! Only differences of the huge sums are exact modulo 2^B, so real weights must not multiply the
//! sums themselves. Let `i_k` be the integer part of `p_k` and `f_k` its fractional part. Subtract
//! from every `D_m(i_k)` its Newton polynomial around one of the points, `r`. With `d = i_k - r`,
//! the rest
//! ```text
//!   R_m(k) = D_m(i_k) - D_m(r) - C(d,1) D_{m-1}(r) - ... - C(d,m-1) D_1(r),
//! ```
//!
//! is an integer as small as the footprint. The polynomials themselves sum to zero, since their sum
//! is the n-th difference of a polynomial of degree below `n` in the evenly spaced `p_k`.
//! [`super::reduce`] computes these small integers and [`Axis::weights`] holds their real weights.
//! A table of wrapping integers thus serves real positions and widths.
//!
//! The table holds `D_n(i)` for `i` from 0 to `size + n - 1`. Beyond that range `D_n` continues as
//! a polynomial in the stored entries; see [`super::entry`]. Any footprint size and any distance
//! from the origin is therefore allowed.
//!
//! A footprint wider than half a period of a repeating texture is folded exactly. A box of width
//! `h = q P + r`, with `r` of either sign, is `q` whole periods and a box of width `|r|`, which is
//! added or removed. The average is therefore the mean of the axis with weight `1 - r/h` and the
//! average under the small box, moved by `q P/2`, with weight `r/h`. A filter of order `n` is `n`
//! boxes in succession. Its small filter has weight `(r/h)^n` and is moved by `n q P/2`, and the
//! mean has the rest of the weight. The period is the size, or twice the size under
//! [`Wrap::Mirror`].

use super::entry::{Entry, Line};
use super::reduce::{MOST_POINTS, Reduce};
use crate::texture::Wrap;

/// Largest number of reduced integers of an axis.
pub const MOST_REDUCED: usize = 11;

/// Widest step under [`Wrap::Clamp`], in sizes of the texture. Wider steps are narrowed to it.
///
/// A filter this wide already averages mostly the edge texels: about a quarter of a tent's weight
/// lies on the texture along one axis, and a sixteenth along both. The limit keeps the integers
/// that hold the sums short.
pub const WIDEST_CLAMPED: f64 = 4.0;

/// One axis of a filter: the points at which it reads the table, and their weights.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    /// Reduction of the entries to small integers.
    pub reduce: Reduce,
    /// Integer parts `i_k` of the points. Each point uses the entries `i_k` to `i_k + n`.
    pub points: [i64; MOST_POINTS],
    /// One weight for each reduced integer in use.
    pub weights: [f64; MOST_REDUCED],
    /// True if all entries are stored in the table, so that none has to be continued.
    pub plain: bool,
    /// The table's axis.
    pub line: Line,
}

impl Axis {
    /// Returns an entry in terms of stored ones. `slot` counts the entries of all points, `n + 1`
    /// for each. [`Reduce::Mean`] has a single entry.
    #[must_use]
    pub fn entry(&self, slot: usize) -> Entry {
        let per_point = self.line.n + 1;
        match self.reduce {
            Reduce::Mean => self.line.sum(),
            Reduce::Difference { .. } => {
                self.line.entry(self.points[slot / per_point] + (slot % per_point) as i64)
            }
        }
    }
}

/// An axis and its share in the average. A folded footprint has a second part, the mean.
#[derive(Debug, Clone, Copy)]
pub struct Part {
    /// Entries and weights of the part, normalized: a texture of ones gives 1.
    pub axis: Axis,
    /// Share of the part, of either sign. The shares of all parts sum to 1.
    pub share: f64,
}

/// Returns the parts of the filter of order `n` centred at `x` with half-support `half`, both in
/// texels.
///
/// The step is at least one texel. A smaller footprint is smoothed by the B-spline of degree `n`,
/// which for n = 1 is bilinear interpolation.
#[must_use]
#[inline]
pub fn parts(n: usize, x: f64, half: f64, size: usize, wrap: Wrap) -> [Option<Part>; 2] {
    let step = (2.0 * half / n as f64).max(1.0);
    let line = Line { n, size: size as i64, wrap };
    let Some(period) = wrap.period(size) else {
        let step = step.min(WIDEST_CLAMPED * size as f64);
        // Further out the clamped texture is constant, and the position does not matter.
        let reach = 2.0 * (step + size as f64);
        let x = x.clamp(-reach, size as f64 + reach);
        return [Some(Part { axis: difference(line, x, step), share: 1.0 }), None];
    };
    if 2.0 * step <= period {
        // The usual case, which avoids a slow remainder.
        let axis = difference(line, nearest(line, x, step, period), step);
        return [Some(Part { axis, share: 1.0 }), None];
    }
    let beyond = step % period;
    let rest = if 2.0 * beyond > period { beyond - period } else { beyond };
    let share = (rest / step).powi(n as i32);
    let odd = (n as f64 * ((step - rest) / period).round()) % 2.0 == 1.0;
    let x = if odd { x - 0.5 * period } else { x };
    // A step of a whole number of periods leaves only the mean.
    let local = (share != 0.0).then(|| {
        let step = rest.abs();
        Part { axis: difference(line, nearest(line, x, step, period), step), share }
    });
    [local, Some(Part { axis: mean(line), share: 1.0 - share })]
}

/// Returns an equivalent centre near the origin. It is `x` itself if the filter lies on the
/// texture; otherwise the first point of the filter lies in the first period.
fn nearest(line: Line, x: f64, step: f64, period: f64) -> f64 {
    let reach = 0.5 * line.n as f64 * step;
    let x = if x - reach >= 0.0 && x + reach < line.size as f64 {
        return x;
    } else if line.wrap == Wrap::Mirror {
        // The filter is even, and a mirrored texture is even around its edges.
        let x = x.rem_euclid(period);
        if 2.0 * x > period { period - x } else { x }
    } else {
        x
    };
    x - ((x - reach) / period).floor() * period
}

/// Takes the n-th difference of the n-fold integral around `x`.
#[inline]
fn difference(line: Line, x: f64, step: f64) -> Axis {
    let n = line.n;
    let mut points = [0; MOST_POINTS];
    let mut f = [0.0; MOST_POINTS];
    for k in 0..=n {
        let point = x + (k as f64 - 0.5 * n as f64) * step;
        // Rounds down without a function call; positions are far below 2^63.
        let toward_zero = point as i64;
        let whole = toward_zero - i64::from(point < toward_zero as f64);
        f[k] = point - whole as f64;
        points[k] = whole;
    }
    let plain = points[0] >= 0 && points[n] < line.size;
    let mut weights = [0.0; MOST_REDUCED];
    match n {
        1 => {
            let scale = 1.0 / step;
            weights[..3].copy_from_slice(&[scale, -scale * f[0], scale * f[1]]);
        }
        2 => {
            let [half, scale] = [0.5, 1.0 / (step * step)];
            let bends = [half * f[0] * f[0], -f[1] * f[1], half * f[2] * f[2]];
            let exact = [1.0, half + f[0], half + f[2], bends[0], bends[1], bends[2]];
            weights[..6].copy_from_slice(&exact.map(|weight| scale * weight));
        }
        _ => {
            let scale = 1.0 / (step * step * step);
            let c = [-scale, 3.0 * scale, -3.0 * scale, scale];
            weights[0] = scale;
            for (at, k) in [0, 2, 3].into_iter().enumerate() {
                weights[1 + at] = c[k] * (1.0 + f[k]);
                weights[4 + at] = c[k] * (1.0 / 6.0 + 0.5 * f[k] * (1.0 + f[k]));
            }
            for k in 0..=n {
                weights[7 + k] = c[k] * f[k] * f[k] * f[k] / 6.0;
            }
        }
    }
    Axis { reduce: Reduce::difference(n, &points), points, weights, plain, line }
}

/// Takes the mean over the whole size: `D_1(size) / size`.
fn mean(line: Line) -> Axis {
    let mut weights = [0.0; MOST_REDUCED];
    weights[0] = 1.0 / line.size as f64;
    let points = [0; MOST_POINTS];
    Axis { reduce: Reduce::Mean, points, weights, plain: false, line }
}

/// Returns a bound on the reduced integers of one axis for texels of 1. The words of a table must
/// hold it, with a sign, times the largest texel.
#[must_use]
pub fn sum_bound(n: usize, size: usize, wrap: Wrap) -> f64 {
    let size = size as f64;
    let widest = match wrap {
        Wrap::Repeat => 0.5 * size,
        Wrap::Mirror => size,
        Wrap::Clamp => WIDEST_CLAMPED * size,
    };
    // The sum of all texels, from which the mean is computed, is also a reduced integer.
    reduced_bound(n, widest.max(1.0)).max(size)
}

/// Returns this bound for steps up to `step`. The kernel's own sum is `step^n`. The margin of 3
/// covers the rounding of points and the `n` entries that follow each of them.
fn reduced_bound(n: usize, step: f64) -> f64 {
    (step + 3.0).powi(n as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::entry::tests::{direct, wraps};
    use crate::filter::kernel;
    use crate::filter::reduce::difference as reduced;
    use proptest::prelude::*;

    /// Averages a table with the reduced integers and weights of an axis.
    fn average<const N: usize, const E: usize, const R: usize>(axis: &Axis, table: &[i64]) -> f64 {
        let value = |slot| [axis.line.value(&axis.entry(slot), table) as u64; 3];
        let words: Vec<[u64; 3]> = match &axis.reduce {
            Reduce::Mean => vec![value(0)],
            Reduce::Difference { moments, distances } => {
                let entries: [_; E] = std::array::from_fn(value);
                reduced::<u64, N, E, R>(&entries, moments, distances).to_vec()
            }
        };
        words.iter().zip(axis.weights).map(|(word, weight)| weight * word[0] as i64 as f64).sum()
    }

    proptest! {
        /// Compares the parts with the kernel itself, integrated texel by texel.
        #[test]
        fn the_average_is_that_of_the_kernel(
            row in prop::collection::vec(0i64..9, 1..6), x in -20.0..20.0f64,
            half in prop_oneof![0.0..18.0f64, (0..30u8).prop_map(|k| 0.5 * f64::from(k))],
            n in 1usize..=3, wrap in wraps(),
        ) {
            let size = row.len();
            let table: Vec<i64> =
                (0..(size + n) as i64).map(|k| direct(n, k, &row, wrap)).collect();
            let mut sum = 0.0;
            for Part { axis, share } in parts(n, x, half, size, wrap).into_iter().flatten() {
                sum += share * match n {
                    1 => average::<1, 4, 3>(&axis, &table),
                    2 => average::<2, 9, 6>(&axis, &table),
                    _ => average::<3, 16, 11>(&axis, &table),
                };
            }
            let limit = if wrap == Wrap::Clamp { WIDEST_CLAMPED * size as f64 } else { f64::MAX };
            let step = (2.0 * half / n as f64).clamp(1.0, limit);
            let weights = kernel::weights(n, x, step);
            let truth: f64 = weights
                .map(|(i, weight)| weight * row[wrap.index(i as f64, size)] as f64)
                .sum();
            // The sums are at most 1e5, in f64.
            prop_assert!((sum - truth).abs() < 1e-9, "{} {}", sum, truth);
        }
    }

    #[test]
    fn reduced_integers_stay_below_their_bound() {
        // Texels from -1 to 1 give at most the sum of the absolute values that each texel gives
        // alone.
        fn most<const N: usize, const E: usize, const R: usize>(
            line: Line,
            x: f64,
            step: f64,
        ) -> i64 {
            let axis = difference(line, x, step);
            let Reduce::Difference { moments, distances } = axis.reduce else { unreachable!() };
            let mut sums = [0i64; R];
            for texel in 0..line.size as usize {
                let mut row = vec![0; line.size as usize];
                row[texel] = 1;
                let entries = std::array::from_fn(|slot| {
                    let i = axis.points[slot / (N + 1)] + (slot % (N + 1)) as i64;
                    [direct(N, i, &row, line.wrap) as u64; 3]
                });
                let small = reduced::<u64, N, E, R>(&entries, &moments, &distances);
                for (sum, word) in sums.iter_mut().zip(small) {
                    *sum += (word[0] as i64).abs();
                }
            }
            sums.into_iter().max().unwrap()
        }
        for (n, k, size) in (1..=3).flat_map(|n| (0..40).map(move |k| (n, k, 100))) {
            let line = Line { n, size, wrap: Wrap::Repeat };
            let (x, step) = (50.0 + 0.137 * f64::from(k), 1.0 + f64::from(k * k) * 0.0131);
            let most = match n {
                1 => most::<1, 4, 3>(line, x, step),
                2 => most::<2, 9, 6>(line, x, step),
                _ => most::<3, 16, 11>(line, x, step),
            };
            let bound = reduced_bound(n, step);
            assert!((most as f64) < bound, "order {n}, step {step}: {most}, bound {bound}");
        }
    }
}
