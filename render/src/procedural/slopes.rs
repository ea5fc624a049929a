//! Slopes of noise, averaged over the part of a surface that a ray stands for.
//!
//! An octave whose cells are wide beside that part keeps its slopes. An octave whose cells are narrow
//! has no mean slope. Its slopes add their variance instead, which acts like the roughness of a
//! surface (M. Olano and D. Baker, "LEAN Mapping", 2010). In between the slopes fade.

use super::noise::Noise;
use super::turbulence::Octaves;
use super::wall::Wall;
use glam::{DMat3, DVec3};

/// Widths of the averaged part, in cells, at which the slopes of noise begin to fade and have faded.
///
/// The mean over a square of width w keeps about the share `sinc(w/2)^2` of the slopes of noise,
/// whose waves are two cells long: 0.9, 0.4 and 0.1 at the widths 0.5, 1 and 1.5. The curve between
/// these numbers keeps 0.9, 0.35 and 0. With larger numbers, slopes are sampled that change faster
/// than once per sample, which shows as sparkle. With smaller ones, relief that could be seen is
/// replaced by roughness.
const FADE: [f64; 2] = [0.25, 1.5];

/// The slope of a height over a part of space, in texture space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// Mean gradient.
    pub mean: DVec3,
    /// Derivatives of the mean gradient: column `k` is its change along axis `k`.
    pub curvature: DMat3,
    /// Variance of the slope along each axis that the mean leaves out.
    pub variance: f64,
}

impl Slope {
    /// The slope of a constant height.
    const LEVEL: Self = Self { mean: DVec3::ZERO, curvature: DMat3::ZERO, variance: 0.0 };

    /// Adds a height of this weight that is seen through the linear map `turn`, which stretches all
    /// directions equally.
    fn add(&mut self, weight: f64, turn: &DMat3, other: &Self) {
        let back = turn.transpose();
        self.mean += back * (weight * other.mean);
        self.curvature += back * (weight * other.curvature) * *turn;
        self.variance += weight * weight * turn.x_axis.length_squared() * other.variance;
    }
}

/// Returns the share of the slopes of noise that the mean over a part of this width keeps: exactly 1
/// for small parts and 0 for large ones. `width` is in cells. A width that is not a number counts as
/// large.
#[must_use]
pub fn kept(width: f64) -> f64 {
    let [first, last] = FADE;
    if width <= first {
        1.0
    } else if width < last {
        let t = (width - first) / (last - first);
        1.0 - t * t * (3.0 - 2.0 * t)
    } else {
        0.0
    }
}

impl Noise {
    /// Returns the slope over a part of texture space of this width, in cells. `share` is the mean
    /// share of space in which the height has the slopes of the noise, and `factor` returns the
    /// factor of the slopes at the point.
    fn slope_by(
        &self,
        point: DVec3,
        width: f64,
        share: f64,
        factor: impl FnOnce() -> f64,
    ) -> Slope {
        let kept = kept(width);
        let variance = share * (1.0 - kept * kept) * self.interpolation.slope_variance();
        if kept == 0.0 {
            return Slope { variance, ..Slope::LEVEL };
        }
        let factor = kept * factor();
        let mean = factor * self.gradient(point);
        Slope { mean, curvature: factor * self.curvature(point), variance }
    }

    /// Returns the slope over a part of texture space of this width, in cells.
    #[must_use]
    pub fn slope(&self, point: DVec3, width: f64) -> Slope {
        self.slope_by(point, width, 1.0, || 1.0)
    }
}

impl Octaves {
    /// Returns the slope of [`Octaves::fractal`] over a part of texture space of this width.
    #[must_use]
    pub fn fractal_slope(&self, point: DVec3, width: f64) -> Slope {
        self.sum(point, width, |at, width| self.noise.slope(at, width))
    }

    /// Returns the slope of [`Octaves::turbulence`] over a part of texture space of this width.
    #[must_use]
    pub fn turbulence_slope(&self, point: DVec3, width: f64) -> Slope {
        let sign = |at| if self.noise.value(at) < 0.0 { -1.0 } else { 1.0 };
        self.sum(point, width, |at, width| self.noise.slope_by(at, width, 1.0, || sign(at)))
    }

    /// Sums the slope of each octave, given its position and the width in its own cells.
    fn sum(&self, point: DVec3, width: f64, slope: impl Fn(DVec3, f64) -> Slope) -> Slope {
        let mut sum = Slope::LEVEL;
        for (at, weight, turn) in self.places(point) {
            // An octave of half the weight has cells of half the size.
            sum.add(weight, &turn, &slope(at, width / weight));
        }
        sum
    }
}

impl Wall {
    /// Returns the slope of [`Wall::height`] over a part of texture space of this width.
    #[must_use]
    pub fn slope(&self, point: DVec3, width: f64) -> Slope {
        let [low, high] = self.clamp;
        let inside = || {
            let slow = self.noise.value(point);
            if slow > low && slow < high { 1.0 } else { 0.0 }
        };
        let mut sum = self.noise.slope_by(point, width, self.share_inside(), inside);
        let fast = self.noise.slope(self.frequency * point, self.frequency * width);
        let steep = self.rough * self.frequency;
        sum.mean += steep * fast.mean;
        sum.curvature += (steep * self.frequency) * fast.curvature;
        sum.variance += steep * steep * fast.variance;
        sum
    }

