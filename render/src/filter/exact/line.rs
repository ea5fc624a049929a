//! The lines of one level of a texture, ready to be integrated along their length.
//!
//! A line is a row of texels, or a column if the texture is transposed. The texture is constant on
//! each texel. The integrals along a line at `x`, in texels from its start, are, for `i` the whole
//! part of `x` and `f` the rest,
//!
//! ```text
//!   F1(i + f) = F1(i) + f T(i)                    F1(i) = sum_{k<i} T(k)
//!   F2(i + f) = F2(i) + f F1(i) + f^2/2 T(i)      F2(i) = sum_{k<i} (F1(k) + T(k)/2)
//! ```
//!
//! Both are stored at every 16th texel, as exact integers. The texels between are added when they
//! are needed, from the nearer of two stored values. `F2` needs 64 bits. They are stored at every
//! 256th texel, and the values between as differences from there, which fit 32 bits. This takes one
//! byte for each texel and half a byte for the sums, where tables of `F1` and `F2` would take 12 bytes
//! for each texel.
//!
//! A repeating line continues as the integrals of its deviation from the mean `m`,
//!
//! ```text
//!   p(x) = F1(x) - m x - c        q(x) = F2(x) - m x^2/2 - c x
//! ```
//!
//! With `c` the mean of `F1(x) - m x`, both repeat with the line. A mirrored line makes `p` odd and
//! `q` even around its ends; `c` is 0. A clamped line continues with its edge texels, and `m` and
//! `c` are 0.

use super::floor;
use super::palette::Code;
use crate::texture::{Wrap, reduced};
use std::array::from_fn;
use std::fmt::Debug;

/// Texels between stored values of the integrals.
///
/// An average adds a quarter as many texels for each end of each line that an edge crosses. Twice as
/// many save a quarter of a byte for each texel and take up to twice the time.
const EVERY: usize = 16;

/// Texels between stored values of the second integral of 64 bits, a multiple of [`EVERY`].
///
/// The differences from there are at most `65535 * ANCHORED^2`, which fits 32 bits.
const ANCHORED: usize = 256;

/// Most texels of a line. The sum of so many 16-bit codes still fits 32 bits.
pub const LONGEST: usize = 1 << 16;

/// All lines of a level in one direction, with `C` channels.
#[derive(Debug)]
pub struct Lines<T: Code, const C: usize> {
    /// Texels of a line.
    pub length: usize,
    /// Number of lines.
    pub count: usize,
    /// Continuation of a line beyond its ends.
    pub wrap: Wrap,
    /// The texels, line by line.
    pub codes: Vec<[T; C]>,
    /// Palette of the texels.
    pub palette: T::Palette,
    /// `F1` at every [`EVERY`]th texel of each line.
    sums: Vec<[u32; C]>,
    /// Twice `F2` at every [`EVERY`]th texel, without the part that the value and the slope at the
    /// anchor before it determine.
    moments: Vec<[u32; C]>,
    /// Twice `F2` at the anchors, every [`ANCHORED`]th texel of each line. The numbers are whole and
    /// below 2^49.
    anchors: Vec<[f64; C]>,
    balances: Vec<Balance<C>>,
}

/// The numbers that make the integrals of a line repeat.
#[derive(Debug, Clone, Copy)]
struct Balance<const C: usize> {
    /// Mean `m` of the line.
    mean: [f64; C],
    /// Constant `c` of integration.
    constant: [f64; C],
}

/// Returns the number of stored values of a line: one at its start and one after each [`EVERY`]
/// texels.
fn stored(length: usize) -> usize {
    length / EVERY + 1
}

impl<T: Code, const C: usize> Lines<T, C> {
    /// Sums the lines. `codes` holds the texels line by line, `length` of them each, 1 to
    /// [`LONGEST`].
    #[must_use]
    pub fn new(codes: Vec<[T; C]>, length: usize, wrap: Wrap, palette: T::Palette) -> Self {
        let count = codes.len() / length;
        let mut sums = Vec::with_capacity(count * stored(length));
        let mut moments = Vec::with_capacity(count * stored(length));
        let mut anchors = Vec::with_capacity(count * anchors(length));
        let mut balances = Vec::with_capacity(count);
        for line in codes.chunks_exact(length) {
            let (mut sum, mut moment) = ([0u32; C], [0u64; C]);
            // Sum and moment at the last anchor.
            let (mut anchor, mut anchored) = ((sum, moment), 0);
            for k in 0..=length {
                if k % ANCHORED == 0 && k > 0 && k < length {
                    anchor = (sum, moment);
                    anchored = k;
                    anchors.push(moment.map(|moment| moment as f64));
                }
                if k % EVERY == 0 {
                    let beyond = 2 * (k - anchored) as u64;
                    sums.push(sum);
                    moments.push(from_fn(|c| {
                        (moment[c] - anchor.1[c] - beyond * u64::from(anchor.0[c])) as u32
                    }));
                }
                let Some(texel) = line.get(k) else { break };
                for c in 0..C {
                    let code = texel[c].value(&palette);
                    moment[c] += 2 * u64::from(sum[c]) + u64::from(code);
                    sum[c] += code;
                }
            }
            balances.push(Balance::of(sum, moment, length, wrap));
        }
        Self { length, count, wrap, codes, palette, sums, moments, anchors, balances }
    }

