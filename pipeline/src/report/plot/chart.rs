//! A chart of curves over two logarithmic axes.

use super::axis::{Axis, Tick};
use super::look::Look;
use files::svg::{Anchor, Class, Svg};

/// A chart of curves over two logarithmic axes.
#[derive(Debug, Clone)]
pub struct Chart {
    /// The title above the chart.
    pub title: Option<String>,
    /// The horizontal axis.
    pub across: Axis,
    /// The vertical axis.
    pub up: Axis,
    /// The curves.
    pub series: Vec<Series>,
    /// A shaded band at the bottom.
    pub band: Option<Band>,
    /// The Pareto front, points `(x, y)` from left to right. Its line continues to both sides.
    pub front: Vec<(f64, f64)>,
    /// Marks with explanations, written beside the curves' names.
    pub key: Vec<(Look, String)>,
}

/// A curve, or separate points.
#[derive(Debug, Clone)]
pub struct Series {
    /// The name written at the end of the curve; empty for none.
    pub name: String,
    /// The look of line and marks.
    pub look: Look,
    /// True if a line joins the points.
    pub joined: bool,
    /// The points, in the order in which the line joins them.
    pub points: Vec<Point>,
}

/// A point of a curve. A point that the axes cannot show, such as one at 0, is left out.
#[derive(Debug, Clone, Default)]
pub struct Point {
    /// Value on the horizontal axis.
    pub x: f64,
    /// Value on the vertical axis.
    pub y: f64,
    /// A description that appears under the mouse.
    pub name: String,
    /// A short note beside the point.
    pub note: Option<String>,
}

/// A shaded band from a value down to the bottom of the chart.
#[derive(Debug, Clone)]
pub struct Band {
    /// The value at the band's upper edge.
    pub up_to: f64,
    /// The text in the band.
    pub label: String,
}

/// The size of a drawn chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// For a desktop screen: 780 by 480 pixels.
    Wide,
    /// For a telephone: 390 by 420 pixels.
    Narrow,
    /// For one of several charts: 400 by 300 pixels.
    Small,
}

/// The rectangle that the axes enclose, in pixels with y down.
#[derive(Debug, Clone, Copy)]
struct Frame {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

/// Distance between lines of text, in pixels.
const LINE: f64 = 17.0;

/// Least distance between labels of the horizontal axis, in pixels.
const LABEL: f64 = 48.0;

/// Least width of the column of curve names, in pixels.
const NAMES: f64 = 104.0;

/// Width of a mark before a name with the gaps around it, and of a letter of a name, in pixels.
const MARK: f64 = 30.0;
const LETTER: f64 = 7.6;

impl Size {
    fn pixels(self) -> (f64, f64) {
        match self {
            Self::Wide => (780.0, 480.0),
            Self::Narrow => (390.0, 420.0),
            Self::Small => (400.0, 300.0),
        }
    }

    fn radius(self) -> f64 {
        if self == Self::Wide { 5.0 } else { 4.0 }
    }
}

impl Chart {
    /// Returns an SVG element for an HTML page that has [`super::STYLE`]. `about` describes the chart.
    #[must_use]
    pub fn inline(&self, size: Size, about: &str) -> String {
        self.drawn(size, about, None)
    }

    /// Returns an SVG file of its own, with style and background.
    #[must_use]
    pub fn file(&self, about: &str) -> String {
        self.drawn(Size::Wide, about, Some(super::STYLE))
    }

