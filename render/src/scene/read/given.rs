//! Hands out the meshes that the caller passed to the objects that name them.

use super::MeshSource;
use super::draft::{SceneText, meshes};
use crate::scene::obj::ObjFile;
use std::collections::BTreeMap;

/// The meshes that the caller passed, and for each the number of objects that still need it.
#[derive(Debug)]
pub(super) struct Given {
    meshes: MeshSource,
    takers: BTreeMap<String, usize>,
}

impl Given {
    pub(super) fn new(given: MeshSource, texts: &[SceneText<'_>]) -> Self {
        let mut takers = BTreeMap::new();
        for mesh in texts.iter().flat_map(|text| meshes(text.lists)) {
            *takers.entry(mesh.name.clone()).or_insert(0) += 1;
        }
        Self { meshes: given, takers }
    }

    /// Returns the mesh of this name for the next object. The last object takes the mesh itself, and
    /// objects before it take copies.
    pub(super) fn take(&mut self, name: &str) -> Option<ObjFile> {
        let left = self.takers.get_mut(name)?;
        *left = left.saturating_sub(1);
        if *left == 0 { self.meshes.remove(name) } else { self.meshes.get(name).cloned() }
    }
}
