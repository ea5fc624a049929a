//! Laws: numbers that change along a trajectory.
//!
//! A law is a function of `at`, the fraction of the trajectory's length, and has a derivative in closed form.
//! Each kind of law guarantees:
//!
//! | law           | continuous | derivative continuous (C1)                                      |
//! |---------------|------------|-----------------------------------------------------------------|
//! | a number      | yes        | yes                                                             |
//! | smooth keys   | yes        | yes: it is 0 at every key (`3 x^2 - 2 x^3` between two)          |
//! | linear keys   | yes        | no: it jumps at keys, and the surface has an edge there          |
//! | Bezier        | yes        | inside a segment, and at joints whose handles are in line        |
//! | total         | yes        | yes                                                             |
//!
//! Keys and Beziers are constant outside their ends, with a derivative of 0. Where the derivative jumps, its
//! value is that of the side after; at the end of the trajectory it is that of the side before. A Bezier may
//! be vertical, as at the end of a round cap; its derivative is then [`STEEPEST`].
//!
//! A new law must provide its JSON, and a variant of [`spec::Law`](crate::spec::Law) that
//! `read/law.rs` checks. It also needs a variant of `Form` with an arm in each method of this file.
//! These methods return its value and derivative at a stop, its graph in cubics, its range, its
//! negative, its zeros, its detail in cells and its kinks. A law that its graph of cubics expresses
//! needs no variant of its own: `total` is such a law. A new interpolation of keys is a member of
//! [`Ease`].

mod ease;
mod graph;
mod heights;
mod snap;

pub use ease::Ease;
pub use graph::is_graph;
pub(crate) use graph::parameter;
pub(crate) use heights::Heights;

use crate::curve::Cubic;
use crate::curve::cut::{Side, Stop};
use glam::DVec2;
use kurbo::{CubicBez, Point, Shape};

/// Largest absolute value of a derivative. Far larger ones would overflow when squared.
pub const STEEPEST: f64 = 1e30;

/// Two pieces of a graph that meet with a smaller sine of their angle have one derivative there.
const SMOOTH: f64 = 1e-9;

/// A checked function of the fraction of the trajectory's length.
#[derive(Debug, Clone)]
pub struct Law(Form);

#[derive(Debug, Clone)]
enum Form {
    Constant(f64),
    Keys { keys: Vec<[f64; 2]>, ease: Ease },
    Bezier(Vec<Cubic<DVec2>>),
}

