//! Reads the textures of a scene file that are pictures.

use super::{Reader, SceneError};
use crate::texture::{Alpha, Texture, Values, Wrap};
use files::check::{Finding, Severity};
use files::input;
use files::memory::{Budget, MemoryError, Reserved};
use files::picture::{self, PictureError, SURFACES};
use image::DynamicImage;
use std::cell::Cell;
use std::path::Path;

/// Memory of the pictures and meshes of a scene, taken from a budget.
#[derive(Debug)]
pub(super) struct Memory<'b> {
    budget: &'b Budget,
    /// Bytes taken by pictures and meshes until the scene is complete.
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

    /// Keeps a reservation until the scene is complete.
    fn take(&self, reserved: Reserved<'_>) {
        self.kept.set(self.kept.get() + reserved.into_bytes());
    }

    /// Reserves memory until the scene is complete.
    pub(super) fn keep(
        &self,
        bytes: u64,
        what: impl FnOnce() -> String,
    ) -> Result<(), MemoryError> {
        self.take(self.budget.reserve(bytes, what)?);
        Ok(())
    }
}

/// The reading of a picture as a texture.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Kind {
    pub(super) values: Values,
    pub(super) wrap: Wrap,
    pub(super) alpha: Alpha,
}

impl<'a> Reader<'a> {
    pub(super) fn textures(&self) -> Result<Vec<Texture>, SceneError> {
        let pictures = self.file.textures.iter().filter_map(|(name, texture)| {
            let path = self.folder.join(texture.image.as_deref()?);
            let kind = Kind {
                values: texture.values.unwrap_or_default(),
                wrap: texture.wrap.unwrap_or_default(),
                alpha: texture.alpha.unwrap_or_default(),
            };
            let texels = self.texels(&format!("textures.{name}.image"), &path, kind);
            Some(texels.map(|texels| Texture { name: name.clone(), ..texels }))
        });
        pictures.collect()
    }

    /// Reads the picture file `path`, which the scene names at the JSON path `at`, as a texture.
    pub(super) fn texels(&self, at: &str, path: &Path, kind: Kind) -> Result<Texture, SceneError> {
        let make = |picture: &DynamicImage| {
            Texture::from_picture(picture, kind.values, kind.wrap, kind.alpha)
        };
        self.texture_of(at, path, make)
    }

    /// Reads the picture file `path`, which the scene names at the JSON path `at`, and keeps the memory of
    /// the texture that `make` makes of it.
    pub(super) fn texture_of(
        &self,
        at: &str,
        path: &Path,
        make: impl FnOnce(&DynamicImage) -> Texture,
    ) -> Result<Texture, SceneError> {
        let (picture, mut reserved) = self.picture(at, path)?;
        let texture = make(&picture);
        reserved.shrink(texture.bytes());
        self.memory.take(reserved);
        Ok(texture)
    }

    /// Reads the picture file `path`, which the scene names at the JSON path `at`. Returns the picture and
    /// the memory of a texture made from it.
    pub(super) fn picture(
        &self,
        at: &str,
        path: &Path,
    ) -> Result<(DynamicImage, Reserved<'a>), SceneError> {
        let bytes = self.named_file(at, path)?;
        let name = || input::name_of(path);
        let budget = self.memory.budget;
        let decoded = picture::decode(&bytes, &SURFACES, Texture::decoding_bytes, budget, name);
        let read = decoded.map_err(|error| match error {
            PictureError::Memory(error) => {
                SceneError::TooLarge(self.document.fault(at, error.to_string()))
            }
            error @ (PictureError::Format(_) | PictureError::Broken(_)) => {
                let message = format!(
                    "found no picture in {} ({error}), expected a PNG, JPEG, TGA, BMP, TIFF, \
                     WebP, GIF, HDR or EXR file",
                    name()
                );
                self.document.fault(at, message).into()
            }
        })?;
        let mut unused = picture::unused(&bytes);
        if Texture::is_invisible(&read.0) {
            unused.push("all texels are transparent, and are taken as opaque");
        }
        if !unused.is_empty() {
            let finding = Finding::new(Severity::Remark, name(), unused.join("; "));
            self.remarks.borrow_mut().push(finding);
        }
        Ok(read)
    }
}
