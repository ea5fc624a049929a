//! Wood: a trunk along y with rings one unit apart.
//!
//! A ring is light in spring and darkens towards its end, where the next ring begins at once. Noise
//! makes the rings wander slowly along the trunk, and fibres run along it.

use super::blur::Blur;
use super::noise::Noise;
use super::patch::{Form, Patch};
use super::ramp::Ramp;
use crate::color::Color;
use glam::{DVec2, DVec3};

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

    /// Returns the average over a patch of texture space, linear RGB.
    #[must_use]
    pub(super) fn average(&self, patch: &Patch) -> Color {
        let noise = |scale: DVec3, start: f64| {
            self.noise.over(&patch.moved(|at| scale * at, DVec3::splat(start))).blur()
        };
        let slow = |x: f64, y: f64| noise(DVec3::new(x, y, x), 0.0);
        let wander = slow(0.23, 0.06).plus(slow(0.9, 0.17).scaled(0.35, 0.0));
        let radius = Self::across(patch).plus(wander.scaled(self.waver, 0.0));
        let years = DVec3::new(0.83 * radius.mean, 7.5, 0.5);
        let wide = 0.83 * (12.0 * radius.variance).sqrt() * DVec3::X;
        let year = self.noise.over(&Patch { center: years, steps: [wide, DVec3::ZERO] }).blur();
        let ring = radius.plus(year.scaled(0.28, 0.0));
        let fibre = slow(9.0, 0.35);
        let pore = noise(DVec3::new(17.0, 0.8, 17.0), 3.9).scaled(2.0, -0.3).clamped(0.0, 1.0);
        ring.periods(|ring| {
            let late = self.late(ring - ring.floor());
            let pores = pore.scaled(0.5 * (1.0 - 0.5 * late), 0.0);
            let dark = fibre.scaled(0.22, 0.0).plus(pores).tent().above(0.0);
            let shade = fibre.scaled(0.12 * self.grain, late);
            self.colors.average(shade) * (1.0 - self.grain * dark)
        })
    }

    /// Returns the distances of a patch from the axis. Except near the axis they are nearly a
    /// linear function.
    fn across(patch: &Patch) -> Blur {
        let Patch { center, steps } = patch;
        let radius = center.x.hypot(center.z);
        let slopes = steps.map(|step| {
            let outward = (center.x / radius) * step.x + (center.z / radius) * step.z;
            if radius > 0.0 { outward } else { 0.0 }
        });
        Form { middle: radius, slopes: DVec2::from(slopes) }.blur()
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
