//! Averages of solid textures over parallelograms, against sums over many points.

use glam::{DAffine3, DVec3};
use proptest::prelude::*;
use render::color::Color;
use render::procedural::blocks::{Brick, Checker, Stripes};
use render::procedural::clouds::{Clouds, Sum};
use render::procedural::granite::Granite;
use render::procedural::marble::Marble;
use render::procedural::wall::{Wall, WallPaint};
use render::procedural::wood::Wood;
use render::procedural::{
    Interpolation, Noise, NoiseLattice, Octaves, Pattern, Placement, Ramp, Solid,
};
use std::sync::{Arc, LazyLock};

/// Parallelograms of a test, from a generator that gives the same numbers in every run.
struct Numbers(u64);

impl Numbers {
    /// Returns a number from 0 to 1.
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.share(), self.share(), self.share()) - 0.5
    }

    /// Returns the middle and the steps of a parallelogram on a random plane. Its longer step has a
    /// length between the ends of `sizes`, and the other is up to 30 times shorter. Logarithms of
    /// lengths are distributed uniformly.
    fn patch(&mut self, sizes: [f64; 2]) -> (DVec3, [DVec3; 2]) {
        let length = sizes[0] * (sizes[1] / sizes[0]).powf(self.share());
        let other = length * 30f64.powf(-self.share());
        let steps = [length * self.vector().normalize(), other * self.vector().normalize()];
        (100.0 * self.vector(), steps)
    }
}

fn solid(pattern: Pattern) -> Solid {
    Solid { pattern, placement: Placement::default() }
}

fn average(solid: &Solid, (point, steps): (DVec3, [DVec3; 2])) -> Color {
    solid.average(&DAffine3::IDENTITY, point, steps)
}

/// Returns the mean of the colours in the middles of `count` by `count` cells of a parallelogram.
fn summed(solid: &Solid, (point, steps): (DVec3, [DVec3; 2]), count: u32) -> Color {
    let part = |k: u32| (f64::from(k) + 0.5) / f64::from(count) - 0.5;
    let mut sum = Color::ZERO;
    for i in 0..count {
        for j in 0..count {
            let at = point + part(i) * steps[0] + part(j) * steps[1];
            sum += solid.color(&DAffine3::IDENTITY, at);
        }
    }
    sum / f64::from(count * count)
}

/// Root of the mean square, and largest absolute value, of an average's error.
fn errors(solid: &Solid, sizes: [f64; 2], count: u32) -> (f64, f64) {
    let mut numbers = Numbers(1993);
    let (mut squares, mut largest) = (0.0, 0f64);
    let tries = 120;
    for _ in 0..tries {
        let patch = numbers.patch(sizes);
        let error = average(solid, patch) - summed(solid, patch, count);
        squares += error.length_squared() / 3.0;
        largest = largest.max(error.abs().max_element());
    }
    ((squares / f64::from(tries)).sqrt(), largest)
}

fn checker() -> Solid {
    solid(Pattern::Checker(Checker { colors: [Color::ZERO, Color::ONE] }))
}

fn stripes() -> Solid {
    let layers = vec![(0.5, Color::ONE), (0.25, Color::X), (1.0, Color::Y), (0.4, Color::X)];
    solid(Pattern::Stripes(Stripes { layers }))
}

fn brick(vary: f64) -> Solid {
    let colors = [Color::new(0.8, 0.3, 0.2), Color::ONE];
    let size = DVec3::new(2.0, 0.75, 1.0);
    solid(Pattern::Brick(Brick { size, joint: 0.1, colors, vary }))
}

/// Textures from noise, each with a ramp that is not linear. They share one lattice.
static OF_NOISE: LazyLock<Vec<Solid>> = LazyLock::new(|| {
    let lattice = Arc::new(NoiseLattice::new());
    let noise = Noise { lattice, interpolation: Interpolation::Smooth };
    let octaves = Octaves { noise: noise.clone(), count: 6 };
    let ramp = |stops: &[(f64, [f64; 3])]| {
        let stops = stops.iter().map(|&(at, color)| (at, Color::from(color)));
        Ramp::new(stops.collect()).unwrap()
    };
    let cloudy = ramp(&[
        (0.0, [0.1, 0.1, 0.2]),
        (0.35, [0.2, 0.3, 0.6]),
        (0.6, [0.9, 0.9, 0.7]),
        (1.0, [1.0, 0.2, 0.2]),
    ]);
    let veined =
        ramp(&[(0.0, [0.05, 0.06, 0.08]), (0.2, [0.4, 0.4, 0.45]), (0.6, [0.9, 0.85, 0.8])]);
    let grown = ramp(&[(0.0, [0.6, 0.4, 0.2]), (1.0, [0.25, 0.12, 0.05])]);
    let clouds = |sum| Clouds { colors: cloudy.clone(), octaves: octaves.clone(), sum };
    let minerals = vec![
        (0.5, Color::new(0.8, 0.7, 0.65)),
        (0.3, Color::splat(0.5)),
        (0.2, Color::new(0.9, 0.9, 0.85)),
    ];
    let wall = Wall { clamp: [-0.2, 0.3], rough: 0.15, frequency: 8.0, noise: noise.clone() };
    let marble = |folds, net| {
        Pattern::Marble(Marble { colors: veined.clone(), octaves: octaves.clone(), folds, net })
    };
    let patterns = [
        Pattern::Clouds(clouds(Sum::Fractal)),
        Pattern::Clouds(clouds(Sum::Turbulence)),
        Pattern::Wall(WallPaint { wall, colors: cloudy.clone() }),
        Pattern::Wood(Wood { colors: grown, waver: 0.8, grain: 0.5, noise: noise.clone() }),
        marble(1.3, 0.0),
        marble(1.3, 0.7),
        Pattern::Granite(Granite {
            minerals,
            flakes: 0.25,
            flake: Color::splat(0.05),
            vary: 0.4,
            noise,
        }),
    ];
    patterns.map(solid).to_vec()
});

