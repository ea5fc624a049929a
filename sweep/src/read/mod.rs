//! Reads specs: from a spec to an [`Object`](crate::Object). Every value is checked before any work is done.

mod areas;
mod caps;
mod corners;
mod curve;
mod deform;
mod depth;
mod drawn;
mod flat;
mod height;
mod helix;
mod joints;
mod law;
mod loaded;
mod loops;
mod measured;
mod modulation;
mod object;
mod place;
mod profile;
mod resolution;
mod seam;
mod swc;
mod table;
mod trajectory;
mod vessel;
mod wall;

use crate::error::SweepError;
use crate::grid::Unit;
use crate::law::Law;
use crate::limits::{LARGEST, REPEATS, SMALLEST};
use crate::sampling::resolution::Tell;
use crate::sampling::{Sweep, lids};
use crate::spec::{Resolution, Spec};
use crate::surface::Shape;
use crate::surface::edges::Edges;
use crate::surface::modulation::Modulation;
use crate::surface::press::Press;
use crate::surface::profile::Profile;
use crate::trajectory::Trajectory;
use files::Source;
use files::json::Document;
use glam::{DVec2, DVec3};
use measured::PointLaws;
use profile::{Face, Loop};
use std::sync::OnceLock;
use std::time::Duration;

/// The reader of a spec, with the document for error positions and the source of its files.
struct Reader<'a> {
    document: &'a Document<'a>,
    folder: &'a std::path::Path,
    source: &'a dyn Source,
    /// Keys that replace those of the resolution of every sweep.
    overrides: &'a Resolution,
    /// Receives the progress of the search for the cells of a tolerance.
    tell: Tell<'a>,
    /// Prefix of all JSON paths.
    prefix: String,
    /// The unit of length of the object.
    unit: Option<Unit>,
}

/// Largest number of bytes of a name.
const LONGEST_NAME: usize = 1000;

