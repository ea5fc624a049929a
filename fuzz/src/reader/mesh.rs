//! Reads meshes and material libraries, in a scene that shows them.

use super::scene;
use crate::seeds::SCENES;
use crate::seeds::memory_files::MemoryFiles;
use crate::verdict::{Tried, refused};
use files::Budget;
use render::scene::mesh_file::{self, Near};
use render::scene::{mtl, obj};
use render::shape::mesh::NONE;

/// A scene with one mesh.
const SCENE: &str = r#"{"format": "tb-scene", "version": 1,
    "camera": {"eye": [0, 2, 5], "target": [0, 0.3, 0], "up": [0, 1, 0], "fov_deg": 40},
    "background": 0.5, "ambient": 0.3,
    "lights": [{"directional": {"direction": [1, -2, -1], "color": 1}}],
    "textures": {"net": {"image": "../textures/net.png"}}, "materials": {"m": {}},
    "objects": [{"mesh": {"name": "tried", "material": "m", "texture": "net"}}]}"#;

/// A scene with one mesh and a material library.
const LIBRARY: &str = r#"{"format": "tb-scene", "version": 1,
    "camera": {"eye": [0, 2, 5], "target": [0, 0.3, 0], "up": [0, 1, 0], "fov_deg": 40},
    "background": 0.5, "ambient": 0.3,
    "lights": [{"directional": {"direction": [1, -2, -1], "color": 1}}],
    "materials": {"m": {}},
    "objects": [{"mesh": {"name": "tried", "mtl": "tried.mtl", "material": "m"}}]}"#;

/// The path of the tried library.
const PATH: &str = "examples/scenes/tried.mtl";

/// A mesh that uses materials of the seeds.
const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n\
    usemtl clay\nf 1/1 2/2 3/3\nusemtl glass\nf 1/1 3/2 4/3\nusemtl picture\nf 2/1 3/2 4/3\n";

/// Memory for a mesh, in bytes.
const MEMORY: u64 = 256 << 20;

/// Largest number of vertices, and of triangles, of a mesh that is rendered.
const MOST: usize = 20_000;

/// Reads a mesh and renders it.
///
/// # Errors
/// When the mesh is refused, or its picture is wrong.
pub fn read_obj(bytes: &[u8], stored: &MemoryFiles) -> Tried {
    let mesh = obj::read("tried.obj", bytes).map_err(refused)?;
    if mesh.triangles.len() > MOST || mesh.positions.len() > MOST {
        return Ok(());
    }
    let textured = mesh.triangles.iter().all(|triangle| !triangle.uv.contains(&NONE));
    let scene = if textured { SCENE.into() } else { SCENE.replace(", \"texture\": \"net\"", "") };
    scene::read_with(scene.as_bytes(), stored, &[("tried", mesh)])
}

/// Reads a mesh file of any format through a scene that names it, and renders it with the materials that it
/// holds.
///
/// # Errors
/// When the mesh is refused, or its picture is wrong.
pub fn read_file(ending: &str, bytes: &[u8], stored: &MemoryFiles) -> Tried {
    let name = format!("tried.{ending}");
    let (budget, mut kept) = (Budget::new(MEMORY), Vec::new());
    let reserve = &mut |bytes| {
        kept.push(budget.reserve(bytes, || name.clone())?);
        Ok(())
    };
    let near = Near { folder: SCENES.as_ref(), source: stored, reserve };
    let read = mesh_file::read(&name, bytes, near).map_err(refused)?;
    if read.mesh.triangles.len() > MOST || read.mesh.positions.len() > MOST {
        return Ok(());
    }
    let material = if read.materials.is_empty() { r#", "material": "m""# } else { "" };
    let file = format!(r#""name": "tried", "file": "{name}"{material}"#);
    let scene = SCENE.replace(r#""name": "tried", "material": "m", "texture": "net""#, &file);
    scene::read(scene.as_bytes(), &stored.with(&format!("{SCENES}/{name}"), bytes))
}

/// Reads a library and renders a mesh with its materials.
///
/// # Errors
/// When the library is refused, or its picture is wrong.
pub fn read_mtl(bytes: &[u8], stored: &MemoryFiles) -> Tried {
    mtl::read("tried.mtl", bytes).map_err(refused)?;
    let mesh = obj::read("tried.obj", MESH.as_bytes()).map_err(refused)?;
    scene::read_with(LIBRARY.as_bytes(), &stored.with(PATH, bytes), &[("tried", mesh)])
}
