//! The wall of thesis 2.2 and figure A.8: a slow noise, clamped, plus a fast one (G. D. Abram and
//! T. Whitted, "Building Block Shaders", 1990).
//!
//! Where the slow noise is clamped the wall is a level plain, above or below; between them it has
//! slopes. The fast noise roughens all of it.

use super::noise::Noise;
use super::ramp::Ramp;
use crate::color::Color;
use glam::DVec3;

/// The heights of a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// The slow noise stays between these, within `[-1, 1]`; the first is the lower.
    pub clamp: [f64; 2],
    /// Strength of the fast noise, at least 0.
    pub rough: f64,
    /// How much faster it is, more than 0.
    pub frequency: f64,
    /// Both noises.
    pub noise: Noise,
}

/// A wall with colours.
#[derive(Debug, Clone, PartialEq)]
pub struct WallPaint {
    /// The heights.
    pub wall: Wall,
    /// Colours from the lowest height that can be, at 0, to the highest, at 1.
    pub colors: Ramp,
}

impl Wall {
    /// The height at a point.
    #[must_use]
    pub fn height(&self, point: DVec3) -> f64 {
        let [low, high] = self.clamp;
        self.noise.value(point).clamp(low, high)
            + self.rough * self.noise.value(self.frequency * point)
    }

    /// Its gradient; none of the slow noise where that is clamped.
    #[must_use]
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        let [low, high] = self.clamp;
        let slow = self.noise.value(point);
        let fast = self.rough * self.frequency * self.noise.gradient(self.frequency * point);
        if slow > low && slow < high { self.noise.gradient(point) + fast } else { fast }
    }
}

impl WallPaint {
    /// The colour at a point.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let [low, high] = self.wall.clamp;
        let (lowest, highest) = (low - self.wall.rough, high + self.wall.rough);
        self.colors.color((self.wall.height(point) - lowest) / (highest - lowest))
    }
}