impl Law {
    /// Returns a law with the same value everywhere.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self(Form::Constant(value))
    }

    /// Returns a law through keys `[at, value]`: at least one, with `at` strictly rising.
    #[must_use]
    pub fn keys(keys: Vec<[f64; 2]>, ease: Ease) -> Self {
        Self(Form::Keys { keys, ease })
    }

    /// Returns a law with a graph of cubics of points `(at, value)`: at least one, which meet and along which
    /// `at` does not fall.
    #[must_use]
    pub fn bezier(segments: Vec<Cubic<DVec2>>) -> Self {
        Self(Form::Bezier(segments))
    }

    /// Returns a linear law from 0 at the start to `value` at the end.
    #[must_use]
    pub fn total(value: f64) -> Self {
        Self::keys(vec![[0.0, 0.0], [1.0, value]], Ease::Linear)
    }

    /// Returns the value and the derivative at `at` in `[0, 1]`; where the derivative jumps, of the side after.
    #[must_use]
    pub fn at(&self, at: f64) -> (f64, f64) {
        self.on(Stop::after(at))
    }

    /// Returns the value and the derivative at a stop; where the derivative jumps, of the stop's side.
    #[must_use]
    pub fn on(&self, stop: Stop) -> (f64, f64) {
        let Stop { at, side } = stop;
        let passed = |end: f64| if side == Side::Before { end < at } else { end <= at };
        let is_end = |end: f64| side == Side::After && is_end(at, end);
        match &self.0 {
            Form::Constant(value) => (*value, 0.0),
            Form::Keys { keys, ease } => {
                let next = keys.partition_point(|key| passed(key[0]));
                let next = if is_end(keys[keys.len() - 1][0]) { next - 1 } else { next };
                if next == 0 || next == keys.len() {
                    return (keys[next.min(keys.len() - 1)][1], 0.0);
                }
                let ([from, a], [to, b]) = (keys[next - 1], keys[next]);
                let x = (at - from) / (to - from);
                let (part, slope) = ease.weight(x);
                // In this form both ends are met exactly.
                (a * (1.0 - part) + b * part, bounded((b - a) * slope / (to - from)))
            }
            Form::Bezier(segments) => {
                let last = segments[segments.len() - 1].0[3];
                let first = segments[0].0[0];
                let next = segments.partition_point(|segment| passed(segment.0[3].x));
                let next = if is_end(last.x) { next - 1 } else { next };
                if at < first.x || next == segments.len() {
                    return (if at < first.x { first.y } else { last.y }, 0.0);
                }
                let segment = &segments[next];
                let t = parameter(segment, at);
                // Where the speed is 0 the curve still has a direction.
                let direction = segment.tangent(t);
                (segment.point(t).y, bounded(direction.y / direction.x.max(0.0)))
            }
        }
    }

    /// Returns the graph as cubics of points `(at, value)` for `at` from 0 to 1, with the constant parts at
    /// the ends.
    #[must_use]
    pub(crate) fn graph(&self) -> Vec<Cubic<DVec2>> {
        let mut graph = match &self.0 {
            Form::Constant(value) => vec![level(0.0, 1.0, *value)],
            Form::Keys { keys, ease } => keys
                .windows(2)
                .map(|pair| ease.graph(DVec2::from_array(pair[0]), DVec2::from_array(pair[1])))
                .collect(),
            Form::Bezier(segments) => segments.clone(),
        };
        let ends = self.ends();
        let first = graph.first().map_or(1.0, |cubic| cubic.0[0].x);
        if first > 0.0 {
            graph.insert(0, level(0.0, first, ends[0]));
        }
        let last = graph.last().map_or(0.0, |cubic| cubic.0[3].x);
        if last < 1.0 {
            graph.push(level(last, 1.0, ends[1]));
        }
        graph
    }

    /// Returns the least and the greatest value.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        let wider = |(low, high): (f64, f64), (a, b): (f64, f64)| (low.min(a), high.max(b));
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        match &self.0 {
            Form::Constant(value) => (*value, *value),
            Form::Keys { keys, .. } => keys.iter().map(|key| (key[1], key[1])).fold(none, wider),
            Form::Bezier(segments) => segments
                .iter()
                .map(|segment| {
                    let [p0, p1, p2, p3] = segment.0.map(|p| Point::new(p.x, p.y));
                    let bounds = CubicBez::new(p0, p1, p2, p3).bounding_box();
                    (bounds.y0, bounds.y1)
                })
                .fold(none, wider),
        }
    }

    /// Returns the law with its sign reversed.
    pub(crate) fn negated(self) -> Self {
        Self(match self.0 {
            Form::Constant(value) => Form::Constant(-value),
            Form::Keys { mut keys, ease } => {
                keys.iter_mut().for_each(|key| key[1] = -key[1]);
                Form::Keys { keys, ease }
            }
            Form::Bezier(segments) => Form::Bezier(
                segments.iter().map(|one| Cubic(one.0.map(|p| DVec2::new(p.x, -p.y)))).collect(),
            ),
        })
    }

    /// Returns half the law.
    pub(crate) fn halved(self) -> Self {
        Self(match self.0 {
            Form::Constant(value) => Form::Constant(0.5 * value),
            Form::Keys { mut keys, ease } => {
                keys.iter_mut().for_each(|key| key[1] *= 0.5);
                Form::Keys { keys, ease }
            }
            Form::Bezier(segments) => Form::Bezier(
                segments
                    .iter()
                    .map(|one| Cubic(one.0.map(|p| DVec2::new(p.x, 0.5 * p.y))))
                    .collect(),
            ),
        })
    }

    /// Returns the zeros of the law, rising: single zeros, and both ends of an interval of zeros.
    pub(crate) fn zeros(&self) -> Vec<f64> {
        let mut found: Vec<f64> = match &self.0 {
            Form::Constant(_) => Vec::new(),
            Form::Keys { keys, ease } => {
                let on_key = keys.iter().filter(|key| key[1] == 0.0).map(|key| key[0]);
                let crossed = keys.windows(2).filter(|pair| pair[0][1] * pair[1][1] < 0.0);
                on_key.chain(crossed.map(|pair| crossing(pair[0], pair[1], *ease))).collect()
            }
            Form::Bezier(segments) => segments.iter().flat_map(graph::zeros_of).collect(),
        };
        found.retain(|at| (0.0..=1.0).contains(at));
        found.sort_by(f64::total_cmp);
        found
    }

    /// Returns the number of cells that resolves the law: eight for each segment or key.
    pub(crate) fn detail(&self) -> f64 {
        match &self.0 {
            Form::Constant(_) => 0.0,
            Form::Keys { keys, .. } => 8.0 * keys.len() as f64,
            Form::Bezier(segments) => 8.0 * segments.len() as f64,
        }
    }

    /// Returns the positions inside the trajectory where the derivative may jump.
    pub(crate) fn kinks(&self) -> Vec<f64> {
        let inside = |at: &f64| *at > 0.0 && *at < 1.0;
        match &self.0 {
            Form::Constant(_) => Vec::new(),
            Form::Keys { ease, .. } if !ease.has_kinks() => Vec::new(),
            Form::Keys { keys, .. } => keys.iter().map(|key| key[0]).filter(inside).collect(),
            Form::Bezier(segments) => {
                let ends = [segments[0].0[0].x, segments[segments.len() - 1].0[3].x];
                let bends = segments.windows(2).filter(|pair| {
                    let [before, after] = [pair[0].tangent(1.0), pair[1].tangent(0.0)];
                    before.perp_dot(after).abs() > SMOOTH
                });
                let mut joints: Vec<f64> = ends
                    .into_iter()
                    .chain(bends.map(|pair| pair[0].0[3].x))
                    .filter(inside)
                    .collect();
                joints.sort_by(f64::total_cmp);
                joints.dedup();
                joints
            }
        }
    }

    /// Returns the values at the start and at the end of the trajectory.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.at(0.0).0, self.at(1.0).0]
    }
}

