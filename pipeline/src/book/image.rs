//! Pictures as a page holds them.

use crate::PipelineError;
use crate::html::png_address;
use image::ExtendedColorType::Rgb8;
use image::ImageEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use render::Picture;
use render::color::Encoding;

/// A picture as the address of a PNG that is the file itself, compressed as well as the encoder can.
///
/// # Errors
/// When the encoder refuses it.
pub fn address(name: &str, picture: &Picture) -> Result<String, PipelineError> {
    let byte = |light: &f32| Encoding::Srgb.to_byte(f64::from(*light));
    let bytes: Vec<u8> = picture.pixels.as_flattened().iter().map(byte).collect();
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(&bytes, picture.width, picture.height, Rgb8)
        .map_err(|source| PipelineError::Encode { name: name.into(), source })?;
    Ok(png_address(&png))
}

/// The same picture smaller, at most `side` pixels across and down; each pixel is the mean of the light of
/// those that it stands for.
#[must_use]
pub fn thumbnail(picture: &Picture, side: u32) -> Picture {
    let (width, height) = (picture.width, picture.height);
    let longest = width.max(height);
    if longest <= side {
        return picture.clone();
    }
    let scaled =
        |length: u32| (u64::from(length) * u64::from(side) / u64::from(longest)).max(1) as u32;
    let mut small = Picture::black(scaled(width), scaled(height));
    let span = |k: u32, parts: u32, all: u32| {
        let edge = |k: u32| (u64::from(k) * u64::from(all) / u64::from(parts)) as usize;
        edge(k)..edge(k + 1).max(edge(k) + 1)
    };
    for y in 0..small.height {
        for x in 0..small.width {
            let (rows, columns) = (span(y, small.height, height), span(x, small.width, width));
            let count = (rows.len() * columns.len()) as f64;
            let mut sum = [0.0_f64; 3];
            for row in rows {
                let start = row * width as usize;
                for pixel in &picture.pixels[start + columns.start..start + columns.end] {
                    for (sum, light) in sum.iter_mut().zip(pixel) {
                        *sum += f64::from(*light).clamp(0.0, 1.0);
                    }
                }
            }
            let place = (y * small.width + x) as usize;
            small.pixels[place] = sum.map(|sum| (sum / count) as f32);
        }
    }
    small
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thumbnail_keeps_the_light_and_the_shape() {
        let mut picture = Picture::black(300, 200);
        for (k, pixel) in picture.pixels.iter_mut().enumerate() {
            *pixel = [(k % 2) as f32; 3];
        }
        let small = thumbnail(&picture, 150);
        assert_eq!((small.width, small.height), (150, 100));
        assert!(small.pixels.iter().all(|pixel| *pixel == [0.5; 3]));
        assert_eq!(thumbnail(&picture, 300), picture);
        assert_eq!(thumbnail(&Picture::black(1000, 1), 10).height, 1);
    }

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
