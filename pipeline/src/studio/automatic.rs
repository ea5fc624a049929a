//! The scene of a spec that has none: that of `pipeline show`, with hard shadows, which take less time.

use super::folder::Folder;
use super::source::Edited;
use crate::{PipelineError, mesh};
use files::json::Document;
use glam::DVec3;
use render::scene::obj::ObjFile;
use render::shape::Mesh;
use render::shape::mesh::{NONE, Triangle};
use render::showcase::{self, Look, Subject, Up};
use std::collections::BTreeMap;
use std::path::Path;
use sweep::Object;
use sweep::spec::Resolution;
use triangulate::Options;

/// Cells along and across the mesh that the camera frames. With fewer, the camera might cut off a part of a thin bow.
const CELLS: usize = 48;

/// Returns the text of a scene that shows the surface of a spec as a mesh with this name. For a spec with a fault, the
/// scene frames a cube of side 2.
#[must_use]
pub fn scene(folder: &Folder, path: &str, text: &str, name: &str) -> String {
    let mesh = coarse(folder, path, text).unwrap_or_else(|_| cube());
    let is_empty = mesh.triangles.is_empty();
    staged(&if is_empty { cube() } else { mesh }.into(), name)
}

fn staged(mesh: &ObjFile, name: &str) -> String {
    let subject = Subject {
        mesh,
        name,
        given: name,
        file: None,
        texture: None,
        up: Up::Y,
        has_colors: false,
        aspect: 1.0,
        alone: false,
        is_soft: false,
    };
    // Only a mesh without triangles has no scene.
    showcase::scene(&subject, &Look::default()).unwrap_or_default()
}

/// Makes the surface of a spec with few cells.
fn coarse(folder: &Folder, path: &str, text: &str) -> Result<Mesh, PipelineError> {
    let document = Document::new(path, text.as_bytes())?;
    let source = Edited { texts: BTreeMap::new(), folder: folder.clone() };
    let below = Path::new(path).parent().unwrap_or(Path::new(""));
    let coarse = Resolution { rows: Some(CELLS), cols: Some(CELLS), ..Resolution::default() };
    let read = |resolution: &Resolution| Object::read(&document, below, &source, resolution);
    // Corners and loops may need the cells that are stated.
    let object = read(&coarse).or_else(|_| read(&Resolution::default()))?;
    let grids = mesh::grids(&object, path)?;
    Ok(mesh::for_render(triangulate::mesh(grids.as_slice(), &Options::default())?))
}

/// Returns triangles through the corners of a cube of side 2 around the origin.
fn cube() -> Mesh {
    let corner = |k: u8| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { 1.0 } else { -1.0 });
    let side = |position| Triangle { position, uv: [NONE; 3], normal: [NONE; 3], surface: 0 };
    Mesh {
        offset: DVec3::ZERO,
        positions: (0..8).map(corner).collect(),
        triangles: vec![side([0, 1, 2]), side([3, 4, 5]), side([5, 6, 7])],
        surfaces: vec![String::new()],
        ..Mesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use render::scene::read;

    const SPEC: &str = r#"{ "format": "tb-sweep", "version": 1, "name": "pipe",
        "contour": { "circle": 0.5 }, "trajectory": { "line": [[4, 0, 0], [4, 7, 1]] },
        "mesh": { "rows": 4, "cols": 12 } }"#;

    /// Every corner is nearer to the middle of the view than the nearest point of the edge of the picture.
    #[test]
    fn the_camera_sees_the_whole_surface_and_a_fault_has_a_scene_too() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(place.path()).unwrap();
        for (text, corners) in
            [(SPEC, [[3.5, 0.0, 0.0], [4.5, 7.0, 1.0]]), ("{", [[-1.0; 3], [1.0; 3]])]
        {
            let scene = scene(&folder, "pipe.json", text, "pipe");
            let document = Document::new("a.json", scene.as_bytes()).unwrap();
            let file = read::parse(&document).unwrap();
            let camera = read::camera_of(&document, &file).unwrap();
            let size = DVec2::splat(100.0);
            let forward = camera.ray(0.5 * size, size).direction;
            let widest = camera.ray(DVec2::new(50.0, 0.0), size).direction.dot(forward);
            for corner in corners.map(DVec3::from) {
                let toward = (corner - camera.eye()).normalize();
                assert!(toward.dot(forward) > widest, "{corner}");
            }
        }
    }
}
