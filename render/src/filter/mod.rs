//! Averages a texture over a footprint.
//!
//! | filter      | its result for a rectangle                                                   |
//! |-------------|------------------------------------------------------------------------------|
//! | `point`     | the texel at its middle                                                      |
//! | `bilinear`  | four texels interpolated at its middle                                       |
//! | `mip`       | eight texels of a pyramid, interpolated (mip-mapping)                        |
//! | `box`       | the average under a box that fills it (summed areas; order 1)                |
//! | `tent`      | the average under a tent that fills it (repeated integration, order 2)       |
//! | `quadratic` | the average under a quadratic B-spline that fills it (the same, order 3)     |
//! | `exact`     | the average over it                                                          |
//! | `ewa8`      | the average under an elliptical Gaussian, at most 8 times as long as broad   |
//! | `ewa16`     | the same, at most 16 times                                                   |
//! | `ewa64`     | the same, at most 64 times                                                   |
//! | `probes`    | up to 16 averages of `mip` along its longer axis                             |
//!
//! The last five see a slanted footprint as it is, and the others see the box around it. All but
//! `point` and `bilinear` use pyramids or tables, which are built only for textures that a scene shows.

mod axis;
mod detached;
mod direct;
mod entry;
mod ewa;
mod exact;
mod kernel;
mod outline;
mod probes;
mod pyramid;
mod reduce;
mod table;
mod weigh;
mod word;

pub use detached::Detached;
pub use ewa::Ewa;
pub use exact::Exact;
pub use pyramid::Pyramid;
pub use table::PrefilteredTable;

use crate::color::Color;
use crate::footprint::Footprint;
use crate::texture::Texture;
use clap::ValueEnum;
use glam::{DVec2, DVec3};
use outline::Outline;
use schemars::JsonSchema;
use serde::Deserialize;
use std::fmt;

/// A method of averaging a texture. Its name on the command line, in JSON and in reports is that of
/// the variant; the attribute `help` is the text of `--help`.
///
/// A new filter provides, and the compiler leads to each `match`:
///
/// - a variant here and in [`Filter::ALL`], with its row in the table above;
/// - [`Filter::wants_area`], [`Filter::order`] and [`Filter::bytes_for`], which counts exactly the
///   bytes that [`FilteredTexture::new`] allocates;
/// - the data and the average, in a file of this folder;
/// - tests: a constant texture stays constant; the average equals a direct sum over the texels; it
///   does not depend on whole periods of a texture that repeats (tests below and in `table`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, ValueEnum, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(description = "A method of averaging a texture over the area that a ray sees.")]
pub enum Filter {
    /// The texel at the middle of the footprint.
    #[value(help = "The texel at the point")]
    Point,
    /// Linear interpolation between the four texels around the middle of the footprint.
    #[value(help = "Four texels interpolated at the point")]
    Bilinear,
    /// Linear interpolation between texels and levels of a pyramid, over a square about as wide as
    /// the footprint.
    #[value(help = "Eight texels of a pyramid of smaller pictures, interpolated (mip-mapping)")]
    Mip,
    /// A box over the footprint (summed areas, n = 1).
    #[value(help = "The average under a box over the footprint (summed areas, n = 1)")]
    Box,
    /// A tent over the footprint (n = 2).
    #[value(help = "The average under a tent over the footprint (repeated integration, n = 2)")]
    Tent,
    /// A quadratic B-spline over the footprint (n = 3).
    #[value(help = "The average under a quadratic B-spline over the footprint (n = 3)")]
    Quadratic,
    /// The exact average over the footprint, of any shape and orientation.
    #[value(help = "The exact average over the footprint, of any shape and orientation")]
    Exact,
    /// An elliptical Gaussian over the footprint (EWA), of an aspect up to 8.
    #[value(
        help = "The average under an elliptical Gaussian (EWA), at most 8 times as long as broad"
    )]
    Ewa8,
    /// An elliptical Gaussian over the footprint, of an aspect up to 16.
    #[value(help = "The same, at most 16 times as long as broad")]
    Ewa16,
    /// An elliptical Gaussian over the footprint, of an aspect up to 64.
    #[value(help = "The same, at most 64 times as long as broad")]
    Ewa64,
    /// Averages of a pyramid along the longer axis of the footprint.
    #[value(help = "Up to 16 averages of a pyramid along the longer axis of the footprint")]
    Probes,
}

