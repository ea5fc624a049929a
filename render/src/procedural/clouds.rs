//! Colours by a sum of octaves: turbulence, or clouds.

use super::ramp::Ramp;
use super::turbulence::Octaves;
use crate::color::Color;
use glam::DVec3;

/// A sum of octaves through a ramp.
#[derive(Debug, Clone, PartialEq)]
pub struct Clouds {
    /// Colours from the least that the sum can be, at 0, to the most, at 1.
    pub colors: Ramp,
    /// The octaves.
    pub octaves: Octaves,
    /// Which sum.
    pub sum: Sum,
}

/// A sum of octaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sum {
    /// Of the noise: soft, and a half as a mean.
    Fractal,
    /// Of its size: with creases where it changes sign.
    Turbulence,
}

impl Clouds {
    /// The colour at a point.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let part = match self.sum {
            Sum::Fractal => 0.5 + 0.5 * self.octaves.fractal(point) / self.octaves.weight(),
            Sum::Turbulence => self.octaves.turbulence(point) / self.octaves.weight(),
        };
        self.colors.color(part)
    }
}
