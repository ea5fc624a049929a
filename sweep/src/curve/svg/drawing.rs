//! The outlines in an SVG file.
//!
//! Paths and basic shapes are read with the transforms of all elements around them, `viewBox` and units. `use` draws the
//! element that it names. Elements that only other elements refer to (`defs`, `symbol`, `clipPath`, masks, markers,
//! patterns) and hidden elements draw nothing. Texts and pictures have no outlines. Style sheets are not read. The
//! property `fill-rule` is read from attributes and from `style`, and elements inherit it.
//!
//! The result has y pointing up, and its origin in the lower left corner of the page.

use super::basic::{self, PIXELS_OF_A_MM};
use super::style::{nonzero, property};
use super::transform::{self, ViewBox};
use super::{Outline, outlines};
use glam::{DAffine2, DVec2};
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::HashMap;

/// Most elements of a drawing, with each copy that `use` makes.
const MOST_ELEMENTS: usize = 100_000;

/// Most outlines of a drawing.
const MOST_OUTLINES: usize = 10_000;

/// Most elements inside each other, with those that `use` refers to.
const DEEPEST: usize = 64;

/// Elements that draw nothing where they stand.
const UNDRAWN: [&str; 9] = [
    "defs",
    "symbol",
    "clipPath",
    "mask",
    "marker",
    "pattern",
    "linearGradient",
    "metadata",
    "style",
];

/// The outlines of one element.
#[derive(Debug, Clone, PartialEq)]
pub struct Filled {
    /// The subpaths, at least one.
    pub outlines: Vec<Outline>,
    /// True if the nonzero rule says which points are inside, false for the even-odd rule: the property `fill-rule`.
    pub nonzero: bool,
}

/// Returns the outlines of a file, element by element: of the element with an id, or of all shapes.
///
/// `millimetres` is the length of a unit of the result. Without it, a unit of the result is a user unit of the file.
///
/// # Errors
/// A sentence about the file: it is not XML or no SVG, has no such element, or has no outline.
pub fn drawing(
    text: &str,
    id: Option<&str>,
    millimetres: Option<f64>,
) -> Result<Vec<Filled>, String> {
    let options =
        ParsingOptions { allow_dtd: true, nodes_limit: 4_000_000, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| format!("found text that is not XML ({error}), expected an SVG file"))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let found = root.tag_name().name();
        return Err(format!("found an XML file of `{found}`, expected an SVG file"));
    }
    let page = page(root, millimetres)?;
    let named = document.descendants().filter(Node::is_element);
    let named = named.filter_map(|node| node.attribute("id").map(|id| (id, node)));
    let mut ids: HashMap<&str, Node<'_, '_>> = HashMap::new();
    for (id, node) in named {
        ids.entry(id).or_insert(node);
    }
    let mut pen = Pen { ids: &ids, elements: 0, outlines: 0, found: Vec::new() };
    match id {
        None => pen.inside(root, Around { to_page: page, nonzero: nonzero(root, true) }, 0)?,
        Some(id) => {
            let node = ids.get(id).copied();
            let node =
                node.ok_or_else(|| format!("found no element with the id {id:?}{}", known(root)))?;
            let around: Vec<Node<'_, '_>> =
                node.ancestors().skip(1).filter(Node::is_element).collect();
            let mut context = Around { to_page: page, nonzero: nonzero(root, true) };
            for outer in around.into_iter().rev().filter(|outer| *outer != root) {
                context.to_page *= placed(outer)?;
                context.nonzero = nonzero(outer, context.nonzero);
            }
            if node == root {
                pen.inside(root, context, 0)?;
            } else {
                pen.element(node, context, 0, true)?;
            }
        }
    }
    if pen.found.is_empty() {
        let what = match id {
            Some(id) => format!("an element {id:?} without outlines"),
            None => "a drawing without outlines".into(),
        };
        return Err(format!(
            "found {what}, expected paths, rectangles, circles, ellipses, lines or polygons; a text is turned into \
             paths by the drawing program"
        ));
    }
    Ok(pen.found)
}

