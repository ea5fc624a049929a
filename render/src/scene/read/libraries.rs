//! Reads the material libraries that a scene's meshes name.

use super::{Reader, SceneError};
use crate::scene::{Scene, Surface, SurfaceTexture, mtl};
use crate::texture::{Values, Wrap};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The libraries read so far: for each path, the surfaces by their names in `usemtl`.
#[derive(Debug, Default)]
pub(super) struct Libraries(BTreeMap<PathBuf, BTreeMap<String, Surface>>);

impl Libraries {
    /// Returns the surface of this name in the library at `path`.
    pub(super) fn surface(&self, path: &Path, name: &str) -> Option<Surface> {
        self.0.get(path)?.get(name).copied()
    }
}

impl Reader<'_> {
    /// Reads the libraries of this file's meshes. Their materials and textures follow those of the scene
    /// file in the scene's lists.
    pub(super) fn libraries(
        &self,
        libraries: &mut Libraries,
        scene: &mut Scene,
    ) -> Result<(), SceneError> {
        for (number, object) in self.file.objects.iter().enumerate() {
            let Some(mesh) = object.mesh() else { continue };
            let Some(path) = &mesh.mtl else { continue };
            let path = self.folder.join(path);
            if libraries.0.contains_key(&path) {
                continue;
            }
            let at = format!("objects[{number}].mesh.mtl");
            let bytes = self.named_file(&at, &path)?;
            let mut surfaces = BTreeMap::new();
            let folder = path.parent().unwrap_or(Path::new(""));
            let mut pictures = BTreeMap::new();
            for entry in mtl::read(&path.display().to_string(), &bytes)? {
                let texture = match entry.picture {
                    None => None,
                    Some(picture) => Some(match pictures.get(&picture) {
                        Some(&index) => index,
                        None => {
                            let file = folder.join(&picture);
                            let index = scene.textures.len();
                            let texture = self.texels(&at, &file, Values::Srgb, Wrap::Repeat)?;
                            scene.textures.push(texture);
                            scene.names.textures.push(picture.clone());
                            pictures.insert(picture, index);
                            index
                        }
                    }),
                };
                let material = scene.materials.len();
                scene.materials.push(entry.material);
                scene.names.materials.push(entry.name.clone());
                let texture = texture.map(SurfaceTexture::Picture);
                surfaces.insert(entry.name, Surface { material, texture });
            }
            libraries.0.insert(path, surfaces);
        }
        Ok(())
    }
}
