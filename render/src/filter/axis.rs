//! One axis of a repeated integration filter: which table entries, with which weights.
//!
//! Heckbert, *Filtering by Repeated Integration*, SIGGRAPH 1986. Let `T(i)` be the texels of one
//! row, `D_1(i)` the sum of those before `i`, `D_2(i)` the sum of `D_1` before `i`. The texture is
//! constant on each texel, so its n-fold integral at `i + f` is, for `f` in `[0, 1)`,
//!
//! ```text
//!   F_1(i + f) = (1 - f) D_1(i) + f D_1(i+1)
//!   F_2(i + f) = (1/2 - f + f^2/2) D_2(i) + (1/2 + f - f^2) D_2(i+1) + f^2/2 D_2(i+2)
//! ```
//!
//! and the average under the box of width `h` (n = 1), or under the tent of half-width `h` (n = 2),
//! centred at `x`, is an n-th difference of it, exact for real `x` and `h`:
//!
//! ```text
//!   n = 1:  (F_1(x + h/2) - F_1(x - h/2)) / h
//!   n = 2:  (F_2(x + h) - 2 F_2(x) + F_2(x - h)) / h^2
//! ```
//!
//! Real weights must not touch huge sums, whose differences alone are exact modulo 2^B. With `i_k`
//! and `f_k` the whole and the broken part of the k-th point, the difference is therefore written
//! over reduced integers, each a small difference of entries:
//!
//! ```text
//!   n = 1:  D(i_1) - D(i_0),  and with weights f_1, -f_0 the texels T(i_1), T(i_0)
//!   n = 2:  D(i_0) - 2 D(i_1) + D(i_2) + m D'(i_1),
//!           with weights 1/2 + f_0 and 1/2 + f_2:  D'(i_0) - D'(i_1),  D'(i_2) - D'(i_1),
//!           with weights f_0^2/2, -f_1^2, f_2^2/2:  T(i_0), T(i_1), T(i_2)
//! ```
//!
//! where `D'(i) = D(i+1) - D(i)` and the whole number `m = 2 i_1 - i_0 - i_2` is `f_0 - 2 f_1 + f_2`,
//! because the points are evenly spaced. That is what makes a table of wrapping integers usable for
//! real places and widths.
//!
//! The table holds `D_n(i)` for `i` from 0 to `size + n - 1`. Beyond that `D_n` goes on as a
//! polynomial in the stored entries, which [`Entry`] writes down; so no footprint is too large and
//! none is too far from the origin.
//!
//! A footprint wider than a repeating texture is folded, exactly: shifting a difference's points by
//! whole periods changes the kernel by a constant only, so the box of width `q size + r` is the box
//! of width `r` with weight `r/h` and the mean of the axis for the rest, and the tent of half-width
//! `h` is that of half-width `r`, its distance from the nearest multiple of the size, with weight
//! `(r/h)^2` and the mean for the rest.

use crate::texture::Wrap;

/// At most this many entries make an axis: three points of three.
pub const MOST: usize = 9;

/// At most this many integers are left of them.
pub const MOST_REDUCED: usize = 6;

/// Under [`Wrap::Clamp`], wider footprints are taken as this many times the texture.
///
/// They average little but the edge texels already (a sixteenth of a tent's weight lies on the
/// texture), and the integers that hold their sums stay short.
const WIDEST_CLAMPED: f64 = 4.0;

/// A table entry at any index, as a sum of stored ones.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Entry {
    /// Stored entries and their whole factors; unused terms have factor 0 and come last.
    pub terms: [(usize, i64); 3],
}

/// One axis of a filter: at which points, and with which weights.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    /// What is done to the entries.
    pub reduce: Reduce,
    /// The whole parts `i_k` of the points; entries `i_k` to `i_k + n` belong to each.
    pub points: [i64; 3],
    /// A weight for each reduced integer in use.
    pub weights: [f64; MOST_REDUCED],
    /// Whether all entries are stored ones.
    pub plain: bool,
    size: i64,
    wrap: Wrap,
    n: usize,
}

