//! Converts the triangles of `triangulate` to the mesh of `render`.

use render::shape::Mesh;
use render::shape::mesh::Triangle;
use triangulate::TriMesh;

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
