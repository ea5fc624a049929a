//! Means of slopes and of their products over parts of a picture of heights.
//!
//! Source: M. Olano and D. Baker, "LEAN Mapping", 2010. A pyramid holds the first and second moments
//! of the slopes. The covariance of slopes over a part follows from both: `E[s s^T] - E[s] E[s]^T`.
//! A long part is covered by several probes along its longer axis (J. `McCormack` et al., "Feline",
//! 1999).
//!
//! All positions and slopes of this file are by texels to the right and up.

use super::heights::index;
use super::probes::{MOST_PROBES, axes, probes};
use glam::{DMat2, DVec2};

/// Widths of a part, in texels, at which the mean of exact slopes begins to be replaced by the
/// pyramid's and has been replaced.
///
/// Bilinear interpolation of the pyramid's level 0 averages over about the square root of two
/// texels. With a larger first width, exact slopes at points change faster than the part is wide.
const EXACT: [f64; 2] = [0.5, std::f64::consts::SQRT_2];

/// Points per axis at which the slopes in a texel are sampled, each with the same weight: Gauss's rule
/// of two points in each half of the texel. Splines meet in its middle. The rule is exact for the means
/// of cubic splines, and misses less than a hundredth of the means of products, also of random texels.
const GAUSS: [f64; 4] = [
    0.105_662_432_702_593_5,
    0.394_337_567_297_406_5,
    0.605_662_432_702_593_5,
    0.894_337_567_297_406_5,
];

/// The slope of a picture of heights over a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceSlope {
    /// Mean slopes by both coordinates.
    pub mean: DVec2,
    /// Derivatives of the mean slopes: column `k` is their change along coordinate `k`.
    pub curvature: DMat2,
    /// Covariance of the slopes within the part.
    pub covariance: DMat2,
}

/// Moments of slopes: the means of `x`, `y`, `x x`, `x y` and `y y`.
type Five = [f64; 5];

/// A pyramid of moments. Each level divides the picture evenly into about half as many cells per axis
/// as the level before; level 0 has a cell for each texel. Moments take 20 bytes per cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Moments {
    levels: Vec<Level>,
    /// Size of the picture, in texels.
    size: DVec2,
    mirror: bool,
}

#[derive(Debug, Clone, PartialEq)]
struct Level {
    width: usize,
    height: usize,
    /// Cells row by row from the top.
    cells: Vec<[f32; 5]>,
}

impl Moments {
    /// Builds the pyramid of a picture from its exact slopes. `slopes` takes a position in texels to
    /// the right and down.
    #[must_use]
    pub fn new(
        width: usize,
        height: usize,
        mirror: bool,
        slopes: impl Fn(f64, f64) -> DVec2,
    ) -> Self {
        let texel = |x: usize, y: usize| {
            let mut sum = [0.0; 5];
            for down in GAUSS {
                for right in GAUSS {
                    let slopes = slopes(x as f64 + right, y as f64 + down);
                    add(&mut sum, 1.0 / 16.0, of(slopes));
                }
            }
            sum.map(|moment| moment as f32)
        };
        let cells = (0..width * height).map(|k| texel(k % width, k / width)).collect();
        let mut levels = vec![Level { width, height, cells }];
        while let Some(level) = levels.last().filter(|level| level.cells.len() > 1) {
            let next = level.halved();
            levels.push(next);
        }
        Self { levels, size: DVec2::new(width as f64, height as f64), mirror }
    }

    /// Memory of the pyramid of a picture of this size, in bytes.
    #[must_use]
    pub fn bytes(width: usize, height: usize) -> u64 {
        let mut size = [width as u64, height as u64];
        let mut cells = size[0].saturating_mul(size[1]);
        while size != [1, 1] {
            size = size.map(|count| count.div_ceil(2));
            cells = cells.saturating_add(size[0].saturating_mul(size[1]));
        }
        cells.saturating_mul(size_of::<[f32; 5]>() as u64)
    }

