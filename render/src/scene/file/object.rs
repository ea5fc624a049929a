//! `objects` of a scene file.

use crate::scene::schema;
use files::names::each_name_once;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// One of `objects`.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ObjectFile {
    /// A sphere.
    Sphere(SphereFile),
    /// A rectangle, or any parallelogram.
    Rectangle(RectangleFile),
    /// A plane without end.
    Plane(PlaneFile),
    /// A box along the axes.
    Box(BoxFile),
    /// A superellipsoid or a supertoroid.
    Superquadric(SuperquadricFile),
    /// A mesh of triangles.
    Mesh(MeshFile),
}

impl ObjectFile {
    /// The key that it stands under.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Rectangle(_) => "rectangle",
            Self::Plane(_) => "plane",
            Self::Box(_) => "box",
            Self::Superquadric(_) => "superquadric",
            Self::Mesh(_) => "mesh",
        }
    }
}

/// A sphere with its poles along y.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SphereFile {
    /// Its centre, in the unit of length.
    pub center: [f64; 3],
    /// Its radius, in the unit of length, above 0: 1e-30 to 1e30.
    #[schemars(transform = schema::positive)]
    pub radius: f64,
    /// The name of its material.
    pub material: String,
    /// The name of the texture that goes once around it; none if left out.
    pub texture: Option<String>,
    /// Steps that place the object, the first one first; none if left out.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A parallelogram; its outside is where `edge_u` x `edge_v` points to.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleFile {
    /// The corner at which both edges begin, in the unit of length.
    pub corner: [f64; 3],
    /// The edge along which the texture goes across.
    pub edge_u: [f64; 3],
    /// The edge along which the texture goes up; not parallel to the other.
    pub edge_v: [f64; 3],
    /// The name of its material.
    pub material: String,
    /// The name of its texture; none if left out.
    pub texture: Option<String>,
    /// How often the texture lies on it, across and up, above 0: 1e-30 to 1e30; once if left out.
    #[serde(default = "once")]
    #[schemars(transform = schema::positive)]
    pub repeat: [f64; 2],
    /// Steps that place the object, the first one first; none if left out.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A plane; its texture fills the parallelogram at `point` and goes on from there.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneFile {
    /// A point of it, in the unit of length.
    pub point: [f64; 3],
    /// A direction in it, as long as the texture is wide.
    pub edge_u: [f64; 3],
    /// Another direction in it, as long as the texture is high.
    pub edge_v: [f64; 3],
    /// The name of its material.
    pub material: String,
    /// The name of its texture; none if left out.
    pub texture: Option<String>,
    /// Steps that place the object, the first one first; none if left out.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A box; its texture fills each of its faces, upright on the four sides.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    /// The corner with the smallest coordinates, in the unit of length.
    pub low: [f64; 3],
    /// The opposite corner: more than `low` in each coordinate.
    pub high: [f64; 3],
    /// The name of its material.
    pub material: String,
    /// The name of its texture; none if left out.
    pub texture: Option<String>,
    /// Steps that place the object, the first one first; none if left out.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A superellipsoid, or with a ring a supertoroid, about the axis y; its texture goes round it as on a
/// sphere, or around the tube of a ring.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SuperquadricFile {
    /// Its centre, in the unit of length.
    pub center: [f64; 3],
    /// Half its size along each axis, or that of the tube of a ring, above 0: 1e-30 to 1e30.
    #[schemars(transform = schema::positive)]
    pub radii: [f64; 3],
    /// Of the section through the axis and of the one across it, 0.05 to 4: a square near 0, a
    /// circle at 1, a square on its corner at 2, a star above.
    #[schemars(transform = schema::range(0.05..=4.0))]
    pub exponents: [f64; 2],
    /// How far the middle of a ring's tube is from the axis, in units of the radii: 1 to 1000; not a
    /// ring if left out.
    #[schemars(transform = schema::range(1.0..=1000.0))]
    pub ring: Option<f64>,
    /// The name of its material.
    pub material: String,
    /// The name of its texture; none if left out.
    pub texture: Option<String>,
    /// Steps that place the object, the first one first; none if left out.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// A mesh of triangles.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// The name by which `--mesh` and jobs give it.
    pub name: String,
    /// The OBJ file that is read when it is not given; its path counts from this file's folder.
    pub file: Option<PathBuf>,
    /// A material library of another tool (MTL), by the names that `usemtl` gives; its path counts from
    /// this file's folder. What `materials` and `textures` bind goes before it. Of the library are read
    /// `Kd`, `map_Kd`, `Ks`, `Ns`, `d` or `Tr`, and `Ni`; none if left out.
    pub mtl: Option<PathBuf>,
    /// The name of the material of all surfaces that neither `materials` nor `mtl` binds.
    pub material: Option<String>,
    /// The name of the texture of all surfaces that neither `textures` nor `mtl` binds; none if left
    /// out.
    pub texture: Option<String>,
    /// Names of materials by surface ids, or by the names that `usemtl` gives.
    #[serde(default, deserialize_with = "each_name_once")]
    pub materials: BTreeMap<String, String>,
    /// Names of textures by texture ids, or by the names that `usemtl` gives.
    #[serde(default, deserialize_with = "each_name_once")]
    pub textures: BTreeMap<String, String>,
    /// Steps that place the object, the first one first; none if left out.
    #[serde(default)]
    pub place: Vec<StepFile>,
}

/// One of the steps of `place`.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
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
#[derive(Debug, Clone, Deserialize, JsonSchema)]
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
