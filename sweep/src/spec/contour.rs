//! Contours as they are written: the curves that are swept.
//!
//! A **polyline** is straight from point to point. Where it turns by more than a degree it has a corner, and
//! the surface has a crease. An open polyline needs two points, a closed one three. A point given twice in a
//! row counts once:
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "gutter",
//!   "contour": { "polyline": { "points": [[1, 1], [0.8, 0], [-0.8, 0], [-1, 1]] } },
//!   "trajectory": { "line": [[0, 0, 0], [0, 0, 4]] },
//!   "mesh": { "rows": 8, "cols": 12 }
//! }
//! ```
//!
//! # Points that are measured or drawn by hand
//!
//! **Free** points with a `fit` are not interpolated: a curve of few cubics passes within that distance of
//! every point. The curve has a corner where the points turn by 30 degrees more than they do around it.
//! Everywhere else it is smooth, also at the start of a closed curve. A turn is measured over legs at least 8
//! `fit` long on both sides, so noise of half a `fit` makes no corner. A bend smaller than the legs may
//! become a corner.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "moulding",
//!   "contour": { "free": { "fit": 0.02, "points": [
//!     [0.00, 0.00], [0.10, 0.01], [0.21, 0.00], [0.30, 0.00], [0.40, 0.01], [0.40, 0.10], [0.39, 0.21], [0.40, 0.30],
//!     [0.41, 0.40], [0.43, 0.50], [0.48, 0.59], [0.56, 0.66], [0.65, 0.70], [0.75, 0.71], [0.85, 0.70], [0.95, 0.71]] } },
//!   "trajectory": { "line": [[0, 0, 0], [0, 0, 4]] },
//!   "mesh": { "rows": 8, "cols": 40 }
//! }
//! ```
//!
//! # Outlines and holes
//!
//! Several closed subpaths of an `svg`, or a list of `loops`, are outlines and holes of one section. Each loop becomes a
//! patch of the object, and flat caps close all of them together. By the rule `even_odd` (the default) a point inside an
//! odd number of loops is inside; by `nonzero` the directions of the loops count, as in SVG. Loops must not cross or
//! touch. `"offset": [x, y]` moves any contour, and `"center": true` moves the middle of its box to the origin first:
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "flange",
//!   "contour": { "loops": [{ "circle": 5 }, { "circle": 2 }, { "circle": 0.5, "offset": [3.5, 0] }, { "circle": 0.5, "offset": [-3.5, 0] }] },
//!   "trajectory": { "line": [[0, 0, 0], [0, 1, 0]] },
//!   "caps": { "start": "flat", "end": "flat" },
//!   "mesh": { "rows": 1, "cols": 64 }
//! }
//! ```
//!
//! # Several contours
//!
//! **Sections** are contours at positions `at` on the trajectory, as fractions of its length. Each section
//! blends into the next; before the first and after the last the shape is constant. All sections are closed,
//! or all are open. `blend` is `linear` (the default), with an edge in the surface at each section, or
//! `smooth`:
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "funnel",
//!   "contour": {
//!     "sections": [
//!       { "at": 0, "contour": { "circle": 0.5 } },
//!       { "at": 0.7, "contour": { "polyline": { "closed": true, "points": [[1, 1], [-1, 1], [-1, -1], [1, -1]] } } }
//!     ],
//!     "blend": "smooth"
//!   },
//!   "trajectory": { "line": [[0, 0, 0], [0, 3, 0]] },
//!   "mesh": { "rows": 40, "cols": 64 }
//! }
//! ```
//!
//! Points at the same fraction of the length correspond, however many points a contour was drawn with. The
//! start of each closed contour is moved to where the contour matches the one before it best. There the sum
//! of squared distances about the centroids is least, and a corner goes to a corner if that is nearly as
//! good. `"align": false` keeps the starts as drawn. A corner of one section is a crease along the whole
//! surface. Along a closed trajectory the last section blends into the first; sections at both 0 and 1 must
//! then have the same contour. The sections of a rotation must not touch the axis.

