//! The exact average of few texels under polygons: the part of each texel that a polygon covers.
//!
//! An edge covers a part of each texel that it crosses, and all of the texels to its right up to the
//! next edge. A line of cells holds the change of the covered part from texel to texel, so that an edge
//! changes only the cells that it crosses. The running sum along the line is the covered part of each
//! texel. (Outlines of letters are often drawn like this.)
//!
//! The time grows with the number of covered texels. For few of them it is a small part of that of the
//! sums of lines in [`super::level`].

use super::floor;
use super::line::Lines;
use super::outline::bounds;
use super::palette::Code;
use super::steps::Steps;
use glam::DVec2;

/// Most texels across and down a window.
///
/// In a wider one, lines are long, and sums of lines are faster. Each line takes time, covered or not.
const MOST_ACROSS: usize = 254;
const MOST_DOWN: usize = 254;

/// Most covered texels in a window, about. Above it, sums of lines are faster.
const MOST_COVERED: f64 = 2000.0;

/// Cells of a line in a narrow window, and in one of middle width.
const FEW_CELLS: usize = 32;
const SOME_CELLS: usize = 96;

/// Cells of a line in the widest window: one on the left and two on the right of the texels.
const MOST_CELLS: usize = MOST_ACROSS + 3;

/// The rectangle of texels around polygons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// The upper left corner, a whole number of texels.
    corner: DVec2,
    /// Texels across and down.
    pub width: usize,
    height: usize,
}

/// An edge of a polygon, followed from its upper to its lower end. Positions are in cells of the window,
/// the first of which is on the left of the texels: a rounding to the left stays in the window.
#[derive(Debug, Clone, Copy)]
struct Edge {
    /// The upper end of the part that is not yet followed.
    at: DVec2,
    /// The lower end.
    lower: DVec2,
    /// Cells to the right for each line down.
    slope: f64,
    /// Lines for each cell, downward if positive. It has the sign of `sign`.
    rise: f64,
    /// 1 if the texels on the right of the edge are covered, -1 if those on the left are.
    sign: f64,
}

impl Window {
    /// Returns the smallest rectangle of texels around polygons, or `None` if sums of lines are faster.
    #[must_use]
    pub fn around<const N: usize>(polygons: &[[DVec2; 4]; N]) -> Option<Self> {
        let (mut low, mut high) = bounds(&polygons[0]);
        for polygon in &polygons[1..] {
            let (lower, higher) = bounds(polygon);
            (low, high) = (low.min(lower), high.max(higher));
        }
        let corner = DVec2::new(floor(low.x), floor(low.y));
        let size = high - corner;
        let fits = size.x < MOST_ACROSS as f64 && size.y < MOST_DOWN as f64;
        if !fits || double_area(&polygons[0]).abs() > 2.0 * MOST_COVERED {
            return None;
        }
        Some(Self { corner, width: size.x as usize + 1, height: size.y as usize + 1 })
    }

    /// Returns the mean of the average codes over polygons inside the window, all in the same direction,
    /// none of which has an area of 0.
    #[must_use]
    pub fn average<const N: usize, T: Code, const C: usize>(
        &self,
        rows: &Lines<T, C>,
        polygons: &[[DVec2; 4]; N],
    ) -> [f64; C] {
        // Clearing more cells than are needed takes time.
        let cells = self.width + 3;
        let sum = if cells <= FEW_CELLS {
            self.sum::<FEW_CELLS, N, T, C>(rows, polygons)
        } else if cells <= SOME_CELLS {
            self.sum::<SOME_CELLS, N, T, C>(rows, polygons)
        } else {
            self.sum::<MOST_CELLS, N, T, C>(rows, polygons)
        };
        let scale = -2.0 / polygons.iter().map(double_area).sum::<f64>();
        sum.map(|sum| scale * sum)
    }