/// Returns the ids in a file, for a message.
fn known(root: Node<'_, '_>) -> String {
    let drawn = |node: &Node<'_, '_>| {
        ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "g", "use"]
            .contains(&node.tag_name().name())
    };
    let ids: Vec<&str> =
        root.descendants().filter(drawn).filter_map(|node| node.attribute("id")).take(8).collect();
    match &ids[..] {
        [] => ", and no other ids; without `id` all shapes are read".into(),
        ids => format!(", expected an id such as {}", ids.join(", ")),
    }
}

/// Returns the map from the user units of the root to the page with y pointing up.
fn page(root: Node<'_, '_>, millimetres: Option<f64>) -> Result<DAffine2, String> {
    let view = root.attribute("viewBox").and_then(ViewBox::read);
    let given = |key: &str| root.attribute(key).and_then(|text| basic::length(text.trim()));
    let sides = [given("width"), given("height")];
    let unit = millimetres.map_or(1.0, |millimetres| 1.0 / (millimetres * PIXELS_OF_A_MM));
    let viewport = match (millimetres, view, sides) {
        (None, Some(view), _) | (_, Some(view), [None, None]) => Some(view.size * unit),
        (_, Some(view), [Some(w), None]) => Some(view.size * (w * unit / view.size.x)),
        (_, Some(view), [None, Some(h)]) => Some(view.size * (h * unit / view.size.y)),
        (_, _, [Some(w), Some(h)]) => Some(DVec2::new(w, h) * unit),
        (_, None, _) => None,
    };
    if let Some(size) = viewport.filter(|size| size.min_element() <= 0.0) {
        return Err(format!("found a page of {} x {}, expected an area", size.x, size.y));
    }
    let own = match (view, viewport) {
        (Some(view), Some(viewport)) => {
            view.fitted(viewport, root.attribute("preserveAspectRatio"))
        }
        _ => DAffine2::from_scale(DVec2::splat(unit)),
    };
    let height = viewport.map_or(0.0, |viewport| viewport.y);
    let upright = DAffine2 {
        matrix2: glam::DMat2::from_diagonal(DVec2::new(1.0, -1.0)),
        translation: DVec2::new(0.0, height),
    };
    Ok(upright * own * transform_of(root)?)
}

/// Returns the transform of an element, from its inside to the outside.
fn placed(node: Node<'_, '_>) -> Result<DAffine2, String> {
    let own = transform_of(node)?;
    let length = |key: &str| node.attribute(key).and_then(|text| basic::length(text.trim()));
    let corner = || {
        DAffine2::from_translation(DVec2::new(
            length("x").unwrap_or_default(),
            length("y").unwrap_or_default(),
        ))
    };
    Ok(match node.tag_name().name() {
        "use" => own * corner(),
        "svg" => {
            let view = node.attribute("viewBox").and_then(ViewBox::read);
            let fitted = view.zip(length("width").zip(length("height"))).map(|(view, (w, h))| {
                view.fitted(DVec2::new(w, h), node.attribute("preserveAspectRatio"))
            });
            own * corner() * fitted.unwrap_or(DAffine2::IDENTITY)
        }
        _ => own,
    })
}

fn transform_of(node: Node<'_, '_>) -> Result<DAffine2, String> {
    let text = node.attribute("transform").unwrap_or_default();
    transform::list(text).map_err(|message| at(node, &format!("transform: {message}")))
}

fn at(node: Node<'_, '_>, message: &str) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    format!("`{}` in line {line}: {message}", node.tag_name().name())
}

/// The placement and the rule that an element takes from the elements around it.
#[derive(Debug, Clone, Copy)]
struct Around {
    to_page: DAffine2,
    /// True if the nonzero rule fills elements that do not say otherwise.
    nonzero: bool,
}

/// Collects the outlines of elements.
struct Pen<'a, 'input> {
    /// The elements with an id; of two with one id the first.
    ids: &'a HashMap<&'a str, Node<'a, 'input>>,
    elements: usize,
    /// Number of outlines in `found`.
    outlines: usize,
    found: Vec<Filled>,
}

impl<'a, 'input> Pen<'a, 'input> {
    fn inside(
        &mut self,
        node: Node<'a, 'input>,
        around: Around,
        depth: usize,
    ) -> Result<(), String> {
        node.children()
            .filter(Node::is_element)
            .try_for_each(|child| self.element(child, around, depth + 1, false))
    }

