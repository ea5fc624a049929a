//! The lights of a scene file.

use super::{Reader, SceneError};
use crate::scene::PointLight;
use crate::scene::file::LightFile;

impl Reader<'_> {
    pub(super) fn lights(&self) -> Result<Vec<PointLight>, SceneError> {
        let lights = self.file.lights.iter().enumerate().map(|(k, light)| {
            let LightFile::Point(light) = light;
            let color = self.color(&format!("lights[{k}].point.color"), light.color)?;
            Ok(PointLight { position: light.position.into(), color })
        });
        lights.collect()
    }
}
