//! `objects` of a scene file.

use files::names::each_name_once;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// One of `objects`.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub enum ObjectFile {
    Sphere(SphereFile),
    Rectangle(RectangleFile),
    Plane(PlaneFile),
    Box(BoxFile),
    Superquadric(SuperquadricFile),
    Mesh(MeshFile),
}

/// A sphere.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct SphereFile {
    pub center: [f64; 3],
    pub radius: f64,
    pub material: String,
    pub texture: Option<String>,
    /// Steps that place the object, the first one first; none by default.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A parallelogram.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct RectangleFile {
    pub corner: [f64; 3],
    pub edge_u: [f64; 3],
    pub edge_v: [f64; 3],
    pub material: String,
    pub texture: Option<String>,
    #[serde(default = "once")]
    pub repeat: [f64; 2],
    /// Steps that place the object, the first one first; none by default.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A plane; its texture fills the parallelogram at `point` and goes on from there.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct PlaneFile {
    pub point: [f64; 3],
    pub edge_u: [f64; 3],
    pub edge_v: [f64; 3],
    pub material: String,
    pub texture: Option<String>,
    /// Steps that place the object, the first one first; none by default.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A box; its texture fills each of its faces.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct BoxFile {
    pub low: [f64; 3],
    /// More than `low` in each coordinate.
    pub high: [f64; 3],
    pub material: String,
    pub texture: Option<String>,
    /// Steps that place the object, the first one first; none by default.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A superellipsoid, or with a ring a supertoroid, about the axis y.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct SuperquadricFile {
    pub center: [f64; 3],
    /// Half its size along each axis, or that of the tube of a ring; more than 0.
    pub radii: [f64; 3],
    /// Of the section through the axis and of the one across it, 0.05 to 4: a square near 0, a
    /// circle at 1, a square on its corner at 2, a star above.
    pub exponents: [f64; 2],
    /// How far the middle of a ring's tube is from the axis, in units of the radii, 1 to 1000.
    pub ring: Option<f64>,
    pub material: String,
    pub texture: Option<String>,
    /// Steps that place the object, the first one first; none by default.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A mesh.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct MeshFile {
    pub name: String,
    pub file: Option<PathBuf>,
    pub material: Option<String>,
    pub texture: Option<String>,
    #[serde(default, deserialize_with = "each_name_once")]
    pub materials: BTreeMap<String, String>,
    #[serde(default, deserialize_with = "each_name_once")]
    pub textures: BTreeMap<String, String>,
    /// Steps that place the object, the first one first; none by default.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// One of the steps of `place`.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum StepFile {
    /// Factors along the axes, about the origin; below 0 they mirror.
    Scale([f64; 3]),
    /// A turn about an axis through the origin.
    RotateDeg(RotateDegFile),
    /// A move.
    Translate([f64; 3]),
    /// Any affine map: three rows of four numbers, the last of which is the move.
    Matrix([[f64; 4]; 3]),
}

/// A turn about an axis through the origin.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotateDegFile {
    /// Its direction, of any length but 0.
    pub axis: [f64; 3],
    /// In degrees, counter-clockwise as seen from where the axis points.
    pub angle: f64,
}

fn once() -> [f64; 2] {
    [1.0; 2]
}
