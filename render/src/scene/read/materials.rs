//! The materials of a scene file.

use super::{Reader, SceneError};
use crate::scene::Material;
use crate::scene::file::MaterialFile;

impl Reader<'_> {
    /// The materials; those with a bump take its number from `bumps`.
    pub(super) fn materials(
        &self,
        bumps: &mut impl Iterator<Item = usize>,
    ) -> Result<Vec<Material>, SceneError> {
        let materials = self.file.materials.iter().map(|(name, file)| {
            let bump = file.bump.as_ref().and_then(|_| bumps.next());
            Ok(Material { bump, ..self.material(name, file)? })
        });
        materials.collect()
    }

    fn material(&self, name: &str, material: &MaterialFile) -> Result<Material, SceneError> {
        let at = |key: &str| format!("materials.{name}.{key}");
        let share = |key: &str, value: f64| self.within(&at(key), value, 0.0, 1.0);
        Ok(Material {
            color: self.color(&at("color"), material.color)?,
            ambient: share("ambient", material.ambient)?,
            diffuse: share("diffuse", material.diffuse)?,
            specular: share("specular", material.specular)?,
            shininess: self.within(&at("shininess"), material.shininess, 1.0, 1e6)?,
            reflectivity: share("reflectivity", material.reflectivity)?,
            transparency: share("transparency", material.transparency)?,
            index_of_refraction: self.within(
                &at("index_of_refraction"),
                material.index_of_refraction,
                0.1,
                10.0,
            )?,
            fresnel: material.fresnel,
            bump: None,
        })
    }
}
