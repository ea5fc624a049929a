//! Settings of the sampling: number, position and weight of the samples of a pixel.

use super::pattern::Pattern;
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::Deserialize;
use std::ops::RangeInclusive;

/// Largest number of samples along each side of a pixel. More samples would not change a 16-bit
/// file.
pub const MOST_SAMPLES: u32 = 256;

/// Number, position and weight of the samples of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// Cells whose rays carry differentials, and which are split where neighbours disagree.
    Area {
        /// Cells along each side of a pixel, 1 to [`MOST_SAMPLES`]. A pixel filter that reaches
        /// beyond the pixel doubles the number.
        samples: u32,
        /// Weights of the cells.
        pixel_filter: PixelFilter,
        /// Estimated error of a cell times its area in pixels, in linear light, above which the
        /// cell is split; `None` if no cell is split.
        threshold: Option<f64>,
    },
}

/// The threshold of [`Sampling::Area`] unless another one is given.
///
/// A larger one leaves steps at edges of little contrast. A smaller one costs rays and gains
/// little, since the error of unsplit cells remains.
pub const THRESHOLD: f64 = 0.1;

/// Thresholds that a user may choose. A smaller one would split every pixel into 256 parts.
pub const SPLITS: RangeInclusive<f64> = 1e-4..=1.0;

/// Part of the threshold of [`Sampling::Area`] that a ray must weigh in its cell to be followed.
///
/// The light of a ray that weighs less is taken to be that of the other ray at its surface. A twentieth
/// leaves the errors of the peer scenes within 0.0001. With a larger part, glass loses its faint inner
/// reflections.
const FOLLOWED: f64 = 0.05;

impl Sampling {
    /// Returns the least weight of a ray in its cell that is worth following, [0, 1].
    #[must_use]
    pub fn least_weight(self) -> f64 {
        match self {
            Self::Area { threshold, .. } => threshold.map_or(0.0, |threshold| FOLLOWED * threshold),
            Self::Grid { .. } | Self::Supersample(_) => 0.0,
        }
    }
}

/// The name of a sampling method on the command line and in JSON. The attribute `help` is the text
/// of `--help`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ValueEnum, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(description = "A method of choosing the rays of a pixel.")]
pub enum SamplingMethod {
    /// The name of [`Sampling::Area`].
    #[default]
    #[schemars(
        description = "One ray for each pixel, with the area that it stands for; pixels split at edges."
    )]
    #[value(
        help = "One ray for each pixel, with the area that it stands for; pixels split at edges"
    )]
    Area,
    /// The name of [`Sampling::Grid`] and [`Sampling::Supersample`].
    #[schemars(
        description = "The thesis's lattice of rays; areas are boxes around a ray's eight neighbours."
    )]
    #[value(help = "The thesis's lattice of rays; areas are boxes around a ray's eight neighbours")]
    Thesis,
}

/// Weights of a grid's samples in a pixel. The name on the command line and in JSON is that of the
/// variant; the attribute `help` is the text of `--help`.
///
/// A new pixel filter provides, and the compiler leads to each `match`:
///
/// - in `lattice/mod.rs` its range of samples (`Lattice::under`) and its weights (`Lattice::weight`):
///   products of whole numbers along both axes, none negative, whose sum over a pixel is
///   `Lattice::whole` along each axis;
/// - a weight in a mirrored column that equals the weight in the column itself;
/// - if it needs more than one sample, a complaint in `cli/sampling.rs` and in pipeline's `job/sampling.rs`;
/// - tests: an entry in `all()` of the tests of `lattice/mod.rs`; a constant picture stays constant.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ValueEnum, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(description = "Weights of the rays in a pixel.")]
pub enum PixelFilter {
    /// Equal weights for the samples in the pixel, and none for others.
    #[default]
    #[value(help = "Equal weights for the rays in the pixel")]
    Box,
    /// A tent that reaches to the middles of the neighbouring pixels. With one sample in each pixel
    /// the tent covers only the pixel's own sample.
    #[value(
        help = "A tent that reaches to the middles of the neighbouring pixels; needs --samples of \
                at least 2"
    )]
    Tent,
    /// A Gaussian with a standard deviation of half a pixel, up to one and a half pixels from the
    /// middle of the pixel.
    #[value(
        help = "A Gaussian with a standard deviation of half a pixel; with --sampling thesis it \
                needs --samples of at least 2"
    )]
    Gaussian,
}

/// Choice of the neighbours that span the footprints of a pixel's nine rays; see
/// [`Sampling::Supersample`].
///
/// With a filter that averages over points only, both choices give the same picture to the last
/// bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, ValueEnum, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(description = "The neighbours that span the footprints of a pixel's nine rays.")]
pub enum Supersample {
    /// The picture of twice the size is rendered like any other (thesis 4.5.4). Each of its samples
    /// is averaged over the box of its own eight neighbours, half a pixel away.
    #[value(help = None::<&'static str>)]
    #[schemars(
        description = "The picture of twice the size is rendered, each of whose rays has its own eight neighbours."
    )]
    Image,
    /// The nine rays of a pixel are each other's neighbours (thesis 4.5.1: "row 1 and row 2 must be
    /// cleared and row 3 must be shifted to the place of row 1"). All nine are averaged over the
    /// box that they span together, which is the pixel. Textures are sharper than with
    /// [`Supersample::Image`]. Every pixel shades nine trees and shares none of their colours with its
    /// neighbours.
    #[value(help = None::<&'static str>)]
    #[schemars(description = "The nine rays of a pixel are each other's neighbours.")]
    Rays,
}

impl Sampling {
    /// A grid of `samples * samples` samples in each pixel, evenly spread and of equal weight.
    #[must_use]
    pub fn regular(samples: u32) -> Self {
        Self::Grid { samples, pattern: Pattern::Regular, pixel_filter: PixelFilter::Box }
    }
}
