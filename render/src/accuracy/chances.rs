//! The choice of the pixels that an audit looks at.
//!
//! A few pixels hold most of the squared error, so pixels are drawn with unequal chances, and a
//! weight makes up for the chances (W. Hansen and W. Hurwitz, "On the Theory of Sampling from
//! Finite Populations", 1943). The chances are a mixture. One part follows the error that the
//! method itself estimates, around a pixel and in it. One part follows the contrast to the
//! neighbours, which needs no method. The rest is equal for all pixels: an error that nothing
//! announces is drawn too, and no weight is large.
//!
//! An estimated error counts up to a multiple of the requested one, since pixels above it will be
//! split.

use crate::film::Picture;
use crate::film::pattern::{fraction, mixed};
use rayon::prelude::*;

/// Parts of the mixture: the largest estimated error around a pixel, the pixel's own, its contrast.
/// The rest is equal for all pixels. Chosen on seven pictures of each of five scenes.
const PARTS: [f64; 3] = [0.5, 0.1, 0.2];

/// The part of the contrast where no error is estimated.
const CONTRAST_ALONE: f64 = 0.6;

/// Largest estimated error that counts, in requested errors. Chosen on the peer scenes. Without a
/// limit, an audit of the same precision takes 35 % more rays on the glass at 0.01, and about as many on
/// the tube. With a limit of 0.5, it takes up to 20 % more.
const MOST: f32 = 3.0;

/// Estimates for each pixel of a picture before its cells are split.
#[derive(Debug, Clone, Copy)]
pub struct Estimates<'e> {
    /// Errors, root mean square of linear RGB.
    pub errors: &'e [f32],
    /// The requested error.
    pub requested: f64,
}

/// A pixel that was drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Draw {
    /// Index of the pixel in the picture, row by row.
    pub place: usize,
    /// The mean over all pixels is the expected value of the weight times the drawn pixel's value.
    pub weight: f64,
    /// Seed of the rays of this draw.
    pub seed: u64,
}

/// The chance of each pixel of a picture to be drawn.
#[derive(Debug)]
pub struct Chances {
    /// For each pixel the chance that it or one before it is drawn.
    cumulative: Vec<f64>,
    seed: u64,
}

impl Chances {
    /// Chances for a picture, with the estimates of its method if there are any.
    #[must_use]
    pub fn new(picture: &Picture, estimates: Option<Estimates<'_>>) -> Self {
        let width = picture.width as usize;
        let contrast = around(width, picture.pixels.len(), |own, other| {
            let [own, other] = [picture.pixels[own], picture.pixels[other]];
            (0..3).map(|k| (own[k] - other[k]).powi(2)).sum::<f32>()
        });
        let contrast: Vec<f32> = contrast.iter().map(|squared| squared.sqrt()).collect();
        let parts = match estimates {
            None => vec![(CONTRAST_ALONE, contrast)],
            Some(Estimates { errors, requested }) => {
                let most = MOST * requested as f32;
                let own: Vec<f32> = errors.iter().map(|error| error.min(most)).collect();
                let near = around(width, own.len(), |a, b| own[a].max(own[b]));
                let [of_near, of_own, of_contrast] = PARTS;
                vec![(of_near, near), (of_own, own), (of_contrast, contrast)]
            }
        };
        let count = picture.pixels.len();
        let mut chances = vec![0.0; count];
        let mut equal = 1.0;
        for (part, values) in parts {
            let sum: f64 = values.iter().map(|&value| f64::from(value)).sum();
            if sum > 0.0 && sum.is_finite() {
                equal -= part;
                let values = chances.iter_mut().zip(values);
                values.for_each(|(chance, value)| *chance += part * f64::from(value) / sum);
            }
        }
        let mut sum = 0.0;
        for chance in &mut chances {
            sum += *chance + equal / count as f64;
            *chance = sum;
        }
        let bits = picture.pixels.as_flattened().iter().map(|light| u64::from(light.to_bits()));
        let seed = bits.fold(0, |seed, bits| mixed(seed ^ bits));
        Self { cumulative: chances, seed }
    }

