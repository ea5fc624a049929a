//! Reads the contour of a spec.

use super::Reader;
use crate::curve::{Path, svg};
use crate::error::SweepError;
use crate::limits::LARGEST;
use crate::spec;
use crate::surface::contour::Contour;
use glam::DVec2;

impl Reader<'_> {
    /// Reads one contour; `path` is its JSON path in the spec.
    pub(super) fn contour(
        &self,
        path: &str,
        contour: &spec::Contour,
    ) -> Result<Contour, SweepError> {
        match contour {
            spec::Contour::Circle(radius) => {
                self.positive(&format!("{path}.circle"), *radius)?;
                Ok(Contour::circle(*radius))
            }
            spec::Contour::Bezier(bezier) => {
                Ok(Contour::path(self.bezier(&format!("{path}.bezier"), bezier)?))
            }
            spec::Contour::Svg(text) => {
                Ok(Contour::path(self.outline(&format!("{path}.svg"), text)?))
            }
            spec::Contour::Free(free) => {
                let (curve, reached) = self.near(&format!("{path}.free"), free)?;
                Ok(Contour::fitted(curve, reached))
            }
            spec::Contour::Polyline(line) => {
                Ok(Contour::path(self.polyline(&format!("{path}.polyline"), line)?))
            }
            spec::Contour::Sections(_) => Err(self.fault(
                &format!("{path}.sections"),
                "found sections inside a section, expected one contour",
            )),
        }
    }

    /// Reads an SVG path, in the direction in which it is drawn.
    pub(super) fn outline(&self, path: &str, text: &str) -> Result<Path<DVec2>, SweepError> {
        let outline = svg::outline(text).map_err(|message| self.fault(path, message))?;
        let reckonable = |point: &DVec2| point.abs().max_element() <= LARGEST;
        if !outline.segments.iter().flat_map(|cubic| &cubic.0).all(reckonable) {
            let message = format!("found a coordinate beyond {LARGEST:?}, expected smaller ones");
            return Err(self.fault(path, message));
        }
        self.path(path, &outline.segments, outline.closed)
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::contour_complaint;
    use files::Exit;

    #[test]
    fn each_kind_of_contour_has_its_complaints() {
        for (contour, message, exit) in [
            ("{\"circle\": -1}", "2:23: contour.circle: found -1.0, expected a number above 0", 3),
            ("{\"circle\": 1e-90}", "2:23: contour.circle: found 1e-90, expected a number from", 3),
            (
                "{\"bezier\": {\"segments\": []}}",
                "2:36: contour.bezier.segments: found no segments",
                3,
            ),
            (
                "{\"free\": {\"points\": [[0, 0]]}}",
                "2:32: contour.free.points: found 1, expected at least 2 points for an open curve",
                3,
            ),
            (
                "{\"free\": {\"closed\": true, \"points\": [[0, 0], [1, 0]]}}",
                "2:48: contour.free.points: found 2, expected at least 3 points for a closed curve",
                3,
            ),
            (
                "{\"free\": {\"points\": [[1, 1], [1, 1]]}}",
                "2:32: contour.free.points: found 1 that differ",
                4,
            ),
            (
                "{\"polyline\": {\"points\": [[1, 1]]}}",
                "2:36: contour.polyline.points: found 1, expected at least 2 points for an open curve",
                3,
            ),
            (
                "{\"polyline\": {\"closed\": true, \"points\": [[0, 0], [1, 0], [1, 0], [0, 0]]}}",
                "2:52: contour.polyline.points: found 2 that differ, expected at least 3",
                4,
            ),
            (
                "{\"svg\": \"M0 0 L1\"}",
                "2:20: contour.svg: found the end at character 8, expected a number",
                3,
            ),
            (
                "{\"svg\": \"M0 0 L1e300 0\"}",
                "2:20: contour.svg: found a coordinate beyond 1e60",
                3,
            ),
            ("{\"svg\": \"M1 1Z\"}", "2:20: contour.svg: found points that all coincide", 4),
            (
                "{\"bezier\": {\"segments\": [[[1,1],[1,1],[1,1],[1,1]]]}}",
                "2:23: contour.bezier: found points that all coincide",
                4,
            ),
            ("{\"squircle\": 1}", "contour.squircle: unknown key `squircle`", 3),
            ("{\"circle\": 1, \"svg\": \"\"}", "contour: found both `circle` and `svg`", 3),
            (
                "{}",
                "contour: found no curve, expected one of circle, bezier, svg, free, polyline",
                3,
            ),
            ("{\"free\": {\"points\": [[0, 0, 0], [1, 0]]}}", "contour.free.points[0]", 3),
            ("{\"free\": {\"closd\": true, \"points\": []}}", "did you mean `closed`?", 3),
        ] {
            let (found, code) = contour_complaint(contour);
            assert!(
                found.starts_with("a.json:2:") && found.contains(message),
                "{contour}: {found}"
            );
            let expected = if exit == 3 { Exit::Malformed } else { Exit::Geometry };
            assert_eq!(code, expected, "{contour}");
        }
    }
}
