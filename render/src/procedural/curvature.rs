//! Second derivatives of noise, in closed form.
//!
//! In a cell the noise is linear in each of three weights, which are polynomials of the offsets. Its
//! second derivatives along one axis therefore contain those of the weight. The mixed ones contain
//! the slopes of two weights.

use super::lattice::Cell;
use super::noise::{Interpolation, Noise, by_weights, step};
use glam::{DMat3, DVec3};

impl Interpolation {
    /// Returns the second derivative of [`Interpolation::fade`] at `t` in `[0, 1]`.
    #[must_use]
    pub fn curvature(self, t: f64) -> f64 {
        match self {
            Self::Linear => 0.0,
            Self::Smooth => 6.0 - 12.0 * t,
            Self::Smoother => 60.0 * t * (1.0 - t) * (1.0 - 2.0 * t),
        }
    }

    /// Returns the mean square of a derivative of the noise along one axis, over all of space.
    ///
    /// Two neighbouring values of the lattice are independent and have variance 1/3, so that of
    /// their difference is 2/3. The factors are the mean of the squared slope of the weight along
    /// the axis, and twice the mean of `w^2 + (1 - w)^2` across it.
    #[must_use]
    pub fn slope_variance(self) -> f64 {
        let (along, across) = match self {
            Self::Linear => (1.0, 2.0 / 3.0),
            Self::Smooth => (6.0 / 5.0, 26.0 / 35.0),
            Self::Smoother => (10.0 / 7.0, 181.0 / 231.0),
        };
        2.0 / 3.0 * along * across * across
    }
}

impl Noise {
    /// Returns the matrix of second derivatives of [`Noise::value`], which is symmetric. On a face
    /// between cells, where second derivatives may jump, it returns those of the upper cell.
    #[must_use]
    pub fn curvature(&self, point: DVec3) -> DMat3 {
        let cell = Cell::of(point);
        let (v, o, slope) = (self.corners(&cell), self.faded(&cell), self.fade_slopes(&cell));
        let pure = by_weights(v, o) * cell.offset.map(|t| self.interpolation.curvature(t));
        let between = |lower: f64, upper: f64, t: f64| lower + t * (upper - lower);
        // Derivatives by two weights at both ends of the third axis.
        let by_xy = between(v[5] - v[4] - v[1] + v[0], v[7] - v[6] - v[3] + v[2], o.z);
        let by_xz = between(v[3] - v[2] - v[1] + v[0], v[7] - v[6] - v[5] + v[4], o.y);
        let by_yz = between(v[6] - v[4] - v[2] + v[0], v[7] - v[5] - v[3] + v[1], o.x);
        let (xy, xz) = (by_xy * slope.x * slope.y, by_xz * slope.x * slope.z);
        let yz = by_yz * slope.y * slope.z;
        DMat3::from_cols(
            DVec3::new(pure.x, xy, xz),
            DVec3::new(xy, pure.y, yz),
            DVec3::new(xz, yz, pure.z),
        )
    }

    /// Returns the derivatives of [`Noise::differences`]: column `k` is its change along axis `k`.
    #[must_use]
    pub fn differences_change(&self, point: DVec3) -> DMat3 {
        let cell = Cell::of(point);
        let (o, slope) = (self.faded(&cell), self.fade_slopes(&cell));
        let gradient = |axis: usize| {
            let difference = |k: usize| {
                let near = step(k);
                let mut far = near;
                far[axis] += 1;
                self.lattice.value(cell.at(far)) - self.lattice.value(cell.at(near))
            };
            by_weights(std::array::from_fn(difference), o) * slope
        };
        // The gradients are the rows.
        DMat3::from_cols(gradient(0), gradient(1), gradient(2)).transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural::NoiseLattice;
    use proptest::prelude::*;
    use std::sync::Arc;

    const ALL: [Interpolation; 3] =
        [Interpolation::Linear, Interpolation::Smooth, Interpolation::Smoother];

    fn noise(interpolation: Interpolation) -> Noise {
        Noise { lattice: Arc::new(NoiseLattice::new()), interpolation }
    }

    /// Differences of a vector along the three axes, as columns.
    fn differences(of: impl Fn(DVec3) -> DVec3, point: DVec3) -> DMat3 {
        let step = 1e-4;
        let along = |k: usize| {
            let axis = step * DVec3::AXES[k];
            (of(point + axis) - of(point - axis)) / (2.0 * step)
        };
        DMat3::from_cols(along(0), along(1), along(2))
    }

    proptest! {
        /// The error of a difference is the square of its step times a fourth derivative of the noise,
        /// at most 360 times a difference of 2, and a rounding of 1e-15 divided by the step.
        #[test]
        fn curvatures_agree_with_differences_of_gradients(
            corner in prop::array::uniform3(-70..70i32), offset in prop::array::uniform3(0.01..0.99f64),
        ) {
            let point = DVec3::from(corner.map(f64::from)) + DVec3::from(offset);
            for noise in ALL.map(noise) {
                let expected = differences(|at| noise.gradient(at), point);
                prop_assert!(noise.curvature(point).abs_diff_eq(expected, 1e-5), "{noise:?}");
                let expected = differences(|at| noise.differences(at), point);
                prop_assert!(noise.differences_change(point).abs_diff_eq(expected, 1e-5));
            }
        }
    }

    /// Over the 2^18 cells of a period, with one point in each, the mean of squares deviates from that
    /// of independent values by less than a hundredth.
    #[test]
    fn mean_squares_are_those_of_the_lattice() {
        for noise in ALL.map(noise) {
            let (mut slopes, mut values) = (DVec3::ZERO, 0.0);
            for k in 0..1 << 18 {
                let corner =
                    DVec3::new(f64::from(k & 63), f64::from(k >> 6 & 63), f64::from(k >> 12));
                // Offsets of a lattice with irrational steps fill the cell evenly (Korobov).
                let offset =
                    (f64::from(k) * DVec3::new(0.554_958_132, 0.307_978_528, 0.170_915_2)).fract();
                let gradient = noise.gradient(corner + offset);
                slopes += gradient * gradient;
                values += noise.value(corner + offset).powi(2);
            }
            let count = f64::from(1 << 18);
            let truth = noise.interpolation.slope_variance();
            assert!((slopes / count / truth - 1.0).abs().max_element() < 0.01, "{slopes} {truth}");
            let truth = noise.interpolation.variance();
            assert!((values / count / truth - 1.0).abs() < 0.01, "{values} {truth}");
        }
    }
}
