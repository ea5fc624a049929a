//! Noise and sums of octaves over a patch.
//!
//! The noise over a patch is estimated from its value and its gradient in the middle: as a linear
//! function, and a variance around it. The value is attenuated by a factor that falls with the size
//! of the patch in cells. The factor is the correlation of the mean over the patch with the value
//! in the middle. The gradient is attenuated by the square of the factor. The variance is that of
//! the noise less that of the linear function, so that no variance is lost. Nonlinear functions of
//! the noise need it ([`Blur`]). The octaves of a sum thereby fade one after the other as the patch
//! grows.

use super::blur::Blur;
use super::lattice::Cell;
use super::noise::{Interpolation, Noise, step};
use super::patch::{Form, Patch};
use super::turbulence::{FINER, MOVED, Octaves};
use glam::{DVec2, DVec3};

/// Rate at which the correlation falls: the correlation is `1 / sqrt(1 + RATE s^2)` for a step of
/// `s` cells. The rate was fitted to the mean over many patches with steps up to 2 cells. Its error
/// there is at most 0.03. A larger rate blurs more than the patch does. A smaller rate leaves more
/// aliasing.
const RATE: f64 = 0.34;

/// Correlation that is regarded as none, so that the noise need not be evaluated. Less of it is
/// subtracted from all correlations, so that none jumps. A larger number lets noise fade early, and
/// a smaller one evaluates noise that can hardly be seen.
const LOST: f64 = 0.05;

/// Values over a patch: a linear function, and a variance around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// The linear function, in texture values.
    pub form: Form,
    /// Mean square of the difference from it, 0 or more.
    pub variance: f64,
}

impl Field {
    /// Returns the mean and variance of all values.
    #[must_use]
    pub fn blur(&self) -> Blur {
        self.form.blur().plus(Blur { mean: 0.0, variance: self.variance })
    }

    /// Adds an independent field, times a factor.
    pub fn add(&mut self, factor: f64, other: &Self) {
        self.form.middle += factor * other.form.middle;
        self.form.slopes += factor * other.form.slopes;
        self.variance += factor * factor * other.variance;
    }
}

/// Returns the correlation of the mean over a patch with the value in its middle, for a texture
/// whose cells have side 1: 1 for a point, and 0 for a large patch.
#[must_use]
pub fn correlation(patch: &Patch) -> f64 {
    of_lengths(patch.steps.map(DVec3::length_squared))
}

/// Returns the correlation for steps of these squared lengths.
fn of_lengths([a, b]: [f64; 2]) -> f64 {
    let product = (1.0 + RATE * a) * (1.0 + RATE * b);
    ((1.0 / product.sqrt() - LOST) / (1.0 - LOST)).max(0.0)
}

impl Interpolation {
    /// Returns the variance of the noise over all space. The lattice values have the variance 1/3.
    /// Along each axis the weights `w` and `1 - w` of two of them reduce it by the mean of
    /// `w^2 + (1 - w)^2`.
    #[must_use]
    pub fn variance(self) -> f64 {
        let kept: f64 = match self {
            Self::Linear => 2.0 / 3.0,
            Self::Smooth => 26.0 / 35.0,
            Self::Smoother => 181.0 / 231.0,
        };
        kept * kept * kept / 3.0
    }
}

impl Noise {
    /// Returns the values of the noise over a patch.
    #[must_use]
    pub fn over(&self, patch: &Patch) -> Field {
        self.estimated(patch).unwrap_or_else(|| self.unknown())
    }

    /// Returns the values of the noise over a patch that is too large to know more.
    fn unknown(&self) -> Field {
        Field { form: Form::ZERO, variance: self.interpolation.variance() }
    }

    /// Returns the values of the noise over a patch, or `None` if the patch is too large.
    fn estimated(&self, patch: &Patch) -> Option<Field> {
        let lengths = patch.steps.map(DVec3::length_squared);
        let kept = of_lengths(lengths);
        if kept == 0.0 {
            return None;
        }
        let (value, gradient) = self.linear(patch.center);
        let square = kept * kept;
        let slopes = DVec2::from(patch.steps.map(|step| gradient.dot(step)));
        // The mean of the linear function's variance over all patches.
        let linear = square * square * RATE * (lengths[0] + lengths[1]);
        let rest = self.interpolation.variance() * (1.0 - square - linear).max(0.0);
        Some(Field { form: Form { middle: kept * value, slopes: square * slopes }, variance: rest })
    }

