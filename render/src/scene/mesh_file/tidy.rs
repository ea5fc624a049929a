//! Numbers of a mesh that are not finite, in files of any format but OBJ, whose reader sees to its own.

use super::error::MeshFileError;
use crate::scene::obj::ObjFile;
use crate::shape::mesh::NONE;
use std::collections::HashSet;

/// Takes normals and texture coordinates that are not finite for missing ones, and colours for black. Lets
/// vertices that no face uses have any numbers, and checks the mesh.
///
/// # Errors
/// If a face uses a vertex that is not finite, or the arrays are not a mesh.
pub(super) fn tidy(file: &str, read: &mut ObjFile) -> Result<(), MeshFileError> {
    let mesh = &mut read.mesh;
    let is_finite = |numbers: &[f32]| numbers.iter().all(|x| x.is_finite());
    for normal in mesh.normals.iter_mut().filter(|normal| !is_finite(&normal[..])) {
        *normal = [0.0; 3];
    }
    for color in read.colors.iter_mut().filter(|color| !is_finite(&color[..])) {
        *color = [0.0; 3];
    }
    let bad: HashSet<u32> =
        (0..).zip(&mesh.uvs).filter(|(_, uv)| !is_finite(&uv[..])).map(|(k, _)| k).collect();
    if !bad.is_empty() {
        for triangle in &mut mesh.triangles {
            if triangle.uv.iter().any(|uv| bad.contains(uv)) {
                triangle.uv = [NONE; 3];
            }
        }
        for &k in &bad {
            mesh.uvs[k as usize] = [0.0; 2];
        }
    }
    let bad: Vec<u32> =
        (0..).zip(&mesh.positions).filter(|(_, p)| !is_finite(&p[..])).map(|(k, _)| k).collect();
    if !bad.is_empty() {
        let used: HashSet<u32> =
            mesh.triangles.iter().flat_map(|triangle| triangle.position).collect();
        if let Some(vertex) = bad.iter().find(|vertex| used.contains(vertex)) {
            let [x, y, z] = mesh.positions[*vertex as usize];
            return Err(MeshFileError::Part {
                file: file.into(),
                found: format!("vertex {vertex} at ({x}, {y}, {z})"),
                expected: "three finite numbers, since a face uses it".into(),
            });
        }
        for vertex in bad {
            mesh.positions[vertex as usize] = [0.0; 3];
        }
    }
    mesh.check().map_err(|source| MeshFileError::Mesh { file: file.into(), source })
}
