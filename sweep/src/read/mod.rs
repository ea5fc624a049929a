//! From a spec to a [`Sweep`]: every value is looked at before any work is done.

mod contour;
mod depth;
mod law;
mod mesh;
mod modulation;
mod trajectory;

use crate::curve::vector::extent;
use crate::curve::{Cubic, Path, Vector, spline};
use crate::spec::{Bezier, FORMAT, Free, Mesh, Spec, VERSION};
use crate::sweep::ON_AXIS;
use crate::{Sweep, SweepError};
use files::json::Document;
use glam::DVec3;
use std::ops::RangeInclusive;

/// Coordinates beyond this have squares of squares that a double cannot hold.
const LARGEST: f64 = 1e60;

/// Curves smaller than this have squares of squares that vanish.
const SMALLEST: f64 = 1e-60;

/// Repeats of a picture, whose coordinates become f32 in a mesh.
const REPEATS: RangeInclusive<f64> = 1e-30..=1e30;

/// Segments meet when their ends are this fraction of the curve apart.
///
/// Wider than rounding by far, so that six decimals copied from an editor do, and far narrower than
/// what is seen.
const MEETS: f64 = 1e-6;

/// Free points closer than this fraction of the curve are one point given twice.
const COINCIDENT: f64 = 1e-12;

/// Reads and checks a spec, with the keys of `rather` in place of those of its `mesh`.
pub fn read(document: &Document, rather: &Mesh) -> Result<Sweep, SweepError> {
    document.expect(FORMAT, VERSION.into())?;
    let spec: Spec = document.parse()?;
    let reader = Reader { document };
    reader.header(&spec)?;
    let mut contour = reader.contour(&spec.contour)?;
    let trajectory = reader.trajectory(&spec.trajectory, spec.frame.as_ref())?;
    if trajectory.is_rotation() {
        let (low, high) = contour.x_range();
        if low < -ON_AXIS * high.max(-low) {
            return Err(reader.geometry(
                "contour",
                format!(
                    "found a contour that reaches x = {low:?}, expected x of at least 0, \
                     the distance from the axis of the rotation"
                ),
            ));
        }
        if high <= 0.0 {
            return Err(reader.geometry(
                "contour",
                "found a contour on the axis of the rotation, expected some x above 0",
            ));
        }
        contour = contour.rotated(ON_AXIS * high);
    }
    let modulation = reader.modulation(&spec, &contour, &trajectory)?;
    let sweep = Sweep {
        name: spec.name,
        contour,
        modulation,
        trajectory,
        resolution: reader.resolution(&spec.mesh, rather)?,
        fitted: None,
        uv: spec.uv,
        position: DVec3::from_array(spec.position),
    };
    match sweep.resolution_fault() {
        Some(fault) => Err(reader.of_mesh(rather, fault)),
        None => Ok(sweep.fitted()),
    }
}

/// The checks, with the document that their complaints are placed in.
struct Reader<'a> {
    document: &'a Document<'a>,
}

