//! The bumps of a scene file's materials.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::procedural::{Bump, Heights, NormalMap, Relief};
use crate::scene::file::bump::{BumpFile, ImageReliefFile, NormalsFile, ReliefKind};
use glam::{DVec2, DVec3};
use image::DynamicImage;

/// The fault of a picture of no size.
const EMPTY: &str = "found a picture without pixels";

impl Reader<'_> {
    /// Reads the bumps of all materials, in the order of the materials.
    pub(super) fn bumps(&self) -> Result<Vec<Bump>, SceneError> {
        let bumps = self.file.materials.iter().filter_map(|(name, material)| {
            let bump = material.bump.as_ref()?;
            Some(self.bump(&format!("materials.{name}.bump"), bump))
        });
        bumps.collect()
    }

    fn bump(&self, at: &str, file: &BumpFile) -> Result<Bump, SceneError> {
        let kind = self.one_of(at, &file.kinds())?;
        let strength = self.within(&format!("{at}.strength"), file.strength, -1e6, 1e6)?;
        let placement = self.texture_place(&format!("{at}.place"), file.place.as_ref())?;
        let relief = match kind {
            ReliefKind::Noise(noise) => {
                let at = format!("{at}.noise");
                Relief::Noise(self.octaves(&at, noise.octaves, noise.interpolation)?)
            }
            ReliefKind::Turbulence(noise) => {
                let at = format!("{at}.turbulence");
                Relief::Turbulence(self.octaves(&at, noise.octaves, noise.interpolation)?)
            }
            ReliefKind::Wall(wall) => {
                if wall.colors.is_some() {
                    let message = "found this key on a bump, expected it only on textures";
                    return self.fault(&format!("{at}.wall.colors"), message);
                }
                Relief::Wall(self.wall(&format!("{at}.wall"), wall)?)
            }
            ReliefKind::Dnoise(dnoise) => Relief::Dnoise(self.noise(dnoise.interpolation)),
            ReliefKind::Image(image) => {
                if file.place.is_some() {
                    let message = "found this key on a picture, expected it only on a relief that \
                                   fills space";
                    return self.fault(&format!("{at}.place"), message);
                }
                Relief::Picture(self.heights(&format!("{at}.image"), image)?)
            }
            ReliefKind::Normals(normals) => {
                if file.place.is_some() {
                    let message = "found this key on a picture, expected it only on a relief that \
                                   fills space";
                    return self.fault(&format!("{at}.place"), message);
                }
                Relief::Normals(self.normals(&format!("{at}.normals"), normals)?)
            }
        };
        Ok(Bump { relief, strength, placement })
    }

    /// Reads the grey of a picture as heights, from 0 for black to 1 for white. The codes are not decoded:
    /// the depth of a sweep reads pictures in the same manner.
    fn heights(&self, at: &str, file: &ImageReliefFile) -> Result<Heights, SceneError> {
        self.repeat(at, file.repeat)?;
        let at = format!("{at}.file");
        let (picture, _reserved) = self.picture(&at, &self.folder.join(&file.file))?;
        self.heights_of(&at, picture, file.repeat.into(), file.mirror)
    }

    /// Reads the colours of a picture as normals.
    fn normals(&self, at: &str, file: &NormalsFile) -> Result<NormalMap, SceneError> {
        self.repeat(at, file.repeat)?;
        let at = format!("{at}.file");
        let (picture, _reserved) = self.picture(&at, &self.folder.join(&file.file))?;
        self.normals_of(&at, &picture, file.repeat.into(), false)
    }

    fn repeat(&self, at: &str, repeat: [f64; 2]) -> Result<(), SceneError> {
        for (k, repeat) in repeat.into_iter().enumerate() {
            self.within(&format!("{at}.repeat[{k}]"), repeat, 1e-6, 1e6)?;
        }
        Ok(())
    }

    /// Returns the heights of a picture that the scene names at the JSON path `at`.
    pub(super) fn heights_of(
        &self,
        at: &str,
        picture: DynamicImage,
        repeat: DVec2,
        mirror: bool,
    ) -> Result<Heights, SceneError> {
        let picture = picture.into_luma16();
        let values = picture.pixels().map(|pixel| f64::from(pixel.0[0]) / f64::from(u16::MAX));
        let width = picture.width() as usize;
        match Heights::new(values.collect(), width, repeat, mirror) {
            Some(heights) => Ok(heights),
            None => self.fault(at, EMPTY),
        }
    }

    /// Returns the normals of a picture that the scene names at the JSON path `at`. With `mirror` every other
    /// copy of the picture is mirrored. Its normals are kept, as programs that draw with mirrored pictures do.
    pub(super) fn normals_of(
        &self,
        at: &str,
        picture: &DynamicImage,
        repeat: DVec2,
        mirror: bool,
    ) -> Result<NormalMap, SceneError> {
        let picture = picture.to_rgb16();
        let (width, height) = (picture.width(), picture.height());
        let copies = if mirror { 2 } else { 1 };
        let within = |at: u32, size: u32| if at < size { at } else { 2 * size - 1 - at };
        let normals = (0..copies * height).flat_map(|y| {
            let picture = &picture;
            (0..copies * width)
                .map(move |x| normal(picture.get_pixel(within(x, width), within(y, height)).0))
        });
        let repeat = repeat / f64::from(copies);
        match NormalMap::new(normals.collect(), (copies * width) as usize, repeat) {
            Some(map) => Ok(map),
            None => self.fault(at, EMPTY),
        }
    }
}