impl Filter {
    /// All filters from the simplest on, in the order of their discriminants.
    pub const ALL: [Self; 11] = [
        Self::Point,
        Self::Bilinear,
        Self::Mip,
        Self::Box,
        Self::Tent,
        Self::Quadratic,
        Self::Exact,
        Self::Ewa8,
        Self::Ewa16,
        Self::Ewa64,
        Self::Probes,
    ];

    /// The filters whose footprint is the box around the neighbours of a ray, as in the thesis, and the
    /// two without footprint. The others see slanted shapes.
    pub const THESIS: [Self; 6] =
        [Self::Point, Self::Bilinear, Self::Mip, Self::Box, Self::Tent, Self::Quadratic];

    /// Returns whether this filter averages over areas. If so, the neighbours of each sample must
    /// be traced.
    #[must_use]
    pub fn wants_area(self) -> bool {
        match self {
            Self::Point | Self::Bilinear => false,
            Self::Mip | Self::Box | Self::Tent | Self::Quadratic => true,
            Self::Exact | Self::Ewa8 | Self::Ewa16 | Self::Ewa64 | Self::Probes => true,
        }
    }

    /// Returns the number of integrations of the filter's table, 1 to 3, or `None` without a table.
    #[must_use]
    pub fn order(self) -> Option<usize> {
        match self {
            Self::Point | Self::Bilinear | Self::Mip | Self::Exact => None,
            Self::Ewa8 | Self::Ewa16 | Self::Ewa64 | Self::Probes => None,
            Self::Box => Some(1),
            Self::Tent => Some(2),
            Self::Quadratic => Some(3),
        }
    }

    /// Returns the largest aspect of an elliptical Gaussian, or `None` for another filter.
    #[must_use]
    pub fn ewa_aspect(self) -> Option<u32> {
        match self {
            Self::Ewa8 => Some(8),
            Self::Ewa16 => Some(16),
            Self::Ewa64 => Some(64),
            _ => None,
        }
    }

    /// Returns the memory of the filter's table or pyramid for a texture, in bytes. The texture
    /// itself is not included.
    #[must_use]
    pub fn bytes_for(self, texture: &Texture) -> u64 {
        let low = texture.floats.as_ref().map(|floats| &floats.low);
        let parts = low.into_iter().chain(texture.mask.as_deref());
        let parts = parts.map(|part| self.bytes_for(part)).sum::<u64>();
        parts
            + match self {
                Self::Point | Self::Bilinear => 0,
                Self::Mip | Self::Ewa8 | Self::Ewa16 | Self::Ewa64 | Self::Probes => {
                    Pyramid::bytes_for(texture)
                }
                Self::Box => PrefilteredTable::bytes_for(texture, 1),
                Self::Tent => PrefilteredTable::bytes_for(texture, 2),
                Self::Quadratic => PrefilteredTable::bytes_for(texture, 3),
                Self::Exact => Exact::bytes_for(texture),
            }
    }
}

impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.to_possible_value();
        f.write_str(value.as_ref().map_or("", |value| value.get_name()))
    }
}

/// A texture ready to be averaged by one filter.
#[derive(Debug)]
pub struct FilteredTexture<'a> {
    texture: &'a Texture,
    filter: Filter,
    prepared: Prepared,
    /// Largest standard deviation of any channel of the texture, in light.
    deviation: f64,
    /// The lower digits of floating point values.
    low: Option<Box<FilteredTexture<'a>>>,
    /// The mask of a cut-out.
    mask: Option<Box<FilteredTexture<'a>>>,
}

/// Data built before the first average.
#[derive(Debug)]
enum Prepared {
    /// None: one texel of the texture.
    Texel,
    /// None: four texels of the texture, interpolated.
    FourTexels,
    Pyramid(Pyramid),
    Table(PrefilteredTable),
    Exact(Exact),
    Ewa(Ewa),
    Probes(Pyramid),
}

