//! One cubic fitted to a sequence of points.

use super::joint::Joint;
use crate::curve::cubic::Cubic;
use crate::curve::vector::Vector;

/// Most rounds that move the parameters of the points to the nearest points of the cubic.
const ROUNDS: usize = 12;

/// Parameters are moved only if the error is below this many tolerances; above it, moving gains nothing.
const IN_REACH: f64 = 1024.0;

/// Shortest handle, as a fraction of the chord.
const SHORTEST: f64 = 0.01;

/// Longest handle, as a fraction of the length of the polyline through the points.
const LONGEST: f64 = 1.0;

/// A cubic and its error.
pub struct Piece<V> {
    pub cubic: Cubic<V>,
    /// The largest distance of a point from the cubic at the point's parameter.
    pub error: f64,
    /// The parameters of the points, from 0 to 1.
    pub at: Vec<f64>,
}

impl<V: Vector> Piece<V> {
    /// Fits the cubic from one joint to another to the points between.
    pub fn through(points: &[V], [start, end]: [Joint<V>; 2], tolerance: f64) -> Self {
        let mut at = chord_lengths(points);
        let length_along: f64 = points.windows(2).map(|ends| (ends[0] - ends[1]).length()).sum();
        let ends = [start.point, end.point];
        let directions = [start.after, -end.before];
        let weights = vec![None; points.len()];
        let first = least_squares(points, &at, &weights, ends, directions, length_along);
        let mut best = Self::measured(first, points, &at);
        let mut cubic = best.cubic;
        for _ in 0..ROUNDS {
            if best.error <= tolerance || best.error > IN_REACH * tolerance {
                break;
            }
            for (t, &point) in at.iter_mut().zip(points) {
                *t = nearer(&cubic, *t, point);
            }
            let moved = Self::measured(cubic, points, &at);
            if moved.error < best.error {
                best = moved;
            }
            let tangents: Vec<_> = at.iter().map(|&t| Some(cubic.tangent(t))).collect();
            cubic = least_squares(points, &at, &tangents, ends, directions, length_along);
        }
        best
    }

    fn measured(cubic: Cubic<V>, points: &[V], at: &[f64]) -> Self {
        let off = at.iter().zip(points).map(|(&t, point)| (cubic.point(t) - *point).length());
        Self { cubic, error: off.fold(0.0, f64::max), at: at.to_vec() }
    }
}

/// Returns the parameters of points by chord length, from 0 to 1.
fn chord_lengths<V: Vector>(points: &[V]) -> Vec<f64> {
    let mut at = vec![0.0];
    let mut length_along = 0.0;
    for ends in points.windows(2) {
        length_along += (ends[0] - ends[1]).length();
        at.push(length_along);
    }
    at.iter().map(|length| length / length_along).collect()
}

/// Returns the cubic whose handles have given directions and the lengths with the least sum of squared
/// distances. If a length would be out of bounds, both are a third of the chord.
///
/// If a point has a normal, only the distance along the normal counts, so that points slide along
/// the curve. Such a step is a Gauss-Newton step for the true distances, where plain steps take
/// hundreds of rounds.
fn least_squares<V: Vector>(
    points: &[V],
    at: &[f64],
    tangents: &[Option<V>],
    [start, end]: [V; 2],
    [leaving, reaching]: [V; 2],
    length_along: f64,
) -> Cubic<V> {
    // The equations for the two lengths: [aa ab; ab bb] (a, b) = (ra, rb).
    let (mut aa, mut ab, mut bb, mut ra, mut rb) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for ((&t, &point), tangent) in at.iter().zip(points).zip(tangents) {
        let s = 1.0 - t;
        let (a, b) = (leaving * (3.0 * s * s * t), reaching * (3.0 * s * t * t));
        let rest =
            (point - start) * (s * s * (s + 3.0 * t)) + (point - end) * (t * t * (t + 3.0 * s));
        let [a, b, rest] = match tangent {
            Some(tangent) => [a, b, rest].map(|v| v.across(*tangent)),
            None => [a, b, rest],
        };
        aa += a.dot(a);
        ab += a.dot(b);
        bb += b.dot(b);
        ra += a.dot(rest);
        rb += b.dot(rest);
    }
    let chord = (start - end).length();
    let det = aa * bb - ab * ab;
    let lengths = [(ra * bb - rb * ab) / det, (rb * aa - ra * ab) / det];
    let fits = |&length: &f64| length >= SHORTEST * chord && length <= LONGEST * length_along;
    let third = chord / 3.0;
    let [a, b] = if lengths.iter().all(fits) { lengths } else { [third; 2] };
    Cubic([start, start + leaving * a, end + reaching * b, end])
}

/// Returns a parameter nearer to the point of the cubic closest to `point`, by one step of Newton's method.
fn nearer<V: Vector>(cubic: &Cubic<V>, t: f64, point: V) -> f64 {
    let off = cubic.point(t) - point;
    let (velocity, acceleration) = (cubic.velocity(t), cubic.acceleration(t));
    let slope = velocity.dot(velocity) + off.dot(acceleration);
    let step = off.dot(velocity) / slope;
    if slope > 0.0 && step.is_finite() { (t - step).clamp(0.0, 1.0) } else { t }
}
