//! Mip-mapping: averages a texture with a pyramid of ever smaller pictures (thesis 3.3.1).
//!
//! The method is Williams, *Pyramidal Parametrics*, SIGGRAPH 1983. Each level has half the texels
//! of the one below along each axis, rounded down, until one is left. Where a side is odd, a texel
//! of the smaller level still averages exactly the area that it covers. This area is `w / (w/2)`
//! texels wide, two to three, and the texels at its border count in part. Every level therefore
//! fills the same unit square and has the same mean, and a size need not be a power of two. Codes
//! are rounded to 16 bits on each level, with an error of half a code at most.
//!
//! A footprint is treated as a square, and `d` is the logarithm to base 2 of its side in texels.
//! The thesis says that no method of finding `d` is correct. Here the side is half the *longer*
//! side of the box around 3 x 3 neighbours: one pixel, where the texture is most compressed. This
//! choice blurs surfaces seen at a slant and does not alias. The result is interpolated linearly
//! between the two nearest levels and between the texels of each.

use crate::color::Color;
use crate::texture::Texture;
use glam::DVec2;

/// The levels above a texture, from the largest to a single texel.
#[derive(Debug)]
pub struct Pyramid {
    levels: Vec<Texture>,
}

impl Pyramid {
    /// Builds the levels by halving the texture until one texel is left.
    #[must_use]
    pub fn build(texture: &Texture) -> Self {
        let mut levels: Vec<Texture> = Vec::new();
        for _ in sizes(texture) {
            let level = halved(levels.last().unwrap_or(texture));
            levels.push(level);
        }
        Self { levels }
    }

    /// The levels above the texture, from the largest to a single texel.
    #[must_use]
    pub fn levels(&self) -> &[Texture] {
        &self.levels
    }

    /// Memory of all levels without the texture itself, in bytes. It is about a third of the
    /// texture's.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.levels.iter().map(|level| size_of_val(level.texels.as_slice())).sum()
    }

    /// Returns the value of [`Self::bytes`] without building anything.
    #[must_use]
    pub fn bytes_for(texture: &Texture) -> u64 {
        sizes(texture).map(|(width, height)| 6 * width as u64 * height as u64).sum()
    }

    /// Returns the trilinear average over a square of about this half-width, linear RGB. `center`
    /// and `half` are in texture coordinates. `texture` is the one from which the pyramid was
    /// built.
    #[must_use]
    pub fn average(&self, texture: &Texture, center: DVec2, half: DVec2) -> Color {
        self.trilinear(texture, center, side(texture, half).log2())
    }

    /// Interpolates between texels and levels at a point, linear RGB. `d` is the logarithm to base 2 of
    /// the width of the texels, in texels of the texture. `center` is in texture coordinates.
    #[must_use]
    pub fn trilinear(&self, texture: &Texture, center: DVec2, d: f64) -> Color {
        if d.is_nan() || d <= 0.0 || self.levels.is_empty() {
            return texture.bilinear(center);
        }
        let top = self.levels.len();
        if d >= top as f64 {
            return self.levels[top - 1].bilinear(center);
        }
        let below = d as usize;
        let lower = if below == 0 { texture } else { &self.levels[below - 1] };
        lower.bilinear(center).lerp(self.levels[below].bilinear(center), d.fract())
    }
}

/// Returns the side of the square that stands for a footprint, in texels. `half` is in texture
/// coordinates.
#[must_use]
pub fn side(texture: &Texture, half: DVec2) -> f64 {
    (half.abs() * DVec2::new(texture.width as f64, texture.height as f64)).max_element()
}

/// Lists the widths and heights of a texture and of the levels above it.
pub fn all_sizes(texture: &Texture) -> impl Iterator<Item = (usize, usize)> {
    let size = (texture.width, texture.height);
    std::iter::successors(Some(size), |&(width, height)| {
        ((width, height) != (1, 1)).then(|| (half_of(width), half_of(height)))
    })
}

/// Lists the widths and heights of the levels above a texture.
fn sizes(texture: &Texture) -> impl Iterator<Item = (usize, usize)> {
    all_sizes(texture).skip(1)
}

fn half_of(size: usize) -> usize {
    (size / 2).max(1)
}

/// Halves a texture: each texel of the result is the average of the area that it covers.
fn halved(texture: &Texture) -> Texture {
    let (width, height) = (half_of(texture.width), half_of(texture.height));
    let scale = u64::from(u16::MAX / texture.white);
    let area = texture.width as u64 * texture.height as u64;
    let mut texels = Vec::with_capacity(width * height);
    for j in 0..height {
        for i in 0..width {
            let mut sum = [0u64; 3];
            for (row, down) in covered(j, texture.height, height) {
                for (column, across) in covered(i, texture.width, width) {
                    let texel = texture.texels[row * texture.width + column];
                    for (sum, code) in sum.iter_mut().zip(texel) {
                        *sum += down * across * u64::from(code);
                    }
                }
            }
            texels.push(sum.map(|sum| ((sum * scale + area / 2) / area) as u16));
        }
    }
    let wrap = texture.wrap;
    Texture { width, height, wrap, texels, white: u16::MAX, ..Texture::default() }
}