    /// Draws the chart. A drawing with a style sheet of its own also has a background.
    fn drawn(&self, size: Size, about: &str, style_sheet: Option<&str>) -> String {
        let (width, height) = size.pixels();
        let top = if self.title.is_some() { 52.0 } else { 32.0 };
        let names = self.series.iter().map(|series| &series.name);
        let words = names.chain(self.key.iter().map(|(_, words)| words));
        let longest = words.map(|word| word.chars().count()).max().unwrap_or(0);
        let right = match longest {
            0 => width - 16.0,
            letters => width - NAMES.max(MARK + LETTER * letters as f64),
        };
        let frame = Frame { left: 56.0, top, right, bottom: height - 46.0 };
        let mut svg = Svg::new(width, height, "class=\"plot\" role=\"img\"");
        if let Some(rules) = style_sheet {
            svg.style_sheet(rules);
            svg.background(width, height, Class("ground"));
        }
        svg.open_named_group(about);
        if let Some(title) = &self.title {
            svg.text((12.0, 22.0), Anchor::Start, Class("title"), title);
        }
        self.axes(&mut svg, frame);
        self.shade(&mut svg, frame);
        self.staircase(&mut svg, frame);
        for series in &self.series {
            self.curve(&mut svg, frame, series, size.radius());
        }
        self.notes(&mut svg, frame);
        self.names(&mut svg, frame, size.radius());
        svg.close_group();
        svg.finish()
    }

    fn axes(&self, svg: &mut Svg, frame: Frame) {
        let ticks = self.across.ticks();
        let labels = self.labels(&ticks, frame);
        for (tick, labelled) in ticks.iter().zip(labels) {
            let Some(x) = self.across.part(tick.at).map(|part| frame.x(part)) else { continue };
            if let Some(label) = tick.label.as_ref().filter(|_| labelled) {
                svg.line(&[(x, frame.top), (x, frame.bottom)], Class("grid"));
                svg.text((x, frame.bottom + 17.0), Anchor::Middle, Class("faint small"), label);
            } else {
                svg.line(&[(x, frame.bottom), (x, frame.bottom + 3.0)], Class("rim"));
            }
        }
        for tick in self.up.ticks() {
            let Some(y) = self.up.part(tick.at).map(|part| frame.y(part)) else { continue };
            if let Some(label) = &tick.label {
                svg.line(&[(frame.left, y), (frame.right, y)], Class("grid"));
                svg.text((frame.left - 7.0, y + 4.0), Anchor::End, Class("faint small"), label);
            } else {
                svg.line(&[(frame.left - 3.0, y), (frame.left, y)], Class("rim"));
            }
        }
        let corners = [frame.left, frame.right].map(|x| (x, frame.bottom));
        svg.line(&[(frame.left, frame.top), corners[0], corners[1]], Class("rim"));
        svg.text((12.0, frame.top - 12.0), Anchor::Start, Class("faint small"), &self.up.label);
        let middle = 0.5 * (frame.left + frame.right);
        svg.text(
            (middle, frame.bottom + 36.0),
            Anchor::Middle,
            Class("faint small"),
            &self.across.label,
        );
    }

    /// Returns which labels of the horizontal axis fit: powers of ten first, then others in between.
    fn labels(&self, ticks: &[Tick], frame: Frame) -> Vec<bool> {
        let mut taken: Vec<f64> = Vec::new();
        let mut shown = vec![false; ticks.len()];
        for whole in [true, false] {
            for (tick, shown) in ticks.iter().zip(&mut shown) {
                let starts = |label: &String| label.starts_with('1') == whole;
                let Some(part) = self.across.part(tick.at) else { continue };
                let x = frame.x(part);
                let free = taken.iter().all(|other| (x - other).abs() >= LABEL);
                if tick.label.as_ref().is_some_and(starts) && free {
                    taken.push(x);
                    *shown = true;
                }
            }
        }
        shown
    }

    fn shade(&self, svg: &mut Svg, frame: Frame) {
        let Some(band) = &self.band else { return };
        let x = frame.left + 8.0;
        let Some(part) = self.up.part(band.up_to).filter(|&part| part > 0.0) else {
            let label = format!("{}: below", band.label);
            svg.text((x, frame.bottom - 5.0), Anchor::Start, Class("faint tiny halo"), &label);
            return;
        };
        let top = frame.y(part.min(1.0));
        let size = (frame.right - frame.left, frame.bottom - top);
        svg.rectangle((frame.left, top), size, Class("band"));
        if frame.bottom - top > 14.0 {
            svg.text((x, frame.bottom - 5.0), Anchor::Start, Class("faint tiny"), &band.label);
        }
    }

