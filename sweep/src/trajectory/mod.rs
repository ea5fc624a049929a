//! The trajectory that a contour follows, and the stations on it.

mod course;
pub mod flat;
pub mod helix;
mod mitre;
mod station;

pub use course::{CORNER_DEG, Course};
pub use flat::Flat;
pub use helix::Helix;
pub use station::Station;

use crate::curve::cut::{self, Side, Stop};
use crate::curve::{Curve3, turn};
use crate::frame::{Directed, Frame, Frames};
use glam::DVec2;
use mitre::Mitres;
use std::f64::consts::TAU;

/// A checked trajectory: it has a length (or is a rotation), and a frame everywhere.
#[derive(Debug, Clone)]
pub struct Trajectory(Form);

#[derive(Debug, Clone)]
enum Form {
    Rotation { start: Frame, fraction: f64 },
    Along { course: Course, framing: Framing, mitres: Mitres },
}

/// How the frames along a curve are computed.
#[derive(Debug, Clone)]
enum Framing {
    /// Rotation-minimizing frames in closed form.
    Own,
    /// Rotation-minimizing frames carried from node to node.
    Carried(Frames),
    /// Frames fixed by a direction.
    Directed(Directed<Course>),
}

impl Trajectory {
    /// Returns a rotation about the line through a frame's origin in the direction of its `w2`. Contour x is
    /// the distance from that axis. A `fraction` of 1 is a full turn, which is closed.
    pub(crate) fn rotation(start: Frame, fraction: f64) -> Self {
        Self(Form::Rotation { start, fraction })
    }

    /// Returns a curve with rotation-minimizing frames that start with `first`.
    ///
    /// A line, a circle and a helix carry a first frame of their own and ignore `first`.
    pub(crate) fn minimizing(course: Course, first: Frame) -> Self {
        let framing = if course.own_frame(0.0).is_some() {
            Framing::Own
        } else {
            Framing::Carried(Frames::new(&course, first))
        };
        Self::along(course, framing)
    }

    /// Returns a curve with frames fixed by a direction, which must give a frame everywhere.
    pub(crate) fn directed(course: Course, directed: Directed<Course>) -> Self {
        Self::along(course, Framing::Directed(directed))
    }

    /// Returns a curve with its frames; its corners are mitred.
    fn along(course: Course, framing: Framing) -> Self {
        let corners = course.corners();
        let mitres = if corners.is_empty() {
            Mitres::default()
        } else {
            let frame = |s, side| placed(&course, &framing, s, side).0.frame;
            Mitres::new(&corners, &course.knots(), frame)
        };
        Self(Form::Along { course, framing, mitres })
    }

    /// Returns whether this is a rotation: the contour turns about an axis from which its x is measured.
    #[must_use]
    pub fn is_rotation(&self) -> bool {
        matches!(self.0, Form::Rotation { .. })
    }

    /// Returns whether the trajectory leads back to its start.
    #[must_use]
    pub fn closed(&self) -> bool {
        match &self.0 {
            Form::Rotation { fraction, .. } => *fraction == 1.0,
            Form::Along { course, .. } => course.closed(),
        }
    }

    /// Returns the length of the trajectory; 0 for a rotation.
    #[must_use]
    pub fn length(&self) -> f64 {
        match &self.0 {
            Form::Rotation { .. } => 0.0,
            Form::Along { course, .. } => course.length(),
        }
    }

    /// Returns the length, or for a rotation its angle in radians. A derivative by `v` divided by this number
    /// is the derivative by length or angle.
    pub(crate) fn extent(&self) -> f64 {
        match &self.0 {
            Form::Rotation { fraction, .. } => TAU * fraction,
            Form::Along { course, .. } => course.length(),
        }
    }

    /// Returns the extra turn of the frame along a closed trajectory that brings it back to itself, as a
    /// fraction of a full turn.
    pub(crate) fn closing_turn(&self) -> f64 {
        match &self.0 {
            Form::Along { course, framing: Framing::Carried(frames), .. } => {
                frames.spin() * course.length() / TAU
            }
            Form::Rotation { .. }
            | Form::Along { framing: Framing::Own | Framing::Directed(_), .. } => 0.0,
        }
    }

    /// Returns the fewest cells along the trajectory: one for each piece between corners, and at least three
    /// if it is closed.
    #[must_use]
    pub fn fewest_cells(&self) -> usize {
        let around = if self.closed() { 3 } else { 1 };
        cut::pieces(self.breaks()).max(around)
    }

    /// Returns the curve's own parameter, from 0 to 1, at the fraction `v` of its length.
    pub(crate) fn parameter(&self, v: f64) -> f64 {
        match &self.0 {
            Form::Rotation { .. } => v,
            Form::Along { course, .. } => course.parameter(v),
        }
    }

    /// Returns the number of cells that resolves the trajectory: eight for each segment or quarter turn.
    pub(crate) fn detail(&self) -> f64 {
        match &self.0 {
            Form::Rotation { fraction, .. } => 32.0 * fraction,
            Form::Along { course, .. } => course.detail(),
        }
    }

    /// Returns the positions of the corners as fractions of the length, rising.
    #[must_use]
    pub fn breaks(&self) -> &[f64] {
        match &self.0 {
            Form::Rotation { .. } => &[],
            Form::Along { mitres, .. } => mitres.breaks(),
        }
    }

    /// Returns the station at `v`, a fraction of the length in `[0, 1]`; at a corner, of the side after.
    #[must_use]
    pub fn station(&self, v: f64) -> Station {
        self.station_at(Stop::after(v))
    }

