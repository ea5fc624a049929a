//! The panel of the trajectory in space, with the contour's axes along it.

use super::page::{Anchor, Area, Page, Pen, View, ink};
use crate::check::short;
use crate::curve::cut::Stop;
use crate::frame::Frame;
use crate::sampling::Sweep;
use glam::{DVec2, DVec3};

/// Number of straight pieces that a trajectory is drawn with.
const PIECES: usize = 240;

/// Number of stations at which the frame is drawn.
const STATIONS: usize = 24;

/// Length of the frame's axes, as a fraction of the size of all trajectories.
const ARM: f64 = 0.075;

pub fn draw(page: &mut Page, area: Area, parts: &[Sweep]) {
    let deformed = parts.iter().any(|sweep| !sweep.shape.deforms.is_empty());
    let note = match parts {
        [sweep] if sweep.shape.trajectory.is_rotation() => "a rotation about its axis".into(),
        [sweep] => {
            let kind = if sweep.shape.trajectory.closed() { "closed" } else { "open" };
            let before = if deformed { ", before deformation" } else { "" };
            format!("{kind}, {} long{before}", short(sweep.shape.trajectory.length()))
        }
        _ => String::new(),
    };
    page.panel(area, if parts.len() > 1 { "Trajectories" } else { "Trajectory" }, &note);
    // Many curves share the pieces of four.
    let pieces = (4 * PIECES / parts.len().max(1)).clamp(STATIONS, PIECES);
    let courses: Vec<Vec<Frame>> = parts.iter().map(|sweep| frames(sweep, pieces)).collect();
    let origins: Vec<DVec3> = courses.iter().flatten().map(|frame| frame.origin).collect();
    let low = origins.iter().fold(DVec3::INFINITY, |low, &p| low.min(p));
    let high = origins.iter().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
    let size = (high - low).length();
    let arm = ARM * if size > 0.0 { size } else { 1.0 };
    let floor = low.y - arm;
    let inner = area.inside(24.0, 40.0, 34.0);
    let base = [[low.x, low.z], [high.x, low.z], [high.x, high.z], [low.x, high.z]];
    let base = base.map(|[x, z]| DVec3::new(x, floor, z));
    let base = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .iter()
        .zip(base)
        .map(|(&(x, z), corner)| corner + DVec3::new(x, 0.0, z) * arm)
        .collect::<Vec<_>>();
    let reach: Vec<DVec3> = courses
        .iter()
        .flatten()
        .flat_map(|frame| [frame.normal, frame.binormal].map(|w| frame.origin + w * arm))
        .chain(base.iter().copied())
        .collect();
    let view = View::of(&reach, inner);
    ground(page, &view, &base, &courses, floor);
    for (sweep, course) in parts.iter().zip(&courses) {
        if sweep.shape.trajectory.is_rotation() {
            axis(page, &view, sweep);
        }
        curve(page, &view, sweep, course, arm);
    }
    view.axes(page, DVec2::new(area.x + 42.0, area.y + area.height - 34.0), 18.0);
    legend(page, area, parts.iter().any(|sweep| !sweep.shape.trajectory.closed()));
}

/// Returns frames along a trajectory, with its twist. The frames of a rotation are on the circle of its
/// widest point.
pub fn frames(sweep: &Sweep, pieces: usize) -> Vec<Frame> {
    let (radius, height) = widest(sweep);
    let frame_at = |i: usize| {
        let v = i as f64 / pieces as f64;
        let stop = if i == pieces { Stop::before(v) } else { Stop::after(v) };
        let frame = *sweep.shape.modulation.section(&sweep.shape.trajectory, stop).frame();
        let out = frame.normal * radius + frame.binormal * height;
        let place = sweep.shape.place;
        Frame {
            origin: place.point(frame.origin + out + sweep.shape.position),
            tangent: place.direction(frame.tangent),
            normal: place.direction(frame.normal),
            binormal: place.direction(frame.binormal),
        }
    };
    (0..=pieces).map(frame_at).collect()
}

/// Returns the widest point of a rotation's contour; the origin for other trajectories.
fn widest(sweep: &Sweep) -> (f64, f64) {
    if !sweep.shape.trajectory.is_rotation() {
        return (0.0, 0.0);
    }
    let (columns, _) = sweep.lines();
    let widest = columns.iter().map(|column| column.first.point).max_by(|a, b| a.x.total_cmp(&b.x));
    widest.map_or((0.0, 0.0), |p| (p.x, p.y))
}

