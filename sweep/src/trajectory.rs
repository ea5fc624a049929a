//! The curve that a contour follows, and the stations on it.

use crate::curve::{Helix, Path, turn};
use crate::cut::Stop;
use crate::frame::{Frame, Frames};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A trajectory, checked: it has a length (or is a rotation) and no corners.
#[derive(Debug, Clone)]
pub struct Trajectory(Form);

#[derive(Debug, Clone)]
enum Form {
    Line { start: Frame, end: DVec3 },
    Turn { start: Frame, radius: f64, fraction: f64 },
    Helix(Helix),
    Path(Frames<Path<DVec3>>),
}

/// A contour's place on a trajectory: a frame, and how a point moves when the station does.
#[derive(Debug, Clone, Copy)]
pub struct Station {
    /// Where the contour's axes lie.
    pub frame: Frame,
    /// The speed along the tangent, by length of the trajectory, of the point at the origin...
    forward: f64,
    /// ... and by how much it changes over the contour: `forward + bend . q`.
    bend: DVec2,
    /// Turn of the frame about the tangent, in radians by length.
    spin: f64,
    /// Whether contour x = 0 is an axis that all stations share.
    on_axis: bool,
}

impl Trajectory {
    /// A straight line from the origin of a frame.
    pub(crate) fn line(start: Frame, end: DVec3) -> Self {
        Self(Form::Line { start, end })
    }

    /// A turn about the y direction of a frame through the frame's origin, which is the centre.
    ///
    /// The contour's x is measured from the circle of that radius; a radius of 0 is a rotational
    /// sweep. `fraction` of 1 is a full turn, which is closed.
    pub(crate) fn turn(start: Frame, radius: f64, fraction: f64) -> Self {
        Self(Form::Turn { start, radius, fraction })
    }

    /// A helix.
    pub(crate) fn helix(helix: Helix) -> Self {
        Self(Form::Helix(helix))
    }

    /// A path, with the frames along it.
    pub(crate) fn path(frames: Frames<Path<DVec3>>) -> Self {
        Self(Form::Path(frames))
    }

    /// Whether the contour is turned about an axis that its x is measured from.
    #[must_use]
    pub fn is_rotation(&self) -> bool {
        matches!(self.0, Form::Turn { radius: 0.0, .. })
    }

    /// Whether the trajectory leads back to its start.
    #[must_use]
    pub fn closed(&self) -> bool {
        match &self.0 {
            Form::Line { .. } | Form::Helix(_) => false,
            Form::Turn { fraction, .. } => *fraction == 1.0,
            Form::Path(frames) => frames.curve().closed(),
        }
    }

    /// The length of the trajectory; 0 for a rotational sweep.
    #[must_use]
    pub fn length(&self) -> f64 {
        match &self.0 {
            Form::Line { start, end } => (*end - start.origin).length(),
            Form::Turn { radius, fraction, .. } => TAU * fraction * radius,
            Form::Helix(helix) => helix.length(),
            Form::Path(frames) => frames.curve().length(),
        }
    }

    /// What laws are differentiated by: the length, or the angle of a rotation in radians.
    pub(crate) fn extent(&self) -> f64 {
        match &self.0 {
            Form::Turn { radius: 0.0, fraction, .. } => TAU * fraction,
            _ => self.length(),
        }
    }

    /// The fewest cells along the trajectory: three around.
    #[must_use]
    pub fn fewest_cells(&self) -> usize {
        if self.closed() { 3 } else { 1 }
    }

    /// Cells that see all that the trajectory does: eight to a segment or a quarter turn.
    pub(crate) fn detail(&self) -> f64 {
        match &self.0 {
            Form::Line { .. } => 1.0,
            Form::Turn { fraction, .. } => 32.0 * fraction,
            Form::Helix(helix) => 32.0 * helix.turns.abs(),
            Form::Path(frames) => 8.0 * frames.curve().cubics().count() as f64,
        }
    }

    /// Where the corners lie, as fractions of the length.
    #[must_use]
    pub fn breaks(&self) -> &[f64] {
        &[]
    }

    /// The station at a stop: at a corner that of its side.
    #[must_use]
    pub fn station_at(&self, stop: Stop) -> Station {
        self.station(stop.at)
    }

    /// The station at `v`, a fraction of the length.
    #[must_use]
    pub fn station(&self, v: f64) -> Station {
        let straight = Station::along;
        match &self.0 {
            Form::Line { start, end } => {
                straight(Frame { origin: start.origin.lerp(*end, v), ..*start })
            }
            Form::Turn { start, radius, fraction } => {
                let angle = turn(fraction * v);
                let normal = start.normal * angle.x + start.tangent * angle.y;
                let tangent = start.tangent * angle.x - start.normal * angle.y;
                let frame = Frame { normal, tangent, ..*start };
                if *radius == 0.0 {
                    return Station {
                        forward: 0.0,
                        bend: DVec2::X,
                        on_axis: true,
                        ..straight(frame)
                    };
                }
                let frame = Frame { origin: start.origin + normal * *radius, ..frame };
                Station { bend: DVec2::X / *radius, ..straight(frame) }
            }
            Form::Helix(helix) => {
                let (frame, curvature) = helix.at(v);
                Station { bend: -curvature, ..straight(frame) }
            }
            Form::Path(frames) => {
                let (frame, curvature) = frames.at(v * frames.curve().length());
                Station { bend: -curvature, spin: frames.spin(), ..straight(frame) }
            }
        }
    }
}

