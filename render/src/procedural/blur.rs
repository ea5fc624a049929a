//! The values of a texture within a patch, by their mean and variance.
//!
//! The exact distribution of noise over a patch is unknown: only few of its values are computed. A
//! [`Blur`] stands for a distribution with the shape of a tent, which resembles that of
//! interpolated noise. Its density falls linearly from the mean to 0 on both sides. Piecewise
//! linear functions have their mean over a tent in closed form.

use crate::color::Color;

/// A distribution of values with the shape of a tent.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Blur {
    /// Mean of the values.
    pub mean: f64,
    /// Variance of the values, 0 or more.
    pub variance: f64,
}

/// The density of a [`Blur`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tent {
    mean: f64,
    /// Half the width.
    reach: f64,
}

impl Blur {
    /// Returns the distribution with only one value.
    #[must_use]
    pub fn sharp(mean: f64) -> Self {
        Self { mean, variance: 0.0 }
    }

    /// Returns the distribution of `factor * value + offset`.
    #[must_use]
    pub fn scaled(self, factor: f64, offset: f64) -> Self {
        Self { mean: factor * self.mean + offset, variance: factor * factor * self.variance }
    }

    /// Returns the distribution of the sum of this value and an independent one.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { mean: self.mean + other.mean, variance: self.variance + other.variance }
    }

    /// Returns the distribution of the product of this value and an independent one.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        let mean = self.mean * other.mean;
        Self { mean, variance: (self.square() * other.square() - mean * mean).max(0.0) }
    }

    /// Returns the mean of the squares of the values.
    #[must_use]
    pub fn square(self) -> f64 {
        self.mean * self.mean + self.variance
    }

    /// Returns the tent of this mean and variance.
    #[must_use]
    pub fn tent(self) -> Tent {
        Tent { mean: self.mean, reach: self.reach() }
    }

    fn reach(self) -> f64 {
        (6.0 * self.variance).sqrt()
    }

    /// Returns the distribution of the absolute values.
    #[must_use]
    pub fn abs(self) -> Self {
        let mean = 2.0 * self.tent().above(0.0) - self.mean;
        Self { mean, variance: (self.square() - mean * mean).max(0.0) }
    }

    /// Returns the distribution of the values clamped to `[low, high]`.
    #[must_use]
    pub fn clamped(self, low: f64, high: f64) -> Self {
        let tent = self.tent();
        let mean = low + tent.above(low) - tent.above(high);
        let variance = self.through(|x| x.clamp(low, high)).variance;
        Self { mean, variance }
    }

    /// Returns the mean and variance of `function` of the values, from a few of them.
    #[must_use]
    pub fn through(self, function: impl Fn(f64) -> f64) -> Self {
        if self.variance == 0.0 {
            return Self::sharp(function(self.mean));
        }
        let (mut sum, mut squares) = (0.0, 0.0);
        for value in self.nodes() {
            let value = function(value);
            sum += value;
            squares += value * value;
        }
        let (mean, square) = (sum / NODES.len() as f64, squares / NODES.len() as f64);
        Self { mean, variance: (square - mean * mean).max(0.0) }
    }

    /// Returns the mean of a colour that is a function of the values, from a few of them.
    #[must_use]
    pub fn color(self, function: impl Fn(f64) -> Color) -> Color {
        if self.variance == 0.0 {
            return function(self.mean);
        }
        self.nodes().into_iter().map(function).sum::<Color>() / NODES.len() as f64
    }

    /// Returns a few values, each for an equal part of the distribution.
    fn nodes(self) -> [f64; 6] {
        let reach = self.reach();
        NODES.map(|place| self.mean + place * reach)
    }

    /// Returns the mean of a function of period 1 at the values. The values are regarded as
    /// distributed uniformly, as those of a linear function are. If they fill a period, all parts
    /// of the period weigh the same.
    #[must_use]
    pub fn periods(self, function: impl Fn(f64) -> Color) -> Color {
        let width = (12.0 * self.variance).sqrt().min(1.0);
        // Narrow distributions need few positions.
        let count = (f64::from(PERIOD) * width).ceil().max(1.0);
        let place = |k: u32| (f64::from(k) + 0.5) / count - 0.5;
        let sum: Color = (0..count as u32).map(|k| function(self.mean + width * place(k))).sum();
        sum / count
    }
}

