//! `drawing-board.png`: pale paper ruled in squares, tileable in both directions, for the ground
//! under the pages of the gallery.

use super::canvas;
use super::color::{Color, srgb};
use glam::DVec2;
use image::RgbImage;

/// Texels along a side of the picture.
const SIZE: u32 = 256;
/// Number of squares along a side of the picture.
const SQUARES: f64 = 4.0;

/// Draws the drawing board.
pub fn draw() -> RgbImage {
    let [paper, fine, bold] = [0xd9_d6_ce, 0xb9_bd_be, 0x9f_a8_ae].map(srgb);
    canvas::draw(SIZE, SIZE, |texel| color_at(texel, paper, fine, bold))
}

/// Returns the colour at `p` in texels: a bold line around the picture, fine ones within.
fn color_at(p: DVec2, paper: Color, fine: Color, bold: Color) -> Color {
    let to_line = |pitch: f64| {
        let off = (p / pitch - (p / pitch).round()).abs() * pitch;
        off.min_element()
    };
    if to_line(f64::from(SIZE)) < 2.0 {
        bold
    } else if to_line(f64::from(SIZE) / SQUARES) < 1.1 {
        fine
    } else {
        paper
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_squares_repeat_both_ways() {
        let side = f64::from(SIZE);
        let [paper, fine, bold] = [1.0, 2.0, 3.0].map(Color::splat);
        let at = |texel| color_at(texel, paper, fine, bold);
        canvas::assert_repeats(SIZE, DVec2::new(side, 0.0), at);
        canvas::assert_repeats(SIZE, DVec2::new(0.0, side), at);
    }
}
