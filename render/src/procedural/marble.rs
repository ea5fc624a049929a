//! Marble: layers folded by turbulence, with veins along them (K. Perlin, 1985).
//!
//! Layers lie one unit apart along x, and a vein follows each folded layer. A net of fine veins
//! runs between the large ones. Both fade in and out, as veins in stone do.

use super::ramp::Ramp;
use super::turbulence::Octaves;
use crate::color::Color;
use glam::DVec3;
use std::f64::consts::PI;

/// Factor by which the fine net is finer than the layers, across which it lies.
const NET: f64 = 2.3;

/// Veined stone.
#[derive(Debug, Clone, PartialEq)]
pub struct Marble {
    /// Colours from the middle of a vein, at 0, to the ground farthest from it, at 1.
    pub colors: Ramp,
    /// Octaves of noise that fold the layers.
    pub octaves: Octaves,
    /// Strength of the folds, in layers; 0 or more.
    pub folds: f64,
    /// Visibility of the fine net, 0 to 1.
    pub net: f64,
}

impl Marble {
    /// Returns the colour at a point of texture space, linear RGB.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        self.colors.color(self.to_vein(point))
    }

    /// Returns the distance of a point from a vein: 0 in the vein's middle, at most 1.
    fn to_vein(&self, point: DVec3) -> f64 {
        let fold = self.octaves.fractal(point);
        let layer = (PI * (point.x + self.folds * fold)).sin().abs();
        // Slow noise, independent of the folds, by which veins are wide in some regions and fade in
        // others.
        let noise = &self.octaves.noise;
        let slow = noise.value(0.47 * point + DVec3::new(17.3, 4.7, 29.1));
        let lost = (0.25 + 1.1 * slow).clamp(0.0, 1.0);
        let large = layer + (1.0 - layer) * 0.85 * lost;
        if self.net == 0.0 {
            return large;
        }
        let across = NET * DVec3::new(point.y - 0.4 * point.z, point.z, point.x);
        let shift = self.octaves.fractal(across + DVec3::splat(31.7));
        let thread = (1.6 * shift).abs().min(1.0).powf(0.55);
        let shown =
            self.net * (0.6 - 0.8 * noise.value(0.9 * point - DVec3::splat(8.3))).clamp(0.0, 1.0);
        large * (1.0 - shown * (1.0 - thread))
    }
}