impl Axis {
    /// An entry as a sum of stored ones; `slot` counts the entries of all points (the mean's only
    /// entry answers for any slot).
    #[must_use]
    pub fn entry(&self, slot: usize) -> Entry {
        match self.reduce {
            // D_1(size), which a table of order 2 holds as a difference.
            Reduce::Mean if self.n == 1 => Entry::stored([(self.size, 1), (0, 0), (0, 0)]),
            Reduce::Mean => Entry::stored([(self.size + 1, 1), (self.size, -1), (0, 0)]),
            Reduce::Box | Reduce::Tent { .. } => {
                let per_point = self.n + 1;
                let point = self.points[(slot / per_point).min(self.n)];
                let index = point + (slot % per_point) as i64;
                entry(self.n, index, self.size, self.wrap)
            }
        }
    }
}

impl Entry {
    /// The terms with their factors, those without a factor left out.
    pub fn used(&self) -> impl Iterator<Item = (usize, i64)> {
        self.terms.into_iter().filter(|term| term.1 != 0)
    }

    fn stored(terms: [(i64, i64); 3]) -> Self {
        Self { terms: terms.map(|(index, factor)| (index as usize, factor)) }
    }
}

/// How the entries of an axis become small integers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reduce {
    /// The one entry is small already.
    Mean,
    /// Two points of two entries.
    Box,
    /// Three points of three entries.
    Tent {
        /// `2 i_1 - i_0 - i_2`.
        m: i64,
    },
}

impl Reduce {
    /// How many entries go in.
    #[must_use]
    pub fn entries(self) -> usize {
        match self {
            Self::Mean => 1,
            Self::Box => 4,
            Self::Tent { .. } => 9,
        }
    }

    /// How many integers come out.
    #[must_use]
    pub fn reduced(self) -> usize {
        match self {
            Self::Mean => 1,
            Self::Box => 3,
            Self::Tent { .. } => 6,
        }
    }
}

/// An axis and how much it counts; a folded footprint has a second one, the mean.
#[derive(Debug, Clone, Copy)]
pub struct Part {
    /// Its entries and weights; they average, so they give 1 for a texture of ones.
    pub axis: Axis,
    /// Its share; those of all parts sum to 1.
    pub share: f64,
}

/// The parts of the filter of order `n` centred at `x` with half-support `half`, both in texels.
///
/// The step is never below a texel: a smaller footprint is smoothed by the B-spline of degree `n`,
/// which for n = 1 is bilinear interpolation.
#[must_use]
pub fn parts(n: usize, x: f64, half: f64, size: usize, wrap: Wrap) -> [Option<Part>; 2] {
    let size_f = size as f64;
    let step = (2.0 * half / n as f64).max(1.0);
    match wrap {
        Wrap::Clamp => {
            let step = step.min(WIDEST_CLAMPED * size_f);
            // Further out the clamped texture is constant and the place does not matter.
            let reach = 2.0 * (step + size_f);
            let x = x.clamp(-reach, size_f + reach);
            [Some(Part { axis: difference(n, x, step, size, wrap), share: 1.0 }), None]
        }
        Wrap::Repeat => {
            let folded = fold(n, step, size_f);
            let share = (folded / step).powi(n as i32);
            let mean = Part { axis: mean(n, size, wrap), share: 1.0 - share };
            // A box keeps its lower end, a tent its middle.
            let middle = if n == 1 { x - 0.5 * (step - folded) } else { x };
            // A step of 0 is a whole number of periods: only the mean is left.
            let local = (share > 0.0).then(|| {
                let lowest = middle - 0.5 * n as f64 * folded;
                let shift = (lowest / size_f).floor() * size_f;
                Part { axis: difference(n, middle - shift, folded, size, wrap), share }
            });
            let folds = folded < step;
            [local, (folds || local.is_none()).then_some(mean)]
        }
    }
}

