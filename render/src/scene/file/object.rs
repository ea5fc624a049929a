//! The key `objects` of a scene file.

use super::keywords;
use files::Place;
use files::names::each_name_once;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// An object of the scene.
//
// A new shape provides, and the compiler leads to each `match`:
//
// - a struct `XFile` here, with `material`, `texture` and `place` as the others have, and a row in the
//   table of file.rs; the comments of its fields are the descriptions of the JSON Schema;
// - its variant, with `kind` and `mesh` below, in scene/read/objects.rs, which checks each number, and in
//   scene/check/subject.rs;
// - tests: each complaint in render/tests/shape_complaints.rs; an example in examples/scenes, which
//   render/tests/schema.rs also mutates.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ObjectFile {
    /// A sphere.
    Sphere(SphereFile),
    /// A rectangle or any other parallelogram.
    Rectangle(RectangleFile),
    /// An infinite plane.
    Plane(PlaneFile),
    /// A box with faces perpendicular to the axes.
    Box(BoxFile),
    /// A superellipsoid or a supertoroid.
    Superquadric(SuperquadricFile),
    /// A mesh of triangles.
    Mesh(MeshFile),
}

impl ObjectFile {
    /// Returns the key of the object in its file.
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

    /// Returns the mesh, if the object is one.
    #[must_use]
    pub fn mesh(&self) -> Option<&MeshFile> {
        match self {
            Self::Mesh(mesh) => Some(mesh),
            Self::Sphere(_)
            | Self::Rectangle(_)
            | Self::Plane(_)
            | Self::Box(_)
            | Self::Superquadric(_) => None,
        }
    }
}

/// A sphere with its poles along y.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SphereFile {
    /// Centre of the sphere, in the unit of length.
    pub center: [f64; 3],
    /// Radius of the sphere, in the unit of length, above 0: 1e-30 to 1e30.
    #[schemars(transform = keywords::positive)]
    pub radius: f64,
    /// Name of the material.
    pub material: String,
    /// Name of the texture, which covers the sphere once; none if left out.
    pub texture: Option<String>,
    /// Place of the object: a step, or a list of steps; where it is defined if left out.
    #[serde(default)]
    pub place: Place,
}

/// A parallelogram. Its outside is the side to which `edge_u` x `edge_v` points.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleFile {
    /// The corner at which both edges start, in the unit of length.
    pub corner: [f64; 3],
    /// The edge along which the texture goes across, in the unit of length.
    pub edge_u: [f64; 3],
    /// The edge along which the texture goes up, in the unit of length; not parallel to `edge_u`.
    pub edge_v: [f64; 3],
    /// Name of the material.
    pub material: String,
    /// Name of the texture; none if left out.
    pub texture: Option<String>,
    /// Number of repetitions of the texture, across and up, above 0: 1e-30 to 1e30; once if left
    /// out.
    #[serde(default = "once")]
    #[schemars(transform = keywords::positive)]
    pub repeat: [f64; 2],
    /// Place of the object: a step, or a list of steps; where it is defined if left out.
    #[serde(default)]
    pub place: Place,
}

/// An infinite plane. Its texture fills the parallelogram at `point` and continues over the plane.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneFile {
    /// A point of the plane, in the unit of length.
    pub point: [f64; 3],
    /// A vector in the plane, as long as the texture is wide.
    pub edge_u: [f64; 3],
    /// A vector in the plane, as long as the texture is high; not parallel to `edge_u`.
    pub edge_v: [f64; 3],
    /// Name of the material.
    pub material: String,
    /// Name of the texture; none if left out.
    pub texture: Option<String>,
    /// Place of the object: a step, or a list of steps; where it is defined if left out.
    #[serde(default)]
    pub place: Place,
}

/// A box. Its texture fills each of its faces and is upright on the four sides.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    /// The corner with the smallest coordinates, in the unit of length.
    pub low: [f64; 3],
    /// The opposite corner, larger than `low` in each coordinate.
    pub high: [f64; 3],
    /// Name of the material.
    pub material: String,
    /// Name of the texture; none if left out.
    pub texture: Option<String>,
    /// Place of the object: a step, or a list of steps; where it is defined if left out.
    #[serde(default)]
    pub place: Place,
}

