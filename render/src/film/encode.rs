//! Encodes a picture as the bytes of a PNG or EXR file.
//!
//! The channel `A` of a picture is its coverage (`alpha.rs`). A PNG then has straight colours, and an EXR
//! has colours that are multiplied by the coverage, as these formats prescribe.
//!
//! An EXR file holds one part with a channel for each value. A channel's name starts with the layer and a
//! dot, such as `normal.X` or `depth.Z` ([`super::Layer`]); the colour is `R`, `G` and `B`. All channels
//! are 32-bit floats. The data window of a crop lies at its place in the display window, which is the
//! whole picture.

use super::bytes::Bytes;
use super::{Crop, Picture, alpha};
use crate::color::Encoding;
use clap::ValueEnum;
use exr::prelude::{
    AnyChannel, AnyChannels, FlatSamples, Image, IntegerBounds, SmallVec, Text, Vec2,
    WritableImage as _,
};
use image::error::EncodingError;
use image::{ImageError, ImageFormat};
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
    /// PNG: 8 or 16 bits for each channel, encoded with sRGB or a gamma.
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

    /// Returns the format of a file by its first bytes.
    #[must_use]
    pub fn of_contents(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"\x89PNG") {
            Some(Self::Png)
        } else {
            bytes.starts_with(b"v/1\x01").then_some(Self::Exr)
        }
    }
}

/// The number of bits of each channel of a PNG.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum Bits {
    /// 8 bits.
    #[default]
    #[value(name = "8", help = None::<&'static str>)]
    Eight,
    /// 16 bits.
    #[value(name = "16", help = None::<&'static str>)]
    Sixteen,
}

/// The encoding, the texts and the place of a picture in its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Coding {
    /// Function from linear values to the codes of a PNG. An EXR stays linear.
    pub encoding: Encoding,
    /// Bits of each channel of a PNG.
    pub bits: Bits,
    /// The part of the whole picture that the picture shows, and the size of the whole in pixels; `None`
    /// if it shows all.
    pub part: Option<(Crop, [u32; 2])>,
    /// The command that makes the picture ([`super::command`]), if it is known.
    pub command: Option<String>,
    /// The digest of all inputs of the picture, if it is known. Only a PNG states it.
    pub inputs: Option<String>,
}

/// Keyword of the text of a PNG that holds [`Coding::inputs`].
pub const INPUTS: &str = "Inputs";

impl Coding {
    /// The coding of a whole picture with 8 bits in each channel of a PNG.
    #[must_use]
    pub fn new(encoding: Encoding) -> Self {
        Self { encoding, bits: Bits::Eight, part: None, command: None, inputs: None }
    }
}

/// The program that writes files, with its version.
pub(crate) const SOFTWARE: &str = concat!("topobook render ", env!("CARGO_PKG_VERSION"));

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
    encode_as(picture, format, &Coding::new(encoding))
}

/// Returns the bytes of the file, with what `coding` states.
///
/// # Errors
/// If the picture is too large for the format.
pub fn encode_as(
    picture: &Picture,
    format: Format,
    coding: &Coding,
) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    match format {
        Format::Png => {
            let failed = |error: png::EncodingError| {
                ImageError::Encoding(EncodingError::new(ImageFormat::Png.into(), error))
            };
            write_png(picture, coding, &mut bytes).map_err(failed)?;
        }
        Format::Exr => write_exr(picture, coding, &mut bytes)?,
    }
    Ok(bytes.into_inner())
}

