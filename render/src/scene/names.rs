//! What the scene file calls its things, for people to read.

use super::file::{Lists, ObjectFile};

/// The names of a scene's things, in the order of its lists; a scene that was not read from a file
/// may have none.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Names {
    /// Of its materials.
    pub materials: Vec<String>,
    /// Of its textures that are pictures.
    pub textures: Vec<String>,
    /// Of its textures that are solids.
    pub solids: Vec<String>,
    /// Of its objects: only meshes have names.
    pub objects: Vec<Option<String>>,
}

impl Names {
    /// Adds the names that a file gives.
    pub fn add(&mut self, lists: &Lists<'_>) {
        self.materials.extend(lists.materials.keys().cloned());
        for (name, texture) in lists.textures {
            let names = if texture.image.is_some() { &mut self.textures } else { &mut self.solids };
            names.push(name.clone());
        }
        self.objects.extend(lists.objects.iter().map(|object| match object {
            ObjectFile::Mesh(mesh) => Some(mesh.name.clone()),
            _ => None,
        }));
    }
}
