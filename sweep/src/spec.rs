//! The spec: a sweep written as JSON, before it is checked.
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
//! Lengths are in any one unit, angles in degrees. `"unit"` states the unit: `um`, `mm`, `cm`, `in`, `ft` or `m`. A grid
//! keeps it. These keys may be left out: `unit`, `uv`, `areas` ([`Area`]), `place` ([`Step`](files::place::Step)) and `copies` ([`Copies`]), `position`, `frame`, `scale`, `twist` and `depth`, and inside the objects `closed` (false), `center` and
//! `origin` (zero), `axis` (y) and `angle_deg` (360). Unknown keys are errors. A **contour** is one of
//!
//! | contour                                         | what                                         |
//! |-------------------------------------------------|----------------------------------------------|
//! | `{"circle": r}`                                 | a circle of radius r about the origin        |
//! | `{"bezier": {"closed": c, "segments": [S, ...]}}` | cubics; `S` is four points `[x, y]`        |
//! | `{"svg": {"file": F, "id": I}}`                   | outlines of an SVG file; see [`SvgFile`]     |
//! | `{"svg": "M0 0 C..."}`                          | a path, closed by `Z` or by its end; y is negated, because y points down in SVG. Several closed subpaths are outlines and holes |
//! | `{"free": {"closed": c, "points": [P, ...]}}`   | a C2 spline through points `[x, y]`, or a curve fitted to them; see [`contour`] |
//! | `{"polyline": {"closed": c, "points": [P, ...]}}` | straight lines from point to point; see [`contour`] |
//! | `{"sections": [{"at": v, "contour": C}, ...], ...}` | contours that blend into each other      |
//! | `{"loops": [C, ...]}`                           | outlines and holes; see [`contour`]          |
//!
//! and a **trajectory** is one of
//!
//! | trajectory                                      | what                                         |
//! |-------------------------------------------------|----------------------------------------------|
//! | `{"line": [A, B]}`                              | a straight line                              |
//! | `{"circle": {"radius": r, ...}}`                | a circle, or an arc of `angle_deg` degrees   |
//! | `{"helix": {"radius": r, "rise": h, "turns": n, ...}}` | a helix that rises by h in each turn |
//! | `{"bezier": {"closed": c, "segments": [S, ...]}}` | cubics; `S` is four points `[x, y, z]`     |
//! | `{"free": {"closed": c, "points": [P, ...]}}`   | a C2 spline through points `[x, y, z]`       |
//! | `{"polyline": {"closed": c, "points": [P, ...], "corners": K}}` | straight lines through points `[x, y, z]` |
//! | `{"flat": {"curve": C, "z": LAW}}`             | a plane curve drawn like a contour, with z given by a law; see [`Flat`] |
//! | `{"formula": {"x": F, "y": F, "z": F, "t": [a, b]}}` | formulas of the coordinates; points may have radii, scales and twists of their own: see [`Measured`] |
//! | `{"swc": {"file": F}}`                          | neurites of an SWC file; see [`Swc`] |
//! | `{"rotation": {"angle_deg": d, ...}}`             | contour x is the distance from an axis, contour y the height along it |
//!
//! `mesh` counts cells, which become quads: `rows` along the trajectory and `cols` along the contour. A
//! closed direction needs at least three cells. A contour needs at least one cell for each piece between
//! corners. The grid may have at most 100 million cells. Instead of counts, `mesh` can give a tolerance; see
//! [`resolution`]. A vessel turned on a potter's wheel is a rotation:
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
//! Texture coordinates are proportional to arc length. With `"by": "parameter"` in `uv` they follow the
//! curves' own parameters.
//!
//! # Which side is outside, and where the contour lies
//!
//! Axes are right-handed and y points up. A contour's (x, y) lies on the directions (w1, w2) of a frame with
//! `w1 x w2 = T`, the direction of the trajectory. Closed contours run counter-clockwise in (w1, w2), so that
//! their normals point out of the area they enclose; a clockwise contour is reversed. So is an open contour
//! of a rotation that starts and ends on the axis and runs clockwise. The outer side of any other open
//! contour is to the right of its direction of travel.
//!
//! On a circle and a rotation `w1` points away from the axis and `w2` along it. The sweep starts where `w1`
//! is nearest to the coordinate axis least aligned with the axis of the circle or rotation (x before y before
//! z). If the axis is y, the sweep starts on the side of +x and runs toward +z. A helix starts on the same side and turns
//! right-handed about its axis, toward -z, if its `turns` are above 0. The frame of a helix is rotation-minimizing.
//!
//! Any other trajectory starts with `w1` as near as possible to the coordinate axis least aligned with its
//! direction. From there the frame turns about the trajectory as little as possible. Along a closed
//! trajectory an even extra turn makes the last frame equal the first.
//!
//! A spec can choose the direction of `w1` at the start: `"frame": {"start": [x, y, z]}`. Or it fixes the
//! frame everywhere, by `up`, `frenet` or `guide`; see [`Frame`].
//!
//! # Laws: scale and twist
//!
//! A **law** is a number that may change along the trajectory. Its argument `at` is the fraction of the
//! trajectory's length.
//!
//! | law                                             | what                                         |
//! |-------------------------------------------------|----------------------------------------------|
//! | `x`                                             | the same number everywhere                   |
//! | `{"keys": [[at, x], ...], "ease": "smooth"}`    | interpolated between keys, `linear` (the default) or `smooth`; constant outside |
//! | `{"bezier": [[[at, x], ... four], ...]}`        | the graph of a Bezier curve along which `at` rises; constant outside |
//! | `{"total": x}`                                  | linear from 0 at the start to x at the end   |
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
//! `scale` is one law for both axes of the contour, or two laws, for x and y. Where both factors are 0 the
//! surface has a pole. Factors below 0 on both axes turn the contour by half a turn. So both factors may pass
//! through 0 together: the surface has a pole there, at a row of its own, and the outside stays outside. A
//! factor below 0 on one axis mirrors the contour, whose columns then run in the other direction. One factor
//! alone must not change its sign along the trajectory, as the surface would turn inside out.
//!
//! `twist` turns the scaled contour about the trajectory, in degrees, right-handed about its direction. Along
//! a closed trajectory a scale ends with the value it starts with. A twist ends a multiple of 360 degrees
//! from its start, so that each column meets itself. A rotation has no twist. Its scale must be above 0 on x
//! and must not reach 0 on y, and its contour must not touch the axis. Where the derivative of a law jumps,
//! as at linear keys, the surface has an edge with one normal.
//!
//! # Depth
//!
//! `depth` is a relief on the contour, made of waves: `delta` is the sum over `terms` of
//! `amp * along(v) * sin(2 pi (u_count u + v_count v) + phase)`. If `mode` is `factor`, the contour is
//! multiplied by `1 + delta`, which must stay above 0. If `mode` is `offset`, the contour is moved along its
//! outer normal by `delta`. Scale and twist act on the contour with its
//! relief: with a scale of 2, heights are twice as large on the surface, and `--check` states the factor. Without a scale
//! heights are lengths of the finished surface.
//!
//! An offset fades at corners, and any relief fades at the axis of a rotation and at the rim of a wall, where it would
//! tear the surface. `fade` is the length of the contour along which it fades, a twentieth of the contour if left out;
//! if given, the relief fades at all corners and ends. See [`fade`](crate::surface::fade) for the rule. Counts are whole numbers along closed curves. All keys of a term except `amp` may be left out.
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
//! Heights may come from a grey picture, alone or in addition to `terms`:
//! `"image": {"file": "relief.png", "amp": a, "repeat": [x, y], "zero": 0.5}` adds `a (grey - zero)`, where
//! black is 0 and white is 1. The file is a PNG of 8 or 16 bits; its path is relative to the spec's folder.
//! Its numbers are read as heights, whatever its colour space, and transparency is ignored. The picture lies
//! on the surface like a texture with the same `across` in `uv`, `repeat` times (once if left out). Between
//! its texels the heights are smooth. Along a closed curve the picture repeats a whole number of times. Along
//! an open curve it is mirrored at its edges.
//!
//! # Seam, caps, deformations, parts
//!
//! [`SeamKind`] closes one-sided surfaces, and [`Wall`] makes a sweep hollow, or gives a one-sided surface a
//! thickness. [`Caps`] close the ends. [`Deform`] bends, twists and tapers the finished surface. [`Parts`] are several sweeps in one
//! object.
//!
//! # Corners
//!
//! A contour may have corners. A corner of more than a degree is a crease, where the surface has two normals.
//! A trajectory may have corners only if `corners` says whether they are rounded or mitred; see [`Corners`].
//! The contour of a rotation must have x of at least 0; where x is 0 the surface has a pole. A point given
//! twice in a row counts once.

