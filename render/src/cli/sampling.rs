//! The flags for the size of the picture, its crop, and the rays of a pixel.

use super::UseError;
use clap::{Args, ValueEnum};
use render::Sampling;
use render::film::crop::Tile;
use render::film::{
    Crop, MOST_SAMPLES, PatternName, PixelFilter, SPLITS, SamplingMethod, Supersample, THRESHOLD,
    crop,
};

#[derive(Debug, Args)]
pub struct SamplingArguments {
    /// Pixels across and down, 1 to 65536 each
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = render::film::size)]
    pub size: (u32, u32),
    /// Make only this part of the picture: column and row of its upper left pixel, from 0, and its
    /// size
    #[arg(long, value_name = "X,Y,WxH", value_parser = Crop::parse)]
    crop: Option<Crop>,
    /// Make only part K of N: the picture is cut into N bands of about equally many rows, from the top. `pipeline
    /// join` puts the parts together. With --error each part reaches the error, and so does the whole
    #[arg(long, value_name = "K/N", value_parser = Tile::parse, conflicts_with_all = ["crop", "pixel"])]
    tile: Option<Tile>,
    /// Method of choosing rays and the areas that they stand for
    #[arg(long, value_name = "METHOD", default_value = "area")]
    sampling: SamplingMethod,
    /// Rays along each side of a pixel, 1 to 256: N times N rays in each pixel
    /// [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SAMPLES)))]
    samples: Option<u32>,
    /// With --sampling area: split a pixel, or a part of one, while its estimated error times its
    /// area is above this: a number from 0.0001 to 1, in linear light, or none [default: 0.1]
    #[arg(long, value_name = "E|none", value_parser = split)]
    split: Option<Split>,
    /// With --sampling thesis: position of each ray in its cell of the pixel [default: regular]
    #[arg(long, value_name = "PATTERN")]
    pattern: Option<PatternName>,
    /// Seed of --pattern jitter: a whole number from 0 to 2^64 - 1 [default: 0]
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Weights of the rays in a pixel
    #[arg(long, value_name = "SHAPE", default_value = "box")]
    pub pixel_filter: PixelFilter,
    /// With --sampling thesis, instead of --samples: trace the picture at twice the size. Each pixel is the mean of nine rays:
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
        if let Some(tile) = self.tile.filter(|tile| tile.count > height) {
            return Err(UseError::ThinTiles(tile.number, tile.count, height));
        }
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

    /// Returns the part of the picture that is made; `None` for all of it.
    pub fn crop(&self) -> Option<Crop> {
        let (width, height) = self.size;
        self.tile.map(|tile| tile.crop(width, height)).or(self.crop)
    }

    /// Returns a flag that was given and that chooses the number or the position of the rays, if any.
    pub fn choices(&self) -> Option<&'static str> {
        let thesis = self.sampling == SamplingMethod::Thesis;
        let given = [
            ("--samples", self.samples.is_some()),
            ("--split", self.split.is_some()),
            ("--sampling thesis", thesis),
            ("--pattern", self.pattern.is_some()),
            ("--seed", self.seed.is_some()),
            ("--supersample", self.supersample.is_some()),
        ];
        given.into_iter().find(|(_, given)| *given).map(|(flag, _)| flag)
    }

    /// Returns number, position and weight of the rays of a pixel.
    pub fn sampling(&self) -> Result<Sampling, UseError> {
        let Self { sampling, split, pattern, seed, pixel_filter, supersample, .. } = *self;
        let samples = self.samples.unwrap_or(1);
        match sampling {
            SamplingMethod::Area => {
                let given = [
                    ("--pattern", pattern.is_some()),
                    ("--seed", seed.is_some()),
                    ("--supersample", supersample.is_some()),
                ];
                if let Some((flag, _)) = given.into_iter().find(|(_, given)| *given) {
                    return Err(UseError::OfOtherSampling(flag, "thesis"));
                }
                let threshold = split.map_or(Some(THRESHOLD), |Split(threshold)| threshold);
                Ok(Sampling::Area { samples, pixel_filter, threshold })
            }
            SamplingMethod::Thesis => {
                if split.is_some() {
                    return Err(UseError::OfOtherSampling("--split", "area"));
                }
                if let Some(nine) = supersample {
                    return Ok(Sampling::Supersample(nine));
                }
                let pattern = pattern.unwrap_or_default();
                let pattern = pattern.pattern(seed).ok_or(UseError::SeedOfNothing)?;
                match pixel_filter {
                    PixelFilter::Tent | PixelFilter::Gaussian if samples < 2 => {
                        let name = pixel_filter.to_possible_value();
                        let name = name.as_ref().map_or("", |value| value.get_name());
                        Err(UseError::WideFilterOfOne(name.into()))
                    }
                    PixelFilter::Box | PixelFilter::Tent | PixelFilter::Gaussian => {
                        Ok(Sampling::Grid { samples, pattern, pixel_filter })
                    }
                }
            }
        }
    }
}

/// The threshold of --split; `None` for no splitting.
#[derive(Debug, Clone, Copy)]
struct Split(Option<f64>);

/// Reads the value of --split.
fn split(text: &str) -> Result<Split, String> {
    if text == "none" {
        return Ok(Split(None));
    }
    let threshold = text.parse().ok().filter(|threshold| SPLITS.contains(threshold));
    threshold.map(|threshold| Split(Some(threshold))).ok_or_else(|| {
        format!("expected none or a number from {} to {}", SPLITS.start(), SPLITS.end())
    })
}
