//! Averages several probes of a pyramid along the longer axis of a footprint.
//!
//! The method is a form of *Feline: Fast Elliptical Lines for Anisotropic Texture Mapping*, SIGGRAPH
//! 1999, as many renderers and graphics processors use it. A footprint gets as many probes as its
//! aspect, rounded up. The probes are as wide as its shorter axis, lie evenly along the longer one and
//! count equally. A footprint longer than [`MOST_ASPECT`] times its breadth is widened, which blurs.
//!
//! The library `OpenImageIO` spreads `2a - 1` probes for an aspect `a` over two pixels, with the weights
//! of a Gaussian. Here they fill one pixel, which is nearer to the average over the pixel.

use super::outline::{Axes, Outline};
use super::pyramid::Pyramid;
use crate::color::Color;
use crate::texture::Texture;
use glam::DVec2;

/// Largest aspect. Twice as much costs up to twice the time.
pub const MOST_ASPECT: f64 = 16.0;

/// Returns the axes of the ellipse that is averaged, in texels: not below one texel, and not longer
/// than `aspect` times the breadth.
#[must_use]
pub fn widened(axes: Axes, aspect: f64, least: f64) -> Axes {
    let minor = axes.minor.max(axes.major / aspect).max(least);
    Axes { minor, major: axes.major.max(minor), ..axes }
}

/// Returns the average over an outline, linear RGB. `pyramid` was built from `texture`.
#[must_use]
pub fn average(pyramid: &Pyramid, texture: &Texture, outline: &Outline) -> Color {
    let Axes { along, major, minor } = widened(outline.axes, MOST_ASPECT, 1.0);
    let level = minor.log2();
    // Rounding must not add a probe to a square.
    let count = ((major / minor - 1e-9).ceil() as u32).max(1);
    let size = DVec2::new(texture.width as f64, texture.height as f64);
    let probe = |offset: f64| {
        let at = (outline.center + offset * along) / size;
        pyramid.trilinear(texture, DVec2::new(at.x, 1.0 - at.y), level)
    };
    let place = |k: u32| (f64::from(k) + 0.5) / f64::from(count) - 0.5;
    (0..count).map(|k| probe(place(k) * major)).sum::<Color>() / f64::from(count)
}

/// Returns the largest distance in texels, across and down, from the centre of an outline to a place
/// that the average reads.
#[must_use]
pub fn reach(outline: &Outline) -> DVec2 {
    let Axes { along, major, minor } = widened(outline.axes, MOST_ASPECT, 1.0);
    // Interpolation reaches half a texel of the coarser of two levels: at most the breadth.
    0.5 * major * along.abs() + minor
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Wrap;

    fn outline(center: DVec2, sides: [DVec2; 2]) -> Outline {
        Outline { center, sides, bend: DVec2::ZERO, axes: Axes::of(sides) }
    }

    /// On a ramp every probe is the ramp at its middle, and the weights are symmetric.
    #[test]
    fn probes_on_a_ramp_give_its_middle() {
        let texels = (0..256 * 4).map(|k| [(k % 256 * 200) as u16; 3]).collect();
        let ramp = Texture {
            width: 256,
            height: 4,
            texels,
            white: u16::MAX,
            wrap: Wrap::Clamp,
            ..Texture::default()
        };
        let pyramid = Pyramid::build(&ramp);
        for (length, breadth) in [(0.0, 0.0), (3.0, 1.0), (20.0, 1.5), (60.0, 0.5), (30.0, 9.0)] {
            let sides = [DVec2::new(length, 0.2), DVec2::new(0.0, breadth)];
            let found = average(&pyramid, &ramp, &outline(DVec2::new(128.0, 2.0), sides)).x;
            // Codes of each level are rounded by half a code.
            let truth = 127.5 * 200.0 / 65535.0;
            assert!((found - truth).abs() < 4.0 / 65535.0, "{length} {breadth}: {found} {truth}");
        }
    }

    #[test]
    fn probes_stay_within_their_reach() {
        // A black texture with one white column, which the probes must not see.
        let texels =
            (0..128 * 128).map(|k| [if k % 128 == 100 { u16::MAX } else { 0 }; 3]).collect();
        let column =
            Texture { width: 128, height: 128, texels, white: u16::MAX, ..Texture::default() };
        let pyramid = Pyramid::build(&column);
        let sides = [DVec2::new(24.0, 7.0), DVec2::new(-0.5, 2.5)];
        let far = reach(&outline(DVec2::ZERO, sides));
        let at = |x: f64| average(&pyramid, &column, &outline(DVec2::new(x, 60.0), sides)).x;
        // The coarser level's texel holds the column and its neighbours.
        assert_eq!(at(99.0 - far.x - 4.0), 0.0);
        assert!(at(101.0) > 0.0);
    }
}