/// The point in the middle of a parallelogram of 1 to 30 cells says little about it. The average is
/// an estimate as well, from few values. It must be better by a factor that the picture shows, for
/// sums of noise and grains whose cells have side 1. Sums of 40 by 40 points are exact to a tenth of
/// the errors of the averages.
#[test]
fn averages_of_noise_are_better_than_a_point() {
    for solid in OF_NOISE.iter() {
        let mut numbers = Numbers(1993);
        let (mut of_average, mut of_point) = (0.0_f64, 0.0_f64);
        for _ in 0..150 {
            let patch = numbers.patch([1.0, 30.0]);
            let truth = summed(solid, patch, 40);
            of_average += (average(solid, patch) - truth).length_squared();
            let point = solid.color(&DAffine3::IDENTITY, patch.0);
            of_point += (point - truth).length_squared();
        }
        let ratio = (of_point / of_average).sqrt();
        let least = if matches!(solid.pattern, Pattern::Granite(_)) { 4.0 } else { 5.0 };
        assert!(ratio > least, "{:?}: {ratio}", solid.pattern);
    }
}

/// Far away every texture has its mean colour. The mean of 10^5 random points deviates by 0.001 for
/// independent points; noise repeats after 64 cells, so they are spread over whole periods.
#[test]
fn averages_over_large_areas_are_the_mean() {
    for solid in OF_NOISE.iter() {
        let mut numbers = Numbers(7);
        let count = 100_000;
        let colors = (0..count).map(|_| solid.color(&DAffine3::IDENTITY, 128.0 * numbers.vector()));
        let mean = colors.sum::<Color>() / f64::from(count);
        let far = average(solid, (DVec3::splat(3.3), [1e3 * DVec3::X, 1e3 * DVec3::Z]));
        assert!(far.abs_diff_eq(mean, 0.01), "{:?}: {far} {mean}", solid.pattern);
    }
}

/// Over a tiny parallelogram an average is nearly the colour. Over a slightly larger one it changes
/// little, but where the number of evaluated points changes: there by the error of the estimate.
#[test]
fn averages_of_noise_change_slowly_with_the_size() {
    for solid in OF_NOISE.iter() {
        let mut numbers = Numbers(3);
        let (mut squares, mut count) = (0.0_f64, 0.0);
        for _ in 0..100 {
            let (point, steps) = numbers.patch([1.0, 1.0]);
            let of_size = |size: f64| average(solid, (point, steps.map(|step| size * step)));
            if !matches!(solid.pattern, Pattern::Granite(_)) {
                // The finest noise has 32 cells per unit, and ramps have slopes of about 5.
                let color = solid.color(&DAffine3::IDENTITY, point);
                assert!(of_size(1e-6).abs_diff_eq(color, 1e-2), "{:?}", solid.pattern);
            }
            for k in -40..40 {
                let (small, large) = (1.1f64.powi(k), 1.1f64.powi(k + 1));
                squares += (of_size(large) - of_size(small)).length_squared();
                count += 3.0;
            }
        }
        let change = (squares / count).sqrt();
        // The edges of crystals are sharp, and each evaluated point that crosses one shows.
        let most = if matches!(solid.pattern, Pattern::Granite(_)) { 0.05 } else { 0.02 };
        assert!(change < most, "{:?}: {change}", solid.pattern);
    }
}

/// The boundaries of cells are lines. A sum over the middles of a lattice of `n` by `n` points
/// misplaces each by up to half a distance of points. Up to 3 cells, 20 lines cross a
/// parallelogram, and their errors add up to less than 20 / 2 n.
#[test]
fn small_averages_of_blocks_are_exact() {
    for solid in [checker(), stripes(), brick(0.4)] {
        let (root, largest) = errors(&solid, [0.01, 3.0], 200);
        assert!(root < 0.003 && largest < 0.05, "{:?}: {root} {largest}", solid.pattern);
    }
}

