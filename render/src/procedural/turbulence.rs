//! Sums of noise at doubled frequencies and halved strengths (K. Perlin, "An Image Synthesizer",
//! 1985, which the thesis follows in 2.1).
//!
//! Octave `k` evaluates the noise in a space that is finer by `2^k`. Each octave is also rotated
//! and moved against the one before. Without this the lattices of all octaves would meet in common
//! planes, and the planes would show. The rotation is by 60 degrees about the diagonal of the
//! cells, which maps no axis to another.

use super::noise::Noise;
use glam::{DMat3, DVec3};

/// Largest number of octaves. Further octaves add less than a thousandth.
pub const MOST_OCTAVES: u32 = 12;

/// Linear map from an octave's space to the next one's: a rotation and a factor of two.
pub(super) const FINER: DMat3 = DMat3::from_cols_array(&[
    4.0 / 3.0,
    4.0 / 3.0,
    -2.0 / 3.0,
    -2.0 / 3.0,
    4.0 / 3.0,
    4.0 / 3.0,
    4.0 / 3.0,
    -2.0 / 3.0,
    4.0 / 3.0,
]);

/// Translation to the next octave's space, in cells. Its three fractional parts differ.
pub(super) const MOVED: DVec3 = DVec3::new(0.371, 5.593, 11.817);

/// A noise summed over several octaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Octaves {
    /// The noise of each octave.
    pub noise: Noise,
    /// Number of octaves, 1 to [`MOST_OCTAVES`].
    pub count: u32,
}

impl Octaves {
    /// Lists the octaves, coarsest first: the position at which each evaluates its noise, its
    /// weight, and the linear part of the map to its space.
    pub(super) fn places(&self, point: DVec3) -> impl Iterator<Item = (DVec3, f64, DMat3)> {
        let first = (point, 1.0, DMat3::IDENTITY);
        let next = |&(point, weight, turn): &(DVec3, f64, DMat3)| {
            Some((FINER * point + MOVED, 0.5 * weight, FINER * turn))
        };
        std::iter::successors(Some(first), next).take(self.count as usize)
    }

    /// Returns the sum of all weights, `2 - 2^(1 - count)`.
    #[must_use]
    pub fn weight(&self) -> f64 {
        2.0 - 0.5_f64.powi(self.count as i32 - 1)
    }

    /// Returns the fractal sum of `noise / 2^k`. Its absolute value is at most [`Octaves::weight`].
    #[must_use]
    pub fn fractal(&self, point: DVec3) -> f64 {
        self.places(point).map(|(at, weight, _)| weight * self.noise.value(at)).sum()
    }

    /// Returns the turbulence, the sum of `|noise| / 2^k`, from 0 to [`Octaves::weight`].
    #[must_use]
    pub fn turbulence(&self, point: DVec3) -> f64 {
        self.places(point).map(|(at, weight, _)| weight * self.noise.value(at).abs()).sum()
    }

    /// Returns the gradient of [`Octaves::fractal`].
    #[must_use]
    pub fn fractal_gradient(&self, point: DVec3) -> DVec3 {
        self.places(point)
            .map(|(at, weight, turn)| turn.transpose() * (weight * self.noise.gradient(at)))
            .sum()
    }

    /// Returns the gradient of [`Octaves::turbulence`]. Where the noise of an octave is 0 it counts
    /// as positive.
    #[must_use]
    pub fn turbulence_gradient(&self, point: DVec3) -> DVec3 {
        self.places(point)
            .map(|(at, weight, turn)| {
                let sign = if self.noise.value(at) < 0.0 { -1.0 } else { 1.0 };
                turn.transpose() * (sign * weight * self.noise.gradient(at))
            })
            .sum()
    }
}
