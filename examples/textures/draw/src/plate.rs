//! `plate.png`: a page of a book of specimens: paper, a border graduated as that of a map, and
//! space for four figures over their names.

use super::alphabet::{self, Line};
use super::canvas;
use super::color::{Color, srgb};
use glam::DVec2;
use image::RgbImage;

/// Texels along a side of the picture.
const SIZE: u32 = 1024;
/// For each line of text: its middle and its base line from the top, the height of its letters, all
/// in texels, a flag for red, and the text.
const LINES: [(f64, f64, f64, bool, &str); 10] = [
    (512.0, 112.0, 25.0, true, "PLATE I"),
    (292.0, 504.0, 20.0, true, "FIG. 1"),
    (292.0, 532.0, 16.0, false, "TREFOIL"),
    (732.0, 504.0, 20.0, true, "FIG. 2"),
    (732.0, 532.0, 16.0, false, "TORUS KNOT"),
    (292.0, 929.0, 20.0, true, "FIG. 3"),
    (292.0, 957.0, 16.0, false, "MOEBIUS BAND"),
    (732.0, 929.0, 20.0, true, "FIG. 4"),
    (732.0, 957.0, 16.0, false, "KLEIN BOTTLE"),
    (512.0, 957.0, 12.0, false, "1993"),
];
/// Distances from the edge of the picture to the border's outer and inner line, in texels.
const BORDER: [f64; 2] = [28.0, 40.0];
/// Width of the border's outer and inner line, in texels.
const RULE: f64 = 2.5;
/// Distance from the edge of the picture to a fine third line, in texels.
const FINE: f64 = 50.0;
/// Texels of a division of the border. Every second division is dark, and the border has a whole
/// number of pairs.
const DIVISION: f64 = (SIZE as f64 - 2.0 * BORDER[0]) / 88.0;

/// The paper, the inks and the lines of text.
#[derive(Debug)]
struct Plate {
    paper: Color,
    ink: Color,
    names: Vec<Name>,
}

/// A line of letters.
#[derive(Debug)]
struct Name {
    /// The left end of the base line, in texels.
    start: DVec2,
    height: f64,
    color: Color,
    letters: Line,
}

impl Plate {
    fn new() -> Self {
        let [paper, ink, red] = [0xee_e7_d6, 0x2e_2c_33, 0x93_33_2a].map(srgb);
        let names = LINES.map(|(middle, base, height, is_red, text)| {
            let letters = alphabet::line(text);
            let start = DVec2::new(middle - 0.5 * letters.width * height, base);
            Name { start, height, color: if is_red { red } else { ink }, letters }
        });
        Self { paper, ink, names: names.into() }
    }
}

/// Draws the plate.
pub fn draw() -> RgbImage {
    let plate = Plate::new();
    canvas::draw(SIZE, SIZE, |texel| color_at(texel, &plate))
}

/// Returns the colour at a position in texels.
fn color_at(p: DVec2, plate: &Plate) -> Color {
    let side = f64::from(SIZE);
    let from_edge = p.min(DVec2::splat(side) - p);
    let in_border = from_edge.min_element();
    if in_border < FINE + 2.0 {
        return if is_border(p, in_border) { plate.ink } else { plate.paper };
    }
    for name in &plate.names {
        let here = DVec2::new(p.x - name.start.x, name.start.y - p.y) / name.height;
        if here.x < -0.5 || here.x > name.letters.width + 0.5 || !(-0.3..1.3).contains(&here.y) {
            continue;
        }
        let pen = 0.05 + 0.3 / name.height;
        if name.letters.strokes.iter().any(|&stroke| alphabet::distance(here, stroke) < pen) {
            return name.color;
        }
    }
    plate.paper
}

/// Returns true if there is ink at `p`, `depth` texels from the nearest edge.
fn is_border(p: DVec2, depth: f64) -> bool {
    let [outer, inner] = BORDER;
    if (depth - FINE).abs() < 0.25 * RULE {
        return true;
    }
    if (depth - outer).abs() < 0.5 * RULE || (depth - inner).abs() < 0.5 * RULE {
        return true;
    }
    // The corners stay without divisions.
    let side = f64::from(SIZE);
    let along = if p.y.min(side - p.y) < p.x.min(side - p.x) { p.x } else { p.y };
    let within = along > inner && along < side - inner;
    let division = ((along - outer) / DIVISION).floor();
    (outer..inner).contains(&depth) && within && division.rem_euclid(2.0) < 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_within_the_border_and_apart() {
        let plate = Plate::new();
        let side = f64::from(SIZE);
        let room = |name: &Name| {
            let wide = DVec2::new(name.letters.width * name.height, 0.0);
            (name.start - DVec2::new(0.0, name.height), name.start + wide)
        };
        let rooms: Vec<_> = plate.names.iter().map(room).collect();
        for (k, (low, high)) in rooms.iter().enumerate() {
            assert!(low.min_element() > FINE && high.max_element() < side - FINE, "{low} {high}");
            for (other_low, other_high) in &rooms[..k] {
                assert!(low.cmpgt(*other_high).any() || high.cmplt(*other_low).any(), "{low}");
            }
        }
    }

    #[test]
    fn the_border_is_the_same_on_all_sides() {
        let side = f64::from(SIZE);
        let plate = Plate::new();
        for k in 0..2000 {
            // Points off the middles of texels, where a division may begin.
            let p = DVec2::new(f64::from(k) * 0.511 + 0.003, f64::from(k % 52) + 0.31);
            let turned = [DVec2::new(p.y, p.x), DVec2::new(p.x, side - p.y)];
            for q in turned {
                assert_eq!(color_at(p, &plate), color_at(q, &plate), "{p} {q}");
            }
        }
    }
}
