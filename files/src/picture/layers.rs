//! The channels of an EXR file by their names, such as `normal.X`.

use super::{PictureError, damaged, exr as header, guard};
use crate::memory::{Budget, Reserved};
use exr::prelude::{ReadChannels, ReadLayers};
use std::io::Cursor;

/// The channels of an EXR file.
#[derive(Debug, Clone, PartialEq)]
pub struct Channels {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Names and values, row by row from the top, in the order of the file.
    pub list: Vec<(String, Vec<f32>)>,
}

/// Decodes all channels of the first layer of an EXR file, and returns the memory reserved for them too. `name` names
/// the file in a refusal of memory.
///
/// # Errors
/// When the bytes are no EXR file, or there is no memory for it. A decoder's panic becomes an error.
pub fn channels<'b>(
    bytes: &[u8],
    budget: &'b Budget,
    name: impl Fn() -> String,
) -> Result<(Channels, Reserved<'b>), PictureError> {
    guard::guarded(|| read(bytes, budget, &name)).unwrap_or_else(|| Err(damaged()))
}

fn read<'b>(
    bytes: &[u8],
    budget: &'b Budget,
    name: &impl Fn() -> String,
) -> Result<(Channels, Reserved<'b>), PictureError> {
    let data = header::unpacked(bytes).map_err(PictureError::Broken)?;
    let pixels = data.width.saturating_mul(data.height);
    let values = pixels.saturating_mul(4 * data.channels as u64);
    let reserved = budget.reserve(data.bytes.saturating_add(values), || {
        format!("{}: {} channels of {}x{} pixels", name(), data.channels, data.width, data.height)
    })?;
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| PictureError::Broken(error.to_string()))?;
    let size = image.layer_data.size;
    let list = image.layer_data.channel_data.list.iter();
    let list = list.map(|one| (one.name.to_string(), one.sample_data.values_as_f32().collect()));
    let [width, height] =
        [size.width(), size.height()].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    Ok((Channels { width, height, list: list.collect() }, reserved))
}
