//! The textures of a scene file.

use super::{Reader, SceneError};
use crate::scene::file::TextureFile;
use crate::texture::{Texture, Values, Wrap};
use image::ImageReader;
use std::io::Cursor;
use std::path::Path;

impl Reader<'_> {
    pub(super) fn textures(&self) -> Result<Vec<Texture>, SceneError> {
        self.file.textures.iter().map(|(name, texture)| self.texture(name, texture)).collect()
    }

    fn texture(&self, name: &str, texture: &TextureFile) -> Result<Texture, SceneError> {
        let place = format!("textures.{name}.image");
        let path = self.folder.join(&texture.image);
        self.picture(&place, &path, texture.values, texture.wrap)
    }

    /// The texture of the picture file at `path`, which the scene names at `place`.
    pub(super) fn picture(
        &self,
        place: &str,
        path: &Path,
        values: Values,
        wrap: Wrap,
    ) -> Result<Texture, SceneError> {
        let bytes = self.named_file(place, path)?;
        let decoded = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(image::ImageError::IoError)
            .and_then(ImageReader::decode);
        let picture = match decoded {
            Ok(picture) => picture,
            Err(error) => {
                let message = format!(
                    "found no picture in {} ({error}), expected a PNG or JPEG file",
                    path.display()
                );
                return self.fault(place, message);
            }
        };
        match Texture::from_picture(&picture, values, wrap) {
            Some(texture) => Ok(texture),
            None => self.fault(
                place,
                format!("found floating point values in {}, expected 8 or 16 bits", path.display()),
            ),
        }
    }
}
