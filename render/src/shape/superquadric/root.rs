//! The first place along a line where a field passes the level of its surface.
//!
//! A convex field is met by Newton's steps: from outside each step ends before the surface, since
//! the tangent lies below the curve, and when the tangent turns upward the line has passed by. So
//! the steps prove what they find. Other fields are searched piece by piece from the start: a piece
//! is passed when the bounds of the value leave no room for a root, has one root at most when those
//! of the slope leave it one sign, and is halved otherwise.

use super::field::{Line, Range};

/// Newton's steps at most; at a root that is nearly double each goes half the way.
const MOST_STEPS: usize = 128;

/// A piece of the line this many times smaller than the way through the box is not cut further.
///
/// Larger, and two roots so near to each other are missed; smaller, and rounding is cut in pieces.
const SMALLEST: f64 = 4.0 * f64::EPSILON;

/// How far rounding may take a computed value of the field.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// Pieces that are looked at for one ray at most.
///
/// A ray that meets the surface at an angle takes some tens, one that touches it some hundreds.
/// More are taken only by a ray that runs along the surface for a long way, to within a millionth
/// of the shape: what it meets there is decided at the ends of pieces so many times smaller than
/// the way. Without a limit such a ray could take minutes.
const MOST_PIECES: u32 = 4096;

/// The first root of a convex field after `begin`, where all of it is before `end`; a line that
/// starts on the surface has a root at `begin`, which does not count.
pub fn of_convex(line: &Line, begin: f64, end: f64, on_surface: bool) -> Option<f64> {
    let value = if on_surface { 0.0 } else { line.value(begin) };
    if value > 0.0 {
        return newton(line, begin, end);
    }
    // From inside there is one root ahead; from the surface too, if the way leads inside.
    if value < 0.0 || line.slope(begin) < 0.0 { newton(line, end, begin) } else { None }
}

/// Newton's steps from a place outside toward `limit`, until the surface or past it.
fn newton(line: &Line, from: f64, limit: f64) -> Option<f64> {
    let way = (limit - from).signum();
    let smallest = SMALLEST * (limit - from).abs();
    let mut t = from;
    for _ in 0..MOST_STEPS {
        let value = line.value(t);
        if value <= 0.0 {
            return Some(t);
        }
        let slope = way * line.slope(t);
        if slope >= 0.0 {
            return None;
        }
        let next = t - way * value / slope;
        if (next - t).abs() <= smallest {
            return Some(next);
        }
        if way * (next - limit) > 0.0 {
            return None;
        }
        t = next;
    }
    Some(t)
}

/// The first root of any field after `begin`, where all of it is before `end`; a line that starts on
/// the surface has roots up to `start`, which do not count.
pub fn first(line: &Line, begin: f64, end: f64, start: Option<f64>) -> Option<f64> {
    let mut search = Search {
        line,
        smallest: SMALLEST * (begin.abs().max(end.abs())),
        start: start.unwrap_or(f64::NEG_INFINITY),
        outside: if start.is_some() { line.slope(begin) >= 0.0 } else { line.value(begin) > 0.0 },
        pieces: MOST_PIECES,
    };
    let mut crossings = line.crossings();
    crossings.sort_unstable_by(f64::total_cmp);
    let inner = crossings.into_iter().filter(|&t| t > begin && t < end);
    let mut a = begin;
    for b in inner.chain([end]) {
        if let Some(root) = search.piece(a, b) {
            return Some(root);
        }
        a = b;
    }
    None
}

/// Where a search has come to.
struct Search<'a> {
    line: &'a Line,
    smallest: f64,
    start: f64,
    /// Which side the line is on, as far as it has been followed.
    outside: bool,
    /// How many pieces may still be looked at.
    pieces: u32,
}

impl Search<'_> {
    /// The first root between `a` and `b`, where coordinates keep their signs.
    fn piece(&mut self, a: f64, b: f64) -> Option<f64> {
        let [value, slope] = self.line.ranges(a, b);
        self.pieces = self.pieces.saturating_sub(1);
        let mut side = side(value);
        if side.is_none() {
            // The mean value theorem tells more of small pieces than their boxes do.
            let half = 0.5 * (b - a);
            let reach = half * slope[0].abs().max(slope[1].abs());
            if reach < 1.0 {
                let middle = self.line.value(a + half);
                side = self::side([middle - reach, middle + reach]);
                if side.is_none() && reach <= NOISE {
                    side = Some(middle > 0.0);
                }
            }
        }
        if let Some(outside) = side {
            // On the other side than before: rounding has hidden the root between two pieces.
            return self.passed(outside, |_| a);
        }
        let one_way = slope[0] > 0.0 || slope[1] < 0.0;
        if one_way || b - a <= self.smallest || self.pieces == 0 {
            let outside = self.line.value(b) > 0.0;
            return self.passed(outside, |search| search.bracketed(a, b, outside));
        }
        let middle = 0.5 * (a + b);
        self.piece(a, middle).or_else(|| self.piece(middle, b))
    }

    /// Goes on to a side, and gives the root on the way to it if there is one that counts.
    fn passed(&mut self, outside: bool, root: impl Fn(&Self) -> f64) -> Option<f64> {
        if outside == self.outside {
            return None;
        }
        self.outside = outside;
        Some(root(self)).filter(|&root| root > self.start)
    }

    /// The root between two places on different sides; `outward` when `b` is the outer one.
    fn bracketed(&self, mut a: f64, mut b: f64, outward: bool) -> f64 {
        let mut t = 0.5 * (a + b);
        let mut step = b - a;
        for _ in 0..MOST_STEPS {
            let value = self.line.value(t);
            if (value > 0.0) == outward {
                b = t;
            } else {
                a = t;
            }
            if value == 0.0 || b - a <= self.smallest {
                break;
            }
            let newton = value / self.line.slope(t);
            // Newton's step, unless it leaves the bracket or is not half as long as the last one.
            let next = if newton.abs() < 0.5 * step.abs() && t - newton > a && t - newton < b {
                // At least so far that it is seen to pass the root, if it is as near as that.
                t - newton.abs().max(0.5 * self.smallest).copysign(newton)
            } else {
                0.5 * (a + b)
            };
            step = next - t;
            t = next;
        }
        t
    }
}

/// Whether a range of values is outside or inside, if it is all on one side.
fn side(value: Range) -> Option<bool> {
    if value[0] > 0.0 {
        Some(true)
    } else if value[1] < 0.0 {
        Some(false)
    } else {
        None
    }
}
