//! The bumps of a scene file's materials.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::procedural::{Bump, Heights, Relief};
use crate::scene::file::bump::{BumpFile, ImageReliefFile, ReliefKind};

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
        let place = file.place.unwrap_or_default();
        let placement = self.texture_place(&format!("{at}.place"), &place)?;
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
        };
        Ok(Bump { relief, strength, placement })
    }

    /// Reads the grey of a picture as heights, from 0 for black to 1 for white. The codes are not decoded:
    /// the depth of a sweep reads pictures in the same manner.
    fn heights(&self, at: &str, file: &ImageReliefFile) -> Result<Heights, SceneError> {
        for (k, &repeat) in file.repeat.iter().enumerate() {
            self.within(&format!("{at}.repeat[{k}]"), repeat, 1e-6, 1e6)?;
        }
        let at = format!("{at}.file");
        let (picture, _reserved) = self.picture(&at, &self.folder.join(&file.file))?;
        let picture = picture.into_luma16();
        let values = picture.pixels().map(|pixel| f64::from(pixel.0[0]) / f64::from(u16::MAX));
        let width = picture.width() as usize;
        match Heights::new(values.collect(), width, file.repeat.into(), file.mirror) {
            Some(heights) => Ok(heights),
            None => self.fault(&at, "found a picture without pixels"),
        }
    }
}
