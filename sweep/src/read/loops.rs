//! Reads contours of one loop or several: outlines and holes.

use super::Reader;
use crate::curve::vector::extent;
use crate::curve::{Cubic, Path, svg};
use crate::error::SweepError;
use crate::limits::LARGEST;
use crate::spec;
use crate::surface::contour::Contour;
use crate::surface::nest::{self, Role, Rule};
use glam::DVec2;
use kurbo::{CubicBez, Point, Shape};

/// Straight pieces of a polygon that stands for a loop, for each of its cubics.
const PIECES: usize = 16;

/// A loop, or an open curve, as it is drawn.
#[derive(Debug, Clone)]
pub(super) enum Drawn {
    Circle { center: DVec2, radius: f64 },
    Curve { path: Path<DVec2>, reached: Option<f64> },
}

impl Drawn {
    fn closed(&self) -> bool {
        match self {
            Self::Circle { .. } => true,
            Self::Curve { path, .. } => path.closed(),
        }
    }

    fn contour(self) -> Contour {
        match self {
            Self::Circle { center, radius } => Contour::circle(center, radius),
            Self::Curve { path, reached } => Contour::fitted(path, reached),
        }
    }

    /// Returns the corners of the box around the curve.
    fn bounds(&self) -> [DVec2; 2] {
        match self {
            Self::Circle { center, radius } => [*center - *radius, *center + *radius],
            Self::Curve { path, .. } => path
                .cubics()
                .map(|cubic| {
                    let [p0, p1, p2, p3] = cubic.0.map(|p| Point::new(p.x, p.y));
                    CubicBez::new(p0, p1, p2, p3).bounding_box()
                })
                .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], bounds| {
                    [
                        low.min(DVec2::new(bounds.x0, bounds.y0)),
                        high.max(DVec2::new(bounds.x1, bounds.y1)),
                    ]
                }),
        }
    }

    fn moved(self, by: DVec2) -> Option<Self> {
        Some(match self {
            Self::Circle { center, radius } => Self::Circle { center: center + by, radius },
            Self::Curve { path, reached } => {
                let cubics: Vec<_> =
                    path.cubics().map(|cubic| Cubic(cubic.0.map(|p| p + by))).collect();
                Self::Curve { path: Path::new(&cubics, path.closed())?, reached }
            }
        })
    }

    fn polygon(&self) -> Vec<DVec2> {
        match self {
            Self::Circle { center, radius } => (0..4 * PIECES)
                .map(|i| crate::curve::turn(i as f64 / (4 * PIECES) as f64) * *radius + *center)
                .collect(),
            Self::Curve { path, .. } => {
                let part = |i: usize| i as f64 / PIECES as f64;
                path.cubics()
                    .flat_map(|cubic| (0..PIECES).map(move |i| cubic.point(part(i))))
                    .collect()
            }
        }
    }
}

impl Reader<'_> {
    /// Reads a contour that is one curve; `path` is its JSON path in the spec.
    pub(super) fn contour(
        &self,
        path: &str,
        contour: &spec::Contour,
    ) -> Result<Contour, SweepError> {
        let mut drawn = self.drawn(path, contour)?;
        match (drawn.pop(), drawn.len()) {
            (Some(only), 0) => Ok(only.contour()),
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
        let drawn = self.drawn(path, contour)?;
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
        let roles = nest::roles(&polygons, rule(contour));
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

    /// Reads the curves of a contour, as they are drawn.
    fn drawn(&self, path: &str, contour: &spec::Contour) -> Result<Vec<Drawn>, SweepError> {
        let curve = |path, reached| vec![Drawn::Curve { path, reached }];
        Ok(match contour {
            spec::Contour::Circle(radius) => {
                self.positive(&format!("{path}.circle"), *radius)?;
                vec![Drawn::Circle { center: DVec2::ZERO, radius: *radius }]
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
                let mut all = Vec::new();
                for (i, one) in loops.loops.iter().enumerate() {
                    let path =
                        if loops.named { format!("{path}.loops[{i}]") } else { path.to_owned() };
                    all.extend(self.drawn(&path, one)?);
                }
                all
            }
            spec::Contour::Moved(moved) => {
                self.point(&format!("{path}.offset"), &moved.offset)?;
                let drawn = self.drawn(path, &moved.contour)?;
                let bounds =
                    drawn.iter().map(Drawn::bounds).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
                let middle = bounds
                    .filter(|_| moved.center)
                    .map_or(DVec2::ZERO, |[low, high]| 0.5 * (low + high));
                let by = DVec2::from_array(moved.offset) - middle;
                let moved: Option<Vec<Drawn>> =
                    drawn.into_iter().map(|one| one.moved(by)).collect();
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
    fn svg(&self, path: &str, text: &str) -> Result<Vec<Drawn>, SweepError> {
        let outlines = svg::outlines(text).map_err(|message| self.fault(path, message))?;
        let curve = |outline: &svg::Outline| {
            let curve = self.outlined(path, outline, outline.closed)?;
            Ok(Drawn::Curve { path: curve, reached: None })
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

/// Returns the rule for the loops of a contour: that of the spec, or even-odd.
fn rule(contour: &spec::Contour) -> Rule {
    use spec::Contour::{Bezier, Circle, Free, Loops, Moved, Polyline, Sections, Svg, SvgFile};
    match contour {
        Loops(loops) if loops.rule == Some(spec::contour::Rule::Nonzero) => Rule::Nonzero,
        Moved(moved) => rule(&moved.contour),
        Circle(_) | Bezier(_) | Svg(_) | SvgFile(_) | Free(_) | Polyline(_) | Sections(_)
        | Loops(_) => Rule::EvenOdd,
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