/// Lists the texels of `size` that texel `k` of `smaller` covers, each with its part of the covered
/// area. In units of 1/(`size * smaller`) of the axis, a texel is `smaller` wide and the covered
/// area `size`.
fn covered(k: usize, size: usize, smaller: usize) -> impl Iterator<Item = (usize, u64)> {
    let (from, to) = (k * size, (k + 1) * size);
    (from / smaller..to.div_ceil(smaller)).map(move |i| {
        let part = to.min((i + 1) * smaller) - from.max(i * smaller);
        (i, part as u64)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Wrap;
    use proptest::prelude::*;

    fn texture(width: usize, height: usize, white: u16, code: impl Fn(usize) -> u16) -> Texture {
        let texels = (0..width * height).map(|k| [code(k), code(k + 7), 0]).collect();
        Texture { width, height, white, texels, wrap: Wrap::Repeat, ..Texture::default() }
    }

    fn mean(texture: &Texture) -> f64 {
        let sum: f64 = texture.texels.iter().map(|texel| f64::from(texel[0])).sum();
        sum * texture.unit() / texture.texels.len() as f64
    }

    #[test]
    fn four_texels_become_their_mean() {
        let small = texture(4, 2, 255, |k| [0, 10, 100, 101, 20, 31, 100, 100][k % 8]);
        let Pyramid { levels } = Pyramid::build(&small);
        let codes: Vec<u16> = levels.iter().flat_map(|l| l.texels.iter().map(|t| t[0])).collect();
        // In 257ths: 61/4, 401/4, and the mean of both rounded codes.
        assert_eq!(codes, [3919, 25764, 14842]);
    }

    #[test]
    fn the_pyramid_takes_a_third_more() {
        let large = texture(512, 512, 255, |_| 0);
        let own = size_of_val(large.texels.as_slice());
        assert_eq!(Pyramid::build(&large).bytes(), (own - 6) / 3);
    }

    #[test]
    fn a_square_of_whole_texels_is_their_mean() {
        // Half sides of 2^l texels at the middle of a texel of level l.
        let small = texture(16, 16, u16::MAX, |k| (k * 40503) as u16);
        let pyramid = Pyramid::build(&small);
        let average = pyramid.average(&small, DVec2::new(0.375, 0.625), DVec2::splat(0.25));
        let block = (4..8).flat_map(|j| (4..8).map(move |i| 16 * j + i));
        let exact = block.map(|k| f64::from(small.texels[k][0])).sum::<f64>() / (16.0 * 65535.0);
        // Two levels, each rounded to half a code.
        assert!((average.x - exact).abs() < 1.01 / 65535.0, "{} {exact}", average.x);
    }

    #[test]
    fn without_a_footprint_it_is_bilinear_and_with_a_huge_one_the_mean() {
        let odd = texture(13, 6, 255, |k| (k * 37 % 256) as u16);
        let pyramid = Pyramid::build(&odd);
        for (k, bad) in [0.0, f64::NAN, -0.01, 1e-300].into_iter().enumerate() {
            let at = DVec2::new(0.3 + 0.1 * k as f64, 0.9);
            assert_eq!(pyramid.average(&odd, at, DVec2::splat(bad)), odd.bilinear(at));
        }
        for huge in [1.0, 1e6, f64::INFINITY] {
            let average = pyramid.average(&odd, DVec2::splat(0.2), DVec2::splat(huge)).x;
            assert!((average - mean(&odd)).abs() < 3.0 / 65535.0, "{average}");
        }
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let average = pyramid.average(&odd, DVec2::splat(bad), DVec2::splat(0.2));
            assert!(average.min_element() >= 0.0 && average.max_element() <= 1.0, "{average}");
        }
    }

    proptest! {
        #[test]
        fn every_level_has_the_mean_of_the_texture(
            width in 1usize..40, height in 1usize..40, seed in any::<u16>(),
        ) {
            let any = texture(width, height, u16::MAX, |k| (k as u16).wrapping_mul(seed | 1));
            let pyramid = Pyramid::build(&any);
            prop_assert_eq!(pyramid.bytes() as u64, Pyramid::bytes_for(&any));
            for (above, level) in pyramid.levels.iter().enumerate() {
                let error = (mean(level) - mean(&any)).abs() * 65535.0;
                prop_assert!(error <= 0.5 * (above + 1) as f64 + 1e-6, "{error}");
            }
        }

        #[test]
        fn a_constant_texture_stays_constant_exactly(
            width in 1usize..40, height in 1usize..40, code in 0u16..=255,
        ) {
            let flat = texture(width, height, 255, |_| code);
            let Pyramid { levels } = Pyramid::build(&flat);
            prop_assert!(levels.iter().flat_map(|l| &l.texels).all(|t| t[0] == 257 * code));
        }
    }
}
