//! The bumps of a scene file's materials.

use super::{Reader, SceneError};
use crate::procedural::{Bump, Heights, Relief};
use crate::scene::file::bump::{BumpFile, ImageReliefFile};

impl Reader<'_> {
    /// The bumps of all materials, in their order.
    pub(super) fn bumps(&self) -> Result<Vec<Bump>, SceneError> {
        let bumps = self.file.materials.iter().filter_map(|(name, material)| {
            let bump = material.bump.as_ref()?;
            Some(self.bump(&format!("materials.{name}.bump"), bump))
        });
        bumps.collect()
    }

    fn bump(&self, at: &str, file: &BumpFile) -> Result<Bump, SceneError> {
        self.one_of(
            at,
            &[
                ("noise", file.noise.is_some()),
                ("turbulence", file.turbulence.is_some()),
                ("wall", file.wall.is_some()),
                ("dnoise", file.dnoise.is_some()),
                ("image", file.image.is_some()),
            ],
        )?;
        let strength = self.within(&format!("{at}.strength"), file.strength, -1e6, 1e6)?;
        let place = file.place.unwrap_or_default();
        let placement = self.texture_place(&format!("{at}.place"), &place)?;
        let relief = if let Some(noise) = &file.noise {
            let at = format!("{at}.noise");
            Relief::Noise(self.octaves(&at, noise.octaves, noise.interpolation)?)
        } else if let Some(noise) = &file.turbulence {
            let at = format!("{at}.turbulence");
            Relief::Turbulence(self.octaves(&at, noise.octaves, noise.interpolation)?)
        } else if let Some(wall) = &file.wall {
            if wall.colors.is_some() {
                let message = "found it on a bump, expected it only on textures";
                return self.fault(&format!("{at}.wall.colors"), message);
            }
            Relief::Wall(self.wall(&format!("{at}.wall"), wall)?)
        } else if let Some(image) = &file.image {
            if file.place.is_some() {
                let message = "found it on a picture, expected it only where a relief fills space";
                return self.fault(&format!("{at}.place"), message);
            }
            Relief::Picture(self.heights(&format!("{at}.image"), image)?)
        } else {
            let dnoise = file.dnoise.clone().unwrap_or_default();
            Relief::Dnoise(self.noise(dnoise.interpolation))
        };
        Ok(Bump { relief, strength, placement })
    }

    /// The grey of a picture, from 0 for black to 1 for white: its codes as they are, as the depth
    /// of a sweep reads them.
    fn heights(&self, at: &str, file: &ImageReliefFile) -> Result<Heights, SceneError> {
        for (k, &repeat) in file.repeat.iter().enumerate() {
            self.within(&format!("{at}.repeat[{k}]"), repeat, 1e-6, 1e6)?;
        }
        let place = format!("{at}.file");
        let (picture, _reserved) = self.picture(&place, &self.folder.join(&file.file))?;
        let picture = picture.into_luma16();
        let values = picture.pixels().map(|pixel| f64::from(pixel.0[0]) / f64::from(u16::MAX));
        let width = picture.width() as usize;
        match Heights::new(values.collect(), width, file.repeat.into(), file.mirror) {
            Some(heights) => Ok(heights),
            None => self.fault(&place, "found a picture without pixels"),
        }
    }
}
