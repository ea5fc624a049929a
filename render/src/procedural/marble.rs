//! Marble: layers that turbulence has folded, and veins along them (K. Perlin, 1985).
//!
//! Layers lie one unit apart along x; a vein is where a folded layer passes. Between the large
//! veins runs a net of fine ones, and both fade in and out, as veins in stone do.

use super::ramp::Ramp;
use super::turbulence::Octaves;
use crate::color::Color;
use glam::DVec3;
use std::f64::consts::PI;

/// The fine net is finer by this and lies across the layers.
const NET: f64 = 2.3;

/// Veined stone.
#[derive(Debug, Clone, PartialEq)]
pub struct Marble {
    /// Colours from the middle of a vein, at 0, to the ground farthest from it, at 1.
    pub colors: Ramp,
    /// What folds the layers.
    pub octaves: Octaves,
    /// How far they are folded, in layers; at least 0.
    pub folds: f64,
    /// How much of the fine net is seen, 0 to 1.
    pub net: f64,
}

impl Marble {
    /// The colour at a point.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        self.colors.color(self.to_vein(point))
    }

    /// How far a point is from a vein: 0 in its middle, up to 1.
    fn to_vein(&self, point: DVec3) -> f64 {
        let fold = self.octaves.fractal(point);
        let layer = (PI * (point.x + self.folds * fold)).sin().abs();
        // Slow noise, different from that of the folds: veins are wide here and lost there.
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
