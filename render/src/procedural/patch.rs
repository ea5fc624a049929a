//! The part of a texture's space over which a solid texture is averaged.
//!
//! A [`Patch`] is a parallelogram. Its points are `center + a steps[0] + b steps[1]`, with `a` and
//! `b` from -1/2 to 1/2. A linear function of the point is then a linear function of `(a, b)` on a
//! square of side 1, a [`Form`]. The square never degenerates, although the parallelogram may be a
//! line or a point.

use super::blur::Blur;
use glam::{DAffine3, DVec2, DVec3};

/// Factor by which the longer step of a narrow patch has more parts.
const NARROW: u32 = 2;

/// A parallelogram in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Middle of the parallelogram.
    pub center: DVec3,
    /// Two sides that meet at a corner. They may be parallel, or zero.
    pub steps: [DVec3; 2],
}

impl Patch {
    /// Returns the patch of the scene that `steps` span around `point`, mapped by `map`.
    #[must_use]
    pub fn mapped(map: &DAffine3, point: DVec3, steps: [DVec3; 2]) -> Self {
        let steps = steps.map(|step| map.transform_vector3(step));
        Self { center: map.transform_point3(point), steps }
    }

    /// Returns the patch mapped by the linear function `map` and then moved by `by`.
    #[must_use]
    pub fn moved(&self, map: impl Fn(DVec3) -> DVec3, by: DVec3) -> Self {
        Self { center: map(self.center) + by, steps: self.steps.map(map) }
    }

    /// Returns whether all coordinates are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.center.is_finite() && self.steps.iter().all(|step| step.is_finite())
    }

    /// Returns whether the patch is a single point.
    #[must_use]
    pub fn is_point(&self) -> bool {
        self.steps == [DVec3::ZERO; 2]
    }

    /// Divides the patch into parts that are evaluated separately. `finer` lists lengths of a step,
    /// rising from 0, from which it is divided into a number of parts.
    pub fn parts(&self, finer: &[(f64, u32)]) -> impl Iterator<Item = Self> {
        let lengths = self.steps.map(DVec3::length);
        let counts = lengths.map(|length| {
            let at = finer.partition_point(|&(start, _)| start <= length);
            at.checked_sub(1).map_or(1, |at| finer[at].1)
        });
        // Along a narrow patch there is time for more parts.
        let counts = match counts {
            [long, 1] if long > 1 => [NARROW * long, 1],
            [1, long] if long > 1 => [1, NARROW * long],
            both => both,
        };
        let steps = [0, 1].map(|k| self.steps[k] / f64::from(counts[k]));
        let place = move |k: usize, index: u32| f64::from(index) - 0.5 * f64::from(counts[k] - 1);
        let center = self.center;
        (0..counts[0]).flat_map(move |i| {
            (0..counts[1]).map(move |j| {
                let center = center + place(0, i) * steps[0] + place(1, j) * steps[1];
                Self { center, steps }
            })
        })
    }

    /// Returns the function `normal . point + offset` on the patch.
    #[must_use]
    pub fn form(&self, normal: DVec3, offset: f64) -> Form {
        let slopes = self.steps.map(|step| step.dot(normal));
        Form { middle: self.center.dot(normal) + offset, slopes: DVec2::from(slopes) }
    }

    /// Returns the width of the patch across its longer step: the area divided by this step.
    #[must_use]
    pub fn width(&self) -> f64 {
        let [a, b] = self.steps;
        let longer = a.length().max(b.length());
        if longer > 0.0 { a.cross(b).length() / longer } else { 0.0 }
    }

    /// Returns the part around the center in which no step is longer than `most` along any axis,
    /// and the share of the patch's area that this part has.
    #[must_use]
    pub fn cut(&self, most: f64) -> (Self, f64) {
        let shares = self.steps.map(|step| {
            let length = step.abs().max_element();
            if length > most { most / length } else { 1.0 }
        });
        let steps = [shares[0] * self.steps[0], shares[1] * self.steps[1]];
        (Self { steps, ..*self }, shares[0] * shares[1])
    }
}

