//! Reads the lights of a scene file.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::scene::file::{DirectionalLightFile, FalloffFile, LightFile, PointLightFile};
use crate::scene::limits::LARGEST;
use crate::scene::{DirectionalLight, Falloff, Light, PointLight};

impl Reader<'_> {
    pub(super) fn lights(&self) -> Result<Vec<Light>, SceneError> {
        let lights = self.file.lights.iter().enumerate().map(|(k, light)| match light {
            LightFile::Point(light) => self.point_light(&format!("lights[{k}].point"), light),
            LightFile::Directional(light) => {
                self.directional_light(&format!("lights[{k}].directional"), light)
            }
        });
        lights.collect()
    }

    fn point_light(&self, at: &str, light: &PointLightFile) -> Result<Light, SceneError> {
        let color = self.color(&format!("{at}.color"), light.color)?;
        let falloff = match &light.falloff {
            Some(falloff) => Some(self.falloff(&format!("{at}.falloff"), falloff)?),
            None => None,
        };
        let position = self.vector(&format!("{at}.position"), light.position)?;
        Ok(Light::Point(PointLight { position, color, falloff }))
    }

    fn directional_light(
        &self,
        at: &str,
        light: &DirectionalLightFile,
    ) -> Result<Light, SceneError> {
        let color = self.color(&format!("{at}.color"), light.color)?;
        let direction = self.vector(&format!("{at}.direction"), light.direction)?;
        // Divided first, so that no length is too large or too small to be squared.
        match (direction / direction.abs().max_element()).try_normalize() {
            Some(along) => Ok(Light::Directional(DirectionalLight { toward: -along, color })),
            None => self.fault(
                &format!("{at}.direction"),
                "found a direction without length, expected the direction in which the light travels",
            ),
        }
    }

    fn falloff(&self, at: &str, file: &FalloffFile) -> Result<Falloff, SceneError> {
        let part = |key: &str, value: f64| self.within(&format!("{at}.{key}"), value, 0.0, LARGEST);
        let falloff = Falloff {
            constant: part("constant", file.constant)?,
            linear: part("linear", file.linear)?,
            quadratic: part("quadratic", file.quadratic)?,
            reference: self.above_zero(&format!("{at}.reference"), file.reference)?,
        };
        if falloff.constant == 0.0 && falloff.linear == 0.0 && falloff.quadratic == 0.0 {
            let message = "found a falloff without terms, expected \"constant\", \"linear\" or \
                           \"quadratic\" above 0";
            return self.fault(at, message);
        }
        Ok(falloff)
    }
}
