//! The kind of texels with which a texture is stored: grey or coloured, short or wide.

use crate::texture::Texture;
use std::fmt::Debug;

/// A stored texel: a 16-bit code, or the 8-bit index of a code in a palette.
pub trait Code: Copy + Send + Sync + Debug {
    /// The codes for each index.
    type Palette: Clone + Send + Sync + Debug;

    /// Returns the code.
    fn value(self, palette: &Self::Palette) -> u32;

    /// Memory of a palette, in bytes.
    const PALETTE_BYTES: usize;
}

impl Code for u8 {
    type Palette = Box<[u16; 256]>;
    const PALETTE_BYTES: usize = size_of::<[u16; 256]>();

    #[inline(always)]
    fn value(self, palette: &Self::Palette) -> u32 {
        u32::from(palette[usize::from(self)])
    }
}

impl Code for u16 {
    type Palette = ();
    const PALETTE_BYTES: usize = 0;

    #[inline(always)]
    fn value(self, (): &()) -> u32 {
        u32::from(self)
    }
}

/// The codes of a texture with few of them, ascending. Unused entries at the end hold 65535.
pub type Palette = Box<[u16; 256]>;

/// Returns whether the three channels of all texels are equal.
#[must_use]
pub fn is_grey(texture: &Texture) -> bool {
    texture.texels.iter().all(|[red, green, blue]| red == green && green == blue)
}

/// Returns the codes that occur in a texture, if they are at most 256: always for pictures of 8 bits,
/// whether sRGB or linear.
#[must_use]
pub fn palette(texture: &Texture) -> Option<Palette> {
    let mut occurs = vec![false; 1 << 16];
    let (mut count, mut palette) = (0, Box::new([u16::MAX; 256]));
    for &code in texture.texels.iter().flatten() {
        if !occurs[usize::from(code)] {
            occurs[usize::from(code)] = true;
            count += 1;
            if count > palette.len() {
                return None;
            }
        }
    }
    let codes = (0..=u16::MAX).filter(|&code| occurs[usize::from(code)]);
    palette.iter_mut().zip(codes).for_each(|(entry, code)| *entry = code);
    Some(palette)
}

/// Returns the index of a code that occurs in the texture of this palette.
#[must_use]
pub fn index(palette: &Palette, code: u16) -> u8 {
    palette.partition_point(|&entry| entry < code) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_give_the_codes_again() {
        for count in [1, 2, 255, 256] {
            let texels = (0..count).map(|k| [65535 - 200 * k, 200 * k + 1, 0]).collect();
            let texture =
                Texture { width: 1, height: usize::from(count), texels, ..Texture::default() };
            let Some(palette) = palette(&texture) else {
                assert!(count > 127, "{count} texels have at most {} codes", 2 * count + 1);
                continue;
            };
            for &code in texture.texels.iter().flatten() {
                assert_eq!(palette[usize::from(index(&palette, code))], code);
            }
        }
    }
}
