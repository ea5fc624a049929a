//! Makes textures of decoded pictures.
//!
//! Whole numbers become codes of linear light. Floating point values are linear already and become two
//! digits of 16 bits ([`Floats`]); NaN and negative values count as 0, and infinity as the largest finite
//! value. Alpha becomes a mask, by which the colours are multiplied, so that the colour of transparent
//! texels does not show at the edges of a cut-out. The alpha of an EXR has been multiplied already.

use super::{Alpha, Floats, Texture, Values, Wrap};
use crate::color::Encoding;
use image::{ColorType, DynamicImage};

/// The largest code of 16 bits.
const MOST: u16 = u16::MAX;

impl Texture {
    /// Creates a texture from a decoded picture. Grey becomes three equal channels.
    #[must_use]
    pub fn from_picture(picture: &DynamicImage, values: Values, wrap: Wrap, alpha: Alpha) -> Self {
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let bytes = bytes_per_channel(picture.color());
        let has_alpha =
            alpha != Alpha::Ignore && picture.color().has_alpha() && !Self::is_invisible(picture);
        let cut = |code: u16| match alpha {
            Alpha::From(least) => {
                if code >= least {
                    MOST
                } else {
                    0
                }
            }
            Alpha::Cut | Alpha::Ignore => code,
        };
        if bytes > 2 {
            let texels = picture.to_rgba32f();
            let light = texels.pixels().map(|pixel| [pixel.0[0], pixel.0[1], pixel.0[2]]);
            let texture = of_floats(&light.collect::<Vec<[f32; 3]>>(), [width, height], wrap);
            let codes = texels.pixels().map(|pixel| (pixel.0[3].clamp(0.0, 1.0) * 65535.0).round());
            let mask: Vec<u16> =
                if has_alpha { codes.map(|x| cut(x as u16)).collect() } else { vec![] };
            return texture.with_mask(mask);
        }
        let wide = bytes == 2;
        let (codes, coded_white): (Vec<[u16; 3]>, u16) = if wide {
            (picture.to_rgb16().pixels().map(|pixel| pixel.0).collect(), MOST)
        } else {
            (picture.to_rgb8().pixels().map(|pixel| pixel.0.map(u16::from)).collect(), 255)
        };
        let (texels, white) = match values {
            Values::Linear => (codes, coded_white),
            Values::Srgb => {
                let linear: Vec<u16> = (0..=coded_white)
                    .map(|code| {
                        let light = Encoding::Srgb.decode(f64::from(code) / f64::from(coded_white));
                        (light * f64::from(MOST)).round() as u16
                    })
                    .collect();
                let decode = |texel: [u16; 3]| texel.map(|code| linear[usize::from(code)]);
                (codes.into_iter().map(decode).collect(), MOST)
            }
        };
        let texture = Self { width, height, wrap, texels, white, ..Self::default() };
        let mask = if !has_alpha {
            vec![]
        } else if wide {
            picture.to_rgba16().pixels().map(|pixel| cut(pixel.0[3])).collect()
        } else {
            picture.to_rgba8().pixels().map(|pixel| cut(u16::from(pixel.0[3]) * 257)).collect()
        };
        texture.multiplied_by(mask)
    }

    /// Returns whether a picture has an alpha channel in which all texels are wholly transparent. Such a
    /// channel was written by mistake, and its texels are taken as opaque.
    #[must_use]
    pub fn is_invisible(picture: &DynamicImage) -> bool {
        let clear = |alpha: f32| alpha <= 0.0;
        match picture {
            DynamicImage::ImageLumaA8(texels) => texels.pixels().all(|texel| texel.0[1] == 0),
            DynamicImage::ImageRgba8(texels) => texels.pixels().all(|texel| texel.0[3] == 0),
            picture if picture.color().has_alpha() => {
                picture.to_rgba32f().pixels().all(|texel| clear(texel.0[3]))
            }
            _ => false,
        }
    }

    /// Creates a mask from a decoded picture: its alpha if some of its texels are transparent, and
    /// otherwise its grey, as codes of coverage.
    #[must_use]
    pub fn mask_of_picture(picture: &DynamicImage, wrap: Wrap) -> Self {
        let size = |texels| Self {
            width: picture.width() as usize,
            height: picture.height() as usize,
            wrap,
            texels,
            white: MOST,
            ..Self::default()
        };
        if picture.color().has_alpha() && !Self::is_invisible(picture) {
            let alpha = picture.to_rgba16();
            if alpha.pixels().any(|pixel| pixel.0[3] < MOST) {
                return size(alpha.pixels().map(|pixel| [pixel.0[3]; 3]).collect());
            }
        }
        size(picture.to_luma16().pixels().map(|pixel| [pixel.0[0]; 3]).collect())
    }