impl Tent {
    /// Returns the mean of `max(value - start, 0)`.
    #[must_use]
    pub fn above(&self, start: f64) -> f64 {
        let over = self.mean - start;
        if over.abs() >= self.reach {
            return over.max(0.0);
        }
        let near = 1.0 - over.abs() / self.reach;
        over.max(0.0) + self.reach * near * near * near / 6.0
    }

    /// Returns the probability of a value of at least `start`.
    #[must_use]
    pub fn beyond(&self, start: f64) -> f64 {
        let over = self.mean - start;
        if over.abs() >= self.reach {
            return f64::from(u8::from(over >= 0.0));
        }
        let near = 1.0 - over.abs() / self.reach;
        if over < 0.0 { 0.5 * near * near } else { 1.0 - 0.5 * near * near }
    }
}

/// Number of positions in a period at which a periodic function is evaluated. A smaller number
/// shows narrow veins as steps, and a larger one costs time.
const PERIOD: u32 = 8;

/// Positions in a tent from -1 to 1: the middles, by mass, of six parts of equal mass. Positions are
/// scaled so that the variance is exact, as the test of quadratic functions asserts.
const NODES: [f64; 6] = [-OUTER, -MIDDLE, -INNER, INNER, MIDDLE, OUTER];
const INNER: f64 = 0.092_507_676_482_732_5;
const MIDDLE: f64 = 0.310_973_947_885_747_3;
const OUTER: f64 = 0.628_281_412_687_116_3;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Mean of a function over the tent by Simpson's rule, on pieces of 1/500 of the tent.
    fn integrated(blur: Blur, function: impl Fn(f64) -> f64) -> f64 {
        let reach = (6.0 * blur.variance).sqrt();
        let mut sum = 0.0;
        for k in 0..=2000 {
            let place = f64::from(k) / 1000.0 - 1.0;
            let simpson = if k == 0 || k == 2000 { 1.0 } else { f64::from(2 + k % 2 * 2) };
            sum += simpson * (1.0 - place.abs()) * function(blur.mean + reach * place);
        }
        sum / 3000.0
    }

    proptest! {
        /// Simpson's rule is exact but for the pieces with a kink or a step, of which there is one.
        #[test]
        fn closed_forms_are_the_integrals_over_the_tent(
            mean in -2.0..2.0f64, variance in 0.0..1.0f64, start in -2.0..2.0f64,
        ) {
            let blur = Blur { mean, variance };
            prop_assert!((integrated(blur, |_| 1.0) - 1.0).abs() < 1e-12);
            let hinge = integrated(blur, |x| (x - start).max(0.0));
            prop_assert!((blur.tent().above(start) - hinge).abs() < 1e-4);
            prop_assert!((blur.abs().mean - integrated(blur, f64::abs)).abs() < 1e-4);
            prop_assert!((blur.abs().square() - integrated(blur, |x| x * x)).abs() < 1e-9);
            let step = integrated(blur, |x| f64::from(u8::from(x >= start)));
            // A step misplaces at most one piece, of 1/500 of the tent.
            prop_assert!((blur.tent().beyond(start) - step).abs() < 2e-3);
        }

        /// The nodes have the tent's mean and variance, so quadratic functions are exact.
        #[test]
        fn nodes_are_exact_for_quadratic_functions(mean in -2.0..2.0f64, variance in 0.0..1.0f64) {
            let blur = Blur { mean, variance };
            let same = blur.through(|x| x);
            prop_assert!((same.mean - mean).abs() < 1e-14);
            prop_assert!((same.variance - variance).abs() < 1e-14 * (1.0 + mean * mean));
            let squares = blur.through(|x| x * x).mean;
            prop_assert!((squares - blur.square()).abs() < 1e-13);
        }
    }

    #[test]
    fn a_sharp_value_stays_sharp() {
        let blur = Blur::sharp(0.3);
        for result in [blur.abs(), blur.clamped(0.0, 1.0), blur.times(Blur::sharp(1.0))] {
            assert_eq!(result, blur);
        }
        assert_eq!(blur.clamped(0.5, 1.0), Blur::sharp(0.5));
    }
}
