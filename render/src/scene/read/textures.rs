//! The textures of a scene file that are pictures.

use super::{Reader, SceneError};
use crate::texture::{Texture, Values, Wrap};
use image::{DynamicImage, ImageReader};
use std::io::Cursor;
use std::path::Path;

impl Reader<'_> {
    pub(super) fn textures(&self) -> Result<Vec<Texture>, SceneError> {
        let pictures = self.file.textures.iter().filter_map(|(name, texture)| {
            let path = self.folder.join(texture.image.as_deref()?);
            let (values, wrap) =
                (texture.values.unwrap_or_default(), texture.wrap.unwrap_or_default());
            Some(self.texels(&format!("textures.{name}.image"), &path, values, wrap))
        });
        pictures.collect()
    }

    /// The texture of the picture file at `path`, which the scene names at `place`.
    pub(super) fn texels(
        &self,
        place: &str,
        path: &Path,
        values: Values,
        wrap: Wrap,
    ) -> Result<Texture, SceneError> {
        let picture = self.picture(place, path)?;
        match Texture::from_picture(&picture, values, wrap) {
            Some(texture) => Ok(texture),
            None => self.fault(
                place,
                format!("found floating point values in {}, expected 8 or 16 bits", path.display()),
            ),
        }
    }

    /// The picture file at `path`, which the scene names at `place`.
    pub(super) fn picture(&self, place: &str, path: &Path) -> Result<DynamicImage, SceneError> {
        let bytes = self.named_file(place, path)?;
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
