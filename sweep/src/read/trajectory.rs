//! The trajectory of a spec, and the frame it starts with.

use super::Reader;
use crate::curve::{Curve3, Helix, Local3, Path};
use crate::frame::{Frame, Frames};
use crate::spec::FrameStart;
use crate::trajectory::Trajectory;
use crate::{SweepError, spec};
use glam::DVec3;

/// A trajectory may turn at a joint by this many degrees, as handles rounded to a few decimals do.
const SMOOTH_DEG: f64 = 1.0;

/// Turns of a helix at most: digits enough are left for the place within one.
const MOST_TURNS: f64 = 1e6;

impl Reader<'_> {
    pub(super) fn trajectory(
        &self,
        trajectory: &spec::Trajectory,
        start: Option<&FrameStart>,
    ) -> Result<Trajectory, SweepError> {
        if let Some(start) = start {
            self.point("frame.start", &start.start)?;
        }
        match trajectory {
            spec::Trajectory::Line(ends) => self.line(ends, start),
            spec::Trajectory::Circle(circle) => {
                let path = "trajectory.circle";
                self.positive(&format!("{path}.radius"), circle.radius)?;
                self.point(&format!("{path}.center"), &circle.center)?;
                let center = DVec3::from_array(circle.center);
                let frame = self.upright(path, center, circle.axis, start)?;
                let fraction = self.fraction(path, circle.angle_deg)?;
                Ok(Trajectory::turn(frame, circle.radius, fraction))
            }
            spec::Trajectory::Helix(helix) => self.helix(helix, start),
            spec::Trajectory::Rotation(rotation) => {
                let path = "trajectory.rotation";
                self.point(&format!("{path}.origin"), &rotation.origin)?;
                let origin = DVec3::from_array(rotation.origin);
                let frame = self.upright(path, origin, rotation.axis, start)?;
                let fraction = self.fraction(path, rotation.angle_deg)?;
                Ok(Trajectory::turn(frame, 0.0, fraction))
            }
            spec::Trajectory::Bezier(bezier) => {
                let path = "trajectory.bezier";
                let curve = self.bezier(path, bezier)?;
                self.smooth(&curve, |segment| format!("{path}.segments[{segment}]"))?;
                self.framed(curve, start)
            }
            spec::Trajectory::Free(free) => {
                let path = "trajectory.free";
                let curve = self.free(path, free)?;
                self.smooth(&curve, |_| path.into())?;
                self.framed(curve, start)
            }
        }
    }

    fn line(
        &self,
        ends: &[[f64; 3]; 2],
        start: Option<&FrameStart>,
    ) -> Result<Trajectory, SweepError> {
        self.points("trajectory.line", ends)?;
        let [from, to] = ends.map(DVec3::from_array);
        let Some(tangent) = (to - from).try_normalize() else {
            return Err(self.geometry(
                "trajectory.line",
                "found ends that coincide, expected a line of some length",
            ));
        };
        let place = Local3 { position: from, tangent, curvature: DVec3::ZERO };
        Ok(Trajectory::line(self.first_frame(&place, start)?, to))
    }

    fn helix(
        &self,
        helix: &spec::Helix,
        start: Option<&FrameStart>,
    ) -> Result<Trajectory, SweepError> {
        let path = "trajectory.helix";
        self.positive(&format!("{path}.radius"), helix.radius)?;
        self.number(&format!("{path}.rise"), helix.rise)?;
        if helix.turns == 0.0 || helix.turns.abs() > MOST_TURNS {
            let message = format!(
                "found {:?}, expected turns other than 0 and at most {MOST_TURNS:?}",
                helix.turns
            );
            return Err(self.fault(&format!("{path}.turns"), message));
        }
        self.point(&format!("{path}.center"), &helix.center)?;
        let center = DVec3::from_array(helix.center);
        let start = self.upright(path, center, helix.axis, start)?;
        let spec::Helix { radius, rise, turns, .. } = *helix;
        Ok(Trajectory::helix(Helix { start, radius, rise, turns }))
    }

    /// A trajectory of cubics, with its frames.
    fn framed(
        &self,
        curve: Path<DVec3>,
        start: Option<&FrameStart>,
    ) -> Result<Trajectory, SweepError> {
        let first = self.first_frame(&curve.at(0.0), start)?;
        Ok(Trajectory::path(Frames::new(curve, first)))
    }

    /// The frame at the start: as the spec wants it, or the seed.
    fn first_frame(&self, place: &Local3, start: Option<&FrameStart>) -> Result<Frame, SweepError> {
        let Some(FrameStart { start }) = start else {
            return Ok(Frame::seed(place));
        };
        Frame::toward(place, DVec3::from_array(*start)).ok_or_else(|| {
            let message =
                format!("found {start:?}, expected a direction across the trajectory's start");
            self.fault("frame.start", message)
        })
    }

    /// The frame in which a turn about an axis starts: contour y is the axis.
    fn upright(
        &self,
        path: &str,
        origin: DVec3,
        axis: [f64; 3],
        start: Option<&FrameStart>,
    ) -> Result<Frame, SweepError> {
        let axis_path = format!("{path}.axis");
        self.point(&axis_path, &axis)?;
        let Some(axis) = DVec3::from_array(axis).try_normalize() else {
            return Err(self.fault(&axis_path, "found no direction, expected an axis"));
        };
        // The frame of a line along the axis has the right w1; the turn begins across both.
        let along = Local3 { position: origin, tangent: axis, curvature: DVec3::ZERO };
        let normal = self.first_frame(&along, start)?.normal;
        Ok(Frame { origin, tangent: normal.cross(axis), normal, binormal: axis })
    }

    fn fraction(&self, path: &str, degrees: f64) -> Result<f64, SweepError> {
        if degrees > 0.0 && degrees <= 360.0 {
            return Ok(degrees / 360.0);
        }
        let message = format!("found {degrees:?}, expected degrees above 0 and up to 360");
        Err(self.fault(&format!("{path}.angle_deg"), message))
    }

    /// Refuses corners and cusps.
    fn smooth(
        &self,
        curve: &Path<DVec3>,
        place: impl Fn(usize) -> String,
    ) -> Result<(), SweepError> {
        let Some(joint) = curve.joints().find(|joint| joint.angle.to_degrees() > SMOOTH_DEG) else {
            return Ok(());
        };
        let [before, after] = joint.sources;
        let degrees = joint.angle.to_degrees();
        let found = if before == after && joint.s > 0.0 {
            format!("a cusp of {degrees:.1} degrees inside segment {after}")
        } else {
            format!("a corner of {degrees:.1} degrees where segment {before} meets segment {after}")
        };
        Err(self.geometry(
            &place(after),
            format!("found {found}, expected a trajectory that bends smoothly"),
        ))
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
                "3:37: trajectory.rotation.axis: found no direction",
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