    /// Returns the share of space in which the slow noise is not clamped, as if its values had a
    /// normal distribution. The logistic function approximates that of the normal distribution to a
    /// hundredth (S. R. Bowling et al. 2009).
    fn share_inside(&self) -> f64 {
        let deviation = self.noise.interpolation.variance().sqrt();
        let below = |value: f64| {
            let z = value / deviation;
            1.0 / (1.0 + (-z * (1.5976 + 0.070_56 * z * z)).exp())
        };
        below(self.clamp[1]) - below(self.clamp[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural::{Interpolation, NoiseLattice};
    use proptest::prelude::*;
    use std::sync::Arc;

    fn noise(interpolation: Interpolation) -> Noise {
        Noise { lattice: Arc::new(NoiseLattice::new()), interpolation }
    }

    fn octaves() -> Octaves {
        Octaves { noise: noise(Interpolation::Smoother), count: 4 }
    }

    fn wall() -> Wall {
        Wall {
            clamp: [-0.1, 0.2],
            rough: 0.3,
            frequency: 3.0,
            noise: noise(Interpolation::Smoother),
        }
    }

    fn point() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-100.0..100.0f64).prop_map(DVec3::from)
    }

    proptest! {
        /// Over a point, slopes are the exact ones to the last bit, and nothing is averaged away.
        #[test]
        fn over_a_point_slopes_are_exact(at in point()) {
            let exact = |mean: DVec3, slope: Slope| mean == slope.mean && slope.variance == 0.0;
            let (octaves, wall) = (octaves(), wall());
            prop_assert!(exact(octaves.fractal_gradient(at), octaves.fractal_slope(at, 0.0)));
            prop_assert!(exact(octaves.turbulence_gradient(at), octaves.turbulence_slope(at, 0.0)));
            prop_assert!(exact(wall.gradient(at), wall.slope(at, 0.0)));
        }

        /// The curvature is the derivative of the mean slope over a part of constant size. Across a
        /// crease of turbulence or wall there is none.
        #[test]
        fn the_curvature_is_that_of_the_mean_slope(at in point(), width in 0.0..1.0f64) {
            let (octaves, wall) = (octaves(), wall());
            let step = 1e-5;
            let reliefs: [&dyn Fn(DVec3) -> Slope; 3] = [
                &|at| octaves.fractal_slope(at, width),
                &|at| octaves.turbulence_slope(at, width),
                &|at| wall.slope(at, width),
            ];
            for slope in reliefs {
                for k in 0..3 {
                    let axis = step * DVec3::AXES[k];
                    let (up, down) = (slope(at + axis), slope(at - axis));
                    let change = (up.mean - down.mean) / (2.0 * step);
                    let creased = (up.mean - down.mean).length() > 1e-2;
                    // Fourth derivatives are at most 360 times the cube of the finest frequency.
                    prop_assert!(creased || change.abs_diff_eq(slope(at).curvature.col(k), 1e-3));
                }
            }
        }

        /// Wider parts change slopes gradually: a thousandth of the width changes them by at most a
        /// few thousandths of their largest size, 30.
        #[test]
        fn slopes_are_continuous_in_the_width(at in point(), width in 0.0..4.0f64) {
            let octaves = octaves();
            let [one, other] = [width, width + 1e-6].map(|width| octaves.fractal_slope(at, width));
            prop_assert!(one.mean.abs_diff_eq(other.mean, 1e-3));
            prop_assert!((one.variance - other.variance).abs() < 1e-3);
        }
    }

    /// The variance over a large part is the mean square of the exact slopes. For the wall it is less
    /// certain, since the distribution of noise is not quite normal and its slopes depend on its value.
    #[test]
    fn over_a_large_part_the_variance_is_the_mean_square_of_slopes() {
        let (octaves, wall) = (octaves(), wall());
        let mut squares = [0.0; 3];
        let count = 100_000;
        for k in 0..count {
            // Points of a lattice with irrational steps through a thousand periods (Korobov).
            let at = f64::from(k) * DVec3::new(35.517_320_5, 19.710_562, 10.938_573);
            let slopes =
                [octaves.fractal_gradient(at), octaves.turbulence_gradient(at), wall.gradient(at)];
            for (sum, slope) in squares.iter_mut().zip(slopes) {
                *sum += slope.length_squared() / 3.0 / f64::from(count);
            }
        }
        let wide = f64::INFINITY;
        let slopes = [
            octaves.fractal_slope(DVec3::ONE, wide),
            octaves.turbulence_slope(DVec3::ONE, wide),
            wall.slope(DVec3::ONE, wide),
        ];
        for ((slope, square), tolerance) in slopes.into_iter().zip(squares).zip([0.02, 0.02, 0.1]) {
            assert_eq!((slope.mean, slope.curvature), (DVec3::ZERO, DMat3::ZERO));
            assert!(
                (slope.variance / square - 1.0).abs() < tolerance,
                "{} {square}",
                slope.variance
            );
        }
    }
}
