//! Averages a texture under an elliptical Gaussian (EWA).
//!
//! The method is Greene and Heckbert, *Creating Raster Omnimax Images from Multiple Perspective Views
//! Using the Elliptical Weighted Average Filter*, IEEE CG&A 1986, in the form of Pharr, Jakob and
//! Humphreys, *Physically Based Rendering*, 4th edition, 10.4.3. The semi-axes of the ellipse are the
//! axes of the footprint, so that it is two pixels long and broad. In the squared distance `r2` from
//! its middle, 1 at its border, a texel has the weight `exp(-2 r2) - exp(-2)`. The squares of the
//! semi-axes are increased by one texel.
//!
//! A level of a pyramid is chosen on which the shorter semi-axis has one to two texels, and is blended
//! with the next one. An ellipse longer than `aspect` times its breadth is widened: without a limit the
//! cost has no bound, and the limit blurs.

use super::outline::{Axes, Outline};
use super::probes::widened;
use super::pyramid::Pyramid;
use crate::color::Color;
use crate::texture::Texture;
use glam::{DVec2, DVec3};

/// Sharpness of the Gaussian: its exponent at the border.
const SHARPNESS: f64 = 2.0;

/// Number of weights between the middle of an ellipse and its border, at equal steps of `r2`.
///
/// The nearest one below is used. With 128 weights, neighbouring ones differ by at most 1.6 hundredths.
const WEIGHTS: usize = 128;

/// Smallest breadth of an ellipse in texels. It is far below the texel by which ellipses grow.
const LEAST: f64 = 1e-9;

/// A texture that is averaged under ellipses.
#[derive(Debug)]
pub struct Ewa {
    pyramid: Pyramid,
    /// Largest ratio of length to breadth.
    aspect: f64,
    weights: Box<[f64; WEIGHTS]>,
}

impl Ewa {
    /// Prepares a texture. `aspect` is the largest ratio of length to breadth, 1 or more.
    #[must_use]
    pub fn build(texture: &Texture, aspect: f64) -> Self {
        let weight = |k: usize| (-SHARPNESS * k as f64 / WEIGHTS as f64).exp() - (-SHARPNESS).exp();
        Self {
            pyramid: Pyramid::build(texture),
            aspect,
            weights: Box::new(std::array::from_fn(weight)),
        }
    }

