//! Heights from a picture, interpolated smoothly between its texels.
//!
//! The surface `h(s, t)` consists of cubic B-splines through the middle of each texel. Its first
//! and second derivatives are continuous, so a bump made of it has no creases. The coefficients are
//! computed from the texels by the recursive filter of M. Unser, A. Aldroubi and M. Eden, "B-spline
//! signal processing: part II" (1993). A depth picture of a swept surface is read by the same rule,
//! so both reliefs agree.

use super::laid::Laid;
use super::moments::{self, Moments, SurfaceSlope};
use glam::{DMat2, DVec2};
use std::sync::OnceLock;

/// Pole of the cubic filter, `sqrt(3) - 2`.
const POLE: f64 = -0.267_949_192_431_122_7;

/// Number of texels beyond an edge that the filter reads. The influence of a texel decreases by the
/// factor of the pole with each step, and after 40 steps it is less than a rounding.
const MARGIN: i64 = 40;

/// A surface of heights over texture coordinates.
#[derive(Debug, Clone)]
pub struct Heights {
    /// Coefficients of the splines, row by row from the top.
    coefficients: Vec<f64>,
    laid: Laid,
    mirror: bool,
    /// Moments of the slopes, built when slopes are first averaged.
    moments: OnceLock<Moments>,
}

impl PartialEq for Heights {
    /// Compares the surfaces. Moments follow from them.
    fn eq(&self, other: &Self) -> bool {
        let all = |heights: &Self| (heights.laid, heights.mirror);
        all(self) == all(other) && self.coefficients == other.coefficients
    }
}

impl Heights {
    /// Creates the surface from the values of a picture, row by row from the top, `width` in each
    /// row. The picture is laid `repeat` times over the unit square of texture coordinates and
    /// continues beyond it. With `mirror` it is mirrored at each of its edges, else it repeats.
    ///
    /// Returns `None` unless there is at least one row and all rows are complete.
    #[must_use]
    pub fn new(mut values: Vec<f64>, width: usize, repeat: DVec2, mirror: bool) -> Option<Self> {
        if values.is_empty() || width == 0 || !values.len().is_multiple_of(width) {
            return None;
        }
        let height = values.len() / width;
        for row in values.chunks_exact_mut(width) {
            let line = filtered(row, mirror);
            row.copy_from_slice(&line);
        }
        for column in 0..width {
            let line: Vec<f64> = values.iter().skip(column).step_by(width).copied().collect();
            for (row, value) in filtered(&line, mirror).into_iter().enumerate() {
                values[row * width + column] = value;
            }
        }
        let laid = Laid::new([width, height], repeat);
        Some(Self { coefficients: values, laid, mirror, moments: OnceLock::new() })
    }

    /// Returns the surface moved against texture coordinates by `offset` copies of the picture.
    #[must_use]
    pub fn moved(mut self, offset: DVec2) -> Self {
        self.laid.offset = offset;
        self
    }

    /// Returns the height at texture coordinates, in the units of the values.
    #[must_use]
    pub fn height(&self, uv: DVec2) -> f64 {
        self.at(uv).0
    }

    /// Returns the derivatives of the height by both texture coordinates.
    #[must_use]
    pub fn slopes(&self, uv: DVec2) -> DVec2 {
        self.at(uv).1
    }

    /// Returns the slope over the parallelogram of texture coordinates with these two sides.
    #[must_use]
    pub fn slope(&self, uv: DVec2, sides: [DVec2; 2]) -> SurfaceSlope {
        let rate = self.laid.rate();
        let moments = || self.moments.get_or_init(|| self.moments());
        moments::averaged(
            self.laid.at(uv),
            sides.map(|side| side * rate),
            |at| self.spline(at),
            moments,
        )
        .stretched(rate)
    }

    /// Memory of the moments, in bytes, which exist once slopes have been averaged.
    #[must_use]
    pub fn moments_bytes(&self) -> u64 {
        let [width, height] = self.laid.size;
        Moments::bytes(width, height)
    }

    fn moments(&self) -> Moments {
        let [width, height] = self.laid.size;
        // Rows are counted from the top.
        Moments::new(width, height, self.mirror, |x, y| {
            self.spline(DVec2::new(x, height as f64 - y)).0
        })
    }

    fn at(&self, uv: DVec2) -> (f64, DVec2) {
        let at = self.laid.at(uv);
        let (height, slopes, _) = self.in_texels(at.x, at.y);
        (height, slopes * self.laid.rate())
    }

    /// Returns slopes and second derivatives by texels, at a position in texels to the right and up.
    fn spline(&self, at: DVec2) -> (DVec2, DMat2) {
        let (_, slopes, curvature) = self.in_texels(at.x, at.y);
        (slopes, curvature)
    }

