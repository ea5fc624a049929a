//! The meshes of a scene, each read once however many objects show it.
//!
//! Objects show the same mesh if they name the same file, or a mesh of the same name that the caller
//! passed, and smooth it alike. If materials or textures change the mesh itself, the object has a copy.

use super::MeshSource;
use super::draft::{SceneText, meshes};
use crate::scene::file::MeshFile;
use crate::scene::obj::ObjFile;
use crate::shape::{Mesh, SharedMesh};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The origin of a mesh, and the bits of its largest smoothed angle.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key(Origin, Option<u64>);

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Origin {
    /// The name of a mesh that the caller passed.
    Given(String),
    /// The path of a file.
    File(PathBuf),
    /// A mesh without a file that nobody passed.
    Missing,
}

/// A mesh as objects of the scene take it.
#[derive(Debug, Clone)]
pub(super) enum Taken {
    /// One object shows the mesh.
    Owned(Mesh),
    /// Several objects show the mesh.
    Shared(Arc<SharedMesh>),
}

impl Taken {
    /// The mesh.
    pub(super) fn mesh(&self) -> &Mesh {
        match self {
            Self::Owned(mesh) => mesh,
            Self::Shared(shared) => shared.mesh(),
        }
    }

    /// Returns the mesh to be changed for one object.
    pub(super) fn into_own(self) -> Mesh {
        match self {
            Self::Owned(mesh) => mesh,
            Self::Shared(shared) => shared.mesh().clone(),
        }
    }
}

/// A mesh that several objects show.
#[derive(Debug)]
struct Kept {
    /// The file without its triangles.
    file: Arc<ObjFile>,
    mesh: Arc<SharedMesh>,
    /// The mesh with corners joined that differ by rounding, and the number of these corners.
    closed: Option<(Arc<SharedMesh>, usize)>,
}

/// The meshes read so far, and those that the caller passed.
#[derive(Debug)]
pub(super) struct Stored {
    given: MeshSource,
    /// Number of objects that show each mesh.
    takers: BTreeMap<Key, usize>,
    kept: BTreeMap<Key, Kept>,
}

impl Stored {
    pub(super) fn new(given: MeshSource, texts: &[SceneText<'_>]) -> Self {
        let mut stored = Self { given, takers: BTreeMap::new(), kept: BTreeMap::new() };
        for text in texts {
            for mesh in meshes(text.lists) {
                let key = stored.key(mesh, text.folder);
                *stored.takers.entry(key).or_insert(0) += mesh.placements();
            }
        }
        stored
    }

    /// Returns the key of a mesh in a file of the scene in `folder`.
    pub(super) fn key(&self, mesh: &MeshFile, folder: &Path) -> Key {
        let origin = match &mesh.file {
            _ if self.given.contains_key(&mesh.name) => Origin::Given(mesh.name.clone()),
            Some(file) => Origin::File(folder.join(file)),
            None => Origin::Missing,
        };
        Key(origin, mesh.smooth_deg.map(f64::to_bits))
    }

    /// Returns the mesh of `key`, and its file without triangles. The first object that shows the mesh
    /// reads it by `read`, from the mesh that the caller passed, if any. The flag is true for this object.
    pub(super) fn take<E>(
        &mut self,
        key: &Key,
        read: impl FnOnce(Option<ObjFile>) -> Result<ObjFile, E>,
    ) -> Result<(Arc<ObjFile>, Taken, bool), E> {
        if let Some(kept) = self.kept.get(key) {
            return Ok((kept.file.clone(), Taken::Shared(kept.mesh.clone()), false));
        }
        let Key(origin, smooth) = key;
        let given = match origin {
            Origin::Given(name) => self.given.get_mut(name),
            Origin::File(_) | Origin::Missing => None,
        };
        // Objects that smooth the mesh in another manner take copies.
        let others = self.takers.keys().filter(|Key(other, _)| other == origin).count() > 1;
        let given = given.map(|given| if others { given.clone() } else { std::mem::take(given) });
        let mut read = read(given)?;
        let file = ObjFile {
            file: std::mem::take(&mut read.file),
            folder: std::mem::take(&mut read.folder),
            libraries: std::mem::take(&mut read.libraries),
            unused: std::mem::take(&mut read.unused),
            colored: read.colored,
            materials: std::mem::take(&mut read.materials),
            pictures: std::mem::take(&mut read.pictures),
            remarks: std::mem::take(&mut read.remarks),
            ..ObjFile::default()
        };
        let file = Arc::new(file);
        let mesh = read.smoothed(smooth.map(f64::from_bits));
        if self.takers.get(key).is_none_or(|&count| count < 2) {
            return Ok((file, Taken::Owned(mesh), true));
        }
        let mesh = SharedMesh::new(mesh);
        let kept = Kept { file: file.clone(), mesh: mesh.clone(), closed: None };
        self.kept.insert(key.clone(), kept);
        Ok((file, Taken::Shared(mesh), true))
    }

    /// Joins corners of a mesh that differ by rounding, if this closes the mesh. `taken` is the mesh of
    /// `key`, perhaps changed. Returns the number of corners.
    pub(super) fn close_rounded(&mut self, key: &Key, taken: &mut Taken) -> usize {
        let shared = match taken {
            Taken::Owned(mesh) => return mesh.close_rounded(),
            Taken::Shared(shared) => shared,
        };
        let Some(kept) = self.kept.get_mut(key) else { return 0 };
        let (closed, joined) = kept.closed.get_or_insert_with(|| {
            let mut mesh = shared.mesh().clone();
            match mesh.close_rounded() {
                0 => (shared.clone(), 0),
                joined => (SharedMesh::new(mesh), joined),
            }
        });
        *taken = Taken::Shared(closed.clone());
        *joined
    }
}
