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
//! Lengths are in any one unit; angles are in degrees. `uv`, `position`, `frame`, `scale`,
//! `twist` and `depth` may be left out, and inside the objects `closed` (false), `center` and `origin` (zero), `axis` (y) and
//! `angle_deg` (360). Unknown keys are errors. A **contour** is one of
//!
//! | contour                                         | what                                         |
//! |-------------------------------------------------|----------------------------------------------|
//! | `{"circle": r}`                                 | a circle about the origin                    |
//! | `{"bezier": {"closed": c, "segments": [S, ...]}}` | cubics; `S` is four points `[x, y]`        |
//! | `{"svg": "M0 0 C..."}`                          | one subpath, closed by `Z` or by its end; y is negated, as SVG's points down |
//! | `{"free": {"closed": c, "points": [P, ...]}}`   | a C2 spline through points `[x, y]`          |
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
//! | `{"rotation": {"angle_deg": d, ...}}`             | contour x is the distance from an axis, y the height on it |
//!
//! `mesh` counts cells, which become quads: rows along the trajectory, cols along the contour. Going
//! around takes three, a contour at least one for each piece between corners, and all together are
//! at most 100 million. It can ask for a tolerance in their place, as [`mesh`] says. The vessel of a potter is a rotation:
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
//! A spec can choose for itself what `w1` starts toward: `"frame": {"start": [x, y, z]}`.
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
//! `scale` is one law for both axes of the contour or two, for x and y; it is not negative, and where
//! it is 0 the surface has a pole. `twist` then turns the contour about the trajectory, in degrees,
//! right-handed about its direction. Along a closed trajectory a scale ends as it starts, and a
//! twist ends a multiple of 360 degrees from there, since each column meets itself. About the axis
//! of a rotation there is no twist; its scale stays above 0, and wants a contour off the axis.
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
//! # Corners
//!
//! A contour may have corners; one of more than a degree is a crease, where the surface has two
//! normals. A trajectory may not: it would need a mitre, and is refused. A rotation wants contour x
//! of at least 0; where it is 0 the surface has a pole. Points given twice count once.

mod depth;
mod helix;
mod law;
pub mod mesh;

pub use depth::{Depth, DepthMode, DepthTerm};
pub use helix::Helix;
pub use law::{Ease, Law, Scale};
pub use mesh::{Camera, Mesh};

use crate::grid::UvLayout;
use serde::{Deserialize, Serialize};

/// The value of `format`.
pub const FORMAT: &str = "tb-sweep";

/// The value of `version`.
pub const VERSION: u32 = 1;

/// A spec as it is written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object, a sweep's spec")]
pub struct Spec {
    /// `tb-sweep`.
    pub format: String,
    /// 1.
    pub version: u32,
    /// The object's name; one word.
    pub name: String,
    /// What is swept.
    pub contour: Contour,
    /// What it is swept along.
    pub trajectory: Trajectory,
    /// How the frame starts, where the trajectory leaves that open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<FrameStart>,
    /// Factors of the contour along the trajectory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Scale>,
    /// Turn of the contour about the trajectory, in degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twist: Option<Law>,
    /// Relief on the contour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<Depth>,
    /// How finely.
    pub mesh: Mesh,
    /// How a picture lies on the surface.
    #[serde(default)]
    pub uv: UvLayout,
    /// By how much the whole is moved in the end.
    #[serde(default)]
    pub position: [f64; 3],
}

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
}

/// A curve in space, or a rotation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", try_from = "TrajectoryKeys")]
pub enum Trajectory {
    /// A straight line by its ends.
    Line([[f64; 3]; 2]),
    /// A circle or an arc of one.
    Circle(Circle),
    /// A helix.
    Helix(Helix),
    /// Cubic Bezier segments.
    Bezier(Bezier<[f64; 3]>),
    /// Points that a spline goes through.
    Free(Free<[f64; 3]>),
    /// A turn of the contour about an axis in its plane.
    Rotation(Rotation),
}

