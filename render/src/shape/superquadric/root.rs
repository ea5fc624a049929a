//! Finds the first point along a line where a field reaches the level of its surface.
//!
//! In a convex field Newton's method is used. A step from outside ends before the surface, since
//! the tangent lies below the curve. If the tangent turns upward, the line has missed the surface.
//! The steps thus prove their result. Other fields are searched piece by piece from the start. A
//! piece is skipped if the bounds of its value exclude a root. It has at most one root if the
//! bounds of its slope have one sign. Otherwise the piece is halved.

use super::field::{Line, Range};

/// Largest number of Newton steps. Near an almost double root each step only halves the distance.
const MOST_STEPS: usize = 128;

/// Length of the smallest piece that is still halved, relative to the length of the search.
///
/// With a larger value two roots so close to each other are missed. With a smaller value pieces are
/// halved below the rounding.
const SMALLEST: f64 = 4.0 * f64::EPSILON;

/// Largest effect of rounding on a computed value of the field.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// Largest number of pieces that are searched for one ray.
///
/// A ray that meets the surface at an angle takes some tens, and a ray that touches it some
/// hundreds. Only a ray that runs along the surface for a long distance, to within a millionth of
/// the shape, takes more. Its hits are then decided only at the ends of that many pieces. Without a
/// limit such a ray could take minutes.
const MOST_PIECES: u32 = 4096;

/// Returns the first root of a convex field after `begin`. The whole surface lies before `end`. A
/// line that starts on the surface has a root at `begin`, which does not count.
pub fn of_convex(line: &Line, begin: f64, end: f64, on_surface: bool) -> Option<f64> {
    let value = if on_surface { 0.0 } else { line.value(begin) };
    if value > 0.0 {
        return newton(line, begin, end);
    }
    // From inside there is one root ahead; from the surface too, if the line leads inside.
    if value < 0.0 || line.slope(begin) < 0.0 { newton(line, end, begin) } else { None }
}

/// Takes Newton steps from a point outside toward `limit`, until they reach the surface or pass it.
fn newton(line: &Line, from: f64, limit: f64) -> Option<f64> {
    let sign = (limit - from).signum();
    let smallest = SMALLEST * (limit - from).abs();
    let mut t = from;
    for _ in 0..MOST_STEPS {
        let value = line.value(t);
        if value <= 0.0 {
            return Some(t);
        }
        let slope = sign * line.slope(t);
        if slope >= 0.0 {
            return None;
        }
        let next = t - sign * value / slope;
        if (next - t).abs() <= smallest {
            return Some(next);
        }
        if sign * (next - limit) > 0.0 {
            return None;
        }
        t = next;
    }
    Some(t)
}

/// Returns the first root of any field after `begin`. The whole surface lies before `end`. A line
/// that starts on the surface has roots up to `start`, which do not count.
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

/// State of the search along a line.
struct Search<'a> {
    line: &'a Line,
    smallest: f64,
    start: f64,
    /// True if the line is outside at the point that the search has reached.
    outside: bool,
    /// Number of pieces that may still be searched.
    pieces: u32,
}

impl Search<'_> {
    /// Returns the first root between `a` and `b`, where coordinates keep their signs.
    fn piece(&mut self, a: f64, b: f64) -> Option<f64> {
        let [value, slope] = self.line.ranges(a, b);
        self.pieces = self.pieces.saturating_sub(1);
        let mut side = side(value);
        if side.is_none() {
            // The mean value theorem gives tighter bounds of small pieces than their boxes do.
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
            // The side differs from the last one: rounding has hidden the root between two pieces.
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

    /// Moves the search to a side, and returns the root before it, if there is one that counts.
    fn passed(&mut self, outside: bool, root: impl Fn(&Self) -> f64) -> Option<f64> {
        if outside == self.outside {
            return None;
        }
        self.outside = outside;
        Some(root(self)).filter(|&root| root > self.start)
    }

    /// Returns the root between two points on different sides; `b` is the outer point if `outward`.
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
            // Takes Newton's step unless it leaves the bracket or is at least half as long as the
            // last step.
            let next = if newton.abs() < 0.5 * step.abs() && t - newton > a && t - newton < b {
                // The step is lengthened to pass a root that is nearer than the smallest piece.
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

/// Returns the side of a range of values: `true` for outside, `false` for inside, and `None` if the
/// range reaches both sides.
fn side(value: Range) -> Option<bool> {
    if value[0] > 0.0 {
        Some(true)
    } else if value[1] < 0.0 {
        Some(false)
    } else {
        None
    }
}
