//! Reads a plane curve with a height as a trajectory.

use super::Reader;
use crate::curve::{Curve3, Path};
use crate::error::SweepError;
use crate::spec;
use crate::trajectory::CORNER_DEG;
use crate::trajectory::Course;
use crate::trajectory::Flat;
use glam::DVec2;

/// Heights at the ends of a closed curve that differ by at most this fraction of its size are equal.
const SAME: f64 = 1e-9;

impl Reader<'_> {
    pub(super) fn flat(&self, path: &str, flat: &spec::Flat) -> Result<Course, SweepError> {
        let curve = format!("{path}.curve");
        let plane: Path<DVec2> = match &flat.curve {
            spec::Contour::Bezier(bezier) => self.bezier(&format!("{curve}.bezier"), bezier)?,
            spec::Contour::Free(free) => self.near(&format!("{curve}.free"), free)?.0,
            spec::Contour::Svg(text) => self.outline(&format!("{curve}.svg"), text)?,
            spec::Contour::Polyline(line) => self.polyline(&format!("{curve}.polyline"), line)?,
            spec::Contour::Circle(_)
            | spec::Contour::Sections(_)
            | spec::Contour::Loops(_)
            | spec::Contour::SvgFile(_)
            | spec::Contour::Moved(_) => {
                let message = "found no path, expected one of bezier, svg, free, polyline; an arc of \
                               an SVG path draws a circle";
                return Err(self.fault(&curve, message));
            }
        };
        let z = format!("{path}.z");
        let law = self.law(&z, &flat.z)?;
        let [start, end] = law.ends();
        let (low, high) = law.range();
        if plane.closed() && (end - start).abs() > SAME * (high - low).max(plane.length()) {
            let message = format!(
                "found {start:?} at the start and {end:?} at the end, expected the same at both, \
                 since the curve is closed"
            );
            return Err(self.geometry(&z, message));
        }
        let Some(flat) = Flat::new(plane, &law.graph()) else {
            return Err(
                self.geometry(path, "found no length, expected a curve with a length above 0")
            );
        };
        let corner = flat.joints().find(|(_, angle)| angle.to_degrees() > CORNER_DEG);
        let Some((s, angle)) = corner else {
            return Ok(Course::Flat(flat));
        };
        let message = format!(
            "found a corner of {:.1} degrees at {:.6} of the length, expected a curve and a law \
             that bend smoothly",
            angle.to_degrees(),
            s / flat.length()
        );
        Err(self.geometry(path, message))
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;
    use files::Exit;

    #[test]
    fn a_flat_trajectory_has_its_complaints() {
        for (keys, message, exit) in [
            ("\"curve\": {\"circle\": 1}, \"z\": 0", "trajectory.flat.curve: found no path", 3),
            ("\"curve\": {\"svg\": \"M0 0\"}, \"z\": 0", "trajectory.flat.curve.svg: found", 4),
            ("\"curve\": {\"svg\": \"M0 0H1\"}", "flat", 3),
            (
                "\"curve\": {\"svg\": \"M0 0A1 1 0 0 0 2 0A1 1 0 0 0 0 0Z\"}, \"z\": {\"total\": 1}",
                "trajectory.flat.z: found 0.0 at the start and 1.0 at the end, expected the same",
                4,
            ),
            (
                "\"curve\": {\"svg\": \"M0 0H4\"}, \"z\": {\"keys\": [[0, 0], [0.5, 2], [1, 0]]}",
                "trajectory.flat: found a corner of 90.0 degrees at 0.500000 of the length",
                4,
            ),
            (
                "\"curve\": {\"svg\": \"M0 0H1V1\"}, \"z\": 3",
                "trajectory.flat: found a corner of 90.0 degrees at 0.500000 of the length",
                4,
            ),
        ] {
            let (found, code) =
                complaint("{\"circle\": {\"radius\": 1}}", &format!("{{\"flat\": {{{keys}}}}}"));
            assert!(found.contains(message), "{keys}: {found}");
            let expected = if exit == 3 { Exit::Malformed } else { Exit::Geometry };
            assert_eq!(code, expected, "{keys}");
        }
    }
}
