//! Tables and pyramids without their textures, for another scene with the same texels.

use super::{Filter, FilteredTexture, Prepared};
use crate::texture::Texture;

/// The data that a filter built for a texture.
#[derive(Debug)]
pub struct Table {
    filter: Filter,
    prepared: Prepared,
    deviation: f64,
    low: Option<Box<Table>>,
    mask: Option<Box<Table>>,
}

impl<'a> FilteredTexture<'a> {
    /// Returns the data that was built.
    #[must_use]
    pub fn into_table(self) -> Table {
        let part = |part: Option<Box<Self>>| part.map(|part| Box::new(part.into_table()));
        Table {
            filter: self.filter,
            prepared: self.prepared,
            deviation: self.deviation,
            low: part(self.low),
            mask: part(self.mask),
        }
    }

    /// Returns a texture with data that was built for a texture with the same texels.
    #[must_use]
    pub fn with_table(texture: &'a Texture, table: Table) -> Self {
        let with = |part: Option<&'a Texture>, table: Option<Box<Table>>| {
            part.zip(table).map(|(part, table)| Box::new(Self::with_table(part, *table)))
        };
        Self {
            texture,
            filter: table.filter,
            prepared: table.prepared,
            deviation: table.deviation,
            low: with(texture.floats.as_ref().map(|floats| &floats.low), table.low),
            mask: with(texture.mask.as_deref(), table.mask),
        }
    }
}
