//! The textures of a scene file that are pictures.

use super::{Reader, SceneError};
use crate::texture::{Texture, Values, Wrap};
use files::input;
use files::memory::{Budget, MemoryError, Reserved};
use files::picture::{self, Format, PictureError};
use image::DynamicImage;
use std::cell::Cell;
use std::path::Path;

/// Memory for what a scene reads.
#[derive(Debug)]
pub(super) struct Memory<'b> {
    budget: &'b Budget,
    /// Bytes taken by what was read, until the scene is whole.
    kept: Cell<u64>,
}

impl Drop for Memory<'_> {
    fn drop(&mut self) {
        self.budget.give_back(self.kept.get());
    }
}

impl<'b> Memory<'b> {
    pub(super) fn new(budget: &'b Budget) -> Self {
        Self { budget, kept: Cell::new(0) }
    }

    /// Keeps what is reserved.
    fn take(&self, reserved: Reserved<'_>) {
        self.kept.set(self.kept.get() + reserved.into_bytes());
    }

    /// Takes memory for something that the scene keeps.
    pub(super) fn keep(
        &self,
        bytes: u64,
        what: impl FnOnce() -> String,
    ) -> Result<(), MemoryError> {
        self.take(self.budget.reserve(bytes, what)?);
        Ok(())
    }
}

impl<'a> Reader<'a> {
    pub(super) fn textures(&self) -> Result<Vec<Texture>, SceneError> {
        let pictures = self.file.textures.iter().filter_map(|(name, texture)| {
            let path = self.folder.join(texture.image.as_deref()?);
            let (values, wrap) =
                (texture.values.unwrap_or_default(), texture.wrap.unwrap_or_default());
            let texels = self.texels(&format!("textures.{name}.image"), &path, values, wrap);
            Some(texels.map(|texels| Texture { name: name.clone(), ..texels }))
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
        let (picture, mut reserved) = self.picture(place, path)?;
        match Texture::from_picture(&picture, values, wrap) {
            Some(texture) => {
                reserved.shrink(texture.bytes());
                self.memory.take(reserved);
                Ok(texture)
            }
            None => self.fault(
                place,
                format!(
                    "found floating point values in {}, expected 8 or 16 bits",
                    input::name_of(path)
                ),
            ),
        }
    }

    /// The picture file at `path`, which the scene names at `place`, and the memory for a texture
    /// of it.
    pub(super) fn picture(
        &self,
        place: &str,
        path: &Path,
    ) -> Result<(DynamicImage, Reserved<'a>), SceneError> {
        let bytes = self.named_file(place, path)?;
        let name = || input::name_of(path);
        // An EXR is read to be refused with its own sentence, which names floating point values.
        let formats = [Format::Png, Format::Jpeg, Format::OpenExr];
        let budget = self.memory.budget;
        picture::decode(&bytes, &formats, Texture::decoding_bytes, budget, name).map_err(|error| {
            match error {
                PictureError::Memory(error) => {
                    SceneError::TooLarge(self.document.fault(place, error.to_string()))
                }
                error => {
                    let message = format!(
                        "found no picture in {} ({error}), expected a PNG or JPEG file",
                        name()
                    );
                    self.document.fault(place, message).into()
                }
            }
        })
    }
}
