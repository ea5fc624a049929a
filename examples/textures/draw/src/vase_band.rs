//! `vase-band.png`: the painted bands of a blue and white vase, tileable around it.
//!
//! The picture's x axis goes once around the vase. Its y axis follows the contour, from the middle
//! of the foot up the outside, over the lip and down the inside. Lengths here are in texels, `y`
//! upwards. Texels are about square where the girth is as long as the whole contour, as at the
//! belly of a usual vase. The bands of foot and neck are drawn wide because the vase narrows them.
//!
//! ```text
//! 768 ┬─────────────────────────── middle of the inside
//!     │ glaze
//! 435 ├─ gilt lip
//! 410 ├─ net
//! 383 ├─ stiff leaves
//! 320 ├─ meander
//! 272 ├─ vine with blossoms
//! 149 ├─ lotus petals
//!  78 ├─ foot
//!   0 ┴─────────────────────────── middle of the foot
//! ```
//!
//! Rings run between the bands. The rings, the net and the veins of the leaves are a texel or two
//! wide, so point sampling must alias on them.

use super::canvas;
use super::color::{Color, srgb};
use super::noise::cloud;
use super::shape::{COS_22_5, SIN_22_5};
use super::shape::{arch, diamond, disc, fold_eight, lens, seen_along, stroke};
use glam::{DVec2, IVec2};
use image::RgbImage;

/// Texels around the vase, and along its contour.
const SIZE: u32 = 768;

/// The paints, and the white below them.
#[derive(Debug)]
struct Paints {
    porcelain: Color,
    /// Cobalt as it flows off a full brush: outlines and rings.
    deep: Color,
    /// Cobalt of the filled shapes.
    cobalt: Color,
    /// Cobalt thinned with water.
    wash: Color,
    gold: Color,
}

impl Paints {
    fn new() -> Self {
        Self {
            porcelain: srgb(0xf0_f0_ea),
            deep: srgb(0x14_24_6b),
            cobalt: srgb(0x2b_4b_a8),
            wash: srgb(0x9f_b6_de),
            gold: srgb(0xc8_98_3c),
        }
    }
}

/// Draws the bands.
pub fn draw() -> RgbImage {
    let paints = Paints::new();
    canvas::draw(SIZE, SIZE, |p| color_at(DVec2::new(p.x, f64::from(SIZE) - p.y), &paints))
}

/// Returns the colour at a point: that of the paint there, or else of the glaze.
fn color_at(p: DVec2, paints: &Paints) -> Color {
    let above = |floor: f64| DVec2::new(p.x, p.y - floor);
    let painted = match p.y {
        80.0..140.0 => lotus_petals(above(80.0), paints),
        151.0..259.0 => vine(above(205.0), paints),
        274.0..309.0 => meander(above(274.0), paints),
        321.0..383.0 => stiff_leaves(above(321.0), paints),
        387.0..405.0 => net(above(387.0), paints),
        y => ring(y, paints),
    };
    painted.unwrap_or_else(|| glaze(p, paints))
}

/// Returns the colour of porcelain under its glaze, a little bluer where the glaze is thicker.
fn glaze(p: DVec2, paints: &Paints) -> Color {
    let thickness = cloud(p * 8.0 / f64::from(SIZE), IVec2::splat(8), 3);
    paints.porcelain.lerp(paints.wash, 0.02 + 0.16 * thickness * thickness)
}

/// Returns the colour of the rings of the foot, between the bands, and of the lip.
fn ring(y: f64, paints: &Paints) -> Option<Color> {
    let Paints { deep, cobalt, gold, .. } = *paints;
    let color = match y {
        // Under the foot, and the foot.
        18.0..20.0 | 23.0..24.0 => deep,
        58.0..69.0 => cobalt,
        69.0..72.0 => gold,
        73.0..75.0 | 77.0..78.0 => deep,
        // Between petals and vine.
        141.0..142.0 | 148.0..149.0 => deep,
        143.0..147.0 => gold,
        // Between vine and meander.
        261.0..262.0 | 268.0..269.0 | 271.0..272.0 => deep,
        263.0..267.0 => gold,
        // Between meander and leaves.
        311.0..312.0 | 318.0..320.0 => deep,
        313.0..317.0 => gold,
        // Around the net.
        384.0..385.0 | 407.0..408.0 => deep,
        // The lip, and within it.
        410.0..414.0 | 432.0..435.0 => cobalt,
        414.0..432.0 => gold,
        438.0..439.0 | 450.0..451.0 => deep,
        _ => return None,
    };
    Some(color)
}

