//! The scenes in `examples`, and substitutes for the files that they name.

#![allow(dead_code, reason = "each test module uses its part of the examples")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::{FileError, Source};
use fixtures::schema::documents;
use serde_json::Value;
use std::io::ErrorKind;
use std::path::Path;

/// A source that returns a small picture for each `.png`, a triangle for each `.obj`, and no other
/// file.
#[derive(Debug)]
pub struct Meshless;

impl Source for Meshless {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let is_picture = path.extension().is_some_and(|kind| kind == "png");
        let found = is_picture.then(|| {
            let texel = image::RgbImage::from_pixel(2, 2, image::Rgb([9, 90, 200]));
            let mut bytes = std::io::Cursor::new(Vec::new());
            texel.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
            bytes.into_inner()
        });
        let is_mesh = path.extension().is_some_and(|kind| kind == "obj");
        let tube = || b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n".to_vec();
        found.or(is_mesh.then(tube)).ok_or_else(|| FileError::Read {
            name: path.display().to_string(),
            source: ErrorKind::NotFound.into(),
        })
    }
}

/// Returns the scenes of `examples/scenes` with their paths.
pub fn examples() -> Vec<(String, Value)> {
    documents(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes"))
}
