//! Pictures to be compared, from PNG and EXR files, in linear light.
//!
//! The codes of a PNG file, of 8 or of 16 bits, are read as sRGB, whatever else its chunks may say; grey
//! is three equal channels. An EXR file is read as it is: its channels `R`, `G` and `B`, and no layers. A
//! picture with an alpha channel must be opaque, since what lies behind it is not known.

use crate::layer;
use files::memory::of_process;
use files::picture::{self, Format, PictureError};
use files::words::shown;
use files::{Exit, Failure, FileError, Ledger, MemoryError, input};
use image::{ColorType, DynamicImage};
use render::Picture;
use render::color::Encoding;
use render::film::Crop;
use std::path::Path;
use thiserror::Error;

/// Returns the bytes for each pixel while a picture is read: decoded, as linear light with alpha, and in
/// the [`Picture`].
fn each(kind: ColorType) -> u64 {
    u64::from(kind.bytes_per_pixel()) + 16 + 12
}

/// Why a picture file cannot be compared.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file holds no PNG or EXR picture.
    #[error("{name}: found no picture ({found}), expected a PNG or EXR file")]
    NoPicture {
        /// The file.
        name: String,
        /// Description of the found content, in words.
        found: String,
    },
    /// The picture takes more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// A pixel is not opaque or not finite.
    #[error("{name}: found {found} in pixel {},{}, expected {expected}", place.0, place.1)]
    Pixel {
        /// The file.
        name: String,
        /// Column and row, from 0.
        place: (u32, u32),
        /// The found value, in words.
        found: String,
        /// The expected value, in words.
        expected: &'static str,
    },
    /// The two pictures are not equally large.
    #[error("{first} is {}x{} pixels and {second} {}x{}: expected the same size", sizes[0].0, sizes[0].1, sizes[1].0, sizes[1].1)]
    Sizes {
        /// The first file.
        first: String,
        /// The second file.
        second: String,
        /// Pixels across and down of both.
        sizes: [(u32, u32); 2],
    },
    /// The file has no such layer, or one of more than three channels.
    #[error("{name}: found no layer and no channel {}, expected one of: {known}", shown(layer))]
    Layer {
        /// The file.
        name: String,
        /// The layer or channel that was requested.
        layer: String,
        /// The channels of the file.
        known: String,
    },
    /// The requested part does not lie in the picture.
    #[error("the crop {},{},{}x{} does not lie in {name}, which is {}x{} pixels", crop.x, crop.y, crop.width, crop.height, size.0, size.1)]
    Crop {
        /// The file.
        name: String,
        /// The part.
        crop: Crop,
        /// Pixels of the picture across and down.
        size: (u32, u32),
    },
}

impl Failure for ReadError {
    fn exit(&self) -> Exit {
        match self {
            Self::File(error) => error.exit(),
            Self::NoPicture { .. } | Self::Pixel { .. } => Exit::Malformed,
            Self::Memory(error) => error.exit(),
            Self::Sizes { .. } | Self::Crop { .. } | Self::Layer { .. } => Exit::Use,
        }
    }
}

/// Reads the picture file that an argument names; `-` is standard input. The first bytes determine
/// the format.
///
/// # Errors
/// When the file cannot be read, is no PNG or EXR file, or is broken; when a pixel is not opaque or not
/// finite.
pub fn read(ledger: &Ledger, argument: &Path) -> Result<Picture, ReadError> {
    let name = input::name_of(argument);
    decode(&name, &ledger.argument(argument, "a picture")?)
}

/// Reads two pictures of the same size, or the same part of both, from the files that arguments name. With `layer` they
/// are this layer or channel of two EXR files.
///
/// # Errors
/// When a file cannot be read, the sizes differ, or the part does not lie in the pictures.
pub fn pair(
    ledger: &Ledger,
    first: &Path,
    second: &Path,
    crop: Option<Crop>,
    layer: Option<&str>,
) -> Result<[Picture; 2], ReadError> {
    let pictures = match layer {
        None => [read(ledger, first)?, read(ledger, second)?],
        Some(layer) => {
            let read = |path: &Path| {
                let bytes = ledger.argument(path, "a picture")?;
                layer::decode(&input::name_of(path), &bytes, layer)
            };
            let mut pictures = [read(first)?, read(second)?];
            layer::level(&mut pictures);
            pictures
        }
    };
    let sizes = pictures.each_ref().map(|picture| (picture.width, picture.height));
    let [first, second] = [first, second].map(input::name_of);
    if sizes[0] != sizes[1] {
        return Err(ReadError::Sizes { first, second, sizes });
    }
    let size = sizes[0];
    match crop {
        None => Ok(pictures),
        Some(crop) if crop.fits(size.0, size.1) => {
            Ok(pictures.each_ref().map(|whole| part(whole, &crop)))
        }
        Some(crop) => Err(ReadError::Crop { name: first, crop, size }),
    }
}

