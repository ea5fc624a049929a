//! A sample of pixels with their true colours.

use super::chances::{Chances, Draw};
use super::truth::{Judge, Truth};
use crate::film::{Crop, GoOn, Picture, Settings};
use crate::prepared::Prepared;
use rayon::prelude::*;
use std::collections::HashMap;

/// Drawn pixels and their true colours. The sample grows by further draws and keeps what it has.
#[derive(Debug, Default)]
pub struct Sample {
    draws: Vec<Draw>,
    truths: Vec<Truth>,
    /// Columns and rows of the drawn pixels in the whole picture, each pixel once.
    pub pixels: Vec<(u32, u32)>,
    /// For each draw the index of its pixel in `pixels`.
    places: Vec<usize>,
    /// The index in `pixels` of each drawn place.
    known: HashMap<usize, usize>,
}

impl Sample {
    /// Draws `count` pixels and finds their true colours in `truth`, with noise that suits errors near
    /// `accuracy`. Runs on the threads of the current rayon pool.
    #[must_use]
    pub fn take(
        truth: &Prepared<'_>,
        settings: &Settings,
        chances: &Chances,
        (count, round): (usize, u64),
        accuracy: f64,
    ) -> Self {
        let mut sample = Self::default();
        sample.grow(truth, settings, chances, (count, round), accuracy, &|| true);
        sample
    }

    /// Draws `count` more pixels. Each call needs a `round` of its own. The sample is of no use once
    /// `go_on` has returned false.
    pub fn grow(
        &mut self,
        truth: &Prepared<'_>,
        settings: &Settings,
        chances: &Chances,
        (count, round): (usize, u64),
        accuracy: f64,
        go_on: &GoOn<'_>,
    ) {
        let crop = Crop::of(settings);
        let pixel = |draw: &Draw| {
            let (row, column) =
                (draw.place / crop.width as usize, draw.place % crop.width as usize);
            (crop.x + column as u32, crop.y + row as u32)
        };
        let draws = chances.draw(count, round);
        for draw in &draws {
            let next = self.pixels.len();
            let index = *self.known.entry(draw.place).or_insert(next);
            if index == next {
                self.pixels.push(pixel(draw));
            }
            self.places.push(index);
        }
        let judge = Judge::new(truth, settings);
        let look = |draw: &Draw| match go_on() {
            true => judge.look(pixel(draw), draw, accuracy),
            false => Truth::default(),
        };
        self.truths.par_extend(draws.par_iter().with_max_len(8).map(look));
        self.draws.extend(draws);
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
    /// picture's colour at a pixel of [`Sample::pixels`].
    pub fn values(&self, color: impl Fn(usize) -> [f32; 3]) -> Vec<f64> {
        let draws = self.draws.iter().zip(&self.truths).zip(&self.places);
        draws.map(|((draw, truth), &k)| draw.weight * truth.squared_error(color(k))).collect()
    }

    /// Returns the values of a picture that holds all drawn pixels.
    #[must_use]
    pub fn values_of(&self, picture: &Picture) -> Vec<f64> {
        let draws = self.draws.iter().zip(&self.truths);
        let value = |(draw, truth): (&Draw, &Truth)| {
            draw.weight * truth.squared_error(picture.pixels[draw.place])
        };
        draws.map(value).collect()
    }

    /// Returns the mean over all pixels of a number that is known for each of [`Sample::pixels`].
    pub fn mean(&self, of: impl Fn(usize) -> f64) -> f64 {
        let draws = self.draws.iter().zip(&self.places);
        let sum: f64 = draws.map(|(draw, &k)| draw.weight * of(k)).sum();
        sum / self.draws.len().max(1) as f64
    }

    /// Returns the index of a draw's pixel in [`Sample::pixels`].
    #[must_use]
    pub fn index(&self, draw: usize) -> usize {
        self.places[draw]
    }

    /// Returns the first `count` draws with their true colours.
    pub fn first(&self, count: usize) -> impl Iterator<Item = (&Draw, &Truth)> {
        self.draws.iter().zip(&self.truths).take(count)
    }

    /// Finds the true colours of the first `count` draws again, in a scene with other meshes.
    #[must_use]
    pub fn again(&self, scene: &Prepared<'_>, settings: &Settings, count: usize) -> Vec<Truth> {
        let judge = Judge::new(scene, settings);
        let count = count.min(self.draws.len());
        let drawn = self.draws[..count].par_iter().zip(&self.truths).zip(&self.places);
        let look = |((draw, truth), &k): ((&Draw, &Truth), &usize)| {
            judge.look_again(self.pixels[k], draw, truth)
        };
        drawn.with_max_len(8).map(look).collect()
    }
}
