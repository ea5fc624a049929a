//! The look of a curve: its colour, and a mark that identifies it without colour.

use files::svg::{Class, Svg};
use render::filter::Filter;

/// The shape of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Two crossed strokes.
    Cross,
    /// A circle.
    Circle,
    /// A triangle with its tip up.
    Triangle,
    /// A square.
    Square,
    /// A square on its corner.
    Diamond,
    /// A triangle with its tip down.
    Wedge,
}

/// The look of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// The number of its colour, one of the six of the style, from 0 to 5.
    pub color: u8,
    /// The shape of its mark.
    pub mark: Mark,
    /// True if the mark is empty.
    pub hollow: bool,
}

impl Look {
    /// Returns look `k` of six looks, which differ in colour and mark. From 6 on the looks repeat.
    #[must_use]
    pub fn number(k: usize) -> Self {
        let marks =
            [Mark::Cross, Mark::Circle, Mark::Triangle, Mark::Square, Mark::Diamond, Mark::Wedge];
        let color = k % marks.len();
        Self { color: color as u8, mark: marks[color], hollow: false }
    }

    /// Returns the look of a filter, the same in all plots.
    #[must_use]
    pub fn filter(filter: Filter) -> Self {
        Self::number(Filter::ALL.iter().position(|&known| known == filter).unwrap_or(0))
    }

    /// Returns this look with an empty mark.
    #[must_use]
    pub fn hollow(self) -> Self {
        Self { hollow: true, ..self }
    }

    pub(super) fn class(self) -> String {
        format!("s{}", self.color)
    }

    /// Draws the mark. Position and radius are in pixels.
    pub(super) fn draw(self, svg: &mut Svg, x: f64, y: f64, radius: f64) {
        let fill = if self.hollow { "hollow" } else { "full" };
        let class = format!("mark {fill} {}", self.class());
        let style = Class(&class);
        // The factors make marks of different shapes look equally large.
        let outline = |svg: &mut Svg, size: f64, corners: &[(f64, f64)]| {
            let points: Vec<(f64, f64)> =
                corners.iter().map(|&(a, b)| (x + size * a, y + size * b)).collect();
            svg.polygon(&points, style);
        };
        match self.mark {
            Mark::Circle => svg.circle((x, y), radius, style),
            Mark::Cross => {
                // A cross has no inside, so an empty cross has a circle around it.
                let arm = if self.hollow { 0.55 } else { 0.85 } * radius;
                if self.hollow {
                    svg.circle((x, y), radius, style);
                }
                svg.line(&[(x - arm, y - arm), (x + arm, y + arm)], style);
                svg.line(&[(x - arm, y + arm), (x + arm, y - arm)], style);
            }
            Mark::Square => {
                outline(svg, 0.88 * radius, &[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]);
            }
            Mark::Diamond => {
                outline(svg, 1.22 * radius, &[(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]);
            }
            Mark::Triangle => {
                outline(svg, 1.2 * radius, &[(0.0, -1.0), (0.95, 0.7), (-0.95, 0.7)]);
            }
            Mark::Wedge => {
                outline(svg, 1.2 * radius, &[(0.0, 1.0), (0.95, -0.7), (-0.95, -0.7)]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_filter_has_a_mark_and_a_colour_of_its_own() {
        let looks = Filter::THESIS.map(Look::filter);
        for (k, a) in looks.iter().enumerate() {
            for b in &looks[k + 1..] {
                assert!(a.mark != b.mark && a.color != b.color, "{a:?} {b:?}");
            }
        }
    }
}
