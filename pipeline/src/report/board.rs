//! A scene whose pixels are known exactly: checks seen vertically from above.

use crate::pages;
use files::json::Document;
use render::scene::{MeshSource, read};
use render::{Picture, Scene};
use std::path::Path;

/// Height of the eye above the board, in scene units. The checks are half a unit wide.
const HEIGHT: f64 = 10.0;

/// Side of the visible square, in scene units. The value makes pixels cut checks at varying positions.
const SEEN: f64 = 7.3;

/// The point of the board in the middle of the picture: x and z.
const MIDDLE: [f64; 2] = [0.13, -0.21];

/// Returns the board with the texture of the scenes on which other renderers were measured.
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

/// Returns the picture of the board without any noise, `side * side` pixels, linear RGB.
///
/// Interpolated checks are a mean plus a product of two waves, one along each axis. So a pixel is the
/// mean plus the product of the two waves' averages over the pixel's sides. Fine sums compute these
/// averages.
pub fn exact(side: u32) -> Picture {
    let [dark, light] = [26.0 / 255.0, 230.0 / 255.0];
    let averages = |middle: f64| -> Vec<f64> {
        let pixel = SEEN / f64::from(side);
        let average = |k: u32| {
            let start = middle - 0.5 * SEEN + f64::from(k) * pixel;
            // The sum over the middles of the parts is exact, except for parts in which the wave bends.
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

/// Returns 1 for x between 0 and half a unit, -1 in the next half unit, and so on. At a border the wave
/// runs straight from one value to the other, between the middles of the two texels beside the border.
/// A unit has 128 texels.
fn wave(x: f64) -> f64 {
    let border = (2.0 * x).round() * 0.5;
    let away = (x - border) * 128.0;
    let sign = if (2.0 * border).rem_euclid(2.0) < 0.5 { 1.0 } else { -1.0 };
    sign * (2.0 * away).clamp(-1.0, 1.0)
}
