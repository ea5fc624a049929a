//! The exact average of one level of a texture over a quadrilateral, by Green's theorem.
//!
//! With `F1` the integral of the texture along each line, the integral over a polygon is
//!
//! ```text
//!   sum over edges, and over the lines that an edge crosses:  dy * (mean of F1 along the crossing)
//! ```
//!
//! The sum has one term for each line and edge, however many texels the lines hold. A quadrilateral
//! that is wide and low therefore costs little. One that is narrow and high is turned: the level
//! also keeps its columns as lines.

use super::coverage::Window;
use super::floor;
use super::line::Lines;
use super::outline::bounds;
use super::palette::Code;
use crate::texture::Wrap;
use glam::DVec2;

/// One level of a texture, ready to be averaged.
#[derive(Debug)]
pub struct Level<T: Code, const C: usize> {
    /// The rows of the texture, from the top.
    rows: Lines<T, C>,
    /// The columns of the texture, from the left.
    columns: Lines<T, C>,
}

impl<T: Code, const C: usize> Level<T, C> {
    /// Prepares a level from its texels, row by row from the top, `width` of them each.
    #[must_use]
    pub fn new(codes: Vec<[T; C]>, width: usize, wrap: Wrap, palette: T::Palette) -> Self {
        let height = codes.len() / width;
        let mut turned = Vec::with_capacity(codes.len());
        for i in 0..width {
            turned.extend((0..height).map(|j| codes[j * width + i]));
        }
        Self {
            rows: Lines::new(codes, width, wrap, palette.clone()),
            columns: Lines::new(turned, height, wrap, palette),
        }
    }

    /// Width and height of the level, in its texels.
    #[must_use]
    pub fn size(&self) -> DVec2 {
        DVec2::new(self.rows.length as f64, self.rows.count as f64)
    }

    /// Memory of the level, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.rows.bytes() + self.columns.bytes()
    }

    /// Returns the value of [`Self::bytes`] for a level of this width and height.
    #[must_use]
    pub fn bytes_for(width: usize, height: usize) -> u64 {
        Lines::<T, C>::bytes_for(width, height) + Lines::<T, C>::bytes_for(height, width)
    }

    /// Returns the mean of the average codes over quadrilaterals with these corners, in texels of this
    /// level, `y` downward. The corners are in order around each, all in the same direction, and no
    /// area is 0.
    #[must_use]
    pub fn average<const N: usize>(&self, outlines: &[[DVec2; 4]; N]) -> [f64; C] {
        if let Some(window) = Window::around(outlines) {
            return window.average(&self.rows, outlines);
        }
        let mut sum = [0.0; C];
        for outline in outlines {
            for (sum, average) in sum.iter_mut().zip(self.by_sums(outline)) {
                *sum += average;
            }
        }
        sum.map(|sum| sum / N as f64)
    }

    /// Returns the average code over a quadrilateral of any size from the sums of lines.
    #[must_use]
    pub fn by_sums(&self, corners: &[DVec2; 4]) -> [f64; C] {
        let (low, high) = bounds(corners);
        let extent = high - low;
        if extent.y <= extent.x {
            over(&self.rows, corners)
        } else {
            over(&self.columns, &corners.map(|corner| DVec2::new(corner.y, corner.x)))
        }
    }
}

/// Averages over a quadrilateral whose corners are positions along and across the lines.
fn over<T: Code, const C: usize>(lines: &Lines<T, C>, corners: &[DVec2; 4]) -> [f64; C] {
    let diagonals = (corners[2] - corners[0]).perp_dot(corners[3] - corners[1]);
    let mut sum = [0.0; C];
    for k in 0..4 {
        add_edge(lines, corners[k], corners[(k + 1) % 4], &mut sum);
    }
    let scale = 2.0 / diagonals;
    sum.map(|sum| scale * sum)
}

/// Adds the integral of `F1` over the height of an edge, upward or downward.
#[inline(always)]
fn add_edge<T: Code, const C: usize>(
    lines: &Lines<T, C>,
    from: DVec2,
    to: DVec2,
    sum: &mut [f64; C],
) {
    let (sign, low, high) = if from.y < to.y { (1.0, from, to) } else { (-1.0, to, from) };
    let height = high.y - low.y;
    if height <= 0.0 {
        return;
    }
    let slope = (high.x - low.x) / height;
    let mut walk = Walk::new(lines.wrap, lines.count, floor(low.y));
    let mut at = low;
    loop {
        let (index, end) = walk.line();
        let next =
            if end >= high.y { high } else { DVec2::new(low.x + (end - low.y) * slope, end) };
        let mean = lines.line(index).mean_integral(at.x, next.x);
        let weight = sign * (next.y - at.y);
        for (sum, mean) in sum.iter_mut().zip(mean) {
            *sum += weight * mean;
        }
        if end >= high.y {
            return;
        }
        at = next;
        walk.advance(end);
    }
}

/// A walk from line to line, upward, through a texture that continues beyond its edges.
struct Walk {
    wrap: Wrap,
    count: usize,
    /// Number of the current line.
    number: f64,
    /// Number of the current line within a period of the texture, from 0.
    place: usize,
}

impl Walk {
    /// Starts at the line with a whole `number`, of either sign.
    #[inline(always)]
    fn new(wrap: Wrap, count: usize, number: f64) -> Self {
        let period = if wrap == Wrap::Mirror { 2 * count } else { count };
        let place = match wrap {
            Wrap::Clamp => 0,
            Wrap::Repeat | Wrap::Mirror if number >= 0.0 && number < period as f64 => {
                number as usize
            }
            Wrap::Repeat | Wrap::Mirror => (number as i64).rem_euclid(period as i64) as usize,
        };
        Self { wrap, count, number, place }
    }

    /// Returns the index of the current line, and the position of its upper end.
    ///
    /// A clamped texture has equal lines beyond its edges: each side is one tall line.
    #[inline(always)]
    fn line(&self) -> (usize, f64) {
        let last = self.count - 1;
        match self.wrap {
            Wrap::Repeat => (self.place, self.number + 1.0),
            Wrap::Mirror if self.place > last => (2 * last + 1 - self.place, self.number + 1.0),
            Wrap::Mirror => (self.place, self.number + 1.0),
            Wrap::Clamp if self.number < 0.0 => (0, 0.0),
            Wrap::Clamp if self.number >= last as f64 => (last, f64::INFINITY),
            Wrap::Clamp => (self.number as usize, self.number + 1.0),
        }
    }

    /// Moves to the line that begins at `end`, the end of the current one.
    #[inline(always)]
    fn advance(&mut self, end: f64) {
        self.number = end;
        let period = if self.wrap == Wrap::Mirror { 2 * self.count } else { self.count };
        self.place += 1;
        if self.place == period {
            self.place = 0;
        }
    }
}
