//! Detection of corners in a sequence of points.

use glam::DVec2;

/// Least difference in degrees between the turn at a corner and the turns around it.
const CORNER_DEG: f64 = 30.0;

/// A turn is measured between legs at least this many tolerances long, so that points half a tolerance off
/// make no corner.
const LEG: f64 = 8.0;

/// Points nearer than this fraction of a leg to the point before are skipped in the search.
const APART: f64 = 0.125;

/// Most steps from a point to the end of a leg.
const MOST_STEPS: usize = 64;

/// Returns the indices of the points that are corners, rising. The ends of an open sequence are no corners.
///
/// The turn at a point is the angle between its legs: the lines to the nearest points before and after it
/// that are a leg away. A point is a corner if its turn is larger by 30 degrees than the turns at both ends
/// of its legs, and no turn between them is larger. So a circle has no corners, however few its points.
pub fn find(points: &[DVec2], closed: bool, tolerance: f64) -> Vec<usize> {
    let leg = LEG * tolerance;
    let mut kept: Vec<usize> = Vec::new();
    for (i, point) in points.iter().enumerate() {
        let far = |&last: &usize| points[last].distance(*point) >= APART * leg;
        if kept.last().is_none_or(far) {
            kept.push(i);
        }
    }
    let search = Search { points, kept: &kept, closed, leg };
    let turns: Vec<Option<Turn>> = (0..kept.len()).map(|at| search.turn(at)).collect();
    let mut corners: Vec<usize> = (0..kept.len())
        .filter_map(|at| {
            let turn = turns[at]?;
            let count = kept.len();
            let least = turn.angle - CORNER_DEG.to_radians();
            // Near the ends of an open sequence there is a turn at one end only, or at none.
            let around = [turn.before, turn.after].into_iter().filter_map(|end| turns[end]);
            let mut straighter = around.map(|turn| turn.angle < least).peekable();
            let sharp = straighter.peek().is_some() && straighter.all(|is| is);
            let between = (turn.after + count - turn.before) % count;
            let largest = (1..between).all(|k| {
                let other = (turn.before + k) % count;
                turns[other].is_none_or(|next| {
                    next.angle < turn.angle || (next.angle == turn.angle && other >= at)
                })
            });
            (sharp && largest).then(|| search.tip(turn))
        })
        .collect();
    corners.sort_unstable();
    corners.dedup();
    corners
}

/// The turn at a point in radians, and the ends of its legs.
#[derive(Clone, Copy)]
struct Turn {
    angle: f64,
    before: usize,
    after: usize,
}

struct Search<'a> {
    points: &'a [DVec2],
    kept: &'a [usize],
    closed: bool,
    leg: f64,
}

impl Search<'_> {
    fn point(&self, at: usize) -> DVec2 {
        self.points[self.kept[at]]
    }

    fn turn(&self, at: usize) -> Option<Turn> {
        let count = self.kept.len();
        let end = |next: fn(usize, usize) -> usize, last: usize| {
            let mut index = at;
            for _ in 0..MOST_STEPS.min(count / 2) {
                if !self.closed && index == last {
                    return None;
                }
                index = next(index, count);
                if self.point(index).distance(self.point(at)) >= self.leg {
                    return Some(index);
                }
            }
            None
        };
        let before = end(|index, count| (index + count - 1) % count, 0)?;
        let after = end(|index, count| (index + 1) % count, count - 1)?;
        let here = self.point(at);
        let angle = (here - self.point(before)).angle_to(self.point(after) - here).abs();
        Some(Turn { angle, before, after })
    }

    /// Returns the index of the point between the ends of two legs that is furthest from the line
    /// through these ends.
    fn tip(&self, turn: Turn) -> usize {
        let count = self.points.len();
        let (from, to) = (self.kept[turn.before], self.kept[turn.after]);
        let (start, across) = (self.points[from], (self.points[to] - self.points[from]).perp());
        let mut tip = (from, -1.0);
        for k in 1..(to + count - from) % count {
            let i = (from + k) % count;
            let height = (self.points[i] - start).dot(across).abs();
            if height > tip.1 {
                tip = (i, height);
            }
        }
        tip.0
    }
}