mod areas;
mod caps;
pub mod contour;
mod copies;
mod corners;
mod deform;
mod depth;
mod flat;
mod frame;
mod helix;
mod law;
mod measured;
mod parts;
mod pieces;
pub mod resolution;
pub mod schema;
mod seam;
mod svg;
mod table;
mod trajectory;
mod turn;
mod wall;

pub use crate::law::Ease;
pub use areas::Area;
pub use caps::{Cap, Caps};
pub use contour::{Contour, FreeContour};
pub use copies::Copies;
pub use corners::{Bezier3, Corners};
pub use deform::{AxisTwist, Bend, Deform, Taper};
pub use depth::{Depth, DepthImage, DepthMode, DepthTerm};
pub use flat::Flat;
pub use frame::{Away, Frame, Frenet};
pub use helix::Helix;
pub use law::{Law, Scale};
pub use measured::{FormulaCurve, Measured};
pub use parts::Parts;
pub use resolution::{Camera, Resolution};
pub use seam::SeamKind;
pub use svg::SvgFile;
pub use table::{Csv, Swc, TableColumn};
pub use trajectory::Trajectory;
pub use turn::{Circle, Rotation};
pub use wall::{Rim, Wall, WallKeys, WallSide};

use crate::grid::{Unit, UvLayout};
use crate::limits;
use files::Place;
use files::note::Note;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The value of `format`.
pub const FORMAT: &str = "tb-sweep";