/// Returns a part of a picture without layers. The part must lie in the picture.
#[must_use]
pub fn part(whole: &Picture, crop: &Crop) -> Picture {
    let (start, end) = (crop.x as usize, (crop.x + crop.width) as usize);
    let rows = whole.pixels.chunks_exact(whole.width as usize);
    let rows = rows.skip(crop.y as usize).take(crop.height as usize);
    let pixels = rows.flat_map(|row| &row[start..end]).copied().collect();
    Picture { pixels, ..Picture::black(crop.width, crop.height) }
}

/// Reads a picture from the bytes of a file, which messages call `name`.
///
/// # Errors
/// See [`read`], except for errors of reading.
pub fn decode(name: &str, bytes: &[u8]) -> Result<Picture, ReadError> {
    let (decoded, _reserved) =
        picture::decode(bytes, &[Format::Png, Format::OpenExr], each, of_process(), || name.into())
            .map_err(|error| match error {
                PictureError::Memory(error) => ReadError::Memory(error),
                error => ReadError::NoPicture { name: name.into(), found: error.to_string() },
            })?;
    let (width, height) = (decoded.width(), decoded.height());
    let fault = |index: usize, found: String, expected: &'static str| {
        let place = crate::error::place(width, index);
        Err(ReadError::Pixel { name: name.into(), place, found, expected })
    };
    let mut picture = Picture::black(width, height);
    for (index, (to, [light @ .., alpha])) in
        picture.pixels.iter_mut().zip(linear(decoded)).enumerate()
    {
        if alpha != 1.0 {
            return fault(index, format!("an alpha of {alpha}"), "an opaque picture");
        }
        if let Some(value) = light.iter().find(|value| !value.is_finite()) {
            return fault(index, value.to_string(), "finite numbers");
        }
        *to = light;
    }
    Ok(picture)
}

