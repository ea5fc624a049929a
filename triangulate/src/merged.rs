//! A mesh after vertices in one place are merged, as readers of STL files do.
//!
//! Vertices are one if all their coordinates agree to 1e-7 of the object's size, which is the rounding of f32. A
//! triangle two of whose corners become one vanishes.

use crate::{Topology, TriMesh};
use glam::DVec3;
use serde::Serialize;
use sweep::grid::near;

/// Vertices at most this fraction of the object's size apart are merged.
const NEAR: f64 = 1e-7;

/// Topology of a mesh whose vertices are merged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Merged {
    /// Number of vertices that triangles use.
    pub vertices: usize,
    /// True if the mesh is a surface around every point.
    pub manifold: bool,
    /// True if the mesh has triangles and no boundary.
    pub closed: bool,
}

impl Merged {
    /// Merges the vertices of a mesh.
    #[must_use]
    pub fn of(mesh: &TriMesh) -> Self {
        let (_, Topology { vertices, manifold, closed, .. }) = Self::mesh(mesh);
        Self { vertices, manifold, closed }
    }

    /// Merges the vertices of a mesh. Returns the mesh of positions and triangles, and its topology.
    /// Positions keep their numbers, of which some are not used any more.
    #[must_use]
    pub fn mesh(mesh: &TriMesh) -> (TriMesh, Topology) {
        let points: Vec<DVec3> =
            mesh.positions.iter().map(|point| DVec3::from(point.map(f64::from))).collect();
        let (low, high) =
            points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
                (low.min(*p), high.max(*p))
            });
        let ids = near::merged(&points, NEAR * (high - low).length());
        let mut merged = TriMesh { positions: mesh.positions.clone(), ..TriMesh::default() };
        for triangle in &mesh.triangles {
            let mut triangle = *triangle;
            triangle.position = triangle.position.map(|index| ids[index as usize] as u32);
            let [a, b, c] = triangle.position;
            if a != b && b != c && c != a {
                merged.triangles.push(triangle);
            }
        }
        let topology = Topology::of(&merged);
        (merged, topology)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triangle;

    /// Returns two tetrahedra whose corners are `apart` from each other.
    fn tetrahedra(apart: f32) -> TriMesh {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let moved = corners.map(|[x, y, z]: [f32; 3]| [x - 1.0 - apart, y, z]);
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let both = faces.into_iter().chain(faces.map(|face| face.map(|index| index + 4)));
        let triangle = |position| Triangle { position, uv: [0; 3], normal: [0; 3] };
        TriMesh {
            positions: [corners, moved].concat(),
            triangles: both.map(triangle).collect(),
            ..TriMesh::default()
        }
    }

    #[test]
    fn only_vertices_in_one_place_are_merged() {
        let merged = |apart| Merged::of(&tetrahedra(apart));
        assert_eq!(merged(0.5), Merged { vertices: 8, manifold: true, closed: true });
        // The first corner of one is the second of the other: two fans meet in one vertex.
        assert_eq!(merged(0.0), Merged { vertices: 7, manifold: false, closed: true });
        assert_eq!(merged(5e-8), merged(0.0));
    }
}