impl Reader<'_> {
    /// Reads the sweeps of a spec: most often one, or one for each loop of its contour.
    fn sweeps(&self, spec: &Spec) -> Result<Vec<Sweep>, SweepError> {
        self.header(spec)?;
        let (trajectory, laws) = self.trajectory(spec)?;
        let loops = self.profiles(spec, &trajectory)?;
        let count = loops.len();
        if count > 1 {
            self.alone(spec)?;
        }
        let mut sweeps = Vec::with_capacity(count);
        for (number, one) in (1..).zip(loops) {
            let sweep = self.sweep(spec, trajectory.clone(), &laws, one, count)?;
            let name =
                if number > 1 { format!("{}-{number}", spec.name) } else { spec.name.clone() };
            let group = if number == count { count } else { 0 };
            sweeps.push(Sweep { name, group, ..sweep });
        }
        if lids::of(&sweeps).is_none() {
            let message = "found outlines of an end that cross themselves or each other, expected outlines that do \
                           not; more cols, a smaller tol or a thinner wall keep them apart";
            return Err(self.geometry(if spec.wall.is_some() { "wall" } else { "caps" }, message));
        }
        Ok(sweeps)
    }

    /// Refuses keys that do not apply to several loops.
    fn alone(&self, spec: &Spec) -> Result<(), SweepError> {
        for (key, given) in [("areas", !spec.areas.is_empty()), ("seam", spec.seam.is_some())] {
            if given {
                let message =
                    format!("found `{key}` of a contour of several loops, expected one loop");
                return Err(self.geometry(key, message));
            }
        }
        Ok(())
    }

    fn sweep(
        &self,
        spec: &Spec,
        trajectory: Trajectory,
        laws: &PointLaws,
        Loop { profile: contour, blend, offset, face, bend }: Loop,
        loops: usize,
    ) -> Result<Sweep, SweepError> {
        let hollow = offset.is_some();
        let (modulation, mirror) = self.modulation(spec, laws, &contour, &face, &trajectory)?;
        let modulation = Modulation { blend, offset, ..modulation };
        let contour = match mirror {
            Some(factors) => contour.mirrored(factors),
            None => contour,
        };
        let (caps, lids) = if hollow || !matches!(face, Face::Whole) {
            ([None, None], [!trajectory.closed(); 2])
        } else {
            self.caps(spec.caps, loops == 1, &contour, &trajectory, &modulation)?
        };
        let press = pressed(&contour, &trajectory, &modulation).filter(|_| loops == 1);
        // The edge of a pressed end closes it.
        let ends = press.as_ref().map_or([false; 2], |press| press.ends);
        let lids = [lids[0] && !ends[0], lids[1] && !ends[1]];
        let shape = Shape {
            contour,
            trajectory,
            modulation,
            caps,
            closing: None,
            press,
            deforms: self.deforms(&spec.deform)?,
            edges: Edges::default(),
            position: DVec3::from_array(spec.position),
            place: self.placement("place", &spec.place)?,
        };
        let shape = match spec.seam {
            Some(kind) => self.closed(shape, kind)?,
            None => shape,
        };
        let shape = Shape { edges: Edges::of(&shape), ..shape };
        let wall = self.wall(spec, &shape)?;
        let sweep = Sweep {
            name: spec.name.clone(),
            shape,
            wall,
            bend,
            lids,
            group: 1,
            resolution: self.resolution(&spec.resolution)?,
            fitted: None,
            spent: Duration::ZERO,
            survey: OnceLock::new(),
            uv: spec.uv,
            unit: self.unit,
            areas: spec.areas.clone(),
            texture: spec.texture,
            surface: spec.surface,
        };
        if let Some(fault) = sweep.resolution_fault() {
            return Err(self.resolution_fault(fault));
        }
        let sweep = sweep.fitted(self.tell)?;
        self.areas(&sweep.areas, &sweep).map(|()| sweep)
    }

    fn fault(&self, path: &str, message: impl Into<String>) -> SweepError {
        SweepError::Malformed(self.document.fault(&self.whole(path), message))
    }

    fn geometry(&self, path: &str, message: impl Into<String>) -> SweepError {
        SweepError::Geometry(self.document.fault(&self.whole(path), message))
    }

    /// Returns a path from the root of the document.
    fn whole(&self, path: &str) -> String {
        format!("{}{path}", self.prefix)
    }

    fn name(&self, name: &str) -> Result<(), SweepError> {
        let blank = |c: char| c.is_whitespace() || c.is_control();
        if name.is_empty() || name.contains(blank) {
            return Err(self.fault("name", format!("found {name:?}, expected one word")));
        }
        // A name is part of a grid's header, whose length readers limit.
        if name.len() > LONGEST_NAME {
            let message = format!("found {} bytes, expected at most {LONGEST_NAME}", name.len());
            return Err(self.fault("name", message));
        }
        Ok(())
    }

    /// Checks the values that belong to no curve: name, repeats and position.
    fn header(&self, spec: &Spec) -> Result<(), SweepError> {
        self.name(&spec.name)?;
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

    /// Checks that a number is above 0 and lies from [`SMALLEST`] to [`LARGEST`].
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
}

/// Returns the ends of a surface that a scale of 0 on one axis presses to a line, if the contour is symmetric about that
/// axis.
fn pressed(contour: &Profile, trajectory: &Trajectory, modulation: &Modulation) -> Option<Press> {
    let [x, y] = modulation.scale.as_ref()?;
    if !contour.closed()
        || trajectory.closed()
        || contour.contours() > 1
        || modulation.depth.is_some()
    {
        return None;
    }
    let ends = |law: &Law, other: &Law| {
        let zero = |at: usize| law.ends()[at] == 0.0 && other.ends()[at] != 0.0;
        [zero(0), zero(1)]
    };
    match (ends(x, y), ends(y, x)) {
        ([false, false], [false, false]) => None,
        (ends, [false, false]) => Press::of(contour, DVec2::new(-1.0, 1.0), ends),
        ([false, false], ends) => Press::of(contour, DVec2::new(1.0, -1.0), ends),
        // Both ends are pressed, along different axes.
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::{Exit, Failure};

    const RING: &str = r#"{"format": "tb-sweep", "version": 1, "name": "ring",
"contour": {"circle": 0.25},
"trajectory": {"circle": {"radius": 1}},
"mesh": {"rows": 9, "cols": 8}}"#;

    /// Returns the error for the ring with one part of its text replaced.
    pub(super) fn complaint(part: &str, replacement: &str) -> (String, Exit) {
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
                "a.json:1:12: format: found \"tb-grid\", expected \"tb-sweep\": `triangulate` makes the triangles of a grid",
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
