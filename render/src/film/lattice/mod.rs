//! The thesis's method of exposing a tile: one lattice of samples over the whole film.
//!
//! The columns and rows of the samples are whole numbers, counted from the upper left and negative
//! to the left of the film and above it. A sample's position does not depend on the pixel that uses
//! the sample.
//!
//! ```text
//!   N x N, here N = 2            nine weights: the same lattice, moved by
//!   +---------+---------+       a quarter of a pixel, so that one sample
//!   | 0   1   | 2   3   |       is in the middle of each pixel
//!   +---------+---------+       0    1    2    3    4
//!                                +---------+---------+
//! ```
//!
//! The weights of a pixel are products of whole numbers along both axes, divided once by their sum.
//! The weights therefore sum to exactly one. A pixel adds its samples row by row, and this order
//! does not depend on tiles.

mod expose;

use super::Crop;
use super::pattern::Pattern;
use super::sampling::{PixelFilter, Supersample};
use crate::color::Color;
use glam::DVec2;
use std::ops::Range;

/// Smallest side of a tile in pixels, where pixels share samples. A smaller tile increases the part
/// of the work that is repeated for the next tile (a half at 4).
const LEAST_SHARING: u32 = 4;

/// A lattice of samples over the whole film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lattice {
    /// Columns per pixel, which is also the number of rows per pixel.
    per_pixel: i64,
    /// Position of each sample within its cell.
    pattern: Pattern,
    weights: Weights,
}

/// Weights of the columns of samples in a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Weights {
    /// Equal weights, of a pixel's own samples.
    Even,
    /// A tent up to the middles of the neighbouring pixels.
    Tent,
    /// A Gaussian up to one and a half pixels from the middle of the pixel.
    Gaussian,
    /// 1, 2 and 1: the nine samples of the thesis, which lie at the corners of their cells.
    Supersample(Supersample),
}

impl Lattice {
    /// The lattice of [`Sampling::Grid`](super::Sampling::Grid).
    pub fn grid(samples: u32, pattern: Pattern, pixel_filter: PixelFilter) -> Self {
        let weights = match pixel_filter {
            PixelFilter::Box => Weights::Even,
            PixelFilter::Tent => Weights::Tent,
            PixelFilter::Gaussian => Weights::Gaussian,
        };
        Self { per_pixel: i64::from(samples), pattern, weights }
    }

    /// The lattice of [`Sampling::Nine`](super::Sampling::Nine).
    pub fn supersample(method: Supersample) -> Self {
        Self { per_pixel: 2, pattern: Pattern::Regular, weights: Weights::Supersample(method) }
    }

    /// Number of columns per pixel, which is also the number of rows per pixel.
    pub fn per_pixel(self) -> i64 {
        self.per_pixel
    }

    /// Returns a side of tiles, in pixels, at which about `samples` samples lie along it.
    pub fn tile_side(self, samples: u32) -> u32 {
        let least = if self.shares() { LEAST_SHARING } else { 1 };
        (samples / self.per_pixel as u32).max(least)
    }

    /// Returns the weights of the columns, or rows, of a pixel. They are the same in all pixels.
    pub fn weights(self) -> Vec<i64> {
        self.under(0..1).map(|column| self.weight(0, column)).collect()
    }

    /// Adds row `down` of a tile's samples to the pixels in which it has a weight. `weights` are
    /// those of [`Lattice::weights`], `colors` those of the row's samples, and `pixels` those of the
    /// tile, row by row.
    pub fn gather(
        self,
        down: usize,
        tile: &Crop,
        weights: &[i64],
        colors: &[Color],
        pixels: &mut [Color],
    ) {
        let per_pixel = self.per_pixel as usize;
        let width = tile.width as usize;
        // Pixels use the samples from `per_pixel` times their row on.
        let first = (down + 1).saturating_sub(weights.len()).div_ceil(per_pixel);
        let last = (down / per_pixel).min(tile.height as usize - 1);
        for row in first..=last {
            let down = weights[down - row * per_pixel];
            let pixels = &mut pixels[row * width..][..width];
            for (column, pixel) in pixels.iter_mut().enumerate() {
                for (across, color) in weights.iter().zip(&colors[column * per_pixel..]) {
                    *pixel += (down * across) as f64 * *color;
                }
            }
        }
    }

    /// Returns the position on the film of the sample in column `x` and row `y`, in pixels from the
    /// upper left corner.
    pub fn position(self, x: i64, y: i64) -> DVec2 {
        let corner = DVec2::new(x as f64, y as f64);
        match self.weights {
            Weights::Even | Weights::Tent | Weights::Gaussian => {
                (corner + self.pattern.offset(x, y)) / self.per_pixel as f64
            }
            Weights::Supersample(_) => 0.5 * corner,
        }
    }

    /// Returns the column of the sample that represents a pixel: the sample in its middle, or the
    /// first one after the middle. Rows follow the same rule.
    pub fn middle(self, pixel: u32) -> i64 {
        let n = self.per_pixel;
        i64::from(pixel) * n + n / 2
    }

    /// Returns the columns of the samples that have a weight in a range of pixels. Rows follow the
    /// same rule.
    pub fn under(self, pixels: Range<u32>) -> Range<i64> {
        let n = self.per_pixel;
        let (start, end) = (i64::from(pixels.start) * n, i64::from(pixels.end) * n);
        match self.weights {
            Weights::Even => start..end,
            Weights::Tent => start - n / 2..end + n / 2,
            Weights::Gaussian => start - n..end + n,
            Weights::Supersample(_) => start..end + 1,
        }
    }

