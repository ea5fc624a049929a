//! Meshes given from outside, handed to the objects that name them.

use super::MeshSource;
use super::draft::{Sheet, meshes};
use crate::shape::Mesh;
use std::collections::BTreeMap;

/// The meshes given, and how many objects are still to take each of them.
#[derive(Debug)]
pub(super) struct Given {
    meshes: MeshSource,
    takers: BTreeMap<String, usize>,
}

impl Given {
    pub(super) fn new(given: MeshSource, sheets: &[Sheet<'_>]) -> Self {
        let mut takers = BTreeMap::new();
        for mesh in sheets.iter().flat_map(|sheet| meshes(sheet.lists)) {
            *takers.entry(mesh.name.clone()).or_insert(0) += 1;
        }
        Self { meshes: given, takers }
    }

    /// The mesh of that name for the next object that has it; the last one takes the mesh itself.
    pub(super) fn take(&mut self, name: &str) -> Option<Mesh> {
        let left = self.takers.get_mut(name)?;
        *left = left.saturating_sub(1);
        if *left == 0 { self.meshes.remove(name) } else { self.meshes.get(name).cloned() }
    }
}
