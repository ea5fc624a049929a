//! The names of a scene file, for messages and reports.

use super::file::{Lists, MeshFile, ObjectFile};

/// The names of a scene's materials, textures and objects, in the order of its lists. A scene that
/// was not read from a file may have no names.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Names {
    /// Names of the materials.
    pub materials: Vec<String>,
    /// Names of the textures that are pictures.
    pub textures: Vec<String>,
    /// Names of the textures that are solids.
    pub solids: Vec<String>,
    /// Names of the objects; only meshes have one.
    pub objects: Vec<Option<String>>,
}

impl Names {
    /// Appends the names of one file of the scene.
    pub fn add(&mut self, lists: &Lists<'_>) {
        self.materials.extend(lists.materials.keys().cloned());
        for (name, texture) in lists.textures {
            let names = if texture.image.is_some() { &mut self.textures } else { &mut self.solids };
            names.push(name.clone());
        }
        for mesh in lists.objects.iter().map(ObjectFile::mesh) {
            let name = mesh.map(|mesh| mesh.name.clone());
            let count = mesh.map_or(1, MeshFile::placements);
            self.objects.extend(std::iter::repeat_n(name, count));
        }
    }
}
