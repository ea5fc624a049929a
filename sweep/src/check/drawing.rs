//! Findings about curves as they were drawn: points dropped, gaps closed, directions reversed, ends that nearly meet.

use super::chain::{Crossings, crossings};
use super::{Finding, Severity, short};
use crate::curve::cut::Stop;
use crate::curve::vector::extent;
use crate::curve::{Cubic, Path, Vector, fit, spline, svg};
use crate::sampling::Sweep;
use crate::spec::{Bezier, Contour, Free, FreeContour, Spec, Trajectory};
use glam::{DVec2, DVec3};

/// Ends of an open curve that are closer than this fraction of its size were most likely meant to meet.
const NEARLY: f64 = 1e-3;

/// Points that are closer than this fraction of a curve's size are one point, as for the reader.
const COINCIDENT: f64 = 1e-12;

/// A contour runs clockwise if its area is below minus this fraction of its squared length.
const NO_AREA: f64 = 1e-9;

/// A contour whose area has at most this fraction of its squared length looks like a line, drawn forth and back.
const THIN: f64 = 1e-6;

/// Number of straight pieces into which a contour is cut for the search for crossings.
const PIECES: usize = 1536;

/// Returns the findings about the curves of a sweep.
#[must_use]
pub fn findings(spec: &Spec, sweep: &Sweep) -> Vec<Finding> {
    let mut found = Vec::new();
    for (path, contour) in contours(&spec.contour) {
        match contour {
            Contour::Bezier(bezier) => {
                joints::<_, DVec2>(&format!("{path}.bezier"), bezier, &mut found);
            }
            Contour::Free(free) => {
                doubled::<_, DVec2>(&format!("{path}.free"), &points_of(free), &mut found);
            }
            Contour::Polyline(line) => {
                doubled::<_, DVec2>(&format!("{path}.polyline"), line, &mut found);
            }
            Contour::Circle(_)
            | Contour::Svg(_)
            | Contour::SvgFile(_)
            | Contour::Sections(_)
            | Contour::Loops(_)
            | Contour::Moved(_) => {}
        }
        if let Some((cubics, closed)) = cubics(contour) {
            shape(&path, &cubics, closed, &mut found);
        }
    }
    match &spec.trajectory {
        Trajectory::Bezier(bezier) => {
            let curve = Bezier { closed: bezier.closed, segments: bezier.segments.clone() };
            joints::<_, DVec3>("trajectory.bezier", &curve, &mut found);
        }
        Trajectory::Polyline(line) => {
            let points = Free { closed: line.closed, points: line.points.clone() };
            doubled::<_, DVec3>("trajectory.polyline", &points, &mut found);
        }
        Trajectory::Free(free) => {
            let points = Free { closed: free.closed, points: free.points.clone() };
            doubled::<_, DVec3>("trajectory.free", &points, &mut found);
        }
        Trajectory::Line(_)
        | Trajectory::Circle(_)
        | Trajectory::Helix(_)
        | Trajectory::Flat(_)
        | Trajectory::Formula(_)
        | Trajectory::Swc(_)
        | Trajectory::Rotation(_) => {}
    }
    found.extend(nearly_closed(sweep));
    found
}

/// Returns the contours of a spec with their JSON paths.
fn contours(contour: &Contour) -> Vec<(String, &Contour)> {
    match contour {
        Contour::Sections(sections) => {
            let path = |i: usize| format!("contour.sections[{i}].contour");
            sections.sections.iter().enumerate().map(|(i, s)| (path(i), &s.contour)).collect()
        }
        Contour::Moved(moved) => contours(&moved.contour),
        Contour::Loops(loops) if !loops.named => loops.loops.iter().flat_map(contours).collect(),
        Contour::Loops(loops) => {
            let path = |i: usize| format!("contour.loops[{i}]");
            loops.loops.iter().enumerate().map(|(i, one)| (path(i), one)).collect()
        }
        Contour::Circle(_)
        | Contour::Bezier(_)
        | Contour::Svg(_)
        | Contour::SvgFile(_)
        | Contour::Free(_)
        | Contour::Polyline(_) => vec![("contour".into(), contour)],
    }
}

/// Returns the cubics of a contour as it was drawn, and whether it is closed; `None` for a circle, which has no faults.
fn cubics(contour: &Contour) -> Option<(Vec<Cubic<DVec2>>, bool)> {
    match contour {
        Contour::Bezier(bezier) => {
            let cubic = |points: &[[f64; 2]; 4]| Cubic(points.map(DVec2::from_array));
            Some((bezier.segments.iter().map(cubic).collect(), bezier.closed))
        }
        Contour::Svg(text) => {
            let outline = svg::outline(text).ok()?;
            Some((outline.segments, outline.closed))
        }
        Contour::Free(free) => {
            let points: Vec<DVec2> = distinct(&points_of(free));
            Some(match free.fit {
                Some(fit) => (fit::within(&points, free.closed, fit).cubics, free.closed),
                None => (spline::through(&points, free.closed), free.closed),
            })
        }
        Contour::Polyline(line) => {
            let points: Vec<DVec2> = distinct(line);
            let next = points.iter().skip(1).chain(line.closed.then(|| &points[0]));
            let sides = points.iter().zip(next).map(|(&a, &b)| Cubic::line(a, b));
            Some((sides.collect(), line.closed))
        }
        Contour::Circle(_)
        | Contour::SvgFile(_)
        | Contour::Sections(_)
        | Contour::Loops(_)
        | Contour::Moved(_) => None,
    }
}

fn points_of(free: &FreeContour) -> Free<[f64; 2]> {
    Free { closed: free.closed, points: free.points.clone() }
}

