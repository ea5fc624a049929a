//! Vertices that carry position, normal and picture coordinates under one index.
//!
//! OBJ and [`TriMesh`] number the three separately; most other formats have only whole vertices. A
//! position is split where picture coordinates or normals differ: along a seam, along a crease, and
//! at a pole into one vertex for each triangle. A position is not split where two numbers refer to
//! equal values.

use crate::TriMesh;
use std::collections::HashMap;

/// The triangles of a mesh with whole vertices.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SplitMesh {
    /// Vertices in the order in which triangles first use them; every vertex is used.
    pub vertices: Vec<SplitVertex>,
    /// Three vertex indices for each triangle, from 0, in the order and with the winding of the mesh.
    pub triangles: Vec<[u32; 3]>,
}

/// Position, normal and picture coordinates of a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SplitVertex {
    /// The point, in the grid's unit.
    pub position: [f32; 3],
    /// Unit normal, outward.
    pub normal: [f32; 3],
    /// Picture coordinates from the lower left corner; one unit is one repeat of the picture.
    pub uv: [f32; 2],
}

/// The key of a vertex: the number of its position, and the bits of its normal and picture coordinates.
type Key = (u32, [u32; 3], [u32; 2]);

impl SplitMesh {
    /// Splits the vertices of a mesh.
    ///
    /// # Panics
    /// When an index of the mesh is out of range (see [`TriMesh::validate`]), or when there are more
    /// than 2^32 vertices, which no grid makes.
    #[must_use]
    pub fn of(mesh: &TriMesh) -> Self {
        let mut split = Self::default();
        // The map is only looked up and never iterated, so its order does not affect the result.
        let mut known: HashMap<Key, u32> = HashMap::with_capacity(mesh.positions.len());
        split.triangles.reserve_exact(mesh.triangles.len());
        for triangle in &mesh.triangles {
            split.triangles.push([0, 1, 2].map(|corner| {
                let position = triangle.position[corner];
                let normal = mesh.normals[triangle.normal[corner] as usize];
                let uv = mesh.uvs[triangle.uv[corner] as usize];
                let key = (position, normal.map(f32::to_bits), uv.map(f32::to_bits));
                *known.entry(key).or_insert_with(|| {
                    let number = u32::try_from(split.vertices.len()).expect("at most 2^32");
                    let position = mesh.positions[position as usize];
                    split.vertices.push(SplitVertex { position, normal, uv });
                    number
                })
            }));
        }
        split
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triangle;

    /// Returns the two triangles of a square. The second triangle has its own number for each
    /// normal and pair of picture coordinates, also where the values are equal.
    fn square(uvs: Vec<[f32; 2]>, normals: Vec<[f32; 3]>) -> TriMesh {
        TriMesh {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            uvs,
            normals,
            triangles: vec![
                Triangle { position: [0, 1, 2], uv: [0; 3], normal: [0; 3] },
                Triangle { position: [0, 2, 3], uv: [1; 3], normal: [1; 3] },
            ],
            ..TriMesh::default()
        }
    }

    #[test]
    fn equal_values_are_one_vertex_and_different_ones_are_two() {
        let (up, tilted) = ([0.0, 0.0, 1.0], [0.6, 0.0, 0.8]);
        for (uvs, normals, expected) in [
            ([[0.0; 2]; 2], [up; 2], vec![[0, 1, 2], [0, 2, 3]]),
            ([[0.0; 2], [1.0, 0.0]], [up; 2], vec![[0, 1, 2], [3, 4, 5]]),
            ([[0.0; 2]; 2], [up, tilted], vec![[0, 1, 2], [3, 4, 5]]),
        ] {
            let mesh = square(uvs.into(), normals.into());
            let split = SplitMesh::of(&mesh);
            assert_eq!(split.triangles, expected);
            for (triangle, corners) in mesh.triangles.iter().zip(&split.triangles) {
                for (corner, &vertex) in corners.iter().enumerate() {
                    let found = split.vertices[vertex as usize];
                    assert_eq!(found.position, mesh.positions[triangle.position[corner] as usize]);
                    assert_eq!(found.normal, mesh.normals[triangle.normal[corner] as usize]);
                    assert_eq!(found.uv, mesh.uvs[triangle.uv[corner] as usize]);
                }
            }
        }
    }
}
