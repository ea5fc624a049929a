//! `granite.png`: pink granite, tileable in both directions, for the floor of thesis figure A.1.
//!
//! Grains have four sizes, each from cells of its own: the ground of feldspar and quartz, the
//! crystals within the ground's grains, flakes of black mica in the ground, and pepper. The cells
//! are cut from a warped plane, so that no boundary is straight.

use super::canvas;
use super::color::{Color, srgb};
use super::noise::{Grain, cloud, grain, unit};
use glam::{DVec2, IVec2};
use image::RgbImage;

/// Texels along a side of the picture.
const SIZE: u32 = 256;
/// Number of cells along a side of the picture, for the ground.
const GROUND: i32 = 32;
/// Number of cells along a side, for the crystals within the ground's grains.
const CRYSTAL: i32 = 110;
/// Number of cells along a side, for the mica.
const MICA: i32 = 46;
/// Number of cells along a side, for the pepper.
const PEPPER: i32 = 96;

/// The minerals.
#[derive(Debug)]
struct Minerals {
    pink_feldspar: Color,
    cream_feldspar: Color,
    quartz: Color,
    mica: Color,
}

impl Minerals {
    fn new() -> Self {
        Self {
            pink_feldspar: srgb(0xc2_a1_94),
            cream_feldspar: srgb(0xd6_ca_be),
            quartz: srgb(0xaa_a4_9f),
            mica: srgb(0x3a_37_38),
        }
    }
}

/// Draws the granite.
pub fn draw() -> RgbImage {
    let minerals = Minerals::new();
    canvas::draw(SIZE, SIZE, |texel| color_at(texel / f64::from(SIZE), &minerals))
}

/// Returns the colour at `p`, where the picture is the unit square.
fn color_at(p: DVec2, minerals: &Minerals) -> Color {
    let ragged = warped(p);
    let cells = |count: i32, seed| grain(ragged * f64::from(count), IVec2::splat(count), seed);

    let pepper = cells(PEPPER, 31);
    if is_flake(pepper, 0.13, 0.50) {
        return minerals.mica * 1.5;
    }
    let mica = cells(MICA, 21);
    if is_flake(mica, 0.24, 0.66) {
        // Flakes glint: each flake has its own grey.
        return minerals.mica * (0.7 + 1.2 * share(mica, 4));
    }
    // A grain of feldspar is no single crystal: finer cells break up its tone.
    let crystal = 0.84 + 0.30 * share(cells(CRYSTAL, 41), 1);
    ground(cells(GROUND, 11), minerals) * crystal
}

/// Moves a point by a few thousandths of the picture, smoothly and periodically.
fn warped(p: DVec2) -> DVec2 {
    let wobble = |seed| cloud(p * 34.0, IVec2::splat(34), seed) - 0.5;
    p + DVec2::new(wobble(1), wobble(5)) * 0.034
}

/// Returns true if the cell holds a flake and the flake covers the point. The fraction `portion` of
/// all cells holds a flake. A flake has a radius of at most `reach` cells.
fn is_flake(cell: Grain, portion: f64, reach: f64) -> bool {
    share(cell, 0) < portion && cell.distance < reach * (0.5 + 0.5 * share(cell, 2))
}

/// Returns the colour of feldspar or quartz. Each grain has its own tone, darker along the
/// boundaries.
fn ground(cell: Grain, minerals: &Minerals) -> Color {
    let mineral = match share(cell, 0) {
        s if s < 0.42 => minerals.pink_feldspar,
        s if s < 0.72 => minerals.cream_feldspar,
        _ => minerals.quartz,
    };
    let boundary = 1.0 - 0.22 * (1.0 - cell.margin / 0.16).max(0.0);
    mineral * (0.86 + 0.24 * share(cell, 3)) * boundary
}

/// Returns a number in `[0, 1)` that belongs to a grain; `which` distinguishes the uses of such
/// numbers.
fn share(cell: Grain, which: u32) -> f64 {
    unit(cell.hash.rotate_left(7 * which).wrapping_mul(0x85eb_ca6b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn granite_repeats_both_ways() {
        let minerals = Minerals::new();
        let side = f64::from(SIZE);
        let at = |texel| color_at(texel / side, &minerals);
        canvas::assert_repeats(SIZE, DVec2::new(side, 0.0), at);
        canvas::assert_repeats(SIZE, DVec2::new(0.0, side), at);
    }
}
