//! `scales.png`: heights of two rows of scales, in grey, tileable in both directions.
//!
//! Each scale is a shield that hangs from above, highest along its lower rim. The shield lies over
//! two scales of the row below. White is highest.

use image::{Rgb, RgbImage};

/// Texels across and up: the width of one scale, and the height of two rows of scales.
const SIZE: u32 = 64;

/// Draws the heights.
pub fn draw() -> RgbImage {
    RgbImage::from_fn(SIZE, SIZE, |x, y| {
        let part = |texel: u32| (f64::from(texel) + 0.5) / f64::from(SIZE);
        let grey = (255.0 * height(part(x), 2.0 * part(y))).round() as u8;
        Rgb([grey; 3])
    })
}

/// Returns the height at a position: `x` counts scales, `y` rows of scales from the top.
fn height(x: f64, y: f64) -> f64 {
    // A scale hangs down over a row and a half, and the upper ones lie on top.
    for row in [y.floor() - 1.0, y.floor()] {
        let shifted = x + 0.5 * row.rem_euclid(2.0);
        let side = 2.0 * (shifted - shifted.floor()) - 1.0;
        let down = (y - row) / 1.5;
        let rim = side * side + down * down;
        if rim < 1.0 {
            // The profile of a scale: a keel along the middle, and a soft rim.
            let keel = 1.0 - 0.25 * side * side;
            let soft = ((1.0 - rim) * 6.0).min(1.0);
            return (0.25 + 0.75 * down) * keel * soft;
        }
    }
    0.0
}