/// Returns the colour of sixteen upright petals, and behind them the tips of sixteen more. `p.y` is
/// in [0, 60].
fn lotus_petals(p: DVec2, paints: &Paints) -> Option<Color> {
    const PITCH: f64 = 48.0;
    let q = DVec2::new(p.x.rem_euclid(PITCH) - PITCH / 2.0, p.y);
    let drop = lens(q - DVec2::new(0.0, 28.0), 11.0, 4.0);
    let scroll = stroke(disc(DVec2::new(q.x.abs() - 6.7, q.y - 10.0), 4.5), 1.6);
    let pearl = disc(q - DVec2::new(0.0, 10.0), 2.2);
    match petal_outline(q) {
        d if d > 0.0 => {
            let behind = DVec2::new((p.x + PITCH / 2.0).rem_euclid(PITCH) - PITCH / 2.0, p.y);
            shaded(petal_outline(behind), paints)
        }
        // From the outline inwards: a white margin, a second line, and a wash that thins out.
        d if d > -2.2 => Some(paints.deep),
        d if d > -5.0 => None,
        d if d > -6.5 => Some(paints.cobalt),
        _ if pearl < 0.0 => Some(paints.gold),
        _ if drop < 0.0 => Some(if drop > -1.5 { paints.deep } else { paints.gold }),
        _ if scroll < 0.0 => Some(paints.deep),
        d => Some(paints.wash.lerp(paints.porcelain, ((-6.5 - d) / 9.0).min(1.0))),
    }
}

fn petal_outline(p: DVec2) -> f64 {
    arch(p, 22.0, 25.0, 33.0)
}

/// Returns the colour of a shape behind others: outlined, light at its rim and dark where it is
/// covered.
fn shaded(distance: f64, paints: &Paints) -> Option<Color> {
    match distance {
        d if d > 0.0 => None,
        d if d > -1.7 => Some(paints.deep),
        d => Some(paints.wash.lerp(paints.cobalt, (-d / 7.0).min(1.0))),
    }
}

/// Returns the colour of the chief frieze: a vine that swings up and down eight times, a blossom in
/// every bend. `p.y` is in [-54, 54].
fn vine(p: DVec2, paints: &Paints) -> Option<Color> {
    /// Texels from one bend to the next.
    const BEND: f64 = 96.0;
    // Each bend is the previous one upside down. Leaves of the neighbouring bends reach into this
    // bend.
    let bend = (p.x / BEND).floor();
    let bends = [bend, bend - 1.0, bend + 1.0].map(|bend| {
        let up = if bend.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
        DVec2::new(p.x - bend * BEND, p.y * up)
    });
    let first =
        |part: fn(DVec2, &Paints) -> Option<Color>| bends.iter().find_map(|&q| part(q, paints));
    first(blossom).or_else(|| first(leaves)).or_else(|| first(stems))
}

/// Returns the colour of half a turn of the vine over the bend, and of the branch below it. The
/// branch curls back, first wide, then narrow, until it ends behind the blossom.
fn stems(q: DVec2, paints: &Paints) -> Option<Color> {
    let turn = |middle: f64, radius: f64, width: f64| {
        stroke(disc(q - DVec2::new(middle, 0.0), radius), width)
    };
    let distance = if q.y < 0.0 {
        turn(61.0, 35.0, 2.6)
    } else {
        let inner = if q.x < 44.0 { turn(44.0, 18.0, 2.4) } else { f64::INFINITY };
        turn(48.0, 48.0, 3.4).min(inner)
    };
    (distance < 0.0).then_some(paints.deep)
}

/// The growth of leaves: their foot, their direction, and half the length of the longest leaf.
type Growth = (DVec2, DVec2, f64);

/// Returns the colour of sprigs of three leaves along the outside of the stems, and of single
/// leaves within.
fn leaves(q: DVec2, paints: &Paints) -> Option<Color> {
    const SPRIGS: [Growth; 3] = [
        (DVec2::new(13.0, 33.5), DVec2::new(-1.0, 0.35), 15.0),
        (DVec2::new(84.5, 32.0), DVec2::new(1.0, 0.30), 14.5),
        (DVec2::new(47.0, -32.0), DVec2::new(-1.0, -0.42), 14.5),
    ];
    const SINGLE: [Growth; 5] = [
        (DVec2::new(14.0, 33.5), DVec2::new(1.0, -0.05), 9.5),
        (DVec2::new(48.0, 47.0), DVec2::new(-1.0, -0.45), 9.5),
        (DVec2::new(48.0, 47.0), DVec2::new(1.0, -0.40), 10.5),
        (DVec2::new(94.5, 10.0), DVec2::new(0.55, 1.0), 9.5),
        (DVec2::new(95.0, 10.0), DVec2::new(1.0, 0.15), 8.0),
    ];
    let one =
        |foot, direction, half_length| leaf(seen_along(q, foot, direction), half_length, paints);
    let sprig = |&(foot, direction, half_length): &Growth| {
        let aside = direction.perp() * 0.75;
        one(foot, direction, half_length)
            .or_else(|| one(foot, direction + aside, half_length * 0.64))
            .or_else(|| one(foot, direction - aside, half_length * 0.64))
    };
    SPRIGS
        .iter()
        .find_map(sprig)
        .or_else(|| SINGLE.iter().find_map(|&(foot, along, half)| one(foot, along, half)))
}

