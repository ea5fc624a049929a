//! The outline of an SVG path (its `d` attribute) as cubic segments.
//!
//! All path commands of SVG 1.1 are read, relative and absolute. [`outlines`] reads all subpaths, [`outline`] accepts
//! one only. SVG's y axis points down. y is negated here, so that a shape upright in an SVG editor is upright as a contour. A
//! path is closed by `Z`, or by ending where it began.
//!
//! [`drawing()`] reads the paths and basic shapes of a whole file.
//!
//! kurbo's own path reader is not used, because it turns arcs into cubics with an absolute
//! tolerance of 0.1. This tolerance is too coarse for a circle of radius 1, and the conversion
//! never finishes for a circle of radius 1e300. Here kurbo converts only single arcs, to a
//! billionth of their radius.

mod basic;
mod drawing;
mod lexer;
mod style;
mod transform;

pub use drawing::{Filled, drawing};

use super::cubic::Cubic;
use super::vector::{Vector, extent};
use glam::DVec2;
use kurbo::{Arc, PathEl, Point, SvgArc, Vec2};
use lexer::Lexer;

/// Error of an arc's cubics, as a fraction of its larger radius: about 32 cubics for a full turn.
const ARC_TOLERANCE: f64 = 1e-9;

/// An arc whose radius is this many times its chord departs from the chord by a billionth, and becomes a
/// line.
const STRAIGHT: f64 = 1e8;

/// A path ends where it began if its ends are at most this fraction of its size apart.
const MEETS: f64 = 1e-9;

/// A `Z` whose line would be at most this fraction of the path's size closes a gap made by rounding.
///
/// Drawing programs write relative commands with three decimals or fewer, whose errors add up along the path.
/// Drawn as a line, such a gap would be a cell of its own between two creases. An intended line is longer,
/// and moving an end by so little is invisible.
const ROUNDING: f64 = 1e-4;

/// The subpath of an SVG path, with y pointing up.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// The segments; each starts where the one before it ends.
    pub segments: Vec<Cubic<DVec2>>,
    /// True if the last segment ends at the start of the first.
    pub closed: bool,
    /// True if the subpath ends with `Z`.
    pub drawn_closed: bool,
}

/// Reads an SVG path of one subpath.
///
/// # Errors
/// The message says what was found, at which character, and what was expected.
pub fn outline(text: &str) -> Result<Outline, String> {
    let mut reader = Reader::new(text);
    let outline = reader.outline(None)?;
    if reader.lexer.finished() {
        return Ok(outline.0);
    }
    Err(reader.lexer.expected("the end of the path: one subpath only"))
}

/// Reads an SVG path of one or more subpaths, which do not move between them.
///
/// # Errors
/// The message says what was found, at which character, and what was expected.
pub fn outlines(text: &str) -> Result<Vec<Outline>, String> {
    let mut reader = Reader::new(text);
    let mut outlines = Vec::new();
    let mut start = None;
    while start.is_none() || !reader.lexer.finished() {
        let (outline, from) = reader.outline(start)?;
        // A move that nothing follows draws nothing.
        if !outline.segments.is_empty() || start.is_none() {
            outlines.push(outline);
        }
        start = Some(from);
    }
    Ok(outlines)
}

