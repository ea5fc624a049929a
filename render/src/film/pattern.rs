//! Positions of the samples within their cells of the sampling lattice.

use clap::ValueEnum;
use glam::DVec2;
use schemars::JsonSchema;
use serde::Deserialize;

/// Position of a sample within its cell of the sampling lattice.
///
/// The footprint of a sample is spanned by its neighbours. With jitter these are the samples of the
/// neighbouring cells, wherever they lie in their cells. The box that they span is as wide on
/// average as that of a regular grid, and the sample is not in the middle of the box.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Pattern {
    /// The middle of the cell.
    #[default]
    Regular,
    /// A pseudo-random position, from a hash of the seed and the sample's column and row. It is the
    /// same for any number of threads, any tiles and any crop.
    Jitter {
        /// Seed of the hash. Different seeds give different patterns.
        seed: u64,
    },
}

/// The name of a [`Pattern`], on the command line and in JSON. The attribute `help` is the text of
/// `--help`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ValueEnum, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(description = "Positions of rays in their cells.")]
pub enum PatternName {
    /// The name of [`Pattern::Regular`].
    #[default]
    #[value(help = "The middle of the cell")]
    #[schemars(description = "The middle of the cell.")]
    Regular,
    /// The name of [`Pattern::Jitter`].
    #[value(help = "A pseudo-random position, from a hash of the ray's number and --seed")]
    #[schemars(
        description = "A pseudo-random position, from a hash of the ray's number and the seed."
    )]
    Jitter,
}

impl PatternName {
    /// Returns the pattern of this name. Without a seed, jitter has the seed 0. Returns `None` if a
    /// seed is given for a pattern that has none.
    #[must_use]
    pub fn pattern(self, seed: Option<u64>) -> Option<Pattern> {
        match (self, seed) {
            (Self::Jitter, seed) => Some(Pattern::Jitter { seed: seed.unwrap_or(0) }),
            (Self::Regular, None) => Some(Pattern::Regular),
            (Self::Regular, Some(_)) => None,
        }
    }
}

impl Pattern {
    /// Returns the position of the sample in column `x` and row `y` of the film's lattice within
    /// its cell. Both coordinates are in `[0, 1)`.
    #[must_use]
    pub fn offset(self, x: i64, y: i64) -> DVec2 {
        match self {
            Self::Regular => DVec2::splat(0.5),
            Self::Jitter { seed } => {
                let hash = mixed(mixed(mixed(seed) ^ x as u64) ^ y as u64);
                DVec2::new(fraction(hash), fraction(mixed(hash)))
            }
        }
    }
}

/// One step of the generator `SplitMix64` (Steele, Lea and Flood 2014). It is a permutation of all
/// words, in which each bit of the argument flips about half of the result's bits.
#[must_use]
pub fn mixed(word: u64) -> u64 {
    let word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

/// Returns the upper 53 bits of a word as a number in `[0, 1)`.
#[must_use]
pub fn fraction(word: u64) -> f64 {
    (word >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jitter_is_even_and_without_ties_between_neighbours() {
        let pattern = Pattern::Jitter { seed: 7 };
        let (mut sum, mut squares, mut along, mut axes) = (DVec2::ZERO, DVec2::ZERO, 0.0, 0.0);
        let count = 200 * 200;
        for y in -100..100 {
            for x in -100..100 {
                let at = pattern.offset(x, y);
                assert!(at.cmpge(DVec2::ZERO).all() && at.cmplt(DVec2::ONE).all());
                let from_middle = at - 0.5;
                sum += from_middle;
                squares += from_middle * from_middle;
                along += from_middle.x * (pattern.offset(x + 1, y).x - 0.5);
                axes += from_middle.x * from_middle.y;
            }
        }
        let n = f64::from(count);
        // Five standard deviations: of the mean sqrt(1/12 / n), of the square sqrt(1/180 / n), and
        // of the products 1/12 / sqrt(n).
        assert!((sum / n).abs().max_element() < 5.0 * (1.0 / 12.0 / n).sqrt());
        assert!((squares / n - 1.0 / 12.0).abs().max_element() < 5.0 * (1.0 / 180.0 / n).sqrt());
        for product in [along, axes] {
            assert!((product / n).abs() < 5.0 / 12.0 / n.sqrt());
        }
    }

    #[test]
    fn another_seed_is_another_pattern() {
        let at = |seed| Pattern::Jitter { seed }.offset(3, -4);
        assert_eq!(at(1), at(1));
        assert_ne!(at(1), at(2));
    }
}
