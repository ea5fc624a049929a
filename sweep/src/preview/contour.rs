//! The panel of the contour in its plane: start, direction, creases, axes, and a scale bar.

use super::page::{Anchor, Area, Page, Pen, bounds, ink};
use crate::check::short;
use crate::curve::cut::{self, Stop};
use crate::sampling::Sweep;
use glam::DVec2;

/// Number of points at which a contour is drawn.
const PLACES: usize = 480;

/// Largest number of contours of one sweep that are drawn, starting with the first.
const MOST: usize = 6;

/// Largest number of sweeps drawn side by side.
const MOST_PARTS: usize = 4;

/// Colours of successive contours.
const SHADES: [&str; 6] = ["#2f5d86", "#6a51a3", "#a23b72", "#c8553d", "#b8860b", "#4f9a6b"];

pub fn draw(page: &mut Page, area: Area, parts: &[Sweep]) {
    let shown = &parts[..parts.len().min(MOST_PARTS)];
    let more = parts.len() - shown.len();
    let note = if more > 0 { format!("and {more} more") } else { lengths(parts) };
    page.panel(area, if parts.len() > 1 { "Contours" } else { "Contour" }, &note);
    let width = area.width / shown.len() as f64;
    for (i, sweep) in shown.iter().enumerate() {
        let panel = Area::new(area.x + width * i as f64, area.y, width, area.height);
        one(page, panel, sweep, parts.len() > 1);
    }
}

fn lengths(parts: &[Sweep]) -> String {
    let [sweep] = parts else { return String::new() };
    let kind = if sweep.shape.contour.closed() { "closed" } else { "open" };
    let creases = match sweep.shape.contour.creases() {
        0 => String::new(),
        1 => ", 1 crease".into(),
        creases => format!(", {creases} creases"),
    };
    format!("{kind}, {} long{creases}", short(sweep.shape.contour.length()))
}

fn one(page: &mut Page, area: Area, sweep: &Sweep, named: bool) {
    let inner = area.inside(30.0, 42.0, if named { 60.0 } else { 44.0 });
    let contour = &sweep.shape.contour;
    let stops = cut::evenly(contour.breaks(), contour.closed(), PLACES.max(contour.fewest_cells()));
    let columns = contour.columns(&stops);
    let shown = contour.contours().min(MOST);
    let point = |col: usize, one: usize| match one {
        0 => columns[col].first,
        _ => columns[col].others[one - 1],
    };
    let all = (0..shown).flat_map(|one| (0..columns.len()).map(move |col| (col, one)));
    let (low, high) = bounds(all.map(|(col, one)| point(col, one).point));
    let size = (high - low).max_element();
    // The origin is included unless it is so far away that the contour would become small.
    let (low, high) = match (low.min(DVec2::ZERO), high.max(DVec2::ZERO)) {
        (from, to) if (to - from).max_element() <= 3.0 * size => (from, to),
        _ => (low, high),
    };
    let extent = (high - low).max(DVec2::splat(1e-3 * size));
    let scale = (inner.width / extent.x).min(inner.height / extent.y);
    let flat = |p: DVec2| {
        let from_middle = (p - 0.5 * (low + high)) * scale;
        inner.center() + DVec2::new(from_middle.x, -from_middle.y)
    };
    axes(page, inner, flat(DVec2::ZERO), sweep.shape.trajectory.is_rotation());
    origin(page, inner, flat(DVec2::ZERO), 0.5 * (low + high));
    for (one, color) in SHADES.into_iter().enumerate().take(shown) {
        let points: Vec<DVec2> =
            (0..columns.len()).map(|col| flat(point(col, one).point)).collect();
        if contour.closed() && one == 0 {
            page.polygon(&points, "#eef3f8", Pen::new(color, 1.8));
        } else {
            page.line(&points, contour.closed(), Pen::new(color, 1.8));
        }
        for at in contour.breaks() {
            let col = stops.partition_point(|stop| stop.at < *at);
            let p = points[col.min(points.len() - 1)];
            let diamond = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y].map(|d| p + d * 3.6);
            page.polygon(&diamond, ink::PANEL, Pen::new(ink::CREASE, 1.1));
        }
        for u in if one == 0 { &[0.12, 0.62][..] } else { &[0.12][..] } {
            let local = contour.at(smooth(contour.breaks(), *u));
            let local = if one == 0 { local.first } else { local.others[one - 1] };
            let along = DVec2::new(local.tangent.x, -local.tangent.y);
            page.arrow(flat(local.point) + along * 5.0, along, 10.0, color);
        }
        let first = contour.columns(&[Stop::after(0.0)]);
        let first = if one == 0 { first[0].first } else { first[0].others[one - 1] };
        page.dot(flat(first.point), 4.2, ink::START, Pen::new(ink::PANEL, 1.4));
        if !contour.closed() {
            page.dot(points[points.len() - 1], 4.2, ink::END, Pen::new(ink::PANEL, 1.4));
        }
    }
    bar(page, DVec2::new(area.x + 14.0, area.y + area.height - 14.0), scale, inner.width);
    if named {
        let at = DVec2::new(area.x + 0.5 * area.width, area.y + area.height - 34.0);
        page.text(at, 11.0, ink::TEXT, Anchor::Middle, sweep.name());
    }
}