/// The step of the narrower filter that, with the mean, stands for one of `step`.
fn fold(n: usize, step: f64, size: f64) -> f64 {
    let widest = if n == 1 { size } else { 0.5 * size };
    if step < widest {
        // The usual case, without a slow remainder.
        return step;
    }
    let rest = step % size;
    if n == 1 { rest } else { rest.min(size - rest) }
}

/// The n-th difference of the n-fold integral around `x`.
fn difference(n: usize, x: f64, step: f64, size: usize, wrap: Wrap) -> Axis {
    let size = size as i64;
    let mut points = [0; 3];
    let mut f = [0.0; 3];
    for k in 0..=n {
        let point = x + (k as f64 - 0.5 * n as f64) * step;
        let whole = point.floor();
        f[k] = point - whole;
        points[k] = whole as i64;
    }
    let plain = points[0] >= 0 && points[n] < size;
    let (reduce, weights) = if n == 1 {
        let scale = 1.0 / step;
        (Reduce::Box, [scale, scale * f[1], -scale * f[0], 0.0, 0.0, 0.0])
    } else {
        let [half, scale] = [0.5, 1.0 / (step * step)];
        let bends = [half * f[0] * f[0], -f[1] * f[1], half * f[2] * f[2]];
        let weights = [1.0, half + f[0], half + f[2], bends[0], bends[1], bends[2]];
        let m = 2 * points[1] - points[0] - points[2];
        (Reduce::Tent { m }, weights.map(|weight| scale * weight))
    };
    Axis { reduce, points, weights, plain, size, wrap, n }
}

/// The mean over the whole size: `D_1(size) / size`.
fn mean(n: usize, size: usize, wrap: Wrap) -> Axis {
    let mut weights = [0.0; MOST_REDUCED];
    weights[0] = 1.0 / size as f64;
    let size = size as i64;
    Axis { reduce: Reduce::Mean, points: [0; 3], weights, plain: false, size, wrap, n }
}

/// `D_n(i)` for any `i`, from the entries `0..size + n` of the table.
fn entry(n: usize, i: i64, size: i64, wrap: Wrap) -> Entry {
    if (0..size + n as i64).contains(&i) {
        return Entry::stored([(i, 1), (0, 0), (0, 0)]);
    }
    let triangular = |k: i64| k * (k - 1) / 2;
    match (wrap, n) {
        (Wrap::Repeat, _) => {
            let (q, i) = (i.div_euclid(size), i.rem_euclid(size));
            if n == 1 {
                return Entry::stored([(i, 1), (size, q), (0, 0)]);
            }
            let sums = q * i + size * triangular(q);
            Entry::stored([(i, 1), (size, q - sums), (size + 1, sums)])
        }
        (Wrap::Clamp, 1) if i < 0 => Entry::stored([(1, i), (0, 0), (0, 0)]),
        (Wrap::Clamp, 1) => {
            let beyond = i - size;
            Entry::stored([(size, 1 + beyond), (size - 1, -beyond), (0, 0)])
        }
        // D_2(2) is the first texel.
        (Wrap::Clamp, _) if i < 0 => Entry::stored([(2, triangular(1 - i)), (0, 0), (0, 0)]),
        (Wrap::Clamp, _) => {
            let beyond = i - size;
            let last = triangular(beyond);
            Entry::stored([
                (size, 1 - beyond - 2 * last),
                (size + 1, beyond + last),
                (size - 1, last),
            ])
        }
    }
}