    /// Memory of the pyramid, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.pyramid.bytes()
    }

    /// Returns the average over an outline, linear RGB. `texture` is the one that was prepared.
    #[must_use]
    pub fn average(&self, texture: &Texture, outline: &Outline) -> Color {
        let axes = widened(outline.axes, self.aspect, LEAST);
        let level = axes.minor.log2().max(0.0);
        let top = self.pyramid.levels().len();
        if level >= top as f64 {
            let size = DVec2::new(texture.width as f64, texture.height as f64);
            let at = outline.center / size;
            return self.level(texture, top).bilinear(DVec2::new(at.x, 1.0 - at.y));
        }
        let finer = level as usize;
        let lower = self.on_level(texture, finer, outline.center, axes);
        if level.fract() == 0.0 {
            return lower;
        }
        lower.lerp(self.on_level(texture, finer + 1, outline.center, axes), level.fract())
    }

    fn level<'a>(&'a self, texture: &'a Texture, level: usize) -> &'a Texture {
        level.checked_sub(1).map_or(texture, |above| &self.pyramid.levels()[above])
    }

    /// Averages on one level. Position and axes are in texels of the texture.
    fn on_level(&self, texture: &Texture, level: usize, center: DVec2, axes: Axes) -> Color {
        let level = self.level(texture, level);
        let size = DVec2::new(texture.width as f64, texture.height as f64);
        let scale = DVec2::new(level.width as f64, level.height as f64) / size;
        // A texel is at its middle.
        let at = center * scale - 0.5;
        let (major, minor) = (axes.major * axes.along * scale, axes.minor * axes.across() * scale);
        // The ellipse xx x^2 + xy x y + yy y^2 = 1.
        let (xx, yy) = (
            major.y * major.y + minor.y * minor.y + 1.0,
            major.x * major.x + minor.x * minor.x + 1.0,
        );
        let xy = -2.0 * (major.x * major.y + minor.x * minor.y);
        let scale = 1.0 / (xx * yy - 0.25 * xy * xy);
        let (xx, xy, yy) = (scale * xx, scale * xy, scale * yy);
        // Half the height of the ellipse, from the discriminant of the quadratic in x.
        let half = (xx / (xx * yy - 0.25 * xy * xy)).sqrt();
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        let mut y = (at.y - half).ceil();
        while y <= at.y + half {
            let row = level.wrap.index(y, level.height) * level.width;
            let down = y - at.y;
            // The ellipse spans these x in the row.
            let (middle, rest) = (-0.5 * xy * down / xx, (1.0 - yy * down * down) / xx);
            let span = (middle * middle + rest).max(0.0).sqrt();
            let mut x = (at.x + middle - span).ceil();
            while x <= at.x + middle + span {
                let across = x - at.x;
                let r2 = xx * across * across + xy * across * down + yy * down * down;
                if let Some(weight) = self.weights.get((WEIGHTS as f64 * r2) as usize) {
                    let texel = level.texels[row + level.wrap.index(x, level.width)];
                    sum += *weight * DVec3::from(texel.map(f64::from));
                    weights += weight;
                }
                x += 1.0;
            }
            y += 1.0;
        }
        if weights > 0.0 {
            return sum / weights * level.unit();
        }
        let size = DVec2::new(level.width as f64, level.height as f64);
        let at = (at + 0.5) / size;
        level.bilinear(DVec2::new(at.x, 1.0 - at.y))
    }

    /// Returns the largest distance in texels, across and down, from the centre of an outline to a
    /// place that the average reads.
    #[must_use]
    pub fn reach(&self, outline: &Outline) -> DVec2 {
        let axes = widened(outline.axes, self.aspect, LEAST);
        let [major, minor] = [axes.major * axes.along, axes.minor * axes.across()];
        // The coarser level's texels are at most twice the breadth wide; each is read at its middle.
        let texel = (2.0 * axes.minor).max(1.0);
        let square = major * major + minor * minor + texel * texel;
        DVec2::new(square.x.sqrt(), square.y.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Wrap;
    use proptest::prelude::*;

    fn texture(width: usize, height: usize) -> Texture {
        let code = |k: usize| ((k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as u16;
        let texels = (0..width * height).map(|k| [code(k), code(k + 3), 0]).collect();
        Texture { width, height, texels, white: u16::MAX, wrap: Wrap::Mirror, ..Texture::default() }
    }

    fn outline(center: DVec2, sides: [DVec2; 2]) -> Outline {
        Outline { center, sides, bend: DVec2::ZERO, axes: Axes::of(sides) }
    }

    proptest! {
        /// The Gaussian is evaluated at all texels around, from the inverse of the matrix of the
        /// ellipse.
        #[test]
        fn a_small_ellipse_is_the_gaussian_of_its_texels(
            x in 0.0..9.0f64, y in 0.0..9.0f64, a in -1.0..1.0f64, b in -0.9..0.9f64, c in -1.0..1.0f64,
        ) {
            let texture = texture(9, 9);
            let sides = [DVec2::new(a, b), DVec2::new(-b, c)];
            let (at, axes) = (DVec2::new(x, y), Axes::of(sides));
            prop_assume!(axes.minor <= 1.0 && axes.minor > 0.0 && axes.major < 8.0 * axes.minor);
            let found = Ewa::build(&texture, 64.0).average(&texture, &outline(at, sides));
            let sides = glam::DMat2::from_cols(sides[0], sides[1]);
            let inverse = (sides * sides.transpose() + glam::DMat2::IDENTITY).inverse();
            let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
            for j in -5..15 {
                for i in -5..15 {
                    let from = DVec2::new(f64::from(i) + 0.5, f64::from(j) + 0.5) - at;
                    let r2 = from.dot(inverse * from);
                    if r2 < 1.0 {
                        let weight = (-2.0 * r2).exp() - (-2.0f64).exp();
                        let (i, j) = (i.into(), j.into());
                        let place = texture.wrap.index(j, 9) * 9 + texture.wrap.index(i, 9);
                        sum += weight * DVec3::from(texture.texels[place].map(f64::from));
                        weights += weight;
                    }
                }
            }
            prop_assume!(weights > 0.1);
            let truth = sum / weights / 65535.0;
            // Each weight is too large by up to 1/64, of a sum of at least 0.1 with few texels.
            prop_assert!((found - truth).abs().max_element() < 0.08, "{found} {truth}");
        }

        #[test]
        fn a_constant_texture_stays_constant(
            x in -9.0..9.0f64, y in -9.0..9.0f64, a in -99.0..99.0f64, b in -9.0..9.0f64, aspect in 1.0..64.0f64,
        ) {
            let flat = Texture { texels: vec![[300, 65535, 0]; 35], ..texture(7, 5) };
            let sides = [DVec2::new(a, b), DVec2::new(0.3 * b, -0.1 * a)];
            let found = Ewa::build(&flat, aspect).average(&flat, &outline(DVec2::new(x, y), sides));
            prop_assert!(found.abs_diff_eq(DVec3::new(300.0 / 65535.0, 1.0, 0.0), 1e-12), "{found}");
        }
    }

    #[test]
    fn a_limit_above_the_aspect_changes_nothing_and_one_below_blurs() {
        let texture = texture(64, 64);
        let sides = [DVec2::new(20.0, 5.0), DVec2::new(-0.5, 2.0)];
        let at = outline(DVec2::splat(31.3), sides);
        let [wide, wider, narrow] =
            [16.0, 64.0, 2.0].map(|aspect| Ewa::build(&texture, aspect).average(&texture, &at));
        assert!(wide == wider && wide != narrow, "{wide} {wider} {narrow}");
    }
}