    /// Returns the sum of the codes, each times its covered part. It is negative for polygons whose area
    /// is positive.
    #[inline(always)]
    fn sum<const CELLS: usize, const N: usize, T: Code, const C: usize>(
        &self,
        rows: &Lines<T, C>,
        polygons: &[[DVec2; 4]; N],
    ) -> [f64; C] {
        let origin = self.corner - DVec2::X;
        let mut edges = polygons.map(|polygon| {
            let corners = polygon.map(|corner| corner - origin);
            [0, 1, 2, 3].map(|k| Edge::new(corners[k], corners[(k + 1) % 4]))
        });
        let mut cells = [0.0; CELLS];
        let mut sum = [0.0; C];
        let columns = Steps::new(rows.wrap, rows.length, origin.x as i64);
        let mut lines = Steps::new(rows.wrap, rows.count, origin.y as i64);
        for line in 0..self.height {
            let mut span = Span { first: CELLS, last: 0 };
            for edge in edges.iter_mut().flatten() {
                edge.follow(line, &mut cells, &mut span);
            }
            let texels = &rows.codes[lines.next() * rows.length..][..rows.length];
            if span.first > span.last {
                continue;
            }
            // The cell after the last one is the change to 0 beyond the last texel.
            cells[span.last + 1] = 0.0;
            let cells = &mut cells[span.first..=span.last];
            let mut covered = 0.0;
            let mut add = |change: &mut f64, texel: &[T; C]| {
                covered += std::mem::take(change);
                for c in 0..C {
                    sum[c] += covered * f64::from(texel[c].value(&rows.palette));
                }
            };
            let mut columns = columns.skip(span.first);
            if let Some(inside) = columns.straight(cells.len()) {
                cells.iter_mut().zip(&texels[inside]).for_each(|(cell, texel)| add(cell, texel));
            } else {
                cells.iter_mut().for_each(|cell| add(cell, &texels[columns.next()]));
            }
        }
        sum
    }
}

/// The cells of a line that edges change: from `first` to the one after `last`.
#[derive(Debug, Clone, Copy)]
struct Span {
    first: usize,
    last: usize,
}

impl Edge {
    #[inline(always)]
    fn new(from: DVec2, to: DVec2) -> Self {
        let (sign, at, lower) = if from.y < to.y { (1.0, from, to) } else { (-1.0, to, from) };
        let (width, height) = (lower.x - at.x, lower.y - at.y);
        Self { at, lower, slope: width / height, rise: sign * height / width.abs(), sign }
    }

    /// Follows the edge through a line of texels, 1 tall, and adds its changes of coverage.
    #[inline(always)]
    fn follow(&mut self, line: usize, cells: &mut [f64], span: &mut Span) {
        let Self { at, lower, slope, rise, sign } = *self;
        let bottom = f64::from(line as u32 + 1);
        if at.y >= bottom || at.y >= lower.y {
            return;
        }
        let to = if lower.y <= bottom {
            lower
        } else {
            DVec2::new(at.x + (bottom - at.y) * slope, bottom)
        };
        self.at = to;
        let weight = sign * (to.y - at.y);
        let (left, right) = if at.x < to.x { (at.x, to.x) } else { (to.x, at.x) };
        let (first, last) = (left as i32 as usize, right as i32 as usize);
        *span = Span { first: span.first.min(first), last: span.last.max(last) };
        let (before, after) = (f64::from(first as u32 + 1) - left, right - f64::from(last as u32));
        if first == last {
            let part = 0.5 * weight * (1.0 - before + after);
            cells[first] += weight - part;
            cells[first + 1] += part;
            return;
        }
        // The edge covers a triangle of the first and of the last texel, and leaves one.
        let covered = 0.5 * rise * before * before;
        let left_out = 0.5 * rise * after * after;
        cells[first] += covered;
        cells[last + 1] += left_out;
        if first + 1 == last {
            cells[last] += weight - left_out - covered;
            return;
        }
        cells[first + 1] += rise * (before + 0.5) - covered;
        cells[first + 2..last].iter_mut().for_each(|cell| *cell += rise);
        cells[last] += rise * (after + 0.5) - left_out;
    }
}

/// Returns twice the area of a quadrilateral, with the sign of its direction.
fn double_area(corners: &[DVec2; 4]) -> f64 {
    (corners[2] - corners[0]).perp_dot(corners[3] - corners[1])
}
