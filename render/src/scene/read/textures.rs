//! The textures of a scene file.

use super::{Reader, SceneError};
use crate::scene::file::TextureFile;
use crate::texture::Texture;
use image::{DynamicImage, ImageDecoder, ImageError, ImageReader, ImageResult, Limits};
use std::io::Cursor;
use std::path::Path;

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
        let mut textures: Vec<Texture> = Vec::with_capacity(self.file.textures.len());
        for (name, texture) in &self.file.textures {
            let kept = textures.iter().map(Texture::bytes).sum();
            textures.push(self.texture(name, texture, kept)?);
        }
        Ok(textures)
    }

    /// Reads a texture, beside others that take `kept` bytes.
    fn texture(&self, name: &str, texture: &TextureFile, kept: u64) -> Result<Texture, SceneError> {
        let place = format!("textures.{name}.image");
        let path = self.folder.join(&texture.image);
        let bytes = self.named_file(&place, &path)?;
        let room = self.max_texture_bytes.saturating_sub(kept);
        let picture = match decode(&bytes, room) {
            Ok(Found::Picture(picture)) => picture,
            Ok(Found::TooLarge { width, height, bytes }) => {
                let size = format!("found {width} x {height} texels in {}", path.display());
                return self.too_large(&place, &size, bytes, kept);
            }
            Err(ImageError::Limits(_)) => {
                let size = format!("found a large picture in {}", path.display());
                return self.too_large(&place, &size, room, kept);
            }
            Err(error) => return self.no_picture(&place, &path, &error),
        };
        match Texture::from_picture(&picture, texture.values, texture.wrap) {
            Some(read) => Ok(Texture { name: name.into(), ..read }),
            None => self.fault(
                &place,
                format!("found floating point values in {}, expected 8 or 16 bits", path.display()),
            ),
        }
    }

    fn no_picture<T>(&self, place: &str, path: &Path, error: &ImageError) -> Result<T, SceneError> {
        let path = path.display();
        let message = format!("found no picture in {path} ({error}), expected a PNG or JPEG file");
        self.fault(place, message)
    }

    fn too_large<T>(
        &self,
        place: &str,
        found: &str,
        bytes: u64,
        kept: u64,
    ) -> Result<T, SceneError> {
        let limit = self.max_texture_bytes;
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