/// Cubic Bezier segments, each of which starts where the one before it ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the key segments, and closed if it is")]
pub struct Bezier<P> {
    /// Whether the last segment ends at the start of the first, and continues there.
    #[serde(default)]
    pub closed: bool,
    /// Four control points each.
    pub segments: Vec<[P; 4]>,
}

/// Points that a C2 spline goes through.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the key points, and closed if it is")]
pub struct Free<P> {
    /// Whether the last point leads on to the first, which is not given again.
    #[serde(default)]
    pub closed: bool,
    /// At least two points, three when closed.
    pub points: Vec<P>,
}

/// A circle in space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key radius, and any of center, axis, angle_deg"
)]
pub struct Circle {
    /// The distance of the contour's origin from the centre; positive.
    pub radius: f64,
    /// The centre.
    #[serde(default)]
    pub center: [f64; 3],
    /// The direction of the contour's y, of any length.
    #[serde(default = "up")]
    pub axis: [f64; 3],
    /// Above 0, up to 360, which is closed.
    #[serde(default = "full_turn")]
    pub angle_deg: f64,
}

/// A turn of the contour about an axis in its plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with any of the keys angle_deg, origin, axis")]
pub struct Rotation {
    /// Above 0, up to 360, which is closed.
    #[serde(default = "full_turn")]
    pub angle_deg: f64,
    /// Where the contour's origin lies.
    #[serde(default)]
    pub origin: [f64; 3],
    /// The direction of the contour's y, of any length.
    #[serde(default = "up")]
    pub axis: [f64; 3],
}

/// How the frame starts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the key start")]
pub struct FrameStart {
    /// What the contour's x points at, as near as the trajectory lets it.
    pub start: [f64; 3],
}

/// The keys of a contour as they are read, so that none and two of them get a sentence.
#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with one of the keys circle, bezier, svg, free"
)]
struct ContourKeys {
    circle: Option<f64>,
    bezier: Option<Bezier<[f64; 2]>>,
    svg: Option<String>,
    free: Option<Free<[f64; 2]>>,
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
            ],
        )
    }
}

/// The keys of a trajectory as they are read.
#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with one of the keys line, circle, helix, bezier, free, rotation"
)]
struct TrajectoryKeys {
    line: Option<[[f64; 3]; 2]>,
    circle: Option<Circle>,
    helix: Option<Helix>,
    bezier: Option<Bezier<[f64; 3]>>,
    free: Option<Free<[f64; 3]>>,
    rotation: Option<Rotation>,
}

impl TryFrom<TrajectoryKeys> for Trajectory {
    type Error = String;

    fn try_from(keys: TrajectoryKeys) -> Result<Self, String> {
        only(
            "curve",
            [
                ("line", keys.line.map(Self::Line)),
                ("circle", keys.circle.map(Self::Circle)),
                ("helix", keys.helix.map(Self::Helix)),
                ("bezier", keys.bezier.map(Self::Bezier)),
                ("free", keys.free.map(Self::Free)),
                ("rotation", keys.rotation.map(Self::Rotation)),
            ],
        )
    }
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

fn full_turn() -> f64 {
    360.0
}

#[cfg(test)]
mod tests {
    use crate::Sweep;
    use files::json::Document;

    #[test]
    fn the_snippets_above_are_specs() {
        let pages = [include_str!("spec.rs"), include_str!("spec/mesh.rs")];
        let page: String = pages
            .iter()
            .flat_map(|page| page.lines().map_while(|line| line.strip_prefix("//!")))
            .map(|line| format!("{line}\n"))
            .collect();
        let snippets: Vec<&str> =
            page.split("```json").skip(1).filter_map(|rest| rest.split("```").next()).collect();
        assert_eq!(snippets.len(), 5);
        for snippet in snippets {
            let document = Document::new("snippet", snippet.as_bytes()).unwrap();
            let sweep = Sweep::read(&document).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(sweep.grid().positions.len(), sweep.grid().rows() * sweep.grid().cols());
        }
    }
}
