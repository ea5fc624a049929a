//! `graticule.png`: a globe without its lands. The picture shows twelve gores of sea, parallels and
//! meridians at every ten degrees, the tropics and polar circles, and the equator as a scale.
//! Longitude runs to the right from -180 to 180 degrees, latitude up from -90 to 90.

use super::canvas;
use super::coast::cosine;
use super::color::{Color, srgb};
use super::shape::to_multiple;
use glam::DVec2;
use image::RgbImage;

/// Texels from pole to pole; the picture is twice as wide.
const HEIGHT: u32 = 512;
/// Latitudes of the tropics and of the polar circles, in degrees.
const CIRCLES: [f64; 2] = [23.44, 66.56];

/// The inks.
#[derive(Debug)]
struct Inks {
    seas: [Color; 2],
    line: Color,
    bold: Color,
    red: Color,
    cream: Color,
}

impl Inks {
    fn new() -> Self {
        Self {
            seas: [srgb(0xb4_cd_cb), srgb(0xa0_bf_c0)],
            line: srgb(0x6f_97_9c),
            bold: srgb(0x3d_64_6e),
            red: srgb(0x93_3f_2f),
            cream: srgb(0xef_e6_cf),
        }
    }
}

/// Draws the graticule.
pub fn draw() -> RgbImage {
    let inks = Inks::new();
    let degrees = 180.0 / f64::from(HEIGHT);
    canvas::draw(2 * HEIGHT, HEIGHT, |texel| {
        color_at(DVec2::new(texel.x * degrees - 180.0, 90.0 - texel.y * degrees), &inks)
    })
}

/// Returns the colour at longitude `p.x` and latitude `p.y`, in degrees.
fn color_at(p: DVec2, inks: &Inks) -> Color {
    let (longitude, latitude) = (p.x, p.y.abs());
    // Lines have the same width everywhere on the globe, so a degree of longitude is scaled by the
    // cosine of the latitude.
    let cosine = cosine(latitude);
    let to_meridian = |pitch: f64| to_multiple(longitude, pitch) * cosine;
    let dash = longitude.rem_euclid(5.0) < 3.2;
    match latitude {
        l if l < 1.3 => {
            let dark = longitude.rem_euclid(20.0) < 10.0;
            if l > 0.9 || dark { inks.red } else { inks.cream }
        }
        l if CIRCLES.iter().any(|circle| (l - circle).abs() < 0.4) && dash => inks.red,
        l if l > 87.0 => inks.bold,
        _ if to_meridian(90.0) < 0.5 => inks.bold,
        l if l > 79.8 => {
            if l < 80.2 || to_meridian(30.0) < 0.28 {
                inks.line
            } else {
                inks.seas[0]
            }
        }
        l if to_multiple(l, 30.0) < 0.4 || to_meridian(30.0) < 0.4 => inks.bold,
        l if to_multiple(l, 10.0) < 0.24 || to_meridian(10.0) < 0.24 => inks.line,
        _ => inks.seas[usize::from(longitude.rem_euclid(60.0) < 30.0)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seas_close_around_the_globe() {
        let inks = Inks::new();
        let at = |texel: DVec2| color_at(DVec2::new(texel.x, texel.y / 2.0 - 90.0), &inks);
        canvas::assert_repeats(360, DVec2::new(360.0, 0.0), at);
    }
}
