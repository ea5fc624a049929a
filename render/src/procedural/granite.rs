//! Granite: crystals of several minerals, grown together.
//!
//! Crystals are grains whose boundaries noise has made ragged. Each has a mineral, by chance and
//! by that mineral's share, and its own tone. Smaller flakes of one mineral more, mica as a rule,
//! lie over all of them.

use super::grains::Grain;
use super::noise::Noise;
use crate::color::Color;
use glam::DVec3;

/// Flakes are smaller than crystals by this.
const FLAKE: f64 = 1.7;

/// The crystals within a crystal, which break up its tone.
const FINE: f64 = 4.3;

/// Crystals of about one unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Granite {
    /// The share of each mineral, more than 0, and its colour; at least one.
    pub minerals: Vec<(f64, Color)>,
    /// The part of space cells that hold a flake, 0 to 1.
    pub flakes: f64,
    /// The colour of flakes.
    pub flake: Color,
    /// How much crystals of one mineral differ in tone, 0 to 1.
    pub vary: f64,
    /// What makes boundaries ragged.
    pub noise: Noise,
}

impl Granite {
    /// The colour at a point.
    #[must_use]
    pub fn color(&self, point: DVec3) -> Color {
        let ragged = point + 0.22 * self.ragged(2.6 * point) + 0.1 * self.ragged(7.1 * point);
        let flake = Grain::of(FLAKE * ragged, 21);
        // A flake fills its cell up to a boundary of its own, not to its neighbours.
        if flake.share(0) < self.flakes && flake.distance < 0.35 + 0.35 * flake.share(1) {
            return self.flake * self.tone(flake.share(2), 2.0);
        }
        let crystal = Grain::of(ragged, 11);
        let fine = Grain::of(FINE * ragged, 31);
        let boundary = 1.0 - 0.3 * self.vary * (1.0 - crystal.margin / 0.08).max(0.0);
        let tone = self.tone(crystal.share(1), 0.6) * self.tone(fine.share(0), 0.35);
        self.mineral(crystal.share(0)) * tone * boundary
    }

    /// The mineral at a part of the sum of all shares.
    fn mineral(&self, part: f64) -> Color {
        let total: f64 = self.minerals.iter().map(|(share, _)| share).sum();
        let mut left = part * total;
        for &(share, color) in &self.minerals {
            if left < share {
                return color;
            }
            left -= share;
        }
        // A rounding past the last one.
        self.minerals.last().map_or(Color::ZERO, |&(_, color)| color)
    }

    /// A factor around 1 for a random number.
    fn tone(&self, random: f64, spread: f64) -> f64 {
        1.0 + self.vary * spread * (random - 0.5)
    }

    /// Noise in each coordinate.
    fn ragged(&self, point: DVec3) -> DVec3 {
        let shift = |k: f64| self.noise.value(point + k * DVec3::new(13.7, 5.3, 21.1));
        DVec3::new(shift(0.0), shift(1.0), shift(2.0))
    }
}