    /// Returns whether neighbouring pixels share samples.
    fn shares(self) -> bool {
        self.under(0..1).end > self.under(1..2).start
    }

    /// Returns the weight of a column of samples in a pixel, as a part of [`Lattice::whole`]. The
    /// weight is 0 outside [`Lattice::under`]. Rows follow the same rule.
    pub fn weight(self, pixel: u32, column: i64) -> i64 {
        if !self.under(pixel..pixel + 1).contains(&column) {
            return 0;
        }
        let n = self.per_pixel;
        let into = column - i64::from(pixel) * n;
        match self.weights {
            Weights::Even => 1,
            // Distance of the middles of the sample's cell and of the pixel, in halves of a cell.
            Weights::Tent => 2 * n - (2 * into + 1 - n).abs(),
            Weights::Gaussian => gaussian(into, n),
            Weights::Supersample(_) => 2 - (into - 1).abs(),
        }
    }

    /// Returns the sum of the weights of a pixel along one axis.
    pub fn whole(self) -> i64 {
        let n = self.per_pixel;
        match self.weights {
            Weights::Even => n,
            Weights::Tent => 2 * n * n,
            Weights::Gaussian => (-n..2 * n).map(|into| gaussian(into, n)).sum(),
            Weights::Supersample(_) => 4,
        }
    }
}

/// Standard deviation of the Gaussian filter, in pixels: that of a filter which neither blurs nor
/// shows the pixels. A larger one blurs; a smaller one comes close to a box.
const SIGMA: f64 = 0.5;

/// Returns the weight of column `into` of a pixel with `n` columns, of which negative ones lie to
/// the left of it: the Gaussian's integral over the column, as a part of about 2^24.
fn gaussian(into: i64, n: i64) -> i64 {
    // Simpson's rule; the error is below a unit of the result.
    const PARTS: i32 = 16;
    let density = |at: f64| (-0.5 * (at / SIGMA).powi(2)).exp();
    let (width, from) = (1.0 / n as f64, into as f64 / n as f64 - 0.5);
    let sum: f64 = (0..=PARTS)
        .map(|k| {
            let times = if k == 0 || k == PARTS { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
            times * density(from + width * f64::from(k) / f64::from(PARTS))
        })
        .sum();
    let integral = sum * width / (3.0 * f64::from(PARTS));
    ((1 << 24) as f64 * integral / (SIGMA * (2.0 * std::f64::consts::PI).sqrt())).round() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Lattice> {
        let mut all =
            vec![Lattice::supersample(Supersample::Image), Lattice::supersample(Supersample::Rays)];
        for samples in [1, 2, 3, 4, 5, 8, 255, 256] {
            for pixel_filter in [PixelFilter::Box, PixelFilter::Tent] {
                all.push(Lattice::grid(samples, Pattern::Regular, pixel_filter));
            }
        }
        all
    }

    #[test]
    fn weights_sum_to_the_whole_and_lie_even_about_the_middle() {
        for lattice in all() {
            let columns = lattice.under(3..4);
            let weights: Vec<i64> = columns.clone().map(|x| lattice.weight(3, x)).collect();
            assert_eq!(weights.iter().sum::<i64>(), lattice.whole(), "{lattice:?}");
            assert!(weights.iter().all(|&weight| weight > 0), "{lattice:?}: {weights:?}");
            let mirrored: Vec<i64> = weights.iter().rev().copied().collect();
            assert_eq!(weights, mirrored, "{lattice:?}");
            assert_eq!(lattice.weight(3, columns.start - 1), 0);
            assert_eq!(lattice.weight(3, columns.end), 0);
            let middle = lattice.weight(3, lattice.middle(3));
            assert_eq!(Some(&middle), weights.iter().max(), "{lattice:?}");
        }
    }

    #[test]
    fn every_sample_counts_the_same_in_all_pixels_together() {
        for lattice in all() {
            let n = lattice.per_pixel;
            for x in 5 * n..6 * n {
                let sum: i64 = (3..9).map(|pixel| lattice.weight(pixel, x)).sum();
                // The weights of one pixel, divided by the number of samples per pixel.
                assert_eq!(sum * n, lattice.whole(), "{lattice:?}, column {x}");
            }
        }
    }

    #[test]
    fn the_nine_weights_are_those_of_the_thesis() {
        let nine = Lattice::supersample(Supersample::Image);
        let at =
            |x, y| (nine.weight(7, x) * nine.weight(4, y)) as f64 / (nine.whole().pow(2) as f64);
        let (x, y) = (nine.middle(7), nine.middle(4));
        assert_eq!(nine.position(x, y), DVec2::new(7.5, 4.5), "the middle of the pixel");
        assert_eq!(at(x, y), 1.0 / 4.0);
        assert_eq!([at(x - 1, y), at(x, y - 1), at(x + 1, y), at(x, y + 1)], [1.0 / 8.0; 4]);
        for (dx, dy) in [(-1, -1), (1, -1), (-1, 1), (1, 1)] {
            assert_eq!(at(x + dx, y + dy), 1.0 / 16.0);
        }
    }
}
