//! Reads contours of one loop or several: outlines and holes.

use super::Reader;
use super::drawn::Drawn;
use crate::curve::vector::extent;
use crate::curve::{Path, svg};
use crate::error::SweepError;
use crate::limits::LARGEST;
use crate::spec;
use crate::surface::contour::Contour;
use crate::surface::nest::{self, Group, Role, Rule};
use glam::DVec2;

impl Reader<'_> {
    /// Reads a contour that is one curve; `path` is its JSON path in the spec.
    pub(super) fn contour(
        &self,
        path: &str,
        contour: &spec::Contour,
    ) -> Result<Contour, SweepError> {
        let mut drawn = self.drawn(path, contour)?;
        match (drawn.pop(), drawn.len()) {
            (Some((only, _)), 0) => Ok(only.contour()),
            (_, more) => {
                let message = format!("found {} loops, expected one contour here", more + 1);
                Err(self.geometry(path, message))
            }
        }
    }

    /// Reads a contour of one curve, or of several loops: outlines, and holes that run clockwise.
    pub(super) fn loops(
        &self,
        path: &str,
        contour: &spec::Contour,
    ) -> Result<Vec<Contour>, SweepError> {
        let (drawn, groups): (Vec<Drawn>, Vec<Option<Group>>) =
            self.drawn(path, contour)?.into_iter().unzip();
        if drawn.len() == 1 {
            return Ok(drawn.into_iter().map(Drawn::contour).collect());
        }
        if drawn.iter().any(|one| !one.closed()) {
            let message =
                "found an open curve beside other loops, expected loops that are all closed";
            return Err(self.geometry(path, message));
        }
        let polygons: Vec<Vec<DVec2>> = drawn.iter().map(Drawn::polygon).collect();
        if let Some([a, b]) = crossed(&polygons) {
            let message = format!(
                "found loops {a} and {b} that cross or touch each other, expected loops inside or beside each \
                 other"
            );
            return Err(self.geometry(path, message));
        }
        let rest = Group { number: usize::MAX, rule: Rule::EvenOdd };
        let groups: Vec<Group> = groups.into_iter().map(|group| group.unwrap_or(rest)).collect();
        let roles = nest::roles(&polygons, &groups);
        let contours: Vec<Contour> = drawn
            .into_iter()
            .zip(roles)
            .filter_map(|(one, role)| match role {
                Role::Outline => Some(one.contour()),
                Role::Hole => Some(one.contour().backward()),
                Role::None => None,
            })
            .collect();
        if contours.is_empty() {
            return Err(self.geometry(path, "found loops that bound no area, expected an outline"));
        }
        Ok(contours)
    }

    /// Reads the curves of a contour, as they are drawn. Each has the group of the outermost contour that states a rule.
    fn drawn(
        &self,
        path: &str,
        contour: &spec::Contour,
    ) -> Result<Vec<(Drawn, Option<Group>)>, SweepError> {
        let curve = |path, reached| vec![(Drawn::Curve { path, reached }, None)];
        Ok(match contour {
            spec::Contour::Circle(radius) => {
                self.positive(&format!("{path}.circle"), *radius)?;
                vec![(Drawn::Circle { center: DVec2::ZERO, radius: *radius }, None)]
            }
            spec::Contour::Bezier(bezier) => {
                curve(self.bezier(&format!("{path}.bezier"), bezier)?, None)
            }
            spec::Contour::Svg(text) => self.svg(&format!("{path}.svg"), text)?,
            spec::Contour::SvgFile(file) => {
                let read = self.svg_file(&format!("{path}.svg"), file)?;
                self.drawn(path, &read)?
            }
            spec::Contour::Free(free) => {
                let (path, reached) = self.near(&format!("{path}.free"), free)?;
                curve(path, reached)
            }
            spec::Contour::Polyline(line) => {
                curve(self.polyline(&format!("{path}.polyline"), line)?, None)
            }
            spec::Contour::Loops(loops) => {
                if loops.loops.is_empty() {
                    return Err(self
                        .fault(&format!("{path}.loops"), "found no loops, expected at least one"));
                }
                let mut all: Vec<(Drawn, Option<Group>)> = Vec::new();
                for (i, one) in loops.loops.iter().enumerate() {
                    let path =
                        if loops.named { format!("{path}.loops[{i}]") } else { path.to_owned() };
                    let groups = all.iter().filter_map(|(_, group)| *group);
                    let next = groups.map(|group| group.number + 1).max().unwrap_or(0);
                    all.extend(self.drawn(&path, one)?.into_iter().map(|(drawn, group)| {
                        (drawn, group.map(|group| Group { number: group.number + next, ..group }))
                    }));
                }
                let own = loops.rule.map(|rule| Group { number: 0, rule: rule_of(rule) });
                all.iter_mut().for_each(|(_, group)| *group = own.or(*group));
                all
            }
            spec::Contour::Moved(moved) => {
                self.point(&format!("{path}.offset"), &moved.offset)?;
                let drawn = self.drawn(path, &moved.contour)?;
                let bounds = drawn
                    .iter()
                    .map(|one| one.0.bounds())
                    .reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
                let middle = bounds
                    .filter(|_| moved.center)
                    .map_or(DVec2::ZERO, |[low, high]| 0.5 * (low + high));
                let by = DVec2::from_array(moved.offset) - middle;
                let moved: Option<Vec<_>> =
                    drawn.into_iter().map(|(one, group)| Some((one.moved(by)?, group))).collect();
                moved.ok_or_else(|| {
                    self.geometry(path, "found an offset beside which the contour has no size, expected a smaller one")
                })?
            }
            spec::Contour::Sections(_) => {
                return Err(self.fault(
                    &format!("{path}.sections"),
                    "found sections inside a section, expected one contour",
                ));
            }
        })
    }

    /// Reads the subpaths of an SVG path.
    fn svg(&self, path: &str, text: &str) -> Result<Vec<(Drawn, Option<Group>)>, SweepError> {
        let outlines = svg::outlines(text).map_err(|message| self.fault(path, message))?;
        let curve = |outline: &svg::Outline| {
            let curve = self.outlined(path, outline, outline.closed)?;
            Ok((Drawn::Curve { path: curve, reached: None }, None))
        };
        outlines.iter().map(curve).collect()
    }

    /// Reads an SVG path of one subpath, in the direction in which it is drawn. The path is closed only by `Z`.
    pub(super) fn outline(&self, path: &str, text: &str) -> Result<Path<DVec2>, SweepError> {
        let outline = svg::outline(text).map_err(|message| self.fault(path, message))?;
        self.outlined(path, &outline, outline.drawn_closed)
    }

    fn outlined(
        &self,
        path: &str,
        outline: &svg::Outline,
        closed: bool,
    ) -> Result<Path<DVec2>, SweepError> {
        let reckonable = |point: &DVec2| point.abs().max_element() <= LARGEST;
        if !outline.segments.iter().flat_map(|cubic| &cubic.0).all(reckonable) {
            let message = format!("found a coordinate beyond {LARGEST:?}, expected smaller ones");
            return Err(self.fault(path, message));
        }
        self.path(path, &outline.segments, closed)
    }
}

