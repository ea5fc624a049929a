//! Rotation-minimizing frames along a whole curve.
//!
//! The frames are found once, on nodes of their own; a frame between two nodes is one more double
//! reflection from the one before. So a frame does not depend on how many rows are asked for. Along
//! a closed curve the frame comes back turned by some angle; the turn is undone evenly in length.
//!
//! Nodes are as dense as the error asks, some 1e-13 radians over all: differences of the surface, which
//! divide by their step, are not to see where nodes lie.

use super::Frame;
use crate::curve::vector::angle_between;
use crate::curve::{Curve3, Local3};
use crate::cut::Side;
use std::f64::consts::{PI, TAU};

/// Steps from knot to knot, before any is halved.
const STEPS: usize = 8;

/// Nodes of one curve, more or less, for curves of very many segments or very sharp bends.
const MOST_NODES: usize = 1 << 20;

/// A step that turns the tangent further than this, in radians, is halved.
///
/// Below it the error of a step falls with the fifth power of its length, and can be judged.
const LARGEST_TURN: f64 = 0.1;

/// A step is halved until it and its halves agree to this, in radians.
///
/// The halves are off by a fifteenth of that together, which is taken out at the nodes; between two
/// nodes it stays. Smaller, and rounding would be taken for the error; larger, and differences of the
/// surface would see the nodes.
const AGREED: f64 = 1e-13;

/// Halvings of one step at most; a bend sharper than that is a corner to all purposes.
const MOST_HALVINGS: u32 = 24;

/// An angle this near to half a turn backward, in radians, is half a turn forward.
const HALF_TURN: f64 = 1e-9;

/// Rotation-minimizing frames along a curve.
#[derive(Debug, Clone)]
pub struct Frames {
    /// Arc lengths of the nodes and the frames there; a joint has one for each side.
    nodes: Vec<(f64, Frame)>,
    /// Turn by length that closes a closed curve, in radians; 0 for an open one.
    spin: f64,
}

impl Frames {
    /// Finds the frames, from the frame at the start of the curve onward.
    pub fn new(curve: &impl Curve3, first: Frame) -> Self {
        let nodes = nodes_of(curve, first);
        let spin = match nodes.last() {
            Some((length, last)) if curve.closed() => {
                // The last step leads back onto the very first point and tangent.
                -closing(first.angle_to(last.carried_to(&curve.at(0.0)).normal)) / length
            }
            _ => 0.0,
        };
        Self { nodes, spin }
    }

    /// By how much the frames turn more than they must, in radians by length, so that a closed
    /// curve ends with the frame it began with.
    pub fn spin(&self) -> f64 {
        self.spin
    }

    /// The frame at a place of the curve, that of arc length `s` and of a side if it is a joint.
    pub fn at(&self, s: f64, place: &Local3, side: Side) -> Frame {
        let after = match side {
            Side::Before => self.nodes.partition_point(|node| node.0 < s),
            Side::After => self.nodes.partition_point(|node| node.0 <= s),
        };
        let (_, node) = &self.nodes[after.max(1) - 1];
        node.carried_to(place).turned(self.spin * s)
    }
}

/// The angle by which a frame has come back turned, from which half a turn backward is taken out.
///
/// Half a turn has no sign of its own. About the tangent the angle is the same whichever way the curve
/// is run through, and so is the surface, if the choice is.
fn closing(angle: f64) -> f64 {
    if angle < HALF_TURN - PI { angle + TAU } else { angle }
}

/// The nodes of a curve by arc length, each with its frame.
fn nodes_of(curve: &impl Curve3, first: Frame) -> Vec<(f64, Frame)> {
    let knots = curve.knots();
    let steps = (MOST_NODES / knots.len().max(1)).clamp(4, STEPS);
    let mut nodes = vec![(0.0, first)];
    for ends in knots.windows(2) {
        if let Some(&(s, last)) = nodes.last()
            && s > 0.0
        {
            nodes.push((s, last.carried_to(&curve.at(s))));
        }
        for step in 1..=steps {
            let s = ends[0] + (ends[1] - ends[0]) * (step as f64 / steps as f64);
            if step == steps {
                extend_to(curve, ends[1], &curve.before(ends[1]), MOST_HALVINGS, &mut nodes);
            } else {
                extend_to(curve, s, &curve.at(s), MOST_HALVINGS, &mut nodes);
            }
        }
    }
    nodes
}