    /// Creates a texture of one white texel.
    #[must_use]
    pub fn white(wrap: Wrap) -> Self {
        let texels = vec![[MOST; 3]];
        Self { width: 1, height: 1, wrap, texels, white: MOST, ..Self::default() }
    }

    /// Returns the texture cut out by a mask of any size. Of the two sizes, each texture gets the larger
    /// along each axis. A mask that covers everything cuts out nothing.
    #[must_use]
    pub fn cut_out_by(self, mask: &Self) -> Self {
        let (width, height) = (self.width.max(mask.width), self.height.max(mask.height));
        let codes = mask.resized(width, height).texels.into_iter().map(|texel| texel[0]);
        let whole = Self { mask: None, ..self };
        whole.resized(width, height).multiplied_by(codes.collect())
    }

    /// Returns the texture with another size. Texels are repeated.
    fn resized(&self, width: usize, height: usize) -> Self {
        let texel = |k: usize| {
            let (row, column) = (k / width, k % width);
            self.texels[row * self.height / height * self.width + column * self.width / width]
        };
        let texels = (0..width * height).map(texel).collect();
        let floats = self.floats.as_ref().map(|floats| {
            Box::new(Floats { low: floats.low.resized(width, height), light: floats.light })
        });
        let (name, wrap, white) = (self.name.clone(), self.wrap, self.white);
        Self { name, width, height, wrap, white, texels, floats, mask: None }
    }

    /// Multiplies the texels by a mask and keeps the mask. A mask that covers everything is left out.
    fn multiplied_by(mut self, mask: Vec<u16>) -> Self {
        if mask.iter().all(|&code| code == MOST) {
            return self;
        }
        // Codes of 8 bits would lose digits.
        let wider = if self.white < MOST { MOST / self.white } else { 1 };
        self.white *= wider;
        let product = |code: u16, by: u16| {
            ((u32::from(code) * u32::from(by) + u32::from(MOST) / 2) / u32::from(MOST)) as u16
        };
        for (texel, &by) in self.texels.iter_mut().zip(&mask) {
            *texel = texel.map(|code| product(code * wider, by));
        }
        if let Some(floats) = &mut self.floats {
            for (texel, &by) in floats.low.texels.iter_mut().zip(&mask) {
                *texel = texel.map(|code| product(code, by));
            }
        }
        self.with_mask(mask)
    }

    /// Keeps a mask by which the texels are multiplied already, unless it covers everything.
    fn with_mask(mut self, mask: Vec<u16>) -> Self {
        if mask.iter().any(|&code| code < MOST) {
            let texels = mask.into_iter().map(|code| [code; 3]).collect();
            let Self { width, height, wrap, .. } = self;
            let mask = Self { width, height, wrap, texels, white: MOST, ..Self::default() };
            self.mask = Some(Box::new(mask));
        }
        self
    }

    /// Returns the bytes per pixel while a picture of this kind becomes a texture: decoded, as
    /// codes and as texels, all at once, and its mask. The decoder's own working memory is not included.
    #[must_use]
    pub fn decoding_bytes(kind: ColorType) -> u64 {
        let texels = size_of::<[u16; 3]>() as u64;
        let codes = match bytes_per_channel(kind) {
            1 => 3,
            2 => 6,
            // A copy with alpha, the light, and the second digit.
            _ => 16 + 12 + texels,
        };
        let mask = if kind.has_alpha() { 2 + texels + 8 } else { 0 };
        u64::from(kind.bytes_per_pixel()) + codes + texels + mask
    }
}

/// Returns the bytes of one channel: 1 or 2 for whole numbers, 4 for floating point values.
fn bytes_per_channel(kind: ColorType) -> u8 {
    kind.bytes_per_pixel() / kind.channel_count()
}

