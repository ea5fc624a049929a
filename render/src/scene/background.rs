//! What rays see that leave the scene.

use super::AngleRamp;
use crate::color::Color;
use glam::DVec3;

/// What is endlessly far away. It has no texture: a ray sees one direction of it.
#[derive(Debug, Clone, PartialEq)]
pub enum Background {
    /// The same in all directions.
    Uniform(Color),
    /// Colours by degrees above the horizon, -90 to 90; y points up.
    ByElevation(AngleRamp),
}

impl Background {
    /// Its colour in a direction, unit.
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