impl Reader<'_> {
    fn fault(&self, path: &str, message: impl Into<String>) -> SweepError {
        SweepError::Malformed(self.document.fault(path, message))
    }

    fn geometry(&self, path: &str, message: impl Into<String>) -> SweepError {
        SweepError::Geometry(self.document.fault(path, message))
    }

    /// All that is no curve.
    fn header(&self, spec: &Spec) -> Result<(), SweepError> {
        let blank = |c: char| c.is_whitespace() || c.is_control();
        if spec.name.is_empty() || spec.name.contains(blank) {
            let message = format!("found {:?}, expected one word", spec.name);
            return Err(self.fault("name", message));
        }
        for (i, &repeat) in spec.uv.repeat.iter().enumerate() {
            let path = format!("uv.repeat[{i}]");
            self.positive(&path, repeat)?;
            if !REPEATS.contains(&repeat) {
                let [least, most] = [REPEATS.start(), REPEATS.end()];
                let message =
                    format!("found {repeat:?}, expected a number from {least:?} to {most:?}");
                return Err(self.fault(&path, message));
            }
        }
        self.point("position", &spec.position)
    }

    /// A number above 0 of a size that can be reckoned with.
    fn positive(&self, path: &str, number: f64) -> Result<(), SweepError> {
        if number > 0.0 && (SMALLEST..=LARGEST).contains(&number) {
            return Ok(());
        }
        let expected = if number > 0.0 {
            format!("a number from {SMALLEST:?} to {LARGEST:?}")
        } else {
            "a number above 0".into()
        };
        Err(self.fault(path, format!("found {number:?}, expected {expected}")))
    }

    fn point(&self, path: &str, point: &[f64]) -> Result<(), SweepError> {
        match point.iter().find(|number| number.abs() > LARGEST) {
            Some(number) => Err(self.fault(
                path,
                format!("found {number:?}, expected coordinates of at most {LARGEST:?}"),
            )),
            None => Ok(()),
        }
    }

    fn points<P: AsRef<[f64]>>(&self, path: &str, points: &[P]) -> Result<(), SweepError> {
        points
            .iter()
            .enumerate()
            .try_for_each(|(i, point)| self.point(&format!("{path}[{i}]"), point.as_ref()))
    }

    /// Segments that meet end to end; the small gaps between them are closed.
    fn bezier<P, V>(&self, path: &str, bezier: &Bezier<P>) -> Result<Path<V>, SweepError>
    where
        P: AsRef<[f64]> + Copy,
        V: Vector + From<P>,
    {
        let segments_path = format!("{path}.segments");
        if bezier.segments.is_empty() {
            return Err(self.fault(&segments_path, "found no segments, expected at least one"));
        }
        for (i, segment) in bezier.segments.iter().enumerate() {
            self.points(&format!("{segments_path}[{i}]"), segment)?;
        }
        let mut cubics: Vec<Cubic<V>> =
            bezier.segments.iter().map(|segment| Cubic(segment.map(V::from))).collect();
        let widest = MEETS * extent(cubics.iter().flat_map(|cubic| cubic.0));
        let count = cubics.len();
        for i in 0..if bezier.closed { count } else { count - 1 } {
            let next = (i + 1) % count;
            let (end, start) = (cubics[i].0[3], cubics[next].0[0]);
            if (end - start).length() > widest {
                let (end, start) = (bezier.segments[i][3], bezier.segments[next][0]);
                let (end, start) = (end.as_ref(), start.as_ref());
                return Err(if next == 0 {
                    self.fault(
                        &format!("{segments_path}[{i}][3]"),
                        format!("found {end:?}, expected {start:?}, where a closed curve starts"),
                    )
                } else {
                    self.fault(
                        &format!("{segments_path}[{next}][0]"),
                        format!("found {start:?}, expected {end:?}, where the segment before ends"),
                    )
                });
            }
            cubics[i].0[3] = start;
        }
        self.path(path, &cubics, bezier.closed)
    }

    /// The spline through free points; points given twice count once.
    fn free<P, V>(&self, path: &str, free: &Free<P>) -> Result<Path<V>, SweepError>
    where
        P: AsRef<[f64]> + Copy,
        V: Vector + From<P>,
    {
        let points_path = format!("{path}.points");
        let (fewest, kind) = if free.closed { (3, "a closed") } else { (2, "an open") };
        if free.points.len() < fewest {
            let found = free.points.len();
            let message =
                format!("found {found}, expected at least {fewest} points for {kind} curve");
            return Err(self.fault(&points_path, message));
        }
        self.points(&points_path, &free.points)?;
        let mut points: Vec<V> = free.points.iter().map(|&point| V::from(point)).collect();
        let narrow = COINCIDENT * extent(points.iter().copied());
        points.dedup_by(|later, earlier| (*later - *earlier).length() <= narrow);
        if free.closed
            && let [first, .., last] = points[..]
            && (last - first).length() <= narrow
        {
            points.pop();
        }
        if points.len() < fewest {
            let message = format!(
                "found {} that differ, expected at least {fewest} points for {kind} curve",
                points.len()
            );
            return Err(self.geometry(&points_path, message));
        }
        self.path(path, &spline::through(&points, free.closed), free.closed)
    }

    fn path<V: Vector>(
        &self,
        path: &str,
        cubics: &[Cubic<V>],
        closed: bool,
    ) -> Result<Path<V>, SweepError> {
        let size = extent(cubics.iter().flat_map(|cubic| cubic.0));
        if size > 0.0 && size < SMALLEST {
            let message = format!("found a size of {size:?}, expected at least {SMALLEST:?}");
            return Err(self.geometry(path, message));
        }
        Path::new(cubics, closed).ok_or_else(|| {
            self.geometry(path, "found points that all coincide, expected a curve of some length")
        })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use files::{Exit, Failure};

    const RING: &str = r#"{"format": "tb-sweep", "version": 1, "name": "ring",
"contour": {"circle": 0.25},
"trajectory": {"circle": {"radius": 1}},
"mesh": {"rows": 9, "cols": 8}}"#;

    /// The complaint about the ring with one part of its text replaced.
    pub(crate) fn complaint(part: &str, replacement: &str) -> (String, Exit) {
        let text = RING.replace(part, replacement);
        assert_ne!(text, RING, "{part} is not in the spec");
        let document = Document::new("a.json", text.as_bytes()).unwrap();
        let error = Sweep::read(&document).unwrap_err();
        (error.to_string(), error.exit())
    }

    pub(super) fn contour_complaint(contour: &str) -> (String, Exit) {
        complaint("{\"circle\": 0.25}", contour)
    }

    #[test]
    fn the_header_is_checked_first() {
        for (part, replacement, message) in [
            (
                "tb-sweep",
                "tb-grid",
                "a.json:1:12: format: found \"tb-grid\", expected \"tb-sweep\"",
            ),
            ("\"version\": 1", "\"version\": 2", "a.json:1:35: version: found 2, expected 1"),
            ("ring", "a ring", "a.json:1:46: name: found \"a ring\", expected one word"),
            ("ring", "", "a.json:1:46: name: found \"\", expected one word"),
            (
                "\"mesh\"",
                "\"uv\": {\"repeat\": [1, 0]}, \"mesh\"",
                "a.json:4:22: uv.repeat[1]: found 0.0, expected a number above 0",
            ),
            (
                "\"mesh\"",
                "\"uv\": {\"repeat\": [1e31, 1]}, \"mesh\"",
                "a.json:4:19: uv.repeat[0]: found 1e31, expected a number from 1e-30 to 1e30",
            ),
            (
                "\"mesh\"",
                "\"position\": [0, 1e99, 0], \"mesh\"",
                "a.json:4:13: position: found 1e99, expected coordinates of at most 1e60",
            ),
        ] {
            assert_eq!(complaint(part, replacement), (message.into(), Exit::Malformed));
        }
    }

    #[test]
    fn the_resolution_is_checked_against_both_curves() {
        let text = |part, replacement| complaint(part, replacement).0;
        assert_eq!(
            text("\"rows\": 9", "\"rows\": 2"),
            "a.json:4:18: mesh.rows: found 2, expected at least 3 to go around"
        );
        assert_eq!(
            text("\"cols\": 8", "\"cols\": 0"),
            "a.json:4:29: mesh.cols: found 0, expected at least 3 to go around"
        );
        assert_eq!(
            text("\"rows\": 9", "\"rows\": 9007199254740993"),
            "a.json:4:18: mesh.rows: found 9007199254740993 x 8 cells, expected at most 100000000"
        );
        assert!(text("\"rows\": 9", "\"rows\": -1").contains("mesh.rows: "));
        assert!(text("\"rows\": 9", "\"rows\": 18446744073709551616").contains("mesh.rows: "));
    }

    #[test]
    fn segments_must_meet() {
        let two = |second: &str, closed: bool| {
            let segments = format!("[[[0,0],[1,0],[2,0],[3,0]],\n[{second},[3,1],[3,2],[3,3]]]");
            contour_complaint(&format!(
                "{{\"bezier\": {{\"closed\": {closed}, \"segments\": {segments}}}}}"
            ))
        };
        let (message, exit) = two("[4,0]", false);
        assert_eq!(
            message,
            "a.json:3:2: contour.bezier.segments[1][0]: found [4.0, 0.0], \
             expected [3.0, 0.0], where the segment before ends"
        );
        assert_eq!(exit, Exit::Malformed);
        let (message, _) = two("[3,0]", true);
        assert_eq!(
            message,
            "a.json:3:20: contour.bezier.segments[1][3]: found [3.0, 3.0], \
             expected [0.0, 0.0], where a closed curve starts"
        );
    }

    #[test]
    fn coordinates_beyond_reckoning_are_placed() {
        let (message, _) =
            contour_complaint("{\"bezier\": {\"segments\": [[[0,0],[1,0],[2,1e70],[3,0]]]}}");
        assert!(
            message.starts_with("a.json:2:50: contour.bezier.segments[0][2]: found 1e70"),
            "{message}"
        );
        let (message, _) = contour_complaint("{\"free\": {\"points\": [[0,0],[1e-61,0]]}}");
        assert!(message.contains("contour.free: found a size of 1e-61"), "{message}");
    }

    #[test]
    fn a_contour_across_the_axis_is_refused() {
        let (message, exit) = complaint("{\"circle\": {\"radius\": 1}}", "{\"rotation\": {}}");
        assert!(
            message.starts_with("a.json:2:12: contour: found a contour that reaches x = -0.25")
        );
        assert_eq!(exit, Exit::Geometry);
        let text = RING
            .replace("{\"circle\": {\"radius\": 1}}", "{\"rotation\": {}}")
            .replace("{\"circle\": 0.25}", "{\"svg\": \"M0 0V3\"}");
        let document = Document::new("a.json", text.as_bytes()).unwrap();
        let message = Sweep::read(&document).unwrap_err().to_string();
        assert!(message.contains("contour: found a contour on the axis"), "{message}");
    }
}