use super::svg::Svg;
use super::{Bezier, Ease, Free, SvgFile, only};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A curve in the plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "ContourKeys", into = "ContourKeys")]
pub enum Contour {
    /// A circle about the origin, given by its radius.
    Circle(f64),
    /// Cubic Bezier segments.
    Bezier(Bezier<[f64; 2]>),
    /// The `d` attribute of an SVG path.
    Svg(String),
    /// Outlines in an SVG file.
    SvgFile(SvgFile),
    /// Points that a spline passes through, or that a curve is fitted to.
    Free(FreeContour),
    /// Points with straight lines between them.
    Polyline(Free<[f64; 2]>),
    /// Contours that blend into each other along the trajectory.
    Sections(Sections),
    /// Several loops: outlines and holes.
    Loops(Loops),
    /// A contour that is moved.
    Moved(Box<Moved>),
}

/// Loops inside and beside each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Loops {
    /// The loops, each a contour.
    pub loops: Vec<Contour>,
    /// True for the list under `loops`; false for an SVG path with a rule.
    pub named: bool,
    /// The rule that says which points are inside.
    pub rule: Option<Rule>,
}

/// The rule that says which points are inside several loops.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// Points about which the loops wind a number of times that is not 0.
    Nonzero,
    /// Points about which the loops wind an odd number of times.
    EvenOdd,
}

/// A contour and a translation of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// The contour before it is moved.
    pub contour: Contour,
    /// True if the middle of its box is moved to the origin first.
    pub center: bool,
    /// The translation `[x, y]`.
    pub offset: [f64; 2],
}

/// Points in the plane that a C2 spline passes through, or that few cubics are fitted to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key points, and any of closed, fit")]
#[schemars(transform = limits::loop_of_three)]
pub struct FreeContour {
    /// True if the curve returns from the last point to the first, which is not repeated.
    #[serde(default)]
    pub closed: bool,
    /// The points `[x, y]`: at least two, or three if closed.
    #[schemars(transform = limits::at_least(2))]
    pub points: Vec<[f64; 2]>,
    /// Largest distance of a point from the curve, in the unit of length, above 0. If left out, the curve
    /// passes through all points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::positive)]
    pub fit: Option<f64>,
}

/// Contours at positions on the trajectory, and the blend between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sections {
    /// The sections: at least two, with `at` strictly rising.
    pub sections: Vec<Section>,
    /// Interpolation between two neighbouring sections.
    pub blend: Ease,
    /// True if the starts of closed contours are moved to match.
    pub align: bool,
}

/// A contour and its position on the trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys at and contour")]
pub struct Section {
    /// Position on the trajectory, as a fraction of its length in `[0, 1]`.
    #[schemars(transform = limits::range(0.0..=1.0))]
    pub at: f64,
    /// The contour at this position; not `sections`.
    #[schemars(transform = limits::without(&["sections"]))]
    pub contour: Contour,
}

/// The keys of a contour as they are read. With this type, a missing or a second key gets an error message of
/// its own.
#[derive(Default, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with one of the keys circle, bezier, svg, free, polyline, sections, loops"
)]
#[schemars(extend("dependentRequired" = {"blend": ["sections"], "align": ["sections"], "rule": [], "center": [], "offset": []}), transform = limits::one_of)]
struct ContourKeys {
    /// A circle about the origin, given by its radius, above 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::positive)]
    circle: Option<f64>,
    /// Cubic Bezier segments.
    #[serde(skip_serializing_if = "Option::is_none")]
    bezier: Option<Bezier<[f64; 2]>>,
    /// The `d` attribute of an SVG path, whose y points down, or an SVG file. Several closed subpaths are outlines and
    /// holes.
    #[serde(skip_serializing_if = "Option::is_none")]
    svg: Option<Svg>,
    /// Points `[x, y]` that a spline passes through, or that a curve is fitted to.
    #[serde(skip_serializing_if = "Option::is_none")]
    free: Option<FreeContour>,
    /// Points `[x, y]` with straight lines between them.
    #[serde(skip_serializing_if = "Option::is_none")]
    polyline: Option<Free<[f64; 2]>>,
    /// Contours that blend into each other, from 2 to 1000, with `at` rising.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::at_least(2))]
    sections: Option<Vec<Section>>,
    /// Interpolation between neighbouring sections; `linear` if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    blend: Option<Ease>,
    /// True if the starts of closed sections are moved to match; true if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    align: Option<bool>,
    /// Contours inside and beside each other: outlines and holes, at least one. None of them has `sections`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::at_least(1))]
    loops: Option<Vec<Contour>>,
    /// The rule that says which points are inside `svg` or `loops`; `even_odd` if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    rule: Option<Rule>,
    /// True if the middle of the contour's box is moved to the origin; not of `sections`.
    #[serde(skip_serializing_if = "Option::is_none")]
    center: Option<bool>,
    /// Translation of the contour, `[x, y]`, after `center`; not of `sections`.
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<[f64; 2]>,
}