/// The sum has the error of its 300 by 300 points. The averages of large patches are estimates,
/// whose error must not be visible.
#[test]
fn large_averages_of_blocks_are_close() {
    // Tones of bricks that are not counted have a deviation of 0.5 / sqrt(12) of `vary`, divided by
    // the root of their number.
    for solid in [checker(), stripes(), brick(0.0), brick(0.15)] {
        let (root, largest) = errors(&solid, [3.0, 100.0], 300);
        assert!(root < 0.006 && largest < 0.06, "{:?}: {root} {largest}", solid.pattern);
    }
}

/// A parallelogram of whole periods has the mean colour, in closed form.
#[test]
fn whole_periods_have_the_mean_colour() {
    let point = DVec3::new(0.3, 0.4, -1.7);
    for periods in 1..=3 {
        let side = 2.0 * f64::from(periods);
        let patch = (point, [side * DVec3::X, side * DVec3::Z]);
        // Positions are rounded to 1e-16, and a few dozen of them are added.
        assert!(average(&checker(), patch).abs_diff_eq(Color::splat(0.5), 1e-13), "{periods}");
        let patch = (point, [2.15 * f64::from(periods) * DVec3::X, DVec3::Y]);
        let mean = (0.5 * Color::ONE + 0.65 * Color::X + Color::Y) / 2.15;
        assert!(average(&stripes(), patch).abs_diff_eq(mean, 1e-13), "{periods}");
        // What remains of an incomplete period vanishes over a very long step.
        for far in [1e9, 1e200, f64::MAX, f64::INFINITY, f64::NAN] {
            let patch = (point, [far * DVec3::X, 0.5 * far * DVec3::Z]);
            assert!(average(&checker(), patch).abs_diff_eq(Color::splat(0.5), 1e-5), "{far}");
            assert!(average(&stripes(), patch).abs_diff_eq(mean, 1e-5), "{far}");
        }
    }
}

proptest! {
    #[test]
    fn a_point_has_the_colour_of_its_point(
        point in prop::array::uniform3(-50.0..50.0f64), step in prop::array::uniform3(-1.0..1.0f64),
    ) {
        let (point, step) = (DVec3::from(point), DVec3::from(step));
        let blocks = [checker(), stripes(), brick(0.4)];
        for solid in blocks.iter().chain(OF_NOISE.iter()) {
            let color = solid.color(&DAffine3::IDENTITY, point);
            prop_assert_eq!(average(solid, (point, [DVec3::ZERO; 2])), color);
            // A surface that moves along an edge of the film only.
            prop_assert!(average(solid, (point, [step, DVec3::ZERO])).is_finite());
            prop_assert!(average(solid, (point, [step, -2.0 * step])).is_finite());
        }
    }

    /// Steps of any size, also at the end of the range of numbers, give a colour of the pattern.
    #[test]
    fn averages_are_between_the_colours_of_the_pattern(
        point in prop::array::uniform3(any::<f64>()),
        steps in prop::array::uniform2(prop::array::uniform3(any::<f64>())),
    ) {
        let patch = (DVec3::from(point), steps.map(DVec3::from));
        for solid in OF_NOISE.iter() {
            let color = average(solid, patch);
            // A tone varies by less than the colour itself.
            let fits = color.min_element() >= 0.0 && color.max_element() <= 2.0;
            prop_assert!(fits, "{:?}: {color}", solid.pattern);
        }
        for solid in [checker(), stripes(), brick(0.0)] {
            let color = average(&solid, patch);
            // Weights are rounded to 1e-16 and add up to 1.
            let fits = color.min_element() >= -1e-12 && color.max_element() <= 1.0 + 1e-12;
            prop_assert!(fits, "{:?}: {color}", solid.pattern);
        }
    }

    /// A parallelogram is the union of its quarters. Over so few cells nothing is
    /// estimated.
    #[test]
    fn an_average_is_that_of_its_quarters(
        point in prop::array::uniform3(-50.0..50.0f64),
        steps in prop::array::uniform2(prop::array::uniform3(-0.7..0.7f64)),
    ) {
        let (point, steps) = (DVec3::from(point), steps.map(DVec3::from));
        for solid in [checker(), stripes(), brick(0.4)] {
            let mut quarters = Color::ZERO;
            for (a, b) in [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)] {
                let middle = point + a * steps[0] + b * steps[1];
                quarters += 0.25 * average(&solid, (middle, steps.map(|step| 0.5 * step)));
            }
            let whole = average(&solid, (point, steps));
            // Closed forms are divided by an area of at least one cell, after rounding to 1e-15.
            prop_assert!(whole.abs_diff_eq(quarters, 1e-6), "{:?}: {whole} {quarters}", solid.pattern);
        }
    }
}
