use super::*;
use crate::{Exit, Failure};
use image::{GrayImage, RgbImage};
use std::io::Write;

const ALL: [ImageFormat; 3] = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::OpenExr];

/// A PNG of one pixel with a palette of 4 bytes, which is one colour and a third of another.
const PALETTE_OF_4_BYTES: &[u8] = b"\x89PNG\r\n\x1a\n\
    \0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x03\0\0\0\x28\xcb\x34\xbb\
    \0\0\0\x04PLTE\0\0\0\0\xb4\xa3\xae\x7a\
    \0\0\0\x0aIDAT\x78\x9c\x63\x60\0\0\0\x02\0\x01\x48\xaf\xa4\x71\
    \0\0\0\0IEND\xae\x42\x60\x82";

fn read(bytes: &[u8], budget: &Budget) -> Result<DynamicImage, PictureError> {
    let each = |kind: ColorType| u64::from(kind.bytes_per_pixel());
    decode(bytes, &ALL, each, budget, || "a.png".into()).map(|(picture, _)| picture)
}

fn encoded(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// Returns the PNG with a chunk inserted after its header.
fn with_chunk(png: &[u8], kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut chunk = (data.len() as u32).to_be_bytes().to_vec();
    chunk.extend(kind);
    chunk.extend(data);
    chunk.extend(crc(&chunk[4..]).to_be_bytes());
    [&png[..33], &chunk, &png[33..]].concat()
}

/// Returns the CRC of a PNG chunk, computed bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1)))
    })
}

#[test]
fn a_palette_of_4_bytes_is_a_broken_file_and_no_panic() {
    let error = read(PALETTE_OF_4_BYTES, &Budget::new(1 << 30)).unwrap_err();
    assert!(matches!(&error, PictureError::Broken(_)), "{error:?}");
}

/// Fails once `png` no longer panics: then the guard and its reason in the module doc can go.
#[test]
fn the_decoder_itself_still_panics_on_a_palette_of_4_bytes() {
    let direct = || image::load_from_memory(PALETTE_OF_4_BYTES).is_ok();
    assert_eq!(guard::guarded(direct), None, "png no longer panics: look at the guard again");
}

#[test]
fn pictures_of_all_formats_are_read_and_others_named() {
    let picture = RgbImage::from_fn(5, 3, |x, y| image::Rgb([x as u8 * 40, y as u8 * 80, 9]));
    let budget = Budget::new(1 << 30);
    let png = read(&encoded(picture.clone(), ImageFormat::Png), &budget).unwrap();
    assert_eq!(png.into_rgb8(), picture);
    let floats = DynamicImage::from(picture.clone()).into_rgb32f();
    let exr = read(&encoded(floats.clone(), ImageFormat::OpenExr), &budget).unwrap();
    assert_eq!(exr.into_rgb32f(), floats);
    for (bytes, expected) in [
        (&b""[..], "an empty file"),
        (b"GIF89a..", "a file of type image/gif"),
        (b"\x1b[2J", "its first bytes are of no known format"),
    ] {
        assert_eq!(read(bytes, &budget).unwrap_err().to_string(), expected);
    }
    assert_eq!(budget.left(), 1 << 30, "all is given back");
}

#[test]
fn a_picture_is_refused_before_it_is_decoded() {
    let mut file = encoded(GrayImage::new(1, 1), ImageFormat::Png);
    for side in [16, 20] {
        file[side..side + 4].copy_from_slice(&1_000_000u32.to_be_bytes());
    }
    let sum = crc(&file[12..29]);
    file[29..33].copy_from_slice(&sum.to_be_bytes());
    let error = read(&file, &Budget::new(1 << 30)).unwrap_err();
    let PictureError::Memory(error) = error else { panic!("{error:?}") };
    assert_eq!((error.needed, error.exit()), (1_000_000_000_000, Exit::Resource));
    assert!(error.to_string().starts_with("a.png: a picture of 1000000x1000000 pixels needs"));
}

/// Returns 64 MB of zeros as a zlib stream of stored and repeated runs, as an ICC profile is
/// stored.
fn zlib_of_zeros() -> Vec<u8> {
    // A grey picture of zeros has such a stream as its data.
    let png = encoded(GrayImage::new(8192, 8192), ImageFormat::Png);
    let mut data = Vec::new();
    let mut at = 8;
    while at < png.len() {
        let length = u32::from_be_bytes(png[at..at + 4].try_into().unwrap()) as usize;
        if &png[at + 4..at + 8] == b"IDAT" {
            data.extend(&png[at + 8..at + 8 + length]);
        }
        at += 12 + length;
    }
    data
}

