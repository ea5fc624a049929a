//! Two scenes whose pictures are known from an independent renderer, at 4096 samples per pixel.
//!
//! Both scenes show a checkered floor without lights, and above it a ball of Fresnel glass or a
//! mirror tube of 10,000 quads. The lowest quarter of both pictures shows the floor alone. The
//! tolerances are a few times the error of 16 regular samples per pixel at the edges of the checks.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::Disk;
use files::json::Document;
use render::filter::Filter;
use render::scene::{MeshSource, read};
use render::{Picture, Prepared, Scene, Settings};
use std::path::Path;

const SIDE: u32 = 128;

/// Mean light of the floor in the lowest quarter of both pictures, in four blocks from left to
/// right.
const BLOCKS: [f64; 4] = [0.4775, 0.5348, 0.4691, 0.5264];

fn scene(name: &str) -> Scene {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/scenes");
    let path = Path::new(folder).join(name);
    let text = std::fs::read(&path).unwrap();
    let document = Document::new(name, &text).unwrap();
    let file = read::parse(&document).unwrap();
    read::resolve(&document, &file, Path::new(folder), &Disk, MeshSource::new()).unwrap()
}

fn mean(picture: &Picture, columns: std::ops::Range<u32>, rows: std::ops::Range<u32>) -> f64 {
    let count = f64::from((columns.end - columns.start) * (rows.end - rows.start));
    let lights = rows.flat_map(|y| columns.clone().map(move |x| (y * SIDE + x) as usize));
    lights.map(|k| f64::from(picture.pixels[k][0])).sum::<f64>() / count
}

fn check(scene: &Scene, samples: u32, filter: Filter, truth: f64) {
    let settings = Settings::new(SIDE, SIDE, filter).with_samples(samples);
    let (picture, _) = render::render(&Prepared::new(scene), &settings, &|_, _| {});
    let quarter = SIDE / 4;
    let blocks: Vec<f64> =
        (0..4).map(|k| mean(&picture, k * quarter..(k + 1) * quarter, 3 * quarter..SIDE)).collect();
    let whole = mean(&picture, 0..SIDE, 0..SIDE);
    assert!((whole - truth).abs() < 0.001, "{filter:?}: {whole}, expected {truth}");
    for (block, truth) in blocks.iter().zip(BLOCKS) {
        assert!((block - truth).abs() < 0.003, "{filter:?}: {blocks:?}, expected {BLOCKS:?}");
    }
}

#[test]
fn a_glass_ball_is_as_bright_as_elsewhere() {
    let scene = scene("peer-glass.json");
    check(&scene, 4, Filter::Point, 0.3126);
    check(&scene, 4, Filter::Bilinear, 0.3126);
    check(&scene, 2, Filter::Tent, 0.3126);
}

#[test]
fn a_mirror_tube_is_as_bright_as_elsewhere() {
    let scene = scene("peer-tube.json");
    check(&scene, 4, Filter::Point, 0.3076);
    check(&scene, 4, Filter::Bilinear, 0.3076);
    check(&scene, 2, Filter::Tent, 0.3076);
}
