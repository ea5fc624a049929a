//! `ribbon.png`: slanting stripes in two light greys with a dark line between them, tileable in
//! both directions. Around a tube the stripes wind as on a barber's pole, in the colour of the
//! tube's material.

use super::canvas;
use super::color::{Color, srgb};
use glam::DVec2;
use image::RgbImage;

/// Texels along a side of the picture.
const SIZE: u32 = 128;

/// Draws the ribbon.
pub fn draw() -> RgbImage {
    let [light, dim, line] = [0xfa_f8_f2, 0x84_88_90, 0x48_4c_56].map(srgb);
    canvas::draw(SIZE, SIZE, |texel| color_at(texel / f64::from(SIZE), light, dim, line))
}

/// Returns the colour at `p`, where the picture is the unit square.
fn color_at(p: DVec2, light: Color, dim: Color, line: Color) -> Color {
    let across = (p.x + p.y).rem_euclid(1.0);
    match across {
        a if a < 0.62 => light,
        a if !(0.65..0.97).contains(&a) => line,
        _ => dim,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stripes_repeat_both_ways() {
        let side = f64::from(SIZE);
        let [light, dim, line] = [1.0, 2.0, 3.0].map(Color::splat);
        let at = |texel: DVec2| color_at(texel / side, light, dim, line);
        canvas::assert_repeats(SIZE, DVec2::new(side, 0.0), at);
        canvas::assert_repeats(SIZE, DVec2::new(0.0, side), at);
    }
}
