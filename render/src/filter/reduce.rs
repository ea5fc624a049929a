//! Small integers from the entries of one axis.
//!
//! The formulas are told in [`super::axis`]: at each point the forward differences of `n + 1`
//! entries give `D_n`, ..., `D_1` and the texel; from all but the texel the Newton polynomial around
//! one of the points is taken away, so that no sum from the table's origin is left. All of it is
//! addition, subtraction and multiplication by whole numbers, exact modulo 2^B.

use super::axis::MOST_POINTS;
use super::entry::binomial;
use super::word::Word;

/// The coefficients `c_k` of an n-th difference, by `n`.
pub const DIFFERENCES: [[i64; MOST_POINTS]; 4] =
    [[1, 0, 0, 0], [-1, 1, 0, 0], [1, -2, 1, 0], [-1, 3, -3, 1]];

/// How the entries of an axis become small integers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reduce {
    /// The one entry, a sum of all texels, is small already.
    Mean,
    /// `n + 1` points of `n + 1` entries.
    Difference {
        /// `sum_k c_k C(d_k, j)` for `j` = 1 and 2, which the rounding of the points leaves over.
        moments: [i64; 2],
        /// The distances `d_k` of the points from the one in the middle, or just below it.
        distances: [i64; MOST_POINTS],
    },
}

impl Reduce {
    /// For points at these places.
    #[must_use]
    #[inline]
    pub fn difference(n: usize, points: &[i64; MOST_POINTS]) -> Self {
        let middle = points[n / 2];
        let mut distances = [0; MOST_POINTS];
        let mut moments = [0; 2];
        for k in 0..=n {
            distances[k] = points[k] - middle;
            moments[0] += DIFFERENCES[n][k] * distances[k];
            if n == 3 {
                moments[1] += DIFFERENCES[n][k] * binomial(distances[k], 2) as i64;
            }
        }
        Self::Difference { moments, distances }
    }

    /// How many entries go in, along an axis of order `n`.
    #[must_use]
    pub fn entries(self, n: usize) -> usize {
        match self {
            Self::Mean => 1,
            Self::Difference { .. } => (n + 1) * (n + 1),
        }
    }

    /// How many integers come out, of at most `all`.
    #[must_use]
    pub fn reduced(self, all: usize) -> usize {
        match self {
            Self::Mean => 1,
            Self::Difference { .. } => all,
        }
    }
}

/// The `R` small integers from `E` entries: first `sum_k c_k R_n(k)`, then `R_{n-1}` and so on down
/// to `R_1` at all points but the middle one, then the texels.
#[must_use]
#[inline(always)]
pub fn difference<W: Word, const N: usize, const E: usize, const R: usize>(
    entries: &[[W; 3]; E],
    moments: &[i64; 2],
    distances: &[i64; MOST_POINTS],
) -> [[W; 3]; R] {
    let per_point = N + 1;
    let mut d = *entries;
    for point in d.chunks_exact_mut(per_point) {
        for j in 1..=N {
            for l in (j..=N).rev() {
                point[l] = minus(point[l], point[l - 1]);
            }
        }
    }
    let middle = N / 2 * per_point;
    let mut small = [[W::default(); 3]; R];
    small[0] = match N {
        1 => minus(d[per_point], d[0]),
        2 => {
            let bend = minus(minus(d[2 * per_point], d[per_point]), minus(d[per_point], d[0]));
            minus(bend, times(d[middle + 1], moments[0]))
        }
        _ => {
            let inner = minus(d[per_point], d[2 * per_point]);
            let outer = minus(d[3 * per_point], d[0]);
            let bend = plus(outer, plus(inner, plus(inner, inner)));
            let line = times(d[middle + 1], moments[0]);
            minus(bend, plus(line, times(d[middle + 2], moments[1])))
        }
    };
    let mut at = 1;
    for j in 1..N {
        for k in 0..=N {
            if k == N / 2 {
                continue;
            }
            let mut rest = minus(d[k * per_point + j], d[middle + j]);
            if j + 1 < N {
                rest = minus(rest, times(d[middle + j + 1], distances[k]));
            }
            small[at] = rest;
            at += 1;
        }
    }
    for k in 0..=N {
        small[at + k] = d[k * per_point + N];
    }
    small
}

/// Sum of each channel.
#[inline(always)]
pub fn plus<W: Word>(a: [W; 3], b: [W; 3]) -> [W; 3] {
    [a[0].plus(b[0]), a[1].plus(b[1]), a[2].plus(b[2])]
}

/// Product of each channel with a whole number.
#[inline(always)]
pub fn times<W: Word>(a: [W; 3], factor: impl Into<i128>) -> [W; 3] {
    let factor = factor.into();
    a.map(|word| word.times(factor))
}

/// Difference of each channel.
#[inline(always)]
pub fn minus<W: Word>(a: [W; 3], b: [W; 3]) -> [W; 3] {
    [a[0].minus(b[0]), a[1].minus(b[1]), a[2].minus(b[2])]
}
