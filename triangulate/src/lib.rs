//! A contour x trajectory grid to triangles with texture ids, in memory or as OBJ, STL or PLY.
//!
//! Each cell of the grid becomes two triangles, counter-clockwise seen from outside. Rows come in
//! and go out one at a time, so that writing an OBJ takes the memory of three rows whatever the
//! length of the grid. What goes out is the same either way: the [`TriMesh`] of [`mesh`] has
//! the numbers and the order of triangles that [`write_obj`] writes, to the bit. STL and PLY
//! begin with counts, so they are written from a whole [`TriMesh`].
//!
//! What makes a mesh of a grid:
//!
//! - *One vertex where the surface has one point.* A seam that closes leads back to the first row or
//!   column, shifted or mirrored as the grid says, and a point equal to its neighbour in the grid shares its vertex: at a pole a
//!   whole row or column does, at a crease two columns do. Texture coordinates are not shared over a
//!   seam; they run on to `u = 1` and `v = 1`, so that no triangle has the whole picture squeezed
//!   into it.
//! - *Two sides of one row* where a seam is mirrored: the surface comes back with its other side out,
//!   so the first row has a second set of normals there, turned over. Seen from one side, its
//!   triangles on either hand of that seam run round opposite ways, as on every such surface.
//! - *No triangle without area.* The cell between the two columns of a crease gives none, a cell at
//!   a pole gives one. [`Counts`] says how many were left out.
//! - *Half a cell at a pole.* All of a picture's edge meets there; each triangle takes the middle of
//!   its share of it, and likewise the normal in the middle.
//! - *The diagonal* is the one that lies closer to the surface ([`diagonal`]).
//! - *Rounding to f32 happens here, once*, and zero is always `+0`: OBJ holds no more, and `render`
//!   intersects exactly these vertices.
//!
//! A grid file may hold several patches, an object's sweeps. Each is triangulated by itself, its
//! vertices numbered on, and nothing is welded between them.
//!
//! A patch may have areas with pictures of their own ([`Area`](sweep::grid::Area)). Where two meet, points and normals are
//! shared and picture coordinates are not; a row's triangles are told by material, so that an OBJ
//! says `usemtl` once for each in a row, and is still written row by row.
//!
//! Only neighbours in the grid are compared: where a surface touches itself elsewhere it
//! stays two surfaces. A cell is not made convex, and a mesh is not thinned.
//!
//! | module           | what                                                         |
//! |------------------|--------------------------------------------------------------|
//! | [`triangulator`] | rows in, vertices and triangles out; the [`Sink`] they go to |
//! | [`diagonal`]     | which way a cell is cut                                      |
//! | [`tri_mesh`]     | the mesh in memory, and its [`TriMesh::validate`]            |
//! | [`obj`]          | the mesh as OBJ                                              |
//! | [`topology`]     | what a mesh is like as a surface: Euler number, rims, sides  |
//! | [`report`]       | that and its measures, as JSON                               |
//! | [`area_file`]    | texture areas for a grid of others                           |
//! | [`mtl`]          | the material file beside an OBJ                              |
//! | [`stl`]          | the mesh as binary STL                                       |
//! | [`split`]        | vertices that carry position, normal and picture coordinates |
//! | [`ply`]          | the mesh as binary PLY                                       |

pub mod area_file;
mod areas;
mod cell;
pub mod diagonal;
mod error;
mod forest;
mod material;
pub mod mtl;
pub mod obj;
mod picture;
pub mod ply;
pub mod report;
pub mod split;
mod station;
pub mod stl;
pub mod topology;
pub mod tri_mesh;
pub mod triangulator;
mod validate;

pub use error::TriangulateError;
pub use material::{Material, Options};
pub use obj::ObjWriter;
pub use ply::write_ply;
pub use report::MeshReport;
pub use split::SplitMesh;
pub use stl::write_stl;
pub use topology::Topology;
pub use tri_mesh::{TriMesh, Triangle};
pub use triangulator::{Counts, Sink, Triangulator};

use std::io::{BufRead, Write};
use sweep::GridMesh;
use sweep::grid::file::{GridReader, Header};

/// The triangles of a grid, in memory.
///
/// # Errors
/// When the grid's arrays do not fit each other, or hold a number that f32 does not.
pub fn mesh(grid: &GridMesh, options: &Options) -> Result<TriMesh, TriangulateError> {
    mesh_all(std::slice::from_ref(grid), options)
}