impl<'a> FilteredTexture<'a> {
    /// Builds the table or pyramid that `filter` needs.
    #[must_use]
    pub fn new(texture: &'a Texture, filter: Filter) -> Self {
        let prepared = match filter {
            Filter::Point => Prepared::Texel,
            Filter::Bilinear => Prepared::FourTexels,
            Filter::Mip => Prepared::Pyramid(Pyramid::build(texture)),
            Filter::Box => Prepared::Table(PrefilteredTable::build(texture, 1)),
            Filter::Tent => Prepared::Table(PrefilteredTable::build(texture, 2)),
            Filter::Quadratic => Prepared::Table(PrefilteredTable::build(texture, 3)),
            Filter::Exact => Prepared::Exact(Exact::build(texture)),
            Filter::Ewa8 => Prepared::Ewa(Ewa::build(texture, 8.0)),
            Filter::Ewa16 => Prepared::Ewa(Ewa::build(texture, 16.0)),
            Filter::Ewa64 => Prepared::Ewa(Ewa::build(texture, 64.0)),
            Filter::Probes => Prepared::Probes(Pyramid::build(texture)),
        };
        let part = |part: &'a Texture| Box::new(Self::new(part, filter));
        let low = texture.floats.as_ref().map(|floats| part(&floats.low));
        let mask = texture.mask.as_deref().map(part);
        let deviation = light(texture) * deviation(texture);
        Self { texture, filter, prepared, deviation, low, mask }
    }

    /// Returns the average of the texture over the footprint, linear RGB. A texture with a mask is
    /// multiplied by it.
    #[must_use]
    pub fn average(&self, footprint: &Footprint) -> Color {
        let codes = self.average_of_codes(footprint);
        self.with_low(codes, footprint)
    }

    /// Returns the average of the mask over the footprint, in `[0, 1]`: the part that the surface covers.
    #[must_use]
    pub fn coverage(&self, footprint: &Footprint) -> f64 {
        let mask = self.mask.as_ref();
        mask.map_or(1.0, |mask| mask.average_of_codes(footprint).x.clamp(0.0, 1.0))
    }

    /// Adds the lower digits of floating point values to an average of codes.
    fn with_low(&self, codes: Color, footprint: &Footprint) -> Color {
        match &self.low {
            None => codes,
            Some(low) => {
                let low = low.average_of_codes(footprint) / f64::from(u16::MAX);
                light(self.texture) * (codes + low)
            }
        }
    }

    /// Returns the average of the codes, with the largest as 1.
    fn average_of_codes(&self, footprint: &Footprint) -> Color {
        let (center, half) = footprint.bounds();
        match &self.prepared {
            Prepared::Table(table) => table.average(self.texture, center, half),
            Prepared::Pyramid(pyramid) => pyramid.average(self.texture, center, half),
            Prepared::Exact(exact) => exact.average(self.texture, footprint),
            Prepared::Ewa(ewa) => match Outline::of(footprint, self.texture) {
                Some(outline) => ewa.average(self.texture, &outline),
                None => self.texture.point(center),
            },
            Prepared::Probes(pyramid) => match Outline::of(footprint, self.texture) {
                Some(outline) => probes::average(pyramid, self.texture, &outline),
                None => self.texture.point(center),
            },
            Prepared::Texel => self.texture.point(center),
            Prepared::FourTexels => self.texture.bilinear(center),
        }
    }

    /// Returns the average over the footprint, and an estimate of how much it could change if the
    /// footprint moved, both in linear light. The estimate is the largest of any channel.
    ///
    /// For the filter `exact` the estimate looks at the texels near the footprint. It costs little
    /// beside the average. For other filters it is the standard deviation of the texture.
    #[must_use]
    pub fn average_and_contrast(&self, footprint: &Footprint) -> (Color, f64) {
        match &self.prepared {
            Prepared::Exact(exact) => {
                let (codes, contrast) = exact.average_and_contrast(self.texture, footprint);
                (self.with_low(codes, footprint), light(self.texture) * contrast)
            }
            _ => (self.average(footprint), self.deviation),
        }
    }

