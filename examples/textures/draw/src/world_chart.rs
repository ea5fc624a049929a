//! `world-chart.png`: an old chart of the world for a globe: lands in ochre and green, waterlines
//! along the shores, parallels and meridians. Longitude runs to the right from -180 to 180 degrees,
//! latitude up from -90 to 90.

use super::canvas;
use super::coast::{Coast, cosine};
use super::color::{Color, srgb};
use super::noise::cloud;
use super::shape::to_multiple;
use glam::{DVec2, IVec2};
use image::RgbImage;

/// Texels from pole to pole; the picture is twice as wide.
const HEIGHT: u32 = 512;
/// Distance of the last waterline from the shore, in degrees.
const OUTERMOST: f64 = 3.1;
/// Waterlines: their distances from the shore, in degrees, and their strengths, in [0, 1].
const WATERLINES: [(f64, f64); 4] = [(0.75, 0.55), (1.4, 0.42), (2.15, 0.3), (3.0, 0.18)];

/// The inks.
#[derive(Debug)]
struct Inks {
    sea: Color,
    shallow: Color,
    shore: Color,
    line: Color,
    equator: Color,
    /// Colours of land by latitude, in degrees, rising.
    lands: [(f64, Color); 7],
}

impl Inks {
    fn new() -> Self {
        Self {
            sea: srgb(0x9d_be_c4),
            shallow: srgb(0xc3_d6_d1),
            shore: srgb(0x3f_36_2b),
            line: srgb(0x5f_86_90),
            equator: srgb(0x96_3c_2c),
            lands: [
                (-90.0, srgb(0xf2_ef_e8)),
                (-62.0, srgb(0xea_e6_dc)),
                (-38.0, srgb(0xb9_b5_7a)),
                (-4.0, srgb(0x93_a7_62)),
                (23.0, srgb(0xdb_bb_82)),
                (48.0, srgb(0xa9_b1_76)),
                (76.0, srgb(0xec_e8_dd)),
            ],
        }
    }
}

/// Draws the chart.
pub fn draw() -> RgbImage {
    let inks = Inks::new();
    let coast = Coast::within(OUTERMOST + 0.3);
    let degrees = 180.0 / f64::from(HEIGHT);
    canvas::draw(2 * HEIGHT, HEIGHT, |texel| {
        let p = DVec2::new(texel.x * degrees - 180.0, 90.0 - texel.y * degrees);
        color_at(p, &coast, &inks)
    })
}

/// Returns the colour at longitude `p.x` and latitude `p.y`, in degrees.
fn color_at(p: DVec2, coast: &Coast, inks: &Inks) -> Color {
    let shore = coast.distance(p);
    if shore < 0.17 {
        return inks.shore;
    }
    if coast.is_land(p) {
        return land(p, shore, inks);
    }
    let mut color =
        inks.sea + (inks.shallow - inks.sea) * (1.0 - shore / OUTERMOST).clamp(0.0, 1.0);
    for (distance, strength) in WATERLINES {
        if (shore - distance).abs() < 0.09 {
            color += (inks.line - color) * strength;
        }
    }
    // Lines have the same width everywhere on the globe, so a degree of longitude is scaled by the
    // cosine of the latitude.
    let to_meridian = |pitch: f64| to_multiple(p.x, pitch) * cosine(p.y.abs());
    let ruled = p.y.abs() < 80.0 && to_meridian(15.0) < 0.12 || to_multiple(p.y, 15.0) < 0.12;
    if p.y.abs() < 0.32 {
        let dark = p.x.rem_euclid(10.0) < 5.0;
        return if dark { inks.equator } else { inks.shallow };
    }
    if ruled || to_meridian(90.0) < 0.2 { color + (inks.line - color) * 0.55 } else { color }
}

/// Returns the colour of land: by latitude, mottled, darker toward the shore.
fn land(p: DVec2, shore: f64, inks: &Inks) -> Color {
    let mottle = cloud((p + DVec2::new(180.0, 90.0)) / 9.0, IVec2::new(40, 40), 3) - 0.5;
    let latitude = p.y + 26.0 * mottle;
    let above = inks.lands.iter().position(|&(from, _)| from > latitude);
    let color = match above {
        None => inks.lands[6].1,
        Some(0) => inks.lands[0].1,
        Some(k) => {
            let ((south, a), (north, b)) = (inks.lands[k - 1], inks.lands[k]);
            a + (b - a) * ((latitude - south) / (north - south))
        }
    };
    color * (0.84 + 0.16 * (shore / 1.6).min(1.0)) * (1.0 + 0.16 * mottle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seas_close_around_the_globe() {
        let (inks, coast) = (Inks::new(), Coast::within(OUTERMOST + 0.3));
        for latitude in -85..85 {
            let at = |x| color_at(DVec2::new(x, f64::from(latitude) + 0.37), &coast, &inks);
            let (west, east) = (at(-179.999), at(179.999));
            assert!(west.distance(east) < 0.02, "{latitude}: {west} {east}");
        }
    }
}
