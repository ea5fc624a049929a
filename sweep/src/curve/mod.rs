//! Curves: piecewise cubic Beziers in two and three dimensions, by arc length.
//!
//! | module         | what                                                              |
//! |----------------|-------------------------------------------------------------------|
//! | [`cubic`]      | one segment: point, derivatives, tangents, cusps                  |
//! | [`path`]       | segments joined, located by arc length; corners                   |
//! | [`arc_length`] | the length of a segment and its inverse                           |
//! | [`fit`]        | a few cubics near many points                                     |
//! | [`formula`]    | formulas of one variable, with exact derivatives                  |
//! | [`hermite`]    | cubics along a curve that is given by a function                  |
//! | [`cut`]        | division of a curve into cells                                    |
//! | [`spline`]     | a C2 curve through free points                                    |
//! | [`svg`]        | the path of an SVG file                                           |
//!
//! No tolerance here is absolute: a curve and a copy a billion times larger give the same results at their
//! scales. Lines and circles are not converted to cubics; see [`turn`](self::turn()).

pub mod arc_length;
pub mod cubic;
pub mod cut;
pub mod fit;
pub mod formula;
pub mod hermite;
pub mod path;
mod quadrature;
pub mod spline;
pub mod svg;
pub mod vector;

pub use cubic::Cubic;
pub use path::Path;
pub use vector::Vector;

use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// A curve in space, parametrized by arc length.
pub trait Curve3 {
    /// Returns the length of the whole curve.
    fn length(&self) -> f64;

    /// Returns whether the curve leads back to its start.
    fn closed(&self) -> bool;

    /// Returns arc lengths between which the curve is smooth, rising from 0 to the whole length.
    fn knots(&self) -> Vec<f64>;

    /// Returns the curve at arc length `s` from its start; `s` outside the curve gives its ends.
    ///
    /// At a joint, returns the side after.
    fn at(&self, s: f64) -> Local3;

    /// Returns the curve at arc length `s`, as [`at`](Curve3::at) does, but at a joint the side before.
    fn before(&self, s: f64) -> Local3 {
        self.at(s)
    }
}

/// A point of a curve in space, with derivatives by arc length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Local3 {
    /// The point, in the unit of length.
    pub position: DVec3,
    /// The unit tangent.
    pub tangent: DVec3,
    /// Derivative of the tangent by arc length: a vector toward the centre of curvature, of length 1 /
    /// radius.
    pub curvature: DVec3,
    /// Derivative of the curvature by arc length.
    pub third: DVec3,
}

impl Local3 {
    /// Returns a point at which the curve is straight.
    #[must_use]
    pub fn straight(position: DVec3, tangent: DVec3) -> Self {
        Self { position, tangent, curvature: DVec3::ZERO, third: DVec3::ZERO }
    }
}

/// Returns the point of the unit circle after a fraction of a full turn; exact at the quarters.
#[must_use]
pub fn turn(fraction: f64) -> DVec2 {
    let quarters = 4.0 * fraction;
    let nearest = quarters.round();
    let (sin, cos) = ((quarters - nearest) * FRAC_PI_2).sin_cos();
    match nearest.rem_euclid(4.0) as u32 {
        0 => DVec2::new(cos, sin),
        1 => DVec2::new(-sin, cos),
        2 => DVec2::new(-cos, -sin),
        _ => DVec2::new(sin, -cos),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_is_exact_at_the_quarters() {
        assert_eq!(turn(0.25), DVec2::Y);
        assert_eq!(turn(0.5), DVec2::NEG_X);
        assert_eq!(turn(0.75), DVec2::NEG_Y);
        assert_eq!(turn(1.0), DVec2::X);
        assert_eq!(turn(-0.25), DVec2::NEG_Y);
        for i in -30..30 {
            let fraction = f64::from(i) / 17.0;
            let (sin, cos) = (std::f64::consts::TAU * fraction).sin_cos();
            assert!((turn(fraction) - DVec2::new(cos, sin)).length() < 4e-15);
        }
    }
}