    /// Returns the moments around a position over a width of at least a texel, and the derivatives of
    /// the mean slopes.
    fn over(&self, at: DVec2, width: f64) -> (Five, DMat2) {
        // Interpolation on a level averages over the square root of two cells.
        let level = (width.log2() - 0.5).clamp(0.0, (self.levels.len() - 1) as f64);
        let (fine, between) = (level.floor(), level.fract());
        let (mut moments, mut curvature) = self.interpolated(fine as usize, at);
        if between > 0.0 {
            let (coarse, coarse_curvature) = self.interpolated(fine as usize + 1, at);
            moments = moments.map(|moment| (1.0 - between) * moment);
            add(&mut moments, between, coarse);
            curvature = (1.0 - between) * curvature + between * coarse_curvature;
        }
        (moments, curvature)
    }

    /// Interpolates bilinearly between the cells of a level.
    fn interpolated(&self, level: usize, at: DVec2) -> (Five, DMat2) {
        let level = &self.levels[level];
        let cells_per_texel = DVec2::new(level.width as f64, level.height as f64) / self.size;
        let place = DVec2::new(at.x, self.size.y - at.y) * cells_per_texel - 0.5;
        let first = place.floor();
        let f = place - first;
        let (column, row) = (first.x as i64, first.y as i64);
        let mut moments = [0.0; 5];
        let mut curvature = DMat2::ZERO;
        for (dy, by_y, slope_y) in [(0, 1.0 - f.y, 1.0), (1, f.y, -1.0)] {
            for (dx, by_x, slope_x) in [(0, 1.0 - f.x, -1.0), (1, f.x, 1.0)] {
                let (column, row) = (column.saturating_add(dx), row.saturating_add(dy));
                let cell = level.cell(column, row, self.mirror);
                add(&mut moments, by_x * by_y, cell);
                let mean = DVec2::new(cell[0], cell[1]);
                curvature.x_axis += slope_x * by_y * cells_per_texel.x * mean;
                // Rows count down, the second coordinate up.
                curvature.y_axis += slope_y * by_x * cells_per_texel.y * mean;
            }
        }
        (moments, curvature)
    }
}

impl Level {
    /// Returns a cell, which may lie beyond the edges. A mirrored picture has mirrored slopes.
    fn cell(&self, column: i64, row: i64, mirror: bool) -> Five {
        let [x, y] = [index(column, self.width, mirror), index(row, self.height, mirror)];
        let [sx, sy, xx, xy, yy] = self.cells[y * self.width + x].map(f64::from);
        let turned =
            |at: i64, count: usize| mirror && at.rem_euclid(2 * count as i64) >= count as i64;
        let sign = |turned| if turned { -1.0 } else { 1.0 };
        let x = sign(turned(column, self.width));
        let y = sign(turned(row, self.height));
        [x * sx, y * sy, xx, x * y * xy, yy]
    }

    /// Returns the next level.
    fn halved(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let rows: Vec<Vec<(usize, f64)>> =
            (0..height).map(|y| shares(y, height, self.height)).collect();
        let columns: Vec<Vec<(usize, f64)>> =
            (0..width).map(|x| shares(x, width, self.width)).collect();
        let mut cells = Vec::with_capacity(width * height);
        for row in &rows {
            for column in &columns {
                let mut sum = [0.0; 5];
                for &(y, by_y) in row {
                    for &(x, by_x) in column {
                        add(&mut sum, by_x * by_y, self.cells[y * self.width + x].map(f64::from));
                    }
                }
                cells.push(sum.map(|moment| moment as f32));
            }
        }
        Self { width, height, cells }
    }
}

/// Returns the cells, of `fine` that divide a line evenly, below one of `coarse`, and their shares of
/// its length.
fn shares(cell: usize, coarse: usize, fine: usize) -> Vec<(usize, f64)> {
    let end = |cell: usize| (cell * fine) as f64 / coarse as f64;
    let (begin, stop) = (end(cell), end(cell + 1));
    let below = begin.floor() as usize..(stop.ceil() as usize).min(fine);
    let share = |k: usize| (stop.min((k + 1) as f64) - begin.max(k as f64)) / (stop - begin);
    below.map(|k| (k, share(k))).filter(|&(_, share)| share > 0.0).collect()
}

