//! The wall of thesis 2.2 and figure A.8: a clamped slow noise plus a fast noise (G. D. Abram and
//! T. Whitted, "Building Block Shaders", 1990).
//!
//! Where the slow noise is clamped, the wall is a level plain, high or low. Between the plains it
//! has slopes. The fast noise roughens the whole wall.

use super::noise::Noise;
use super::patch::Patch;
use super::ramp::Ramp;
use crate::color::Color;
use glam::DVec3;

/// The height field of a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// Lower and upper limit of the slow noise, within `[-1, 1]`.
    pub clamp: [f64; 2],
    /// Strength of the fast noise, 0 or more.
    pub rough: f64,
    /// Frequency of the fast noise relative to the slow one, more than 0.
    pub frequency: f64,
    /// The noise that is used for both.
    pub noise: Noise,
}

/// A wall with colours.
#[derive(Debug, Clone, PartialEq)]
pub struct WallPaint {
    /// The height field of the wall.
    pub wall: Wall,
    /// Colours from the lowest possible height, at 0, to the highest, at 1.
    pub colors: Ramp,
}

impl Wall {
    /// Returns the height at a point of texture space.
    #[must_use]
    pub fn height(&self, point: DVec3) -> f64 {
        let [low, high] = self.clamp;
        self.noise.value(point).clamp(low, high)
            + self.rough * self.noise.value(self.frequency * point)
    }

    /// Returns the gradient of the height. The slow noise contributes nothing where it is clamped.
    #[must_use]
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        let [low, high] = self.clamp;
        let slow = self.noise.value(point);
        let fast = self.rough * self.frequency * self.noise.gradient(self.frequency * point);
        if slow > low && slow < high { self.noise.gradient(point) + fast } else { fast }
    }
}

impl WallPaint {
    /// Returns the colour at a point of texture space, linear RGB.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let [low, high] = self.wall.clamp;
        let (lowest, highest) = (low - self.wall.rough, high + self.wall.rough);
        self.colors.color((self.wall.height(point) - lowest) / (highest - lowest))
    }

    /// Returns the average over a patch of texture space, linear RGB.
    #[must_use]
    pub(super) fn average(&self, patch: &Patch) -> Color {
        let Wall { clamp: [low, high], rough, frequency, noise } = &self.wall;
        let fast = noise.over(&patch.moved(|at| *frequency * at, DVec3::ZERO)).blur();
        let scale = 1.0 / (high - low + 2.0 * rough);
        let fast = fast.scaled(scale * rough, scale * (rough - low));
        noise.over(patch).blur().color(|slow| {
            let slow = slow.clamp(*low, *high);
            self.colors.average(fast.scaled(1.0, scale * slow))
        })
    }
}
