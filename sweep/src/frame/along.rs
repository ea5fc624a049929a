//! Rotation-minimizing frames along a whole curve.
//!
//! The frames are found once, on nodes of their own; a frame between two nodes is one more double
//! reflection from the one before. So a frame does not depend on how many rows are asked for. Along
//! a closed curve the frame comes back turned by some angle; the turn is undone evenly in length.

use super::Frame;
use crate::curve::vector::angle_between;
use crate::curve::{Curve3, Local3};
use crate::cut::Side;

/// Steps from knot to knot. With the order of the method, 64 on a quarter turn leave an error of
/// about 1e-10 radians.
const STEPS: usize = 64;

/// Nodes of one curve at most, for curves of very many segments, whose pieces are short and
/// straight enough for fewer steps.
const MOST_NODES: usize = 1 << 20;

/// A step that turns the tangent further than this, in radians, is halved.
///
/// It matters only where a curve bends sharply within a sixty-fourth of a segment.
const LARGEST_TURN: f64 = 0.1;

/// Halvings of one step at most; a bend sharper than that is a corner to all purposes.
const MOST_HALVINGS: u32 = 20;

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
                -first.angle_to(last.carried_to(&curve.at(0.0)).normal) / length
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

/// Adds the node at `s`, and before it those that a sharp bend on the way needs.
fn extend_to(
    curve: &impl Curve3,
    s: f64,
    place: &Local3,
    halvings: u32,
    nodes: &mut Vec<(f64, Frame)>,
) {
    let Some(&(from, last)) = nodes.last() else { return };
    if halvings > 0
        && nodes.len() < 2 * MOST_NODES
        && angle_between(last.tangent, place.tangent) > LARGEST_TURN
    {
        let middle = 0.5 * (from + s);
        extend_to(curve, middle, &curve.at(middle), halvings - 1, nodes);
        extend_to(curve, s, place, halvings - 1, nodes);
        return;
    }
    nodes.push((s, last.carried_to(place)));
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
            std::f64::consts::TAU * self.turns * self.speed()
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
        println!("helix of two turns, 8 knots of 64 steps: {worst:.2e}");
        assert!(worst < 1e-9, "{worst:e}");
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