    /// Returns the station at a stop; at a corner, of the stop's side.
    #[must_use]
    pub fn station_at(&self, stop: Stop) -> Station {
        match &self.0 {
            Form::Rotation { start, fraction } => {
                let angle = turn(fraction * stop.at);
                let frame = Frame {
                    normal: start.normal * angle.x + start.tangent * angle.y,
                    tangent: start.tangent * angle.x - start.normal * angle.y,
                    ..*start
                };
                Station { forward: 0.0, bend: DVec2::X, on_axis: true, ..Station::along(frame) }
            }
            Form::Along { course, framing, mitres } => station(course, framing, mitres, stop),
        }
    }
}

fn station(course: &Course, framing: &Framing, mitres: &Mitres, stop: Stop) -> Station {
    if let (Framing::Own, Some((frame, curvature))) = (framing, course.own_frame(stop.at)) {
        return Station { bend: -curvature, ..Station::along(frame) };
    }
    let corner = mitres.arc_length(stop);
    let s = corner.unwrap_or(stop.at * course.length());
    let (upright, spin) = placed(course, framing, s, stop.side);
    let (shear, shear_s) = mitres.at(s, stop.side);
    let bend = upright.bend + shear_s + shear.perp() * spin;
    Station { bend, shear, ..upright }
}

/// Returns the station at arc length `s`, without mitres, and its spin in radians per length.
fn placed(course: &Course, framing: &Framing, s: f64, side: Side) -> (Station, f64) {
    let local = match side {
        Side::Before => course.before(s),
        Side::After => course.at(s),
    };
    let (frame, spin) = match framing {
        Framing::Carried(frames) => (frames.at(s, &local, side), frames.spin()),
        Framing::Directed(directed) => directed
            .at(s, course.length(), &local, side)
            // The reader has searched for points without a frame. At a point it missed, any frame will do.
            .unwrap_or_else(|| (Frame::seed(&local), 0.0)),
        Framing::Own => (Frame::seed(&local), 0.0),
    };
    let curvature =
        DVec2::new(local.curvature.dot(frame.normal), local.curvature.dot(frame.binormal));
    (Station { bend: -curvature, spin, ..Station::along(frame) }, spin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Curve3, Local3, Path, spline};
    use glam::DVec3;

    fn seed(tangent: DVec3) -> Frame {
        Frame::seed(&Local3::straight(DVec3::ZERO, tangent))
    }

    fn minimizing(course: Course) -> Trajectory {
        let first = Frame::seed(&course.at(0.0));
        Trajectory::minimizing(course, first)
    }

    /// Returns the frame of a turn about the y axis, from +x toward +z.
    fn upright() -> Frame {
        let local = Local3::straight(DVec3::ZERO, DVec3::Z);
        Frame::toward(&local, DVec3::X).unwrap()
    }

    #[test]
    fn a_rotation_runs_from_x_toward_z() {
        let rotation = Trajectory::rotation(upright(), 1.0);
        let point = |v| rotation.station(v).point(DVec2::new(2.0, 5.0));
        assert_eq!(point(0.0), DVec3::new(2.0, 5.0, 0.0));
        assert_eq!(point(0.25), DVec3::new(0.0, 5.0, 2.0));
        assert!(rotation.closed());
        assert!(!Trajectory::rotation(upright(), 0.5).closed());
    }

    #[test]
    fn frames_are_right_handed_and_poles_have_normals() {
        for trajectory in [
            minimizing(Course::Line { start: seed(DVec3::Y), end: DVec3::Y * 3.0 }),
            minimizing(Course::Circle { start: upright(), radius: 2.0, fraction: 0.75 }),
            Trajectory::rotation(upright(), 1.0),
        ] {
            for i in 0..=7 {
                let station = trajectory.station(f64::from(i) / 7.0);
                let Frame { tangent, normal, binormal, .. } = station.frame;
                assert!((normal.cross(binormal) - tangent).length() < 1e-15);
                let pole = station.normal(DVec2::ZERO, DVec2::X);
                assert!((pole + binormal).length() < 1e-15);
            }
        }
    }

    #[test]
    fn normals_agree_with_differences_also_where_the_frame_is_spun() {
        let points = [[2.0, 0.0, 0.0], [0.0, 1.0, 2.0], [-2.0, 0.0, -0.5], [0.0, -1.0, -2.0]];
        let path = spline::through(&points.map(DVec3::from_array), true);
        let path = Path::new(&path, true).unwrap();
        let trajectory = minimizing(Course::Path(path));
        // An ellipse, because its points are not perpendicular to its tangents.
        let ellipse = |a: f64| DVec2::new(0.5 * a.cos(), 0.2 * a.sin());
        let (h, mut worst) = (4e-4, 0.0_f64);
        let surface = |a: f64, v: f64| trajectory.station(v).point(ellipse(a));
        // Finite differences of order 6.
        let slope = |f: &dyn Fn(f64) -> DVec3| {
            (f(h) - f(-h)) * 0.75 - (f(2.0 * h) - f(-2.0 * h)) * 0.15
                + (f(3.0 * h) - f(-3.0 * h)) / 60.0
        };
        for i in 0..400 {
            let (a, v) = (f64::from(i) * 0.37, 0.01 + 0.98 * (f64::from(i) * 0.618).fract());
            // Third derivatives of a spline jump at its points.
            if (v * 4.0 - (v * 4.0).round()).abs() < 0.05 {
                continue;
            }
            let along_u = slope(&|d| surface(a + d, v));
            let along_v = slope(&|d| surface(a, v + d));
            let q_u = DVec2::new(-0.5 * a.sin(), 0.2 * a.cos()).normalize();
            let error =
                along_u.cross(along_v).normalize() - trajectory.station(v).normal(ellipse(a), q_u);
            worst = worst.max(error.length());
        }
        println!("normals against differences: {worst:.1e}");
        assert!(worst < 1e-9, "{worst:e}");
    }
}
