//! The trees of meshes without their scene, for another scene with some of the same meshes.

use super::mesh_tree::MeshTree;
use std::collections::HashMap;

/// Trees of meshes, by the first object that shows the mesh.
#[derive(Debug, Default)]
pub struct Planted(pub(super) HashMap<u32, Vec<MeshTree>>);

impl Planted {
    /// Keeps the trees of the objects whose mesh is the same in the other scene. The other trees are dropped.
    #[must_use]
    pub fn of_same(mut self, is_same: impl Fn(usize) -> bool) -> Self {
        self.0.retain(|object, _| is_same(*object as usize));
        self
    }

    /// Takes the trees of an object, if there are any.
    pub(super) fn of(&mut self, object: u32) -> Option<Vec<MeshTree>> {
        self.0.remove(&object)
    }
}