fn ground(page: &mut Page, view: &View, base: &[DVec3], courses: &[Vec<Frame>], floor: f64) {
    let flat: Vec<DVec2> = base.iter().map(|&p| view.page(p)).collect();
    page.polygon(&flat, "#faf9f5", Pen::new("#ebe7dd", 1.0));
    for part in [0.25, 0.5, 0.75] {
        for [a, b, c, d] in [[0, 1, 3, 2], [0, 3, 1, 2]] {
            let ends = [flat[a].lerp(flat[b], part), flat[c].lerp(flat[d], part)];
            page.line(&ends, false, Pen::new("#f0ece3", 0.8));
        }
    }
    for course in courses {
        let shadow: Vec<DVec2> = course.iter().map(|f| view.page(f.origin.with_y(floor))).collect();
        page.line(&shadow, false, Pen::new("#e2ddd0", 2.6));
    }
}

/// Draws a piece of a rotation's axis, beside its contour.
fn axis(page: &mut Page, view: &View, sweep: &Sweep) {
    let frame = *sweep.shape.modulation.section(&sweep.shape.trajectory, Stop::after(0.0)).frame();
    let (radius, height) = widest(sweep);
    let middle = frame.origin + sweep.shape.position + frame.binormal * height;
    let arm = frame.binormal * (0.22 * radius);
    let ends = [middle - arm, middle + arm].map(|p| view.page(sweep.shape.place.point(p)));
    page.line(&ends, false, Pen::new(ink::MUTED, 1.1).dashed("9 3 2 3"));
    page.text(ends[1] + DVec2::new(0.0, -4.0), 10.0, ink::MUTED, Anchor::Middle, "axis");
}

/// An element of the drawing; elements are drawn from far to near.
enum Item {
    Piece([DVec2; 2]),
    Halo([DVec2; 2]),
    Arm([DVec2; 2], &'static str),
}

fn curve(page: &mut Page, view: &View, sweep: &Sweep, course: &[Frame], arm: f64) {
    let mut items: Vec<(f64, Item)> = Vec::new();
    for pair in course.windows(2) {
        let middle = 0.5 * (pair[0].origin + pair[1].origin);
        let ends = [view.page(pair[0].origin), view.page(pair[1].origin)];
        let depth = view.depth(middle);
        items.push((depth, Item::Piece(ends)));
        // Each piece has a halo in the background colour, which interrupts farther pieces but not its
        // neighbours.
        let rise = view.depth(pair[1].origin) - view.depth(pair[0].origin);
        items.push((depth - 4.0 * ends[0].distance(ends[1]).hypot(rise), Item::Halo(ends)));
    }
    let closed = sweep.shape.trajectory.closed();
    for frame in frames(sweep, if closed { STATIONS } else { STATIONS - 1 }).iter().take(STATIONS) {
        for (direction, color) in [(frame.normal, ink::W1), (frame.binormal, ink::W2)] {
            let tip = frame.origin + direction * arm;
            let depth = view.depth(0.5 * (frame.origin + tip));
            items.push((depth, Item::Arm([view.page(frame.origin), view.page(tip)], color)));
        }
    }
    items.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, item) in &items {
        match item {
            Item::Piece(ends) => page.line(ends, false, Pen::new(ink::CURVE, 2.2)),
            Item::Halo(ends) => page.line(ends, false, Pen::new(ink::PANEL, 6.5)),
            Item::Arm(ends, color) => page.line(ends, false, Pen::new(color, 1.3)),
        }
    }
    if let [first, .., last] = course {
        let along = |from: &Frame, to: &Frame| view.page(to.origin) - view.page(from.origin);
        if !closed {
            page.dot(view.page(last.origin), 4.6, ink::END, Pen::new(ink::PANEL, 1.4));
        }
        let part = course.len() / 12;
        let ahead = &course[part];
        let direction = along(&course[part - 1], ahead);
        page.arrow(
            view.page(ahead.origin) + direction.normalize_or(DVec2::X) * 5.0,
            direction,
            10.0,
            ink::CURVE,
        );
        page.dot(view.page(first.origin), 4.6, ink::START, Pen::new(ink::PANEL, 1.4));
    }
}

fn legend(page: &mut Page, area: Area, ends: bool) {
    let y = area.y + area.height - 13.0;
    let mut x = area.x + area.width - 14.0;
    for (word, color, width) in [
        ("end", ink::END, 18.0),
        ("start", ink::START, 25.0),
        ("w2", ink::W2, 16.0),
        ("w1", ink::W1, 16.0),
    ]
    .into_iter()
    .skip(usize::from(!ends))
    {
        page.text(DVec2::new(x, y), 10.5, ink::MUTED, Anchor::End, word);
        page.dot(DVec2::new(x - width - 6.0, y - 3.5), 3.0, color, Pen::new(ink::PANEL, 0.0));
        x -= width + 22.0;
    }
}
