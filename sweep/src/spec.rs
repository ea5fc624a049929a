//! The spec: a sweep as JSON, as it is written and not yet checked.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "ring",
//!   "contour": { "circle": 0.25 },
//!   "trajectory": { "circle": { "radius": 1, "center": [0, 0, 0], "axis": [0, 1, 0], "angle_deg": 360 } },
//!   "mesh": { "rows": 96, "cols": 32 },
//!   "uv": { "across": "contour", "repeat": [1, 4] },
//!   "position": [0, 0.25, 0]
//! }
//! ```
//!
//! Lengths are in any one unit; angles are in degrees. `uv`, `areas` ([`Area`]), `position`, `frame`, `scale`,
//! `twist` and `depth` may be left out, and inside the objects `closed` (false), `center` and `origin` (zero), `axis` (y) and
//! `angle_deg` (360). Unknown keys are errors. A **contour** is one of
//!
//! | contour                                         | what                                         |
//! |-------------------------------------------------|----------------------------------------------|
//! | `{"circle": r}`                                 | a circle about the origin                    |
//! | `{"bezier": {"closed": c, "segments": [S, ...]}}` | cubics; `S` is four points `[x, y]`        |
//! | `{"svg": "M0 0 C..."}`                          | one subpath, closed by `Z` or by its end; y is negated, as SVG's points down |
//! | `{"free": {"closed": c, "points": [P, ...]}}`   | a C2 spline through points `[x, y]`, or a curve near them; see [`contour`] |
//! | `{"polyline": {"closed": c, "points": [P, ...]}}` | straight from point to point; see [`contour`] |
//! | `{"sections": [{"at": v, "contour": C}, ...], ...}` | contours that go over into each other |
//!
//! and a **trajectory** is one of
//!
//! | trajectory                                      | what                                         |
//! |-------------------------------------------------|----------------------------------------------|
//! | `{"line": [A, B]}`                              | a straight line                              |
//! | `{"circle": {"radius": r, ...}}`                | a circle or, by `angle_deg`, a part of it      |
//! | `{"helix": {"radius": r, "rise": h, "turns": n, ...}}` | a helix that rises by h in each turn |
//! | `{"bezier": {"closed": c, "segments": [S, ...]}}` | cubics; `S` is four points `[x, y, z]`     |
//! | `{"free": {"closed": c, "points": [P, ...]}}`   | a C2 spline through points `[x, y, z]`       |
//! | `{"polyline": {"closed": c, "points": [P, ...], "corners": K}}` | straight lines through points `[x, y, z]` |
//! | `{"flat": {"curve": C, "z": LAW}}`             | a curve drawn flat like a contour, with a height; see [`Flat`] |
//! | `{"rotation": {"angle_deg": d, ...}}`             | contour x is the distance from an axis, y the height on it |
//!
//! `mesh` counts cells, which become quads: rows along the trajectory, cols along the contour. Going
//! around takes three, a contour at least one for each piece between corners, and all together are
//! at most 100 million. It can ask for a tolerance in their place, as [`mesh`] says. The vessel of a
//! potter is a rotation:
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "bowl",
//!   "contour": { "free": { "points": [[0, 0], [0.5, 0.1], [0.8, 0.5], [0.75, 0.5], [0.45, 0.15], [0, 0.06]] } },
//!   "trajectory": { "rotation": { "origin": [0, 0, 0], "axis": [0, 1, 0], "angle_deg": 360 } },
//!   "mesh": { "rows": 90, "cols": 60 },
//!   "uv": { "across": "trajectory" }
//! }
//! ```
//!
//! A picture lies on the surface by length; with `"by": "parameter"` in `uv`, by the curves' own
//! parameters.
//!
//! # Which side is outside, and where the contour lies
//!
//! Axes are right-handed and y points up. A contour's (x, y) lies on the directions (w1, w2) of a
//! frame with `w1 x w2 = T`, the direction of the trajectory. Closed contours run counter-clockwise
//! there (they are turned round if they do not), which puts their outside outside; so do open ones
//! that a rotation takes from its axis to its axis. The outer side of any other open contour is to
//! the right of its direction of travel.
//!
//! On a circle and a rotation `w1` points away from the axis and `w2` along it. They start where
//! `w1` is as near as can be to the coordinate axis least aligned with their axis (x before y
//! before z): with the axis at y on the side of +x, from where they run toward +z. So does a helix,
//! which is left-handed then if it rises, and right-handed if its turns are below 0; on its way its
//! frame turns as little as it can.
//!
//! Any other trajectory starts with `w1` as near as can be to the coordinate axis least aligned
//! with its direction. From there the frame turns about the trajectory as little as it can, and
//! along a closed one it is turned evenly so that it closes.
//!
//! A spec can choose for itself what `w1` starts toward: `"frame": {"start": [x, y, z]}`. Or it fixes
//! the frame everywhere, by `up`, `frenet` or `guide`; see [`Frame`].
//!
//! # Laws: scale and twist
//!
//! A **law** is a number that may change along the trajectory, by the fraction `at` of its length:
//!
//! | law                                             | what                                         |
//! |-------------------------------------------------|----------------------------------------------|
//! | `x`                                             | the same number everywhere                   |
//! | `{"keys": [[at, x], ...], "ease": "smooth"}`    | from key to key, `linear` (the default) or `smooth`; held outside |
//! | `{"bezier": [[[at, x], ... four], ...]}`        | the graph of a curve, along which `at` rises; held outside |
//! | `{"total": x}`                                  | from 0 at the start evenly to x at the end   |
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "drill",
//!   "contour": { "svg": "M1 1H-1V-1H1Z" },
//!   "trajectory": { "line": [[0, 0, 0], [0, 9, 0]] },
//!   "scale": [{ "keys": [[0, 0], [0.3, 1]], "ease": "smooth" }, { "bezier": [[[0, 0], [0, 0.8], [0.5, 1], [1, 1]]] }],
//!   "twist": { "total": 270 },
//!   "mesh": { "rows": 90, "cols": 40 }
//! }
//! ```
//!
//! `scale` is one law for both axes of the contour or two, for x and y. Where both are 0 the surface has
//! a pole. Factors below 0 on both axes turn the contour by half, so that a scale may pass through 0: it
//! has a pole there, at a row of its own, and the outside stays outside. A factor below 0 on one axis
//! mirrors the contour, whose columns then run the other way round; only one axis must not pass 0 on its
//! way, as the surface would turn inside out. `twist` then turns the contour about the trajectory, in degrees,
//! right-handed about its direction. Along a closed trajectory a scale ends as it starts, and a
//! twist ends a multiple of 360 degrees from there, since each column meets itself. About the axis
//! of a rotation there is no twist; its scale stays above 0 on x and apart from 0 on y, and wants a contour off the axis.
//! A law whose derivative jumps, as linear keys do, gives the surface an edge with one normal.
//!
//! # Depth
//!
//! `depth` is a relief on the contour, made of waves: `delta` is the sum over `terms` of
//! `amp * along(v) * sin(2 pi (u_count u + v_count v) + phase)`. Where `mode` is `factor` the contour
//! is multiplied by `1 + delta`, which must stay above 0; where it is `offset` the contour, which has
//! no corners then, is moved along its outer normal by `delta`. The rest acts on the contour with its
//! relief. Counts are whole along closed curves; all keys of a term but `amp` may be left out.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "candle",
//!   "contour": { "circle": 0.4 },
//!   "trajectory": { "line": [[0, 0, 0], [0, 2, 0]] },
//!   "depth": { "mode": "offset", "terms": [{ "amp": 0.05, "u": 8, "v": 1.5, "phase_deg": 90, "along": { "total": 1 } }] },
//!   "mesh": { "rows": 60, "cols": 96 }
//! }
//! ```
//!
//! Heights may come from a grey picture, alone or besides `terms`:
//! `"image": {"file": "relief.png", "amp": a, "repeat": [x, y], "zero": 0.5}` adds `a (grey - zero)`, where
//! black is 0 and white is 1. The file is a PNG of 8 or 16 bits, named from the spec's folder; its numbers
//! are heights, whatever its colour space, and transparency is not looked at. It lies on the surface as
//! a texture does that `uv` lays `across` the same way, `repeat` times (once if left out), and is smooth
//! between its texels. Along a closed curve it repeats, a whole number of times; along an open one
//! it is mirrored at its edges.
//!
//! # Seam, caps, deformations, parts
//!
//! [`SeamKind`] closes one-sided surfaces, to which a `wall` gives a thickness; [`Caps`] close the ends; [`Deform`] bends, twists and tapers the finished surface; [`Parts`] are
//! several sweeps in one object.
//!
//! # Corners
//!
//! A contour may have corners; one of more than a degree is a crease, where the surface has two
//! normals. A trajectory may not, unless it says by `corners` whether they are rounded or mitred; see
//! [`Corners`]. A rotation wants contour x
//! of at least 0; where it is 0 the surface has a pole. Points given twice count once.

