//! Makes a map of the errors between two pictures.

use super::Scale;
use super::difference::magnitude;
use super::error::{CompareError, check_finite, check_sizes};
use image::{ImageError, ImageFormat, Rgb, RgbImage};
use render::Picture;
use std::io::Cursor;

/// Returns the error map. The colour of each pixel stands for the largest absolute difference among its
/// channels, in linear light where white is 1. Codes are sRGB.
///
/// # Errors
/// When the sizes differ, there are no pixels, or a pixel is not finite.
pub fn map(first: &Picture, second: &Picture, scale: Scale) -> Result<RgbImage, CompareError> {
    check_sizes(first, second)?;
    let mut map = RgbImage::new(first.width, first.height);
    let pairs = first.pixels.iter().zip(&second.pixels).enumerate();
    for (pixel, (index, pair)) in map.pixels_mut().zip(pairs) {
        check_finite("first", first.width, index, pair.0)?;
        check_finite("second", first.width, index, pair.1)?;
        *pixel = Rgb(scale.color(magnitude(pair)));
    }
    Ok(map)
}

/// Returns a map as the bytes of a PNG file.
///
/// # Errors
/// When the map is too large for the format.
pub fn png(map: &RgbImage) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    map.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_has_the_colour_of_its_error() {
        let black = Picture::black(3, 2);
        let mut other = black.clone();
        other.pixels[1] = [0.0, -0.125, 0.0625];
        other.pixels[5] = [0.5, 0.0, 0.0];
        let scale = Scale::Linear { most: 0.5 };
        let map = map(&other, &black, scale).unwrap();
        let errors = [0.0, 0.125, 0.0, 0.0, 0.0, 0.5];
        for (pixel, error) in map.pixels().zip(errors) {
            assert_eq!(pixel.0, scale.color(error));
        }
        let read = image::load_from_memory(&png(&map).unwrap()).unwrap().to_rgb8();
        assert_eq!(read, map);
    }

    #[test]
    fn maps_of_what_cannot_be_compared_are_refused() {
        let two = Picture::black(2, 1);
        assert!(map(&two, &Picture::black(1, 2), Scale::default()).is_err());
        let broken = Picture { pixels: vec![[0.0; 3], [f32::NAN; 3]], ..two.clone() };
        assert!(map(&two, &broken, Scale::default()).is_err());
    }
}