#[test]
fn a_colour_profile_of_zeros_is_not_unpacked() {
    let small = encoded(GrayImage::new(8, 8), ImageFormat::Png);
    let zeros = zlib_of_zeros();
    let profile = [b"zeros\0\0", &zeros[..]].concat();
    let file = with_chunk(&small, b"iCCP", &profile);
    // The budget is too small for the profile, and the picture is read without it.
    let picture = read(&file, &Budget::new(20 << 20)).unwrap();
    assert_eq!(picture.width(), 8);
    let text = with_chunk(&small, b"zTXt", &[b"Comment\0\0", &zeros[..]].concat());
    assert_eq!(read(&text, &Budget::new(20 << 20)).unwrap().width(), 8);
}

/// Returns the header of an EXR file with a display window of 8 x 8 pixels and the given data
/// window.
fn exr_with_data_window(corners: [i32; 4]) -> Vec<u8> {
    let mut file = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        file.write_all(&[name.as_bytes(), b"\0", kind.as_bytes(), b"\0"].concat()).unwrap();
        file.write_all(&(value.len() as u32).to_le_bytes()).unwrap();
        file.write_all(value).unwrap();
    };
    let mut channels = Vec::new();
    for name in [b"B", b"G", b"R"] {
        channels.extend(name);
        channels.extend([0, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
    }
    channels.push(0);
    let window = |corners: [i32; 4]| corners.map(i32::to_le_bytes).concat();
    attribute("channels", "chlist", &channels);
    attribute("compression", "compression", &[3]);
    attribute("dataWindow", "box2i", &window(corners));
    attribute("displayWindow", "box2i", &window([0, 0, 7, 7]));
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1f32.to_le_bytes());
    file.push(0);
    file.extend([0; 400]);
    file
}

#[test]
fn the_data_window_of_an_exr_is_measured_and_not_only_what_is_displayed() {
    let budget = Budget::new(1 << 30);
    for corners in [[0, 0, 1_000_000, 1000], [-1_000_000_000, -4, 1_000_000_000, 4]] {
        let file = exr_with_data_window(corners);
        let error = read(&file, &budget).unwrap_err();
        let PictureError::Broken(error) = error else { panic!("{corners:?}: {error:?}") };
        let expected =
            format!("pixels with 3 channels, more than a file of {} bytes can hold", file.len());
        assert!(error.ends_with(&expected), "{error}");
    }
    // The file is long enough to hold the pixels, so only the budget refuses it.
    let mut file = exr_with_data_window([0, 0, 1_000_000, 1000]);
    file.resize(20_000_000, 0);
    let error = read(&file, &budget).unwrap_err();
    let PictureError::Memory(error) = error else { panic!("{error:?}") };
    assert!(error.what.ends_with("pixels with 3 channels"), "{error}");
    // A small data window passes the budget, and the file is reported as cut short.
    let error = read(&exr_with_data_window([0, 0, 7, 7]), &budget).unwrap_err();
    assert!(matches!(&error, PictureError::Broken(_)), "{error:?}");
    assert_eq!(budget.left(), 1 << 30);
}

#[test]
fn damaged_files_of_all_formats_do_not_panic() {
    let picture = RgbImage::from_fn(16, 16, |x, y| image::Rgb([(x * y) as u8, x as u8, y as u8]));
    let floats = DynamicImage::from(picture.clone()).into_rgb32f();
    let files = [
        encoded(picture.clone(), ImageFormat::Png),
        encoded(picture, ImageFormat::Jpeg),
        encoded(floats, ImageFormat::OpenExr),
    ];
    let budget = Budget::new(64 << 20);
    let mut state = 1u64;
    let mut random = |below: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for file in &files {
        for _ in 0..2000 {
            let mut bytes = file.clone();
            for _ in 0..=random(3) {
                let at = random(bytes.len());
                bytes[at] = random(256) as u8;
            }
            // Any result but a panic is right.
            let _ = read(&bytes, &budget);
        }
    }
    assert_eq!(budget.left(), 64 << 20);
}

#[test]
fn messages_of_the_png_decoder_name_chunks_and_no_rust_values() {
    let mut file = encoded(GrayImage::new(3, 2), ImageFormat::Png);
    // The first chunk: its name follows the signature and a length, 13 bytes of content follow its name.
    file[12..16].copy_from_slice(b"IDAT");
    let sum = crc(&file[12..29]);
    file[29..33].copy_from_slice(&sum.to_be_bytes());
    let budget = Budget::new(1 << 30);
    let error = read(&file, &budget).unwrap_err().to_string();
    assert!(error.contains("IDAT") && !error.contains('{'), "{error}");
}