    /// Returns the height and its derivatives by texels to the right and up.
    fn in_texels(&self, right: f64, up: f64) -> (f64, DVec2, DMat2) {
        let [width, height] = self.laid.size;
        let (columns, x) = taps(right - 0.5);
        // Rows are counted from the top, v from the bottom.
        let (rows, y) = taps(height as f64 - up - 0.5);
        let columns = columns.map(|column| index(column, width, self.mirror));
        let (mut sum, mut slopes) = (0.0, DVec2::ZERO);
        let (mut across, mut mixed, mut down) = (0.0, 0.0, 0.0);
        for (row, [weight, slope, bend]) in rows.into_iter().zip(y) {
            let row = index(row, height, self.mirror) * width;
            let (mut value, mut along, mut curved) = (0.0, 0.0, 0.0);
            for (column, [weight, slope, bend]) in columns.into_iter().zip(x) {
                value += self.coefficients[row + column] * weight;
                along += self.coefficients[row + column] * slope;
                curved += self.coefficients[row + column] * bend;
            }
            sum += value * weight;
            slopes += DVec2::new(along * weight, -value * slope);
            across += curved * weight;
            mixed -= along * slope;
            down += value * bend;
        }
        (sum, slopes, DMat2::from_cols_array(&[across, mixed, mixed, down]))
    }
}

/// Returns the index of the texel at `at`, which may lie beyond the edges.
pub(super) fn index(at: i64, count: usize, mirror: bool) -> usize {
    let count = count as i64;
    let place = if mirror {
        let place = at.rem_euclid(2 * count);
        place.min(2 * count - 1 - place)
    } else {
        at.rem_euclid(count)
    };
    place as usize
}

/// Returns the four texels around a position and, for each, its weight and the first and second
/// derivative of the weight.
fn taps(place: f64) -> ([i64; 4], [[f64; 3]; 4]) {
    let place = if place.is_finite() { place } else { 0.0 };
    let first = place.floor();
    let (f, g) = (place - first, 1.0 - (place - first));
    let first = first as i64;
    let outer = |f: f64| [f * f * f / 6.0, 0.5 * f * f, f];
    let inner = |f: f64| {
        [(4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0, 1.5 * f * f - 2.0 * f, 3.0 * f - 2.0]
    };
    let turned = |[weight, slope, bend]: [f64; 3]| [weight, -slope, bend];
    let steps = [-1, 0, 1, 2].map(|step| first.saturating_add(step));
    (steps, [turned(outer(g)), inner(f), turned(inner(g)), outer(f)])
}

/// Returns the coefficients of the spline through the values of a line.
fn filtered(line: &[f64], mirror: bool) -> Vec<f64> {
    let around = -MARGIN..line.len() as i64 + MARGIN;
    let mut wide: Vec<f64> = around.map(|at| 6.0 * line[index(at, line.len(), mirror)]).collect();
    for k in 1..wide.len() {
        wide[k] += POLE * wide[k - 1];
    }
    let mut next = 0.0;
    for value in wide.iter_mut().rev() {
        next = POLE * (next - *value);
        *value = next;
    }
    wide[MARGIN as usize..][..line.len()].to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pseudo-random numbers from 0 to 1.
    fn texels() -> Vec<f64> {
        (0..35).map(|i| f64::from(i * i * 37 % 101) / 100.0).collect()
    }

    fn heights(mirror: bool) -> Heights {
        Heights::new(texels(), 7, DVec2::new(2.0, 3.0), mirror).unwrap()
    }

    #[test]
    fn the_surface_goes_through_the_middle_of_each_texel_and_repeats() {
        for (k, texel) in texels().into_iter().enumerate() {
            let (column, row) = ((k % 7) as f64, (k / 7) as f64);
            let s = (column + 0.5) / 7.0;
            let t = 1.0 - (row + 0.5) / 5.0;
            let over = |s: f64, t: f64| DVec2::new(s / 2.0, t / 3.0);
            for (s, t) in [(s, t), (s + 1.0, t), (s, t - 4.0)] {
                assert!((heights(false).height(over(s, t)) - texel).abs() < 1e-13);
            }
            for (s, t) in [(s, t), (2.0 - s, t), (-s, 2.0 - t)] {
                assert!((heights(true).height(over(s, t)) - texel).abs() < 1e-13);
            }
        }
        assert_eq!(Heights::new(vec![0.0; 5], 2, DVec2::ONE, false), None);
    }

    #[test]
    fn slopes_of_heights_agree_with_differences() {
        let step = 1e-5;
        for mirror in [false, true] {
            let heights = heights(mirror);
            for k in 0..100 {
                let at = DVec2::new(0.371 * f64::from(k), 0.217 * f64::from(k));
                let by = |axis: DVec2| {
                    let [up, down] = [at + step * axis, at - step * axis];
                    (heights.height(up) - heights.height(down)) / (2.0 * step)
                };
                // Third derivatives are at most a few times the cube of 15 texels to a unit.
                let expected = DVec2::new(by(DVec2::X), by(DVec2::Y));
                assert!(heights.slopes(at).abs_diff_eq(expected, 1e-4), "{at}");
                // Over a point, slopes are exact, and their change is the second derivative.
                let slope = |at| heights.slope(at, [DVec2::ZERO; 2]);
                assert_eq!(slope(at).mean, heights.slopes(at));
                assert_eq!(slope(at).covariance, DMat2::ZERO);
                let by = |axis: DVec2| {
                    (slope(at + step * axis).mean - slope(at - step * axis).mean) / (2.0 * step)
                };
                let expected = DMat2::from_cols(by(DVec2::X), by(DVec2::Y));
                // Second derivatives have kinks of at most a few times the cube of 15.
                assert!(slope(at).curvature.abs_diff_eq(expected, 0.2), "{at}");
            }
        }
    }
}
