//! `floor-tiles.png`: octagons of sandstone and squares of terracotta, tileable in both directions.
//!
//! Four by four octagons stand on a square lattice; where four of them meet, a small square stands
//! on its corner. Every second octagon is grey, with a star let into it. Each tile has its own
//! tone, as if cut from its own block, and thin joints run between them.

use super::canvas;
use super::color::{Color, srgb};
use super::noise::{cloud, hash, unit};
use super::shape::{diamond, disc, fold_eight, stroke};
use glam::{DVec2, IVec2};
use image::RgbImage;

/// Texels along a side of the picture.
const SIZE: u32 = 512;
/// Octagons along a side of the picture.
const TILES: i32 = 4;
/// Texels from one octagon to the next.
const PITCH: f64 = SIZE as f64 / TILES as f64;
/// Texels from the middle of a small square to its corners.
const SQUARE: f64 = 35.0;
/// Texels between two tiles.
const JOINT: f64 = 3.0;

/// The colours of the stones and of the joints.
#[derive(Debug)]
struct Stones {
    sand: Color,
    warm_grey: Color,
    terracotta: Color,
    slate: Color,
    lime: Color,
}

impl Stones {
    fn new() -> Self {
        Self {
            sand: srgb(0xd9_c6_a5),
            warm_grey: srgb(0xb9_ad_9c),
            terracotta: srgb(0xa8_5f_45),
            slate: srgb(0x5c_5a_5c),
            lime: srgb(0x8d_82_75),
        }
    }
}

/// Draws the floor.
pub fn draw() -> RgbImage {
    let stones = Stones::new();
    canvas::draw(SIZE, SIZE, |texel| color_at(texel, &stones))
}

fn color_at(texel: DVec2, stones: &Stones) -> Color {
    let lattice = texel / PITCH;

    // The small squares stand on the integer lattice points, the octagons between them.
    let corner = lattice.round();
    let square = diamond(texel - corner * PITCH, SQUARE);
    if square < -JOINT / 2.0 {
        let color = worn(stones.terracotta, square, lattice);
        return color * tone(corner.as_ivec2(), 1);
    }

    let cell = lattice.floor();
    let p = texel - (cell + DVec2::splat(0.5)) * PITCH;
    let octagon = (p.x.abs().max(p.y.abs()) - PITCH / 2.0).max(-square);
    if octagon > -JOINT / 2.0 {
        return stones.lime;
    }
    let cell = cell.as_ivec2();
    let has_star = (cell.x + cell.y) % 2 == 0;
    let stone = if has_star { star(p, stones) } else { stones.sand };
    worn(stone, octagon, lattice) * tone(cell, 2)
}

/// Returns the colour of the grey octagon's inlay: a flower in a star of slate in a ring of
/// terracotta.
fn star(p: DVec2, stones: &Stones) -> Color {
    let ring = stroke(disc(p, 44.0), 3.0);
    // Two squares, one of them on its corner, have eight points.
    let upright = p.x.abs().max(p.y.abs()) - 25.0;
    let tilted = diamond(p, 25.0 * std::f64::consts::SQRT_2);
    let star = upright.min(tilted);
    let folded = fold_eight(p);
    let flower = disc(DVec2::new(folded.x * 2.2, folded.y - 10.0), 8.5);
    if disc(p, 3.5) < 0.0 {
        stones.terracotta
    } else if flower < 0.0 {
        stones.sand
    } else if star < 0.0 {
        stones.slate
    } else if ring < 0.0 {
        stones.terracotta
    } else {
        stones.warm_grey
    }
}

/// Returns the colour of stone with its clouds, darker towards the tile's edge at `distance` 0.
fn worn(stone: Color, distance: f64, lattice: DVec2) -> Color {
    let edge = 1.0 - 0.10 * (1.0 + (distance + JOINT / 2.0) / 4.0).max(0.0);
    let period = IVec2::splat(TILES * 6);
    stone * edge * (0.94 + 0.12 * cloud(lattice * 6.0, period, 7))
}

/// Returns the lightness factor of one tile among tiles of its kind.
fn tone(tile: IVec2, kind: u32) -> f64 {
    0.88 + 0.20 * unit(hash(tile.rem_euclid(IVec2::splat(TILES)), kind))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_repeats_both_ways() {
        let stones = Stones::new();
        let at = |texel| color_at(texel, &stones);
        canvas::assert_repeats(SIZE, DVec2::new(f64::from(SIZE), 0.0), at);
        canvas::assert_repeats(SIZE, DVec2::new(0.0, f64::from(SIZE)), at);
    }
}
