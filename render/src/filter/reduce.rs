//! Reduces the entries of one axis to small integers.
//!
//! The formulas are in [`super::axis`]. At each point the forward differences of `n + 1` entries
//! give `D_n`, ..., `D_1` and the texel. The Newton polynomial around one of the points is
//! subtracted from all but the texel, which removes the sums from the table's origin. All steps are
//! additions, subtractions and multiplications by whole numbers, exact modulo 2^B.

use super::entry::binomial;
use super::word::Word;

/// Highest order of a table.
pub const HIGHEST: usize = 3;

/// Largest number of points in a difference.
pub const MOST_POINTS: usize = HIGHEST + 1;

/// Coefficients `c_k` of an n-th difference, indexed by `n`.
pub const DIFFERENCES: [[i64; MOST_POINTS]; 4] =
    [[1, 0, 0, 0], [-1, 1, 0, 0], [1, -2, 1, 0], [-1, 3, -3, 1]];

/// The reduction of an axis's entries to small integers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reduce {
    /// A single entry, the sum of all texels, which is small already.
    Mean,
    /// A difference of `n + 1` points with `n + 1` entries each.
    Difference {
        /// `sum_k c_k C(d_k, j)` for `j` = 1 and 2. The moments are not 0 because points are
        /// rounded.
        moments: [i64; 2],
        /// Distances `d_k` of the points from the middle one, or from the one just below the
        /// middle.
        distances: [i64; MOST_POINTS],
    },
}

impl Reduce {
    /// Creates the reduction for a filter of order `n` with these integer points.
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

    /// Returns the number of entries that are reduced, along an axis of order `n`.
    #[must_use]
    pub fn entries(self, n: usize) -> usize {
        match self {
            Self::Mean => 1,
            Self::Difference { .. } => (n + 1) * (n + 1),
        }
    }

    /// Returns the number of reduced integers, at most `all`.
    #[must_use]
    pub fn reduced(self, all: usize) -> usize {
        match self {
            Self::Mean => 1,
            Self::Difference { .. } => all,
        }
    }
}

/// Reduces `E` entries to `R` small integers. The first is `sum_k c_k R_n(k)`. It is followed by
/// `R_{n-1}` down to `R_1` at all points but the middle one, and then by the texels.
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

/// Adds channel by channel.
#[inline(always)]
pub fn plus<W: Word>(a: [W; 3], b: [W; 3]) -> [W; 3] {
    [a[0].plus(b[0]), a[1].plus(b[1]), a[2].plus(b[2])]
}

/// Multiplies each channel by a whole number.
#[inline(always)]
pub fn times<W: Word>(a: [W; 3], factor: impl Into<i128>) -> [W; 3] {
    let factor = factor.into();
    a.map(|word| word.times(factor))
}

/// Subtracts channel by channel.
#[inline(always)]
pub fn minus<W: Word>(a: [W; 3], b: [W; 3]) -> [W; 3] {
    [a[0].minus(b[0]), a[1].minus(b[1]), a[2].minus(b[2])]
}
