//! The textures of a scene file.

use super::{Reader, SceneError};
use crate::scene::file::TextureFile;
use crate::texture::Texture;
use image::{DynamicImage, ImageReader};
use std::io::Cursor;
use std::path::Path;

impl Reader<'_> {
    pub(super) fn textures(&self) -> Result<Vec<Texture>, SceneError> {
        let pictures = self.file.textures.iter().filter_map(|(name, texture)| {
            Some(self.texture(name, texture, texture.image.as_deref()?))
        });
        pictures.collect()
    }

    fn texture(
        &self,
        name: &str,
        texture: &TextureFile,
        image: &Path,
    ) -> Result<Texture, SceneError> {
        let place = format!("textures.{name}.image");
        let picture = self.picture(&place, image)?;
        let (values, wrap) = (texture.values.unwrap_or_default(), texture.wrap.unwrap_or_default());
        match Texture::from_picture(&picture, values, wrap) {
            Some(texture) => Ok(texture),
            None => self.fault(
                &place,
                format!(
                    "found floating point values in {}, expected 8 or 16 bits",
                    self.folder.join(image).display()
                ),
            ),
        }
    }

    /// The picture file that the scene names at `place`.
    pub(super) fn picture(&self, place: &str, path: &Path) -> Result<DynamicImage, SceneError> {
        let path = self.folder.join(path);
        let bytes = self.named_file(place, &path)?;
        let decoded = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(image::ImageError::IoError)
            .and_then(ImageReader::decode);
        match decoded {
            Ok(picture) => Ok(picture),
            Err(error) => {
                let message = format!(
                    "found no picture in {} ({error}), expected a PNG or JPEG file",
                    path.display()
                );
                self.fault(place, message)
            }
        }
    }
}
