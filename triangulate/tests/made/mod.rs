//! Meshes of grids that were written to a file and read back.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use sweep::GridMesh;
use sweep::grid::file::{Encoding, GridReader, write};
use triangulate::{Counts, MeshReport, Options, Patches, TriMesh};

/// Returns the mesh of a grid that was written and read back, and its report.
pub fn made(grid: &GridMesh) -> (TriMesh, Counts, MeshReport) {
    let mut file = Vec::new();
    write(grid, Encoding::Binary, &mut file).unwrap();
    let mut reader = GridReader::open("test", file.as_slice()).unwrap();
    let (mesh, counts) = reader.run(&Options::default(), TriMesh::default()).unwrap();
    let report = MeshReport::of(&mesh, &counts);
    (mesh, counts, report)
}

/// Returns the number of edges that two triangles follow in the same direction.
pub fn walked_twice(mesh: &TriMesh) -> usize {
    let mut edges = mesh.directed_edges();
    edges.sort_unstable();
    edges.windows(2).filter(|pair| pair[0] == pair[1]).count()
}
