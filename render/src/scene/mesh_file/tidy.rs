//! Numbers of a mesh that are not finite, in files of any format but OBJ, whose reader sees to its own.

use super::error::MeshFileError;
use crate::scene::obj::ObjFile;
use crate::shape::mesh::NONE;
use crate::shape::offset;
use glam::DVec3;
use std::collections::HashSet;

/// Takes normals and texture coordinates that are not finite for missing ones, and colours for black. Gives
/// the mesh its positions, from an offset if they lie far from the origin. Vertices that no face uses may
/// have any numbers.
///
/// # Errors
/// If a face uses a vertex that is not finite, or the arrays are not a mesh.
pub(super) fn tidy(
    file: &str,
    read: &mut ObjFile,
    positions: &[DVec3],
) -> Result<(), MeshFileError> {
    let mesh = &mut read.mesh;
    let is_finite = |numbers: &[f32]| numbers.iter().all(|x| x.is_finite());
    for normal in mesh.normals.iter_mut().filter(|normal| !is_finite(&normal[..])) {
        *normal = [0.0; 3];
    }
    for color in mesh.colors.iter_mut().filter(|color| !is_finite(&color[..])) {
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
    let used = || mesh.triangles.iter().flat_map(|triangle| triangle.position);
    let is_single = |at: DVec3| at.as_vec3().is_finite();
    if let Some(vertex) = used().find(|&vertex| !is_single(positions[vertex as usize])) {
        let DVec3 { x, y, z } = positions[vertex as usize];
        return Err(MeshFileError::Part {
            file: file.into(),
            found: format!("vertex {vertex} at ({x:?}, {y:?}, {z:?})"),
            expected: "three numbers within 3.4e38, since a face uses it".into(),
        });
    }
    mesh.offset = offset::of(used().map(|vertex| positions[vertex as usize]));
    let own = |&at: &DVec3| {
        let own = (at - mesh.offset).as_vec3();
        if own.is_finite() { own.to_array() } else { [0.0; 3] }
    };
    mesh.positions = positions.iter().map(own).collect();
    mesh.check().map_err(|source| MeshFileError::Mesh { file: file.into(), source })
}
