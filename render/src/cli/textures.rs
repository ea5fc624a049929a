//! How textures are averaged.

use clap::{Args, ValueEnum};
use render::filter::Filter;

#[derive(Debug, Args)]
pub struct TextureArguments {
    /// How textures are averaged
    #[arg(long, default_value = "tent")]
    filter: FilterName,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FilterName {
    /// The texel at the point
    Point,
    /// Four texels interpolated at the point
    Bilinear,
    /// Eight texels of a pyramid of smaller pictures, interpolated (mip-mapping)
    Mip,
    /// The average under a box over the footprint (summed areas, n = 1)
    Box,
    /// The average under a tent over the footprint (repeated integration, n = 2)
    Tent,
    /// The average under a quadratic B-spline over the footprint (n = 3)
    Quadratic,
}

impl TextureArguments {
    pub fn filter(&self) -> Filter {
        match self.filter {
            FilterName::Point => Filter::Point,
            FilterName::Bilinear => Filter::Bilinear,
            FilterName::Mip => Filter::Mip,
            FilterName::Box => Filter::Box,
            FilterName::Tent => Filter::Tent,
            FilterName::Quadratic => Filter::Quadratic,
        }
    }
}