struct Reader<'a> {
    lexer: Lexer<'a>,
    pen: DVec2,
    segments: Vec<Cubic<DVec2>>,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str) -> Self {
        Self { lexer: Lexer { text, at: 0 }, pen: DVec2::ZERO, segments: Vec::new() }
    }

    /// Reads a subpath; `before` is the start of the subpath before it. Returns the subpath and its start.
    fn outline(&mut self, before: Option<DVec2>) -> Result<(Outline, DVec2), String> {
        self.segments.clear();
        let (start, closed) = self.read(before)?;
        let mut segments = std::mem::take(&mut self.segments);
        let gap = (self.pen - start).length();
        let widest = if closed { ROUNDING } else { MEETS };
        let meets = gap <= widest * extent(segments.iter().flat_map(|segment| segment.0));
        if closed && !meets {
            segments.push(Cubic::line(self.pen, start));
        }
        if let Some(last) = segments.last_mut()
            && meets
        {
            last.0[3] = start;
        }
        if closed {
            self.pen = start;
        }
        for segment in &mut segments {
            // Negating with -y would turn 0 into -0.
            segment.0 = segment.0.map(|p| DVec2::new(p.x, 0.0 - p.y));
        }
        Ok((Outline { segments, closed: closed || meets, drawn_closed: closed }, start))
    }

    /// Reads the commands of a subpath. Returns the start, and whether the subpath ends with `Z`.
    fn read(&mut self, before: Option<DVec2>) -> Result<(DVec2, bool), String> {
        let first = self.lexer.at;
        let command = match self.lexer.command() {
            Some(letter @ ('M' | 'm')) => letter,
            // After a `Z` the next subpath may start where the last one did.
            Some(letter) if before.is_some() => {
                self.lexer.at = first;
                self.pen = before.unwrap_or(self.pen);
                return self.rest(self.pen, letter);
            }
            _ => return Err(self.lexer.expected("`M` and a point to start from")),
        };
        let origin = if command == 'm' { self.pen } else { DVec2::ZERO };
        let start = origin + self.lexer.point()?;
        self.pen = start;
        // Further points after a move are lines.
        let command = if command == 'M' { 'L' } else { 'l' };
        self.rest(start, command)
    }

    /// Reads the commands of a subpath after its start; `command` is that of numbers without a letter.
    fn rest(&mut self, start: DVec2, mut command: char) -> Result<(DVec2, bool), String> {
        // The last handles of a cubic and of a quadratic, for the commands that mirror them.
        let mut handles = [None; 2];
        loop {
            if let Some(letter) = self.lexer.command() {
                command = letter;
            } else if self.lexer.finished() {
                return Ok((start, false));
            }
            let origin = if command.is_ascii_lowercase() { self.pen } else { DVec2::ZERO };
            let from = self.pen;
            let mirrored =
                handles.map(|handle: Option<DVec2>| handle.map_or(from, |h| from * 2.0 - h));
            handles = [None; 2];
            match command.to_ascii_uppercase() {
                'L' => {
                    let to = origin + self.lexer.point()?;
                    self.line(to);
                }
                'H' => {
                    let x = origin.x + self.lexer.number()?;
                    self.line(DVec2::new(x, from.y));
                }
                'V' => {
                    let y = origin.y + self.lexer.number()?;
                    self.line(DVec2::new(from.x, y));
                }
                'C' => {
                    let first = origin + self.lexer.point()?;
                    handles[0] = Some(self.cubic(first, origin)?);
                }
                'S' => handles[0] = Some(self.cubic(mirrored[0], origin)?),
                'Q' => {
                    let handle = origin + self.lexer.point()?;
                    handles[1] = Some(self.quadratic(handle, origin)?);
                }
                'T' => handles[1] = Some(self.quadratic(mirrored[1], origin)?),
                'A' => self.arc(origin)?,
                'Z' => return Ok((start, true)),
                'M' => {
                    self.lexer.at -= 1;
                    return Ok((start, false));
                }
                _ => {
                    self.lexer.at -= 1;
                    return Err(self.lexer.expected("one of the commands L H V C S Q T A Z"));
                }
            }
        }
    }

    fn line(&mut self, to: DVec2) {
        self.segments.push(Cubic::line(self.pen, to));
        self.pen = to;
    }

    /// Reads the rest of a cubic after its first handle. Returns its second handle.
    fn cubic(&mut self, first: DVec2, origin: DVec2) -> Result<DVec2, String> {
        let second = origin + self.lexer.point()?;
        let to = origin + self.lexer.point()?;
        self.segments.push(Cubic([self.pen, first, second, to]));
        self.pen = to;
        Ok(second)
    }

    /// Reads the rest of a quadratic after its handle. Returns the handle.
    fn quadratic(&mut self, handle: DVec2, origin: DVec2) -> Result<DVec2, String> {
        let from = self.pen;
        let to = origin + self.lexer.point()?;
        let toward = |end: DVec2| end + (handle - end) * (2.0 / 3.0);
        self.segments.push(Cubic([from, toward(from), toward(to), to]));
        self.pen = to;
        Ok(handle)
    }

    fn arc(&mut self, origin: DVec2) -> Result<(), String> {
        let radii = self.lexer.point()?;
        let x_rotation = self.lexer.number()?.to_radians();
        let large_arc = self.lexer.flag()?;
        let sweep = self.lexer.flag()?;
        let to = origin + self.lexer.point()?;
        let chord = to - self.pen;
        // In units of the chord nothing can overflow or underflow.
        let unit = Vector::length(chord);
        let radii = radii.abs() / unit;
        let arc = SvgArc {
            from: Point::ZERO,
            to: Point::new(chord.x / unit, chord.y / unit),
            radii: Vec2::new(radii.x, radii.y),
            x_rotation,
            large_arc,
            sweep,
        };
        let curved = radii.min_element() > 0.0 && radii.max_element() < STRAIGHT;
        let Some(arc) = curved.then(|| Arc::from_svg_arc(&arc)).flatten() else {
            self.line(to);
            return Ok(());
        };
        let transformed = |p: Point| self.pen + DVec2::new(p.x, p.y) * unit;
        let mut from = self.pen;
        let tolerance = ARC_TOLERANCE * arc.radii.x.max(arc.radii.y);
        for element in arc.append_iter(tolerance) {
            if let PathEl::CurveTo(p1, p2, p3) = element {
                self.segments.push(Cubic([
                    from,
                    transformed(p1),
                    transformed(p2),
                    transformed(p3),
                ]));
                from = transformed(p3);
            }
        }
        if let Some(last) = self.segments.last_mut() {
            last.0[3] = to;
        }
        self.pen = to;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn p(x: f64, y: f64) -> DVec2 {
        DVec2::new(x, y)
    }

    #[test]
    fn what_is_up_in_an_editor_is_up() {
        let read = outline("M0 0 L10,0 10-20z").unwrap();
        assert!(read.closed);
        let starts: Vec<DVec2> = read.segments.iter().map(|segment| segment.0[0]).collect();
        assert_eq!(starts, [p(0.0, 0.0), p(10.0, 0.0), p(10.0, 20.0)]);
        assert_eq!(read.segments[2].0[3], p(0.0, 0.0));
    }

    #[test]
    fn all_commands_are_read_relative_and_absolute() {
        let absolute = outline("M1 1H3V2C3 3 4 3 4 2S5 1 5 2Q6 3 7 2T9 2A1 1 0 0 1 11 2L12 2");
        let relative = outline("m1 1h2v1c0 1 1 1 1 0s1-1 1 0q1 1 2 0t2 0a1 1 0 012 0l1 0");
        assert_eq!(absolute, relative);
        let read = absolute.unwrap();
        assert!(!read.closed);
        assert_eq!(read.segments[3].0[1], p(4.0, -1.0), "the handle is mirrored");
        assert_eq!(read.segments[5].0[3], p(9.0, -2.0));
    }

    #[test]
    fn arcs_lie_on_their_circle_at_any_size() {
        for radius in [1e-30, 1.0, 1e30] {
            let text = format!("M{radius} 0A{radius} {radius} 0 1 0 0 {radius}");
            let read = outline(&text).unwrap();
            for cubic in &read.segments {
                for i in 0..=10 {
                    let error = cubic.point(f64::from(i) / 10.0).length() / radius - 1.0;
                    assert!(error.abs() < 2e-9, "{radius}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn arcs_without_a_radius_or_a_chord_are_lines() {
        for text in ["M0 0A0 1 0 0 0 2 0", "M0 0A1e300 1 0 0 0 2 0", "M0 0A1 1 0 0 0 0 0"] {
            assert_eq!(outline(text).unwrap().segments.len(), 1, "{text}");
        }
    }

    #[test]
    fn a_path_that_returns_is_closed() {
        let read = outline("M0 0C1 0 1 1 0 1S-1 0 1e-12 0").unwrap();
        assert!(read.closed);
        assert_eq!(read.segments.len(), 2);
        assert_eq!(read.segments[1].0[3], p(0.0, 0.0));
    }

    #[test]
    fn a_gap_of_rounding_is_closed_without_a_line() {
        let read = outline(
            "m10.12 5.46c-2.761 0-5-2.239-5-5s2.239-5 5-5 5.001 2.239 5.001 5-2.24 5.001-5 5.001z",
        );
        let read = read.unwrap();
        assert_eq!(read.segments.len(), 4);
        assert_eq!(read.segments[3].0[3], read.segments[0].0[0]);
        let meant = outline("m0 0h10v10h-10v-9.9z").unwrap();
        assert_eq!(meant.segments.len(), 5);
    }

    #[test]
    fn faults_are_placed() {
        let fault = |text: &str| outline(text).unwrap_err();
        assert_eq!(
            fault("L1 1"),
            "found `1` at character 2, expected `M` and a point to start from"
        );
        assert_eq!(fault("M0 0 L1 x"), "found `x` at character 9, expected a number");
        assert_eq!(fault("M0 0 L1"), "found the end at character 8, expected a number");
        assert!(fault("M0 0L1 1zM2 2").starts_with("found `M` at character 10, expected the end"));
        assert!(fault("M0 0L1 1M2 2").starts_with("found `M` at character 9, expected the end"));
        assert!(fault("M0 0X1 1").starts_with("found `X` at character 5, expected one of"));
        assert!(fault("M0 0A1 1 0 2 0 1 1").ends_with("expected an arc's flag, 0 or 1"));
        assert!(fault("").starts_with("found the end at character 1"));
        assert!(fault("é").starts_with("found `é` at character 1"));
    }

    proptest! {
        #[test]
        fn no_text_makes_it_stumble(text in "[MmLlHhVvCcSsQqTtAaZz0-9eE+., é-]{0,60}") {
            let _ = outline(&format!("M0 0{text}"));
            let _ = outline(&text);
        }
    }
}