    /// Draws the front as steps: for each time, the smallest error that costs no more.
    fn staircase(&self, svg: &mut Svg, frame: Frame) {
        let mut points: Vec<(f64, f64)> = Vec::new();
        for (x, y) in self.front.iter().filter_map(|&(x, y)| self.place(frame, x, y)) {
            points.push((x, points.last().map_or(frame.top, |last| last.1)));
            points.push((x, y));
        }
        if let Some(&(_, y)) = points.last() {
            points.push((frame.right, y));
            svg.line(&points, Class("front"));
        }
    }

    fn curve(&self, svg: &mut Svg, frame: Frame, series: &Series, radius: f64) {
        let class = series.look.class();
        if series.joined {
            let points: Vec<(f64, f64)> =
                series.points.iter().filter_map(|p| self.place(frame, p.x, p.y)).collect();
            svg.line(&points, Class(&format!("line {class}")));
        }
        for place in &series.points {
            let Some((x, y)) = self.place(frame, place.x, place.y) else { continue };
            svg.open_named_group(&place.name);
            series.look.draw(svg, x, y, radius);
            svg.close_group();
        }
    }

    /// Draws notes to the lower left of their points, since below a front there is nothing. A note that
    /// would overlap another is left out.
    fn notes(&self, svg: &mut Svg, frame: Frame) {
        let mut taken: Vec<(f64, f64)> = Vec::new();
        for place in self.series.iter().flat_map(|series| &series.points) {
            let Some(note) = &place.note else { continue };
            let Some((x, y)) = self.place(frame, place.x, place.y) else { continue };
            let at = (x - 6.0, y + 14.0);
            if taken
                .iter()
                .all(|other| (other.0 - at.0).abs() > 16.0 || (other.1 - at.1).abs() > 10.0)
            {
                svg.text((at.0, at.1), Anchor::End, Class("faint tiny halo"), note);
                taken.push(at);
            }
        }
    }

    /// Draws the names of the curves, one below the other in the order of the curves' ends. Each name
    /// has its mark and a fine line to the curve's end.
    fn names(&self, svg: &mut Svg, frame: Frame, radius: f64) {
        let mut ends: Vec<(f64, f64, &Series)> = self
            .series
            .iter()
            .filter(|series| !series.name.is_empty())
            .filter_map(|series| {
                let last = series.points.iter().rev();
                let mut last = last.filter_map(|p| self.place(frame, p.x, p.y));
                last.next().map(|(x, y)| (x, y, series))
            })
            .collect();
        ends.sort_by(|a, b| a.1.total_cmp(&b.1));
        let heights = stacked(&ends.iter().map(|end| end.1).collect::<Vec<_>>(), frame);
        let (start, gap) = (frame.right + 14.0, radius + 6.0);
        for ((x, y, series), height) in ends.iter().zip(&heights) {
            let leader = [(x + radius + 2.0, *y), (frame.right, *y), (start - radius, *height)];
            svg.line(&leader, Class(&format!("leader {}", series.look.class())));
            series.look.draw(svg, start, *height, radius);
            let class = series.look.class();
            svg.text((start + gap, height + 4.5), Anchor::Start, Class(&class), &series.name);
        }
        let below = heights.last().map_or(frame.top, |last| last + 0.6 * LINE);
        for (k, (look, words)) in self.key.iter().enumerate() {
            let mut height = below + LINE * (k as f64 + 1.0);
            if height > frame.bottom {
                height = frame.top + LINE * k as f64;
            }
            look.draw(svg, start, height, radius - 0.5);
            svg.text((start + gap, height + 3.5), Anchor::Start, Class("faint tiny"), words);
        }
    }

    fn place(&self, frame: Frame, x: f64, y: f64) -> Option<(f64, f64)> {
        let (x, y) = (self.across.part(x)?, self.up.part(y)?);
        let inside = |part: f64| (-1e-9..=1.0 + 1e-9).contains(&part);
        (inside(x) && inside(y)).then(|| (frame.x(x), frame.y(y)))
    }
}

impl Frame {
    fn x(self, part: f64) -> f64 {
        self.left + part * (self.right - self.left)
    }