/// Returns the linear red, green, blue and alpha of each pixel.
fn linear(decoded: DynamicImage) -> Vec<[f32; 4]> {
    if matches!(decoded, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_)) {
        return decoded.into_rgba32f().pixels().map(|pixel| pixel.0).collect();
    }
    let whole = f64::from(u16::MAX);
    let light: Vec<f32> =
        (0..=u16::MAX).map(|code| Encoding::Srgb.decode(f64::from(code) / whole) as f32).collect();
    // An 8-bit code k becomes 257 k, which is the same part of the whole.
    let codes = decoded.into_rgba16();
    let pixels = codes.pixels().map(|pixel| {
        let [r, g, b, alpha] = pixel.0;
        let [r, g, b] = [r, g, b].map(|code| light[usize::from(code)]);
        [r, g, b, f32::from(alpha) / f32::from(u16::MAX)]
    });
    pixels.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{
        GrayAlphaImage, GrayImage, ImageBuffer, ImageFormat, Luma, Rgb, Rgb32FImage, Rgba,
    };
    use render::film::encode::{self, Format};
    use std::io::Cursor;

    fn bytes(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.into().write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    fn complaint(bytes: &[u8]) -> String {
        decode("a.png", bytes).unwrap_err().to_string()
    }

    #[test]
    fn what_render_writes_is_read() {
        let pixels = vec![[0.0, 0.5, 1.0], [-0.25, 7.5, 1e-6]];
        let picture = Picture { pixels, ..Picture::black(2, 1) };
        let exr = encode::encode(&picture, Format::Exr, Encoding::Srgb).unwrap();
        assert_eq!(decode("a.exr", &exr).unwrap(), picture);
        let png = encode::encode(&picture, Format::Png, Encoding::Srgb).unwrap();
        let read = decode("a.png", &png).unwrap();
        // Code 188 is the nearest to the middle grey; half a code is 0.004 of light there.
        assert_eq!((read.pixels[0][0], read.pixels[0][2]), (0.0, 1.0));
        assert!((read.pixels[0][1] - 0.5).abs() < 0.004);
        assert_eq!(read.pixels[1], [0.0, 1.0, 0.0]);
        // Every code is itself again.
        assert_eq!(encode::encode(&read, Format::Png, Encoding::Srgb).unwrap(), png);
    }

    #[test]
    fn codes_of_8_and_16_bits_and_grey_are_the_same_light() {
        let wide = ImageBuffer::from_pixel(1, 1, Rgb([188 * 257u16; 3]));
        let opaque = ImageBuffer::from_pixel(1, 1, Rgba([188u8, 188, 188, 255]));
        let grey = GrayImage::from_pixel(1, 1, Luma([188]));
        let expected = Encoding::Srgb.decode(188.0 / 255.0) as f32;
        for file in [
            bytes(wide, ImageFormat::Png),
            bytes(opaque, ImageFormat::Png),
            bytes(grey, ImageFormat::Png),
        ] {
            assert_eq!(decode("a.png", &file).unwrap().pixels, [[expected; 3]]);
        }
        let finest = ImageBuffer::from_pixel(1, 1, Rgb([1u16, 2, 3]));
        let read = decode("a.png", &bytes(finest, ImageFormat::Png)).unwrap().pixels[0];
        let code = 1.0 / 65535.0 / 12.92;
        assert_eq!(read, [1.0, 2.0, 3.0].map(|k| (k * code) as f32));
    }

    #[test]
    fn pixels_that_cannot_be_compared_are_named() {
        let mut glass = GrayAlphaImage::from_pixel(3, 2, image::LumaA([0, 255]));
        glass.get_pixel_mut(2, 1).0[1] = 51;
        assert_eq!(
            complaint(&bytes(glass, ImageFormat::Png)),
            "a.png: found an alpha of 0.2 in pixel 2,1, expected an opaque picture"
        );
        let mut broken = Rgb32FImage::new(2, 2);
        broken.get_pixel_mut(1, 0).0[2] = f32::NAN;
        assert_eq!(
            complaint(&bytes(broken, ImageFormat::OpenExr)),
            "a.png: found NaN in pixel 1,0, expected finite numbers"
        );
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let grey = bytes(GrayImage::new(40, 40), ImageFormat::Png);
        for broken in [&b""[..], b"no picture", b"GIF89a..", &grey[..30], &grey[..grey.len() / 2]] {
            let error = complaint(broken);
            assert!(error.starts_with("a.png: found no picture ("), "{error}");
            assert!(error.ends_with("), expected a PNG or EXR file"), "{error}");
            assert!(!error.contains('\n'), "{error}");
        }
    }

    /// Returns the CRC of a PNG chunk, computed bit by bit.
    fn crc(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(!0, |crc, &byte| {
            (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1)))
        })
    }

    #[test]
    fn a_picture_is_measured_before_it_is_decoded() {
        let mut file = bytes(GrayImage::new(1, 1), ImageFormat::Png);
        // Width and height follow the signature and the first chunk's length and name.
        for side in [16, 20] {
            file[side..side + 4].copy_from_slice(&1_000_000u32.to_be_bytes());
        }
        let sum = crc(&file[12..29]);
        file[29..33].copy_from_slice(&sum.to_be_bytes());
        let error = decode("a.png", &file).unwrap_err();
        let said = error.to_string();
        assert!(said.starts_with("a.png: a picture of 1000000x1000000 pixels needs "), "{said}");
        assert!(said.ends_with("or raise --max-memory"), "{said}");
        assert_eq!(error.exit(), Exit::Resource);
    }

    #[test]
    fn a_part_is_that_part() {
        let mut whole = Picture::black(5, 4);
        for (k, pixel) in (0u8..).zip(&mut whole.pixels) {
            *pixel = [f32::from(k); 3];
        }
        let found = part(&whole, &Crop { x: 1, y: 2, width: 3, height: 2 });
        let light: Vec<f32> = found.pixels.iter().map(|pixel| pixel[0]).collect();
        assert_eq!((found.width, found.height), (3, 2));
        assert_eq!(light, [11.0, 12.0, 13.0, 16.0, 17.0, 18.0]);
        assert_eq!(part(&whole, &Crop::whole(5, 4)), whole);
    }
}
