//! `checkerboard.png`: eight by eight checks of ivory and oxblood, tileable in both directions, for
//! the floor of thesis figures A.10 and A.11.
//!
//! Every check is a whole number of texels and every texel has one of two colours. Only the
//! renderer softens the edges.

use image::{Rgb, RgbImage};

/// Texels along a side of the picture.
const SIZE: u32 = 256;
/// Texels along a side of a check.
const CHECK: u32 = SIZE / 8;

const IVORY: Rgb<u8> = Rgb([0xf1, 0xe6, 0xcf]);
const OXBLOOD: Rgb<u8> = Rgb([0x5a, 0x1e, 0x22]);

/// Draws the checkerboard. The bottom left check, where `u` and `v` begin, is light, as in
/// `peer-checker.png`.
pub fn draw() -> RgbImage {
    RgbImage::from_fn(SIZE, SIZE, |x, y| {
        if (x / CHECK + y / CHECK).is_multiple_of(2) { OXBLOOD } else { IVORY }
    })
}
