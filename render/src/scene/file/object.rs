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
}

fn once() -> [f64; 2] {
    [1.0; 2]
}
