//! Few cubics near many points: P. J. Schneider's least-squares fit ("An Algorithm for Automatically
//! Fitting Digitized Curves", Graphics Gems, 1990).
//!
//! Points are divided at their corners. From one of them to the next, each cubic takes as many points as
//! it can be near to; it is the nearest one in the least-squares sense whose directions at its ends
//! are given. Two cubics have one direction where they meet, so that all joints but corners are smooth.
//! Joints lie where a parabola through the points around them does, which averages noise; ends and
//! corners stay where they are.
//!
//! The number of points that a cubic takes is found by halving, beginning near that of the cubic before,
//! so the work is that of some dozen passes over the points. (Schneider divides at the worst point
//! instead, which takes 8 cubics for a circle to a thousandth, where this takes 4.)

mod corner;
mod joint;
mod piece;

use super::cubic::Cubic;
use glam::DVec2;
use joint::Joint;
use piece::Piece;

/// A piece is first tried with this many times the points of the one before.
const REACH: usize = 4;

/// The end of a piece is looked for up to this part of its points.
const FINE: usize = 64;

/// Cubics near points.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The cubics, each from the end of the one before it.
    pub cubics: Vec<Cubic<DVec2>>,
    /// The largest distance of a point from them, in the unit of the points.
    pub reached: f64,
}

/// Cubics within `tolerance` of every point, in their order; neighbours must differ.
///
/// A closed fit takes three points, an open one two; with fewer there are no cubics. Where points turn
/// by 30 degrees more than around, there is a corner; all other joints are smooth, the start of a
/// closed fit too.
#[must_use]
pub fn within(points: &[DVec2], closed: bool, tolerance: f64) -> Fit {
    let count = points.len();
    let mut fit = Fit { cubics: Vec::new(), reached: 0.0 };
    if count < if closed { 3 } else { 2 } {
        return fit;
    }
    let run = Run { points, closed, tolerance, corners: corner::find(points, closed, tolerance) };
    let last = if closed { count } else { count - 1 };
    let mut knots: Vec<usize> = [0, last].into_iter().chain(run.corners.iter().copied()).collect();
    if closed && run.corners.is_empty() {
        // A cubic that starts and ends in one place is no part of a loop.
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
    fit
}

/// Points that are fitted.
struct Run<'a> {
    points: &'a [DVec2],
    closed: bool,
    tolerance: f64,
    /// Numbers of points that are corners, rising; those of an open run are not its ends.
    corners: Vec<usize>,
}

impl Run<'_> {
    /// Point `i`, counted on after the last one of a closed run.
    fn point(&self, i: usize) -> DVec2 {
        self.points[i % self.points.len()]
    }

    /// Fits cubics from one joint to another, and adds them.
    fn fit(&self, span: [usize; 2], ends: [Joint; 2], fit: &mut Fit) {
        let ([mut from, end], [mut start, last]) = (span, ends);
        let mut steps = end - from;
        while from < end {
            let piece = |steps: usize| {
                let to = from + steps;
                let joint = if to == end { last } else { self.joint(to) };
                let points: Vec<DVec2> = (from..=to).map(|i| self.point(i)).collect();
                let piece = Piece::through(&points, [start, joint], self.tolerance);
                (steps == 1 || piece.error <= self.tolerance).then_some((steps, joint, piece))
            };
            // From what the piece before took down to what fits, and then between the two.
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
            fit.cubics.push(piece.cubic);
            (from, start, steps) = (from + taken, joint, taken);
        }
    }
}
