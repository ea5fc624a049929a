//! What the scene file calls its things, for people to read.

use super::file::{ObjectFile, SceneFile};

/// The names of a scene's things, in the order of its lists; a scene that was not read from a file
/// may have none.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Names {
    /// Of its materials.
    pub materials: Vec<String>,
    /// Of its textures.
    pub textures: Vec<String>,
    /// Of its objects: only meshes have names.
    pub objects: Vec<Option<String>>,
}

impl Names {
    /// The names that a file gives.
    #[must_use]
    pub fn of(file: &SceneFile) -> Self {
        let name_of = |object: &ObjectFile| match object {
            ObjectFile::Mesh(mesh) => Some(mesh.name.clone()),
            _ => None,
        };
        Self {
            materials: file.materials.keys().cloned().collect(),
            textures: file.textures.keys().cloned().collect(),
            objects: file.objects.iter().map(name_of).collect(),
        }
    }
}
