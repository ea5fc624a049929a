//! Heights from a picture, interpolated smoothly between its texels.
//!
//! The heights are a surface `h(s, t)` of cubic B-splines through the middle of each texel. Its first and
//! second derivatives have no jumps. The coefficients are computed from the texels by the recursive filter of
//! M. Unser, A. Aldroubi and M. Eden, "B-spline signal processing: part II" (1993): forward and backward with
//! the pole `sqrt(3) - 2`, first along rows, then along columns. Along a closed direction of the surface the
//! picture continues from its opposite edge. Along an open direction it is mirrored at its edges, where the
//! surface is then level.

use crate::grid::Across;

/// Texels beyond an edge that the filter reads. The influence of a texel falls by a factor of 0.27 per texel.
const MARGIN: isize = 40;

/// Heights on a surface, with their derivatives.
#[derive(Debug, Clone)]
pub struct HeightMap {
    /// Coefficients of the splines, relative to the height that counts as 0, row by row from the top.
    coefficients: Vec<f64>,
    x: Axis,
    y: Axis,
    across: Across,
    /// Height of white above black.
    amp: f64,
}

/// One direction of a picture.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    /// Number of texels along the direction.
    pub texels: usize,
    /// Repeats of the picture along the surface; a whole number along a closed direction.
    pub repeat: f64,
    /// True if the direction of the surface is closed.
    pub closed: bool,
}

impl HeightMap {
    /// Returns the heights of a picture with values from 0 to 1, row by row from the top.
    ///
    /// `across` says which direction of the surface runs along the picture's rows, as in
    /// [`UvLayout`](crate::grid::UvLayout).
    pub(crate) fn new(mut values: Vec<f64>, [x, y]: [Axis; 2], across: Across, amp: f64) -> Self {
        for row in values.chunks_exact_mut(x.texels) {
            let line = filtered(row, x);
            row.copy_from_slice(&line);
        }
        for col in 0..x.texels {
            let column: Vec<f64> = values.iter().skip(col).step_by(x.texels).copied().collect();
            for (row, value) in filtered(&column, y).into_iter().enumerate() {
                values[row * x.texels + col] = value;
            }
        }
        Self { coefficients: values, x, y, across, amp }
    }

    /// Returns the numbers of cells along `u` and `v` that resolve the picture: two for each texel.
    pub(crate) fn detail(&self) -> [f64; 2] {
        let [s, t] = [2.0 * self.x.rate(), 2.0 * self.y.rate()];
        match self.across {
            Across::Contour => [s, t],
            Across::Trajectory => [t, s],
        }
    }

    /// Returns an upper bound of the heights' size: splines stay within their coefficients.
    pub(crate) fn most(&self) -> f64 {
        self.amp.abs() * self.coefficients.iter().fold(0.0, |most: f64, c| most.max(c.abs()))
    }

    /// Returns bounds of the heights.
    pub(crate) fn range(&self) -> [f64; 2] {
        let heights = self.coefficients.iter().map(|c| self.amp * c);
        let [low, high] = heights
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| [low.min(h), high.max(h)]);
        [low.min(0.0), high.max(0.0)]
    }

    /// Returns the numbers of texels along `u` and `v`.
    pub(crate) fn texels(&self) -> [f64; 2] {
        self.detail().map(|cells| 0.5 * cells)
    }

    /// Returns the height at (u, v), and its derivatives by `u` and by `v`.
    #[must_use]
    pub fn at(&self, u: f64, v: f64) -> [f64; 3] {
        let (s, t) = match self.across {
            Across::Contour => (u, v),
            Across::Trajectory => (1.0 - v, u),
        };
        let (x_rate, y_rate) = (self.x.rate(), self.y.rate());
        // Rows are counted from the top, t from below.
        let (columns, x) = taps(s * x_rate - 0.5);
        let (rows, y) = taps(self.y.texels as f64 - t * y_rate - 0.5);
        let columns = columns.map(|column| self.x.texel(column));
        let (mut height, mut height_s, mut height_t) = (0.0, 0.0, 0.0);
        for (row, [weight, slope]) in rows.into_iter().zip(y) {
            let row = self.y.texel(row) * self.x.texels;
            let (mut value, mut value_x) = (0.0, 0.0);
            for (column, [weight, slope]) in columns.into_iter().zip(x) {
                let coefficient = self.coefficients[row + column];
                value += coefficient * weight;
                value_x += coefficient * slope;
            }
            height += value * weight;
            height_s += value_x * weight * x_rate;
            height_t -= value * slope * y_rate;
        }
        let (height_u, height_v) = match self.across {
            Across::Contour => (height_s, height_t),
            Across::Trajectory => (height_t, -height_s),
        };
        [height, height_u, height_v].map(|value| value * self.amp)
    }
}

impl Axis {
    /// Returns the number of texels along the whole surface.
    fn rate(&self) -> f64 {
        self.texels as f64 * self.repeat
    }