mod areas;
mod caps;
pub mod contour;
mod corners;
mod deform;
mod depth;
mod flat;
mod frame;
mod helix;
mod law;
pub mod mesh;
mod parts;
mod seam;
mod trajectory;
mod turn;

pub use areas::Area;
pub use caps::{Cap, Caps};
pub use contour::{Contour, FreeContour};
pub use corners::{Bezier3, Corners, Polyline3};
pub use deform::{AxisTwist, Bend, Deform, Taper};
pub use depth::{Depth, DepthImage, DepthMode, DepthTerm};
pub use flat::Flat;
pub use frame::{Frame, Frenet};
pub use helix::Helix;
pub use law::{Ease, Law, Scale};
pub use mesh::{Camera, Mesh};
pub use parts::Parts;
pub use seam::SeamKind;
pub use trajectory::Trajectory;
pub use turn::{Circle, Rotation};

use crate::grid::UvLayout;
use crate::schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The value of `format`.
pub const FORMAT: &str = "tb-sweep";

/// The value of `version`.
pub const VERSION: u32 = 1;

/// A spec as it is written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object, a sweep's spec")]
pub struct Spec {
    /// Where an editor finds the schema of this file; passed over.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// `tb-sweep`; may be left out in a part of an object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("const" = FORMAT))]
    pub format: Option<String>,
    /// 1; may be left out in a part of an object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("const" = VERSION))]
    pub version: Option<u32>,
    /// The object's name; one word.
    #[schemars(transform = schema::word)]
    pub name: String,
    /// What is swept.
    pub contour: Contour,
    /// What it is swept along.
    pub trajectory: Trajectory,
    /// How the contour's axes lie along the trajectory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<Frame>,
    /// Factors of the contour along the trajectory; 1 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Scale>,
    /// Turn of the contour about the trajectory, in degrees, right-handed; 0 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twist: Option<Law>,
    /// Relief on the contour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<Depth>,
    /// How it comes back to its start, where columns do not meet themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seam: Option<SeamKind>,
    /// The thickness of a wall in place of a sheet, in the unit of length; of mirrored closed surfaces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::positive)]
    pub wall: Option<f64>,
    /// What closes the ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub caps: Option<Caps>,
    /// What happens to the surface in the end, one after another.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub deform: Vec<Deform>,
    /// How finely.
    pub mesh: Mesh,
    /// How a picture lies on the surface.
    #[serde(default)]
    pub uv: UvLayout,
    /// Parts with pictures of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub areas: Vec<Area>,
    /// The texture id of its triangles, which a scene binds to a picture; 0 is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::id)]
    pub texture: Option<u32>,
    /// The surface id of its triangles, which a scene binds to a material.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = schema::id)]
    pub surface: Option<u32>,
    /// By how much the whole is moved in the end, `[x, y, z]` in the unit of length.
    #[serde(default)]
    pub position: [f64; 3],
}