impl Station {
    fn along(frame: Frame) -> Self {
        Self { frame, forward: 1.0, bend: DVec2::ZERO, spin: 0.0, on_axis: false }
    }

    /// The point of the surface over a point `q` of the contour.
    #[must_use]
    pub fn point(&self, q: DVec2) -> DVec3 {
        let Frame { origin, normal, binormal, .. } = self.frame;
        if self.on_axis && q.x == 0.0 {
            // A pole is the same in every row to the last bit, which 0 * w1 need not be: it may
            // be -0.
            return origin + binormal * q.y;
        }
        origin + normal * q.x + binormal * q.y
    }

    /// The same place with the contour turned about the tangent by a fraction of a full turn, which
    /// changes at `rate` radians by length. Right-handed: from w1 toward w2.
    pub(crate) fn turned(self, fraction: f64, rate: f64) -> Self {
        let angle = turn(fraction);
        let Frame { normal, binormal, .. } = self.frame;
        let frame = Frame {
            normal: normal * angle.x + binormal * angle.y,
            binormal: binormal * angle.x - normal * angle.y,
            ..self.frame
        };
        // The same vector in space, on the new axes.
        let bend = DVec2::new(angle.x, -angle.y).rotate(self.bend);
        Self { frame, bend, spin: self.spin + rate, ..self }
    }

    /// How far the point over `q` moves along the tangent, by length of the trajectory at the
    /// origin (by radian, for a rotation). Not above 0 where the surface folds back on itself.
    #[must_use]
    pub fn stretch(&self, q: DVec2) -> f64 {
        self.forward + self.bend.dot(q)
    }

    /// The unit normal over a point `q` of the contour with the unit tangent `q_u`.
    ///
    /// It is `S_u x S_v` in closed form, with `S_u = q_u.x w1 + q_u.y w2` and
    /// `S_v = stretch T + spin (q.x w2 - q.y w1)`. A rotation has no spin, so its normal does not
    /// hold the radius, and a pole has one like any other point.
    #[must_use]
    pub fn normal(&self, q: DVec2, q_u: DVec2) -> DVec3 {
        let Frame { tangent, normal, binormal, .. } = self.frame;
        let outward = normal * q_u.y - binormal * q_u.x;
        let stretch = self.stretch(q);
        if self.spin == 0.0 {
            return if stretch < 0.0 { -outward } else { outward };
        }
        let across = outward * stretch + tangent * (self.spin * q.dot(q_u));
        across.try_normalize().unwrap_or(outward)
    }

    /// The same as [`Station::normal`] for a contour that changes on its way: `q_u` is along it, of
    /// any length, and `q_s` is how its point moves on it by length of the trajectory.
    #[must_use]
    pub(crate) fn normal_of_moving(&self, q: DVec2, q_u: DVec2, q_s: DVec2) -> DVec3 {
        let Frame { tangent, normal, binormal, .. } = self.frame;
        let outward = normal * q_u.y - binormal * q_u.x;
        let moving = q_s + q.perp() * self.spin;
        let across = outward * self.stretch(q) + tangent * q_u.perp_dot(moving);
        // A contour pressed flat has no direction where it turns back.
        across.try_normalize().or(outward.try_normalize()).unwrap_or(normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Curve3, Local3, spline};

    fn seed(tangent: DVec3) -> Frame {
        Frame::seed(&Local3 { position: DVec3::ZERO, tangent, curvature: DVec3::ZERO })
    }

    /// The frame of a turn about the y axis: from +x toward +z.
    fn upright() -> Frame {
        let place = Local3 { position: DVec3::ZERO, tangent: DVec3::Z, curvature: DVec3::ZERO };
        Frame::toward(&place, DVec3::X).unwrap()
    }

    #[test]
    fn a_rotation_runs_from_x_toward_z() {
        let rotation = Trajectory::turn(upright(), 0.0, 1.0);
        let point = |v| rotation.station(v).point(DVec2::new(2.0, 5.0));
        assert_eq!(point(0.0), DVec3::new(2.0, 5.0, 0.0));
        assert_eq!(point(0.25), DVec3::new(0.0, 5.0, 2.0));
        assert!(rotation.closed());
        assert!(!Trajectory::turn(upright(), 0.0, 0.5).closed());
    }

    #[test]
    fn frames_are_right_handed_and_poles_have_normals() {
        for trajectory in [
            Trajectory::line(seed(DVec3::Y), DVec3::Y * 3.0),
            Trajectory::turn(upright(), 2.0, 0.75),
            Trajectory::turn(upright(), 0.0, 1.0),
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
        let first = Frame::seed(&path.at(0.0));
        let trajectory = Trajectory::path(Frames::new(path, first));
        // An ellipse, whose points are not at a right angle to its tangents.
        let ellipse = |a: f64| DVec2::new(0.5 * a.cos(), 0.2 * a.sin());
        let (h, mut worst) = (4e-4, 0.0_f64);
        let surface = |a: f64, v: f64| trajectory.station(v).point(ellipse(a));
        // Differences of order 6.
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
