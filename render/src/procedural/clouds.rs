//! Turbulence and clouds: colours from a sum of octaves.

use super::patch::Patch;
use super::ramp::Ramp;
use super::turbulence::Octaves;
use crate::color::Color;
use glam::DVec3;

/// A sum of octaves mapped through a ramp.
#[derive(Debug, Clone, PartialEq)]
pub struct Clouds {
    /// Colours from the least possible sum, at 0, to the largest, at 1.
    pub colors: Ramp,
    /// The octaves that are summed.
    pub octaves: Octaves,
    /// Kind of the sum.
    pub sum: Sum,
}

/// A kind of sum of octaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sum {
    /// Sum of the noise itself. It is soft and scaled to a mean of one half.
    Fractal,
    /// Sum of the absolute value of the noise. It has creases where the noise changes sign.
    Turbulence,
}

impl Clouds {
    /// Returns the colour at a point of texture space, linear RGB.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let part = match self.sum {
            Sum::Fractal => 0.5 + 0.5 * self.octaves.fractal(point) / self.octaves.weight(),
            Sum::Turbulence => self.octaves.turbulence(point) / self.octaves.weight(),
        };
        self.colors.color(part)
    }

    /// Returns the average over a patch of texture space, linear RGB.
    #[must_use]
    pub(super) fn average(&self, patch: &Patch) -> Color {
        let weight = 1.0 / self.octaves.weight();
        let part = match self.sum {
            Sum::Fractal => self.octaves.fractal_over(patch).blur().scaled(0.5 * weight, 0.5),
            Sum::Turbulence => self.octaves.turbulence_over(patch).scaled(weight, 0.0),
        };
        self.colors.average(part)
    }
}
