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
}

fn once() -> [f64; 2] {
    [1.0; 2]
}
