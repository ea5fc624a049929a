//! A picture as the bytes of a file.

use super::Picture;
use crate::color::Encoding;
use image::{ImageError, ImageFormat, Rgb, Rgb32FImage, RgbImage};
use std::io::Cursor;
use std::path::Path;

/// A kind of picture file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// 24 bits per pixel, encoded (sRGB or a gamma).
    Png,
    /// EXR: linear 32-bit floats.
    Exr,
}

impl Format {
    /// The format that a file name's extension names, if it is one of ours.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "png" => Some(Self::Png),
            "exr" => Some(Self::Exr),
            _ => None,
        }
    }
}

/// The bytes of the file. `encoding` is how PNG codes are made; EXR stays linear.
///
/// # Errors
/// When the picture is too large for the format.
pub fn encode(
    picture: &Picture,
    format: Format,
    encoding: Encoding,
) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    let at = |x: u32, y: u32| picture.pixels[y as usize * picture.width as usize + x as usize];
    match format {
        Format::Png => {
            let byte = |light: f32| encoding.to_byte(f64::from(light));
            RgbImage::from_fn(picture.width, picture.height, |x, y| Rgb(at(x, y).map(byte)))
                .write_to(&mut bytes, ImageFormat::Png)?;
        }
        Format::Exr => {
            Rgb32FImage::from_fn(picture.width, picture.height, |x, y| Rgb(at(x, y)))
                .write_to(&mut bytes, ImageFormat::OpenExr)?;
        }
    }
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

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
