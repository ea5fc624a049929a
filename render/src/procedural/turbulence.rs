//! Sums of noise at doubled frequencies and halved strengths (K. Perlin, "An Image Synthesizer",
//! 1985, which the thesis follows in 2.1).
//!
//! Octave `k` looks at a space that is finer by `2^k`. Each is also turned and moved against the
//! one before: without that the lattices of all octaves would meet in the same planes, and the
//! planes would show. The turn is by 60 degrees about the diagonal of the cells, which takes no
//! axis to another.

use super::noise::Noise;
use glam::{DMat3, DVec3};

/// More octaves than this add less than a thousandth.
pub const MOST_OCTAVES: u32 = 12;

/// From an octave's space to the next one's, before it is moved: a turn, times two.
const FINER: DMat3 = DMat3::from_cols_array(&[
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

/// How far the next octave's space is moved; parts of a cell, and no two alike.
const MOVED: DVec3 = DVec3::new(0.371, 5.593, 11.817);

/// Octaves of a noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Octaves {
    /// The noise.
    pub noise: Noise,
    /// How many, 1 to [`MOST_OCTAVES`].
    pub count: u32,
}

impl Octaves {
    /// The places where the octaves look, coarsest first, with the weight of each and the linear
    /// part of the way there.
    fn places(&self, point: DVec3) -> impl Iterator<Item = (DVec3, f64, DMat3)> {
        let first = (point, 1.0, DMat3::IDENTITY);
        let next = |&(point, weight, turn): &(DVec3, f64, DMat3)| {
            Some((FINER * point + MOVED, 0.5 * weight, FINER * turn))
        };
        std::iter::successors(Some(first), next).take(self.count as usize)
    }

    /// The sum of all weights, `2 - 2^(1 - count)`.
    #[must_use]
    pub fn weight(&self) -> f64 {
        2.0 - 0.5_f64.powi(self.count as i32 - 1)
    }

    /// The fractal sum of `noise / 2^k`; at most [`Octaves::weight`], with either sign.
    #[must_use]
    pub fn fractal(&self, point: DVec3) -> f64 {
        self.places(point).map(|(at, weight, _)| weight * self.noise.value(at)).sum()
    }

    /// The turbulence: the sum of `|noise| / 2^k`, from 0 to [`Octaves::weight`].
    #[must_use]
    pub fn turbulence(&self, point: DVec3) -> f64 {
        self.places(point).map(|(at, weight, _)| weight * self.noise.value(at).abs()).sum()
    }

    /// The gradient of [`Octaves::fractal`].
    #[must_use]
    pub fn fractal_gradient(&self, point: DVec3) -> DVec3 {
        self.places(point)
            .map(|(at, weight, turn)| turn.transpose() * (weight * self.noise.gradient(at)))
            .sum()
    }

    /// The gradient of [`Octaves::turbulence`]; where an octave is 0, as if it were rising.
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
