//! Crossings of a chain of straight pieces with itself.
//!
//! A tree of boxes around intervals of the chain finds the pieces that may cross. Each interval is halved down to single
//! pieces. Neighbours on the chain are near each other, so the boxes are small where the chain is cut finely.

use glam::DVec2;

/// Largest number of pieces that are tested against one piece.
///
/// With a larger number, a drawing of thousands of crossing strokes takes long. With a smaller
/// number, the reported count of such a drawing is further below the true one; the report then says
/// "at least".
const MOST_TRIED: u64 = 1 << 12;

/// The crossings of a chain with itself.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Crossings {
    /// Number of crossings.
    pub count: usize,
    /// Position of the first crossing along the chain.
    pub first: Option<DVec2>,
    /// True if the search was cut short, so that more crossings are possible.
    pub more: bool,
    /// Number of boxes and pieces that were tested.
    pub looks: u64,
}

type Bounds = [DVec2; 2];

/// Returns the crossings of the chain through these points. A chain that touches itself does not cross there.
#[must_use]
pub fn crossings(points: &[DVec2], closed: bool) -> Crossings {
    let mut found = Crossings::default();
    let pieces = points.len().saturating_sub(1);
    if pieces == 0 {
        return found;
    }
    let mut parts = Vec::new();
    divide(points, 0, pieces, &mut parts);
    let mut open = Vec::new();
    for i in 0..pieces {
        let [a, b] = [points[i], points[i + 1]];
        let own = [a.min(b), a.max(b)];
        let mut tried = 0;
        open.push((0, pieces, 0));
        while let Some((from, to, part)) = open.pop() {
            found.looks += 1;
            let [low, high] = parts[part];
            if to < i + 3 || low.cmpgt(own[1]).any() || high.cmplt(own[0]).any() {
                continue;
            }
            if to - from > 1 {
                let half = from + (to - from) / 2;
                // The earlier half is tested first, because the first crossing is reported.
                open.push((half, to, part + 2 * (half - from)));
                open.push((from, half, part + 1));
                continue;
            }
            tried += 1;
            if tried > MOST_TRIED {
                found.more = true;
                open.clear();
                break;
            }
            if closed && i == 0 && to == pieces {
                continue;
            }
            let [c, d] = [points[from], points[from + 1]];
            if let Some(at) = crossing([a, b], [c, d]) {
                found.count += 1;
                found.first.get_or_insert(at);
            }
        }
    }
    found
}

/// Appends the boxes around an interval of pieces and around its halves, a box before those of its halves. An interval
/// of `n` pieces has `2 n - 1` boxes. Returns the box of the interval.
fn divide(points: &[DVec2], from: usize, to: usize, parts: &mut Vec<Bounds>) -> Bounds {
    let index = parts.len();
    parts.push([DVec2::ZERO; 2]);
    let bounds = if to - from > 1 {
        let half = from + (to - from) / 2;
        let a = divide(points, from, half, parts);
        let b = divide(points, half, to, parts);
        [a[0].min(b[0]), a[1].max(b[1])]
    } else {
        let [a, b] = [points[from], points[to]];
        [a.min(b), a.max(b)]
    };
    parts[index] = bounds;
    bounds
}

/// Returns the point at which one straight piece crosses a later one.
fn crossing([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> Option<DVec2> {
    let of = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let (at_c, at_d) = (of(a, b, c), of(a, b, d));
    // A piece that starts on another piece crosses it there if the chain came from the other side. Exactly one of the
    // two pieces that share the point crosses.
    let passes = |x: f64, y: f64| (x < 0.0 && y >= 0.0) || (x >= 0.0 && y < 0.0);
    (passes(at_c, at_d) && passes(of(c, d, a), of(c, d, b)))
        .then(|| c.lerp(d, at_c / (at_c - at_d)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_are_counted_once() {
        let p = DVec2::new;
        let said = |points: &[DVec2], closed: bool| {
            let found = crossings(points, closed);
            (found.count, found.first)
        };
        let bow = [p(0.0, 0.0), p(2.0, 2.0), p(2.0, 0.0), p(0.0, 2.0), p(0.0, 0.0)];
        assert_eq!(said(&bow, true), (1, Some(p(1.0, 1.0))));
        // A crossing at which the chain has points also counts once.
        let cut = [
            p(0.0, 0.0),
            p(1.0, 1.0),
            p(2.0, 2.0),
            p(2.0, 0.0),
            p(1.0, 1.0),
            p(0.0, 2.0),
            p(0.0, 0.0),
        ];
        assert_eq!(said(&cut, true).0, 1);
        let square = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0), p(0.0, 0.0)];
        assert_eq!(said(&square, true), (0, None));
    }

    #[test]
    fn the_boxes_find_the_crossings_that_trying_all_finds() {
        let part = |i: usize, golden: f64| (i as f64 * golden).fract();
        for count in [1, 2, 3, 50, 333] {
            let points: Vec<DVec2> =
                (0..=count).map(|i| DVec2::new(part(i, 0.618_034), part(i, 0.754_877))).collect();
            let (mut all, mut first) = (0, None);
            for i in 0..count {
                for j in i + 2..count {
                    let pieces = [i, j].map(|k| [points[k], points[k + 1]]);
                    if let Some(at) = crossing(pieces[0], pieces[1]) {
                        all += 1;
                        first.get_or_insert(at);
                    }
                }
            }
            let found = crossings(&points, false);
            assert_eq!((found.count, found.first, found.more), (all, first, false));
        }
    }

    #[test]
    fn a_long_chain_takes_work_in_proportion_to_its_pieces() {
        let spiral = |count: usize| -> Vec<DVec2> {
            let turn = |i: usize| 40.0 * i as f64 / count as f64;
            (0..=count).map(|i| (1.0 + turn(i)) * DVec2::from_angle(turn(i))).collect()
        };
        let [one, two] =
            [20_000, 40_000].map(|count| crossings(&spiral(count), false).looks as f64);
        assert!(two < 2.3 * one, "{one} {two}");
        // All strokes pass near the centre, so the number of tests of each stroke must be bounded.
        let star = |count: usize| -> Vec<DVec2> {
            let angle = |i: usize| 3.0 * i as f64 + i as f64 * 1e-4;
            (0..=count).map(|i| DVec2::from_angle(angle(i))).collect()
        };
        let found = crossings(&star(10_000), false);
        assert!(found.more && found.looks < 10_000 * 4 * MOST_TRIED);
    }
}