fn of(s: DVec2) -> Five {
    [s.x, s.y, s.x * s.x, s.x * s.y, s.y * s.y]
}

fn add(sum: &mut Five, weight: f64, other: Five) {
    for (sum, other) in sum.iter_mut().zip(other) {
        *sum += weight * other;
    }
}

/// Returns the slope over the parallelogram around a position with these two sides. `exact` returns
/// slopes and second derivatives at a point. `moments` returns the pyramid, and is called only if the
/// part is wide enough. Over a point, the slope is exact to the last bit.
pub fn averaged<'a>(
    at: DVec2,
    sides: [DVec2; 2],
    exact: impl Fn(DVec2) -> (DVec2, DMat2),
    moments: impl Fn() -> &'a Moments,
) -> SurfaceSlope {
    let (long, wide) = axes(sides);
    let length = long.length();
    let width = wide.max(length / MOST_PROBES);
    let [first, last] = EXACT;
    let coarse = ((width / first).log2() / (last / first).log2()).clamp(0.0, 1.0);
    // In less than half a texel, slopes change evenly. One probe with its curvature describes them.
    let covered = length * ((length - first) / first).clamp(0.0, 1.0);
    let (mut sum, mut curvature) = ([0.0; 5], DMat2::ZERO);
    for (off, weight) in probes(covered / width) {
        // A part without size has only the probe in its middle.
        let at = if off == 0.0 { at } else { at + (off * width / length) * long };
        if coarse < 1.0 {
            let (slopes, bend) = exact(at);
            add(&mut sum, weight * (1.0 - coarse), of(slopes));
            curvature += (weight * (1.0 - coarse)) * bend;
        }
        if coarse > 0.0 {
            let (means, bend) = moments().over(at, width);
            add(&mut sum, weight * coarse, means);
            curvature += (weight * coarse) * bend;
        }
    }
    let [x, y, xx, xy, yy] = sum;
    let (xx, xy, yy) = (xx - x * x, xy - x * y, yy - y * y);
    let covariance = DMat2::from_cols_array(&[xx, xy, xy, yy]);
    SurfaceSlope { mean: DVec2::new(x, y), curvature, covariance }
}

