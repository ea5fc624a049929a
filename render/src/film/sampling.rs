//! Positions and weights of the samples of a picture.
//!
//! Samples lie on one lattice over the whole film. Their columns and rows are whole numbers,
//! counted from the upper left and negative to the left of the film and above it. A sample's
//! position does not depend on the pixel that uses the sample.
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

use super::pattern::Pattern;
use clap::ValueEnum;
use glam::DVec2;
use serde::Deserialize;
use std::ops::Range;

/// Largest number of samples along each side of a pixel. More samples would not change a 16-bit
/// file.
pub const MOST_SAMPLES: u32 = 256;

/// Number, position and weight of the samples of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// `samples * samples` samples in each pixel.
    Grid {
        /// Samples along each side of a pixel, 1 to [`MOST_SAMPLES`].
        samples: u32,
        /// Position of each sample within its cell of the pixel.
        pattern: Pattern,
        /// Weights of the samples.
        pixel_filter: PixelFilter,
    },
    /// The thesis's uniform supersampling (4.5.4): the picture is traced at twice the size. Each
    /// pixel takes the sample in its middle with weight 1/4, the four samples beside it with 1/8
    /// and the four at its corners with 1/16.
    ///
    /// We read "the pixel in the middle" as the sample in the middle of the small picture's pixel.
    /// A lattice of 2n x 2n samples has none there. The lattice is therefore moved by a quarter of
    /// a pixel, since otherwise the small picture would be moved. Pixel `k` uses the columns `2k`,
    /// `2k + 1` and `2k + 2`, and shares the outer two with its neighbours; rows likewise. Samples
    /// on the border of the film and beyond it are traced like all others.
    Supersample(Supersample),
}

/// Weights of a grid's samples in a pixel. The name on the command line and in JSON is that of the
/// variant; the attribute `help` is the text of `--help`.
///
/// A new pixel filter provides, and the compiler leads to each `match`:
///
/// - its range of samples ([`Sampling::under`]) and its weights ([`Sampling::weight`]): products of
///   whole numbers along both axes, none negative, whose sum over a pixel is [`Sampling::whole`]
///   along each axis;
/// - a weight in a mirrored column that equals the weight in the column itself;
/// - if it needs more than one sample, a complaint in `cli/sampling.rs` and in pipeline's `job/mode.rs`;
/// - tests: the three tests below take the filter from `all()`; a constant picture stays constant.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum PixelFilter {
    /// Equal weights for the samples in the pixel, and none for others.
    #[default]
    #[value(help = "Those in the pixel, equally")]
    Box,
    /// A tent that reaches to the middles of the neighbouring pixels. With one sample in each pixel
    /// the tent covers only the pixel's own sample.
    #[value(
        help = "By a tent that reaches to the middles of the neighbouring pixels; N is at least 2 for it"
    )]
    Tent,
}

/// Choice of the neighbours that span the footprints of a pixel's nine rays; see
/// [`Sampling::Supersample`].
///
/// With a filter that averages over points only, both choices give the same picture to the last
/// bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum Supersample {
    /// The picture of twice the size is rendered like any other (thesis 4.5.4). Each of its samples
    /// is averaged over the box of its own eight neighbours, half a pixel away.
    #[value(help = None::<&'static str>)]
    Image,
    /// The nine rays of a pixel are each other's neighbours (thesis 4.5.1: "row 1 and row 2 must be
    /// cleared and row 3 must be shifted to the place of row 1"). All nine are averaged over the
    /// box that they span together, which is the pixel. Textures are sharper than with
    /// [`Supersample::Image`]. Every pixel shades nine trees and shares none of their colours with its
    /// neighbours.
    #[value(help = None::<&'static str>)]
    Rays,
}

impl Sampling {
    /// A grid of `samples * samples` samples in each pixel, evenly spread and of equal weight.
    #[must_use]
    pub fn regular(samples: u32) -> Self {
        Self::Grid { samples, pattern: Pattern::Regular, pixel_filter: PixelFilter::Box }
    }

    /// Columns of the lattice per pixel, which is also the number of rows per pixel.
    #[must_use]
    pub fn per_pixel(self) -> u32 {
        match self {
            Self::Grid { samples, .. } => samples,
            Self::Supersample(_) => 2,
        }
    }

    /// Returns the position on the film of the sample in column `x` and row `y`, in pixels from the
    /// upper left corner.
    #[must_use]
    pub fn place(self, x: i64, y: i64) -> DVec2 {
        let corner = DVec2::new(x as f64, y as f64);
        match self {
            Self::Grid { samples, pattern, .. } => {
                (corner + pattern.offset(x, y)) / f64::from(samples)
            }
            Self::Supersample(_) => 0.5 * corner,
        }
    }

    /// Returns the column of the sample that represents a pixel: the sample in its middle, or the
    /// first one after the middle. Rows follow the same rule.
    #[must_use]
    pub fn middle(self, pixel: u32) -> i64 {
        let n = i64::from(self.per_pixel());
        i64::from(pixel) * n + n / 2
    }

