//! The pictures of the page as PNG, encoded for speed.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use rayon::prelude::*;
use render::Picture;
use render::color::Encoding;
use std::sync::OnceLock;

/// Entries of the table of codes. Neighbouring codes of dark colours are 0.0003 apart.
const CODES: usize = 1 << 14;

/// Returns the bytes of a PNG of 8 bits. A code may differ by one from that of an exported picture.
#[must_use]
pub fn encoded(picture: &Picture) -> Vec<u8> {
    static TABLE: OnceLock<Vec<u8>> = OnceLock::new();
    let table = TABLE.get_or_init(|| {
        let light = |k: usize| k as f64 / (CODES - 1) as f64;
        (0..CODES).map(|k| Encoding::Srgb.to_byte(light(k))).collect()
    });
    let code = |light: f32| table[(light.clamp(0.0, 1.0) * (CODES - 1) as f32).round() as usize];
    let bytes: Vec<u8> = picture.pixels.par_iter().flat_map_iter(|pixel| pixel.map(code)).collect();
    let mut png = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Sub);
    let written =
        encoder.write_image(&bytes, picture.width, picture.height, ExtendedColorType::Rgb8);
    if written.is_err() {
        png.clear();
    }
    png
}
