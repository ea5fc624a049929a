//! Fits a few cubics to many points: P. J. Schneider's least-squares fit ("An Algorithm for Automatically
//! Fitting Digitized Curves", Graphics Gems, 1990).
//!
//! Points are divided at their corners. Between two corners, each cubic takes as many points as lie within
//! the tolerance of it. The cubic is the least-squares fit with given directions at its ends. Two cubics
//! share one direction where they meet, so all joints except corners are smooth. A joint lies on a parabola
//! fitted to the points around it, which averages noise. Ends and corners stay at their points.
//!
//! The number of points that a cubic takes is found by bisection, starting near the number that the cubic
//! before took. So the work is that of some dozen passes over the points. (Schneider divides at the worst
//! point instead. That takes 8 cubics for a circle to a thousandth, where this method takes 4.)

mod corner;
mod joint;
mod piece;

use super::cubic::Cubic;
use super::vector::Vector;
use glam::DVec2;
use joint::Joint;
use piece::Piece;

/// A piece is first tried with this many times the points of the piece before.
const REACH: usize = 4;

/// The number of points of a piece is found to within 1 / `FINE` of it.
const FINE: usize = 64;

/// Cubics fitted to points.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit<V> {
    /// The cubics, each starting at the end of the one before it.
    pub cubics: Vec<Cubic<V>>,
    /// The largest distance of a point from the cubics, in the unit of the points.
    pub reached: f64,
    /// For each point the index of its cubic and the parameter there, where the cubic passes the point.
    pub places: Vec<(usize, f64)>,
}

/// Fits cubics within `tolerance` of every point, in their order; neighbours must differ.
///
/// A closed fit needs three points, an open one two; with fewer points there are no cubics. A point that
/// turns by 30 degrees more than the points around it is a corner. All other joints are smooth, including the
/// start of a closed fit.
#[must_use]
pub fn within(points: &[DVec2], closed: bool, tolerance: f64) -> Fit<DVec2> {
    let enough = points.len() >= if closed { 3 } else { 2 };
    let corners = if enough { corner::find(points, closed, tolerance) } else { Vec::new() };
    with_corners(points, closed, tolerance, corners)
}

/// Fits cubics as [`within`] does, all of whose joints are smooth.
#[must_use]
pub fn smooth<V: Vector>(points: &[V], closed: bool, tolerance: f64) -> Fit<V> {
    with_corners(points, closed, tolerance, Vec::new())
}

fn with_corners<V: Vector>(
    points: &[V],
    closed: bool,
    tolerance: f64,
    corners: Vec<usize>,
) -> Fit<V> {
    let count = points.len();
    let mut fit = Fit { cubics: Vec::new(), reached: 0.0, places: Vec::new() };
    if count < if closed { 3 } else { 2 } {
        return fit;
    }
    let run = Run { points, closed, tolerance, corners };
    let last = if closed { count } else { count - 1 };
    let mut knots: Vec<usize> = [0, last].into_iter().chain(run.corners.iter().copied()).collect();
    if closed && run.corners.is_empty() {
        // A cubic that starts and ends at one point cannot be the whole loop.
        knots.push(count / 2);
    }
    knots.sort_unstable();
    knots.dedup();
    let first = run.joint(0);
    let mut from = first;
    for span in knots.windows(2) {
        let to = if span[1] == count { first } else { run.joint(span[1]) };
        run.fit([span[0], span[1]], [from, to], &mut fit);
        from = to;
    }
    if !closed {
        fit.places.push((fit.cubics.len().saturating_sub(1), 1.0));
    }
    fit
}

/// Points to be fitted.
struct Run<'a, V> {
    points: &'a [V],
    closed: bool,
    tolerance: f64,
    /// Indices of the points that are corners, rising; the ends of an open sequence are not included.
    corners: Vec<usize>,
}

impl<V: Vector> Run<'_, V> {
    /// Returns point `i`; indices continue after the last point of a closed sequence.
    fn point(&self, i: usize) -> V {
        self.points[i % self.points.len()]
    }

    /// Fits cubics between two joints and adds them to `fit`.
    fn fit(&self, span: [usize; 2], ends: [Joint<V>; 2], fit: &mut Fit<V>) {
        let ([mut from, end], [mut start, last]) = (span, ends);
        let mut steps = end - from;
        while from < end {
            let piece = |steps: usize| {
                let to = from + steps;
                let joint = if to == end { last } else { self.joint(to) };
                let points: Vec<V> = (from..=to).map(|i| self.point(i)).collect();
                let piece = Piece::through(&points, [start, joint], self.tolerance);
                (steps == 1 || piece.error <= self.tolerance).then_some((steps, joint, piece))
            };
            // Search down from a multiple of the last piece's points to a number that fits, then bisect.
            let mut low = steps.saturating_mul(REACH).min(end - from);
            let mut high = low + 1;
            let mut found = piece(low);
            while found.is_none() {
                high = low;
                low = (low / 2).max(1);
                found = piece(low);
            }
            while high - low > 1 + low / FINE {
                let middle = low.midpoint(high);
                match piece(middle) {
                    Some(next) => (low, found) = (middle, Some(next)),
                    None => high = middle,
                }
            }
            let Some((taken, joint, piece)) = found else { return };
            fit.reached = fit.reached.max(piece.error);
            let number = fit.cubics.len();
            fit.places.extend(piece.at.iter().take(taken).map(|&t| (number, t)));
            fit.cubics.push(piece.cubic);
            (from, start, steps) = (from + taken, joint, taken);
        }
    }
}
