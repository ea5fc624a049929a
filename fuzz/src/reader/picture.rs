//! Reads picture files: as a texture, as a bump, and in a comparison.

use super::scene;
use crate::seeds::memory_files::MemoryFiles;
use crate::verdict::{Stop, Tried, broken, refused};
use compare::{Difference, Scale, map, read, ssim};
use render::Picture;
use render::color::Encoding;
use render::film::encode::{self, Format};

/// The path of the tried picture. Its first bytes determine its format.
const PATH: &str = "examples/textures/tried.png";

/// A scene that shows the picture, also as a bump, for which it must be a PNG file.
const BUMPY: &str = r#"{"format": "tb-scene", "version": 1,
    "camera": {"eye": [0, 2, 5], "target": [0, 0.3, 0], "up": [0, 1, 0], "fov_deg": 40},
    "background": 0.5, "ambient": 0.3,
    "lights": [{"directional": {"direction": [1, -2, -1], "color": 1}}],
    "textures": {"t": {"image": "../textures/tried.png"}},
    "materials": {"m": {}, "b": {"bump": {"image": {"file": "../textures/tried.png"}, "strength": 0.1}}},
    "objects": [{"sphere": {"center": [1, 0, 0], "radius": 1, "material": "m", "texture": "t"}},
        {"sphere": {"center": [-1, 0, 0], "radius": 1, "material": "b"}}]}"#;

/// A scene that shows the picture as a texture alone.
const SMOOTH: &str = r#"{"format": "tb-scene", "version": 1,
    "camera": {"eye": [0, 2, 5], "target": [0, 0.3, 0], "up": [0, 1, 0], "fov_deg": 40},
    "background": 0.5, "ambient": 1,
    "textures": {"t": {"image": "../textures/tried.png"}}, "materials": {"m": {}},
    "objects": [{"sphere": {"center": [1, 0, 0], "radius": 1, "material": "m", "texture": "t"}}]}"#;

/// Largest number of pixels of a picture that is compared with itself.
const MOST_PIXELS: usize = 1 << 16;

/// Shows a JPEG file on a sphere.
///
/// # Errors
/// When the file is refused, or the picture that shows it is wrong.
pub fn read_jpeg(bytes: &[u8], stored: &MemoryFiles) -> Tried {
    scene::read(SMOOTH.as_bytes(), &stored.with(PATH, bytes))
}

/// Shows a PNG file on a sphere, as its bumps too, and compares the picture with others.
///
/// # Errors
/// When both readers refuse the file, or one of them fails.
pub fn read_png(bytes: &[u8], stored: &MemoryFiles) -> Tried {
    let shown = scene::read(BUMPY.as_bytes(), &stored.with(PATH, bytes));
    match (shown, compare(bytes)) {
        (Err(Stop::Broken(what)), _) | (_, Err(Stop::Broken(what))) => Err(Stop::Broken(what)),
        (Ok(()), _) | (_, Ok(())) => Ok(()),
        // The two readers word a refusal differently; each message is checked in one half of the
        // cases.
        (first, second) => {
            if crc32fast::hash(bytes).is_multiple_of(2) {
                first
            } else {
                second
            }
        }
    }
}

/// Reads a picture as `compare` does, and compares it with itself and with black.
///
/// # Errors
/// When the picture is refused, or the decoded picture cannot be compared or written.
pub fn compare(bytes: &[u8]) -> Tried {
    let picture = read::decode("tried.png", bytes).map_err(refused)?;
    if picture.pixels.len() > MOST_PIXELS {
        return Ok(());
    }
    let black = Picture::black(picture.width, picture.height);
    for other in [&picture, &black] {
        Difference::between(&picture, other, None)
            .map_err(|error| broken("a picture that was read is not compared")(&error))?;
        ssim::ssim(&picture, other)
            .map_err(|error| broken("a picture that was read has no similarity")(&error))?;
        map::map(&picture, other, Scale::Linear { most: 1.0 })
            .map_err(|error| broken("a picture that was read has no map")(&error))?;
    }
    for format in [Format::Png, Format::Exr] {
        let written = encode::encode(&picture, format, Encoding::Srgb)
            .map_err(|error| broken("a picture that was read is not written")(&error))?;
        read::decode("again", &written)
            .map_err(|error| broken("a picture that was written is refused")(&error))?;
    }
    Ok(())
}
