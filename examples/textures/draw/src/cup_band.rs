//! `cup-band.png`: the stripes of a cream cup, tileable around it.
//!
//! The picture's x axis goes once around the cup. Its y axis follows the contour, from the middle of
//! the foot up the outside, over the lip at half the height, and down the inside. Lengths here are in
//! texels, `y` upwards. Upright stripes come closer toward the foot, as the cup gets narrower there.
//!
//! ```text
//! 512 ┬─────────────────────────── middle of the inside
//!     │ cream, a ring below the lip
//! 272 ├─ lip
//! 250 ├─ beads
//! 222 ├─ stripes
//!  96 ├─ foot
//!   0 ┴─────────────────────────── middle of the foot
//! ```

use super::canvas;
use super::color::{Color, srgb};
use super::shape::{diamond, disc};
use glam::DVec2;
use image::RgbImage;

/// Texels around the cup, and along its contour.
const SIZE: u32 = 512;

/// The paints, and the cream below them.
#[derive(Debug)]
struct Paints {
    cream: Color,
    red: Color,
    ochre: Color,
}

impl Paints {
    fn new() -> Self {
        Self { cream: srgb(0xf0_e8_d6), red: srgb(0x9c_3a_26), ochre: srgb(0xc9_94_44) }
    }
}

/// Draws the stripes.
pub fn draw() -> RgbImage {
    let paints = Paints::new();
    canvas::draw(SIZE, SIZE, |p| color_at(DVec2::new(p.x, f64::from(SIZE) - p.y), &paints))
}

/// Returns the colour at a point, in texels.
fn color_at(p: DVec2, paints: &Paints) -> Color {
    match p.y {
        // The foot, and the rings around stripes and beads.
        70.0..84.0 | 90.0..94.0 | 216.0..219.0 | 223.0..225.0 | 247.0..249.0 => paints.red,
        // The lip.
        254.0..284.0 => paints.ochre,
        296.0..298.0 => paints.red,
        96.0..214.0 => stripes(p.x, paints),
        225.0..247.0 => beads(DVec2::new(p.x, p.y - 236.0), paints),
        _ => paints.cream,
    }
}

/// Returns the colour of the stripes: a broad stripe and two narrow ones, thirty-two times around
/// the cup.
fn stripes(x: f64, paints: &Paints) -> Color {
    match x.rem_euclid(16.0) {
        0.0..5.0 => paints.red,
        7.5..9.0 | 12.0..13.5 => paints.ochre,
        _ => paints.cream,
    }
}

/// Returns the colour of lozenges and beads in turn, thirty-two of each. `p.y` is in [-11, 11].
fn beads(p: DVec2, paints: &Paints) -> Color {
    let q = DVec2::new(p.x.rem_euclid(16.0) - 8.0, p.y);
    let beside = DVec2::new((p.x + 8.0).rem_euclid(16.0) - 8.0, p.y);
    if diamond(DVec2::new(q.x, q.y * 0.6), 5.2) < 0.0 {
        paints.red
    } else if disc(beside - DVec2::new(0.0, 6.5), 1.8) < 0.0
        || disc(beside + DVec2::new(0.0, 6.5), 1.8) < 0.0
    {
        paints.ochre
    } else {
        paints.cream
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stripes_close_around_the_cup() {
        let paints = Paints::new();
        canvas::assert_repeats(SIZE, DVec2::new(f64::from(SIZE), 0.0), |p| color_at(p, &paints));
    }
}
