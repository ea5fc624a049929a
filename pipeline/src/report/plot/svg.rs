//! Writes SVG elements. Coordinates are in pixels, with y down.

use maud::Escaper;
use std::fmt::{self, Write};

/// The part of a text that lies at its position.
#[derive(Debug, Clone, Copy)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// The SVG elements written so far. Their classes decide their look.
#[derive(Debug, Default)]
pub struct Svg(pub String);

impl Svg {
    pub fn circle(&mut self, class: &str, x: f64, y: f64, radius: f64) {
        let (x, y, radius) = (Digits(x), Digits(y), Digits(radius));
        self.put(format_args!("<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>"));
    }

    pub fn rectangle(&mut self, class: &str, from: (f64, f64), size: (f64, f64)) {
        let (x, y, width, height) =
            (Digits(from.0), Digits(from.1), Digits(size.0), Digits(size.1));
        self.put(format_args!(
            "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/>"
        ));
    }

    pub fn line(&mut self, class: &str, points: &[(f64, f64)]) {
        self.put(format_args!("<path class=\"{class}\" d=\"{}\"/>", Course(points)));
    }

    pub fn polygon(&mut self, class: &str, points: &[(f64, f64)]) {
        self.put(format_args!("<path class=\"{class}\" d=\"{}Z\"/>", Course(points)));
    }

    pub fn text(&mut self, class: &str, x: f64, y: f64, anchor: Anchor, text: &str) {
        let (x, y) = (Digits(x), Digits(y));
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let _ =
            write!(self.0, "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">");
        let _ = Escaper::new(&mut self.0).write_str(text);
        self.0.push_str("</text>\n");
    }

    /// Opens a group with a name that appears under the mouse. The group ends at [`Svg::end`].
    pub fn named(&mut self, name: &str) {
        self.0.push_str("<g><title>");
        let _ = Escaper::new(&mut self.0).write_str(name);
        self.0.push_str("</title>");
    }

    pub fn end(&mut self) {
        self.0.push_str("</g>\n");
    }

    fn put(&mut self, element: fmt::Arguments<'_>) {
        let _ = writeln!(self.0, "{element}");
    }
}

/// A coordinate, rounded to a tenth of a pixel.
struct Digits(f64);

impl fmt::Display for Digits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tenths = (self.0 * 10.0).round() / 10.0;
        write!(f, "{}", if tenths.is_finite() { tenths + 0.0 } else { 0.0 })
    }
}

struct Course<'a>(&'a [(f64, f64)]);

impl fmt::Display for Course<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, &(x, y)) in self.0.iter().enumerate() {
            write!(f, "{}{} {}", if k == 0 { 'M' } else { 'L' }, Digits(x), Digits(y))?;
        }
        Ok(())
    }
}
