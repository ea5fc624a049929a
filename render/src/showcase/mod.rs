//! Makes a scene that shows one mesh: a camera that frames it, a ground below it and lights around it.
//!
//! The scene is the text of a scene file, so that it can be kept and edited. All lengths are multiples of the mesh's
//! radius, so that meshes of any size and at any distance from the origin look alike:
//!
//! | part | choice |
//! |---|---|
//! | camera | the nearest one that sees the whole mesh within a margin ([`fit`]) |
//! | ground | a plane below the lowest corner, unless the camera would be under it |
//! | lights | a cluster of points above the camera, for soft shadows; a weak light from the right |
//! | background | the colour that the ground has at the horizon, which therefore is not seen |
//!
//! The lights fade with distance, so that the ground is darker far from the mesh.

pub mod fit;
pub mod look;
pub mod paint;
mod text;
pub mod view;

pub use look::Look;
pub use paint::Paint;
pub use view::{Up, View};

use crate::scene::obj::{self, ObjFile};
use crate::shape::mesh::{NONE, as_dvec3};
use files::{Exit, Failure, Source};
use fit::{Frame, Sphere};
use glam::DVec3;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Name of a mesh that has no other one.
pub const MESH: &str = "mesh";

/// First bytes of a binary STL that `triangulate` wrote. Its meshes have y upwards, unless they were turned.
const OUR_STL: &[u8] = b"topobook triangulate STL";

/// The reason why a mesh cannot be shown.
#[derive(Debug, Error)]
pub enum ShowcaseError {
    /// The mesh has no triangles.
    #[error("{0}: found no triangles, expected at least one")]
    Empty(String),
    /// A texture needs coordinates, which the mesh lacks.
    #[error(
        "--picture: {0} has triangles without texture coordinates, expected them at each corner"
    )]
    NoCoordinates(String),
}

impl Failure for ShowcaseError {
    fn exit(&self) -> Exit {
        Exit::Malformed
    }
}

/// A mesh to be shown, and the names under which its scene finds it.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The mesh, as it was read.
    pub mesh: &'a ObjFile,
    /// Name of the mesh in messages.
    pub name: &'a str,
    /// Name of the mesh in the scene.
    pub given: &'a str,
    /// Path of the mesh from the folder of the scene; `None` if the scene is given the mesh.
    pub file: Option<&'a Path>,
    /// Path of the texture from the folder of the scene.
    pub texture: Option<&'a Path>,
    /// The axis that points up if the look names none.
    pub up: Up,
    /// True if the surfaces have materials or colours of their own.
    pub has_colors: bool,
    /// Width of the picture over its height.
    pub aspect: f64,
    /// True if the background is transparent, and nothing but the mesh is shown.
    pub alone: bool,
    /// True for soft shadows. A picture with hard ones has one light above the camera and takes less time.
    pub is_soft: bool,
}

/// Returns the axis that points up in a mesh file, by its format: z in STL, and y in all others. An STL of `triangulate`
/// has y upwards too.
#[must_use]
pub fn up_of(name: &str, bytes: &[u8]) -> Up {
    let is_stl = Path::new(name).extension().is_some_and(|ext| ext.eq_ignore_ascii_case("stl"));
    if is_stl && !bytes.starts_with(OUR_STL) { Up::Z } else { Up::Y }
}

/// Returns whether the surfaces of a mesh have colours of their own: materials inside the file, a library that can be
/// read, or colours of vertices.
#[must_use]
pub fn has_colors(read: &ObjFile, source: &dyn Source) -> bool {
    let is_there = |name: &String| {
        let name = name.replace('\\', "/");
        let beside = name.rsplit('/').next().unwrap_or(&name).to_owned();
        let words = name.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        let mut names = [name.clone(), beside].into_iter().chain(words);
        names.any(|name| source.read(&read.folder.join(name.trim())).is_ok())
    };
    read.colored > 0 || !read.materials.is_empty() || read.libraries.iter().any(is_there)
}

/// Returns the path of a file as a scene in a folder names it.
#[must_use]
pub fn seen_from(folder: &Path, file: &Path) -> PathBuf {
    if folder.as_os_str().is_empty() || folder == Path::new(".") {
        return file.into();
    }
    std::path::absolute(file).unwrap_or_else(|_| file.into())
}

/// Returns the text of the scene file that shows a mesh.
///
/// # Errors
/// If the mesh has no triangles, or has none of the texture coordinates that a texture needs.
pub fn scene(subject: &Subject<'_>, look: &Look) -> Result<String, ShowcaseError> {
    let mesh = &subject.mesh.mesh;
    let used = mesh.triangles.iter().flat_map(|triangle| triangle.position);
    let corners = used.map(|index| as_dvec3(mesh.positions[index as usize]) + mesh.offset);
    let corners = || corners.clone();
    let sphere =
        Sphere::around(corners()).ok_or_else(|| ShowcaseError::Empty(subject.name.into()))?;
    let is_bare = mesh.triangles.iter().any(|triangle| triangle.uv[0] == NONE);
    if subject.texture.is_some() && is_bare {
        return Err(ShowcaseError::NoCoordinates(subject.name.into()));
    }
    let up = look.up.unwrap_or(subject.up);
    let frame = Frame::of(look.view, up);
    let eye = frame.eye(corners(), &sphere, subject.aspect);
    let lowest = corners().map(|at| at.dot(up.axis())).fold(f64::INFINITY, f64::min);
    let level = lowest - GAP * sphere.radius;
    let is_above = eye.dot(up.axis()) > level;
    let has_ground = is_above && !look.no_ground && !subject.alone;
    Ok(text::Staging { subject, look, up, frame, eye, sphere, level, has_ground }.text())
}

/// Distance of the ground from the lowest corner, in radii. A flat mesh on the ground would coincide with it if there
/// were no gap. A larger gap would separate an object from its shadow.
const GAP: f64 = 1e-3;

/// Returns whether some surface of the mesh has a texture id of `triangulate`, to which a scene must bind a texture.
fn names_textures(mesh: &ObjFile) -> bool {
    let mut ids = mesh.mesh.surfaces.iter().filter_map(|name| obj::ids(name));
    ids.any(|[texture, _]| texture != "0")
}

/// Returns the surface ids of `triangulate` in a mesh other than 0, which has the colour of the whole mesh.
fn further_surfaces(mesh: &ObjFile) -> BTreeSet<&str> {
    let ids = mesh.mesh.surfaces.iter().filter_map(|name| obj::ids(name));
    ids.map(|[_, surface]| surface).filter(|&surface| surface != "0").collect()
}

/// Returns the direction with this azimuth from `front` towards `right`, and this elevation above them, in radians.
fn direction([right, up, front]: [DVec3; 3], azimuth: f64, elevation: f64) -> DVec3 {
    let flat = azimuth.cos() * front + azimuth.sin() * right;
    elevation.cos() * flat + elevation.sin() * up
}
