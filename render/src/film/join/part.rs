//! Decodes a part of a picture, with its place in the whole.

use crate::film::encode::{Bits, Format, INPUTS, SOFTWARE};
use crate::film::{Crop, size};
use exr::prelude::{AnyChannel, FlatSamples, ReadChannels as _, ReadLayers as _, SmallVec, read};
use std::io::Cursor;

/// A part of a picture, decoded.
pub(super) struct Part {
    pub(super) crop: Crop,
    /// Size of the whole picture.
    pub(super) whole: (u32, u32),
    /// The command of the whole picture.
    pub(super) command: String,
    /// The digest of all inputs of the picture, if a PNG states it.
    pub(super) inputs: Option<String>,
    pub(super) pixels: Pixels,
}

/// The values of a part or of the whole.
pub(super) enum Pixels {
    /// Codes of a PNG, with the bytes of a pixel.
    Png { codes: Vec<u8>, bytes: usize, has_coverage: bool, bits: Bits },
    /// Channels of an EXR by name.
    Exr(Vec<(String, Vec<f32>)>),
}

impl Part {
    /// Decodes a file. Fails with a description of what it is instead of a part.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, String> {
        match Format::of_contents(bytes) {
            Some(Format::Png) => of_png(bytes),
            Some(Format::Exr) => of_exr(bytes),
            None => Err("another kind of file".into()),
        }
    }
}

fn of_png(bytes: &[u8]) -> Result<Part, String> {
    let broken = |error: png::DecodingError| format!("a PNG that is broken ({error})");
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(broken)?;
    let info = reader.info();
    let has_coverage = match info.color_type {
        png::ColorType::Rgb => false,
        png::ColorType::Rgba => true,
        _ => return Err("a PNG of grey or of a palette".into()),
    };
    let bits = match info.bit_depth {
        png::BitDepth::Eight => Bits::Eight,
        png::BitDepth::Sixteen => Bits::Sixteen,
        _ => return Err("a PNG of few bits".into()),
    };
    let text = |key: &str| {
        let own = info.utf8_text.iter().find(|text| text.keyword == key)?;
        own.get_text().ok()
    };
    let command = text("Command");
    let latin = |key: &str| {
        let own = info.uncompressed_latin1_text.iter().find(|text| text.keyword == key);
        own.map(|text| text.text.clone())
    };
    let (software, inputs) = (latin("Software"), latin(INPUTS));
    let size = (info.width, info.height);
    let (crop, whole, command) = of_command(software.as_deref(), command.as_deref())?;
    if size != (crop.width, crop.height) {
        return Err("a PNG whose size is not that of its command".into());
    }
    let channels = if has_coverage { 4 } else { 3 };
    let bytes = channels * if bits == Bits::Eight { 1 } else { 2 };
    let mut codes = vec![0; size.0 as usize * size.1 as usize * bytes];
    reader.next_frame(&mut codes).map_err(broken)?;
    let pixels = Pixels::Png { codes, bytes, has_coverage, bits };
    Ok(Part { crop, whole, command, inputs, pixels })
}

fn of_exr(bytes: &[u8]) -> Result<Part, String> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| format!("an EXR that is broken ({error})"))?;
    let layer = image.layer_data;
    let text = |text: &Option<exr::prelude::Text>| text.as_ref().map(ToString::to_string);
    let (software, command) =
        (text(&layer.attributes.software_name), text(&layer.attributes.comments));
    let (crop, whole, command) = of_command(software.as_deref(), command.as_deref())?;
    let at = layer.attributes.layer_position;
    let place = (at.0, at.1, layer.size.0, layer.size.1);
    if place != (crop.x as i32, crop.y as i32, crop.width as usize, crop.height as usize) {
        return Err("an EXR whose data window is not that of its command".into());
    }
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = layer.channel_data.list;
    let channels = channels.into_iter().map(|channel| match channel.sample_data {
        FlatSamples::F32(values) => Ok((channel.name.to_string(), values)),
        FlatSamples::F16(_) | FlatSamples::U32(_) => {
            Err("an EXR of other numbers than 32-bit floats")
        }
    });
    let channels = channels.collect::<Result<_, _>>()?;
    Ok(Part { crop, whole, command, inputs: None, pixels: Pixels::Exr(channels) })
}

/// Returns the place of a part, the size of the whole picture and the command of the whole picture, from the texts of a
/// file.
fn of_command(
    software: Option<&str>,
    command: Option<&str>,
) -> Result<(Crop, (u32, u32), String), String> {
    let none = || "a picture without the command that made it".to_string();
    let (software, command) = (software.ok_or_else(none)?, command.ok_or_else(none)?);
    if software != SOFTWARE {
        return Err(format!("a picture of `{software}`, which is not `{SOFTWARE}`"));
    }
    // The scene and values that are set stand before, and nothing that is quoted behind.
    let (start, rest) = command.rsplit_once(" --size ").ok_or_else(none)?;
    let mut words = rest.split(' ');
    let own = words.next().unwrap_or_default();
    let whole = size(own).map_err(|_| none())?;
    let mut words = words.peekable();
    let crop = match words.next_if_eq(&"--crop").and_then(|_| words.next()) {
        None => Crop::whole(whole.0, whole.1),
        Some(crop) => Crop::parse(crop).map_err(|_| none())?,
    };
    if !crop.fits(whole.0, whole.1) {
        return Err("a crop that reaches out of its picture".into());
    }
    let words: Vec<&str> = [own].into_iter().chain(words).collect();
    Ok((crop, whole, format!("{start} --size {}", words.join(" "))))
}
