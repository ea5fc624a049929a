//! The textures of a scene file that are pictures.

use super::{Reader, SceneError};
use crate::texture::{Texture, Values, Wrap};
use image::{DynamicImage, ImageDecoder, ImageError, ImageReader, ImageResult, Limits};
use std::cell::Cell;
use std::io::Cursor;
use std::path::Path;

/// Memory for the pictures of a scene.
#[derive(Debug)]
pub(super) struct Memory {
    /// What they may take, in bytes.
    pub(super) limit: u64,
    /// What those take that were read.
    pub(super) kept: Cell<u64>,
}

/// A picture file, decoded or not.
enum Found {
    Picture(DynamicImage),
    /// Not begun: it would take too much memory.
    TooLarge {
        width: u32,
        height: u32,
        bytes: u64,
    },
}

impl Reader<'_> {
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
        let picture = self.picture(place, path)?;
        match Texture::from_picture(&picture, values, wrap) {
            Some(texture) => {
                self.memory.kept.set(self.memory.kept.get().saturating_add(texture.bytes()));
                Ok(texture)
            }
            None => self.fault(
                place,
                format!("found floating point values in {}, expected 8 or 16 bits", path.display()),
            ),
        }
    }

    /// The picture file at `path`, which the scene names at `place`.
    pub(super) fn picture(&self, place: &str, path: &Path) -> Result<DynamicImage, SceneError> {
        let bytes = self.named_file(place, path)?;
        let room = self.memory.limit.saturating_sub(self.memory.kept.get());
        let path = path.display();
        match decode(&bytes, room) {
            Ok(Found::Picture(picture)) => Ok(picture),
            Ok(Found::TooLarge { width, height, bytes }) => {
                self.too_large(place, &format!("found {width} x {height} texels in {path}"), bytes)
            }
            Err(ImageError::Limits(_)) => {
                self.too_large(place, &format!("found a large picture in {path}"), room)
            }
            Err(error) => {
                let message =
                    format!("found no picture in {path} ({error}), expected a PNG or JPEG file");
                self.fault(place, message)
            }
        }
    }

    fn too_large<T>(&self, place: &str, found: &str, bytes: u64) -> Result<T, SceneError> {
        let (limit, kept) = (self.memory.limit, self.memory.kept.get());
        let others = if kept > 0 { format!(" beside {kept} of others") } else { String::new() };
        let message = format!(
            "{found}, which take {bytes} bytes to read{others}; expected at most {limit} for all textures (--max-texture-mem)"
        );
        Err(SceneError::TooLarge(self.document.fault(place, message)))
    }
}

/// The picture in a file, if it can be had with this much memory. Its size is looked at first.
fn decode(file: &[u8], most: u64) -> ImageResult<Found> {
    let mut reader = ImageReader::new(Cursor::new(file)).with_guessed_format()?;
    let mut limits = Limits::no_limits();
    // What the decoder works with comes on top of the picture; this much is more than it needs.
    limits.max_alloc = Some(most.saturating_add(1 << 24));
    reader.limits(limits);
    let decoder = reader.into_decoder()?;
    let (width, height) = decoder.dimensions();
    let bytes = Texture::decoding_bytes(width, height, decoder.color_type());
    if bytes > most {
        return Ok(Found::TooLarge { width, height, bytes });
    }
    DynamicImage::from_decoder(decoder).map(Found::Picture)
}