fn rule_of(rule: spec::contour::Rule) -> Rule {
    match rule {
        spec::contour::Rule::Nonzero => Rule::Nonzero,
        spec::contour::Rule::EvenOdd => Rule::EvenOdd,
    }
}

/// Returns the indices of two polygons that cross or touch, if any do.
fn crossed(polygons: &[Vec<DVec2>]) -> Option<[usize; 2]> {
    let near: Vec<f64> =
        polygons.iter().map(|points| 1e-9 * extent(points.iter().copied())).collect();
    let bounds = |points: &[DVec2]| {
        points.iter().fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], &p| {
            [low.min(p), high.max(p)]
        })
    };
    let boxes: Vec<[DVec2; 2]> = polygons.iter().map(|points| bounds(points)).collect();
    let sides = |points: &[DVec2]| {
        let next = points.iter().copied().cycle().skip(1);
        points.iter().copied().zip(next).collect::<Vec<_>>()
    };
    for i in 0..polygons.len() {
        for j in i + 1..polygons.len() {
            if boxes[i][0].cmpgt(boxes[j][1]).any() || boxes[i][1].cmplt(boxes[j][0]).any() {
                continue;
            }
            let slack = near[i].max(near[j]);
            for (a, b) in sides(&polygons[i]) {
                let hit = sides(&polygons[j]).into_iter().any(|(c, d)| {
                    let of = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
                    let apart = of(a, b, c) * of(a, b, d) < 0.0 && of(c, d, a) * of(c, d, b) < 0.0;
                    apart || a.distance(c) <= slack
                });
                if hit {
                    return Some([i, j]);
                }
            }
        }
    }
    None
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
