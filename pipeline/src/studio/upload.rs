//! Pictures that the user gives to the page, such as textures, as files of the opened folder.

use super::folder::{Folder, slashed};
use files::picture::{SURFACES, size};
use files::words::shown;
use files::{FileError, Source};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The largest picture file, in bytes.
pub const LARGEST: usize = 64 << 20;

/// Longest name of a file, in characters.
const LONGEST: usize = 80;

/// Files of the same name, but for a number, that are looked at.
const MOST: u32 = 1000;

/// Writes a picture beside the file `beside` of the folder. Nothing is replaced: the name gets a number if another file
/// has it already. Returns the name of the file, and the size of the picture in pixels.
///
/// # Errors
/// When the bytes are no picture that a surface can show, or the file cannot be written. The error is a sentence.
pub fn picture(folder: &Folder, beside: &str, name: &str, bytes: &[u8]) -> Result<Value, String> {
    let (width, height) = size(bytes, &SURFACES).map_err(|error| {
        let name = shown(name);
        format!("{name}: {error}; expected a PNG, JPEG, BMP, TIFF, WebP, GIF, HDR or EXR file")
    })?;
    let below = Path::new(beside).parent().unwrap_or(Path::new(""));
    let plain = plain(name);
    for k in 1..=MOST {
        let own = numbered(&plain, k);
        let path = below.join(&own);
        if folder.stamp(&path).is_some() {
            // An uploaded picture that equals this file needs no file of its own.
            if folder.read(&path).is_ok_and(|there| there == bytes) {
                return Ok(json!({ "name": slashed(&own), "size": [width, height] }));
            }
            continue;
        }
        folder.write(&path, bytes).map_err(|error: FileError| error.to_string())?;
        return Ok(json!({ "name": slashed(&own), "size": [width, height] }));
    }
    Err(format!("{} and {MOST} names like it are taken: choose another name", shown(&plain)))
}

/// Returns the last part of a path with letters, digits, `.`, `-` and `_` only.
fn plain(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let of = |c: char| if c.is_alphanumeric() || "._-".contains(c) { c } else { '-' };
    let name: String = last.chars().map(of).collect();
    let from = name.chars().count().saturating_sub(LONGEST);
    let name: String = name.trim_start_matches('.').chars().skip(from).collect();
    if name.is_empty() { "picture".into() } else { name }
}

/// Returns a name with a number before its extension; the first has none.
fn numbered(name: &str, k: u32) -> PathBuf {
    if k == 1 {
        return name.into();
    }
    match name.rsplit_once('.') {
        Some((stem, end)) => format!("{stem}-{k}.{end}").into(),
        None => format!("{name}-{k}").into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png(light: u8) -> Vec<u8> {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let picture = image::GrayImage::from_pixel(3, 2, image::Luma([light]));
        picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn pictures_lie_beside_their_scene_and_replace_nothing() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(place.path()).unwrap();
        let given = |name: &str, bytes: &[u8]| picture(&folder, "scenes/cup.json", name, bytes);
        let named = |name: &str, light| given(name, &png(light)).unwrap()["name"].clone();
        assert_eq!(named("my tiles.png", 1), "my-tiles.png");
        assert_eq!(named("my tiles.png", 1), "my-tiles.png", "the same picture");
        assert_eq!(named("my tiles.png", 2), "my-tiles-2.png", "another picture");
        assert_eq!(named("../../../.profile", 3), "profile");
        assert!(place.path().join("scenes/my-tiles-2.png").exists());
        assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 1);
        assert_eq!(given("a.png", &png(4)).unwrap()["size"], json!([3, 2]));
        for wrong in [&b"no picture"[..], b"", &png(1)[..20]] {
            assert!(given("b.png", wrong).unwrap_err().starts_with("b.png: "));
        }
        assert!(picture(&folder, "../cup.json", "a.png", &png(5)).is_err());
    }
}
