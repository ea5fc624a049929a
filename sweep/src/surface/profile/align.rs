//! The start of a closed contour that matches the contour before it best.
//!
//! Let `A` and `B` be the two contours by arc length about their centroids. The start `r` of `B` minimizes
//! the sum of squared distances
//!
//! ```text
//!     D(r) = sum over k of |A(u_k) - B(u_k + r)|^2,     u_k = k / M
//! ```
//!
//! A correlation finds it among `M` shifts. Newton's method then refines it to the last digits, on the
//! derivative of the integral that the correlation approximates,
//!
//! ```text
//!     c'(r) = integral of A(u) . B'(u + r),     c''(r) = - integral of A'(u) . B'(u + r)
//! ```
//!
//! and, if one contour is a copy of the other, on `D` itself. If both contours have corners, the nearest
//! shift that brings a corner onto a corner is taken instead if it is nearly as good. Among equally good
//! shifts the smallest is taken, so that contours that match as drawn are left as drawn.

use crate::curve::cut::Stop;
use crate::surface::contour::{Contour, Local2};
use glam::DVec2;

/// Number of shifts compared. Neighbouring shifts are 1.4 degrees of a circle apart. Finer details do not
/// decide how two contours match.
const SHIFTS: usize = 256;

/// Shifts are equally good if their correlations differ by at most this fraction of the largest possible one.
/// The terms of the sum are rounded to far less.
const TIE: f64 = 1e-9;

/// Largest loss of correlation that bringing a corner onto a corner may cost, as a fraction of the largest
/// possible correlation.
///
/// Between two polygons, or a polygon and a circle, this is the loss of a shift by 3 degrees. Such a shift is
/// hardly visible, but corners that lead smoothly into corners are.
const CORNER: f64 = 1.5e-3;

/// Most steps of Newton's method; bisection alone needs 45.
const STEPS: usize = 60;

/// Equal cells of the integral, which corners divide further.
const CELLS: usize = 64;

/// Contours whose mean distance is at most this fraction of their size are copies of each other.
const COPY: f64 = 1e-4;

/// Nodes and weights of the three-point Gauss-Legendre rule on a cell from 0 to 1.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// Returns the position on a contour that starts at `start`; all are fractions of its length.
pub(super) fn own(start: f64, u: f64) -> f64 {
    let sum = start + u;
    // The end of a contour that starts at 0 stays its end.
    if start > 0.0 && sum >= 1.0 { sum - 1.0 } else { sum }
}

/// Returns the start of `contour`, as a fraction of its length in `[0, 1)`, that matches `before` best.
/// `before` starts at `from`, a fraction of its length; both contours are closed.
#[must_use]
pub fn start(before: &Contour, from: f64, contour: &Contour) -> f64 {
    let a = centred(sampled(before, from));
    let b = centred(sampled(contour, 0.0));
    let size = |points: &[Local2]| points.iter().map(|p| p.point.length_squared()).sum::<f64>();
    let scale = (size(&a) * size(&b)).sqrt();
    let matches = |shift: usize| -> f64 {
        let shifted = b.iter().cycle().skip(shift);
        a.iter().zip(shifted).map(|(a, b)| a.point.dot(b.point)).sum()
    };
    let all: Vec<f64> = (0..SHIFTS).map(matches).collect();
    let best = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // Take the shift nearest to 0, a forward one before a backward one.
    let nearest = (0..SHIFTS)
        .filter(|&shift| all[shift] >= best - TIE * scale)
        .min_by_key(|&shift| (shift.min(SHIFTS - shift), shift))
        .unwrap_or(0);
    let near = nearest as f64 / SHIFTS as f64;
    let shift = copied(&a, contour, refined(before, from, contour, near, scale));
    let corner = nearest_corner(&before.breaks(), from, &contour.breaks(), shift);
    let shift = match corner {
        Some(corner) if best - correlation(&a, contour, corner) <= CORNER * scale => corner,
        _ => shift,
    };
    // A start moved only by rounding counts as not moved.
    let shift = if (shift - shift.round()).abs() < 1e-14 { 0.0 } else { shift };
    shift.rem_euclid(1.0) % 1.0
}

/// Returns a contour at `SHIFTS` equal steps from a start.
fn sampled(contour: &Contour, start: f64) -> Vec<Local2> {
    let at = |k: usize| own(start, k as f64 / SHIFTS as f64);
    (0..SHIFTS).map(|k| contour.at(Stop::after(at(k)))).collect()
}

/// Returns the points moved so that their centroid is the origin.
fn centred(mut samples: Vec<Local2>) -> Vec<Local2> {
    let centre = samples.iter().map(|sample| sample.point).sum::<DVec2>() / samples.len() as f64;
    for sample in &mut samples {
        sample.point -= centre;
    }
    samples
}

fn correlation(a: &[Local2], contour: &Contour, shift: f64) -> f64 {
    let b = centred(sampled(contour, shift.rem_euclid(1.0) % 1.0));
    a.iter().zip(&b).map(|(a, b)| a.point.dot(b.point)).sum()
}

/// Returns the shift that maximizes the integral, within two steps of `first`.
fn refined(before: &Contour, from: f64, contour: &Contour, first: f64, scale: f64) -> f64 {
    let size = scale / SHIFTS as f64;
    let width = 2.0 / SHIFTS as f64;
    let (mut low, mut high) = (first - width, first + width);
    let mut shift = first;
    for _ in 0..STEPS {
        let [slope, change] = derivatives(before, from, contour, shift);
        if slope.abs() <= 1e-13 * size || change.abs() <= TIE * size {
            break;
        }
        if slope > 0.0 {
            low = shift;
        } else {
            high = shift;
        }
        let newton = shift - slope / change;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let done = (next - shift).abs() <= 1e-15;
        shift = next;
        if done {
            break;
        }
    }
    shift
}