    /// Draws an element. One that is `asked` for is drawn although only other elements refer to it.
    fn element(
        &mut self,
        node: Node<'a, 'input>,
        around: Around,
        depth: usize,
        asked: bool,
    ) -> Result<(), String> {
        self.elements += 1;
        if self.elements > MOST_ELEMENTS || depth > DEEPEST {
            return Err(at(
                node,
                &format!(
                    "found more than {MOST_ELEMENTS} elements or {DEEPEST} inside each other, expected fewer"
                ),
            ));
        }
        let name = node.tag_name().name();
        let hidden = property(node, "display") == Some("none");
        if !asked && (hidden || UNDRAWN.contains(&name)) {
            return Ok(());
        }
        let own = Around {
            to_page: around.to_page * placed(node)?,
            nonzero: nonzero(node, around.nonzero),
        };
        match name {
            "g" | "a" | "svg" | "switch" | "symbol" | "defs" => self.inside(node, own, depth),
            "use" => {
                let names = node.attributes().find(|one| one.name() == "href");
                let id = names.and_then(|one| one.value().strip_prefix('#')).ok_or_else(|| {
                    at(node, "found no reference to an element of this file, expected one")
                })?;
                match self.ids.get(id) {
                    Some(other) => self.element(*other, own, depth + 1, true),
                    None => Err(at(node, &format!("found no element with the id {id:?}"))),
                }
            }
            _ => self.shape(node, own),
        }
    }