    /// Returns the index of a texel of the picture for an index that may lie beyond its edges.
    fn texel(&self, index: isize) -> usize {
        let count = self.texels as isize;
        let wrapped = if self.closed {
            index.rem_euclid(count)
        } else {
            let wrapped = index.rem_euclid(2 * count);
            wrapped.min(2 * count - 1 - wrapped)
        };
        wrapped as usize
    }
}

/// Returns the four texels around a position, and the weight of each with its derivative.
fn taps(position: f64) -> ([isize; 4], [[f64; 2]; 4]) {
    let first = position.floor();
    let (f, g) = (position - first, 1.0 - (position - first));
    let first = first as isize;
    let inner = |f: f64| (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0;
    let inner_slope = |f: f64| 1.5 * f * f - 2.0 * f;
    let weights = [
        [g * g * g / 6.0, -0.5 * g * g],
        [inner(f), inner_slope(f)],
        [inner(g), -inner_slope(g)],
        [f * f * f / 6.0, 0.5 * f * f],
    ];
    ([first - 1, first, first + 1, first + 2], weights)
}

/// Returns the coefficients of the spline through the values of a line.
fn filtered(line: &[f64], axis: Axis) -> Vec<f64> {
    let pole = 3.0_f64.sqrt() - 2.0;
    let count = line.len() as isize;
    let mut wide: Vec<f64> = (-MARGIN..count + MARGIN).map(|i| 6.0 * line[axis.texel(i)]).collect();
    for i in 1..wide.len() {
        wide[i] += pole * wide[i - 1];
    }
    let mut next = 0.0;
    for value in wide.iter_mut().rev() {
        next = pole * (next - *value);
        *value = next;
    }
    wide[MARGIN as usize..][..line.len()].to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns numbers from 0 to 1 without a pattern.
    fn texels(count: usize) -> Vec<f64> {
        (0..count).map(|i| (i as f64 * 0.618_033_988_7 + (i * i) as f64 * 0.137).fract()).collect()
    }

    fn map(closed: [bool; 2], across: Across) -> HeightMap {
        let axis = |texels, closed| Axis { texels, repeat: 1.0, closed };
        HeightMap::new(texels(35), [axis(7, closed[0]), axis(5, closed[1])], across, 1.0)
    }

    #[test]
    fn the_middle_of_each_texel_is_met() {
        for closed in [[true, true], [false, false], [true, false]] {
            let heights = map(closed, Across::Contour);
            for (i, texel) in texels(35).into_iter().enumerate() {
                let (s, t) = (((i % 7) as f64 + 0.5) / 7.0, 1.0 - ((i / 7) as f64 + 0.5) / 5.0);
                assert!((heights.at(s, t)[0] - texel).abs() < 1e-14);
                let upright = map(closed, Across::Trajectory);
                assert!((upright.at(t, 1.0 - s)[0] - texel).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn slopes_agree_with_differences() {
        for across in [Across::Contour, Across::Trajectory] {
            let heights = map([true, false], across);
            let h = 1e-5;
            for i in 0..200 {
                let (u, v) = (f64::from(i) * 0.618 % 1.0, f64::from(i) * 0.377 % 1.0);
                let [_, by_u, by_v] = heights.at(u, v);
                let slope = |a: [f64; 3], b: [f64; 3]| (a[0] - b[0]) / (2.0 * h);
                let u_slope = slope(heights.at(u + h, v), heights.at(u - h, v));
                let v_slope = slope(heights.at(u, v + h), heights.at(u, v - h));
                // Third derivatives jump at texels, so the differences are accurate only to the order h^2.
                assert!((by_u - u_slope).abs() < 1e-6 && (by_v - v_slope).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn closed_directions_go_on_and_open_ones_are_level_at_their_edges() {
        let heights = map([true, false], Across::Contour);
        for i in 0..10 {
            let at = f64::from(i) / 10.0;
            let (start, end) = (heights.at(0.0, at), heights.at(1.0, at));
            assert!(start.iter().zip(end).all(|(a, b)| (a - b).abs() < 1e-12));
            assert!(heights.at(at, 0.0)[2].abs() < 1e-12 && heights.at(at, 1.0)[2].abs() < 1e-12);
        }
        let most = heights.most();
        assert!((0..1000).all(|i| heights.at(f64::from(i) / 1e3, 0.3)[0].abs() <= most));
    }

    #[test]
    fn a_picture_of_one_texel_is_level() {
        let axis = Axis { texels: 1, repeat: 3.0, closed: true };
        let heights = HeightMap::new(vec![0.25], [axis; 2], Across::Contour, 2.0);
        let [height, by_u, by_v] = heights.at(0.3, 0.9);
        assert!((height - 0.5).abs() < 1e-14 && by_u.abs() < 1e-13 && by_v.abs() < 1e-13);
    }
}
