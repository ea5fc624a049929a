//! The patches of an object: the grids of its sweeps, in a file or in memory.

use crate::lids::Rims;
use crate::{Counts, Options, Sink, TriangulateError, Triangulator};
use std::io::BufRead;
use sweep::GridMesh;
use sweep::grid::file::{GridReader, Header};

/// The patches of an object, of which rows are read one at a time.
pub trait Patches {
    /// Passes the triangles of all patches to a sink. Returns the sink and the counts of the mesh.
    ///
    /// # Errors
    /// When a grid file is cut short or damaged, or when the arrays of a grid in memory do not fit
    /// each other. Also when a number does not fit in f32, and when the sink fails.
    fn run<S: Sink>(self, options: &Options, sink: S) -> Result<(S, Counts), TriangulateError>;
}

/// The patches of a grid file, from the reader's first patch on.
impl<R: BufRead> Patches for &mut GridReader<R> {
    fn run<S: Sink>(self, options: &Options, mut sink: S) -> Result<(S, Counts), TriangulateError> {
        let mut counts = Counts::default();
        let mut rims = Rims::new();
        loop {
            let header = self.header().clone();
            let mut triangulator = Triangulator::following(counts, header, options, sink)?;
            while let Some(row) = self.next_row()? {
                triangulator.row(row)?;
            }
            (sink, counts) = triangulator.close(&mut rims)?;
            if !self.next_patch()? {
                return Ok((sink, counts));
            }
        }
    }
}

/// Grids in memory.
impl Patches for &[GridMesh] {
    fn run<S: Sink>(self, options: &Options, mut sink: S) -> Result<(S, Counts), TriangulateError> {
        let mut counts = Counts::default();
        let mut rims = Rims::new();
        for grid in self {
            let points = grid.rows().saturating_mul(grid.cols());
            if grid.positions.len() != points || grid.normals.len() != points {
                let (positions, normals) = (grid.positions.len(), grid.normals.len());
                let object = grid.name.clone();
                let expected = points;
                return Err(TriangulateError::Arrays { object, positions, normals, expected });
            }
            if let Some((number, key, message)) = grid.area_fault() {
                let fault = format!("areas[{number}].{key}: {message}");
                return Err(TriangulateError::Area { object: grid.name.clone(), fault });
            }
            let header = Header::of(grid);
            let mut triangulator = Triangulator::following(counts, header, options, sink)?;
            for row in grid.row_views() {
                triangulator.row(row)?;
            }
            (sink, counts) = triangulator.close(&mut rims)?;
        }
        Ok((sink, counts))
    }
}

/// One grid in memory, which is the object's only patch.
impl Patches for &GridMesh {
    fn run<S: Sink>(self, options: &Options, sink: S) -> Result<(S, Counts), TriangulateError> {
        std::slice::from_ref(self).run(options, sink)
    }
}
