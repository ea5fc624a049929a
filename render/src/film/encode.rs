//! Encodes a picture as the bytes of a PNG or EXR file.
//!
//! An EXR file with layers holds one part with a channel for each value. A channel's name starts
//! with the layer and a dot, such as `normal.X` or `depth.Z` ([`super::Layer`]); the colour is `R`,
//! `G` and `B`. All channels are 32-bit floats.

use super::Picture;
use super::bytes::Bytes;
use crate::color::Encoding;
use clap::ValueEnum;
use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Image, SmallVec, WritableImage as _};
use image::error::EncodingError;
use image::{ImageError, ImageFormat, Rgb, Rgb32FImage, RgbImage};
use std::io::Cursor;
use std::path::Path;

/// The format of a picture file. Its name on the command line is that of the variant, and is also
/// the extension of its files.
///
/// A new format provides, and the compiler leads to each `match`:
///
/// - its bytes ([`encode`]), or an error if the picture is too large for the format;
/// - the memory that encoding takes (`film/memory.rs`);
/// - whether it holds layers (`cli/output.rs` refuses `--layers` for PNG);
/// - tests: a decoder of another crate reads back the same pixels, also of a picture of 1 x 1 pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// PNG: 24 bits per pixel, encoded with sRGB or a gamma.
    #[value(help = None::<&'static str>)]
    Png,
    /// EXR: linear 32-bit floats.
    #[value(help = None::<&'static str>)]
    Exr,
}

impl Format {
    /// Returns the format of a file name's extension, in upper or lower case, or `None` if the
    /// extension is neither `png` nor `exr`.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        Self::from_str(path.extension()?.to_str()?, true).ok()
    }
}

/// Returns the bytes of the file. `encoding` turns linear values into the codes of a PNG. An EXR
/// stays linear.
///
/// # Errors
/// If the picture is too large for the format.
pub fn encode(
    picture: &Picture,
    format: Format,
    encoding: Encoding,
) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    let at = |x: u32, y: u32| picture.pixels[y as usize * picture.width as usize + x as usize];
    match format {
        Format::Png => {
            let bytes_of = Bytes::of(encoding);
            let color = |x, y| Rgb(at(x, y).map(|light| bytes_of.at(light)));
            RgbImage::from_fn(picture.width, picture.height, color)
                .write_to(&mut bytes, ImageFormat::Png)?;
        }
        Format::Exr if !picture.channels.is_empty() => write_layers(picture, &mut bytes)?,
        Format::Exr => {
            Rgb32FImage::from_fn(picture.width, picture.height, |x, y| Rgb(at(x, y)))
                .write_to(&mut bytes, ImageFormat::OpenExr)?;
        }
    }
    Ok(bytes.into_inner())
}

/// Writes an EXR file with the colour and all channels of the picture.
fn write_layers(picture: &Picture, bytes: &mut Cursor<Vec<u8>>) -> Result<(), ImageError> {
    let light = |k: usize| FlatSamples::F32(picture.pixels.iter().map(|pixel| pixel[k]).collect());
    let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = ["R", "G", "B"]
        .into_iter()
        .enumerate()
        .map(|(k, name)| AnyChannel::new(name, light(k)))
        .collect();
    for channel in &picture.channels {
        channels.push(AnyChannel::new(channel.name, FlatSamples::F32(channel.values.clone())));
    }
    let size = (picture.width as usize, picture.height as usize);
    Image::from_channels(size, AnyChannels::sort(channels)).write().to_buffered(bytes).map_err(
        |error| ImageError::Encoding(EncodingError::new(ImageFormat::OpenExr.into(), error)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::picture::Channel;

    #[test]
    fn exr_keeps_every_layer() {
        let names = ["uv.V", "depth.Z", "object.id"];
        let values = [vec![0.25, -1e-30], vec![f32::INFINITY, 3.5], vec![-1.0, 16_777_216.0]];
        let channels = names.into_iter().zip(values);
        let channels = channels.map(|(name, values)| Channel { name, values }).collect();
        let picture = Picture { channels, ..small() };
        let bytes = encode(&picture, Format::Exr, Encoding::Srgb).unwrap();
        let colors = image::load_from_memory(&bytes).unwrap().to_rgb32f();
        let pixels: Vec<[f32; 3]> = colors.pixels().map(|pixel| pixel.0).collect();
        assert_eq!(pixels, picture.pixels, "readers that know no layers see the colour");
        for (name, values) in fixtures::exr::channels(&bytes) {
            let Some(channel) = picture.channels.iter().find(|channel| channel.name == name) else {
                assert!(["R", "G", "B"].contains(&name.as_str()), "{name}");
                continue;
            };
            assert_eq!(values, channel.values, "{name}");
        }
    }

    fn small() -> Picture {
        let pixels = vec![[0.0, 0.5, 1.0], [-0.25, 7.5, 1e-6]];
        Picture { pixels, ..Picture::black(2, 1) }
    }

    #[test]
    fn exr_keeps_every_value() {
        let bytes = encode(&small(), Format::Exr, Encoding::Srgb).unwrap();
        let read = image::load_from_memory(&bytes).unwrap().to_rgb32f();
        let pixels: Vec<[f32; 3]> = read.pixels().map(|pixel| pixel.0).collect();
        assert_eq!(pixels, small().pixels);
    }

    #[test]
    fn png_is_encoded_and_clamped() {
        let bytes = encode(&small(), Format::Png, Encoding::Srgb).unwrap();
        let read = image::load_from_memory(&bytes).unwrap().to_rgb8();
        assert_eq!(read.as_raw(), &[0, 188, 255, 0, 255, 0]);
    }
}