/// A bound on the reduced integers of one axis for texels of 1: what the table's words must hold,
/// with a sign.
#[must_use]
pub fn sum_bound(n: usize, size: usize, wrap: Wrap) -> f64 {
    let size = size as f64;
    let widest = match (wrap, n) {
        (Wrap::Repeat, 1) => size,
        (Wrap::Repeat, _) => 0.5 * size,
        (Wrap::Clamp, _) => WIDEST_CLAMPED * size,
    };
    // A step is at least a texel; points are rounded and followed by n more entries.
    let far = widest.max(1.0) + 3.0;
    if n == 1 { far } else { far * (far + 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// `D_n` of a wrapped row by counting, for `i` of either sign.
    fn direct(n: usize, i: i64, row: &[i64], wrap: Wrap) -> i64 {
        let size = row.len() as i64;
        let texel = |k: i64| match wrap {
            Wrap::Repeat => row[k.rem_euclid(size) as usize],
            Wrap::Clamp => row[k.clamp(0, size - 1) as usize],
        };
        let value = |k: i64| if n == 1 { texel(k) } else { direct(1, k, row, wrap) };
        if i >= 0 { (0..i).map(value).sum() } else { -(i..0).map(value).sum::<i64>() }
    }

    fn wraps() -> impl Strategy<Value = Wrap> {
        prop_oneof![Just(Wrap::Repeat), Just(Wrap::Clamp)]
    }

    proptest! {
        #[test]
        fn entries_beyond_the_table_are_exact(
            row in prop::collection::vec(-9i64..9, 1..6), i in -30i64..30, n in 1usize..=2,
            wrap in wraps(),
        ) {
            let table: Vec<i64> =
                (0..(row.len() + n) as i64).map(|k| direct(n, k, &row, wrap)).collect();
            let entry = entry(n, i, row.len() as i64, wrap);
            let value: i64 = entry.terms.iter().map(|&(k, factor)| table[k] * factor).sum();
            prop_assert_eq!(value, direct(n, i, &row, wrap));
        }

        /// The parts against the kernel itself, integrated texel by texel.
        #[test]
        fn the_average_is_that_of_the_kernel(
            row in prop::collection::vec(0i64..9, 1..6), x in -20.0..20.0f64,
            half in 0.0..12.0f64, n in 1usize..=2, wrap in wraps(),
        ) {
            let size = row.len();
            let table: Vec<i64> =
                (0..(size + n) as i64).map(|k| direct(n, k, &row, wrap)).collect();
            let mut average = 0.0;
            for part in parts(n, x, half, size, wrap).into_iter().flatten() {
                let Axis { weights, reduce, .. } = part.axis;
                let mut line = [[0u64; 3]; MOST];
                for (slot, value) in line.iter_mut().enumerate().take(reduce.entries()) {
                    let terms = part.axis.entry(slot).terms;
                    let sum: i64 = terms.iter().map(|&(k, factor)| table[k] * factor).sum();
                    *value = [sum as u64; 3];
                }
                let words = crate::filter::table::reduced(reduce, &line);
                for (word, weight) in words.iter().zip(weights).take(reduce.reduced()) {
                    average += part.share * weight * word[0] as i64 as f64;
                }
            }
            let limit = if wrap == Wrap::Clamp { WIDEST_CLAMPED * size as f64 } else { f64::MAX };
            let step = (2.0 * half / n as f64).clamp(1.0, limit);
            let truth = brute_force(n, x, step, &row, wrap);
            // Sums of at most 1e5 in f64.
            prop_assert!((average - truth).abs() < 1e-9, "{} {}", average, truth);
        }
    }

    /// The kernel's own integral over each texel times the texel.
    fn brute_force(n: usize, x: f64, step: f64, row: &[i64], wrap: Wrap) -> f64 {
        // The kernel's integral from minus infinity to its middle plus z.
        let integral = |z: f64| {
            let z = (z / step).clamp(-0.5 * n as f64, 0.5 * n as f64);
            match n {
                1 => z + 0.5,
                _ if z < 0.0 => 0.5 * (z + 1.0) * (z + 1.0),
                _ => 1.0 - 0.5 * (1.0 - z) * (1.0 - z),
            }
        };
        let reach = (0.5 * n as f64 * step) as i64 + 2;
        let size = row.len() as i64;
        (x as i64 - reach..=x as i64 + reach)
            .map(|i| {
                let weight = integral((i + 1) as f64 - x) - integral(i as f64 - x);
                let k =
                    if wrap == Wrap::Repeat { i.rem_euclid(size) } else { i.clamp(0, size - 1) };
                weight * row[k as usize] as f64
            })
            .sum()
    }
}