    /// Returns [`Noise::value`] and [`Noise::gradient`] at a point.
    fn linear(&self, point: DVec3) -> (f64, DVec3) {
        let cell = Cell::of(point);
        let weight = self.faded(&cell);
        let v: [f64; 8] = std::array::from_fn(|k| self.lattice.value(cell.at(step(k))));
        // Bit 0 of the index of a corner selects the upper x, bit 1 the upper z, bit 2 the upper y.
        let by_x = [0, 2, 4, 6].map(|k| v[k + 1] - v[k]);
        let along_x = [0, 1, 2, 3].map(|k| v[2 * k] + weight.x * by_x[k]);
        let by_y = [0, 1].map(|k| along_x[k + 2] - along_x[k]);
        let along_y = [0, 1].map(|k| along_x[k] + weight.y * by_y[k]);
        let by_z = along_y[1] - along_y[0];
        let mixed = [0, 1].map(|k| by_x[k] + weight.y * (by_x[k + 2] - by_x[k]));
        let between = |ends: [f64; 2]| ends[0] + weight.z * (ends[1] - ends[0]);
        let slope = cell.offset.map(|t| self.interpolation.slope(t));
        (between(along_y), slope * DVec3::new(between(mixed), between(by_y), by_z))
    }
}

impl Octaves {
    /// Returns the values of the fractal sum over a patch.
    #[must_use]
    pub fn fractal_over(&self, patch: &Patch) -> Field {
        self.sum_over(patch, |octave| octave)
    }

    /// Returns the mean and variance of the turbulence over a patch.
    #[must_use]
    pub fn turbulence_over(&self, patch: &Patch) -> Blur {
        let sum = self.sum_over(patch, |octave| {
            let Blur { mean, variance } = octave.blur().abs();
            Field { form: Form { middle: mean, ..Form::ZERO }, variance }
        });
        sum.blur()
    }

    fn sum_over(&self, patch: &Patch, function: impl Fn(Field) -> Field) -> Field {
        let mut sum = Field { form: Form::ZERO, variance: 0.0 };
        let (mut patch, mut weight) = (*patch, 1.0);
        let mut faded = None;
        for _ in 0..self.count {
            // Octaves finer than a faded one are faded too.
            let octave = faded.unwrap_or_else(|| match self.noise.estimated(&patch) {
                Some(known) => {
                    let octave = function(known);
                    patch = patch.moved(|at| FINER * at, MOVED);
                    octave
                }
                None => *faded.insert(function(self.noise.unknown())),
            });
            sum.add(weight, &octave);
            weight *= 0.5;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::sync::{Arc, LazyLock};

    static NOISE: LazyLock<Noise> = LazyLock::new(|| Noise {
        lattice: Arc::new(super::super::NoiseLattice::new()),
        interpolation: Interpolation::Smooth,
    });

    proptest! {
        #[test]
        fn the_linear_function_is_the_value_and_the_gradient(
            point in prop::array::uniform3(-90.0..90.0f64),
        ) {
            let point = DVec3::from(point);
            for interpolation in
                [Interpolation::Linear, Interpolation::Smooth, Interpolation::Smoother]
            {
                let noise = Noise { interpolation, ..NOISE.clone() };
                let (value, gradient) = noise.linear(point);
                prop_assert!((value - noise.value(point)).abs() < 1e-14);
                prop_assert!(gradient.abs_diff_eq(noise.gradient(point), 1e-13));
            }
        }

        /// A step of zero keeps the value. Longer steps attenuate it, and what the linear function
        /// loses is variance: both together have at least the variance of the noise.
        #[test]
        fn no_variance_is_lost(length in 0.0..20.0f64, other in 0.0..20.0f64) {
            let point = DVec3::new(0.3, 7.7, -2.2);
            let patch = Patch { center: point, steps: [length * DVec3::X, other * DVec3::Y] };
            let kept = correlation(&patch);
            prop_assert!((0.0..=1.0).contains(&kept));
            let field = NOISE.over(&patch);
            prop_assert!((field.form.middle - kept * NOISE.value(point)).abs() < 1e-14);
            prop_assert!(field.variance >= 0.0);
            // Mean over all points: the square of the value, and the linear function's variance.
            let of_gradient = RATE * kept.powi(4) * (length * length + other * other);
            let noise = NOISE.interpolation.variance();
            prop_assert!(noise * (kept * kept + of_gradient) + field.variance >= noise - 1e-14);
        }
    }

    /// 26 / 35 and 181 / 231 are means of `w^2 + (1 - w)^2` over a cell. Simpson's rule on 1000
    /// pieces is exact to 1e-12 for polynomials of degree 10.
    #[test]
    fn variances_are_those_of_the_weights() {
        for interpolation in [Interpolation::Linear, Interpolation::Smooth, Interpolation::Smoother]
        {
            let square = |k: u32| {
                let w = interpolation.fade(f64::from(k) / 1000.0);
                w * w + (1.0 - w) * (1.0 - w)
            };
            let inner: f64 = (1..1000).map(|k| f64::from(2 + k % 2 * 2) * square(k)).sum();
            let kept: f64 = (square(0) + inner + square(1000)) / 3000.0;
            assert!((interpolation.variance() - kept.powi(3) / 3.0).abs() < 1e-9);
        }
    }
}
