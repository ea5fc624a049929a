//! An object: one sweep, or several that belong together, such as a cup and its handle.

use super::Sweep;
use super::rows::{Rows, Spent};
use crate::error::SweepError;
use crate::grid::file::{Encoding, Patch};
use crate::grid::{GridMesh, Unit};
use crate::spec::Spec;
use std::io::{self, Write};

/// One sweep or several, checked.
#[derive(Debug, Clone)]
pub struct Object {
    pub(crate) name: String,
    pub(crate) parts: Vec<Sweep>,
    /// The specs, with the content of the files that they name.
    pub(crate) specs: Vec<Spec>,
    /// For each part the index of its spec: an outline and its holes have one spec.
    pub(crate) owners: Vec<usize>,
    /// For each spec its number among the parts as they are written; `None` for a spec of one sweep.
    pub(crate) written: Vec<Option<usize>>,
}

impl Object {
    /// Returns the object's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the unit of length, if the spec states one.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        self.parts.first().and_then(|part| part.unit)
    }

    /// Returns the object's sweeps, at least one.
    #[must_use]
    pub fn parts(&self) -> &[Sweep] {
        &self.parts
    }

    /// Returns the spec of a part, and the index of that spec among the parts as they are written; `None` for a spec of
    /// one sweep.
    ///
    /// # Panics
    /// When there is no such part.
    #[must_use]
    pub fn spec_of(&self, part: usize) -> (&Spec, Option<usize>) {
        let owner = self.owners[part];
        (&self.specs[owner], self.written[owner])
    }

    /// Returns the rows of a part.
    fn rows(&self, index: usize) -> Rows<'_> {
        let group = self.parts[index].group.max(1);
        Rows::last_of(&self.parts[index + 1 - group..=index])
    }

    /// Returns a sentence that says by how much the parts miss their tolerances; `None` if all are kept.
    #[must_use]
    pub fn missed(&self) -> Option<String> {
        let of = |part: &Sweep| {
            let missed = part.missed()?;
            Some(if self.parts.len() == 1 { missed } else { format!("{}: {missed}", part.name()) })
        };
        let missed: Vec<String> = self.parts.iter().filter_map(of).collect();
        (!missed.is_empty()).then(|| missed.join("; "))
    }

    /// Returns the grids of the parts, in their order.
    ///
    /// # Errors
    /// When there is not enough memory for the grids, or when a point is not finite.
    pub fn grids(&self) -> Result<Vec<GridMesh>, SweepError> {
        let grid = |part: usize| {
            let grid = self.rows(part).grid()?;
            let finite = grid.positions.iter().all(|point| point.is_finite());
            if finite && grid.normals.iter().all(|normal| normal.is_finite()) {
                return Ok(grid);
            }
            Err(SweepError::NotFinite(files::words::shown(&grid.name).to_string()))
        };
        (0..self.parts.len()).map(grid).collect()
    }

    /// Writes the grids of the parts, with only a few rows of each in memory.
    ///
    /// # Errors
    /// When writing to `out` fails.
    pub fn write(&self, encoding: Encoding, out: &mut impl Write) -> io::Result<Spent> {
        let mut spent = Spent::default();
        for index in 0..self.parts.len() {
            let patch = Patch { number: index + 1, of: self.parts.len() };
            let Spent { sweeping, writing } = self.rows(index).write(patch, encoding, out)?;
            spent.sweeping += sweeping;
            spent.writing += writing;
        }
        Ok(spent)
    }
}