    /// Memory of the lines, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.codes.as_slice())
            + size_of_val(self.sums.as_slice())
            + size_of_val(self.moments.as_slice())
            + size_of_val(self.anchors.as_slice())
            + size_of_val(self.balances.as_slice())
            + T::PALETTE_BYTES
    }

    /// Returns the value of [`Self::bytes`] for `count` lines of `length` texels.
    #[must_use]
    pub fn bytes_for(length: usize, count: usize) -> u64 {
        let line = length * size_of::<[T; C]>()
            + 2 * stored(length) * size_of::<[u32; C]>()
            + anchors(length) * size_of::<[f64; C]>()
            + size_of::<Balance<C>>();
        (count * line + T::PALETTE_BYTES) as u64
    }

    /// Returns line `j` of the level, 0 to [`Self::count`].
    #[must_use]
    #[inline]
    pub fn line(&self, j: usize) -> Line<'_, T, C> {
        let part = |count: usize| j * count..(j + 1) * count;
        let (count, anchors) = (stored(self.length), anchors(self.length));
        Line {
            codes: &self.codes[j * self.length..][..self.length],
            palette: &self.palette,
            sums: &self.sums[part(count)],
            moments: &self.moments[part(count)],
            anchors: &self.anchors[part(anchors)],
            balance: &self.balances[j],
            wrap: self.wrap,
        }
    }
}

impl<const C: usize> Balance<C> {
    fn of(sum: [u32; C], moment: [u64; C], length: usize, wrap: Wrap) -> Self {
        let length = length as f64;
        let mean = match wrap {
            Wrap::Repeat | Wrap::Mirror => sum.map(|sum| f64::from(sum) / length),
            Wrap::Clamp => [0.0; C],
        };
        let constant = match wrap {
            Wrap::Repeat => from_fn(|c| 0.5 * (moment[c] as f64 / length - mean[c] * length)),
            Wrap::Mirror | Wrap::Clamp => [0.0; C],
        };
        Self { mean, constant }
    }
}

/// Returns the number of anchors of a line beside its start.
fn anchors(length: usize) -> usize {
    length.div_ceil(ANCHORED) - 1
}

/// One line of a level. Positions are in texels from its start, and values are codes.
#[derive(Debug, Clone, Copy)]
pub struct Line<'a, T: Code, const C: usize> {
    codes: &'a [[T; C]],
    palette: &'a T::Palette,
    sums: &'a [[u32; C]],
    moments: &'a [[u32; C]],
    anchors: &'a [[f64; C]],
    balance: &'a Balance<C>,
    wrap: Wrap,
}