/// Returns a piece of a graph with a constant value.
fn level(from: f64, to: f64, value: f64) -> Cubic<DVec2> {
    Cubic::line(DVec2::new(from, value), DVec2::new(to, value))
}

/// Returns whether `at` is the end of both the trajectory and the law, where only the side before exists.
fn is_end(at: f64, last: f64) -> bool {
    at == last && last == 1.0
}

fn bounded(slope: f64) -> f64 {
    if slope.is_nan() { 0.0 } else { slope.clamp(-STEEPEST, STEEPEST) }
}

/// Returns the position between two keys of different signs where the law is 0.
fn crossing([from, a]: [f64; 2], [to, b]: [f64; 2], ease: Ease) -> f64 {
    from + (to - from) * ease.crossing(a / (a - b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cubic(points: [[f64; 2]; 4]) -> Cubic<DVec2> {
        Cubic(points.map(DVec2::from_array))
    }

    fn laws() -> Vec<Law> {
        let keys = vec![[0.1, 2.0], [0.4, -1.0], [0.9, 3.0]];
        let up = cubic([[0.0, 1.0], [0.2, 3.0], [0.3, -2.0], [0.6, 0.5]]);
        let down = cubic([[0.6, 0.5], [0.6, 1.0], [0.9, 1.0], [1.0, 0.0]]);
        vec![
            Law::constant(3.0),
            Law::keys(keys.clone(), Ease::Linear),
            Law::keys(keys, Ease::Smooth),
            Law::bezier(vec![up, down]),
            Law::total(360.0),
        ]
    }

    #[test]
    fn slopes_agree_with_differences() {
        for law in laws() {
            let (low, high) = law.range();
            for i in 1..200 {
                let at = f64::from(i) / 200.0;
                assert!((low..=high).contains(&law.at(at).0));
                if [0.1, 0.4, 0.6, 0.9].iter().any(|knot: &f64| (knot - at).abs() < 0.04) {
                    continue;
                }
                let h = 1e-4;
                let value = |at| law.at(at).0;
                let slope = (8.0 * (value(at + h) - value(at - h))
                    - (value(at + 2.0 * h) - value(at - 2.0 * h)))
                    / (12.0 * h);
                let error = (slope - law.at(at).1).abs();
                assert!(error < 1e-9 * (1.0 + slope.abs()), "{law:?} at {at}: {error:e}");
            }
        }
    }

    #[test]
    fn a_graph_has_the_values_of_its_law() {
        for law in laws() {
            let graph = law.graph();
            assert_eq!((graph[0].0[0].x, graph[graph.len() - 1].0[3].x), (0.0, 1.0));
            assert!(graph.windows(2).all(|pair| pair[0].0[3] == pair[1].0[0]));
            for i in 0..100 {
                let at = f64::from(i) / 100.0;
                let next = graph.partition_point(|cubic| cubic.0[3].x <= at);
                let value = graph[next].point(parameter(&graph[next], at)).y;
                assert!(
                    (value - law.at(at).0).abs() < 1e-13 * (1.0 + value.abs()),
                    "{law:?} at {at}"
                );
            }
        }
    }

    #[test]
    fn keys_are_met_exactly_and_held_outside() {
        for law in &laws()[1..3] {
            for (at, value) in [(0.0, 2.0), (0.1, 2.0), (0.4, -1.0), (0.9, 3.0), (1.0, 3.0)] {
                assert_eq!(law.at(at).0, value);
            }
            assert_eq!((law.at(0.05).1, law.at(0.95).1, law.at(1.0).1), (0.0, 0.0, 0.0));
            assert_eq!((law.ends(), law.range()), ([2.0, 3.0], (-1.0, 3.0)));
        }
        assert_eq!(Law::keys(vec![[0.5, 7.0]], Ease::Smooth).at(0.2), (7.0, 0.0));
    }

    #[test]
    fn zeros_are_found_and_each_side_has_its_slope() {
        let keys = Law::keys(
            vec![[0.0, 2.0], [0.5, -2.0], [0.6, 0.0], [0.7, 0.0], [1.0, 3.0]],
            Ease::Linear,
        );
        assert_eq!(keys.zeros(), [0.25, 0.6, 0.7]);
        assert_eq!(keys.on(Stop::before(0.7)), (0.0, 0.0));
        assert!((keys.on(Stop::after(0.7)).1 - 10.0).abs() < 1e-12);
        assert_eq!(keys.clone().negated().zeros(), keys.zeros());
        assert_eq!(Law::keys(vec![[0.0, 1.0], [1.0, -1.0]], Ease::Smooth).zeros(), [0.5]);
        let line = Law::bezier(vec![cubic([[0.0, -1.0], [0.25, 0.0], [0.5, 1.0], [1.0, 2.0]])]);
        let zero = line.zeros();
        assert!(zero.len() == 1 && line.at(zero[0]).0.abs() < 1e-15, "{zero:?}");
    }

    #[test]
    fn a_total_runs_evenly_to_the_end() {
        let law = Law::total(90.0);
        assert_eq!([0.0, 0.5, 1.0].map(|at| law.at(at)), [(0.0, 90.0), (45.0, 90.0), (90.0, 90.0)]);
    }

    #[test]
    fn smooth_keys_and_handles_in_line_are_c1() {
        let first = cubic([[0.0, 0.0], [0.1, 1.0], [0.3, 1.0], [0.5, 2.0]]);
        let second = cubic([[0.5, 2.0], [0.6, 2.5], [0.8, 0.0], [1.0, 0.0]]);
        for law in [laws()[2].clone(), Law::bezier(vec![first, second])] {
            for at in [0.1, 0.4, 0.5, 0.9] {
                let jump = law.at(at + 1e-12).1 - law.at(at - 1e-12).1;
                assert!(jump.abs() < 1e-8, "{law:?} at {at}: {jump:e}");
            }
        }
    }

    #[test]
    fn a_vertical_end_is_steep_and_finite() {
        // Approximately a quarter of a circle, from full width to width 0.
        let cap = Law::bezier(vec![cubic([[0.0, 1.0], [0.55, 1.0], [1.0, 0.55], [1.0, 0.0]])]);
        assert_eq!(cap.at(0.0), (1.0, 0.0));
        assert_eq!(cap.at(1.0), (0.0, -STEEPEST));
        assert!((cap.at(0.6).0 - 0.8).abs() < 1e-2);
        assert!(cap.at(1.0 - 1e-12).1 < -1e5);
    }

    #[test]
    fn a_graph_does_not_turn_back() {
        let with =
            |x1: f64, x2: f64| is_graph(&cubic([[0.0, 0.0], [x1, 0.0], [x2, 0.0], [1.0, 0.0]]));
        assert!(with(0.3, 0.6) && with(0.0, 1.0) && with(1.0, 0.0) && with(0.6, 0.4));
        assert!(!with(-0.1, 0.5) && !with(0.5, 1.1) && !with(1.0, -0.01));
        assert!(!is_graph(&cubic([[0.5, 0.0], [0.5, 1.0], [0.5, 2.0], [0.5, 3.0]])));
    }
}
