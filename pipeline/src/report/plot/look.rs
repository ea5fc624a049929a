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
    /// A star of five points.
    Star,
    /// An upright cross of two strokes.
    Plus,
    /// A lying rectangle.
    Bar,
}

/// The look of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// The number of its colour, one of the nine of the style, from 0 to 8.
    pub color: u8,
    /// The shape of its mark.
    pub mark: Mark,
    /// True if the mark is empty.
    pub hollow: bool,
}

impl Look {
    /// Returns look `k` of nine looks, which differ in colour and mark. From 9 on the looks repeat.
    #[must_use]
    pub fn number(k: usize) -> Self {
        let marks = [
            Mark::Cross,
            Mark::Circle,
            Mark::Triangle,
            Mark::Square,
            Mark::Diamond,
            Mark::Wedge,
            Mark::Star,
            Mark::Plus,
            Mark::Bar,
        ];
        let color = k % marks.len();
        Self { color: color as u8, mark: marks[color], hollow: false }
    }

    /// Returns the look of a filter, the same in all plots. Elliptic filters share one look.
    #[must_use]
    pub fn filter(filter: Filter) -> Self {
        Self::number(match filter {
            Filter::Point => 0,
            Filter::Bilinear => 1,
            Filter::Mip => 2,
            Filter::Box => 3,
            Filter::Tent => 4,
            Filter::Quadratic => 5,
            Filter::Exact => 6,
            Filter::Ewa8 | Filter::Ewa16 | Filter::Ewa64 => 7,
            Filter::Probes => 8,
        })
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
            Mark::Plus => {
                svg.line(&[(x - radius, y), (x + radius, y)], style);
                svg.line(&[(x, y - radius), (x, y + radius)], style);
            }
            Mark::Bar => {
                outline(svg, radius, &[(-1.1, -0.5), (1.1, -0.5), (1.1, 0.5), (-1.1, 0.5)]);
            }
            Mark::Star => {
                let corner = |k: u32| {
                    let angle = f64::from(k) * std::f64::consts::PI / 5.0;
                    let size = if k.is_multiple_of(2) { 1.0 } else { 0.45 };
                    (size * angle.sin(), -size * angle.cos())
                };
                outline(svg, 1.4 * radius, &(0..10).map(corner).collect::<Vec<_>>());
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
        let elliptic = |filter| matches!(filter, Filter::Ewa8 | Filter::Ewa16 | Filter::Ewa64);
        for (k, &first) in Filter::ALL.iter().enumerate() {
            for &second in &Filter::ALL[k + 1..] {
                let (a, b) = (Look::filter(first), Look::filter(second));
                let alike = elliptic(first) && elliptic(second);
                assert_eq!((a.mark == b.mark, a.color == b.color), (alike, alike), "{a:?} {b:?}");
            }
        }
    }
}
