//! The flags for the size of the picture, its crop, and the rays of a pixel.

use super::UseError;
use clap::Args;
use render::Sampling;
use render::film::{Crop, MOST_SAMPLES, PatternName, PixelFilter, Supersample, crop};

#[derive(Debug, Args)]
pub struct SamplingArguments {
    /// Pixels across and down, 1 to 65536 each
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = render::film::size)]
    pub size: (u32, u32),
    /// Make only this part of the picture: column and row of its upper left pixel, from 0, and its
    /// size
    #[arg(long, value_name = "X,Y,WxH", value_parser = Crop::parse)]
    pub crop: Option<Crop>,
    /// Rays along each side of a pixel, 1 to 256: N times N rays in each pixel
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SAMPLES)))]
    samples: u32,
    /// Position of each ray in its cell of the pixel
    #[arg(long, value_name = "PATTERN", default_value = "regular")]
    pattern: PatternName,
    /// Seed of the jitter: a whole number from 0 to 2^64 - 1 [default: 0]
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Weights of the rays in a pixel
    #[arg(long, value_name = "SHAPE", default_value = "box")]
    pixel_filter: PixelFilter,
    /// Instead of --samples, trace the picture at twice the size. Each pixel is the mean of nine rays:
    /// its middle with weight 1/4, its sides with 1/8 and its corners with 1/16. Textures are averaged
    /// for each ray (image), or for the nine rays of a pixel together (rays)
    #[arg(long, value_name = "HOW", num_args = 0..=1, require_equals = true,
        default_missing_value = "image", conflicts_with_all = ["samples", "pattern", "seed", "pixel_filter"])]
    supersample: Option<Supersample>,
    /// Print the colour of this pixel, and the tree of reflections and refractions of the ray in its
    /// middle. Column and row count from 0, in the whole picture
    #[arg(long, value_name = "X,Y", value_parser = crop::pixel)]
    pub pixel: Option<(u32, u32)>,
    /// With --pixel: print the trees of all rays that have a weight in the pixel
    #[arg(long, requires = "pixel")]
    pub all_samples: bool,
}

impl SamplingArguments {
    /// Checks that the crop and the pixel lie in the picture.
    pub fn check(&self) -> Result<(), UseError> {
        let (width, height) = self.size;
        match (self.crop, self.pixel) {
            (Some(crop), _) if !crop.fits(width, height) => {
                let Crop { x, y, width: across, height: down } = crop;
                Err(UseError::CropOutside(format!("{x},{y},{across}x{down}"), width, height))
            }
            (_, Some((x, y))) if x >= width || y >= height => {
                Err(UseError::PixelOutside(x, y, width, height))
            }
            _ => Ok(()),
        }
    }

    /// Returns number, position and weight of the rays of a pixel.
    pub fn sampling(&self) -> Result<Sampling, UseError> {
        if let Some(nine) = self.supersample {
            return Ok(Sampling::Supersample(nine));
        }
        let pattern = self.pattern.pattern(self.seed).ok_or(UseError::SeedOfNothing)?;
        let pixel_filter = match self.pixel_filter {
            PixelFilter::Tent if self.samples < 2 => return Err(UseError::TentOfOne),
            filter @ (PixelFilter::Box | PixelFilter::Tent) => filter,
        };
        Ok(Sampling::Grid { samples: self.samples, pattern, pixel_filter })
    }
}
