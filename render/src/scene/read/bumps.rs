//! The bumps of a scene file's materials.

use super::{Reader, SceneError};
use crate::procedural::{Bump, Relief};
use crate::scene::file::bump::BumpFile;

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
            ],
        )?;
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
        } else {
            let dnoise = file.dnoise.clone().unwrap_or_default();
            Relief::Dnoise(self.noise(dnoise.interpolation))
        };
        Ok(Bump {
            relief,
            strength: self.within(&format!("{at}.strength"), file.strength, -1e6, 1e6)?,
            placement: self.placement(&format!("{at}.place"), &file.place)?,
        })
    }
}
