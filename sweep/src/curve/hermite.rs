//! Cubics along a curve that is given by a function: its points and exact derivatives.
//!
//! A cubic with the points and derivatives of the curve at both ends differs from the curve by the fourth power of its
//! extent. A piece is halved until the cubic agrees with the curve at a quarter, a half and three quarters.

use super::Cubic;
use super::vector::extent;
use glam::DVec3;

/// Largest distance of the cubics from the curve, as a fraction of its size. Coordinates of a mesh are rounded to 6e-8.
const NEAR: f64 = 1e-9;

/// Pieces before any is halved, so that no bend lies between the points that are compared.
const PIECES: usize = 64;

/// Most halvings of a piece.
const DEEPEST: u32 = 10;

/// Returns cubics along a curve whose function returns a point and its derivative, between rising parameters at which
/// derivatives may jump. `None` where a point is not finite: then the error is the parameter.
///
/// # Errors
/// The parameter of a point or a derivative that is not finite.
pub fn along(curve: impl Fn(f64) -> [DVec3; 2], ends: &[f64]) -> Result<Vec<Cubic<DVec3>>, f64> {
    let pieces = (PIECES / (ends.len() - 1)).max(1);
    between(curve, ends, pieces, NEAR)
}

/// Returns cubics along a curve, as [`along`] does: at least `pieces` between two parameters, and no further from the curve
/// than the fraction `near` of its size.
///
/// # Errors
/// The parameter of a point or a derivative that is not finite.
pub fn between(
    curve: impl Fn(f64) -> [DVec3; 2],
    ends: &[f64],
    pieces: usize,
    near: f64,
) -> Result<Vec<Cubic<DVec3>>, f64> {
    let mut cubics = Vec::new();
    let samples = (0..=PIECES).map(|i| {
        let part = i as f64 / PIECES as f64;
        curve(ends[0] + (ends[ends.len() - 1] - ends[0]) * part)[0]
    });
    let near = near * extent(samples);
    for span in ends.windows(2) {
        let width = span[1] - span[0];
        // Derivatives that jump at an end are those of the inside.
        let inside = |t: f64| t.clamp(span[0] + 1e-12 * width, span[1] - 1e-12 * width);
        let of = |t: f64| [curve(t)[0], curve(inside(t))[1]];
        for piece in 0..pieces {
            let part = |i: usize| span[0] + width * (i as f64 / pieces as f64);
            let (from, to) =
                (part(piece), if piece + 1 == pieces { span[1] } else { part(piece + 1) });
            halved(&of, [from, to], [of(from), of(to)], near, DEEPEST, &mut cubics)?;
        }
    }
    Ok(cubics)
}

fn halved(
    curve: &impl Fn(f64) -> [DVec3; 2],
    [from, to]: [f64; 2],
    [start, end]: [[DVec3; 2]; 2],
    near: f64,
    left: u32,
    cubics: &mut Vec<Cubic<DVec3>>,
) -> Result<(), f64> {
    for (t, [point, slope]) in [(from, start), (to, end)] {
        if !point.is_finite() || !slope.is_finite() {
            return Err(t);
        }
    }
    let third = (to - from) / 3.0;
    let cubic = Cubic([start[0], start[0] + start[1] * third, end[0] - end[1] * third, end[0]]);
    let off = |part: f64| cubic.point(part).distance(curve(from + (to - from) * part)[0]);
    if left == 0 || [0.25, 0.5, 0.75].iter().all(|&part| off(part) <= near) {
        cubics.push(cubic);
        return Ok(());
    }
    let middle = 0.5 * (from + to);
    let between = curve(middle);
    halved(curve, [from, middle], [start, between], near, left - 1, cubics)?;
    halved(curve, [middle, to], [between, end], near, left - 1, cubics)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Curve3, Path};
    use std::f64::consts::TAU;

    #[test]
    fn a_circle_by_its_function_is_a_circle() {
        let circle = |t: f64| {
            let (sin, cos) = t.sin_cos();
            [DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0)]
        };
        let path = Path::new(&along(circle, &[0.0, TAU]).unwrap(), true).unwrap();
        assert!((path.length() - TAU).abs() < 1e-8);
        for i in 0..1000 {
            let local = path.at(path.length() * f64::from(i) / 1000.0);
            assert!((local.position.length() - 1.0).abs() < 2e-9);
        }
        let pole = |t: f64| [DVec3::new(1.0 / t, 0.0, 0.0), DVec3::X];
        assert_eq!(along(pole, &[0.0, 1.0]), Err(0.0));
    }
}
