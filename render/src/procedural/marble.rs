//! Marble: layers folded by turbulence, with veins along them (K. Perlin, 1985).
//!
//! Layers lie one unit apart along x, and a vein follows each folded layer. A net of fine veins
//! runs between the large ones. Both fade in and out, as veins in stone do.

use super::blur::Blur;
use super::noise_average::Field;
use super::patch::Patch;
use super::ramp::Ramp;
use super::turbulence::Octaves;
use crate::color::Color;
use glam::DVec3;
use std::f64::consts::PI;

/// Factor by which the fine net is finer than the layers, across which it lies.
const NET: f64 = 2.3;

/// Frequency of the slow noise that widens and fades veins.
const SLOW: f64 = 0.47;

/// Frequency of the noise that shows and hides the net.
const SHOWN: f64 = 0.9;

/// Translations that make the noises independent, in cells.
const SLOW_START: DVec3 = DVec3::new(17.3, 4.7, 29.1);
const NET_START: DVec3 = DVec3::splat(31.7);
const SHOWN_START: DVec3 = DVec3::splat(-8.3);

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

    /// Returns the average over a patch of texture space, linear RGB.
    #[must_use]
    pub(super) fn average(&self, patch: &Patch) -> Color {
        let mut layer = Field { form: patch.form(DVec3::X, 0.0), variance: 0.0 };
        layer.add(self.folds, &self.octaves.fractal_over(patch));
        let noise = &self.octaves.noise;
        let slow = noise.over(&patch.moved(|at| SLOW * at, SLOW_START)).blur();
        let lost = slow.scaled(1.1, 0.25).clamped(0.0, 1.0).scaled(0.85, 0.0);
        let ground = self.ground(patch);
        layer.blur().periods(|position| {
            let layer = (PI * (position - position.floor())).sin();
            let large = lost.scaled(1.0 - layer, layer);
            self.colors.average(large.times(ground))
        })
    }

    /// Returns the factor by which the fine net brings the ground nearer to a vein: 1 beside the
    /// net's threads.
    fn ground(&self, patch: &Patch) -> Blur {
        if self.net == 0.0 {
            return Blur::sharp(1.0);
        }
        let shift = self.octaves.fractal_over(&patch.moved(across, NET_START)).blur();
        let thread = shift.through(|shift| (1.6 * shift).abs().min(1.0).powf(0.55));
        let noise = self.octaves.noise.over(&patch.moved(|at| SHOWN * at, SHOWN_START)).blur();
        let shown = noise.scaled(-0.8, 0.6).clamped(0.0, 1.0).scaled(self.net, 0.0);
        shown.times(thread.scaled(-1.0, 1.0)).scaled(-1.0, 1.0)
    }

    /// Returns the distance of a point from a vein: 0 in the vein's middle, at most 1.
    fn to_vein(&self, point: DVec3) -> f64 {
        let fold = self.octaves.fractal(point);
        let layer = (PI * (point.x + self.folds * fold)).sin().abs();
        // Slow noise, independent of the folds, by which veins are wide in some regions and fade in
        // others.
        let noise = &self.octaves.noise;
        let slow = noise.value(SLOW * point + SLOW_START);
        let lost = (0.25 + 1.1 * slow).clamp(0.0, 1.0);
        let large = layer + (1.0 - layer) * 0.85 * lost;
        if self.net == 0.0 {
            return large;
        }
        let shift = self.octaves.fractal(across(point) + NET_START);
        let thread = (1.6 * shift).abs().min(1.0).powf(0.55);
        let shown =
            self.net * (0.6 - 0.8 * noise.value(SHOWN * point + SHOWN_START)).clamp(0.0, 1.0);
        large * (1.0 - shown * (1.0 - thread))
    }
}

/// Maps texture space to that of the net, whose layers lie across those of the veins.
fn across(point: DVec3) -> DVec3 {
    NET * DVec3::new(point.y - 0.4 * point.z, point.z, point.x)
}
