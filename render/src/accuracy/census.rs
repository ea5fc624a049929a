//! The true colours of all pixels of a picture, to check audits.

use super::bound::mean;
use super::chances::Draw;
use super::truth::{Judge, Truth};
use crate::film::pattern::mixed;
use crate::film::{Crop, Picture, Settings};
use crate::prepared::Prepared;
use rayon::prelude::*;

/// The true colours of all pixels.
#[derive(Debug)]
pub struct Census {
    truths: Vec<Truth>,
}

/// A mean squared error over all pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Squared {
    /// The mean. The noise of the true colours can make it negative.
    pub mean: f64,
    /// About the standard deviation of the mean, which the noise of the true colours causes.
    pub deviation: f64,
}

impl Census {
    /// Finds the true colours of all pixels, with noise that suits errors near `accuracy`. The rays
    /// are independent of those of all audits. Runs on the threads of the current rayon pool.
    #[must_use]
    pub fn take(prepared: &Prepared<'_>, settings: &Settings, accuracy: f64) -> Self {
        let crop = Crop::of(settings);
        let judge = Judge::new(prepared, settings);
        let rows = crop.rows().into_par_iter().flat_map_iter(|y| {
            let judge = &judge;
            crop.columns().map(move |x| {
                // Seeds of draws are other permutations of other numbers.
                let seed = mixed(mixed(u64::from(y) << 32 | u64::from(x)) ^ 0x0cea_5ed0);
                judge.look((x, y), &Draw { place: 0, weight: 1.0, seed }, accuracy)
            })
        });
        Self { truths: rows.collect() }
    }

    /// Returns the mean squared error of a picture of the same pixels.
    #[must_use]
    pub fn squared_error(&self, picture: &Picture) -> Squared {
        let pairs = self.truths.iter().zip(&picture.pixels);
        let values: Vec<f64> = pairs.map(|(truth, color)| truth.squared_error(*color)).collect();
        // The product of two independent noises has the product of their variances.
        let noise: f64 = self.truths.iter().map(Truth::noise).map(|noise| noise * noise).sum();
        let count = values.len().max(1) as f64;
        Squared { mean: mean(&values), deviation: noise.sqrt() / count }
    }
}