/// Returns the first and second derivative of the correlation integral at a shift.
fn derivatives(before: &Contour, from: f64, contour: &Contour, shift: f64) -> [f64; 2] {
    let start = shift.rem_euclid(1.0) % 1.0;
    // Between these ends the integrand is smooth.
    let mut ends: Vec<f64> = (1..=CELLS).map(|cell| cell as f64 / CELLS as f64).collect();
    ends.extend(before.breaks().iter().map(|at| (at - from).rem_euclid(1.0)));
    ends.extend(contour.breaks().iter().map(|at| (at - start).rem_euclid(1.0)));
    ends.sort_by(f64::total_cmp);
    let (mut slope, mut change, mut cell) = (0.0, 0.0, 0.0);
    for end in ends {
        for (node, weight) in GAUSS {
            let u = cell + node * (end - cell);
            let a = before.at(Stop::after(own(from, u)));
            let b = contour.at(Stop::after(own(start, u)));
            let velocity = b.tangent / b.pace;
            slope += weight * (end - cell) * a.point.dot(velocity);
            change -= weight * (end - cell) * (a.tangent / a.pace).dot(velocity);
        }
        cell = end;
    }
    [slope, change]
}

/// Returns the shift, near `shift`, at which a copy coincides with its original. For contours that are no
/// copies, returns `shift`.
fn copied(a: &[Local2], contour: &Contour, shift: f64) -> f64 {
    let size: f64 = a.iter().map(|a| a.point.length_squared()).sum();
    let mut found = shift;
    for _ in 0..8 {
        let b = centred(sampled(contour, found.rem_euclid(1.0) % 1.0));
        let (mut slope, mut gauss, mut miss) = (0.0, 0.0, 0.0);
        for (a, b) in a.iter().zip(&b) {
            let velocity = b.tangent / b.pace;
            slope += (b.point - a.point).dot(velocity);
            gauss += velocity.length_squared();
            miss += (b.point - a.point).length_squared();
        }
        if miss > COPY * COPY * size {
            return shift;
        }
        found -= slope / gauss;
    }
    found
}

/// Returns the shift nearest to `shift` that brings a corner of one contour onto a corner of the other, if
/// both have corners.
fn nearest_corner(before: &[f64], from: f64, after: &[f64], shift: f64) -> Option<f64> {
    let far = |corner: f64| (corner - shift - (corner - shift).round()).abs();
    before
        .iter()
        .flat_map(|a| after.iter().map(move |b| (b - (a - from)).rem_euclid(1.0)))
        .min_by(|a, b| far(*a).total_cmp(&far(*b)).then(a.total_cmp(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Cubic, Path, spline};

    fn ring(count: usize, turned: f64) -> Vec<DVec2> {
        (0..count).map(|i| crate::curve::turn(i as f64 / count as f64 + turned)).collect()
    }

    fn polygon(count: usize, turned: f64) -> Contour {
        let points = ring(count, turned);
        let next = points.iter().cycle().skip(1);
        let sides: Vec<_> = points.iter().zip(next).map(|(&a, &b)| Cubic::line(a, b)).collect();
        Contour::fitted(Path::new(&sides, true).unwrap(), None)
    }

    fn free(points: &[DVec2]) -> Contour {
        Contour::fitted(Path::new(&spline::through(points, true), true).unwrap(), None)
    }

    #[test]
    fn a_contour_matches_itself_as_drawn() {
        for contour in [Contour::circle(DVec2::ZERO, 2.0), polygon(5, 0.1), free(&ring(7, 0.3))] {
            assert_eq!(start(&contour, 0.0, &contour), 0.0);
            assert!((start(&contour, 0.3, &contour) - 0.3).abs() < 1e-14);
        }
    }

    #[test]
    fn circles_drawn_from_another_side_are_turned_back() {
        let circle = Contour::circle(DVec2::ZERO, 1.0);
        for turned in [0.5, 0.123_456, 0.9] {
            let smooth = free(&ring(60, turned));
            let found = start(&circle, 0.0, &smooth);
            assert!((found - (1.0 - turned)).abs() < 1e-6, "{turned}: {found}");
            let found = start(&circle, 0.0, &polygon(3, turned));
            assert!((found - (1.0 - turned)).abs() < 1e-6, "{turned}: {found}");
        }
    }

    #[test]
    fn a_corner_goes_to_a_corner_nearby() {
        // Two squares, one of them turned by two degrees.
        let turned = 2.0 / 360.0;
        let found = start(&polygon(4, 0.0), 0.0, &polygon(4, turned));
        assert_eq!(found, 0.0);
        // With a turn of 40 degrees, either no corner moves or the nearest corner is taken.
        let found = start(&polygon(4, 0.0), 0.0, &polygon(4, 40.0 / 360.0));
        assert!(found == 0.0 || found > 0.85, "{found}");
    }

    #[test]
    fn a_figure_of_eight_that_matches_both_ways_keeps_its_start() {
        let eight: Vec<DVec2> = (0..16)
            .map(|i| {
                let angle = f64::from(i) / 16.0;
                DVec2::new(crate::curve::turn(angle).x, crate::curve::turn(2.0 * angle).y)
            })
            .collect();
        assert_eq!(start(&free(&eight), 0.0, &free(&eight)), 0.0);
    }
}
