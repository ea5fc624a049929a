//! The data of a filtered texture apart from the texture, for an equal texture of another scene.

use super::{Filter, FilteredTexture, Prepared};
use crate::texture::Texture;

/// The table or pyramid of a texture for one filter.
#[derive(Debug)]
pub struct Detached {
    filter: Filter,
    prepared: Prepared,
    deviation: f64,
    low: Option<Box<Detached>>,
    mask: Option<Box<Detached>>,
}

impl FilteredTexture<'_> {
    /// Returns the data without the texture.
    #[must_use]
    pub fn detach(self) -> Detached {
        let part =
            |part: Option<Box<FilteredTexture<'_>>>| part.map(|part| Box::new(part.detach()));
        let Self { filter, prepared, deviation, low, mask, .. } = self;
        Detached { filter, prepared, deviation, low: part(low), mask: part(mask) }
    }
}

impl Detached {
    /// Returns the data with a texture, which must equal the one that the data were built for.
    #[must_use]
    pub fn attach(self, texture: &Texture) -> FilteredTexture<'_> {
        let Self { filter, prepared, deviation, low, mask } = self;
        let low = texture.floats.as_ref().zip(low);
        let mask = texture.mask.as_deref().zip(mask);
        FilteredTexture {
            texture,
            filter,
            prepared,
            deviation,
            low: low.map(|(floats, low)| Box::new(low.attach(&floats.low))),
            mask: mask.map(|(texture, mask)| Box::new(mask.attach(texture))),
        }
    }
}
