//! Whether the textures of a picture fit the memory that they may take.

use crate::filter::Filter;
use crate::scene::Scene;
use files::{Exit, Failure};
use thiserror::Error;

/// Texels and tables take more memory than is allowed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "texture {name}: with the {filter} filter its {width} x {height} texels take {bytes} bytes, and all textures {sum}; expected at most {limit} (--max-texture-mem)"
)]
pub struct TextureMemoryError {
    /// The texture whose table is too large, or the last of several that are together.
    pub name: String,
    /// The filter's name.
    pub filter: String,
    /// Texels across.
    pub width: usize,
    /// Texels down.
    pub height: usize,
    /// Its texels and table.
    pub bytes: u64,
    /// Those of all textures up to it.
    pub sum: u64,
    /// What is allowed.
    pub limit: u64,
}

impl Failure for TextureMemoryError {
    fn exit(&self) -> Exit {
        Exit::Resource
    }
}

/// Checks, before anything is built, that the texels of all textures and the tables or pyramids of
/// those that are shown take at most `limit` bytes.
///
/// # Errors
/// With the first texture that does not fit.
pub fn check(scene: &Scene, filter: Filter, limit: u64) -> Result<(), TextureMemoryError> {
    let mut sum = scene.texture_bytes();
    for (texture, shown) in scene.textures.iter().zip(scene.shown_textures()) {
        let table = if shown { filter.bytes_for(texture) } else { 0 };
        sum = sum.saturating_add(table);
        if sum > limit {
            return Err(TextureMemoryError {
                name: texture.name.clone(),
                filter: filter.to_string(),
                width: texture.width,
                height: texture.height,
                bytes: texture.bytes().saturating_add(table),
                sum,
                limit,
            });
        }
    }
    Ok(())
}

/// Reads a number of bytes, such as `500000`, `64k`, `512M` or `2G`; the letters stand for powers
/// of 1024.
///
/// # Errors
/// On anything else, and beyond 64 bits.
pub fn bytes(text: &str) -> Result<u64, String> {
    let (digits, shift) = match text.char_indices().last() {
        Some((at, 'k' | 'K')) => (&text[..at], 10),
        Some((at, 'm' | 'M')) => (&text[..at], 20),
        Some((at, 'g' | 'G')) => (&text[..at], 30),
        _ => (text, 0),
    };
    let plain = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit());
    let number = digits.parse::<u64>().ok().filter(|_| plain);
    number
        .and_then(|number| number.checked_mul(1 << shift))
        .ok_or_else(|| "expected a number of bytes, or one with k, M or G such as 512M".into())
}

#[cfg(test)]
mod tests {
    use super::bytes;

    #[test]
    fn sizes_of_memory_have_letters() {
        let sizes = ["0", "17", "3k", "2M", "1G"].map(|text| bytes(text).unwrap());
        assert_eq!(sizes, [0, 17, 3 << 10, 2 << 20, 1 << 30]);
        for bad in ["", "k", "-1", "+1", "1.5G", "1T", "99999999999G", "2 G", "G2"] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
    }
}
