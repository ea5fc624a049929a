//! The grid that the program reads: row by row from a file, or whole with areas on it.

use files::json::Document;
use files::memory::{Reserved, of_process};
use files::{Ledger, MemoryError, Report, input};
use std::io::BufRead;
use std::path::Path;
use sweep::GridMesh;
use sweep::grid::file::GridReader;
use triangulate::{Counts, Options, Patches, Sink, TriMesh, TriangulateError, area_file};

/// Reads all patches of a grid, and adds the areas of a file to them.
pub fn with_areas(
    areas: &Path,
    ledger: &Ledger,
    reader: &mut GridReader<impl BufRead>,
) -> Result<Vec<GridMesh>, Report> {
    let bytes = ledger.argument_json(areas, "the areas")?;
    let name = input::name_of(areas);
    let document = Document::new(&name, &bytes)?;
    let mut grids = reader.read_rest().map_err(TriangulateError::Grid)?;
    area_file::add(&document, &mut grids)?;
    Ok(grids)
}

/// The grid of a run.
#[derive(Debug)]
pub enum Grid<'a, R> {
    /// A grid file, of which one row at a time is in memory.
    File(&'a mut GridReader<R>),
    /// All patches in memory.
    Memory(&'a [GridMesh]),
}

impl<R: BufRead> Grid<'_, R> {
    /// Reserves the memory of a mesh of the first patch, or of all patches that are in memory.
    pub fn reserve_mesh(&self) -> Result<Reserved<'static>, MemoryError> {
        let points = match self {
            Self::File(reader) => {
                let header = reader.header();
                (header.rows as u64).saturating_mul(header.cols() as u64)
            }
            Self::Memory(grids) => grids.iter().map(|grid| grid.positions.len() as u64).sum(),
        };
        let what = || format!("a mesh of {points} points");
        of_process().reserve(TriMesh::bytes_for(points), what)
    }
}

impl<R: BufRead> Patches for &mut Grid<'_, R> {
    fn run<S: Sink>(self, options: &Options, sink: S) -> Result<(S, Counts), TriangulateError> {
        match self {
            Grid::File(reader) => reader.run(options, sink),
            Grid::Memory(grids) => grids.run(options, sink),
        }
    }
}