/// The value of `version`.
pub const VERSION: u32 = 1;

/// A spec of one sweep, before it is checked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object, a sweep's spec")]
pub struct Spec {
    /// Path or URL of this file's JSON Schema, for editors; ignored by the reader.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// The format, `tb-sweep`; may be left out in a part of an object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("const" = FORMAT))]
    pub format: Option<String>,
    /// The version of the format, 1; may be left out in a part of an object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("const" = VERSION))]
    pub version: Option<u32>,
    /// The object's name; one word.
    #[schemars(transform = limits::word)]
    pub name: String,
    /// Sentences for people; ignored by the reader.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<Note>,
    /// The unit of length of all numbers; not in a part of an object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// The curve that is swept.
    pub contour: Contour,
    /// The curve that the contour is swept along, or a rotation.
    pub trajectory: Trajectory,
    /// Orientation of the contour's axes along the trajectory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<Frame>,
    /// Factors of the contour's x and y along the trajectory; 1 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Scale>,
    /// Rotation of the contour about the trajectory, in degrees, right-handed; 0 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twist: Option<Law>,
    /// Relief on the contour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<Depth>,
    /// How the end of the surface meets its start, if columns do not meet themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seam: Option<SeamKind>,
    /// Wall of a hollow sweep or of a vessel; with `"seam": "mirror"` the thickness of a wall around the sheet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall: Option<Wall>,
    /// The closures of the two ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub caps: Option<Caps>,
    /// Deformations of the finished surface, applied one after another before `position`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub deform: Vec<Deform>,
    /// Resolution of the surface: counts of cells, or a tolerance.
    #[serde(rename = "mesh")]
    pub resolution: Resolution,
    /// How texture coordinates lie on the surface.
    #[serde(default)]
    pub uv: UvLayout,
    /// Rectangles of cells with textures of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub areas: Vec<Area>,
    /// Texture id of the triangles, which a scene binds to a picture; 0 means none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::id)]
    pub texture: Option<u32>,
    /// Surface id of the triangles, which a scene binds to a material.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::id)]
    pub surface: Option<u32>,
    /// Translation of the finished surface, `[x, y, z]` in the unit of length.
    #[serde(default)]
    pub position: [f64; 3],
    /// Place of the finished surface after `position`: a step, or a list of steps, that scale all directions alike and
    /// do not mirror.
    #[serde(default, skip_serializing_if = "Place::is_empty")]
    pub place: Place,
    /// Copies of the finished surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub copies: Option<Copies>,
}

/// Cubic Bezier segments, each of which starts where the one before it ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key segments, and closed if it is")]
#[schemars(inline)]
pub struct Bezier<P> {
    /// True if the last segment ends at the start of the first.
    #[serde(default)]
    pub closed: bool,
    /// Four control points for each segment. At least one segment; each starts where the one before it ends.
    #[serde(deserialize_with = "pieces::read", bound(deserialize = "P: Deserialize<'de>"))]
    #[schemars(transform = limits::at_least(1))]
    pub segments: Vec<[P; 4]>,
}

/// Points that a C2 spline passes through.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key points, and closed if it is")]
#[schemars(inline, transform = limits::loop_of_three)]
pub struct Free<P> {
    /// True if the curve returns from the last point to the first, which is not repeated.
    #[serde(default)]
    pub closed: bool,
    /// The points: at least two, or three if closed.
    #[schemars(transform = limits::at_least(2))]
    pub points: Vec<P>,
}

/// Returns the one value that is given, or a message if there is none or more than one.
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
    use super::Resolution;
    use crate::sampling::Object;
    use files::Disk;
    use files::json::Document;
    use std::path::Path;

    /// Pages that show specs, with the number of specs on each.
    const PAGES: [(&str, usize); 14] = [
        (include_str!("spec.rs"), 4),
        (include_str!("spec/caps.rs"), 1),
        (include_str!("spec/contour.rs"), 4),
        (include_str!("spec/corners.rs"), 2),
        (include_str!("spec/deform.rs"), 1),
        (include_str!("spec/flat.rs"), 1),
        (include_str!("spec/frame.rs"), 3),
        (include_str!("spec/resolution.rs"), 1),
        (include_str!("spec/helix.rs"), 1),
        (include_str!("spec/measured.rs"), 2),
        (include_str!("spec/parts.rs"), 1),
        (include_str!("spec/copies.rs"), 1),
        (include_str!("spec/seam.rs"), 2),
        (include_str!("spec/wall.rs"), 3),
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
                let object = Object::read(&document, Path::new(""), &Disk, &Resolution::default())
                    .unwrap_or_else(|error| panic!("{error}"));
                for grid in object.grids().unwrap() {
                    assert_eq!(grid.positions.len(), grid.rows() * grid.cols());
                }
            }
        }
    }
}