/// A linear function on the square of side 1 around the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    /// Value in the middle of the square.
    pub middle: f64,
    /// Derivatives along the two sides of the square.
    pub slopes: DVec2,
}

impl Form {
    /// The function that is 0 everywhere.
    pub const ZERO: Self = Self { middle: 0.0, slopes: DVec2::ZERO };

    /// Returns the value at a point of the square.
    #[must_use]
    pub fn at(&self, point: DVec2) -> f64 {
        self.middle + self.slopes.dot(point)
    }

    /// Returns the largest value minus the smallest one on the square.
    #[must_use]
    pub fn extent(&self) -> f64 {
        self.slopes.abs().element_sum()
    }

    /// Returns the mean and variance of the values over the square.
    #[must_use]
    pub fn blur(&self) -> Blur {
        Blur { mean: self.middle, variance: self.slopes.length_squared() / 12.0 }
    }

    /// Returns the function `factor (value - start)`.
    #[must_use]
    pub fn scaled(&self, start: f64, factor: f64) -> Self {
        Self { middle: factor * (self.middle - start), slopes: factor * self.slopes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_form_has_the_values_of_the_patch() {
        let steps = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-2.0, 0.5, 1.0)];
        let patch = Patch { center: DVec3::new(4.0, -1.0, 2.0), steps };
        let normal = DVec3::new(0.5, -1.5, 2.0);
        let form = patch.form(normal, 0.25);
        for ab in [[0.0, 0.0], [0.5, -0.5], [-0.25, 0.125]].map(DVec2::from) {
            let point = patch.center + ab.x * steps[0] + ab.y * steps[1];
            // All numbers are small dyadic fractions, so nothing is rounded.
            assert_eq!(form.at(ab), normal.dot(point) + 0.25);
        }
        let corner = |a: f64, b: f64| form.at(DVec2::new(a, b));
        let corners = [corner(0.5, 0.5), corner(0.5, -0.5), corner(-0.5, 0.5), corner(-0.5, -0.5)];
        let largest = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let smallest = corners.into_iter().fold(f64::INFINITY, f64::min);
        assert_eq!(form.extent(), largest - smallest);
    }

    #[test]
    fn parts_cover_the_patch() {
        let finer = [(0.0, 1), (1.0, 2), (4.0, 3), (20.0, 1)];
        let center = DVec3::new(1.0, -2.0, 0.5);
        for (lengths, count) in [
            ([0.5, 0.9], 1),
            ([1.0, 1.5], 4),
            ([5.0, 1.5], 6),
            ([0.5, 5.0], 6),
            ([1.0, 0.1], 4),
            ([30.0, 30.0], 1),
        ] {
            let patch = Patch { center, steps: [lengths[0] * DVec3::X, lengths[1] * DVec3::Z] };
            let parts: Vec<Patch> = patch.parts(&finer).collect();
            assert_eq!(parts.len(), count, "{lengths:?}");
            // The mean position and the mean square distance along a side are those of the patch:
            // the squares of the parts' centers, plus the variance within a part.
            let square = |part: &Patch| {
                let along = (part.center - center).x;
                along * along + part.steps[0].x * part.steps[0].x / 12.0
            };
            let mean: DVec3 = parts.iter().map(|part| part.center).sum::<DVec3>() / count as f64;
            assert!(mean.abs_diff_eq(center, 1e-14));
            let squares: f64 = parts.iter().map(square).sum::<f64>() / count as f64;
            assert!((squares - lengths[0] * lengths[0] / 12.0).abs() < 1e-12, "{lengths:?}");
        }
    }

    #[test]
    fn a_cut_shortens_only_long_steps() {
        let patch = Patch { center: DVec3::ONE, steps: [8.0 * DVec3::X, DVec3::Y + DVec3::Z] };
        let (part, share) = patch.cut(2.0);
        assert_eq!(part, Patch { center: DVec3::ONE, steps: [2.0 * DVec3::X, patch.steps[1]] });
        assert_eq!((share, patch.cut(9.0)), (0.25, (patch, 1.0)));
        // The cross product of the steps has the length 8 sqrt(2).
        assert!((patch.width() - 2f64.sqrt()).abs() < 1e-15);
    }
}
