//! Cubics that are graphs: `x` does not fall along them.

use crate::curve::Cubic;
use glam::DVec2;
use kurbo::common::solve_cubic;

/// Most steps toward a position on a Bezier; bisection alone would need 53.
const MOST_STEPS: usize = 80;

/// Returns whether `at` nowhere falls along a segment, and rises from its start to its end.
#[must_use]
pub fn is_graph(segment: &Cubic<DVec2>) -> bool {
    let [p0, p1, p2, p3] = segment.0.map(|p| p.x);
    let (a, b, c) = (p1 - p0, p2 - p1, p3 - p2);
    // The speed is 3 (a s^2 + 2 b s t + c t^2) with s = 1 - t.
    p3 > p0 && a >= 0.0 && c >= 0.0 && (b >= 0.0 || b * b <= a * c)
}

/// Returns the parameter at which a segment reaches `at`, by Newton's method inside a bracket.
pub(crate) fn parameter(segment: &Cubic<DVec2>, at: f64) -> f64 {
    let [from, .., to] = segment.0.map(|p| p.x);
    let (mut low, mut high) = (0.0, 1.0);
    let mut t = (at - from) / (to - from);
    for _ in 0..MOST_STEPS {
        let off = segment.point(t).x - at;
        if off == 0.0 {
            break;
        }
        if off > 0.0 {
            high = t;
        } else {
            low = t;
        }
        let step = t - off / segment.velocity(t).x;
        let next = if step > low && step < high { step } else { 0.5 * (low + high) };
        if next == t {
            break;
        }
        t = next;
    }
    t
}

/// Returns the values of `at` where a segment is 0.
pub(super) fn zeros_of(segment: &Cubic<DVec2>) -> Vec<f64> {
    let [a, b, c, d] = segment.0.map(|p| p.y);
    let ends = segment.0.into_iter().step_by(3).filter(|p| p.y == 0.0).map(|p| p.x);
    solve_cubic(a, 3.0 * (b - a), 3.0 * (a - 2.0 * b + c), d - a + 3.0 * (b - c))
        .into_iter()
        .filter(|t| (0.0..=1.0).contains(t))
        .map(|t| segment.point(t).x)
        .chain(ends)
        .collect()
}
