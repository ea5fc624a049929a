//! `hatching.png`: a fine net as an engraver lays it over a surface: rings across it, thinner lines
//! along it, and every seventh ring bold. The picture is tileable in both directions and is its own
//! mirror image. So it also closes where a surface returns with its other side out. The seam lies
//! between two rings.

use super::canvas;
use super::color::{Color, srgb};
use glam::DVec2;
use image::RgbImage;

/// Texels along a side of the picture.
const SIZE: u32 = 256;
/// Texels from one line along the surface to the next.
const ALONG_PITCH: f64 = 32.0;
/// Texels from one ring to the next.
const RING_PITCH: f64 = SIZE as f64 / 7.0;
/// Width of a ring, in texels.
const RING: f64 = 9.0;
/// Width of a bold ring, in texels.
const BOLD: f64 = 17.0;
/// Width of a line along the surface, in texels.
const ALONG: f64 = 3.5;

/// Draws the hatching.
pub fn draw() -> RgbImage {
    let [ground, line, bold] = [0xfa_f6_ec, 0x74_70_70, 0x3c_3a_40].map(srgb);
    canvas::draw(SIZE, SIZE, |texel| color_at(texel, ground, line, bold))
}

/// Returns the colour at `p` in texels.
fn color_at(p: DVec2, ground: Color, line: Color, bold: Color) -> Color {
    let off = |x: f64, pitch: f64| (x - (x / pitch).round() * pitch).abs();
    // The fourth of seven rings is in the middle.
    let middle = p.y - 0.5 * f64::from(SIZE);
    if off(middle, f64::from(SIZE)) < 0.5 * BOLD {
        bold
    } else if off(middle, RING_PITCH) < 0.5 * RING || off(p.x, ALONG_PITCH) < 0.5 * ALONG {
        line
    } else {
        ground
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hatching_repeats_both_ways_and_is_its_own_mirror_image() {
        let side = f64::from(SIZE);
        let [ground, line, bold] = [1.0, 2.0, 3.0].map(Color::splat);
        let at = |texel: DVec2| color_at(texel, ground, line, bold);
        canvas::assert_repeats(SIZE, DVec2::new(ALONG_PITCH, 0.0), at);
        canvas::assert_repeats(SIZE, DVec2::new(0.0, side), at);
        let drawn = draw();
        for (x, y, texel) in drawn.enumerate_pixels() {
            assert_eq!(texel, drawn.get_pixel(SIZE - 1 - x, y));
            assert_eq!(texel, drawn.get_pixel(x, SIZE - 1 - y));
        }
    }
}
