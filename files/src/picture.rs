//! Decodes the bytes of a picture file. All programs decode pictures with this one function.
//!
//! A file of a stranger must neither stop a program nor exhaust its memory:
//!
//! - The size is read first, and memory is reserved for the decoder, the picture and the caller's
//!   copies of it. For an EXR file the data window with all channels counts, which the decoder
//!   unpacks. Its display window, which the decoder returns, does not count.
//! - The data of a PNG beside its pixels (colour profiles, texts) may take `MOST_BESIDE` bytes
//!   after unpacking. The decoder skips a larger profile; our programs do not read profiles.
//! - A JPEG that is cut off is refused, as other formats are: its decoder would fill the rest with grey.
//! - A panic of a decoder becomes [`PictureError::Broken`]. Release 0.18.1 of the crate `png`
//!   panics on palettes whose length is not a multiple of three. The fix exists upstream but is not
//!   published; a test fails once the panic is gone. The guard stays useful after that: other
//!   decoders are not proven free of panics.

mod exr;
mod guard;
mod jpeg;
pub mod layers;
mod unused;

pub use unused::unused;

use crate::memory::{Budget, MemoryError, Reserved};
use image::{ColorType, DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use thiserror::Error;

pub use image::ImageFormat as Format;

/// The formats of pictures that cover surfaces. HDR and EXR hold floating point values.
pub const SURFACES: [Format; 9] = [
    Format::Png,
    Format::Jpeg,
    Format::Tga,
    Format::Bmp,
    Format::Tiff,
    Format::WebP,
    Format::Gif,
    Format::Hdr,
    Format::OpenExr,
];

/// Number of bytes that profiles and texts of a PNG may take after unpacking, beyond their bytes in
/// the file.
const MOST_BESIDE: u64 = 16 << 20;

/// Number of bytes that the decoder of a PNG takes for each pixel of a row: two rows of four 16-bit
/// samples.
const ROW: u64 = 16;

/// Number of bytes for each pixel that decoders take besides the picture: the coefficients of a
/// progressive JPEG of four components, as 16-bit numbers.
const DECODER: u64 = 8;

/// A reason why a file gives no picture.
#[derive(Debug, Error)]
pub enum PictureError {
    /// The file is of another format, or of none. The text describes the file's first bytes.
    #[error("{0}")]
    Format(String),
    /// The file is damaged, or of a kind that is not read. The text is the decoder's.
    #[error("{0}")]
    Broken(String),
    /// The picture takes more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}

/// Decodes a picture from the bytes of a file in one of `formats`, and returns the memory reserved
/// for the picture too. `each` gives the bytes that the caller takes for each pixel of a picture of
/// this kind, the picture itself included. `name` names the file in a refusal of memory.
///
/// # Errors
/// When there is no picture of these formats, or no memory for it. A decoder's panic becomes an
/// error.
pub fn decode<'b>(
    bytes: &[u8],
    formats: &[ImageFormat],
    each: impl Fn(ColorType) -> u64,
    budget: &'b Budget,
    name: impl Fn() -> String,
) -> Result<(DynamicImage, Reserved<'b>), PictureError> {
    let format = format_of(bytes, formats, &name)?;
    let work = || decode_unguarded(bytes, format, &each, budget, &name);
    guard::guarded(work).unwrap_or_else(|| Err(damaged()))
}

/// Returns the format of a file by its first bytes, if that is one of `formats`. A TGA file has no
/// signature; the name tells.
fn format_of(
    bytes: &[u8],
    formats: &[ImageFormat],
    name: &impl Fn() -> String,
) -> Result<ImageFormat, PictureError> {
    let is_tga = || name().to_ascii_lowercase().ends_with(".tga");
    let found = match image::guess_format(bytes) {
        Ok(format) if formats.contains(&format) => return Ok(format),
        Ok(format) => format!("a file of type {}", format.to_mime_type()),
        Err(_) if bytes.is_empty() => "an empty file".into(),
        Err(_) if formats.contains(&ImageFormat::Tga) && is_tga() => return Ok(ImageFormat::Tga),
        Err(_) => "its first bytes are of no known format".into(),
    };
    Err(PictureError::Format(found))
}

fn decode_unguarded<'b>(
    bytes: &[u8],
    format: ImageFormat,
    each: &impl Fn(ColorType) -> u64,
    budget: &'b Budget,
    name: &impl Fn() -> String,
) -> Result<(DynamicImage, Reserved<'b>), PictureError> {
    let size_of =
        |width: u64, height: u64| format!("{}: a picture of {width}x{height} pixels", name());
    let mut unpacking = budget.reserve(0, String::new)?;
    if format == ImageFormat::OpenExr {
        let data = exr::unpacked(bytes).map_err(PictureError::Broken)?;
        unpacking.grow(data.bytes, || {
            format!("{} with {} channels", size_of(data.width, data.height), data.channels)
        })?;
    }
    if format == ImageFormat::Jpeg && !jpeg::is_whole(bytes) {
        return Err(PictureError::Broken("the file ends before its picture does".into()));
    }
    if format == ImageFormat::Png {
        let row = || format!("{}: a row of {} pixels", name(), png_width(bytes));
        unpacking.grow(png_width(bytes).saturating_mul(ROW), row)?;
    }
    let decoder = opened(bytes, format, budget.left())?;
    let ((width, height), kind) = (decoder.dimensions(), decoder.color_type());
    let pixels = u64::from(width) * u64::from(height);
    let working = if format == ImageFormat::Jpeg { DECODER } else { 0 };
    let wanted = pixels.saturating_mul(each(kind).saturating_add(working));
    let mut reserved = budget.reserve(wanted, || size_of(width.into(), height.into()))?;
    let picture = DynamicImage::from_decoder(decoder).map_err(broken)?;
    reserved.shrink(pixels.saturating_mul(each(kind)));
    Ok((picture, reserved))
}

