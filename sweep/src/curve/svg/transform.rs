//! Transforms of SVG elements: the `transform` attribute, and a `viewBox` fitted to a viewport.
//!
//! Coordinates are those of SVG, with y pointing down. See SVG 1.1, sections 7.6 to 7.8.

use super::lexer::Lexer;
use glam::{DAffine2, DMat2, DVec2};

/// Reads a list of transforms, of which the last acts first.
///
/// # Errors
/// The message says what was found, at which character, and what was expected.
pub(super) fn list(text: &str) -> Result<DAffine2, String> {
    let mut lexer = Lexer { text, at: 0 };
    let mut all = DAffine2::IDENTITY;
    while !lexer.finished() {
        all *= one(&mut lexer)?;
    }
    Ok(all)
}

fn one(lexer: &mut Lexer<'_>) -> Result<DAffine2, String> {
    let expected = "one of matrix, translate, scale, rotate, skewX, skewY";
    let rest = &lexer.text[lexer.at..];
    let name: String = rest.chars().take_while(char::is_ascii_alphabetic).collect();
    if name.is_empty() {
        return Err(lexer.expected(expected));
    }
    let start = lexer.at;
    lexer.at += name.len();
    lexer.symbol('(')?;
    let mut numbers: Vec<f64> = Vec::new();
    while !lexer.is_symbol(')') {
        numbers.push(lexer.number()?);
    }
    lexer.symbol(')')?;
    let turn = |degrees: f64| {
        let turned = crate::curve::turn(degrees / 360.0);
        DAffine2::from_mat2(DMat2::from_cols(turned, turned.perp()))
    };
    let skewed = |degrees: f64| degrees.to_radians().tan();
    Ok(match (&name[..], &numbers[..]) {
        ("matrix", &[a, b, c, d, e, f]) => DAffine2 {
            matrix2: DMat2::from_cols(DVec2::new(a, b), DVec2::new(c, d)),
            translation: DVec2::new(e, f),
        },
        ("translate", &[x]) => DAffine2::from_translation(DVec2::new(x, 0.0)),
        ("translate", &[x, y]) => DAffine2::from_translation(DVec2::new(x, y)),
        ("scale", &[s]) => DAffine2::from_scale(DVec2::splat(s)),
        ("scale", &[x, y]) => DAffine2::from_scale(DVec2::new(x, y)),
        ("rotate", &[degrees]) => turn(degrees),
        ("rotate", &[degrees, x, y]) => {
            let center = DVec2::new(x, y);
            DAffine2::from_translation(center) * turn(degrees) * DAffine2::from_translation(-center)
        }
        ("skewX", &[degrees]) => {
            DAffine2::from_mat2(DMat2::from_cols(DVec2::X, DVec2::new(skewed(degrees), 1.0)))
        }
        ("skewY", &[degrees]) => {
            DAffine2::from_mat2(DMat2::from_cols(DVec2::new(1.0, skewed(degrees)), DVec2::Y))
        }
        ("matrix" | "translate" | "scale" | "rotate" | "skewX" | "skewY", numbers) => {
            let count = numbers.len();
            return Err(format!(
                "found `{name}` with {count} numbers, expected the numbers of SVG"
            ));
        }
        _ => {
            lexer.at = start;
            return Err(lexer.expected(expected));
        }
    })
}

/// The part of a drawing that is shown: left, top, width and height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ViewBox {
    pub corner: DVec2,
    pub size: DVec2,
}

impl ViewBox {
    /// Reads the attribute `viewBox`; `None` if it has no area.
    pub fn read(text: &str) -> Option<Self> {
        let mut lexer = Lexer { text, at: 0 };
        let corner = lexer.point().ok()?;
        let size = lexer.point().ok()?;
        let area = size.min_element() > 0.0 && size.max_element() < f64::INFINITY;
        (area && corner.is_finite()).then_some(Self { corner, size })
    }

    /// Returns the transform that fits the box into a viewport from (0, 0) to `viewport`, as the attribute
    /// `preserveAspectRatio` says: most often as large as possible, in the middle.
    pub fn fitted(self, viewport: DVec2, aspect: Option<&str>) -> DAffine2 {
        let mut words = aspect.unwrap_or_default().split_ascii_whitespace();
        let align = words.next().unwrap_or("xMidYMid");
        let slice = words.next() == Some("slice");
        let each = viewport / self.size;
        let scale = match align {
            "none" => each,
            _ if slice => DVec2::splat(each.max_element()),
            _ => DVec2::splat(each.min_element()),
        };
        let left = viewport - self.size * scale;
        let part = |low: &str, high: &str| {
            if align.contains(low) {
                0.0
            } else if align.contains(high) {
                1.0
            } else {
                0.5
            }
        };
        let shift = left * DVec2::new(part("xMin", "xMax"), part("YMin", "YMax"));
        DAffine2::from_translation(shift)
            * DAffine2::from_scale(scale)
            * DAffine2::from_translation(-self.corner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(text: &str, x: f64, y: f64) -> DVec2 {
        list(text).unwrap().transform_point2(DVec2::new(x, y))
    }

    #[test]
    fn the_last_transform_acts_first() {
        assert_eq!(moved("translate(10, 20) scale(2)", 1.0, 1.0), DVec2::new(12.0, 22.0));
        assert_eq!(moved("scale(2),translate(10 20)", 1.0, 1.0), DVec2::new(22.0, 42.0));
        assert_eq!(moved("rotate(90)", 1.0, 0.0), DVec2::new(0.0, 1.0));
        assert_eq!(moved("rotate(90 1 1)", 2.0, 1.0), DVec2::new(1.0, 2.0));
        assert_eq!(moved("matrix(1 2 3 4 5 6)", 1.0, 1.0), DVec2::new(9.0, 12.0));
        assert!((moved("skewX(45)", 0.0, 1.0) - DVec2::ONE).length() < 1e-15);
        assert!((moved("skewY(45)", 1.0, 0.0) - DVec2::ONE).length() < 1e-15);
    }

    #[test]
    fn faults_are_placed() {
        assert!(list("turn(3)").unwrap_err().starts_with("found `t` at character 1"));
        assert!(list("scale(1 2 3)").unwrap_err().contains("`scale` with 3 numbers"));
        assert!(list("scale(1").unwrap_err().contains("at character 8"));
    }

    #[test]
    fn a_box_is_fitted_in_the_middle() {
        let view = ViewBox::read("10 10 100 50").unwrap();
        let fitted = |aspect| {
            let map = view.fitted(DVec2::new(400.0, 400.0), aspect);
            [DVec2::new(10.0, 10.0), DVec2::new(110.0, 60.0)].map(|p| map.transform_point2(p))
        };
        assert_eq!(fitted(None), [DVec2::new(0.0, 100.0), DVec2::new(400.0, 300.0)]);
        assert_eq!(fitted(Some("none")), [DVec2::ZERO, DVec2::splat(400.0)]);
        assert_eq!(fitted(Some("xMinYMin"))[0], DVec2::ZERO);
        assert_eq!(fitted(Some("xMidYMid slice"))[1], DVec2::new(600.0, 400.0));
        assert_eq!(ViewBox::read("0 0 0 5"), None);
    }
}
