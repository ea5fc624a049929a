//! Reads the trajectory of a spec, and the frame at its start.

use super::Reader;
use super::joints::described;
use super::measured::PointLaws;
use crate::curve::{Curve3, Local3, Path};
use crate::error::SweepError;
use crate::frame::{Directed, Frame, Lack};
use crate::limits::SMALLEST;
use crate::spec::{self, Spec};
use crate::trajectory::{CORNER_DEG, Course, Trajectory};
use glam::DVec3;

/// A frame that a mitre reflects with an error above this angle, in radians, would tear the surface.
const MIRRORED: f64 = 1e-9;

/// Smallest turn of an arc in degrees. A smaller one is lost in the arithmetic of its length.
const LEAST_TURN: f64 = SMALLEST;

impl Reader<'_> {
    /// Returns the trajectory of a spec, and the laws that the numbers at its points give.
    pub(super) fn trajectory(&self, spec: &Spec) -> Result<(Trajectory, PointLaws), SweepError> {
        let (trajectory, frame) = (&spec.trajectory, spec.frame.as_ref());
        if let spec::Trajectory::Rotation(rotation) = trajectory {
            return Ok((self.rotation(rotation, frame)?, PointLaws::default()));
        }
        let start = match frame {
            Some(spec::Frame::Start(start)) => {
                self.point("frame.start", start)?;
                Some(start)
            }
            None
            | Some(
                spec::Frame::Up(_)
                | spec::Frame::Guide(_)
                | spec::Frame::Frenet(_)
                | spec::Frame::Away(_),
            ) => None,
        };
        let (course, marks) = self.course_with_marks("trajectory", trajectory, start)?;
        let laws = self.point_laws(spec, &course, &marks)?;
        let trajectory = match frame {
            None | Some(spec::Frame::Start(_)) => {
                let outward = match trajectory {
                    // A helix starts with w1 away from its axis.
                    spec::Trajectory::Helix(helix) if start.is_none() => {
                        let axis = DVec3::from_array(helix.axis).normalize_or_zero();
                        let spoke = course.at(0.0).position - DVec3::from_array(helix.center);
                        Some((spoke - axis * spoke.dot(axis)).to_array())
                    }
                    _ => start.copied(),
                };
                let first = self.first_frame(&course.at(0.0), outward.as_ref())?;
                Trajectory::minimizing(course, first)
            }
            Some(frame) => self.directed(course, frame)?,
        };
        Ok((trajectory, laws))
    }

    fn rotation(
        &self,
        rotation: &spec::Rotation,
        frame: Option<&spec::Frame>,
    ) -> Result<Trajectory, SweepError> {
        let path = "trajectory.rotation";
        let start = match frame {
            None => None,
            Some(spec::Frame::Start(start)) => {
                self.point("frame.start", start)?;
                Some(start)
            }
            Some(_) => {
                let message = "found a frame for a rotation, whose contour lies in the plane of its \
                               axis, expected none, or `start`";
                return Err(self.geometry("frame", message));
            }
        };
        self.point(&format!("{path}.origin"), &rotation.origin)?;
        let origin = DVec3::from_array(rotation.origin);
        let frame = self.upright(path, origin, rotation.axis, start)?;
        let fraction = self.fraction(path, rotation.angle_deg)?;
        Ok(Trajectory::rotation(frame, fraction))
    }

    /// Reads a curve in space: the guide of a frame.
    fn course(
        &self,
        path: &str,
        trajectory: &spec::Trajectory,
        start: Option<&[f64; 3]>,
    ) -> Result<Course, SweepError> {
        Ok(self.course_with_marks(path, trajectory, start)?.0)
    }

    /// Reads a curve in space, and for rounded corners pairs of arc lengths: before and after they were rounded.
    fn course_with_marks(
        &self,
        path: &str,
        trajectory: &spec::Trajectory,
        start: Option<&[f64; 3]>,
    ) -> Result<(Course, Vec<[f64; 2]>), SweepError> {
        let course = match trajectory {
            spec::Trajectory::Line(ends) => self.line(&format!("{path}.line"), ends, start),
            spec::Trajectory::Circle(circle) => {
                let path = format!("{path}.circle");
                self.positive(&format!("{path}.radius"), circle.radius)?;
                self.point(&format!("{path}.center"), &circle.center)?;
                let center = DVec3::from_array(circle.center);
                let start = self.upright(&path, center, circle.axis, start)?;
                let fraction = self.fraction(&path, circle.angle_deg)?;
                Ok(Course::Circle { start, radius: circle.radius, fraction })
            }
            spec::Trajectory::Helix(helix) => self.helix(&format!("{path}.helix"), helix, start),
            spec::Trajectory::Swc(_) => {
                let message =
                    "found neurites, which are no single curve, expected another trajectory";
                Err(self.geometry(path, message))
            }
            spec::Trajectory::Rotation(_) => {
                let message = "found a rotation, which is no curve, expected one of line, circle, \
                               helix, bezier, polyline, free, flat, formula";
                Err(self.geometry(path, message))
            }
            spec::Trajectory::Bezier(bezier) => self.bezier3(&format!("{path}.bezier"), bezier),
            spec::Trajectory::Polyline(line) => {
                return self.polyline3(&format!("{path}.polyline"), line);
            }
            spec::Trajectory::Free(free) => return self.free3(&format!("{path}.free"), free),
            spec::Trajectory::Flat(flat) => self.flat(&format!("{path}.flat"), flat),
            spec::Trajectory::Formula(curve) => self.formula(&format!("{path}.formula"), curve),
        };
        Ok((course?, Vec::new()))
    }

    fn line(
        &self,
        path: &str,
        ends: &[[f64; 3]; 2],
        start: Option<&[f64; 3]>,
    ) -> Result<Course, SweepError> {
        self.points(path, ends)?;
        let [from, end] = ends.map(DVec3::from_array);
        let Some(tangent) = (end - from).try_normalize() else {
            let message = "found ends that coincide, expected a line with a length above 0";
            return Err(self.geometry(path, message));
        };
        let start = self.first_frame(&Local3::straight(from, tangent), start)?;
        Ok(Course::Line { start, end })
    }

    /// Returns a trajectory whose frames are fixed by a direction.
    fn directed(&self, course: Course, frame: &spec::Frame) -> Result<Trajectory, SweepError> {
        let (path, directed, what) = match frame {
            spec::Frame::Up(up) => {
                self.point("frame.up", up)?;
                let Some(up) = DVec3::from_array(*up).try_normalize() else {
                    return Err(self
                        .fault("frame.up", "found a vector without length, expected a direction"));
                };
                ("frame.up", Directed::Up(up), "the direction lies along the trajectory")
            }
            spec::Frame::Guide(guide) => {
                let path = "frame.guide";
                let guide = self.course(path, guide, None)?;
                if !guide.corners().is_empty() {
                    let message = "found a guide with corners, expected one that bends smoothly; use \
                                   `round`";
                    return Err(self.geometry(path, message));
                }
                if course.closed() && !guide.closed() {
                    let message = "found an open guide, expected a closed one, since the trajectory \
                                   is closed";
                    return Err(self.geometry(path, message));
                }
                (path, Directed::Guide(Box::new(guide)), "the guide lies on the tangent")
            }
            spec::Frame::Away(away) => {
                self.point("frame.away.origin", &away.origin)?;
                self.point("frame.away.axis", &away.axis)?;
                let Some(axis) = DVec3::from_array(away.axis).try_normalize() else {
                    let message = "found a vector without length, expected an axis";
                    return Err(self.fault("frame.away.axis", message));
                };
                let directed = Directed::Away { origin: DVec3::from_array(away.origin), axis };
                ("frame.away", directed, "the trajectory leads to or from the axis, or meets it")
            }
            spec::Frame::Frenet(_) | spec::Frame::Start(_) => {
                ("frame.frenet", Directed::Frenet, "the trajectory does not bend")
            }
        };
        let mitred = course.corners().into_iter().map(|s| (s, directed.jump(&course, s)));
        let turned = mitred.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|worst| worst.1 > MIRRORED);
        let lack = directed.lack(&course);
        if turned.is_some() && !matches!(lack, Some(Lack::Along(_))) {
            let message = "found a mitre at which the frame turns, expected a frame without `up` \
                           or `guide`, or rounded corners";
            return Err(self.geometry(path, message));
        }
        match lack {
            None => Ok(Trajectory::directed(course, directed)),
            Some(Lack::Along(at)) => {
                let message = format!(
                    "found no frame at {at:.6} of the trajectory's length, where {what}, expected \
                     one everywhere"
                );
                Err(self.geometry(path, message))
            }
            Some(Lack::Jump(at, angle)) => {
                let message = format!(
                    "found a frame that jumps by {:.1} degrees at {at:.6} of the trajectory's \
                     length, expected one that turns smoothly",
                    angle.to_degrees()
                );
                Err(self.geometry(path, message))
            }
        }
    }

    /// Returns the frame at the start: the one that the spec requests, or the seed.
    fn first_frame(&self, local: &Local3, start: Option<&[f64; 3]>) -> Result<Frame, SweepError> {
        let Some(start) = start else {
            return Ok(Frame::seed(local));
        };
        Frame::toward(local, DVec3::from_array(*start)).ok_or_else(|| {
            let message =
                format!("found {start:?}, expected a direction across the trajectory's start");
            self.fault("frame.start", message)
        })
    }

    /// Returns the frame in which a rotation about an axis starts; contour y is along the axis.
    pub(super) fn upright(
        &self,
        path: &str,
        origin: DVec3,
        axis: [f64; 3],
        start: Option<&[f64; 3]>,
    ) -> Result<Frame, SweepError> {
        let axis_path = format!("{path}.axis");
        self.point(&axis_path, &axis)?;
        let Some(axis) = DVec3::from_array(axis).try_normalize() else {
            return Err(self.fault(&axis_path, "found a vector without length, expected an axis"));
        };
        // The frame of a line along the axis has the right w1. The rotation starts perpendicular to w1 and
        // the axis.
        let normal = self.first_frame(&Local3::straight(origin, axis), start)?.normal;
        Ok(Frame { origin, tangent: normal.cross(axis), normal, binormal: axis })
    }

    fn fraction(&self, path: &str, degrees: f64) -> Result<f64, SweepError> {
        if (LEAST_TURN..=360.0).contains(&degrees) {
            return Ok(degrees / 360.0);
        }
        let expected = if degrees > 0.0 && degrees < LEAST_TURN {
            format!("degrees from {LEAST_TURN:?} to 360")
        } else {
            "degrees above 0 and up to 360".into()
        };
        let message = format!("found {degrees:?}, expected {expected}");
        Err(self.fault(&format!("{path}.angle_deg"), message))
    }

    /// Refuses corners and cusps.
    pub(super) fn smooth(&self, curve: &Path<DVec3>, path: &str) -> Result<(), SweepError> {
        let Some(joint) = curve.joints().find(|joint| joint.angle.to_degrees() > CORNER_DEG) else {
            return Ok(());
        };
        let message =
            format!("found {}, expected a trajectory that bends smoothly", described(&joint));
        Err(self.geometry(path, message))
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;
    use files::Exit;

    fn trajectory_complaint(trajectory: &str) -> (String, Exit) {
        complaint("{\"circle\": {\"radius\": 1}}", trajectory)
    }

    #[test]
    fn each_kind_of_trajectory_has_its_complaints() {
        for (trajectory, message, exit) in [
            ("{\"line\": [[1,1,1],[1,1,1]]}", "3:24: trajectory.line: found ends that coincide", 4),
            ("{\"line\": [[1,1,1],[1,1e80,1]]}", "3:33: trajectory.line[1]: found 1e80", 3),
            ("{\"circle\": {\"radius\": 0}}", "3:37: trajectory.circle.radius: found 0.0", 3),
            (
                "{\"circle\": {\"radius\": 1, \"angle_deg\": 361}}",
                "3:53: trajectory.circle.angle_deg: found 361.0, expected degrees above 0 and up to 360",
                3,
            ),
            (
                "{\"circle\": {\"radius\": 1, \"angle_deg\": 5e-324}}",
                "3:53: trajectory.circle.angle_deg: found 5e-324, expected degrees from 1e-60 to 360",
                3,
            ),
            (
                "{\"helix\": {\"radius\": 1, \"rise\": 1, \"turns\": 0}}",
                "trajectory.helix.turns: found 0.0, expected turns other than 0",
                3,
            ),
            (
                "{\"helix\": {\"radius\": 0, \"rise\": 1, \"turns\": 1}}",
                "helix.radius: found 0.0",
                3,
            ),
            ("{\"helix\": {\"radius\": 1, \"turns\": 1}}", "helix", 3),
            (
                "{\"rotation\": {\"axis\": [0, 0, 0]}}",
                "3:37: trajectory.rotation.axis: found a vector without length",
                3,
            ),
            ("{\"rotation\": {\"angle_deg\": 0}}", "trajectory.rotation.angle_deg: found 0.0", 3),
            (
                "{\"free\": {\"closed\": true, \"points\": [[0,0,0],[1,0,0],[1,0,0],[0,0,0]]}}",
                "trajectory.free.points: found 2 that differ, expected at least 3 points",
                4,
            ),
            (
                "{\"bezier\": {\"segments\": [[[0,0,0],[1,0,0],[2,0,0],[3,0,0]],\n [[3,0,0],[3,1,0],[3,2,0],[3,3,0]]]}}",
                "a.json:4:2: trajectory.bezier.segments[1]: found a corner of 90.0 degrees where segment 0 meets segment 1, expected",
                4,
            ),
            (
                "{\"bezier\": {\"segments\": [[[0,0,0],[1,1,0],[0,1,0],[1,0,0]]]}}",
                "3:40: trajectory.bezier.segments[0]: found a cusp of 180.0 degrees inside segment 0",
                4,
            ),
            (
                "{\"bezier\": {\"closed\": true, \"segments\": [[[0,0,0],[1,1,0],[-1,1,0],[0,0,0]]]}}",
                "found a corner of 90.0 degrees where segment 0 meets segment 0",
                4,
            ),
        ] {
            let (found, code) = trajectory_complaint(trajectory);
            assert!(found.contains(message), "{trajectory}: {found}");
            let expected = if exit == 3 { Exit::Malformed } else { Exit::Geometry };
            assert_eq!(code, expected, "{trajectory}");
        }
    }

    #[test]
    fn a_start_along_the_trajectory_is_refused() {
        let (message, exit) = complaint("\"mesh\"", "\"frame\": {\"start\": [0, 2, 0]}, \"mesh\"");
        assert_eq!(
            message,
            "a.json:4:20: frame.start: found [0.0, 2.0, 0.0], expected a direction across the \
             trajectory's start"
        );
        assert_eq!(exit, Exit::Malformed);
    }
}