/// Decodes the colour of a normal.
fn normal(codes: [u16; 3]) -> DVec3 {
    DVec3::from(codes.map(|code| f64::from(code) / f64::from(u16::MAX) * 2.0 - 1.0))
}

/// Returns whether a picture is a normal map: nine tenths of its colours are nearly unit vectors on the outside,
/// and not all are grey. No grey is near a unit vector but a light one.
pub(super) fn are_normals(picture: &DynamicImage) -> bool {
    if !picture.color().has_color() {
        return false;
    }
    let picture = picture.to_rgb16();
    let (mut units, mut colored) = (0_usize, false);
    for pixel in picture.pixels() {
        let [red, green, blue] = pixel.0;
        colored |= red != green || green != blue;
        let normal = normal(pixel.0);
        units += usize::from(normal.z > 0.0 && (0.9..=1.1).contains(&normal.length()));
    }
    colored && 10 * units >= 9 * picture.pixels().len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, RgbImage};

    #[test]
    fn normal_maps_are_told_from_heights_by_their_colours() {
        let picture = |color: fn(u32) -> [u8; 3]| {
            DynamicImage::from(RgbImage::from_fn(16, 16, |x, y| Rgb(color(x + 16 * y))))
        };
        let code = |x: f64| ((x + 1.0) * 127.5).round() as u8;
        assert!(are_normals(&picture(|_| [128, 128, 255])));
        assert!(are_normals(&picture(|k| {
            let (x, y) = ((f64::from(k) * 0.7).sin() * 0.6, (f64::from(k) * 1.1).sin() * 0.6);
            let code = |x: f64| ((x + 1.0) * 127.5).round() as u8;
            [code(x), code(y), code((1.0 - x * x - y * y).sqrt())]
        })));
        assert_eq!(code(0.0), 128);
        // Grey of any brightness, also one whose vector has length 1; and colours of any kind.
        assert!(!are_normals(&picture(|k| [k as u8; 3])));
        assert!(!are_normals(&picture(|_| [201; 3])));
        assert!(!are_normals(&picture(|k| [k as u8, 255 - k as u8, (7 * k) as u8])));
        assert!(!are_normals(&DynamicImage::new_luma8(4, 4)));
    }
}