    /// Draws pixels. A pixel may be drawn several times. `round` selects one of many independent
    /// selections; the pictures decide the rest.
    #[must_use]
    pub fn draw(&self, count: usize, round: u64) -> Vec<Draw> {
        let Some(&whole) = self.cumulative.last() else { return Vec::new() };
        let first = mixed(self.seed ^ mixed(round));
        // One draw in each of `count` equal parts of the chances: no region is left out by accident.
        let draw = |k: usize| {
            let seed = mixed(first ^ k as u64);
            let at = whole * (k as f64 + fraction(seed)) / count as f64;
            let place = self.cumulative.partition_point(|&sum| sum <= at);
            let place = place.min(self.cumulative.len() - 1);
            let before = if place == 0 { 0.0 } else { self.cumulative[place - 1] };
            let chance = (self.cumulative[place] - before) / whole;
            Draw { place, weight: 1.0 / (chance * self.cumulative.len() as f64), seed: mixed(seed) }
        };
        (0..count).map(draw).collect()
    }
}

/// Returns for each of `count` pixels the largest value of `of` for the pixel and one of its up to
/// eight neighbours, or 0.
fn around(width: usize, count: usize, of: impl Fn(usize, usize) -> f32 + Sync) -> Vec<f32> {
    let height = count / width;
    let row = |y: usize| {
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        let of = &of;
        (0..width).map(move |x| {
            let columns = x.saturating_sub(1)..(x + 2).min(width);
            let places = rows.clone().flat_map(|y| columns.clone().map(move |x| y * width + x));
            places.map(|other| of(y * width + x, other)).fold(0.0, f32::max)
        })
    };
    (0..height).into_par_iter().flat_map_iter(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture with an edge down the middle.
    fn edge() -> Picture {
        let mut picture = Picture::black(40, 30);
        for (k, pixel) in picture.pixels.iter_mut().enumerate() {
            *pixel = if k % 40 < 20 { [0.1; 3] } else { [0.9, 0.2, 0.4] };
        }
        picture
    }

    /// The weighted mean of any function of the pixels is that over all pixels.
    #[test]
    fn weights_make_up_for_the_chances() {
        let picture = edge();
        let mut errors = vec![0.0; 1200];
        errors[777] = 3.0;
        let estimates = Estimates { errors: &errors, requested: 0.01 };
        for estimates in [None, Some(estimates)] {
            let chances = Chances::new(&picture, estimates);
            for value in [|_| 1.0, |place| (place % 40) as f64, |place| f64::from(place == 777)] {
                let all = (0..1200).map(value).sum::<f64>() / 1200.0;
                let draws = chances.draw(4000, 1);
                let values: Vec<f64> = draws.iter().map(|d| d.weight * value(d.place)).collect();
                let mean = values.iter().sum::<f64>() / 4000.0;
                let square = values.iter().map(|x| x * x).sum::<f64>() / 4000.0;
                // Five standard errors; draws that are spread have smaller ones.
                let margin = 5.0 * ((square - mean * mean).max(0.0) / 4000.0).sqrt();
                assert!((mean - all).abs() <= margin + 1e-12, "{mean} of {all}, {margin}");
            }
        }
    }

    #[test]
    fn no_weight_is_large_and_edges_are_drawn_more_often() {
        let chances = Chances::new(&edge(), None);
        let draws = chances.draw(1000, 0);
        assert!(draws.iter().all(|draw| draw.weight <= 1.0 / (1.0 - CONTRAST_ALONE) + 1e-9));
        let beside = |draw: &&Draw| matches!(draw.place % 40, 19 | 20);
        // Two of forty columns have the chance 0.6 + 0.4 / 20.
        let found = draws.iter().filter(beside).count();
        assert!((610..=630).contains(&found), "{found}");
        assert_ne!(chances.draw(10, 0), chances.draw(10, 1));
    }

    #[test]
    fn a_constant_picture_is_drawn_evenly() {
        let zeros = [0.0; 100];
        let nothing = Estimates { errors: &zeros, requested: 0.01 };
        let draws = Chances::new(&Picture::black(10, 10), Some(nothing)).draw(100, 5);
        assert!(draws.iter().all(|draw| (draw.weight - 1.0).abs() < 1e-9));
        let mut places: Vec<usize> = draws.iter().map(|draw| draw.place).collect();
        places.dedup();
        assert!(places.len() > 60, "one draw in each hundredth: {places:?}");
    }
}
