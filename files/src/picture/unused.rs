//! The contents of a picture file beside its pixels that our programs do not apply.

use image::metadata::Orientation;
use image::{ImageDecoder, ImageReader};
use std::io::Cursor;

/// Gamma of sRGB files in a PNG, times 100,000, and the difference that nobody sees.
const USUAL_GAMMA: i64 = 45455;
const NEAR_GAMMA: i64 = 500;

/// Returns sentences about the contents of a picture file that are not applied: a camera's orientation,
/// a colour profile other than sRGB, and the gamma of a PNG.
#[must_use]
pub fn unused(bytes: &[u8]) -> Vec<&'static str> {
    let look = || {
        let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().ok()?;
        let mut decoder = reader.into_decoder().ok()?;
        let turned = decoder.orientation().is_ok_and(|found| found != Orientation::NoTransforms);
        let profile = decoder.icc_profile().ok().flatten();
        Some((turned, profile.is_some_and(|profile| !names_srgb(&profile))))
    };
    let (turned, profiled) = super::guard::guarded(look).flatten().unwrap_or_default();
    let mut sentences = Vec::new();
    if turned {
        sentences.push("the orientation of the camera is not applied");
    }
    if profiled {
        sentences.push("the colour profile is not applied");
    }
    if has_other_gamma(bytes) {
        sentences.push("the gamma of the file is not applied");
    }
    sentences
}

/// Returns whether a profile names sRGB, as text of one or of two bytes for each letter.
fn names_srgb(profile: &[u8]) -> bool {
    let holds = |name: &[u8]| profile.windows(name.len()).any(|part| part == name);
    holds(b"sRGB") || holds(b"s\0R\0G\0B")
}

/// Returns whether a PNG states another gamma than that of sRGB.
fn has_other_gamma(bytes: &[u8]) -> bool {
    let mut at = 8;
    let mut other = false;
    while let Some(head) = bytes.get(at..at + 8).filter(|_| bytes.starts_with(b"\x89PNG")) {
        let length = head[..4].iter().fold(0, |sum, &byte| sum << 8 | usize::from(byte));
        match &head[4..] {
            b"gAMA" => {
                let gamma = bytes.get(at + 8..at + 12).unwrap_or_default();
                let gamma = gamma.iter().fold(0, |sum, &byte| sum << 8 | i64::from(byte));
                other = (gamma - USUAL_GAMMA).abs() > NEAR_GAMMA;
            }
            b"sRGB" => return false,
            b"IDAT" => break,
            _ => {}
        }
        at += 12 + length;
    }
    other
}