    fn y(self, part: f64) -> f64 {
        self.bottom + part * (self.top - self.bottom)
    }
}

/// Returns heights near the wished ones, which ascend, at least one line of text apart.
fn stacked(wished: &[f64], frame: Frame) -> Vec<f64> {
    let mut heights: Vec<f64> = Vec::with_capacity(wished.len());
    for &wish in wished {
        let least = heights.last().map_or(f64::NEG_INFINITY, |last| last + LINE);
        heights.push(wish.max(least));
    }
    let mut most = frame.bottom;
    for height in heights.iter_mut().rev() {
        *height = height.min(most);
        most = *height - LINE;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::super::axis::Unit;
    use super::*;

    const FRAME: Frame = Frame { left: 0.0, top: 0.0, right: 100.0, bottom: 100.0 };

    fn chart(places: &[(f64, f64)]) -> Chart {
        let values = |k: fn(&(f64, f64)) -> f64| places.iter().map(k).collect::<Vec<_>>();
        let axis = |v: Vec<f64>| Axis::around("a & b", Unit::Plain, v.into_iter());
        let place = |&(x, y): &(f64, f64)| Point { x, y, name: "<p>".into(), note: None };
        Chart {
            title: None,
            across: axis(values(|p| p.0)),
            up: axis(values(|p| p.1)),
            series: vec![Series {
                name: "curve".into(),
                look: Look::number(1),
                joined: true,
                points: places.iter().map(place).collect(),
            }],
            band: Some(Band { up_to: 1e-9, label: "noise".into() }),
            front: Vec::new(),
            key: Vec::new(),
        }
    }

    #[test]
    fn names_keep_their_order_and_their_distance_within_the_frame() {
        let heights = stacked(&[5.0, 6.0, 50.0, 98.0, 99.0], FRAME);
        assert!(heights.windows(2).all(|w| w[1] - w[0] >= LINE - 1e-9), "{heights:?}");
        assert_eq!(heights[0], 5.0);
        assert_eq!(*heights.last().unwrap(), 100.0);
    }

    #[test]
    fn a_place_is_drawn_where_its_logarithms_lie_and_others_not_at_all() {
        let mut chart = chart(&[(0.1, 0.01), (1.0, 0.1), (10.0, 1.0)]);
        let middle = chart.place(FRAME, 1.0, 0.1).unwrap();
        assert!((middle.0 - 50.0).abs() < 1e-9 && (middle.1 - 50.0).abs() < 1e-9, "{middle:?}");
        for (x, y) in [(0.0, 0.1), (1.0, f64::NAN), (1e9, 0.1), (-1.0, 0.1)] {
            assert_eq!(chart.place(FRAME, x, y), None);
        }
        chart.series[0].points.push(Point { x: f64::NAN, y: 0.0, ..Point::default() });
        let circles = chart.inline(Size::Wide, "about").matches("<circle").count();
        // Three points, and the mark beside the name.
        assert_eq!(circles, 4);
    }

    #[test]
    fn a_drawing_is_sound_and_a_file_stands_alone() {
        let chart = chart(&[(0.1, 0.01), (1.0, 0.1)]);
        let text = chart.file("a < b");
        assert!(text.contains("<style>") && text.contains("class=\"ground\""));
        assert!(text.contains("a &lt; b") && text.contains("a &amp; b") && text.contains("&lt;p"));
        assert!(!text.contains("NaN") && !text.contains("inf"));
        for tag in ["svg", "g", "text", "title", "style"] {
            let opened = text.matches(&format!("<{tag}>")).count()
                + text.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, text.matches(&format!("</{tag}>")).count(), "{tag}");
        }
        let inline = chart.inline(Size::Small, "");
        assert!(!inline.contains("<style>") && !inline.contains("\"ground\""));
    }
}