/// Returns the points of a curve without those that repeat the point before.
fn distinct<P: Copy, V: Vector + From<P>>(free: &Free<P>) -> Vec<V> {
    let mut points: Vec<V> = free.points.iter().map(|&point| V::from(point)).collect();
    let narrow = COINCIDENT * extent(points.iter().copied());
    points.dedup_by(|later, earlier| (*later - *earlier).length() <= narrow);
    if let (true, [first, .., last]) = (free.closed, &points[..])
        && (*last - *first).length() <= narrow
    {
        points.pop();
    }
    points
}

/// Reports points given twice.
fn doubled<P: Copy, V: Vector + From<P>>(path: &str, free: &Free<P>, found: &mut Vec<Finding>) {
    let dropped = free.points.len() - distinct::<P, V>(free).len();
    if dropped > 0 {
        let points = if dropped == 1 { "point" } else { "points" };
        let message = format!("found {dropped} {points} given twice, which count once");
        found.push(Finding::new(Severity::Remark, format!("{path}.points"), message));
    }
}

/// Reports gaps between segments, which were closed, and segments without size, which were dropped.
fn joints<P, V: Vector + From<P>>(path: &str, bezier: &Bezier<P>, found: &mut Vec<Finding>)
where
    P: Copy,
{
    let cubics: Vec<Cubic<V>> = bezier.segments.iter().map(|s| Cubic(s.map(V::from))).collect();
    let size = extent(cubics.iter().flat_map(|cubic| cubic.0));
    let next = cubics.iter().skip(1).chain(bezier.closed.then(|| &cubics[0]));
    let gaps = cubics.iter().zip(next).map(|(a, b)| (b.0[0] - a.0[3]).length());
    let widest = gaps.fold(0.0, f64::max);
    let path = format!("{path}.segments");
    if widest > 0.0 {
        let message = format!("closed gaps between segments, the widest of {}", short(widest));
        found.push(Finding::new(Severity::Remark, &path, message));
    }
    let empty = cubics.iter().filter(|cubic| cubic.size() <= COINCIDENT * size).count();
    if empty > 0 {
        let segments = if empty == 1 { "segment" } else { "segments" };
        let message = format!("dropped {empty} {segments} whose points all coincide");
        found.push(Finding::new(Severity::Remark, &path, message));
    }
}

/// Reports the crossings of a contour, and its direction and area if it is closed.
fn shape(path: &str, cubics: &[Cubic<DVec2>], closed: bool, found: &mut Vec<Finding>) {
    let Some(curve) = Path::new(cubics, closed) else { return };
    let count = cubics.len().max(1);
    let pieces = (PIECES / count).clamp(2, 64);
    let straight = |cubic: &Cubic<DVec2>| cubic.0[1] == cubic.0[0].lerp(cubic.0[3], 1.0 / 3.0);
    let mut points: Vec<DVec2> = Vec::with_capacity(count * pieces + 1);
    for cubic in curve.cubics() {
        let pieces = if straight(cubic) { 1 } else { pieces };
        points.extend((0..pieces).map(|i| cubic.point(i as f64 / pieces as f64)));
    }
    points.push(curve.point(curve.end()));
    let Crossings { count: crossings, first, more, .. } = crossings(&points, closed);
    if let Some(at) = first {
        let times = match (crossings, more) {
            (1, false) => "once".into(),
            (_, false) => format!("{crossings} times"),
            (_, true) => format!("at least {crossings} times"),
        };
        let message = format!(
            "the contour crosses itself {times}, first at ({}, {}): the surface crosses itself there",
            short(at.x),
            short(at.y)
        );
        found.push(Finding::new(Severity::Hint, path, message));
    }
    if !closed {
        return;
    }
    let origin = points[0];
    let area: f64 = 0.5
        * points.windows(2).map(|pair| (pair[0] - origin).perp_dot(pair[1] - origin)).sum::<f64>();
    let whole = curve.length().powi(2);
    if crossings == 0 && area.abs() < THIN * whole {
        let message = format!(
            "the contour encloses an area of only {}: the two sides of the contour coincide; an \
             open contour has one side",
            short(area.abs())
        );
        found.push(Finding::new(Severity::Hint, path, message));
    } else if area < -NO_AREA * whole {
        let message = "the contour runs clockwise and was reversed, so that the normals point \
                       outward";
        found.push(Finding::new(Severity::Remark, path, message));
    }
}

/// Returns a finding for each open curve whose ends nearly meet.
fn nearly_closed(sweep: &Sweep) -> Vec<Finding> {
    let close = |path: &str, gap: f64, size: f64| {
        let message = format!(
            "the ends are {} apart, {} of the size, and the curve is open: should the curve be \
             closed?",
            short(gap),
            short(gap / size)
        );
        (size > 0.0 && gap < NEARLY * size).then(|| Finding::new(Severity::Hint, path, message))
    };
    let mut found = Vec::new();
    if !sweep.shape.contour.closed() {
        let ends = sweep.shape.contour.columns(&[Stop::after(0.0), Stop::before(1.0)]);
        let gap = ends[0].first.point.distance(ends[1].first.point);
        found.extend(close("contour", gap, sweep.shape.contour.length()));
    }
    if !sweep.shape.trajectory.closed()
        && !sweep.shape.trajectory.is_rotation()
        && sweep.shape.closing.is_none()
    {
        let [from, to] = [0.0, 1.0].map(|v| sweep.shape.trajectory.station(v).frame.origin);
        found.extend(close("trajectory", from.distance(to), sweep.shape.trajectory.length()));
    }
    found
}
