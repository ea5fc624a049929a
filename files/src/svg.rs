//! Writes drawings as SVG: shapes and texts at pixel coordinates, with y down.
//!
//! Coordinates are rounded to a tenth of a pixel, and a coordinate that is not finite becomes 0. Each
//! element takes a style: the attributes that decide its look, such as [`Class`], in the form in which
//! SVG writes them. Texts are escaped, and characters that are not seen are replaced.

use crate::words::unseen;
use std::fmt::{self, Display, Write};

/// The part of a text that lies at the text's position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The start of the text.
    Start,
    /// The middle of the text.
    Middle,
    /// The end of the text.
    End,
}

/// A style: the class of an element, whose look is in a style sheet.
#[derive(Debug, Clone, Copy)]
pub struct Class<'a>(pub &'a str);

impl Display for Class<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "class=\"{}\"", self.0)
    }
}

/// A drawing that is being written.
#[derive(Debug)]
pub struct Svg(String);

impl Svg {
    /// Begins a drawing of `width` x `height` pixels. The style applies to the whole drawing.
    #[must_use]
    pub fn new(width: f64, height: f64, style: impl Display) -> Self {
        let mut svg = Self(String::with_capacity(1 << 14));
        svg.put(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" {style}>"
        ));
        svg
    }

    /// Returns the text of the whole drawing.
    #[must_use]
    pub fn finish(mut self) -> String {
        self.0.push_str("</svg>\n");
        self.0
    }

    /// Adds a style sheet.
    pub fn style_sheet(&mut self, rules: &str) {
        self.put(format_args!("<style>{rules}</style>"));
    }

    /// Fills the whole drawing, which has this size.
    pub fn background(&mut self, width: f64, height: f64, style: impl Display) {
        self.put(format_args!("<rect width=\"{width}\" height=\"{height}\" {style}/>"));
    }

    /// Opens a group that ends at [`Svg::close_group`].
    pub fn open_group(&mut self, style: impl Display) {
        self.put(format_args!("<g {style}>"));
    }

    /// Opens a group with a name that appears under the mouse. The group ends at [`Svg::close_group`].
    pub fn open_named_group(&mut self, name: &str) {
        self.put(format_args!("<g><title>{}</title>", Escaped(name)));
    }

    /// Closes the group that was opened last.
    pub fn close_group(&mut self) {
        self.0.push_str("</g>\n");
    }

    /// Draws a circle.
    pub fn circle(&mut self, middle: impl Into<(f64, f64)>, radius: f64, style: impl Display) {
        let (x, y) = pixels(middle);
        self.put(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {style}/>"));
    }

    /// Draws a rectangle from its upper left corner and its size.
    pub fn rectangle(
        &mut self,
        corner: impl Into<(f64, f64)>,
        size: impl Into<(f64, f64)>,
        style: impl Display,
    ) {
        let ((x, y), (width, height)) = (pixels(corner), pixels(size));
        self.put(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {style}/>"
        ));
    }

    /// Draws straight lines from point to point.
    pub fn line<P: Into<(f64, f64)> + Copy>(&mut self, points: &[P], style: impl Display) {
        self.put(format_args!("<path d=\"{}\" {style}/>", Course(points)));
    }

    /// Draws straight lines from point to point and back to the first.
    pub fn polygon<P: Into<(f64, f64)> + Copy>(&mut self, points: &[P], style: impl Display) {
        self.put(format_args!("<path d=\"{}Z\" {style}/>", Course(points)));
    }

    /// Draws one line of text.
    pub fn text(
        &mut self,
        at: impl Into<(f64, f64)>,
        anchor: Anchor,
        style: impl Display,
        text: &str,
    ) {
        let (x, y) = pixels(at);
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let text = Escaped(text);
        self.put(format_args!("<text x=\"{x}\" y=\"{y}\" {style}{anchor}>{text}</text>"));
    }

    fn put(&mut self, element: fmt::Arguments<'_>) {
        let _ = writeln!(self.0, "{element}");
    }
}

/// A coordinate, rounded to a tenth of a pixel.
struct Pixels(f64);

impl Display for Pixels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tenths = (self.0 * 10.0).round() / 10.0;
        write!(f, "{}", if tenths.is_finite() { tenths + 0.0 } else { 0.0 })
    }
}

fn pixels(point: impl Into<(f64, f64)>) -> (Pixels, Pixels) {
    let (x, y) = point.into();
    (Pixels(x), Pixels(y))
}

/// The commands of a path through points.
struct Course<'a, P>(&'a [P]);

impl<P: Into<(f64, f64)> + Copy> Display for Course<'_, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, &point) in self.0.iter().enumerate() {
            let (x, y) = pixels(point);
            write!(f, "{}{x} {y}", if k == 0 { 'M' } else { 'L' })?;
        }
        Ok(())
    }
}

/// A text that is escaped for XML.
struct Escaped<'a>(&'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.chars().try_for_each(|c| match c {
            '&' => f.write_str("&amp;"),
            '<' => f.write_str("&lt;"),
            '>' => f.write_str("&gt;"),
            '"' => f.write_str("&quot;"),
            // XML has no control characters and lacks these two; other invisible characters can reverse text.
            c if unseen(c) || matches!(c, '\u{fffe}' | '\u{ffff}') => f.write_char('\u{fffd}'),
            c => f.write_char(c),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_is_written_element_by_element() {
        let mut svg = Svg::new(40.0, 30.5, Class("plot"));
        svg.open_named_group("a < b");
        svg.circle((1.04, -0.04), 2.5, Class("mark"));
        svg.line(&[(0.0, 1.0), (f64::NAN, 2.26)], "fill=\"none\"");
        svg.polygon(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], "fill=\"red\"");
        svg.text((3.0, 4.0), Anchor::End, Class("faint"), "\u{202e}\"&");
        svg.close_group();
        let expected = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"30.5\" \
            viewBox=\"0 0 40 30.5\" class=\"plot\">\n\
            <g><title>a &lt; b</title>\n\
            <circle cx=\"1\" cy=\"0\" r=\"2.5\" class=\"mark\"/>\n\
            <path d=\"M0 1L0 2.3\" fill=\"none\"/>\n\
            <path d=\"M0 0L1 0L0 1Z\" fill=\"red\"/>\n\
            <text x=\"3\" y=\"4\" class=\"faint\" text-anchor=\"end\">\u{fffd}&quot;&amp;</text>\n\
            </g>\n</svg>\n";
        assert_eq!(svg.finish(), expected);
    }
}
