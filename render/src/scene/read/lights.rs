//! The lights of a scene file.

use super::{Reader, SceneError};
use crate::scene::PointLight;
use crate::scene::file::LightFile;

impl Reader<'_> {
    pub(super) fn lights(&self) -> Result<Vec<PointLight>, SceneError> {
        let lights = self.file.lights.iter().enumerate().map(|(k, light)| {
            let LightFile::Point(light) = light;
            let at = format!("lights[{k}].point");
            let position = self.vector(&format!("{at}.position"), light.position)?;
            let color = self.color(&format!("{at}.color"), light.color)?;
            Ok(PointLight { position, color })
        });
        lights.collect()
    }
}
