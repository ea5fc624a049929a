//! Averages a texture over a footprint.
//!
//! | filter     | what it gives for a rectangle                                              |
//! |------------|----------------------------------------------------------------------------|
//! | `point`    | the texel at its middle                                                    |
//! | `bilinear` | four texels interpolated at its middle                                     |
//! | `box`      | the average under a box that fills it (summed areas, order 1)              |
//! | `tent`     | the average under a tent that fills it (repeated integration, order 2)     |
//!
//! The last two work from tables, which are built only for textures that a scene shows.

mod axis;
mod direct;
mod table;
mod word;

pub use table::PrefilteredTable;

use crate::color::Color;
use crate::footprint::Footprint;
use crate::texture::Texture;
use glam::DVec2;
use serde::Deserialize;

/// How a texture is averaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Filter {
    /// The texel at the point.
    Point,
    /// Linear interpolation between texels.
    Bilinear,
    /// A box over the footprint.
    Box,
    /// A tent over the footprint.
    Tent,
}

impl Filter {
    /// Whether this filter wants more than a point: then neighbours must be traced.
    #[must_use]
    pub fn wants_area(self) -> bool {
        matches!(self, Self::Box | Self::Tent)
    }
}

/// A texture ready to be averaged by one filter.
#[derive(Debug)]
pub struct FilteredTexture<'a> {
    texture: &'a Texture,
    filter: Filter,
    table: Option<PrefilteredTable>,
}

impl<'a> FilteredTexture<'a> {
    /// Builds what the filter needs.
    #[must_use]
    pub fn new(texture: &'a Texture, filter: Filter) -> Self {
        let order = match filter {
            Filter::Point | Filter::Bilinear => None,
            Filter::Box => Some(1),
            Filter::Tent => Some(2),
        };
        Self { texture, filter, table: order.map(|n| PrefilteredTable::build(texture, n)) }
    }

    /// The average of the texture over the footprint.
    #[must_use]
    pub fn average(&self, footprint: &Footprint) -> Color {
        let (center, half) = match *footprint {
            Footprint::Point(at) => (at, DVec2::ZERO),
            Footprint::Rectangle { center, half } => (center, half),
        };
        match (&self.table, self.filter) {
            (Some(table), _) => table.average(self.texture, center, half),
            (None, Filter::Point) => self.texture.point(center),
            (None, _) => self.texture.bilinear(center),
        }
    }

    /// The footprint, moved upward or downward as far as its filter reaches past the first or the
    /// last row of texels.
    ///
    /// On a sphere those rows are poles, and beyond a pole is not the other one, though the texture
    /// repeats. Footprints end at the poles, so only the filter's smallest width moves any: by less
    /// than a texel.
    #[must_use]
    pub fn between_poles(&self, footprint: Footprint) -> Footprint {
        let smallest = match self.filter {
            Filter::Point | Filter::Bilinear | Filter::Box => 0.5,
            Filter::Tent => 1.0,
        };
        let within = |v: f64, half: f64| {
            let reach = half.max(smallest / self.texture.height as f64).min(0.5);
            v.clamp(reach, 1.0 - reach)
        };
        match footprint {
            Footprint::Point(at) => Footprint::Point(DVec2::new(at.x, within(at.y, 0.0))),
            Footprint::Rectangle { center, half } => {
                let center = DVec2::new(center.x, within(center.y, half.y));
                Footprint::Rectangle { center, half }
            }
        }
    }

    /// Texels or table entries that one average reads. Footprints of few texels, which are averaged
    /// directly, and those larger than the texture, which are folded, read other numbers.
    #[must_use]
    pub fn reads(&self) -> u64 {
        match self.filter {
            Filter::Point => 1,
            Filter::Bilinear => 4,
            Filter::Box => 16,
            Filter::Tent => 81,
        }
    }

    /// Memory of the table, in bytes; 0 when there is none.
    #[must_use]
    pub fn table_bytes(&self) -> usize {
        self.table.as_ref().map_or(0, PrefilteredTable::bytes)
    }
}
