//! Reads the lights of a scene file.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::scene::file::{
    DirectionalLightFile, FalloffFile, LightFile, PointLightFile, SpotLightFile,
};
use crate::scene::limits::LARGEST;
use crate::scene::{DirectionalLight, Falloff, Light, PointLight, SpotLight};
use glam::DVec3;

impl Reader<'_> {
    pub(super) fn lights(&self) -> Result<Vec<Light>, SceneError> {
        let lights = self.file.lights.iter().enumerate().map(|(k, light)| match light {
            LightFile::Point(light) => self.point_light(&format!("lights[{k}].point"), light),
            LightFile::Spot(light) => self.spot_light(&format!("lights[{k}].spot"), light),
            LightFile::Directional(light) => {
                self.directional_light(&format!("lights[{k}].directional"), light)
            }
        });
        lights.collect()
    }

    fn spot_light(&self, at: &str, light: &SpotLightFile) -> Result<Light, SceneError> {
        let SpotLightFile { position, color, ref falloff, outer_deg, .. } = *light;
        let falloff = falloff.clone();
        let point = self.point(at, &PointLightFile { position, color, falloff })?;
        let axis = self.direction(&format!("{at}.direction"), light.direction)?;
        if outer_deg == 0.0 {
            return self.fault(&format!("{at}.outer_deg"), "found 0, expected an angle above it");
        }
        self.within(&format!("{at}.outer_deg"), outer_deg, 0.0, 180.0)?;
        let inner_deg = light.inner_deg.unwrap_or(0.8 * outer_deg);
        self.within(&format!("{at}.inner_deg"), inner_deg, 0.0, outer_deg)?;
        let [inner, outer] = [inner_deg, outer_deg].map(|angle| angle.to_radians().cos());
        Ok(Light::Spot(SpotLight { point, axis, inner, outer }))
    }

    fn point_light(&self, at: &str, light: &PointLightFile) -> Result<Light, SceneError> {
        self.point(at, light).map(Light::Point)
    }

    fn point(&self, at: &str, light: &PointLightFile) -> Result<PointLight, SceneError> {
        let color = self.color(&format!("{at}.color"), light.color)?;
        let falloff = match &light.falloff {
            Some(falloff) => Some(self.falloff(&format!("{at}.falloff"), falloff)?),
            None => None,
        };
        let position = self.vector(&format!("{at}.position"), light.position)?;
        Ok(PointLight { position, color, falloff })
    }

    fn directional_light(
        &self,
        at: &str,
        light: &DirectionalLightFile,
    ) -> Result<Light, SceneError> {
        let color = self.color(&format!("{at}.color"), light.color)?;
        let along = self.direction(&format!("{at}.direction"), light.direction)?;
        Ok(Light::Directional(DirectionalLight { toward: -along, color }))
    }

    /// Reads a direction as a unit vector.
    fn direction(&self, at: &str, direction: [f64; 3]) -> Result<DVec3, SceneError> {
        let direction = self.vector(at, direction)?;
        // Divided first, so that no length is too large or too small to be squared.
        match (direction / direction.abs().max_element()).try_normalize() {
            Some(along) => Ok(along),
            None => self.fault(
                at,
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
