//! A scene whose pixels are known: checks that are looked at straight from above.

use crate::pages;
use files::json::Document;
use render::scene::{MeshSource, read};
use render::{Picture, Scene};
use std::path::Path;

/// The board is seen from this height; its checks are half a unit wide.
const HEIGHT: f64 = 10.0;

/// Width and height of what is seen: pixels cut checks in ever other places.
const SEEN: f64 = 7.3;

/// Where the middle of the picture is.
const MIDDLE: [f64; 2] = [0.13, -0.21];

/// The board, by the texture of the scenes that other renderers were measured on.
pub fn scene() -> Scene {
    let fov = 2.0 * (0.5 * SEEN / HEIGHT).atan().to_degrees();
    let [x, z] = MIDDLE;
    let text = format!(
        r#"{{"format": "tb-scene", "version": 1,
        "camera": {{"eye": [{x}, {HEIGHT}, {z}], "target": [{x}, 0, {z}], "up": [0, 0, -1], "fov_deg": {fov}}},
        "background": 0, "ambient": 1,
        "textures": {{"checks": {{"image": "peer-checker.png", "wrap": "repeat", "values": "linear"}}}},
        "materials": {{"unlit": {{"ambient": 1, "diffuse": 0}}}},
        "objects": [{{"rectangle": {{"corner": [-40, 0, -40], "edge_u": [0, 0, 80], "edge_v": [80, 0, 0],
                     "repeat": [20, 20], "material": "unlit", "texture": "checks"}}}}]}}"#
    );
    let document = Document::new("board.json", text.as_bytes()).unwrap();
    let file = read::parse(&document).unwrap();
    let folder = Path::new("examples/textures");
    read::resolve(&document, &file, folder, &pages::FILES, MeshSource::new()).unwrap()
}

/// The picture of the board without any noise, of `side * side` pixels.
///
/// Interpolated checks are a mean plus a product of two waves, one along each axis; so a pixel is the mean
/// plus the product of the waves' averages over its sides, which are summed up finely.
pub fn exact(side: u32) -> Picture {
    let [dark, light] = [26.0 / 255.0, 230.0 / 255.0];
    let averages = |middle: f64| -> Vec<f64> {
        let pixel = SEEN / f64::from(side);
        let average = |k: u32| {
            let start = middle - 0.5 * SEEN + f64::from(k) * pixel;
            // The middles of so many parts: their sum is exact but for the parts where the wave bends.
            let parts = 20_000;
            let wave = |i: u32| wave(start + (f64::from(i) + 0.5) * pixel / f64::from(parts));
            (0..parts).map(wave).sum::<f64>() / f64::from(parts)
        };
        (0..side).map(average).collect()
    };
    let (across, down) = (averages(MIDDLE[0]), averages(MIDDLE[1]));
    let mut picture = Picture::black(side, side);
    for (pixel, (down, across)) in
        picture.pixels.iter_mut().zip(down.iter().flat_map(|d| across.iter().map(move |a| (d, a))))
    {
        let value = 0.5 * (light + dark) + 0.5 * (light - dark) * down * across;
        *pixel = [value as f32; 3];
    }
    picture
}

/// 1 between 0 and half a unit, -1 in the next, and between the texels at a border, of which 128 are a unit
/// long, straight from one to the other.
fn wave(x: f64) -> f64 {
    let border = (2.0 * x).round() * 0.5;
    let away = (x - border) * 128.0;
    let sign = if (2.0 * border).rem_euclid(2.0) < 0.5 { 1.0 } else { -1.0 };
    sign * (2.0 * away).clamp(-1.0, 1.0)
}
