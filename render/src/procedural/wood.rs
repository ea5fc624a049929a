//! Wood: a trunk along y with rings one unit apart.
//!
//! A ring is light in spring and darkens towards its end, where the next ring begins at once. Noise
//! makes the rings wander slowly along the trunk, and fibres run along it.

use super::noise::Noise;
use super::ramp::Ramp;
use crate::color::Color;
use glam::DVec3;

/// The part of a ring in which late wood changes back to early wood.
const FALL: f64 = 0.12;

/// The wood of a trunk along y.
#[derive(Debug, Clone, PartialEq)]
pub struct Wood {
    /// Colours from early wood, at 0, to late wood, at 1.
    pub colors: Ramp,
    /// Distance by which rings wander, in rings; 0 or more.
    pub waver: f64,
    /// Strength of the fibres, 0 to 1.
    pub grain: f64,
    /// Noise from which rings and fibres are made.
    pub noise: Noise,
}

impl Wood {
    /// Returns the colour at a point of texture space, linear RGB.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let slow = |x: f64, y: f64| self.noise.value(DVec3::new(x, y, x) * point);
        let across = point.x.hypot(point.z);
        let wander = slow(0.23, 0.06) + 0.35 * slow(0.9, 0.17);
        let radius = across + self.waver * wander;
        // Some years are wide and some narrow, equally all around.
        let year = self.noise.value(DVec3::new(0.83 * radius, 7.5, 0.5));
        let ring = radius + 0.28 * year;
        let late = self.late(ring - ring.floor());
        // Fibres are long and thin, and darker where pores are open.
        let fibre = self.noise.value(DVec3::new(9.0, 0.35, 9.0) * point);
        let pore = self.noise.value(DVec3::new(17.0, 0.8, 17.0) * point + DVec3::splat(3.9));
        let dark = 0.22 * fibre + 0.5 * ((pore - 0.15) / 0.5).clamp(0.0, 1.0) * (1.0 - 0.5 * late);
        self.colors.color(late + 0.12 * self.grain * fibre) * (1.0 - self.grain * dark.max(0.0))
    }

    /// Returns how late in the year the wood grew, 0 to 1. `part` is the position within a ring,
    /// from 0 at its inner side to 1 at its outer side.
    fn late(&self, part: f64) -> f64 {
        if part > 1.0 - FALL {
            let fall = (1.0 - part) / FALL;
            return fall * fall * (3.0 - 2.0 * fall);
        }
        let grown = part / (1.0 - FALL);
        grown * grown * (1.6 - 0.6 * grown)
    }
}
