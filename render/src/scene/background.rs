//! The background, which is seen by rays that leave the scene.

use super::AngleRamp;
use crate::color::Color;
use glam::DVec3;

/// Colours at infinite distance. A ray sees the colour of its direction alone; nothing is averaged.
#[derive(Debug, Clone, PartialEq)]
pub enum Background {
    /// One colour in all directions, linear RGB.
    Uniform(Color),
    /// Colours by the elevation above the horizon, -90 to 90 degrees; y points up.
    ByElevation(AngleRamp),
}

impl Background {
    /// Returns the colour in a direction, linear RGB. `direction` is unit.
    #[must_use]
    pub fn toward(&self, direction: DVec3) -> Color {
        match self {
            Self::Uniform(color) => *color,
            Self::ByElevation(ramp) => {
                ramp.at_degrees(direction.y.clamp(-1.0, 1.0).asin().to_degrees())
            }
        }
    }
}
