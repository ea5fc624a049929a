//! Granite: crystals of several minerals, grown together.
//!
//! Crystals are grains with boundaries that noise makes ragged. The mineral of each crystal is
//! random, with the probability of the mineral's share, and each crystal has its own tone. Smaller
//! flakes of one more mineral, usually mica, lie over the crystals.

use super::grains::Grain;
use super::noise::Noise;
use super::noise_average::correlation;
use super::patch::Patch;
use crate::color::Color;
use glam::DVec3;

/// Factor by which flakes are smaller than crystals.
const FLAKE: f64 = 1.7;

/// Factor by which the grains within a crystal, which break up its tone, are smaller than the
/// crystal.
const FINE: f64 = 4.3;

/// Part of space nearer than a random distance from 0.35 to 0.7 to the nearest centre of a grain,
/// in cells. Measured at 4 million points, for which it deviates by 0.0003.
const FLAKE_FILL: f64 = 0.505;

/// Margin of the dark boundary between crystals.
const WIDTH: f64 = 0.08;

/// Mean over space of the nearness to a boundary: 1 on the boundary, and 0 from a margin of
/// [`WIDTH`] on. Measured at the same points.
const BOUNDARY: f64 = 0.147;

/// Granite with crystals about one unit large.
#[derive(Debug, Clone, PartialEq)]
pub struct Granite {
    /// Share of each mineral, more than 0, and its colour. There is at least one mineral.
    pub minerals: Vec<(f64, Color)>,
    /// Part of the cells that hold a flake, 0 to 1.
    pub flakes: f64,
    /// Colour of the flakes, linear RGB.
    pub flake: Color,
    /// Variation in tone between crystals of one mineral, 0 to 1.
    pub vary: f64,
    /// Noise that makes the boundaries ragged.
    pub noise: Noise,
}

impl Granite {
    /// Returns the colour at a point of texture space, linear RGB.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        self.detailed(point, |_| 1.0)
    }

    /// Returns the colour at a point. `seen` returns the visibility, 0 to 1, of details that are
    /// finer than crystals by a factor. Details that are not seen have their mean.
    fn detailed(&self, point: DVec3, seen: impl Fn(f64) -> f64) -> Color {
        let shift = |strength: f64, finer: f64| match strength * seen(finer) {
            0.0 => DVec3::ZERO,
            strength => strength * self.ragged(finer * point),
        };
        let ragged = point + shift(0.22, 2.6) + shift(0.1, 7.1);
        let flake = Grain::of(FLAKE * ragged, 21);
        // A flake ends at a boundary of its own and not at the neighbouring flakes.
        if flake.share(0) < self.flakes && flake.distance < 0.35 + 0.35 * flake.share(1) {
            return self.flake * self.tone(flake.share(2), 2.0);
        }
        let crystal = Grain::of(ragged, 11);
        let fine = match seen(FINE) {
            0.0 => 1.0,
            seen => self.tone(Grain::of(FINE * ragged, 31).share(0), 0.35 * seen),
        };
        let lines = seen(1.0 / WIDTH);
        let near = lines * (1.0 - crystal.margin / WIDTH).max(0.0) + (1.0 - lines) * BOUNDARY;
        let boundary = 1.0 - 0.3 * self.vary * near;
        let tone = self.tone(crystal.share(1), 0.6) * fine;
        self.mineral(crystal.share(0)) * tone * boundary
    }

    /// Returns the average over a patch of texture space, linear RGB.
    #[must_use]
    pub(super) fn average(&self, patch: &Patch) -> Color {
        let kept = correlation(patch);
        if kept == 0.0 {
            return self.mean();
        }
        let seen = |finer: f64| correlation(&patch.moved(|at| finer * at, DVec3::ZERO));
        self.mean().lerp(self.detailed(patch.center, seen), kept)
    }

    /// Returns the mean colour of all space, linear RGB.
    #[must_use]
    pub(super) fn mean(&self) -> Color {
        let total: f64 = self.minerals.iter().map(|(share, _)| share).sum();
        let sum: Color = self.minerals.iter().map(|&(share, color)| share * color).sum();
        // Tones have the mean 1, and so do all random numbers that are independent of a flake.
        let crystals = sum / total * (1.0 - 0.3 * self.vary * BOUNDARY);
        crystals.lerp(self.flake, self.flakes * FLAKE_FILL)
    }

    /// Returns the colour of the mineral at `part`, in [0, 1], of the sum of all shares.
    fn mineral(&self, part: f64) -> Color {
        let total: f64 = self.minerals.iter().map(|(share, _)| share).sum();
        let mut left = part * total;
        for &(share, color) in &self.minerals {
            if left < share {
                return color;
            }
            left -= share;
        }
        // Rounding can lead past the last mineral.
        self.minerals.last().map_or(Color::ZERO, |&(_, color)| color)
    }

    /// Returns a tone factor around 1 for a random number in [0, 1).
    fn tone(&self, random: f64, spread: f64) -> f64 {
        1.0 + self.vary * spread * (random - 0.5)
    }

    /// Returns a vector of noise with independent coordinates.
    fn ragged(&self, point: DVec3) -> DVec3 {
        let shift = |k: f64| self.noise.value(point + k * DVec3::new(13.7, 5.3, 21.1));
        DVec3::new(shift(0.0), shift(1.0), shift(2.0))
    }
}
