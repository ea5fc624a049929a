//! The grid that the program reads: row by row from a file, or whole with areas on it.

use files::json::Document;
use files::memory::{Reserved, of_process};
use files::{FileError, Ledger, MemoryError, Report, Setting, input, setting};
use std::io::BufRead;
use std::path::Path;
use sweep::GridMesh;
use sweep::grid::file::GridReader;
use triangulate::up::{Turned, Up};
use triangulate::{Counts, Options, Patches, Sink, TriMesh, TriangulateError, Unit, area_file};

/// Reads all patches of a grid, and adds the areas of a file, with the values that are set in it, to them.
pub fn with_areas(
    (areas, settings): (&Path, &[Setting]),
    ledger: &Ledger,
    reader: &mut GridReader<impl BufRead>,
) -> Result<Vec<GridMesh>, Report> {
    let bytes = ledger.argument_json(areas, "the areas")?;
    let name = input::name_of(areas);
    let bytes = setting::apply(&name, bytes, settings).map_err(FileError::from)?;
    let name = setting::name(name, settings);
    let document = Document::new(&name, &bytes)?;
    let mut grids = reader.read_rest().map_err(TriangulateError::Grid)?;
    area_file::add(&document, &mut grids)?;
    Ok(grids)
}

/// The grid of a run, and the axis that points up in its mesh.
#[derive(Debug)]
pub struct Grid<'a, R> {
    /// Where the grid comes from.
    pub source: Place<'a, R>,
    /// The axis that points up.
    pub up: Up,
}

/// The place of a grid.
#[derive(Debug)]
pub enum Place<'a, R> {
    /// A grid file, of which one row at a time is in memory.
    File(&'a mut GridReader<R>),
    /// All patches in memory.
    Memory(&'a [GridMesh]),
}

impl<R: BufRead> Grid<'_, R> {
    /// Returns the unit of length that the spec states.
    pub fn unit(&self) -> Option<Unit> {
        let unit = match &self.source {
            Place::File(reader) => reader.header().unit,
            Place::Memory(grids) => grids.first().and_then(|grid| grid.unit),
        };
        unit.map(Unit::from)
    }

    /// Reserves the memory of a mesh of the first patch, or of all patches that are in memory.
    pub fn reserve_mesh(&self) -> Result<Reserved<'static>, MemoryError> {
        let points = match &self.source {
            Place::File(reader) => {
                let header = reader.header();
                (header.rows as u64).saturating_mul(header.cols() as u64)
            }
            Place::Memory(grids) => grids.iter().map(|grid| grid.positions.len() as u64).sum(),
        };
        let what = || format!("a mesh of {points} points");
        of_process().reserve(TriMesh::bytes_for(points), what)
    }
}

impl<R: BufRead> Patches for &mut Grid<'_, R> {
    fn run<S: Sink>(self, options: &Options, sink: S) -> Result<(S, Counts), TriangulateError> {
        let sink = Turned { sink, up: self.up };
        let (Turned { sink, .. }, counts) = match &mut self.source {
            Place::File(reader) => reader.run(options, sink),
            Place::Memory(grids) => grids.run(options, sink),
        }?;
        Ok((sink, counts))
    }
}