impl<T: Code, const C: usize> Line<'_, T, C> {
    /// Returns the mean, over `x` between `a` and `b`, of the integral of the line from a fixed
    /// place to `x`. The place is the same for all `a` and `b`.
    ///
    /// Nothing is divided by a small number: a short stretch, which meets one or two texels, has a
    /// formula of its own.
    #[must_use]
    #[inline(always)]
    pub fn mean_integral(&self, a: f64, b: f64) -> [f64; C] {
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        let middle = 0.5 * (a + b);
        let mean = self.balance.mean;
        let start = floor(low);
        if high <= start + 1.0 {
            let i = start as i64;
            let (integral, texel) = (self.integral(i), self.texel(i));
            let part = middle - start;
            return from_fn(|c| integral[c] + part * texel[c] + mean[c] * middle);
        }
        if high - low <= 1.0 {
            // Two texels, left and right of `knot`.
            let knot = start as i64 + 1;
            let (left, right) = (start + 1.0 - low, high - (start + 1.0));
            let scale = 0.5 / (left + right);
            let (left, right) = (scale * left * left, scale * right * right);
            let integral = self.integral(knot);
            let (before, after) = (self.texel(knot - 1), self.texel(knot));
            return from_fn(|c| {
                integral[c] + right * after[c] - left * before[c] + mean[c] * middle
            });
        }
        let (from, to) = (self.double_integral(low), self.double_integral(high));
        let scale = 1.0 / (high - low);
        from_fn(|c| scale * (to[c] - from[c]) + mean[c] * middle)
    }

    /// Returns the deviation of texel `i`, of either sign, from the mean.
    #[inline(always)]
    fn texel(&self, i: i64) -> [f64; C] {
        let length = self.codes.len() as i64;
        let inside = if (i as u64) < length as u64 {
            i
        } else {
            match self.wrap {
                Wrap::Repeat => i.rem_euclid(length),
                Wrap::Clamp => i.clamp(0, length - 1),
                Wrap::Mirror => {
                    let turned = i.rem_euclid(2 * length);
                    turned.min(2 * length - 1 - turned)
                }
            }
        };
        let texel = self.codes[inside as usize];
        from_fn(|c| f64::from(texel[c].value(self.palette)) - self.balance.mean[c])
    }

    /// Returns `p` at the whole number `i`, of either sign.
    #[inline(always)]
    fn integral(&self, i: i64) -> [f64; C] {
        let length = self.codes.len() as i64;
        if (i as u64) <= length as u64 {
            return self.integral_inside(i as usize);
        }
        match self.wrap {
            Wrap::Repeat => self.integral_inside(i.rem_euclid(length) as usize),
            Wrap::Mirror => {
                let i = i.rem_euclid(2 * length);
                if i <= length {
                    self.integral_inside(i as usize)
                } else {
                    self.integral_inside((2 * length - i) as usize).map(|value| -value)
                }
            }
            Wrap::Clamp => {
                let end = i.clamp(0, length);
                let (to_end, edge) = (self.integral_inside(end as usize), self.texel(i));
                from_fn(|c| to_end[c] + (i - end) as f64 * edge[c])
            }
        }
    }

    /// Returns `p` at `i` between 0 and the length.
    #[inline(always)]
    fn integral_inside(&self, i: usize) -> [f64; C] {
        let place = ((i + EVERY / 2) / EVERY).min(self.sums.len() - 1);
        let from = place * EVERY;
        let mut sum = self.sums[place];
        if from <= i {
            for texel in &self.codes[from..i] {
                for c in 0..C {
                    sum[c] += texel[c].value(self.palette);
                }
            }
        } else {
            for texel in &self.codes[i..from] {
                for c in 0..C {
                    sum[c] -= texel[c].value(self.palette);
                }
            }
        }
        let Balance { mean, constant } = self.balance;
        let at = f64::from(i as u32);
        from_fn(|c| f64::from(sum[c]) - mean[c] * at - constant[c])
    }

    /// Returns `q` at `x`, of either sign.
    #[inline(always)]
    fn double_integral(&self, x: f64) -> [f64; C] {
        let length = self.codes.len() as f64;
        if x >= 0.0 && x <= length {
            return self.double_integral_inside(x);
        }
        match self.wrap {
            Wrap::Repeat => self.double_integral_inside(reduced(x, length)),
            Wrap::Mirror => {
                let x = reduced(x, 2.0 * length);
                self.double_integral_inside(x.min(2.0 * length - x))
            }
            Wrap::Clamp => {
                let end = x.clamp(0.0, length);
                let (to_end, slope) =
                    (self.double_integral_inside(end), self.integral_inside(end as usize));
                let (edge, beyond) = (self.texel(floor(x) as i64), x - end);
                from_fn(|c| to_end[c] + beyond * (slope[c] + 0.5 * beyond * edge[c]))
            }
        }
    }

    /// Returns `q` at `x` between 0 and the length.
    #[inline(always)]
    fn double_integral_inside(&self, x: f64) -> [f64; C] {
        // Numbers of 32 bits become f64 faster than longer ones.
        let whole = x as i32;
        let i = whole as usize;
        let place = ((i + EVERY / 2) / EVERY).min(self.moments.len() - 1);
        let from = place * EVERY;
        // The first anchor is the start, where both integrals are 0.
        let anchor = (from / ANCHORED).min(self.anchors.len());
        // The sum of the texels between the stored value and i, and the sum of k times texel k.
        let (mut sum, mut first) = ([0u32; C], [0u32; C]);
        let backward = from > i;
        let between = if backward { &self.codes[i..from] } else { &self.codes[from..i] };
        for (k, texel) in between.iter().enumerate() {
            for c in 0..C {
                let code = texel[c].value(self.palette);
                sum[c] += code;
                first[c] += k as u32 * code;
            }
        }
        let last = self.codes.get(i).copied();
        let (start, f) = (self.sums[place], x - f64::from(whole));
        let at_anchor = self.sums[anchor * (ANCHORED / EVERY)];
        let at_start = if anchor == 0 { [0.0; C] } else { self.anchors[anchor - 1] };
        let beyond = x - f64::from(from as u32);
        let from_anchor = f64::from((from - anchor * ANCHORED) as u32);
        let Balance { mean, constant } = self.balance;
        from_fn(|c| {
            // Texel k between i and `from` is seen from x: backward from its far side.
            let (sum, first) = (f64::from(sum[c]), f64::from(first[c]));
            let between =
                if backward { first + (0.5 - f) * sum } else { (beyond - 0.5) * sum - first };
            let last = last.map_or(0.0, |texel| f64::from(texel[c].value(self.palette)));
            let moment = at_start[c] + f64::from(self.moments[place][c]);
            let double = 0.5 * moment
                + from_anchor * f64::from(at_anchor[c])
                + beyond * f64::from(start[c])
                + between
                + 0.5 * f * f * last;
            double - x * (0.5 * mean[c] * x + constant[c])
        })
    }
}