/// A superellipsoid or, with `ring`, a supertoroid about the axis y. Its texture covers it as on a
/// sphere, or goes around the tube of a ring.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SuperquadricFile {
    /// Centre of the shape, in the unit of length.
    pub center: [f64; 3],
    /// Half the size along each axis, of the shape or of the tube of a ring, above 0: 1e-30 to
    /// 1e30.
    #[schemars(transform = keywords::positive)]
    pub radii: [f64; 3],
    /// Exponents of the section through the axis and of the section across it, 0.05 to 4. A section
    /// is a square near 0, a circle at 1, a square on its corner at 2, and a star above 2.
    #[schemars(transform = keywords::range(0.05..=4.0))]
    pub exponents: [f64; 2],
    /// Distance of the middle of a ring's tube from the axis, in units of the radii: 1 to 1000; not
    /// a ring if left out.
    #[schemars(transform = keywords::range(1.0..=1000.0))]
    pub ring: Option<f64>,
    /// Name of the material.
    pub material: String,
    /// Name of the texture; none if left out.
    pub texture: Option<String>,
    /// Place of the object: a step, or a list of steps; where it is defined if left out.
    #[serde(default)]
    pub place: Place,
}

/// A mesh of triangles.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// Name of the mesh, to which `--mesh` and jobs refer.
    pub name: String,
    /// OBJ, STL, PLY or glTF file that is read if `--mesh` or a job gives no mesh; relative to this file's
    /// folder.
    pub file: Option<PathBuf>,
    /// Material library (MTL) of another tool, or a list of several, by the names that `usemtl` gives;
    /// relative to this file's folder. The bindings of `materials` and `textures` take precedence. If
    /// left out, the libraries that the file names, or its own materials, serve the surfaces that nothing
    /// else binds. `Kd`, `map_Kd`, `Ks`, `Ns`, `d` or `Tr`, and `Ni` of a library are read.
    pub mtl: Option<OneOrMore>,
    /// Largest angle between two faces, in degrees, that still shade as one: 0 to 180. Corners without
    /// normals get mean normals. If left out, only faces in a smoothing group (`s`) of the OBJ file do.
    #[schemars(transform = keywords::range(0.0..=180.0))]
    pub smooth_deg: Option<f64>,
    /// Name of the material of all surfaces that neither `materials` nor `mtl` binds.
    pub material: Option<String>,
    /// Name of the texture of all surfaces that neither `textures` nor `mtl` binds; none if left
    /// out.
    pub texture: Option<String>,
    /// Names of materials by surface ids, or by the names that `usemtl` gives; none if left out.
    #[serde(default, deserialize_with = "each_name_once")]
    pub materials: BTreeMap<String, String>,
    /// Names of textures by texture ids, or by the names that `usemtl` gives; none if left out.
    #[serde(default, deserialize_with = "each_name_once")]
    pub textures: BTreeMap<String, String>,
    /// Place of the object: a step, or a list of steps; where it is defined if left out.
    #[serde(default)]
    pub place: Place,
    /// Places of copies of the mesh, each a step or a list of steps that follow those of `place`. Every copy is
    /// an object of its own, and the mesh is stored once. One object if left out.
    #[schemars(length(min = 1))]
    pub instances: Option<Vec<Place>>,
}

impl MeshFile {
    /// Number of objects of the scene that show the mesh.
    #[must_use]
    pub fn placements(&self) -> usize {
        self.instances.as_ref().map_or(1, Vec::len)
    }
}

/// A path, or a list of paths.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a path or a list of paths")]
pub enum OneOrMore {
    /// One path.
    One(PathBuf),
    /// Several paths.
    More(Vec<PathBuf>),
}

impl OneOrMore {
    /// Returns the paths.
    #[must_use]
    pub fn all(&self) -> &[PathBuf] {
        match self {
            Self::One(path) => std::slice::from_ref(path),
            Self::More(paths) => paths,
        }
    }
}

fn once() -> [f64; 2] {
    [1.0; 2]
}
