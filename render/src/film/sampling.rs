//! Settings of the sampling: number, position and weight of the samples of a pixel.

use super::pattern::Pattern;
use serde::Deserialize;

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
    Nine(Nine),
}

/// Weights of a grid's samples in a pixel.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PixelFilter {
    /// Equal weights for the samples in the pixel, and none for others.
    #[default]
    Box,
    /// A tent that reaches to the middles of the neighbouring pixels. With one sample in each pixel
    /// the tent covers only the pixel's own sample.
    Tent,
}

/// Choice of the neighbours that span the footprints of a pixel's nine rays; see
/// [`Sampling::Nine`].
///
/// With a filter that averages over points only, both choices give the same picture to the last
/// bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Nine {
    /// The picture of twice the size is rendered like any other (thesis 4.5.4). Each of its samples
    /// is averaged over the box of its own eight neighbours, half a pixel away.
    Image,
    /// The nine rays of a pixel are each other's neighbours (thesis 4.5.1: "row 1 and row 2 must be
    /// cleared and row 3 must be shifted to the place of row 1"). All nine are averaged over the
    /// box that they span together, which is the pixel. Textures are sharper than with
    /// [`Nine::Image`]. Every pixel shades nine trees and shares none of their colours with its
    /// neighbours.
    Rays,
}

impl Sampling {
    /// A grid of `samples * samples` samples in each pixel, evenly spread and of equal weight.
    #[must_use]
    pub fn regular(samples: u32) -> Self {
        Self::Grid { samples, pattern: Pattern::Regular, pixel_filter: PixelFilter::Box }
    }
}