/// Writes a PNG file with the colour and the coverage of the picture, if it has one.
fn write_png(
    picture: &Picture,
    coding: &Coding,
    bytes: &mut Cursor<Vec<u8>>,
) -> Result<(), png::EncodingError> {
    let Coding { encoding, bits, .. } = coding;
    let coverage = alpha::coverage(picture);
    let alpha = |k: usize| coverage.map(|coverage| coverage[k]);
    let straight = |k: usize| alpha::straight(picture.pixels[k], alpha(k));
    let count = 0..picture.pixels.len();
    let channels = if coverage.is_some() { 4 } else { 3 };
    let mut data =
        Vec::with_capacity(count.len() * channels * (1 + usize::from(*bits == Bits::Sixteen)));
    match bits {
        Bits::Eight => {
            let bytes_of = Bytes::of(*encoding);
            for k in count {
                data.extend(straight(k).map(|light| bytes_of.at(light)));
                data.extend(alpha(k).map(|a| (a.clamp(0.0, 1.0) * 255.0).round() as u8));
            }
        }
        Bits::Sixteen => {
            let code = |part: f64| ((part * 65535.0).round() as u16).to_be_bytes();
            for k in count {
                data.extend(straight(k).into_iter().flat_map(|light| {
                    // NaN becomes 0, as in a cast to a whole number.
                    code(encoding.encode(f64::from(light)))
                }));
                data.extend(alpha(k).into_iter().flat_map(|a| code(f64::from(a).clamp(0.0, 1.0))));
            }
        }
    }
    let size = [picture.width, picture.height];
    write_codes(size, coverage.is_some(), &data, coding, bytes)
}

