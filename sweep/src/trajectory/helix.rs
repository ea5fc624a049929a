//! A helix and its rotation-minimizing frames, in closed form.
//!
//! The tangent of a helix keeps an angle to the axis, with the cosine `h` and the sine `c`. So curvature and
//! torsion are constant, and a rotation-minimizing frame turns evenly against a frame whose `w1` points away
//! from the axis. Nothing is summed, so a point far from the start costs no more than one near it.

use crate::curve::{Local3, turn};
use crate::frame::Frame;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A helix about the line through a frame's origin in the direction of the frame's `w2`.
#[derive(Debug, Clone, Copy)]
pub struct Helix {
    /// The frame at the centre of the helix's base circle. The helix starts at the side of `w1`.
    pub(crate) start: Frame,
    /// Distance from the axis; above 0.
    pub(crate) radius: f64,
    /// Rise along the axis in one turn.
    pub(crate) rise: f64,
    /// Number of turns, positive from `w1` toward `T`.
    pub(crate) turns: f64,
}

impl Helix {
    /// Returns the length of one turn.
    fn turn_length(&self) -> f64 {
        (TAU * self.radius).hypot(self.rise)
    }

    /// Returns the length of the whole helix.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.turns.abs() * self.turn_length()
    }

    /// Returns the point and derivatives at `v`, a fraction of the length in `[0, 1]`.
    #[must_use]
    pub fn local(&self, v: f64) -> Local3 {
        let (outward, around) = self.spoke(v);
        let (c, h) = self.slope();
        // Rotation about the axis, in radians per length.
        let rate = (c / self.radius).copysign(self.turns);
        Local3 {
            position: self.start.origin
                + outward * self.radius
                + self.start.binormal * (self.turns.abs() * v * self.rise),
            tangent: around * c.copysign(self.turns) + self.start.binormal * h,
            curvature: -outward * (c * c / self.radius),
            third: -around * (c * c / self.radius * rate),
        }
    }

    /// Returns the frame at `v`, a fraction of the length, and the curvature there on its `(w1, w2)`.
    ///
    /// At the start, `w1` points away from the axis.
    #[must_use]
    pub fn at(&self, v: f64) -> (Frame, DVec2) {
        let (outward, _) = self.spoke(v);
        let (c, h) = self.slope();
        let Local3 { position, tangent, .. } = self.local(v);
        let sideways = tangent.cross(outward);
        // If w1 pointed away from the axis everywhere, it would turn toward w2 by -c h / r radians per
        // length.
        let back = turn(self.turns * v * h);
        let frame = Frame {
            origin: position,
            tangent,
            normal: outward * back.x + sideways * back.y,
            binormal: sideways * back.x - outward * back.y,
        };
        (frame, DVec2::new(-back.x, back.y) * (c * c / self.radius))
    }

    /// Returns the unit vector away from the axis, and that vector a quarter turn further.
    fn spoke(&self, v: f64) -> (DVec3, DVec3) {
        let Frame { normal, tangent, .. } = self.start;
        let angle = turn(self.turns * v);
        (normal * angle.x + tangent * angle.y, tangent * angle.x - normal * angle.y)
    }

    /// Returns the sine and the cosine of the tangent's angle to the axis.
    fn slope(&self) -> (f64, f64) {
        (TAU * self.radius / self.turn_length(), self.rise / self.turn_length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Curve3;
    use crate::curve::cut::Side;
    use crate::frame::Frames;

    fn helix(rise: f64, turns: f64) -> Helix {
        let start =
            Frame { origin: DVec3::ONE, normal: DVec3::X, binormal: DVec3::Y, tangent: DVec3::Z };
        Helix { start, radius: 2.0, rise, turns }
    }

    /// The helix without its closed-form frames, so that double reflection finds them.
    struct Bare(Helix);

    impl Curve3 for Bare {
        fn length(&self) -> f64 {
            self.0.length()
        }

        fn closed(&self) -> bool {
            false
        }

        fn knots(&self) -> Vec<f64> {
            (0..=40).map(|i| self.length() * f64::from(i) / 40.0).collect()
        }

        fn at(&self, s: f64) -> Local3 {
            self.0.local(s / self.length())
        }
    }

    #[test]
    fn frames_are_those_of_double_reflection() {
        for (rise, turns) in [(1.0, 3.0), (-9.0, 2.3), (4.0, -2.0), (0.0, 0.7)] {
            let helix = helix(rise, turns);
            let frames = Frames::new(&Bare(helix), helix.at(0.0).0);
            for i in 0..=50 {
                let v = f64::from(i) / 50.0;
                let (frame, curvature) = helix.at(v);
                let local = helix.local(v);
                let other = frames.at(v * helix.length(), &local, Side::After);
                assert!((frame.normal - other.normal).length() < 1e-9, "{rise} {turns} {v}");
                let in_space = frame.normal * curvature.x + frame.binormal * curvature.y;
                assert!((local.curvature - in_space).length() < 1e-14);
                assert!((frame.normal.cross(frame.binormal) - frame.tangent).length() < 1e-14);
            }
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        for turns in [3.0, -3.0] {
            let (helix, h) = (helix(1.5, turns), 1e-5);
            for i in 1..20 {
                let v = f64::from(i) / 20.0;
                let ((after, _), (before, _)) = (helix.at(v + h), helix.at(v - h));
                let step = 2.0 * h * helix.length();
                let (frame, k) = helix.at(v);
                assert!(((after.origin - before.origin) / step - frame.tangent).length() < 1e-8);
                let curvature = frame.normal * k.x + frame.binormal * k.y;
                assert!(((after.tangent - before.tangent) / step - curvature).length() < 1e-8);
                let bending = helix.local(v + h).curvature - helix.local(v - h).curvature;
                assert!((bending / step - helix.local(v).third).length() < 1e-8);
            }
        }
    }

    #[test]
    fn each_turn_rises_alike_whichever_way_it_goes() {
        for (turns, quarter) in [(1.0, DVec3::Z), (-1.0, DVec3::NEG_Z)] {
            let helix = helix(8.0, turns);
            let at = |v: f64| helix.at(v).0.origin - DVec3::ONE;
            assert_eq!(at(0.25), quarter * 2.0 + DVec3::Y * 2.0);
            assert_eq!(at(1.0), DVec3::new(2.0, 8.0, 0.0));
            assert_eq!(helix.length(), (TAU * 2.0).hypot(8.0));
        }
    }
}
