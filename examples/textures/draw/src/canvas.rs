//! Draws a picture from the colour at each point, with supersampling.

use super::color::{Color, Encoder};
use glam::DVec2;
use image::{Rgb, RgbImage};
use rayon::prelude::*;

/// Number of points along each side of a texel. A texel is the mean, in linear light, of `GRID` x
/// `GRID` points.
const GRID: u32 = 4;

/// Draws a picture from the colour at each point.
///
/// Points are in texels, `x` to the right, `y` down from the top left corner of the picture:
///
/// ```text
/// (0, 0) ──────── x ──────> (width, 0)
///   │
///   y
///   v
/// (0, height)               (width, height)
/// ```
pub fn draw(width: u32, height: u32, color_at: impl Fn(DVec2) -> Color + Sync) -> RgbImage {
    let encoder = Encoder::new();
    let mut picture = RgbImage::new(width, height);
    picture.enumerate_rows_mut().par_bridge().for_each(|(_, row)| {
        for (x, y, texel) in row {
            let corner = DVec2::new(f64::from(x), f64::from(y));
            let mut sum = Color::ZERO;
            for j in 0..GRID {
                for i in 0..GRID {
                    let inside = DVec2::new(f64::from(i) + 0.5, f64::from(j) + 0.5);
                    sum += color_at(corner + inside / f64::from(GRID));
                }
            }
            *texel = Rgb(encoder.bytes(sum / f64::from(GRID * GRID)));
        }
    });
    picture
}

/// Asserts that the colours repeat after `step`, at every texel's middle of a square picture.
///
/// Rounding may move a point near an edge to either side of the edge. So one point in a thousand
/// may differ.
#[cfg(test)]
pub fn assert_repeats(size: u32, step: DVec2, color_at: impl Fn(DVec2) -> Color) {
    let middle = |i| DVec2::new(f64::from(i % size) + 0.5, f64::from(i / size) + 0.5);
    let differs = |p: &DVec2| color_at(*p).distance(color_at(*p + step)) > 1e-9;
    let differing = (0..size * size).map(middle).filter(differs).count();
    assert!(differing <= (size * size / 1000) as usize, "{differing} texels differ");
}
