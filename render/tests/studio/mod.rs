//! Scenes made from texts, and pictures made from scenes, without a disk.

#![allow(dead_code, reason = "each test module uses its part of the studio")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

pub mod objects;

use files::json::Document;
use files::{FileError, Source};
use image::{ImageFormat, Rgb, RgbImage};
use render::filter::Filter;
use render::scene::read;
use render::{Picture, Prepared, Scene, Settings};
use std::io::{Cursor, ErrorKind};
use std::path::Path;

/// All filters but the ellipses and probes, which see more than their footprint.
pub const FILTERS: [Filter; 7] = [
    Filter::Point,
    Filter::Bilinear,
    Filter::Mip,
    Filter::Box,
    Filter::Tent,
    Filter::Quadratic,
    Filter::Exact,
];

/// Contents of the files that a scene names, by path.
#[derive(Debug)]
struct Files<'a>(&'a [(&'a str, Vec<u8>)]);

impl Source for Files<'_> {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let found = self.0.iter().find(|(name, _)| Path::new(name) == path);
        found.map(|(_, bytes)| bytes.clone()).ok_or_else(|| FileError::Read {
            name: path.display().to_string(),
            source: ErrorKind::NotFound.into(),
        })
    }
}

/// Returns the scene with these keys. Unless the keys state otherwise, its camera is at (0, 0, 1)
/// and sees the square from -1 to 1 of the plane z = 0.
pub fn scene(keys: &str, files: &[(&str, Vec<u8>)]) -> Scene {
    let camera = r#""camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 },"#;
    let camera = if keys.contains("\"camera\"") { "" } else { camera };
    let text = format!("{{ \"format\": \"tb-scene\", \"version\": 1, {camera} {keys} }}");
    let document = Document::new("scene.json", text.as_bytes()).unwrap();
    let file = read::parse(&document).unwrap_or_else(|error| panic!("{error}\n{text}"));
    read::resolve(&document, &file, Path::new(""), &Files(files), read::MeshSource::new())
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Renders `side` by `side` pixels with one ray in each.
pub fn picture(scene: &Scene, side: u32, filter: Filter) -> Picture {
    supersampled(scene, side, 1, filter)
}

/// Renders `side` by `side` pixels with `samples` by `samples` rays in each.
pub fn supersampled(scene: &Scene, side: u32, samples: u32, filter: Filter) -> Picture {
    let settings = Settings::new(side, side, filter).with_samples(samples);
    let (picture, stats) = render::render(&Prepared::new(scene), &settings, &|_, _| {});
    assert_eq!(stats.not_finite, 0);
    picture
}

/// Renders a picture of any width and height, with one ray in each pixel.
pub fn sized(scene: &Scene, width: u32, height: u32, filter: Filter) -> Picture {
    let settings = Settings::new(width, height, filter);
    let (picture, stats) = render::render(&Prepared::new(scene), &settings, &|_, _| {});
    assert_eq!(stats.not_finite, 0);
    picture
}

/// Returns a picture file of `width` columns of 8-bit texels, row by row from the top.
pub fn png(width: usize, texels: &[[u8; 3]]) -> Vec<u8> {
    let texel = |x: u32, y: u32| Rgb(texels[y as usize * width + x as usize]);
    let picture = RgbImage::from_fn(width as u32, (texels.len() / width) as u32, texel);
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// Returns the pixel in column `x` and row `y`.
pub fn at(picture: &Picture, x: u32, y: u32) -> [f32; 3] {
    picture.pixels[(y * picture.width + x) as usize]
}

/// Returns every pixel with its column and row.
pub fn pixels(picture: &Picture) -> impl Iterator<Item = (u32, u32, [f32; 3])> {
    let width = picture.width;
    picture.pixels.iter().zip(0..).map(move |(&pixel, k)| (k % width, k / width, pixel))
}

/// Returns the point of the plane z = 0 that the ray through the middle of a pixel meets, with the
/// camera of [`scene`].
pub fn on_film(x: u32, y: u32, side: u32) -> [f64; 2] {
    let middle = |k: u32| (2.0 * f64::from(k) + 1.0) / f64::from(side) - 1.0;
    [middle(x), -middle(y)]
}

/// Checks that all channels of all pixels of two pictures differ by at most `tolerance`.
#[track_caller]
pub fn assert_near(left: &Picture, right: &Picture, tolerance: f32) {
    assert_eq!((left.width, left.height), (right.width, right.height));
    for ((x, y, left), right) in pixels(left).zip(&right.pixels) {
        let near = left.iter().zip(right).all(|(l, r)| (l - r).abs() <= tolerance);
        assert!(near, "at column {x}, row {y}: {left:?} and {right:?}");
    }
}