/// Cubic Bezier segments, each of which starts where the one before it ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key segments, and closed if it is")]
#[schemars(inline)]
pub struct Bezier<P> {
    /// Whether the last segment ends at the start of the first, and continues there.
    #[serde(default)]
    pub closed: bool,
    /// Four control points each, at least one segment; a segment starts where the one before ends.
    #[schemars(transform = schema::at_least(1))]
    pub segments: Vec<[P; 4]>,
}

/// Points that a C2 spline goes through.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key points, and closed if it is")]
#[schemars(inline, transform = schema::loop_of_three)]
pub struct Free<P> {
    /// Whether the last point leads on to the first, which is not given again.
    #[serde(default)]
    pub closed: bool,
    /// At least two points, three when closed.
    #[schemars(transform = schema::at_least(2))]
    pub points: Vec<P>,
}

/// The one value of a kind that is there.
fn only<T, const N: usize>(kind: &str, keys: [(&str, Option<T>); N]) -> Result<T, String> {
    let names = keys.each_ref().map(|key| key.0).join(", ");
    let mut given = keys.into_iter().filter_map(|(name, value)| value.map(|value| (name, value)));
    match (given.next(), given.next()) {
        (Some((_, value)), None) => Ok(value),
        (Some((first, _)), Some((second, _))) => {
            Err(format!("found both `{first}` and `{second}`, expected one of {names}"))
        }
        (None, _) => Err(format!("found no {kind}, expected one of {names}")),
    }
}

fn up() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}

#[cfg(test)]
mod tests {
    use super::Mesh;
    use crate::Object;
    use files::Disk;
    use files::json::Document;
    use std::path::Path;

    /// The pages that show specs, and how many each shows.
    const PAGES: [(&str, usize); 10] = [
        (include_str!("spec.rs"), 4),
        (include_str!("spec/caps.rs"), 1),
        (include_str!("spec/contour.rs"), 3),
        (include_str!("spec/corners.rs"), 2),
        (include_str!("spec/deform.rs"), 1),
        (include_str!("spec/flat.rs"), 1),
        (include_str!("spec/frame.rs"), 3),
        (include_str!("spec/mesh.rs"), 1),
        (include_str!("spec/parts.rs"), 1),
        (include_str!("spec/seam.rs"), 2),
    ];

    #[test]
    fn the_snippets_on_the_pages_are_specs() {
        for (page, count) in PAGES {
            let lines = page.lines().map_while(|line| line.strip_prefix("//!"));
            let page: String = lines.map(|line| format!("{line}\n")).collect();
            let snippets =
                page.split("```json").skip(1).filter_map(|rest| rest.split("```").next());
            let snippets: Vec<&str> = snippets.collect();
            assert_eq!(snippets.len(), count);
            for snippet in snippets {
                let document = Document::new("snippet", snippet.as_bytes()).unwrap();
                let object = Object::read(&document, Path::new(""), &Disk, &Mesh::default())
                    .unwrap_or_else(|error| panic!("{error}"));
                for grid in object.grids().unwrap() {
                    assert_eq!(grid.positions.len(), grid.rows() * grid.cols());
                }
            }
        }
    }
}