/// Returns the colour of a leaf that grows from the origin along the y axis, with a light midrib;
/// lighter at its tip.
fn leaf(p: DVec2, half_length: f64, paints: &Paints) -> Option<Color> {
    match lens(p - DVec2::new(0.0, half_length), half_length, half_length * 0.42) {
        d if d > 0.0 => None,
        d if d > -1.3 => Some(paints.deep),
        _ if p.x.abs() < 0.7 => Some(paints.porcelain),
        _ => {
            let thinned = (p.y / half_length - 0.6).clamp(0.0, 0.7);
            Some(paints.cobalt.lerp(paints.wash, thinned))
        }
    }
}

/// Returns the colour of a blossom of eight light petals before eight dark ones, with a golden
/// heart.
fn blossom(q: DVec2, paints: &Paints) -> Option<Color> {
    let q = q - DVec2::new(55.5, 1.5);
    let radius = q.length();
    match radius {
        r if r < 5.0 => return Some(paints.gold),
        r if r < 6.4 => return Some(paints.deep),
        r if r > 28.0 => return None,
        _ => (),
    }
    let petal =
        |p: DVec2, reach: f64| lens(p - DVec2::new(0.0, reach * 0.55), reach * 0.45, reach * 0.22);
    let light = fold_eight(q);
    match petal(light, 27.0) {
        d if d > 0.0 => (),
        d if d > -1.3 => return Some(paints.deep),
        _ => {
            let thinned = ((radius - 7.5) / 15.0).clamp(0.0, 1.0);
            return Some(paints.wash.lerp(paints.porcelain, thinned));
        }
    }
    // The dark petals stand between the light ones.
    let dark = seen_along(light, DVec2::ZERO, DVec2::new(SIN_22_5, COS_22_5));
    match petal(dark, 25.0) {
        d if d > 0.0 => None,
        d if d > -1.3 => Some(paints.deep),
        _ => Some(paints.cobalt),
    }
}

/// Returns the colour of a running key of sixteen turns, the oldest of borders. `p.y` is in [0,
/// 35].
fn meander(p: DVec2, paints: &Paints) -> Option<Color> {
    const KEY: [&[u8; 8]; 7] =
        [b"#######.", b"#.....#.", b"#.###.#.", b"#.#...#.", b"#.#####.", b"#.......", b"########"];
    // A cell is six texels wide and five high.
    let row = 6 - (p.y / 5.0) as usize;
    let col = (p.x / 6.0) as usize % 8;
    (KEY[row][col] == b'#').then_some(paints.deep)
}

/// Returns the colour of the leaves that stand around the neck, twelve in front of twelve. `p.y` is
/// in [0, 62].
fn stiff_leaves(p: DVec2, paints: &Paints) -> Option<Color> {
    const PITCH: f64 = 64.0;
    let q = DVec2::new(p.x.rem_euclid(PITCH) - PITCH / 2.0, p.y);
    match arch(q, 28.0, 0.0, 60.0) {
        d if d > 0.0 => {
            let behind = DVec2::new((p.x + PITCH / 2.0).rem_euclid(PITCH) - PITCH / 2.0, p.y);
            shaded(arch(behind, 24.0, 0.0, 48.0), paints)
        }
        d if d > -2.0 => Some(paints.deep),
        d if d > -4.5 => None,
        d if d > -6.0 => Some(paints.cobalt),
        _ if q.x.abs() < 1.3 => Some(paints.deep),
        // Veins rise from the midrib to both sides.
        _ if (q.y - 0.8 * q.x.abs()).rem_euclid(5.0) < 1.6 => Some(paints.cobalt),
        _ => Some(paints.wash),
    }
}

/// Returns the colour of a net of fine lines with a bead in every mesh. `p.y` is in [0, 18].
fn net(p: DVec2, paints: &Paints) -> Option<Color> {
    let q = DVec2::new(p.x.rem_euclid(16.0) - 8.0, p.y.rem_euclid(9.0) - 4.5);
    let mesh = diamond(DVec2::new(q.x * 0.5625, q.y), 4.5);
    let bead = disc(DVec2::new(q.x * 0.6, q.y), 1.4);
    (mesh > -0.7 || bead < 0.0).then_some(paints.cobalt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bands_close_around_the_vase() {
        let paints = Paints::new();
        canvas::assert_repeats(SIZE, DVec2::new(f64::from(SIZE), 0.0), |p| color_at(p, &paints));
    }
}