/// Returns the decoder of a file, which has read everything before the pixels.
fn opened(
    bytes: &[u8],
    format: ImageFormat,
    left: u64,
) -> Result<impl ImageDecoder + use<'_>, PictureError> {
    let mut limits = Limits::no_limits();
    // The budget does not count these few bytes, so they are at most what a small budget has left.
    let row = png_width(bytes).saturating_mul(ROW);
    limits.max_alloc = Some(match format {
        // These decoders count their pictures too.
        ImageFormat::Tiff | ImageFormat::WebP | ImageFormat::Gif => left,
        _ => (MOST_BESIDE + bytes.len() as u64).min(left).saturating_add(row),
    });
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    reader.into_decoder().map_err(broken)
}

/// Returns the pixels of the picture in a file across and down, by its header.
///
/// # Errors
/// When there is no header of these formats. A decoder's panic becomes an error.
pub fn size(bytes: &[u8], formats: &[ImageFormat]) -> Result<(u32, u32), PictureError> {
    let format = format_of(bytes, formats, &String::new)?;
    let work = || Ok(opened(bytes, format, MOST_BESIDE)?.dimensions());
    guard::guarded(work).unwrap_or_else(|| Err(damaged()))
}

/// Returns the error for a decoder that panicked.
fn damaged() -> PictureError {
    PictureError::Broken("the decoder failed; the file is damaged".into())
}

/// Returns the width that the header of a PNG claims, in pixels, or 0 without a header.
fn png_width(bytes: &[u8]) -> u64 {
    bytes
        .get(16..20)
        .and_then(|width| width.try_into().ok())
        .map_or(0, |width| u32::from_be_bytes(width).into())
}

/// Turns a decoder's complaint into an error. The only limit that a decoder can exceed here is that
/// of the data beside the pixels.
fn broken(error: ImageError) -> PictureError {
    PictureError::Broken(match error {
        ImageError::Limits(_) => {
            format!("more than {} of data beside the pixels", crate::memory::Bytes(MOST_BESIDE))
        }
        other => without_types(other.to_string()),
    })
}

/// Returns a message of the PNG decoder with the name of a chunk in place of its Rust value.
fn without_types(mut message: String) -> String {
    const START: &str = "ChunkType { type: ";
    while let Some(start) = message.find(START) {
        let Some(length) = message[start..].find('}') else { break };
        let value = &message[start + START.len()..start + length];
        let name = value.split(',').next().unwrap_or_default().trim().to_string();
        message.replace_range(start..=start + length, &name);
    }
    message
}

#[cfg(test)]
mod tests;