    /// Moves a footprint up or down, so that its filter does not reach past the first or the last
    /// row of texels.
    ///
    /// On a sphere these rows are the poles. The texture repeats, but one pole is not next to the
    /// other. Footprints end at the poles. The function therefore moves only a footprint below a
    /// table's smallest width, by less than a texel, the square of a pyramid, and an ellipse, which is
    /// larger than its footprint.
    #[must_use]
    pub fn between_poles(&self, footprint: Footprint) -> Footprint {
        let (center, half) = footprint.bounds();
        // Interpolation reaches half a texel of the coarser of two levels: at most the side of the
        // square.
        let smallest = match self.filter {
            Filter::Mip => pyramid::side(self.texture, half).max(0.5),
            Filter::Point | Filter::Bilinear => 0.5,
            Filter::Exact | Filter::Ewa8 | Filter::Ewa16 | Filter::Ewa64 | Filter::Probes => {
                self.outline_reach(&footprint)
            }
            Filter::Box | Filter::Tent | Filter::Quadratic => {
                0.5 * self.filter.order().unwrap_or(1) as f64
            }
        };
        let reach = half.y.max(smallest / self.texture.height as f64).min(0.5);
        footprint.centered_at(DVec2::new(center.x, center.y.clamp(reach, 1.0 - reach)))
    }

    /// Returns the largest distance down from the middle of a footprint, in texels, to a texel that a
    /// filter of slanted shapes reads.
    fn outline_reach(&self, footprint: &Footprint) -> f64 {
        let reach = |outline: Outline| match &self.prepared {
            Prepared::Ewa(ewa) => ewa.reach(&outline).y,
            Prepared::Probes(_) => probes::reach(&outline).y,
            _ => exact::reach(&outline).y,
        };
        Outline::of(footprint, self.texture).map_or(0.5, reach)
    }

    /// Returns the nominal number of texels or table entries that one average reads. Footprints of
    /// few texels, which are averaged directly, and folded ones, which are larger than the texture,
    /// read other numbers.
    #[must_use]
    pub fn reads(&self) -> u64 {
        match self.filter {
            Filter::Point => 1,
            Filter::Bilinear => 4,
            Filter::Mip => 8,
            Filter::Box => 16,
            Filter::Tent => 81,
            Filter::Quadratic => 256,
            // Eight lines with two edges each, and two sums and four texels at an edge.
            Filter::Exact => 96,
            // The texels in the longest ellipse, whose breadth is four texels on average, and a quarter
            // as many on the coarser level.
            Filter::Ewa8 | Filter::Ewa16 | Filter::Ewa64 => {
                8 * u64::from(self.filter.ewa_aspect().unwrap_or(1))
            }
            Filter::Probes => 16 * 8,
        }
    }

    /// Memory of the table or pyramid, in bytes; 0 without one.
    #[must_use]
    pub fn table_bytes(&self) -> usize {
        let parts = self.low.iter().chain(&self.mask);
        let parts = parts.map(|part| part.table_bytes()).sum::<usize>();
        parts
            + match &self.prepared {
                Prepared::Texel | Prepared::FourTexels => 0,
                Prepared::Pyramid(pyramid) | Prepared::Probes(pyramid) => pyramid.bytes(),
                Prepared::Ewa(ewa) => ewa.bytes(),
                Prepared::Table(table) => table.bytes(),
                Prepared::Exact(exact) => exact.bytes(),
            }
    }
}

/// Returns the light of the largest code.
fn light(texture: &Texture) -> f64 {
    texture.floats.as_ref().map_or(1.0, |floats| floats.light)
}

/// Returns the largest standard deviation of any channel, with the largest code as 1.
fn deviation(texture: &Texture) -> f64 {
    let (mut sum, mut squares) = (DVec3::ZERO, DVec3::ZERO);
    for texel in &texture.texels {
        let codes = DVec3::from(texel.map(f64::from));
        sum += codes;
        squares += codes * codes;
    }
    let count = texture.texels.len() as f64;
    let variance = squares / count - sum * sum / (count * count);
    variance.max_element().max(0.0).sqrt() * texture.unit()
}

#[cfg(test)]
mod tests;
