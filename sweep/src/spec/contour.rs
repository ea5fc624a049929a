//! Contours as they are written: the curves that are swept.
//!
//! A **polyline** goes straight from point to point; where it turns by more than a degree it has a
//! corner, and the surface a crease. Two points are a line; a closed one takes three. Points given
//! twice count once:
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "gutter",
//!   "contour": { "polyline": { "points": [[1, 1], [0.8, 0], [-0.8, 0], [-1, 1]] } },
//!   "trajectory": { "line": [[0, 0, 0], [0, 0, 4]] },
//!   "mesh": { "rows": 8, "cols": 12 }
//! }
//! ```

use super::{Bezier, Free, only};
use serde::{Deserialize, Serialize};

/// A curve in the plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", try_from = "ContourKeys")]
pub enum Contour {
    /// A circle about the origin, by its radius.
    Circle(f64),
    /// Cubic Bezier segments.
    Bezier(Bezier<[f64; 2]>),
    /// The `d` attribute of an SVG path.
    Svg(String),
    /// Points that a spline goes through.
    Free(Free<[f64; 2]>),
    /// Points with straight lines between them.
    Polyline(Free<[f64; 2]>),
}

/// The keys of a contour as they are read, so that none and two of them get a sentence.
#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with one of the keys circle, bezier, svg, free, polyline"
)]
struct ContourKeys {
    circle: Option<f64>,
    bezier: Option<Bezier<[f64; 2]>>,
    svg: Option<String>,
    free: Option<Free<[f64; 2]>>,
    polyline: Option<Free<[f64; 2]>>,
}

impl TryFrom<ContourKeys> for Contour {
    type Error = String;

    fn try_from(keys: ContourKeys) -> Result<Self, String> {
        only(
            "curve",
            [
                ("circle", keys.circle.map(Self::Circle)),
                ("bezier", keys.bezier.map(Self::Bezier)),
                ("svg", keys.svg.map(Self::Svg)),
                ("free", keys.free.map(Self::Free)),
                ("polyline", keys.polyline.map(Self::Polyline)),
            ],
        )
    }
}

#[cfg(test)]
mod tests {
    use crate::spec::tests::swept_snippets;

    #[test]
    fn the_snippets_above_are_specs() {
        assert_eq!(swept_snippets(include_str!("contour.rs")), 1);
    }
}
