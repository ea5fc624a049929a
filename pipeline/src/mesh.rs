//! Makes the grids of an object within the memory budget, and converts the triangles of `triangulate` to the mesh of
//! `render`.

use crate::PipelineError;
use files::memory::of_process;
use files::words::shown;
use render::shape::Mesh;
use render::shape::mesh::Triangle;
use sweep::Object;
use sweep::grid::GridMesh;
use triangulate::TriMesh;

/// Returns the grids of an object. `name` is that of its mesh, for messages.
///
/// # Errors
/// When the grids, their triangles and the copy that is rendered take more memory than the process may use, or a point is
/// not finite.
pub fn grids(object: &Object, name: &str) -> Result<Vec<GridMesh>, PipelineError> {
    let points = object.parts().iter().map(|part| {
        let [rows, cols] = part.points();
        (rows as u64).saturating_mul(cols as u64)
    });
    let points: u64 = points.sum();
    let bytes = points.saturating_mul(36).saturating_add(TriMesh::bytes_for(2 * points));
    of_process().check(bytes, || format!("mesh {} of {points} points", shown(name)))?;
    Ok(object.grids()?)
}

/// Returns the mesh that `render` would read from the OBJ that `triangulate` writes: the same numbers
/// in the same order.
#[must_use]
pub fn for_render(mesh: TriMesh) -> Mesh {
    let surfaces = mesh.materials().into_iter().map(triangulate::Material::name).collect();
    let numbers = mesh.material_numbers();
    let triangles = mesh.triangles.iter().zip(numbers).map(|(triangle, surface)| Triangle {
        position: triangle.position,
        uv: triangle.uv,
        normal: triangle.normal,
        surface,
    });
    Mesh {
        triangles: triangles.collect(),
        positions: mesh.positions,
        uvs: mesh.uvs,
        normals: mesh.normals,
        surfaces,
        ..Mesh::default()
    }
}