    /// Returns the columns of the samples that have a weight in a range of pixels. Rows follow the
    /// same rule.
    #[must_use]
    pub fn under(self, pixels: Range<u32>) -> Range<i64> {
        let n = i64::from(self.per_pixel());
        let (start, end) = (i64::from(pixels.start) * n, i64::from(pixels.end) * n);
        match self {
            Self::Grid { pixel_filter: PixelFilter::Box, .. } => start..end,
            Self::Grid { pixel_filter: PixelFilter::Tent, .. } => start - n / 2..end + n / 2,
            Self::Supersample(_) => start..end + 1,
        }
    }

    /// Returns whether neighbouring pixels share samples.
    #[must_use]
    pub fn shares(self) -> bool {
        self.under(0..1).end > self.under(1..2).start
    }

    /// Returns the weight of a column of samples in a pixel, as a part of [`Sampling::whole`]. The
    /// weight is 0 outside [`Sampling::under`]. Rows follow the same rule.
    #[must_use]
    pub fn weight(self, pixel: u32, column: i64) -> i64 {
        if !self.under(pixel..pixel + 1).contains(&column) {
            return 0;
        }
        let n = i64::from(self.per_pixel());
        let into = column - i64::from(pixel) * n;
        match self {
            Self::Grid { pixel_filter: PixelFilter::Box, .. } => 1,
            // Distance of the middles of the sample's cell and of the pixel, in halves of a cell.
            Self::Grid { pixel_filter: PixelFilter::Tent, .. } => 2 * n - (2 * into + 1 - n).abs(),
            Self::Supersample(_) => 2 - (into - 1).abs(),
        }
    }

    /// Returns the sum of the weights of a pixel along one axis.
    #[must_use]
    pub fn whole(self) -> i64 {
        let n = i64::from(self.per_pixel());
        match self {
            Self::Grid { pixel_filter: PixelFilter::Box, .. } => n,
            Self::Grid { pixel_filter: PixelFilter::Tent, .. } => 2 * n * n,
            Self::Supersample(_) => 4,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Sampling> {
        let mut all = vec![
            Sampling::Supersample(Supersample::Image),
            Sampling::Supersample(Supersample::Rays),
        ];
        for samples in [1, 2, 3, 4, 5, 8, 255, 256] {
            for pixel_filter in [PixelFilter::Box, PixelFilter::Tent] {
                let pattern = Pattern::Regular;
                all.push(Sampling::Grid { samples, pattern, pixel_filter });
            }
        }
        all
    }

    #[test]
    fn weights_sum_to_the_whole_and_lie_even_about_the_middle() {
        for sampling in all() {
            let columns = sampling.under(3..4);
            let weights: Vec<i64> = columns.clone().map(|x| sampling.weight(3, x)).collect();
            assert_eq!(weights.iter().sum::<i64>(), sampling.whole(), "{sampling:?}");
            assert!(weights.iter().all(|&weight| weight > 0), "{sampling:?}: {weights:?}");
            let mirrored: Vec<i64> = weights.iter().rev().copied().collect();
            assert_eq!(weights, mirrored, "{sampling:?}");
            assert_eq!(sampling.weight(3, columns.start - 1), 0);
            assert_eq!(sampling.weight(3, columns.end), 0);
            let middle = sampling.weight(3, sampling.middle(3));
            assert_eq!(Some(&middle), weights.iter().max(), "{sampling:?}");
        }
    }

    #[test]
    fn every_sample_counts_the_same_in_all_pixels_together() {
        for sampling in all() {
            let n = i64::from(sampling.per_pixel());
            for x in 5 * n..6 * n {
                let sum: i64 = (3..9).map(|pixel| sampling.weight(pixel, x)).sum();
                // The weights of one pixel, divided by the number of samples per pixel.
                assert_eq!(sum * n, sampling.whole(), "{sampling:?}, column {x}");
            }
        }
    }

    #[test]
    fn the_nine_weights_are_those_of_the_thesis() {
        let nine = Sampling::Supersample(Supersample::Image);
        let at =
            |x, y| (nine.weight(7, x) * nine.weight(4, y)) as f64 / (nine.whole().pow(2) as f64);
        let (x, y) = (nine.middle(7), nine.middle(4));
        assert_eq!(nine.place(x, y), DVec2::new(7.5, 4.5), "the middle of the pixel");
        assert_eq!(at(x, y), 1.0 / 4.0);
        assert_eq!([at(x - 1, y), at(x, y - 1), at(x + 1, y), at(x, y + 1)], [1.0 / 8.0; 4]);
        for (dx, dy) in [(-1, -1), (1, -1), (-1, 1), (1, 1)] {
            assert_eq!(at(x + dx, y + dy), 1.0 / 16.0);
        }
    }
}
