//! A sample of pixels with their true colours.

use super::chances::{Chances, Draw};
use super::truth::{Judge, Truth};
use crate::film::{Crop, Picture, Settings};
use crate::prepared::Prepared;
use rayon::prelude::*;

/// Drawn pixels and their true colours.
#[derive(Debug, Default)]
pub struct Sample {
    draws: Vec<Draw>,
    truths: Vec<Truth>,
    /// Columns and rows of the drawn pixels, in the whole picture.
    pub pixels: Vec<(u32, u32)>,
}

impl Sample {
    /// Draws `count` pixels and finds their true colours, with noise that suits errors near
    /// `accuracy`. Runs on the threads of the current rayon pool.
    #[must_use]
    pub fn take(
        prepared: &Prepared<'_>,
        settings: &Settings,
        chances: &Chances,
        (count, round): (usize, u64),
        accuracy: f64,
    ) -> Self {
        let crop = Crop::of(settings);
        let draws = chances.draw(count, round);
        let pixel = |draw: &Draw| {
            let (row, column) =
                (draw.place / crop.width as usize, draw.place % crop.width as usize);
            (crop.x + column as u32, crop.y + row as u32)
        };
        let pixels: Vec<(u32, u32)> = draws.iter().map(pixel).collect();
        let judge = Judge::new(prepared, settings);
        let drawn = draws.par_iter().zip(&pixels).with_max_len(8);
        let truths = drawn.map(|(draw, &pixel)| judge.look(pixel, draw, accuracy)).collect();
        Self { draws, truths, pixels }
    }

    /// Number of draws.
    #[must_use]
    pub fn len(&self) -> usize {
        self.draws.len()
    }

    /// Returns whether nothing was drawn.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.draws.is_empty()
    }

    /// Rays from the eye for all true colours.
    #[must_use]
    pub fn rays(&self) -> u64 {
        self.truths.iter().map(|truth| truth.rays).sum()
    }

    /// Returns values whose expected mean is the mean squared error of a picture. `color` is the
    /// picture's colour at each draw.
    pub fn values(&self, color: impl Fn(usize) -> [f32; 3]) -> Vec<f64> {
        let draws = self.draws.iter().zip(&self.truths).enumerate();
        draws.map(|(k, (draw, truth))| draw.weight * truth.squared_error(color(k))).collect()
    }

    /// Returns the values of a picture that holds all drawn pixels.
    #[must_use]
    pub fn values_of(&self, picture: &Picture) -> Vec<f64> {
        self.values(|k| picture.pixels[self.draws[k].place])
    }

    /// Returns the mean over all pixels of a number that is known for each draw.
    pub fn mean(&self, of: impl Fn(usize) -> f64) -> f64 {
        let sum: f64 = self.draws.iter().enumerate().map(|(k, draw)| draw.weight * of(k)).sum();
        sum / self.draws.len().max(1) as f64
    }
}
