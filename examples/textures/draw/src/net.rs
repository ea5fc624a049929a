//! `net.png`: four by four checks in two light greys between dark lines, tileable in both
//! directions. The net shows how parameters run over a surface, in the colour of the surface's
//! material.

use super::canvas;
use super::color::{Color, srgb};
use glam::DVec2;
use image::RgbImage;

/// Texels along a side of the picture.
const SIZE: u32 = 256;
/// Texels along a side of a check. The pattern repeats after two checks.
const CHECK: f64 = 64.0;
/// Half the width of a line, in texels.
const HALF_LINE: f64 = 3.0;

/// Draws the net.
pub fn draw() -> RgbImage {
    let [light, dim, line] = [0xfa_f8_f2, 0xd8_d6_d0, 0x50_54_5c].map(srgb);
    canvas::draw(SIZE, SIZE, |texel| color_at(texel, light, dim, line))
}

/// Returns the colour at `p` in texels.
fn color_at(p: DVec2, light: Color, dim: Color, line: Color) -> Color {
    let cell = p / CHECK;
    let off = (cell - cell.round()).abs() * CHECK;
    if off.min_element() < HALF_LINE {
        return line;
    }
    let check = cell.floor();
    if (check.x + check.y).rem_euclid(2.0) < 1.0 { light } else { dim }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_net_repeats_both_ways() {
        let side = f64::from(SIZE);
        let [light, dim, line] = [1.0, 2.0, 3.0].map(Color::splat);
        let at = |texel| color_at(texel, light, dim, line);
        canvas::assert_repeats(SIZE, DVec2::new(side, 0.0), at);
        canvas::assert_repeats(SIZE, DVec2::new(0.0, side), at);
    }
}