/// Writes a PNG file of these codes, row by row, with a coverage or without.
pub(super) fn write_codes(
    [width, height]: [u32; 2],
    has_coverage: bool,
    codes: &[u8],
    coding: &Coding,
    bytes: &mut Cursor<Vec<u8>>,
) -> Result<(), png::EncodingError> {
    let Coding { encoding, bits, command, inputs, .. } = coding;
    let mut encoder = png::Encoder::new(bytes, width, height);
    encoder.set_color(if has_coverage { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(match bits {
        Bits::Eight => png::BitDepth::Eight,
        Bits::Sixteen => png::BitDepth::Sixteen,
    });
    encoder.set_compression(png::Compression::Fast);
    encoder.set_filter(png::Filter::Adaptive);
    match *encoding {
        Encoding::Srgb => encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual),
        Encoding::Gamma(gamma) => {
            encoder.set_source_gamma(png::ScaledFloat::new((1.0 / gamma) as f32));
        }
    }
    encoder.add_text_chunk("Software".into(), SOFTWARE.into())?;
    if let Some(command) = command {
        encoder.add_itxt_chunk("Command".into(), command.clone())?;
    }
    if let Some(inputs) = inputs {
        encoder.add_text_chunk(INPUTS.into(), inputs.clone())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(codes)?;
    writer.finish()
}

/// Writes an EXR file with the colour and all channels of the picture.
fn write_exr(
    picture: &Picture,
    coding: &Coding,
    bytes: &mut Cursor<Vec<u8>>,
) -> Result<(), ImageError> {
    let light = |k: usize| FlatSamples::F32(picture.pixels.iter().map(|pixel| pixel[k]).collect());
    let mut channels: Channels = ["R", "G", "B"]
        .into_iter()
        .enumerate()
        .map(|(k, name)| AnyChannel::new(name, light(k)))
        .collect();
    for channel in &picture.channels {
        channels.push(AnyChannel::new(channel.name, FlatSamples::F32(channel.values.clone())));
    }
    write_channels([picture.width, picture.height], channels, coding, bytes)
}

/// The channels of an EXR file.
pub(super) type Channels = SmallVec<[AnyChannel<FlatSamples>; 4]>;

/// Writes an EXR file of these channels.
pub(super) fn write_channels(
    [width, height]: [u32; 2],
    channels: Channels,
    coding: &Coding,
    bytes: &mut Cursor<Vec<u8>>,
) -> Result<(), ImageError> {
    let size = (width as usize, height as usize);
    let mut image = Image::from_channels(size, AnyChannels::sort(channels));
    let attributes = &mut image.layer_data.attributes;
    attributes.software_name = Text::new_or_none(SOFTWARE);
    attributes.comments = coding.command.as_deref().and_then(Text::new_or_none);
    if let Some((crop, [width, height])) = coding.part {
        attributes.layer_position = Vec2(crop.x as i32, crop.y as i32);
        let whole = Vec2(width as usize, height as usize);
        image.attributes.display_window = IntegerBounds::new(Vec2(0, 0), whole);
    }
    image.write().to_buffered(bytes).map_err(|error| {
        ImageError::Encoding(EncodingError::new(ImageFormat::OpenExr.into(), error))
    })
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

    /// Half of a white pixel is covered, and nothing of the next.
    fn half_covered() -> Picture {
        let alpha = Channel { name: alpha::NAME, values: vec![0.5, 0.0] };
        let pixels = vec![[0.5, 0.25, 0.0], [0.0; 3]];
        Picture { pixels, channels: vec![alpha], ..Picture::black(2, 1) }
    }

    #[test]
    fn a_png_is_straight_and_an_exr_is_multiplied() {
        let png = encode(&half_covered(), Format::Png, Encoding::Srgb).unwrap();
        let read = image::load_from_memory(&png).unwrap().to_rgba8();
        assert_eq!(read.as_raw(), &[255, 188, 0, 128, 0, 0, 0, 0]);
        let exr = encode(&half_covered(), Format::Exr, Encoding::Srgb).unwrap();
        let read = image::load_from_memory(&exr).unwrap().to_rgba32f();
        assert_eq!(read.as_raw(), &[0.5, 0.25, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn sixteen_bits_are_the_nearest_codes() {
        for encoding in [Encoding::Srgb, Encoding::Gamma(2.2)] {
            let coding = Coding { bits: Bits::Sixteen, ..Coding::new(encoding) };
            let png = encode_as(&half_covered(), Format::Png, &coding).unwrap();
            let read = image::load_from_memory(&png).unwrap();
            assert_eq!(read.color(), image::ColorType::Rgba16);
            let half = (encoding.encode(0.5) * 65535.0).round() as u16;
            assert_eq!(read.to_rgba16().get_pixel(0, 0).0, [65535, half, 0, 32768]);
        }
    }

    #[test]
    fn files_state_the_encoding_the_command_and_the_place() {
        let command = Some("render a.json --size 9x8".to_string());
        let crop = Crop { x: 3, y: 5, width: 2, height: 1 };
        let coding = Coding { command, part: Some((crop, [9, 8])), ..Coding::new(Encoding::Srgb) };
        let png = encode_as(&small(), Format::Png, &coding).unwrap();
        let reader = png::Decoder::new(Cursor::new(&png)).read_info().unwrap();
        let info = reader.info();
        assert_eq!(info.srgb, Some(png::SrgbRenderingIntent::Perceptual));
        assert_eq!(info.uncompressed_latin1_text[0].text, SOFTWARE);
        assert_eq!(info.utf8_text[0].get_text().unwrap(), "render a.json --size 9x8");
        let gamma = encode(&small(), Format::Png, Encoding::Gamma(2.0)).unwrap();
        let reader = png::Decoder::new(Cursor::new(&gamma)).read_info().unwrap();
        assert_eq!(reader.info().gama_chunk.map(png::ScaledFloat::into_value), Some(0.5));
        let exr = encode_as(&small(), Format::Exr, &coding).unwrap();
        let meta = exr::meta::MetaData::read_from_buffered(&*exr, false).unwrap();
        let header = &meta.headers[0];
        assert_eq!(header.own_attributes.layer_position, Vec2(3, 5));
        assert_eq!(header.layer_size, Vec2(2, 1));
        assert_eq!(header.shared_attributes.display_window.size, Vec2(9, 8));
        let comment = header.own_attributes.comments.as_ref().map(ToString::to_string);
        assert_eq!(comment.as_deref(), Some("render a.json --size 9x8"));
    }
}
