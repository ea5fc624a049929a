//! The exact average of a texture over any quadrilateral.
//!
//! A level of a pyramid is chosen so that the shorter axis of the footprint still spans some texels.
//! On this level the average over the quadrilateral is exact ([`level`]). Its cost grows with the
//! number of lines that the quadrilateral crosses and not with the number of texels in it.
//!
//! A texture is interpolated between its texels, and not constant on them. An interpolated texture is
//! the constant one under a box of one texel. The average is therefore that of the constant texture
//! over the footprint under this box. [`Outline::grown`] is a quadrilateral of the same covariance.
//! For thin footprints the edges of the box matter. Several quadrilaterals, less grown and moved
//! apart, stand for it. A footprint smaller than a texel is sampled.
//!
//! A quadrilateral that is seen in strong perspective is the mean of two halves, each of which is seen by
//! half of the pixel ([`Outline::halves`]).
//!
//! Where all texels near a footprint are equal, their code is the average ([`range`]).
//!
//! | footprint | average |
//! |---|---|
//! | not finite | the texel at its middle |
//! | no area | as if it were grown by a texel |
//! | folded or not convex | that over the parallelogram of its mean sides |
//! | as large as many repetitions of the texture, or longer than 2^40 texels | the mean |
//! | beyond the edge of a clamped texture | with the edge texels of the level, at least 64 to a side |

mod coverage;
mod level;
mod levels;
mod line;
mod palette;
mod range;
mod steps;

use super::outline::{self, Outline};
use crate::color::Color;
use crate::footprint::Footprint;
use crate::texture::Texture;
use glam::{DVec2, DVec3};
use levels::{FEW_LINES, Levels, MOST_LINES};

/// Longest axis of a footprint that is sampled, in texels.
///
/// Nine samples of a larger footprint miss some of its texels. Integrals over a smaller one are as
/// exact but cost more.
const SAMPLED: f64 = 1.0;

/// A texture that is averaged exactly over quadrilaterals.
#[derive(Debug)]
pub struct Exact(Channels);

/// A grey texture has one channel.
#[derive(Debug)]
enum Channels {
    Grey(Levels<1>),
    Color(Levels<3>),
}

impl Exact {
    /// Prepares a texture.
    #[must_use]
    pub fn build(texture: &Texture) -> Self {
        Self(if palette::is_grey(texture) {
            Channels::Grey(Levels::build(texture, |[grey, ..]| [grey]))
        } else {
            Channels::Color(Levels::build(texture, |texel| texel))
        })
    }

    /// Memory of all levels, in bytes.
    ///
    /// For a texture of at most 256 codes, as from a picture of 8 bits, it is at most 5 bytes for each
    /// texel and channel from 512 texels a side. For one of 16 bits it is at most 8. A grey texture has
    /// one channel.
    #[must_use]
    pub fn bytes(&self) -> usize {
        match &self.0 {
            Channels::Grey(levels) => levels.bytes(),
            Channels::Color(levels) => levels.bytes(),
        }
    }

    /// Returns the value of [`Self::bytes`] without building anything.
    #[must_use]
    pub fn bytes_for(texture: &Texture) -> u64 {
        if palette::is_grey(texture) {
            Levels::<1>::bytes_for(texture)
        } else {
            Levels::<3>::bytes_for(texture)
        }
    }

    /// Returns the average over the footprint, linear RGB. `texture` is the one that was prepared.
    #[must_use]
    pub fn average(&self, texture: &Texture, footprint: &Footprint) -> Color {
        self.look(texture, footprint, MOST_LINES).0
    }

    /// Returns the average over the footprint, linear RGB, and the contrast of the texture near it.
    /// Unlike [`Exact::average`], the average of a long slanted footprint may be blurred at the ends.
    ///
    /// The contrast is an estimate, in light, of the change of the average if the footprint moved. It
    /// is the smaller of two numbers: half the range of the texels near the footprint, and the standard
    /// deviation of the whole texture on the level whose texels are as large as the footprint's shorter
    /// axis. Of three channels, the largest counts.
    #[must_use]
    pub fn average_and_contrast(&self, texture: &Texture, footprint: &Footprint) -> (Color, f64) {
        self.look(texture, footprint, FEW_LINES)
    }

