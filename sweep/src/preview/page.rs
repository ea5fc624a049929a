//! A page of SVG: shapes and words at pixel coordinates, with y down.

use files::svg::Svg;
use glam::{DVec2, DVec3};
use std::fmt::{self, Display};

pub use files::svg::Anchor;

/// Width of the page in pixels.
pub const WIDTH: f64 = 1200.0;

/// Height of the page in pixels.
pub const HEIGHT: f64 = 900.0;

/// Colours of the page.
pub mod ink {
    pub const PAPER: &str = "#f7f5f0";
    pub const PANEL: &str = "#ffffff";
    pub const RIM: &str = "#e3ded3";
    pub const TEXT: &str = "#2c3238";
    pub const MUTED: &str = "#7d848a";
    pub const FAINT: &str = "#d9d6ce";
    pub const CURVE: &str = "#2f5d86";
    pub const W1: &str = "#c8553d";
    pub const W2: &str = "#4f9a6b";
    pub const START: &str = "#2e8b6f";
    pub const END: &str = "#8b3a62";
    pub const SEAM: &str = "#d9962b";
    pub const CREASE: &str = "#1f3a56";
    pub const FOLD: &str = "#d0342c";
    pub const FONT: &str = "Helvetica, Arial, 'DejaVu Sans', sans-serif";
}

/// A rectangle of the page, in pixels.
#[derive(Debug, Clone, Copy)]
pub struct Area {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

impl Area {
    pub fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { x, y, width, height }
    }

    /// Returns the rectangle without margins to the left and right (`side`), above and below.
    pub fn inside(self, side: f64, above: f64, below: f64) -> Self {
        let (width, height) = (self.width - 2.0 * side, self.height - above - below);
        Self::new(self.x + side, self.y + above, width, height)
    }

    pub fn center(self) -> DVec2 {
        DVec2::new(self.x + 0.5 * self.width, self.y + 0.5 * self.height)
    }
}

/// Style of a line.
#[derive(Debug, Clone, Copy)]
pub struct Pen<'a> {
    pub color: &'a str,
    pub width: f64,
    /// Lengths of dashes and gaps in pixels; empty for a solid line.
    pub dashes: &'a str,
}

impl<'a> Pen<'a> {
    pub fn new(color: &'a str, width: f64) -> Self {
        Self { color, width, dashes: "" }
    }

    pub fn dashed(self, dashes: &'a str) -> Self {
        Self { dashes, ..self }
    }
}

impl Display for Pen<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.width > 0.0 {
            write!(f, " stroke=\"{}\" stroke-width=\"{}\"", self.color, self.width)?;
        }
        if !self.dashes.is_empty() {
            write!(f, " stroke-dasharray=\"{}\"", self.dashes)?;
        }
        Ok(())
    }
}

/// The page written so far.
#[derive(Debug)]
pub struct Page(Svg);

