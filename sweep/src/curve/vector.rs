//! The operations that curves need from their points, in two and three dimensions.

use glam::{DVec2, DVec3};
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Smallest sine between a direction and an axis across which the direction is taken. A double has 16 digits; below
/// this sine cancellation leaves fewer than 7 of them.
pub const LEAST_SINE: f64 = 1e-9;

/// A point or a vector; also a plain number, for the solver of the splines.
pub trait Vector:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// The zero vector.
    const ZERO: Self;

    /// Returns the scalar product.
    fn dot(self, other: Self) -> f64;

    /// Returns the smaller and the larger value of each coordinate.
    fn bounds(self, other: Self) -> (Self, Self);

    /// Returns the part across a unit vector.
    fn across(self, unit: Self) -> Self {
        self - unit * self.dot(unit)
    }

    /// Returns the unit vector in this direction; `None` for a vector without length.
    fn unit(self) -> Option<Self> {
        let over = 1.0 / self.length();
        (over.is_finite() && over > 0.0).then(|| self * over)
    }

    /// Returns the Euclidean length.
    fn length(self) -> f64 {
        self.dot(self).sqrt()
    }
}

impl Vector for f64 {
    const ZERO: Self = 0.0;

    fn dot(self, other: Self) -> f64 {
        self * other
    }

    fn bounds(self, other: Self) -> (Self, Self) {
        (self.min(other), self.max(other))
    }
}

impl Vector for DVec2 {
    const ZERO: Self = Self::ZERO;

    fn across(self, unit: Self) -> Self {
        let normal = unit.perp();
        normal * self.dot(normal)
    }

    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }

    fn bounds(self, other: Self) -> (Self, Self) {
        (self.min(other), self.max(other))
    }
}

impl Vector for DVec3 {
    const ZERO: Self = Self::ZERO;

    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }

    fn bounds(self, other: Self) -> (Self, Self) {
        (self.min(other), self.max(other))
    }
}

/// Returns the angle between two unit vectors, in radians from 0 to pi; accurate near both ends.
pub fn angle_between<V: Vector>(a: V, b: V) -> f64 {
    2.0 * (a - b).length().atan2((a + b).length())
}

/// Returns the diagonal of the bounding box of the points; 0 for no points.
pub fn extent<V: Vector>(points: impl IntoIterator<Item = V>) -> f64 {
    let mut points = points.into_iter();
    let Some(first) = points.next() else {
        return 0.0;
    };
    let (low, high) =
        points.fold((first, first), |(low, high), p| (low.bounds(p).0, high.bounds(p).1));
    (high - low).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_angles_keep_their_digits() {
        let angle = 1e-9_f64;
        let turned = DVec2::new(angle.cos(), angle.sin());
        assert!((angle_between(DVec2::X, turned) / angle - 1.0).abs() < 1e-12);
        assert!((angle_between(DVec2::X, -DVec2::X) - std::f64::consts::PI).abs() < 1e-15);
    }

    #[test]
    fn the_extent_is_the_diagonal_of_the_box() {
        let points = [DVec2::new(1.0, 1.0), DVec2::new(4.0, 1.0), DVec2::new(2.0, 5.0)];
        assert_eq!(extent(points), 5.0);
        assert_eq!(extent(std::iter::empty::<DVec3>()), 0.0);
    }
}