impl SurfaceSlope {
    /// Returns the slope by other coordinates, whose unit is `rate` units of the current ones.
    #[must_use]
    pub fn stretched(self, rate: DVec2) -> Self {
        let both = DMat2::from_cols_array(&[
            rate.x * rate.x,
            rate.x * rate.y,
            rate.x * rate.y,
            rate.y * rate.y,
        ]);
        let times = |matrix: DMat2| {
            DMat2::from_cols(matrix.x_axis * both.x_axis, matrix.y_axis * both.y_axis)
        };
        Self {
            mean: self.mean * rate,
            curvature: times(self.curvature),
            covariance: times(self.covariance),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural::Heights;
    use proptest::prelude::*;

    const WIDTH: usize = 13;
    const HEIGHT: usize = 9;

    /// A picture whose texture coordinates count texels.
    fn heights(mirror: bool) -> Heights {
        let values = (0..WIDTH * HEIGHT).map(|k| (k * k * 37 % 101) as f64 / 100.0).collect();
        let repeat = DVec2::new(1.0 / WIDTH as f64, 1.0 / HEIGHT as f64);
        Heights::new(values, WIDTH, repeat, mirror).unwrap()
    }

    fn vector(size: f64) -> impl Strategy<Value = DVec2> {
        prop::array::uniform2(-size..size).prop_map(DVec2::from)
    }

    /// Returns the mean of slopes and of their products over a period, of the exact slopes or of the
    /// slopes over the parallelogram with these sides.
    fn whole(heights: &Heights, sides: [DVec2; 2], mirror: bool) -> Five {
        let periods = if mirror { 2 } else { 1 };
        let (columns, rows) = (16 * periods * WIDTH, 16 * periods * HEIGHT);
        let mut sum = [0.0; 5];
        for k in 0..columns * rows {
            let at = DVec2::new((k % columns) as f64 + 0.5, (k / columns) as f64 + 0.5) / 16.0;
            let SurfaceSlope { mean, covariance, .. } = heights.slope(at, sides);
            let [x, y, xx, xy, yy] = of(mean);
            let c = covariance.to_cols_array();
            add(&mut sum, 1.0 / (columns * rows) as f64, [x, y, xx + c[0], xy + c[1], yy + c[3]]);
        }
        sum
    }

    /// Averaging moves slopes from the mean to the covariance, and keeps their sum over the picture.
    #[test]
    fn over_parts_of_any_size_the_moments_of_the_picture_are_kept() {
        for mirror in [false, true] {
            let heights = heights(mirror);
            let truth = whole(&heights, [DVec2::ZERO; 2], mirror);
            for sides in [
                [DVec2::new(0.3, 0.1), DVec2::new(0.1, 0.3)],
                [DVec2::new(1.1, 0.2), DVec2::new(-0.3, 0.8)],
                [DVec2::new(7.0, 0.2), DVec2::new(-0.3, 0.6)],
                [DVec2::new(3.0, 1.0), DVec2::new(0.0, 4.0)],
                [DVec2::new(900.0, 1.0), DVec2::new(0.0, 400.0)],
                [DVec2::INFINITY, DVec2::NAN],
            ] {
                let found = whole(&heights, sides, mirror);
                // Means are exact up to single precision. Products are up to 0.3, of which Gauss's
                // rule misses up to a hundredth.
                for (k, (found, truth)) in found.into_iter().zip(truth).enumerate() {
                    let tolerance = if k < 2 { 1e-5 } else { 3e-3 };
                    assert!(
                        (found - truth).abs() < tolerance,
                        "{mirror} {sides:?}: {found} {truth}"
                    );
                }
            }
        }
    }

    #[test]
    fn over_the_whole_picture_no_slope_is_left() {
        let heights = heights(false);
        let side = 1000.0;
        let found = heights.slope(DVec2::ONE, [side * DVec2::X, side * DVec2::Y]);
        // Moments are stored in single precision.
        assert!(found.mean.length() < 1e-6 && found.covariance.determinant() > 0.0, "{found:?}");
        assert!(Moments::bytes(WIDTH, HEIGHT) == 20 * (13 * 9 + 7 * 5 + 4 * 3 + 2 * 2 + 1));
    }

    proptest! {
        #[test]
        fn the_curvature_is_that_of_the_mean(
            at in vector(20.0), a in vector(6.0), b in vector(6.0), scale in 0.0..1.0f64,
        ) {
            let heights = heights(true);
            let mean = |at| heights.slope(at, [scale * a, scale * b]).mean;
            let step = 1e-6;
            let by = |axis: DVec2| (mean(at + step * axis) - mean(at - step * axis)) / (2.0 * step);
            let expected = DMat2::from_cols(by(DVec2::X), by(DVec2::Y));
            let found = heights.slope(at, [scale * a, scale * b]).curvature;
            // Slopes are up to 1 per texel. Interpolation has kinks between cells; few of the random
            // points are so near to one that a difference extends across it.
            let near = (found - expected).abs_diff_eq(DMat2::ZERO, 1e-4);
            let kinked = [DVec2::X, DVec2::Y].into_iter().any(|axis| {
                let bend = |side: f64| heights.slope(at + side * step * axis, [scale * a, scale * b]).curvature;
                !bend(1.0).abs_diff_eq(bend(-1.0), 1e-4)
            });
            prop_assert!(near || kinked, "{found} {expected}");
        }

        /// A part that grows by a millionth changes its slope by about as much.
        #[test]
        fn slopes_are_continuous_in_the_size(
            at in vector(20.0), a in vector(6.0), b in vector(6.0), scale in 0.0..3.0f64,
        ) {
            let heights = heights(false);
            let over = |scale: f64| heights.slope(at, [scale * a, scale * b]);
            let (one, other) = (over(scale), over(scale + 1e-6));
            prop_assert!(one.mean.abs_diff_eq(other.mean, 1e-4), "{one:?} {other:?}");
            prop_assert!(one.covariance.abs_diff_eq(other.covariance, 1e-4), "{one:?} {other:?}");
        }
    }
}