impl TryFrom<ContourKeys> for Contour {
    type Error = String;

    fn try_from(keys: ContourKeys) -> Result<Self, String> {
        for (key, given) in [("blend", keys.blend.is_some()), ("align", keys.align.is_some())] {
            if given && keys.sections.is_none() {
                return Err(format!("found `{key}` without `sections`, which it belongs to"));
            }
        }
        if keys.rule.is_some() && keys.svg.is_none() && keys.loops.is_none() {
            return Err("found `rule` without `svg` or `loops`, which it belongs to".into());
        }
        let moved = keys.center.is_some() || keys.offset.is_some();
        if moved && keys.sections.is_some() {
            return Err(
                "found `center` or `offset` beside `sections`, expected them in each section"
                    .into(),
            );
        }
        let (center, offset) = (keys.center.unwrap_or(false), keys.offset.unwrap_or_default());
        let ruled = |svg: Svg| {
            let own = match svg {
                Svg::Path(text) => Self::Svg(text),
                Svg::File(file) => Self::SvgFile(file),
            };
            match keys.rule {
                None => own,
                rule => Self::Loops(Loops { loops: vec![own], named: false, rule }),
            }
        };
        let loops = |loops| Self::Loops(Loops { loops, named: true, rule: keys.rule });
        let (blend, align) = (keys.blend.unwrap_or_default(), keys.align.unwrap_or(true));
        let sections = |sections| Self::Sections(Sections { sections, blend, align });
        let contour = only(
            "curve",
            [
                ("circle", keys.circle.map(Self::Circle)),
                ("bezier", keys.bezier.map(Self::Bezier)),
                ("svg", keys.svg.map(ruled)),
                ("free", keys.free.map(Self::Free)),
                ("polyline", keys.polyline.map(Self::Polyline)),
                ("sections", keys.sections.map(sections)),
                ("loops", keys.loops.map(loops)),
            ],
        )?;
        Ok(if moved { Self::Moved(Box::new(Moved { contour, center, offset })) } else { contour })
    }
}

impl From<Contour> for ContourKeys {
    fn from(contour: Contour) -> Self {
        let none = Self::default();
        match contour {
            Contour::Circle(radius) => Self { circle: Some(radius), ..none },
            Contour::Bezier(bezier) => Self { bezier: Some(bezier), ..none },
            Contour::Svg(text) => Self { svg: Some(Svg::Path(text)), ..none },
            Contour::SvgFile(file) => Self { svg: Some(Svg::File(file)), ..none },
            Contour::Free(free) => Self { free: Some(free), ..none },
            Contour::Polyline(line) => Self { polyline: Some(line), ..none },
            Contour::Sections(Sections { sections, blend, align }) => {
                Self { sections: Some(sections), blend: Some(blend), align: Some(align), ..none }
            }
            Contour::Loops(Loops { loops, named: true, rule }) => {
                Self { loops: Some(loops), rule, ..none }
            }
            Contour::Loops(Loops { loops, named: false, rule }) => {
                let first = loops.into_iter().next().map(Self::from).unwrap_or_default();
                Self { rule, ..first }
            }
            Contour::Moved(moved) => {
                let Moved { contour, center, offset } = *moved;
                Self { center: Some(center), offset: Some(offset), ..contour.into() }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Contour;

    #[test]
    fn contours_survive_writing_and_reading() {
        for text in [
            r#"{"circle":2.5}"#,
            r#"{"svg":"M0 0H1"}"#,
            r#"{"svg":{"file":"a.svg","id":"b"}}"#,
            r#"{"polyline":{"closed":true,"points":[[0.0,0.0],[1.0,0.0],[1.0,1.0]]}}"#,
            r#"{"sections":[{"at":0.0,"contour":{"circle":1.0}}],"blend":"smooth","align":false}"#,
        ] {
            let contour: Contour = serde_json::from_str(text).unwrap();
            assert_eq!(serde_json::to_string(&contour).unwrap(), text);
        }
    }
}