/// The triangles of all patches of an object, in memory.
///
/// # Errors
/// As [`mesh`].
pub fn mesh_all(grids: &[GridMesh], options: &Options) -> Result<TriMesh, TriangulateError> {
    let (mesh, _) = run_grids(grids, options, TriMesh::default())?;
    Ok(mesh)
}

/// The triangles of a grid in memory, as OBJ: the same bytes that [`write_obj`] makes of the file
/// of that grid.
///
/// # Errors
/// As [`mesh`], and when `out` fails.
pub fn write_grid_obj(
    grid: &GridMesh,
    options: &Options,
    out: &mut impl Write,
) -> Result<Counts, TriangulateError> {
    write_grids_obj(std::slice::from_ref(grid), options, out)
}

/// The triangles of all patches of an object in memory, as OBJ: the same bytes that [`write_obj`]
/// makes of their file.
///
/// # Errors
/// As [`write_grid_obj`].
pub fn write_grids_obj(
    grids: &[GridMesh],
    options: &Options,
    out: &mut impl Write,
) -> Result<Counts, TriangulateError> {
    let (writer, counts) = run_grids(grids, options, ObjWriter::new(out))?;
    writer.finish(&counts).map_err(TriangulateError::Write)?;
    Ok(counts)
}

/// The triangles of a grid file with all its patches, row by row, as OBJ.
///
/// The closing comment is written only when the last footer was read and found right.
///
/// # Errors
/// When the grid is cut short or damaged, holds a number that f32 does not, or `out` fails.
pub fn write_obj(
    reader: &mut GridReader<impl BufRead>,
    options: &Options,
    out: &mut impl Write,
) -> Result<Counts, TriangulateError> {
    let (writer, counts) = run_rows(reader, options, ObjWriter::new(out))?;
    writer.finish(&counts).map_err(TriangulateError::Write)?;
    Ok(counts)
}

/// The triangles of a grid file with all its patches, in memory.
///
/// # Errors
/// When the grid is cut short or damaged, or holds a number that f32 does not.
pub fn read_mesh(
    reader: &mut GridReader<impl BufRead>,
    options: &Options,
) -> Result<(TriMesh, Counts), TriangulateError> {
    run_rows(reader, options, TriMesh::default())
}

/// Tells a sink the triangles of a grid file with all its patches, row by row.
///
/// # Errors
/// When the grid is cut short or damaged, holds a number that f32 does not, or the sink fails.
pub fn run_rows<S: Sink>(
    reader: &mut GridReader<impl BufRead>,
    options: &Options,
    mut sink: S,
) -> Result<(S, Counts), TriangulateError> {
    let mut counts = Counts::default();
    loop {
        let header = reader.header().clone();
        let mut triangulator = Triangulator::following(counts, header, options, sink)?;
        while let Some(row) = reader.next_row()? {
            triangulator.row(row)?;
        }
        (sink, counts) = triangulator.finish()?;
        if !reader.next_patch()? {
            return Ok((sink, counts));
        }
    }
}

/// Tells a sink the triangles of grids in memory, the patches of one object.
///
/// # Errors
/// As [`mesh`], and when the sink fails.
pub fn run_grids<S: Sink>(
    grids: &[GridMesh],
    options: &Options,
    mut sink: S,
) -> Result<(S, Counts), TriangulateError> {
    let mut counts = Counts::default();
    for grid in grids {
        let points = grid.rows().saturating_mul(grid.cols());
        if grid.positions.len() != points || grid.normals.len() != points {
            let (positions, normals) = (grid.positions.len(), grid.normals.len());
            let object = grid.name.clone();
            return Err(TriangulateError::Arrays { object, positions, normals, expected: points });
        }
        if let Some((number, key, message)) = grid.area_fault() {
            let fault = format!("areas[{number}].{key}: {message}");
            return Err(TriangulateError::Area { object: grid.name.clone(), fault });
        }
        let mut triangulator = Triangulator::following(counts, Header::of(grid), options, sink)?;
        for row in grid.row_views() {
            triangulator.row(row)?;
        }
        (sink, counts) = triangulator.finish()?;
    }
    Ok((sink, counts))
}
