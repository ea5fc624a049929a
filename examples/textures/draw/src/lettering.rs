//! `lettering.png`: a sheet of fine lettering, tileable in both directions. Sentences about
//! surfaces made from curves stand in lines of three sizes on paper, between ruled lines.

use super::alphabet::{self, Line};
use super::canvas;
use super::color::{Color, srgb};
use super::noise::cloud;
use glam::{DVec2, IVec2};
use image::RgbImage;

/// Texels along a side of the picture: enough for a poster whose sheet is some thousand pixels wide.
const SIZE: u32 = 1024;
/// Points along a side of the sheet. Lengths on the sheet are in points.
const SIDE: f64 = 512.0;
/// The lines, from the top: the height of the letters, in points, and the text, which is repeated
/// over the width.
const LINES: [(f64, &str); 12] = [
    (26.0, "CURVES IN. PICTURE OUT."),
    (11.0, "A CONTOUR IS SWEPT ALONG A TRAJECTORY AND TURNS AS LITTLE AS IT CAN."),
    (11.0, "WHERE IT COMES BACK TO ITS START IT CLOSES TO THE LAST BIT."),
    (18.0, "EVERY PIXEL IS RIGHT"),
    (11.0, "A PIXEL SEES A PIECE OF TEXTURE AND NOT A POINT. ITS COLOUR IS THE MEAN OF THE PIECE."),
    (11.0, "SO IT IS IN A MIRROR AND SO IT IS BEHIND GLASS."),
    (26.0, "TOPOLOGYBOOK 1993"),
    (11.0, "SUMS OF WHOLE NUMBERS ARE EXACT AND WHAT IS SUMMED TWICE IS SMOOTH."),
    (11.0, "A BOTTLE WITH ONE SIDE HOLDS NOTHING AND HIDES NOTHING."),
    (18.0, "ASK FOR AN ACCURACY"),
    (11.0, "0123456789 AND THE LETTERS OF THE ALPHABET ARE DRAWN WITH ONE PEN."),
    (11.0, "IF YOU CAN READ THIS THE PICTURE IS WELL FILTERED."),
];
/// Distance from the top of the picture to the first line, in points.
const TOP: f64 = 6.0;
/// Height of the strip of each line, in points.
const LEAD: f64 = 35.5;

/// Paper and inks.
#[derive(Debug)]
struct Sheet {
    paper: Color,
    ink: Color,
    red: Color,
    rows: Vec<Row>,
}

/// A line on the sheet.
#[derive(Debug)]
struct Row {
    /// The base line, in points from the top.
    base: f64,
    height: f64,
    letters: Line,
    /// Factor that stretches the letters across so that the text fills the width a whole number of
    /// times.
    spread: f64,
}

impl Sheet {
    fn new() -> Self {
        let mut base = TOP;
        let rows = LINES.map(|(height, text)| {
            base += 0.5 * LEAD + 0.5 * height;
            let letters = alphabet::line(&format!("{text}  "));
            let times = (SIDE / (letters.width * height)).round().max(1.0);
            let spread = SIDE / (times * letters.width * height);
            let row = Row { base, height, letters, spread };
            base += 0.5 * LEAD - 0.5 * height + 0.38 * height;
            row
        });
        let [paper, ink, red] = [0xf1_e8_d4, 0x2c_2a_33, 0x9a_33_28].map(srgb);
        Self { paper, ink, red, rows: rows.into() }
    }
}

/// Draws the sheet.
pub fn draw() -> RgbImage {
    let sheet = Sheet::new();
    canvas::draw(SIZE, SIZE, |texel| color_at(texel * (SIDE / f64::from(SIZE)), &sheet))
}

/// Returns the colour at a position in points.
fn color_at(p: DVec2, sheet: &Sheet) -> Color {
    let p = p.rem_euclid(DVec2::splat(SIDE));
    let fibres = cloud(p * (64.0 / SIDE), IVec2::splat(64), 5) - 0.5;
    let paper = sheet.paper * (1.0 + 0.05 * fibres);
    for (row, number) in sheet.rows.iter().zip(0..) {
        let above = row.base - p.y;
        if above < -0.3 * row.height || above > 1.2 * row.height {
            continue;
        }
        let ink = if row.height > 15.0 && number % 2 == 0 { sheet.red } else { sheet.ink };
        let scale = DVec2::new(row.height * row.spread, row.height);
        let repeated = p.x.rem_euclid(row.letters.width * scale.x);
        // Half of the gap at the end of a line lies at its start.
        let here = DVec2::new(repeated, above) / scale - DVec2::new(0.35, 0.0);
        let pen = 0.055 + 0.35 / row.height;
        if row.letters.strokes.iter().any(|&stroke| alphabet::distance(here, stroke) < pen) {
            return ink;
        }
    }
    paper
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lines_are_on_the_sheet_and_legible() {
        let sheet = Sheet::new();
        let last = sheet.rows.last().unwrap();
        assert!(last.base < SIDE - 6.0, "{}", last.base);
        for row in &sheet.rows {
            assert!((0.6..1.5).contains(&row.spread), "{} at {}", row.spread, row.base);
        }
    }

    #[test]
    fn the_sheet_repeats_both_ways() {
        let sheet = Sheet::new();
        let side = SIDE;
        for step in [DVec2::new(side, 0.0), DVec2::new(0.0, -side)] {
            let differs =
                |p: DVec2| color_at(p, &sheet).distance(color_at(p + step, &sheet)) > 1e-9;
            let tried = (0..4000).map(|k| f64::from(k) * 0.754_877_666);
            let differing =
                tried.filter(|k| differs(DVec2::new((k * 97.3) % side, (k * 31.7) % side)));
            assert!(differing.count() < 8);
        }
    }
}
