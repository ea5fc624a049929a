//! Heights from a picture, interpolated smoothly between its texels.
//!
//! The surface `h(s, t)` consists of cubic B-splines through the middle of each texel. Its first
//! and second derivatives are continuous, so a bump made of it has no creases. The coefficients are
//! computed from the texels by the recursive filter of M. Unser, A. Aldroubi and M. Eden, "B-spline
//! signal processing: part II" (1993). A depth picture of a swept surface is read by the same rule,
//! so both reliefs agree.

use glam::DVec2;

/// Pole of the cubic filter, `sqrt(3) - 2`.
const POLE: f64 = -0.267_949_192_431_122_7;

/// Number of texels beyond an edge that the filter reads. The influence of a texel decreases by the
/// factor of the pole with each step, and after 40 steps it is less than a rounding.
const MARGIN: i64 = 40;

/// A surface of heights over texture coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    /// Coefficients of the splines, row by row from the top.
    coefficients: Vec<f64>,
    width: usize,
    height: usize,
    repeat: DVec2,
    mirror: bool,
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
        Some(Self { coefficients: values, width, height, repeat, mirror })
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

    fn at(&self, uv: DVec2) -> (f64, DVec2) {
        let rate = DVec2::new(self.width as f64, self.height as f64) * self.repeat;
        // Rows are counted from the top, v from the bottom.
        let (columns, x) = taps(uv.x * rate.x - 0.5);
        let (rows, y) = taps(self.height as f64 - uv.y * rate.y - 0.5);
        let columns = columns.map(|column| index(column, self.width, self.mirror));
        let (mut height, mut slopes) = (0.0, DVec2::ZERO);
        for (row, [weight, slope]) in rows.into_iter().zip(y) {
            let row = index(row, self.height, self.mirror) * self.width;
            let (mut value, mut along) = (0.0, 0.0);
            for (column, [weight, slope]) in columns.into_iter().zip(x) {
                value += self.coefficients[row + column] * weight;
                along += self.coefficients[row + column] * slope;
            }
            height += value * weight;
            slopes += DVec2::new(along * weight, -value * slope);
        }
        (height, slopes * rate)
    }
}

/// Returns the index of the texel at `at`, which may lie beyond the edges.
fn index(at: i64, count: usize, mirror: bool) -> usize {
    let count = count as i64;
    let place = if mirror {
        let place = at.rem_euclid(2 * count);
        place.min(2 * count - 1 - place)
    } else {
        at.rem_euclid(count)
    };
    place as usize
}

/// Returns the four texels around a position and, for each, its weight and the derivative of the
/// weight.
fn taps(place: f64) -> ([i64; 4], [[f64; 2]; 4]) {
    let place = if place.is_finite() { place } else { 0.0 };
    let first = place.floor();
    let (f, g) = (place - first, 1.0 - (place - first));
    let first = first as i64;
    let outer = |f: f64| [f * f * f / 6.0, 0.5 * f * f];
    let inner = |f: f64| [(4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0, 1.5 * f * f - 2.0 * f];
    let turned = |[weight, slope]: [f64; 2]| [weight, -slope];
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
            }
        }
    }
}