    fn shape(&mut self, node: Node<'a, 'input>, own: Around) -> Result<(), String> {
        let Some(text) = basic::path(node).map_err(|message| at(node, &message))? else {
            return Ok(());
        };
        let read = outlines(&text).map_err(|message| at(node, &message))?;
        // The outlines have y pointing up already.
        let moved = |p: DVec2| own.to_page.transform_point2(DVec2::new(p.x, -p.y)) + DVec2::ZERO;
        let mut outlines = Vec::new();
        for mut outline in read.into_iter().filter(|outline| !outline.segments.is_empty()) {
            self.outlines += 1;
            if self.outlines > MOST_OUTLINES {
                return Err(at(
                    node,
                    &format!(
                        "found more than {MOST_OUTLINES} outlines, expected fewer; `id` chooses some"
                    ),
                ));
            }
            outline.segments.iter_mut().for_each(|cubic| cubic.0 = cubic.0.map(moved));
            outlines.push(outline);
        }
        if !outlines.is_empty() {
            self.found.push(Filled { outlines, nonzero: own.nonzero });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(outline: &Outline) -> [DVec2; 2] {
        let part = |i: i32| f64::from(i) / 256.0;
        let points =
            outline.segments.iter().flat_map(|cubic| (0..=256).map(move |i| cubic.point(part(i))));
        points.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[a, b], p| [a.min(p), b.max(p)])
    }

    fn box_of(text: &str, id: Option<&str>, mm: Option<f64>) -> [DVec2; 2] {
        let found = drawing(text, id, mm).unwrap();
        found
            .iter()
            .flat_map(|one| &one.outlines)
            .map(bounds)
            .reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
            .unwrap()
    }

    const PAGE: &str = "<svg xmlns='http://www.w3.org/2000/svg' width='210mm' height='297mm' viewBox='0 0 420 594'>\
        <defs><rect id='r' width='10' height='20'/></defs>\
        <g id='both' transform='translate(100 200)'><use href='#r' x='4'/>\
        <circle id='c' cx='50' cy='50' r='10' transform='scale(2)'/></g>\
        <path display='none' d='M0 0H1V1Z'/></svg>";

    #[test]
    fn the_page_has_its_origin_below_on_the_left_and_its_units() {
        let near = |found: [DVec2; 2], a: [f64; 2], b: [f64; 2]| {
            let off = [found[0] - DVec2::from_array(a), found[1] - DVec2::from_array(b)];
            // Samples miss the sides of a circle of 20 by less than a millionth.
            assert!(off.iter().all(|off| off.length() < 1e-4), "{found:?}");
        };
        near(box_of(PAGE, None, None), [104.0, 274.0], [220.0, 394.0]);
        near(box_of(PAGE, Some("c"), None), [180.0, 274.0], [220.0, 314.0]);
        // A user unit is half a millimetre.
        near(box_of(PAGE, Some("c"), Some(1.0)), [90.0, 137.0], [110.0, 157.0]);
        near(
            box_of(PAGE, Some("c"), Some(25.4)),
            [90.0 / 25.4, 137.0 / 25.4],
            [110.0 / 25.4, 157.0 / 25.4],
        );
        near(box_of(PAGE, Some("r"), None), [0.0, 574.0], [10.0, 594.0]);
        // Without units a user unit is a pixel, 96 of which are an inch.
        let plain = "<svg><rect width='96' height='48'/></svg>";
        near(box_of(plain, None, Some(25.4)), [0.0, -0.5], [1.0, 0.0]);
        near(box_of(plain, None, None), [0.0, -48.0], [96.0, 0.0]);
    }

    #[test]
    fn what_is_no_drawing_has_its_complaint() {
        for (text, id, message) in [
            ("<svg", None, "not XML"),
            ("<html/>", None, "XML file of `html`"),
            ("<svg><text>A</text></svg>", None, "a drawing without outlines"),
            ("<svg><rect id='a'/></svg>", Some("a"), "an element \"a\" without outlines"),
            ("<svg><g id='a'/></svg>", Some("b"), "expected an id such as a"),
            (
                "<svg><path d='M0 0 L1'/></svg>",
                None,
                "`path` in line 1: found the end at character 8",
            ),
            ("<svg>\n<g transform='turn(1)'/></svg>", None, "`g` in line 2: transform: found `t`"),
            ("<svg><use href='#b'/></svg>", None, "no element with the id \"b\""),
            ("<svg><g id='a'><use href='#a'/></g></svg>", None, "64 inside each other"),
        ] {
            let found = drawing(text, id, None).unwrap_err();
            assert!(found.contains(message), "{text}: {found}");
        }
    }

    #[test]
    fn copies_of_copies_are_bounded() {
        let mut text = "<svg><rect id='r0' width='1' height='1'/>".to_owned();
        for i in 1..40 {
            let uses = format!("<use href='#r{}'/>", i - 1).repeat(10);
            text += &format!("<g id='r{i}'>{uses}</g>");
        }
        assert!(drawing(&(text + "</svg>"), None, None).unwrap_err().contains("expected fewer"));
    }

    #[test]
    fn the_rule_is_that_of_the_style_then_of_the_attribute_then_of_the_elements_around() {
        let rules = |text: &str, id: Option<&str>| -> Vec<bool> {
            drawing(text, id, None).unwrap().iter().map(|one| one.nonzero).collect()
        };
        let path = |keys: &str| format!("<path id='p' d='M0 0H1V1Z' {keys}/>");
        let even = |inside: String| format!("<svg><g fill-rule='evenodd'>{inside}</g></svg>");
        for (keys, expected) in [
            ("", false),
            ("fill-rule='nonzero'", true),
            ("fill-rule='nonzero' style='fill:red; fill-rule: evenodd'", false),
            ("fill-rule='evenodd' style='fill-rule:nonzero !important'", true),
            ("fill-rule='inherit'", false),
            ("style='clip-rule:nonzero'", false),
        ] {
            let text = even(path(keys));
            assert_eq!(rules(&text, None), [expected], "{keys}");
            assert_eq!(rules(&text, Some("p")), [expected], "{keys}");
        }
        assert_eq!(rules(&format!("<svg>{}</svg>", path("")), None), [true]);
        let root = format!("<svg style='fill-rule:evenodd'>{}</svg>", path(""));
        assert_eq!((rules(&root, None), rules(&root, Some("p"))), (vec![false], vec![false]));
        // An element that is used inherits from `use`, not from its own surroundings.
        let used = format!(
            "<svg><defs fill-rule='evenodd'>{}</defs><use href='#p' fill-rule='nonzero'/><use href='#p'/></svg>",
            path("")
        );
        assert_eq!(rules(&used, None), [true, true]);
    }
}
