//! Writes the mesh in the format that the arguments request.

use super::Arguments;
use super::grid::Grid;
use std::io::{BufRead, Write};
use triangulate::{
    Counts, Format, Material, ObjWriter, Patches, TriMesh, TriangulateError, write_3mf, write_glb,
    write_ply, write_stl,
};

/// The result of writing a mesh.
#[derive(Debug)]
pub struct Written {
    /// The whole mesh, if the format or the report needs it.
    pub mesh: Option<TriMesh>,
    /// The materials that the file names, sorted by ids.
    pub materials: Vec<Material>,
    /// Counts and rounding errors of the mesh.
    pub counts: Counts,
}

/// Writes the mesh of a grid.
pub fn write(
    arguments: &Arguments,
    grid: &mut Grid<'_, impl BufRead>,
    out: &mut impl Write,
) -> Result<Written, TriangulateError> {
    match arguments.format() {
        Format::Obj => write_obj(arguments, grid, out),
        Format::Stl => write_whole(arguments, grid, |mesh| write_stl(mesh, out)),
        Format::Ply => write_whole(arguments, grid, |mesh| write_ply(mesh, out)),
        Format::Glb => write_whole(arguments, grid, |mesh| write_glb(mesh, arguments.unit, out)),
        Format::ThreeMf => {
            let unit = arguments.unit.unwrap_or_default();
            write_whole(arguments, grid, |mesh| write_3mf(mesh, unit, out))
        }
    }
}

/// Writes an OBJ row by row. The mesh is kept in memory only for a report.
fn write_obj(
    arguments: &Arguments,
    grid: &mut Grid<'_, impl BufRead>,
    out: &mut impl Write,
) -> Result<Written, TriangulateError> {
    let options = arguments.options();
    let writer = ObjWriter::with_materials(arguments.mtl_name().as_deref(), out);
    let (writer, mesh, counts) = if arguments.report.is_some() {
        let _reserved = grid.reserve_mesh()?;
        let ((writer, mesh), counts) = grid.run(&options, (writer, TriMesh::default()))?;
        (writer, Some(mesh), counts)
    } else {
        let (writer, counts) = grid.run(&options, writer)?;
        (writer, None, counts)
    };
    let materials = writer.materials();
    writer.finish(&counts).map_err(TriangulateError::Write)?;
    Ok(Written { mesh, materials, counts })
}

/// Writes a format that begins with the counts of the mesh.
fn write_whole(
    arguments: &Arguments,
    grid: &mut Grid<'_, impl BufRead>,
    write: impl FnOnce(&TriMesh) -> std::io::Result<()>,
) -> Result<Written, TriangulateError> {
    let _reserved = grid.reserve_mesh()?;
    let (mesh, counts) = grid.run(&arguments.options(), TriMesh::default())?;
    write(&mesh).map_err(TriangulateError::Write)?;
    Ok(Written { mesh: Some(mesh), materials: Vec::new(), counts })
}
