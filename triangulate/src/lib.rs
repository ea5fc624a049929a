//! Turns a contour x trajectory grid into triangles with texture ids, in memory or as OBJ, STL or PLY.
//!
//! Each cell of the grid becomes two triangles, counter-clockwise seen from outside. Rows are read and
//! written one at a time, so writing an OBJ takes the memory of three rows, however long the grid is.
//! Both outputs agree to the bit: the [`TriMesh`] of [`mesh`] has the numbers and the order of
//! triangles that [`write_obj`] writes. STL and PLY files begin with counts, so these two are written
//! from a whole [`TriMesh`].
//!
//! Rules by which a grid becomes a mesh:
//!
//! - *One vertex where the surface has one point.* A closed seam leads back to the first row or column,
//!   shifted or mirrored as the grid says. A point equal to its neighbour in the grid shares the
//!   neighbour's vertex: a whole row or column at a pole, two columns at a crease. Texture coordinates
//!   are not shared over a seam. They run on to `u = 1` and `v = 1`, so no triangle has the whole
//!   picture squeezed into it.
//! - *Two sides of one row* at a mirrored seam. The surface arrives there with its other side out, so
//!   the first row has a second set of normals, negated. Seen from one side, the triangles before and
//!   after that seam have opposite winding, as on every one-sided surface.
//! - *No triangle without area.* The cell between the two columns of a crease gives no triangle, and a
//!   cell at a pole gives one. [`Counts`] holds the number of triangles left out.
//! - *Half a cell at a pole.* A whole edge of the picture meets in the pole. Each triangle there takes
//!   the picture coordinates in the middle of its share of that edge, and the normal in the middle.
//! - *The diagonal* of a cell is the one that lies closer to the surface ([`diagonal`]).
//! - *Rounding to f32 happens here, once*, and zero is always `+0`. OBJ holds no more digits, and
//!   `render` intersects exactly these vertices.
//!
//! A grid file may hold several patches: the sweeps of one object. Each patch is triangulated by
//! itself. Its vertices are numbered on from the patch before, and no vertex is shared between patches.
//!
//! A patch may have areas with pictures of their own ([`Area`](sweep::grid::Area)). Where two areas
//! meet, they share points and normals but not picture coordinates. The triangles of a row are ordered
//! by material. So an OBJ has one `usemtl` for each material of a row, and is still written row by row.
//!
//! Limits: only neighbours in the grid are compared, so where a surface touches itself elsewhere it
//! stays two surfaces. Cells are not made convex, and meshes are not simplified.
//!
//! | module           | what                                                         |
//! |------------------|--------------------------------------------------------------|
//! | [`triangulator`] | rows to vertices and triangles, and the [`Sink`] they go to  |
//! | [`diagonal`]     | the choice of a cell's diagonal                              |
//! | [`tri_mesh`]     | the mesh in memory, and its [`TriMesh::validate`]            |
//! | [`obj`]          | the mesh as OBJ                                              |
//! | [`topology`]     | Euler number, boundary loops, orientability of a mesh        |
//! | [`report`]       | topology and measures of a mesh, as JSON                     |
//! | [`area_file`]    | a file of texture areas for a grid                           |
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

/// Makes the triangles of a grid, in memory.
///
/// # Errors
/// When the grid's arrays do not fit each other, or hold a number that does not fit in f32.
pub fn mesh(grid: &GridMesh, options: &Options) -> Result<TriMesh, TriangulateError> {
    mesh_all(std::slice::from_ref(grid), options)
}

/// Makes the triangles of all patches of an object, in memory.
///
/// # Errors
/// See [`mesh`].
pub fn mesh_all(grids: &[GridMesh], options: &Options) -> Result<TriMesh, TriangulateError> {
    let (mesh, _) = run_grids(grids, options, TriMesh::default())?;
    Ok(mesh)
}

/// Writes the triangles of a grid in memory as OBJ: the same bytes that [`write_obj`] writes for the
/// file of that grid.
///
/// # Errors
/// See [`mesh`]; also when `out` fails.
pub fn write_grid_obj(
    grid: &GridMesh,
    options: &Options,
    out: &mut impl Write,
) -> Result<Counts, TriangulateError> {
    write_grids_obj(std::slice::from_ref(grid), options, out)
}

/// Writes the triangles of all patches of an object in memory as OBJ: the same bytes that [`write_obj`]
/// writes for the file of those patches.
///
/// # Errors
/// See [`write_grid_obj`].
pub fn write_grids_obj(
    grids: &[GridMesh],
    options: &Options,
    out: &mut impl Write,
) -> Result<Counts, TriangulateError> {
    let (writer, counts) = run_grids(grids, options, ObjWriter::new(out))?;
    writer.finish(&counts).map_err(TriangulateError::Write)?;
    Ok(counts)
}

/// Writes the triangles of a grid file with all its patches as OBJ, row by row.
///
/// The closing comment is written only when the last footer was read and found right.
///
/// # Errors
/// When the grid is cut short or damaged, holds a number that does not fit in f32, or `out` fails.
pub fn write_obj(
    reader: &mut GridReader<impl BufRead>,
    options: &Options,
    out: &mut impl Write,
) -> Result<Counts, TriangulateError> {
    let (writer, counts) = run_rows(reader, options, ObjWriter::new(out))?;
    writer.finish(&counts).map_err(TriangulateError::Write)?;
    Ok(counts)
}

/// Makes the triangles of a grid file with all its patches, in memory.
///
/// # Errors
/// When the grid is cut short or damaged, or holds a number that does not fit in f32.
pub fn read_mesh(
    reader: &mut GridReader<impl BufRead>,
    options: &Options,
) -> Result<(TriMesh, Counts), TriangulateError> {
    run_rows(reader, options, TriMesh::default())
}

/// Passes the triangles of a grid file with all its patches to a sink, row by row.
///
/// # Errors
/// When the grid is cut short or damaged, holds a number that does not fit in f32, or the sink fails.
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

/// Passes the triangles of grids in memory, the patches of one object, to a sink.
///
/// # Errors
/// See [`mesh`]; also when the sink fails.
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