/// Returns the texture of floating point values, row by row.
fn of_floats(channels: &[[f32; 3]], [width, height]: [usize; 2], wrap: Wrap) -> Texture {
    let finite = |x: f32| if x.is_finite() && x > 0.0 { x } else { 0.0 };
    let largest = channels.iter().flatten().map(|&x| finite(x)).fold(0.0, f32::max);
    let light = if largest > 0.0 { f64::from(largest) } else { 1.0 };
    let digits = |x: f32| {
        let x = if x == f32::INFINITY { largest } else { finite(x) };
        let whole = f64::from(x) / light * f64::from(MOST);
        let low = ((whole - whole.floor()) * f64::from(MOST)).round();
        [whole.floor() as u16, low as u16]
    };
    let both = channels.iter().map(|texel| texel.map(digits));
    let (texels, low) =
        both.map(|both| (both.map(|[high, _]| high), both.map(|[_, low]| low))).unzip();
    let texture =
        |texels| Texture { width, height, wrap, texels, white: MOST, ..Texture::default() };
    let floats = Some(Box::new(Floats { low: texture(low), light }));
    Texture { floats, ..texture(texels) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, Rgb32FImage, RgbImage, Rgba, RgbaImage};

    #[test]
    fn encoded_texels_become_16_bit_light() {
        let white = RgbImage::from_pixel(1, 1, Rgb([255, 188, 0]));
        let texture = Texture::from_picture(&white.into(), Values::Srgb, Wrap::Clamp, Alpha::Cut);
        assert_eq!((texture.white, texture.texels[0]), (65535, [65535, 32957, 0]));
    }

    #[test]
    fn two_digits_hold_a_sun_and_its_shadow() {
        let light = [[0.001, 0.37, 20_000.0], [-1.0, f32::NAN, f32::INFINITY]];
        let picture = Rgb32FImage::from_fn(2, 1, |x, _| Rgb(light[x as usize]));
        let texture =
            Texture::from_picture(&picture.into(), Values::Srgb, Wrap::Repeat, Alpha::Cut);
        let floats = texture.floats.unwrap();
        let found = |texel: usize, k: usize| {
            let low = f64::from(floats.low.texels[texel][k]) / 65535.0;
            floats.light * (f64::from(texture.texels[texel][k]) + low) / 65535.0
        };
        for (k, truth) in light[0].into_iter().enumerate() {
            // Half a step of the lower digit.
            assert!((found(0, k) - f64::from(truth)).abs() < 20_000.0 / 65535f64.powi(2));
        }
        assert_eq!([0, 1, 2].map(|k| found(1, k)), [0.0, 0.0, 20_000.0]);
    }

    #[test]
    fn transparent_texels_have_no_colour_of_their_own() {
        let texels = [[255, 0, 0, 0], [0, 255, 0, 51], [0, 0, 255, 255]];
        let picture = RgbaImage::from_fn(3, 1, |x, _| Rgba(texels[x as usize])).into();
        let cut = Texture::from_picture(&picture, Values::Linear, Wrap::Clamp, Alpha::Cut);
        assert_eq!(cut.texels, [[0, 0, 0], [0, 13107, 0], [0, 0, 65535]]);
        let mask = cut.mask.unwrap();
        assert_eq!(mask.texels, [[0; 3], [13107; 3], [65535; 3]]);
        assert_eq!(Texture::mask_of_picture(&picture, Wrap::Clamp).texels, mask.texels);
        let clear = RgbaImage::from_pixel(1, 1, Rgba([9, 8, 7, 0])).into();
        let shown = Texture::from_picture(&clear, Values::Linear, Wrap::Clamp, Alpha::Cut);
        assert_eq!((shown.mask, shown.texels[0]), (None, [9, 8, 7]), "nothing would be left");
        let whole = Texture::from_picture(&picture, Values::Linear, Wrap::Clamp, Alpha::Ignore);
        assert_eq!((whole.mask, whole.texels[0]), (None, [255, 0, 0]));
    }

    #[test]
    fn a_mask_of_another_size_cuts_out_a_picture() {
        let grey =
            image::GrayImage::from_fn(4, 1, |x, _| image::Luma([if x < 2 { 0 } else { 255 }]));
        let mask = Texture::mask_of_picture(&grey.into(), Wrap::Repeat);
        let cut = Texture::white(Wrap::Repeat).cut_out_by(&mask);
        assert_eq!((cut.width, cut.height), (4, 1));
        assert_eq!(cut.texels, [[0; 3], [0; 3], [65535; 3], [65535; 3]]);
        assert_eq!(cut.mask.map(|mask| mask.texels), Some(mask.texels));
        let all = Texture {
            texels: vec![[65535; 3]; 4],
            ..Texture::mask_of_picture(&image::GrayImage::new(4, 1).into(), Wrap::Repeat)
        };
        assert_eq!(Texture::white(Wrap::Repeat).cut_out_by(&all).mask, None);
    }
}
