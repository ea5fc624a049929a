//! Embeds pictures in a page.

use crate::PipelineError;
use crate::html::png_address;
use image::ExtendedColorType::Rgb8;
use image::ImageEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use render::Picture;
use render::color::Encoding;

/// Returns a picture as a data URL that contains the PNG file, compressed as well as the encoder can.
///
/// # Errors
/// When the encoder refuses the picture.
pub fn address(name: &str, picture: &Picture) -> Result<String, PipelineError> {
    let byte = |light: &f32| Encoding::Srgb.to_byte(f64::from(*light));
    let bytes: Vec<u8> = picture.pixels.as_flattened().iter().map(byte).collect();
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(&bytes, picture.width, picture.height, Rgb8)
        .map_err(|source| PipelineError::Encode { name: name.into(), source })?;
    Ok(png_address(&png))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_address_is_the_picture() {
        use base64::Engine;
        let mut picture = Picture::black(2, 1);
        picture.pixels[1] = [1.0, 0.0, 0.5];
        let address = address("a", &picture).unwrap();
        let png = address.strip_prefix("data:image/png;base64,").unwrap();
        let png = base64::engine::general_purpose::STANDARD.decode(png).unwrap();
        let read = image::load_from_memory(&png).unwrap().to_rgb8();
        assert_eq!(read.as_raw(), &[0, 0, 0, 255, 0, 188]);
    }
}
