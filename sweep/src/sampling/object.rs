//! An object: one sweep, or several that belong together, such as a cup and its handle.

use super::Sweep;
use super::rows::{Rows, Spent};
use crate::error::SweepError;
use crate::grid::GridMesh;
use crate::grid::file::{Encoding, Patch};
use crate::spec::{Parts, Spec};
use std::io::{self, Write};

/// One sweep or several, checked.
#[derive(Debug, Clone)]
pub struct Object {
    pub(crate) name: String,
    pub(crate) parts: Vec<Sweep>,
    pub(crate) specs: Specs,
    /// For each part the index of its spec: an outline and its holes have one spec.
    pub(crate) owners: Vec<usize>,
}

/// The text of an object, parsed.
#[derive(Debug, Clone)]
pub(crate) enum Specs {
    /// A spec of one sweep.
    One(Box<Spec>),
    /// A spec of parts.
    Several(Parts),
}

impl Object {
    /// Returns the object's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
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
        match &self.specs {
            Specs::One(spec) => (spec, None),
            Specs::Several(object) => {
                let owner = self.owners[part];
                (&object.parts[owner], Some(owner))
            }
        }
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