impl Page {
    pub fn new() -> Self {
        let font = ink::FONT;
        let style =
            format!("font-family=\"{font}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"");
        let mut svg = Svg::new(WIDTH, HEIGHT, style);
        svg.background(WIDTH, HEIGHT, format_args!("fill=\"{}\"", ink::PAPER));
        Self(svg)
    }

    pub fn finish(self) -> String {
        self.0.finish()
    }

    /// Opens a group that is filled with this opacity.
    pub fn open_group(&mut self, opacity: f64) {
        self.0.open_group(format_args!("fill-opacity=\"{opacity}\""));
    }

    pub fn close_group(&mut self) {
        self.0.close_group();
    }

    /// Draws a panel with its heading and a note.
    pub fn panel(&mut self, area: Area, heading: &str, note: &str) {
        let Area { x, y, width, height } = area;
        let style = format_args!("rx=\"8\" fill=\"{}\" stroke=\"{}\"", ink::PANEL, ink::RIM);
        self.0.rectangle((x, y), (width, height), style);
        let at = DVec2::new(x + 14.0, y + 23.0);
        self.text(at, 13.0, ink::TEXT, Anchor::Start, heading);
        self.text(DVec2::new(x + width - 14.0, at.y), 11.0, ink::MUTED, Anchor::End, note);
    }

    pub fn text(&mut self, at: DVec2, size: f64, color: &str, anchor: Anchor, text: &str) {
        if !text.is_empty() {
            let style = format_args!("font-size=\"{size}\" fill=\"{color}\"");
            self.0.text(at, anchor, style, text);
        }
    }

    /// Draws straight lines from point to point.
    pub fn line(&mut self, points: &[DVec2], closed: bool, pen: Pen<'_>) {
        if closed {
            self.polygon(points, "none", pen);
        } else {
            self.0.line(points, format_args!("fill=\"none\"{pen}"));
        }
    }

    /// Draws a filled polygon; with a pen width of 0 it has no outline.
    pub fn polygon(&mut self, points: &[DVec2], fill: &str, pen: Pen<'_>) {
        self.0.polygon(points, format_args!("fill=\"{fill}\"{pen}"));
    }

    pub fn dot(&mut self, at: DVec2, radius: f64, fill: &str, pen: Pen<'_>) {
        self.0.circle(at, radius, format_args!("fill=\"{fill}\"{pen}"));
    }

    /// Draws the head of an arrow that ends at `tip`.
    pub fn arrow(&mut self, tip: DVec2, direction: DVec2, size: f64, color: &str) {
        let along = direction.normalize_or(DVec2::X) * size;
        let (back, side) = (tip - along, along.perp() * 0.42);
        self.polygon(&[tip, back + side, back - side], color, Pen::new(color, 0.0));
    }
}

/// A parallel projection of space along a direction, fitted into a rectangle.
#[derive(Debug, Clone, Copy)]
pub struct View {
    right: DVec3,
    up: DVec3,
    toward: DVec3,
    scale: f64,
    middle: DVec2,
    center: DVec2,
    /// Divisor of all coordinates, so that none is too large for calculations.
    unit: f64,
}

impl View {
    /// Returns the view from the front, slightly from the right and from above, that shows all points.
    pub fn of(points: &[DVec3], area: Area) -> Self {
        let toward = DVec3::new(0.42, 0.44, 0.79).normalize();
        let right = DVec3::Y.cross(toward).normalize();
        let up = toward.cross(right);
        let largest = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let flat = |p: &DVec3| DVec2::new((*p / unit).dot(right), -(*p / unit).dot(up));
        let (low, high) = bounds(points.iter().map(flat));
        let size = (high - low).max(DVec2::splat(1e-12));
        let scale = (area.width / size.x).min(area.height / size.y);
        Self { right, up, toward, scale, middle: 0.5 * (low + high), center: area.center(), unit }
    }

    /// Returns the position of a point on the page, in pixels.
    pub fn page(&self, p: DVec3) -> DVec2 {
        let p = p / self.unit;
        let flat = DVec2::new(p.dot(self.right), -p.dot(self.up));
        self.center + (flat - self.middle) * self.scale
    }

    /// Returns the nearness of a point to the viewer, in pixels.
    pub fn depth(&self, p: DVec3) -> f64 {
        (p / self.unit).dot(self.toward) * self.scale
    }

    /// Returns a direction in the viewer's axes: to the right, up, and toward the viewer.
    pub fn seen(&self, direction: DVec3) -> DVec3 {
        DVec3::new(direction.dot(self.right), direction.dot(self.up), direction.dot(self.toward))
    }

    /// Draws the three coordinate axes with their letters.
    pub fn axes(&self, page: &mut Page, at: DVec2, length: f64) {
        for (axis, name) in [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")] {
            let seen = self.seen(axis);
            let direction = DVec2::new(seen.x, -seen.y);
            let tip = at + direction * length;
            page.line(&[at, tip], false, Pen::new(ink::MUTED, 1.2));
            page.arrow(tip, direction, 6.0, ink::MUTED);
            let word = at + direction * (length + 9.0) + DVec2::Y * 3.5;
            page.text(word, 11.0, ink::MUTED, Anchor::Middle, name);
        }
    }
}

/// Returns the corners of the bounding box of points; the origin twice for no points.
pub fn bounds(points: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = points.fold(none, |(low, high), p| (low.min(p), high.max(p)));
    if low.x <= high.x { (low, high) } else { (DVec2::ZERO, DVec2::ZERO) }
}
