//! The exact filter on pixels that see a textured floor, against brute force.
//!
//! The bench `filters` measures the same on more pixels, and every other filter.

#[allow(dead_code, reason = "the test and the measurement each use their part")]
#[path = "../benches/filters/floor.rs"]
mod floor;
#[allow(dead_code, reason = "the test and the measurement each use their part")]
#[path = "../benches/filters/textures.rs"]
mod textures;

use floor::{ANGLES, Pixel, STRETCHES, Set};
use glam::DVec2;
use rayon::prelude::*;
use render::filter::{Filter, FilteredTexture};
use render::footprint::Footprint;

/// Few pixels, with the truth of the full set.
const FEW: Set = Set { anisotropies: 16, places: 2, samples: 96, tent: false };

/// Parts of the pixel along each side for the finer average.
const PARTS: u32 = 4;

/// The error of a pixel from 0 to 1: over the whole quadrilateral, and over its parts.
struct Seen {
    /// Indices of texture, angle and stretch.
    kind: [usize; 3],
    whole: f64,
    parts: f64,
}

fn seen(pixel: &Pixel, texture: &FilteredTexture<'_>, truth: f64) -> Seen {
    let average = |low: DVec2, side: f64| {
        let corners = pixel.corners(low, low + side);
        texture.average(&Footprint::Quadrilateral(corners)).x
    };
    let side = 1.0 / f64::from(PARTS);
    let cells = (0..PARTS * PARTS).map(|k| DVec2::new((k % PARTS).into(), (k / PARTS).into()));
    let parts: f64 = cells.map(|cell| average(cell * side - 0.5, side)).sum();
    Seen {
        kind: [pixel.texture, pixel.angle, pixel.stretch()],
        whole: average(DVec2::splat(-0.5), 1.0) - truth,
        parts: parts * side * side - truth,
    }
}

fn rms(errors: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) =
        errors.fold((0, 0.0), |(count, sum), error| (count + 1, sum + error * error));
    (sum / f64::from(count)).sqrt()
}

#[test]
fn the_exact_filter_is_near_the_truth_on_a_floor() {
    let textures = textures::all();
    let ready: Vec<FilteredTexture<'_>> =
        textures.iter().map(|(_, texture)| FilteredTexture::new(texture, Filter::Exact)).collect();
    let pixels = floor::pixels(textures.len(), FEW);
    let seen: Vec<Seen> = pixels
        .par_iter()
        .map(|pixel| {
            let [truth, _] = pixel.truth(&textures[pixel.texture].1, FEW);
            seen(pixel, &ready[pixel.texture], truth.x)
        })
        .collect();
    // The targets are multiples of the 8-bit code, 0.0039. Bilinear interpolation has 0.25.
    let whole = rms(seen.iter().map(|seen| seen.whole));
    assert!(whole <= 4.5e-3, "{whole}");
    let parts = rms(seen.iter().map(|seen| seen.parts));
    assert!(parts <= 3.0e-3 && parts < whole, "{parts}");
    let largest = seen.iter().map(|seen| seen.whole.abs()).fold(0.0, f64::max);
    assert!(largest <= 60e-3, "{largest}");
    for (at, values) in [textures.len(), ANGLES.len(), STRETCHES.len()].into_iter().enumerate() {
        for value in 0..values {
            let own = rms(seen.iter().filter(|s| s.kind[at] == value).map(|s| s.whole));
            assert!(own <= 5.0e-3, "kind {at}, number {value}: {own}");
        }
    }
}