/// Returns the middle of the piece between creases that contains `u`; without creases, `u` itself.
fn smooth(breaks: &[f64], u: f64) -> f64 {
    if breaks.is_empty() {
        return u;
    }
    let next = breaks.partition_point(|&at| at <= u);
    let from = if next == 0 { 0.0 } else { breaks[next - 1] };
    0.5 * (from + breaks.get(next).copied().unwrap_or(1.0))
}

/// Draws the axes that pass through the panel.
fn axes(page: &mut Page, inner: Area, origin: DVec2, rotation: bool) {
    let Area { x, y, width, height } = inner;
    let (right, below) = (x + width + 12.0, y + height + 12.0);
    let pen = Pen::new(ink::FAINT, 1.0);
    if (x - 1.0..=x + width + 1.0).contains(&origin.x) {
        let ends = [DVec2::new(origin.x, below), DVec2::new(origin.x, y - 12.0)];
        let pen = if rotation { Pen::new(ink::MUTED, 1.1).dashed("9 3 2 3") } else { pen };
        page.line(&ends, false, pen);
        let word = if rotation { "axis" } else { "y" };
        page.text(ends[1] + DVec2::new(6.0, 5.0), 10.0, ink::MUTED, Anchor::Start, word);
    }
    if (y - 1.0..=y + height + 1.0).contains(&origin.y) {
        let ends = [DVec2::new(x - 12.0, origin.y), DVec2::new(right, origin.y)];
        page.line(&ends, false, pen);
        page.text(ends[1] + DVec2::new(2.0, -5.0), 10.0, ink::MUTED, Anchor::Middle, "x");
    }
}

/// Marks the contour's origin, which the trajectory carries. An origin beyond the panel is named with its position from
/// the middle of the contour.
fn origin(page: &mut Page, inner: Area, at: DVec2, middle: DVec2) {
    let Area { x, y, width, height } = inner;
    let pen = Pen::new(ink::MUTED, 1.4);
    if (x - 12.0..=x + width + 12.0).contains(&at.x)
        && (y - 12.0..=y + height + 12.0).contains(&at.y)
    {
        for arm in [DVec2::X * 5.0, DVec2::Y * 5.0] {
            page.line(&[at - arm, at + arm], false, pen);
        }
        return;
    }
    let ahead = (at - inner.center()).normalize_or_zero();
    let start = inner.center() + ahead * (0.5 * width.min(height));
    page.arrow(start + ahead * 10.0, ahead, 12.0, ink::MUTED);
    let text = format!("origin at {} {}", short(-middle.x), short(-middle.y));
    page.text(start - DVec2::Y * 8.0, 10.0, ink::MUTED, Anchor::Middle, &text);
}

/// Draws a scale bar of a round length.
fn bar(page: &mut Page, at: DVec2, scale: f64, width: f64) {
    let most = 0.3 * width / scale;
    let power = 10.0_f64.powf(most.log10().floor());
    let length = [5.0, 2.0, 1.0].map(|step| step * power).into_iter().find(|&l| l <= most);
    let length = length.unwrap_or(power);
    let end = at + DVec2::X * (length * scale);
    let tick = DVec2::Y * 3.0;
    for line in [[at, end], [at - tick, at + tick], [end - tick, end + tick]] {
        page.line(&line, false, Pen::new(ink::MUTED, 1.2));
    }
    page.text(end + DVec2::new(8.0, 4.0), 11.0, ink::MUTED, Anchor::Start, &short(length));
}
