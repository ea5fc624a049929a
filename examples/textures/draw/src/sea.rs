//! `sea.png`: the sea from above in a fresh wind, tileable in both directions, for the sea of
//! thesis figures A.8 and A.9. Long swells and short chop have sharp crests, with foam where both
//! are high.

use super::canvas;
use super::color::{Color, srgb};
use super::noise::cloud;
use glam::{DVec2, IVec2};
use image::RgbImage;

/// Texels along a side of the picture.
const SIZE: u32 = 256;
/// The trains of waves: the number of waves across and down the picture, and their relative height.
const TRAINS: [([i32; 2], f64); 9] = [
    ([2, 3], 1.0),
    ([1, 5], 0.8),
    ([-2, 5], 0.55),
    ([4, 9], 0.5),
    ([-3, 10], 0.42),
    ([7, 13], 0.36),
    ([-6, 17], 0.3),
    ([3, 23], 0.26),
    ([-11, 25], 0.2),
];

/// The colours of water, the deepest first, and of foam.
#[derive(Debug)]
struct Water {
    depths: [Color; 4],
    foam: Color,
}

impl Water {
    fn new() -> Self {
        Self {
            depths: [srgb(0x0e_3a_52), srgb(0x1a_5a_74), srgb(0x36_86_99), srgb(0x7c_bb_bd)],
            foam: srgb(0xee_f3_ee),
        }
    }
}

/// Draws the sea.
pub fn draw() -> RgbImage {
    let water = Water::new();
    canvas::draw(SIZE, SIZE, |texel| color_at(texel / f64::from(SIZE), &water))
}

/// Returns the colour at `p`, where the picture is the unit square.
fn color_at(p: DVec2, water: &Water) -> Color {
    let height = height(p);
    // Light comes from the upper left: slopes that face it are brighter.
    let toward = DVec2::new(-0.6, -0.8) * 0.002;
    let slope = (height - self::height(p + toward)) / 0.002;
    let tone = (0.5 + 0.5 * height - 0.014 * slope).clamp(0.0, 1.0);
    let body = shade(tone, &water.depths);
    let streaks = cloud(p * 48.0, IVec2::splat(48), 17);
    let foam = ((height - 0.36) * 5.0).clamp(0.0, 1.0) * ((streaks - 0.42) * 5.0).clamp(0.0, 1.0);
    body + (water.foam - body) * foam
}

/// Returns the height of the water, in [-1, 1].
fn height(p: DVec2) -> f64 {
    // The plane is warped by a few hundredths of the picture, periodically, so that crests are not
    // straight.
    let wobble = |seed| cloud(p * 9.0, IVec2::splat(9), seed) - 0.5;
    let p = p + DVec2::new(wobble(3), wobble(7)) * 0.11;
    let (mut sum, mut most) = (0.0, 0.0);
    for ([x, y], size) in TRAINS {
        sum += size * wave(p.dot(DVec2::new(f64::from(x), f64::from(y))));
        most += size;
    }
    // Trains seldom have their crests together. The factor leaves foam to crests that do.
    (1.9 * sum / most).clamp(-1.0, 1.0)
}

/// Returns a wave of period 1 in [-1, 1], flat in the trough and sharp at the crest: two parabolas.
fn wave(phase: f64) -> f64 {
    let t = 2.0 * (phase - phase.floor()) - 1.0;
    2.0 * t * t - 1.0
}

/// Returns the colour at `tone` in `[0, 1]` on a ramp.
fn shade(tone: f64, ramp: &[Color; 4]) -> Color {
    let at = tone * 3.0;
    let k = (at as usize).min(2);
    ramp[k] + (ramp[k + 1] - ramp[k]) * (at - k as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sea_repeats_both_ways() {
        let water = Water::new();
        let at = |texel: DVec2| color_at(texel / f64::from(SIZE), &water);
        let side = f64::from(SIZE);
        canvas::assert_repeats(SIZE, DVec2::new(side, 0.0), at);
        canvas::assert_repeats(SIZE, DVec2::new(0.0, -side), at);
    }

    #[test]
    fn a_wave_is_as_often_below_as_above_its_quarter() {
        assert_eq!((wave(0.0), wave(0.5), wave(-3.0)), (1.0, -1.0, 1.0));
        let mean = (0..1000).map(|k| wave(f64::from(k) / 1000.0)).sum::<f64>() / 1000.0;
        assert!((mean + 1.0 / 3.0).abs() < 1e-3);
    }
}