    /// Returns the average and the contrast, for at most `most_lines` lines.
    fn look(&self, texture: &Texture, footprint: &Footprint, most_lines: f64) -> (Color, f64) {
        let Some(outline) = Outline::of(footprint, texture) else {
            return (texture.point(footprint.bounds().0), 0.0);
        };
        match &self.0 {
            Channels::Grey(levels) => {
                let ([grey], contrast) =
                    look(levels, texture, &outline, most_lines, |color| [color.x]);
                (within(DVec3::splat(grey)), contrast)
            }
            Channels::Color(levels) => {
                let (color, contrast) =
                    look(levels, texture, &outline, most_lines, |color| color.to_array());
                (within(color.into()), contrast)
            }
        }
    }
}

/// Limits an average to the light that texels can have, which rounding exceeds by about 1e-16.
fn within(color: Color) -> Color {
    color.clamp(Color::ZERO, Color::ONE)
}

/// Returns the average and the contrast of an outline, in light. `channels` picks the channels of a
/// colour.
fn look<const C: usize>(
    levels: &Levels<C>,
    texture: &Texture,
    outline: &Outline,
    most_lines: f64,
    channels: impl Fn(Color) -> [f64; C],
) -> ([f64; C], f64) {
    let range = levels.range(outline);
    if range.iter().all(|[low, high]| low == high) {
        return (range.map(|[code, _]| f64::from(code) * texture.unit()), 0.0);
    }
    let contrast = levels.contrast(&range, outline.axes);
    if outline.axes.major <= SAMPLED {
        return (channels(sampled(texture, outline)), contrast);
    }
    let average = match outline.halves() {
        Some([near, far]) => {
            let [near, far] = [near, far].map(|half| levels.average(texture, &half, most_lines));
            std::array::from_fn(|c| 0.5 * (near[c] + far[c]))
        }
        None => levels.average(texture, outline, most_lines),
    };
    (average, contrast)
}

/// Averages nine samples of a small footprint.
fn sampled(texture: &Texture, outline: &Outline) -> Color {
    let size = DVec2::new(texture.width as f64, texture.height as f64);
    let [a, b] = outline.sides;
    let mut sum = DVec3::ZERO;
    for u in [-1.0 / 3.0, 0.0, 1.0 / 3.0] {
        for v in [-1.0 / 3.0, 0.0, 1.0 / 3.0] {
            let at = (outline.center + u * a + v * b + 4.0 * u * v * outline.bend) / size;
            sum += texture.bilinear(DVec2::new(at.x, 1.0 - at.y));
        }
    }
    sum / 9.0
}

/// Returns the largest distance in texels, across and down, from the centre of an outline to a place
/// that the average reads.
///
/// A quadrilateral grows by at most half a texel along each axis, and is moved by a quarter along each.
/// Interpolation reaches half a texel.
#[must_use]
pub fn reach(outline: &Outline) -> DVec2 {
    let (low, high) = outline.bounds();
    0.5 * (high - low) + 0.75
}

/// Rounds down. Positions are far below 2^63.
#[inline(always)]
fn floor(at: f64) -> f64 {
    let toward_zero = at as i64 as f64;
    toward_zero - f64::from(u8::from(toward_zero > at))
}

/// Returns the binary logarithm of a number, rounded down: its exponent. 0 for numbers below 2 and for
/// NaN.
#[inline(always)]
fn octave(number: f64) -> usize {
    let exponent = number.max(1.0).to_bits() >> (f64::MANTISSA_DIGITS - 1);
    exponent as usize + 1 - f64::MAX_EXP as usize
}

#[cfg(test)]
mod tests;
