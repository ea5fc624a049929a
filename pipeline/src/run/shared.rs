//! Meshes that several jobs have in common, such as the variants of one job.

use crate::job::MeshJob;
use render::shape::Mesh;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use sweep::spec::Resolution;

/// The meshes that were made, by what they were made of.
///
/// The memory of the meshes is not counted in the budget of the process: each is also in a scene while it is made.
#[derive(Debug, Default)]
pub struct Shared {
    /// The meshes, and whether they were used since [`Shared::forget_unused`].
    meshes: Mutex<BTreeMap<String, (Mesh, bool)>>,
}

impl Shared {
    /// Returns the description of a mesh: its spec with all values that are set, its ids and its resolution. The camera
    /// counts only if the resolution is in pixels.
    pub(super) fn key(mesh: &MeshJob, spec: &[u8], resolution: &Resolution) -> String {
        let spec = String::from_utf8_lossy(spec);
        let in_pixels = resolution.pixels.is_some() || spec.contains("\"pixels\"");
        let camera = resolution.camera.filter(|_| in_pixels);
        let resolution = Resolution { camera, ..resolution.clone() };
        let folder = mesh.spec.parent();
        format!("{folder:?} {:?} {resolution:?} {spec}", mesh.options)
    }

    pub(super) fn get(&self, key: &str) -> Option<Mesh> {
        let mut meshes = self.meshes.lock().unwrap_or_else(PoisonError::into_inner);
        let (mesh, used) = meshes.get_mut(key)?;
        *used = true;
        Some(mesh.clone())
    }

    pub(super) fn keep(&self, key: String, mesh: &Mesh) {
        let mut meshes = self.meshes.lock().unwrap_or_else(PoisonError::into_inner);
        meshes.insert(key, (mesh.clone(), true));
    }

    /// Forgets the meshes that were not used since the last call, such as those of another frame.
    pub(super) fn forget_unused(&self) {
        let mut meshes = self.meshes.lock().unwrap_or_else(PoisonError::into_inner);
        meshes.retain(|_, (_, used)| std::mem::take(used));
    }
}