/// Adds the node at `s`, and before it those that its accuracy needs; at least one.
fn extend_to(
    curve: &impl Curve3,
    s: f64,
    place: &Local3,
    halvings: u32,
    nodes: &mut Vec<(f64, Frame)>,
) {
    let Some(&(from, last)) = nodes.last() else { return };
    let half = 0.5 * (from + s);
    let middle = curve.at(half);
    let turned = angle_between(last.tangent, place.tangent);
    let between = last.carried_to(&middle);
    let there = between.carried_to(place);
    // Points far from the origin are rounded, and their chord is tilted by as much of its length.
    let tilt = f64::EPSILON * last.origin.length() / (place.position - last.origin).length();
    let agreed = AGREED + 4.0 * tilt.min(1.0) * turned;
    let apart = last.carried_to(place).angle_to(there.normal);
    if halvings > 0 && nodes.len() < MOST_NODES && (turned > LARGEST_TURN || apart.abs() > agreed) {
        extend_to(curve, half, &middle, halvings - 1, nodes);
        extend_to(curve, s, place, halvings - 1, nodes);
        return;
    }
    // The error falls with the fifth power of the step (Richardson).
    nodes.push((half, between.turned(apart / 30.0)));
    nodes.push((s, there.turned(apart / 15.0)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Cubic, Path, spline};
    use glam::DVec3;

    /// A helix about y with as many knots as steps are wanted.
    struct Helix {
        radius: f64,
        climb: f64,
        turns: f64,
        pieces: usize,
    }

    impl Helix {
        fn speed(&self) -> f64 {
            self.radius.hypot(self.climb)
        }

        /// The frame that turns against the torsion, from Frenet's normal and binormal.
        fn truth(&self, s: f64) -> DVec3 {
            let place = self.at(s);
            let normal = place.curvature.normalize();
            let binormal = place.tangent.cross(normal);
            let torsion = self.torsion();
            let (sin, cos) = (-torsion * s).sin_cos();
            normal * cos + binormal * sin
        }

        fn torsion(&self) -> f64 {
            // Right-handed about y for a climb upward: x leads to -z.
            self.climb / self.speed().powi(2)
        }
    }

    impl Curve3 for Helix {
        fn length(&self) -> f64 {
            TAU * self.turns * self.speed()
        }

        fn closed(&self) -> bool {
            false
        }

        fn knots(&self) -> Vec<f64> {
            (0..=self.pieces).map(|i| self.length() * i as f64 / self.pieces as f64).collect()
        }

        fn at(&self, s: f64) -> Local3 {
            let (r, h, speed) = (self.radius, self.climb, self.speed());
            let (sin, cos) = (s / speed).sin_cos();
            Local3 {
                position: DVec3::new(r * cos, h * s / speed, -r * sin),
                tangent: DVec3::new(-r * sin, h, -r * cos) / speed,
                curvature: DVec3::new(-r * cos, 0.0, r * sin) / (speed * speed),
                third: DVec3::ZERO,
            }
        }
    }

    /// The largest error of frames carried over `steps` even steps, in radians.
    fn helix_error(steps: usize) -> f64 {
        let helix = Helix { radius: 1.0, climb: 0.3, turns: 2.0, pieces: 1 };
        let place = |i: usize| helix.length() * i as f64 / steps as f64;
        let mut frame = Frame::toward(&helix.at(0.0), helix.truth(0.0)).unwrap();
        let mut error: f64 = 0.0;
        for i in 1..=steps {
            frame = frame.carried_to(&helix.at(place(i)));
            error = error.max(angle_between(frame.normal, helix.truth(place(i))));
        }
        error
    }

    #[test]
    fn frames_on_a_helix_have_order_four() {
        let errors = [64, 128, 256].map(helix_error);
        println!("helix of two turns, 64, 128, 256 steps: {errors:?}");
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - 4.0).abs() < 0.1, "order {order}");
        }
        assert!(errors[2] < 1e-7, "{errors:?}");
    }

    #[test]
    fn frames_between_nodes_are_as_good_as_those_on_them() {
        let helix = Helix { radius: 1.0, climb: 0.3, turns: 2.0, pieces: 8 };
        let first = Frame::toward(&helix.at(0.0), helix.truth(0.0)).unwrap();
        let frames = Frames::new(&helix, first);
        let mut worst: f64 = 0.0;
        for i in 0..=3001 {
            let s = helix.length() * f64::from(i) / 3001.0;
            let frame = frames.at(s, &helix.at(s), Side::After);
            worst = worst.max(angle_between(frame.normal, helix.truth(s)));
            let handed = frame.normal.cross(frame.binormal) - frame.tangent;
            assert!(handed.length() < 1e-14);
        }
        println!("helix of two turns, {} nodes: {worst:.2e}", frames.nodes.len());
        assert!(worst < 2e-13, "{worst:e}");
    }

    /// `(sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t)`, five times, at `t`.
    fn trefoil(t: f64) -> Local3 {
        let (s1, c1) = t.sin_cos();
        let (s2, c2) = (2.0 * t).sin_cos();
        let (s3, c3) = (3.0 * t).sin_cos();
        let velocity = DVec3::new(c1 + 4.0 * c2, -s1 + 4.0 * s2, -3.0 * c3);
        let position = DVec3::new(s1 + 2.0 * s2, c1 - 2.0 * c2, -s3) * 5.0;
        Local3::straight(position, velocity.normalize())
    }

    /// The frames after each eighth of a trefoil, carried over `steps` steps of even parameter.
    fn trefoil_frames(steps: usize) -> Vec<Frame> {
        let place = |i: usize| trefoil(TAU * i as f64 / steps as f64);
        let mut frame = Frame::seed(&place(0));
        let mut eighths = Vec::new();
        for i in 1..=steps {
            frame = frame.carried_to(&place(i));
            if i % (steps / 8) == 0 {
                eighths.push(frame);
            }
        }
        eighths
    }

    #[test]
    fn frames_on_a_trefoil_have_order_four() {
        let truth = trefoil_frames(1 << 14);
        let errors = [256, 512, 1024].map(|steps| {
            let angles = trefoil_frames(steps)
                .into_iter()
                .zip(&truth)
                .map(|(frame, true_frame)| frame.angle_to(true_frame.normal).abs());
            angles.fold(0.0, f64::max)
        });
        println!("trefoil, 256, 512, 1024 steps: {errors:?}");
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - 4.0).abs() < 0.2, "order {order}");
        }
    }

    /// The trefoil run through at its own speed, with Simpson's rule for the length.
    struct Trefoil {
        /// Lengths up to each of even steps of the parameter.
        lengths: Vec<f64>,
    }

    impl Trefoil {
        fn new() -> Self {
            let cells = 4096;
            let t = |i: f64| TAU * i / f64::from(cells);
            let speed = |t: f64| {
                let ((s1, c1), (s2, c2)) = (t.sin_cos(), (2.0 * t).sin_cos());
                let c3 = (3.0 * t).cos();
                5.0 * DVec3::new(c1 + 4.0 * c2, -s1 + 4.0 * s2, -3.0 * c3).length()
            };
            let mut lengths = vec![0.0];
            for i in 0..cells {
                let (a, b) = (t(f64::from(i)), t(f64::from(i) + 1.0));
                let cell = (b - a) / 6.0 * (speed(a) + 4.0 * speed(0.5 * (a + b)) + speed(b));
                lengths.push(lengths[lengths.len() - 1] + cell);
            }
            Self { lengths }
        }
    }

    impl Curve3 for Trefoil {
        fn length(&self) -> f64 {
            self.lengths[self.lengths.len() - 1]
        }

        fn closed(&self) -> bool {
            true
        }

        fn knots(&self) -> Vec<f64> {
            self.lengths.iter().copied().step_by(128).collect()
        }

        /// Frames ask for points with their tangents, and little of even speed.
        fn at(&self, s: f64) -> Local3 {
            let cells = self.lengths.len() - 1;
            let cell = self.lengths.partition_point(|&from| from <= s).clamp(1, cells) - 1;
            let (from, to) = (self.lengths[cell], self.lengths[cell + 1]);
            let part = (s - from) / (to - from);
            trefoil(TAU * (cell as f64 + part) / cells as f64)
        }
    }

    #[test]
    fn frames_of_a_trefoil_are_true_to_rounding() {
        let curve = Trefoil::new();
        let frames = Frames::new(&curve, Frame::seed(&curve.at(0.0)));
        let truth = trefoil_frames(1 << 14);
        for (i, true_frame) in truth.iter().enumerate() {
            let s = curve.lengths[512 * (i + 1)];
            let place = trefoil(TAU * (i + 1) as f64 / 8.0);
            let frame = frames.at(s, &place, Side::Before).turned(-frames.spin() * s);
            let error = frame.angle_to(true_frame.normal);
            assert!(error.abs() < 1e-12, "{i}: {error:e}, {} nodes", frames.nodes.len());
        }
        let holonomy = -(frames.spin() * curve.length()).to_degrees();
        assert!((holonomy.abs() - 127.485).abs() < 1e-3, "{holonomy}");
    }

    #[test]
    fn half_a_turn_has_one_sign_whatever_rounding_says() {
        for off in [0.0, 1e-15, 1e-12, 5e-10] {
            assert!((closing(off - PI) - (PI + off)).abs() < 1e-15 * 4.0);
            assert_eq!(closing(PI - off), PI - off);
        }
        assert_eq!(closing(1e-8 - PI), 1e-8 - PI);
    }

    fn three_d_loop() -> Path<DVec3> {
        let points = [[2.0, 0.0, 0.0], [0.0, 1.0, 2.0], [-2.0, 0.0, -0.5], [0.0, -1.0, -2.0]];
        let points = points.map(DVec3::from_array);
        Path::new(&spline::through(&points, true), true).unwrap()
    }

    #[test]
    fn a_closed_curve_ends_with_the_frame_it_began_with() {
        let path = three_d_loop();
        let first = Frame::seed(&path.at(0.0));
        let length = path.length();
        let frames = Frames::new(&path, first);
        assert!(frames.spin().abs() * length > 1e-3, "there is a turn to undo");
        let normal = |s| frames.at(s, &path.at(s), Side::Before).normal;
        let gap = (normal(length) - normal(0.0)).length();
        assert!(gap < 1e-14, "{gap:e}");
    }

    #[test]
    fn a_straight_line_keeps_its_frame() {
        let line = Cubic::line(DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, -2.0, 5.0));
        let path = Path::new(&[line], false).unwrap();
        let first = Frame::seed(&path.at(0.0));
        let frames = Frames::new(&path, first);
        for i in 0..=20 {
            let s = path.length() * f64::from(i) / 20.0;
            let frame = frames.at(s, &path.at(s), Side::After);
            assert!((frame.normal - first.normal).length() < 1e-15);
        }
    }

    #[test]
    fn an_inflection_does_not_turn_the_frame_over() {
        let p = DVec3::new;
        let wave = Cubic([p(0.0, 0.0, 0.0), p(1.0, 2.0, 0.0), p(2.0, -2.0, 0.0), p(3.0, 0.0, 0.0)]);
        let path = Path::new(&[wave], false).unwrap();
        let first = Frame::toward(&path.at(0.0), DVec3::Z).unwrap();
        let frames = Frames::new(&path, first);
        for i in 0..=50 {
            let s = path.length() * f64::from(i) / 50.0;
            let frame = frames.at(s, &path.at(s), Side::After);
            assert!((frame.normal - DVec3::Z).length() < 1e-14);
        }
    }
}
