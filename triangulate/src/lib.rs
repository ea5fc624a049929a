//! Turns a contour x trajectory grid into triangles with texture ids, in memory or as OBJ, STL, PLY, GLB or 3MF.
//!
//! Each cell of the grid becomes two triangles, counter-clockwise seen from outside. Rows are read and
//! written one at a time, so writing an OBJ takes the memory of three rows, however long the grid is.
//! Both outputs agree to the bit: the [`TriMesh`] of [`mesh`] has the numbers and the order of
//! triangles that [`write_obj`] writes. All other formats begin with counts, so they are written from a
//! whole [`TriMesh`].
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
//! | [`patches`]      | the grids of an object, in a file or in memory, and [`Patches::run`] |
//! | [`triangulator`] | rows to vertices and triangles, and the [`Sink`] they go to  |
//! | [`diagonal`]     | the choice of a cell's diagonal                              |
//! | [`tri_mesh`]     | the mesh in memory, and its [`TriMesh::validate`]            |
//! | [`obj`]          | the mesh as OBJ                                              |
//! | [`up`]           | the axis that points up in the mesh                          |
//! | [`topology`]     | Euler number, boundary loops, orientability of a mesh        |
//! | [`merged`]       | the mesh after vertices in one place are merged              |
//! | [`report`]       | topology and measures of a mesh, as JSON                     |
//! | [`area_file`]    | a file of texture areas for a grid                           |
//! | [`mtl`]          | the material file beside an OBJ                              |
//! | [`mod@format`]   | the formats of mesh files                                    |
//! | [`stl`]          | the mesh as binary STL                                       |
//! | [`split`]        | vertices that carry position, normal and picture coordinates |
//! | [`ply`]          | the mesh as binary PLY                                       |
//! | [`glb`]          | the mesh as binary glTF                                      |
//! | [`threemf`]      | the mesh as 3MF                                              |
//! | [`mod@unit`]     | units of length                                              |
//!
//! A torus has 2 triangles in each cell of its grid, and Euler's number 0:
//!
//! ```
//! use files::json::Document;
//! use sweep::Sweep;
//! use triangulate::{Options, Topology};
//!
//! let text = br#"{"format": "tb-sweep", "version": 1, "name": "ring",
//!     "contour": {"circle": 0.3}, "trajectory": {"circle": {"radius": 1}},
//!     "mesh": {"rows": 24, "cols": 12}}"#;
//! let document = Document::new("ring.json", text).expect("the text is JSON");
//! let grid = Sweep::read(&document).expect("the spec is valid").grid();
//! let mesh = triangulate::mesh([grid].as_slice(), &Options::default())?;
//! let Topology { vertices, edges, faces, closed, .. } = Topology::of(&mesh);
//! assert_eq!((faces, closed), (2 * 24 * 12, true));
//! assert_eq!(vertices + faces, edges);
//! # Ok::<(), triangulate::TriangulateError>(())
//! ```

pub mod area_file;
mod areas;
mod cell;
pub mod diagonal;
mod error;
mod forest;
pub mod format;
pub mod glb;
mod lids;
mod material;
pub mod merged;
pub mod mtl;
pub mod obj;
pub mod patches;
mod picture;
pub mod ply;
pub mod report;
mod rounding;
pub mod split;
mod station;
pub mod stl;
pub mod threemf;
pub mod topology;
pub mod tri_mesh;
pub mod triangulator;
pub mod unit;
pub mod up;
mod validate;

pub use error::TriangulateError;
pub use format::Format;
pub use glb::write_glb;
pub use material::{Material, Options};
pub use merged::Merged;
pub use obj::ObjWriter;
pub use patches::Patches;
pub use ply::write_ply;
pub use report::MeshReport;
pub use split::SplitMesh;
pub use stl::write_stl;
pub use threemf::write_3mf;
pub use topology::Topology;
pub use tri_mesh::{TriMesh, Triangle};
pub use triangulator::{Counts, Sink, Triangulator};
pub use unit::Unit;

use std::io::Write;

/// Makes the triangles of all patches of an object, in memory.
///
/// # Errors
/// When a grid file is cut short or damaged, when the arrays of a grid in memory do not fit each other,
/// or when a number does not fit in f32.
pub fn mesh(patches: impl Patches, options: &Options) -> Result<TriMesh, TriangulateError> {
    let (mesh, _) = patches.run(options, TriMesh::default())?;
    Ok(mesh)
}

/// Writes the triangles of all patches of an object as OBJ, row by row. A grid in memory and the file of
/// this grid give the same bytes.
///
/// The closing comment is written only when the last row was read and found right.
///
/// # Errors
/// See [`mesh`]; also when `out` fails.
pub fn write_obj(
    patches: impl Patches,
    options: &Options,
    out: &mut impl Write,
) -> Result<Counts, TriangulateError> {
    let (writer, counts) = patches.run(options, ObjWriter::new(out))?;
    writer.finish(&counts).map_err(TriangulateError::Write)?;
    Ok(counts)
}
