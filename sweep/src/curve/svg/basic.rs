//! The basic shapes of SVG as paths: rectangles, circles, ellipses, lines, polylines and polygons.
//!
//! A shape without area, such as a circle of radius 0, is not drawn. See SVG 1.1, chapter 9.

use super::lexer::Lexer;
use roxmltree::Node;

/// Pixels of a millimetre, at the 96 pixels per inch of CSS.
pub(super) const PIXELS_OF_A_MM: f64 = 96.0 / 25.4;

/// Returns the path of an element; `None` for an element that draws no curve.
///
/// # Errors
/// A sentence about an attribute that is not valid.
pub(super) fn path(node: Node<'_, '_>) -> Result<Option<String>, String> {
    let number = |key: &str| match node.attribute(key).map(str::trim) {
        None | Some("auto") => Ok(None),
        Some(text) => length(text)
            .map(Some)
            .ok_or_else(|| format!("found {key}={text:?}, expected a length, such as 3 or 3mm")),
    };
    let or_zero = |key: &str| number(key).map(Option::unwrap_or_default);
    Ok(match node.tag_name().name() {
        "path" => node.attribute("d").filter(|text| !text.trim().is_empty()).map(str::to_owned),
        "rect" => {
            let [x, y, w, h] =
                [or_zero("x")?, or_zero("y")?, or_zero("width")?, or_zero("height")?];
            let (rx, ry) = (number("rx")?, number("ry")?);
            let rx_own = rx.or(ry).unwrap_or(0.0).clamp(0.0, 0.5 * w.max(0.0));
            let ry_own = ry.or(rx).unwrap_or(0.0).clamp(0.0, 0.5 * h.max(0.0));
            (w > 0.0 && h > 0.0).then(|| rectangle([x, y, w, h], [rx_own, ry_own]))
        }
        "circle" => {
            let (x, y, r) = (or_zero("cx")?, or_zero("cy")?, or_zero("r")?);
            (r > 0.0).then(|| ellipse([x, y], [r, r]))
        }
        "ellipse" => {
            let (x, y, rx, ry) = (or_zero("cx")?, or_zero("cy")?, number("rx")?, number("ry")?);
            let [a, b] = [rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0)];
            (a > 0.0 && b > 0.0).then(|| ellipse([x, y], [a, b]))
        }
        "line" => {
            let [a, b, c, d] = [or_zero("x1")?, or_zero("y1")?, or_zero("x2")?, or_zero("y2")?];
            Some(format!("M{a:?} {b:?}L{c:?} {d:?}"))
        }
        "polyline" => points(node)?,
        "polygon" => points(node)?.map(|text| text + "Z"),
        _ => None,
    })
}

fn rectangle([x, y, w, h]: [f64; 4], [rx, ry]: [f64; 2]) -> String {
    let (right, below) = (x + w, y + h);
    if rx == 0.0 || ry == 0.0 {
        return format!("M{x:?} {y:?}H{right:?}V{below:?}H{x:?}Z");
    }
    let arc = |to: [f64; 2]| format!("A{rx:?} {ry:?} 0 0 1 {:?} {:?}", to[0], to[1]);
    let mut text = format!("M{:?} {y:?}H{:?}", x + rx, right - rx);
    text += &arc([right, y + ry]);
    text += &format!("V{:?}", below - ry);
    text += &arc([right - rx, below]);
    text += &format!("H{:?}", x + rx);
    text += &arc([x, below - ry]);
    text += &format!("V{:?}", y + ry);
    text += &arc([x + rx, y]);
    text + "Z"
}

fn ellipse([x, y]: [f64; 2], [rx, ry]: [f64; 2]) -> String {
    let arc = |to: f64| format!("A{rx:?} {ry:?} 0 0 1 {to:?} {y:?}");
    format!("M{:?} {y:?}{}{}Z", x + rx, arc(x - rx), arc(x + rx))
}

/// Returns the path through the points of an element; `None` for fewer than two.
fn points(node: Node<'_, '_>) -> Result<Option<String>, String> {
    let text = node.attribute("points").unwrap_or_default();
    let mut lexer = Lexer { text, at: 0 };
    let mut path = String::new();
    let mut count = 0;
    while !lexer.finished() {
        let point = lexer.point().map_err(|message| format!("points: {message}"))?;
        path += &format!("{}{:?} {:?}", if count == 0 { 'M' } else { 'L' }, point.x, point.y);
        count += 1;
    }
    Ok((count > 1).then_some(path))
}

/// Returns a length in pixels, which are the user units of a drawing without a `viewBox`; `None` for a text that is no
/// length, or a percentage.
pub(super) fn length(text: &str) -> Option<f64> {
    let mut lexer = Lexer { text, at: 0 };
    let number = lexer.number().ok().filter(|number| number.is_finite())?;
    let millimetres = match text[lexer.at..].trim() {
        "" | "px" => return Some(number),
        "mm" => 1.0,
        "cm" => 10.0,
        "in" => 25.4,
        "pt" => 25.4 / 72.0,
        "pc" => 25.4 / 6.0,
        "Q" | "q" => 0.25,
        _ => return None,
    };
    Some(number * millimetres * PIXELS_OF_A_MM)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::svg::outlines;
    use std::f64::consts::PI;

    fn shape(text: &str) -> Result<Option<String>, String> {
        path(roxmltree::Document::parse(text).unwrap().root_element())
    }

    /// Returns the area within the first outline of an element.
    fn area(text: &str) -> f64 {
        let outline = outlines(&shape(text).unwrap().unwrap()).unwrap().remove(0);
        assert!(outline.closed);
        let part = |i: i32| f64::from(i) / 256.0;
        let of = |cubic: &crate::curve::Cubic<glam::DVec2>| -> f64 {
            (0..256).map(|i| 0.5 * cubic.point(part(i)).perp_dot(cubic.point(part(i + 1)))).sum()
        };
        outline.segments.iter().map(of).sum::<f64>().abs()
    }

    #[test]
    fn shapes_have_the_area_of_their_formula() {
        // 256 chords of a cubic of an eleventh of a turn cut off less than a millionth of the area.
        for (text, expected) in [
            ("<rect x='1' y='2' width='3' height='4'/>", 12.0),
            ("<rect width='6' height='4' rx='1'/>", 24.0 - (4.0 - PI)),
            ("<rect width='6' height='4' rx='50' ry='2'/>", PI * 3.0 * 2.0),
            ("<circle cx='9' r='2'/>", 4.0 * PI),
            ("<ellipse rx='2' ry='3'/>", 6.0 * PI),
            ("<polygon points='0,0 4,0 0,3'/>", 6.0),
        ] {
            let found = area(text);
            assert!((found / expected - 1.0).abs() < 1e-6, "{text}: {found} for {expected}");
        }
    }

    #[test]
    fn shapes_without_area_draw_nothing_and_faults_are_named() {
        for text in [
            "<circle/>",
            "<rect width='3'/>",
            "<polyline points='1 1'/>",
            "<path d=' '/>",
            "<text/>",
        ] {
            assert_eq!(shape(text), Ok(None), "{text}");
        }
        assert!(shape("<circle r='2%'/>").unwrap_err().contains("r=\"2%\""));
        assert!(shape("<polygon points='1 1 x'/>").unwrap_err().starts_with("points: found `x`"));
        assert_eq!(shape("<line x2='1in'/>"), Ok(Some("M0.0 0.0L96.0 0.0".into())));
    }
}
