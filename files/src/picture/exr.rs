//! Computes the memory into which the decoder unpacks an EXR file, from the file's header.

use exr::meta::MetaData;

/// The layer of a file that takes the most memory.
pub(super) struct Unpacked {
    /// Pixels of the data window across.
    pub width: u64,
    /// Pixels of the data window down.
    pub height: u64,
    /// Number of channels, including those that are not read.
    pub channels: usize,
    /// Number of bytes of all pixels.
    pub bytes: u64,
}

/// Most bytes that compression makes of one byte. A deflated stream of zeros gives 1032; the
/// Huffman code of PIZ gives some hundreds, the other methods fewer.
const MOST_EXPANDED: u64 = 2000;

/// Returns the largest layer of the file. An error is the decoder's sentence.
///
/// Blocks are unpacked one after another, and one block may be the whole layer. Compressed samples
/// of B44 and PXR24 pass through a second buffer of the same size.
pub(super) fn unpacked(file: &[u8]) -> Result<Unpacked, String> {
    let meta = MetaData::read_from_buffered(file, false).map_err(|error| error.to_string())?;
    let layers = meta.headers.iter().map(|header| {
        let (width, height) = (header.layer_size.width() as u64, header.layer_size.height() as u64);
        let pixel = header.channels.bytes_per_pixel as u64;
        let bytes = width.saturating_mul(height).saturating_mul(pixel).saturating_mul(2);
        Unpacked { width, height, channels: header.channels.list.len(), bytes }
    });
    let largest = layers.max_by_key(|layer| layer.bytes).ok_or("no layers")?;
    if largest.bytes / 2 > MOST_EXPANDED.saturating_mul(file.len() as u64) {
        let Unpacked { width, height, channels, .. } = largest;
        let claim = format!("a data window of {width}x{height} pixels with {channels} channels");
        return Err(format!("{claim}, more than a file of {} bytes can hold", file.len()));
    }
    Ok(largest)
}
