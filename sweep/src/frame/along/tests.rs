//! Tests of frames on curves whose frames are known.

use super::*;
use crate::curve::{Cubic, Path, spline};
use glam::DVec3;

/// A helix about the y axis with `pieces` pieces between knots.
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

    /// Returns the normal of a rotation-minimizing frame: Frenet's normal turned back by the
    /// torsion.
    fn truth(&self, s: f64) -> DVec3 {
        let place = self.at(s);
        let normal = place.curvature.normalize();
        let binormal = place.tangent.cross(normal);
        let torsion = self.torsion();
        let (sin, cos) = (-torsion * s).sin_cos();
        normal * cos + binormal * sin
    }

    fn torsion(&self) -> f64 {
        // With an upward climb the helix is right-handed about y: x leads to -z.
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

/// Returns the largest error of frames carried over `steps` even steps, in radians.
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
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.1, "order {order}");
    }
    assert!(errors[2] < 1e-8, "{errors:?}");
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
    assert!(worst < 2e-13, "{worst:e}");
}

/// Returns the trefoil `5 (sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t)` at `t`.
fn trefoil(t: f64) -> Local3 {
    let (s1, c1) = t.sin_cos();
    let (s2, c2) = (2.0 * t).sin_cos();
    let (s3, c3) = (3.0 * t).sin_cos();
    let velocity = DVec3::new(c1 + 4.0 * c2, -s1 + 4.0 * s2, -3.0 * c3);
    let position = DVec3::new(s1 + 2.0 * s2, c1 - 2.0 * c2, -s3) * 5.0;
    Local3::straight(position, velocity.normalize())
}

/// Returns the frames after each eighth of a trefoil, carried over `steps` even steps of the parameter.
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

/// Returns the largest error of frames carried over `steps` steps of even length, in radians.
fn trefoil_error(steps: usize) -> f64 {
    let curve = Trefoil::new();
    let t = |i: usize| curve.parameter(curve.length() * i as f64 / steps as f64);
    let mut frame = Frame::seed(&trefoil(0.0));
    let (mut truth, mut error) = (frame, 0.0_f64);
    for i in 1..=steps {
        frame = frame.carried_to(&trefoil(t(i)));
        for part in 1..=64 {
            // With 64 times as many steps an error of order 4 is 64^4 times smaller.
            let part = f64::from(part) / 64.0;
            truth = truth.carried_to(&trefoil(t(i - 1) + (t(i) - t(i - 1)) * part));
        }
        error = error.max(frame.angle_to(truth.normal).abs());
    }
    error
}

#[test]
fn frames_on_a_trefoil_have_order_four() {
    let errors = [256, 512, 1024].map(trefoil_error);
    assert!(errors[0] < 1e-8, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.2, "order {order}");
    }
}

/// The trefoil by arc length, which is measured by Simpson's rule.
struct Trefoil {
    /// Lengths up to each of the even steps of the parameter.
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

    /// Returns the parameter at a length, interpolated linearly between the known lengths.
    fn parameter(&self, s: f64) -> f64 {
        let cells = self.lengths.len() - 1;
        let cell = self.lengths.partition_point(|&from| from <= s).clamp(1, cells) - 1;
        let (from, to) = (self.lengths[cell], self.lengths[cell + 1]);
        let part = (s - from) / (to - from);
        TAU * (cell as f64 + part) / cells as f64
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

    /// Frames need exact points and tangents, but hardly an even speed.
    fn at(&self, s: f64) -> Local3 {
        trefoil(self.parameter(s))
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
