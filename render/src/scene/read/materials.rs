//! Reads the materials of a scene file.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::color::Color;
use crate::optics::thin_film::ThinFilm;
use crate::scene::file::{MaterialFile, SurfaceColorFile, ThinFilmFile};
use crate::scene::{AngleRamp, Material, VertexColors};
use std::sync::Arc;

impl Reader<'_> {
    /// Reads the materials. A material with a bump takes its index from `bumps`.
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
        let (color, vertex_colors) = match material.color {
            None => (Color::ONE, VertexColors::Untextured),
            Some(SurfaceColorFile::Uniform(color)) => {
                (self.color(&at("color"), color)?, VertexColors::Never)
            }
            Some(SurfaceColorFile::Vertex) => (Color::ONE, VertexColors::Always),
        };
        Ok(Material {
            color,
            vertex_colors,
            emission: self.color(&at("emission"), material.emission)?,
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
            absorption: self.color(&at("absorption"), material.absorption)?,
            priority: material.priority,
            by_angle: self.by_angle(name, material)?.map(Arc::new),
        })
    }

    fn by_angle(&self, name: &str, file: &MaterialFile) -> Result<Option<AngleRamp>, SceneError> {
        let at = format!("materials.{name}.by_angle");
        match (&file.by_angle, &file.thin_film) {
            (None, None) => Ok(None),
            (None, Some(film)) => self.thin_film(name, film).map(Some),
            (Some(_), Some(_)) => {
                self.fault(&at, "found this key beside \"thin_film\", expected only one of the two")
            }
            (Some(file), None) => self.colors_by_angle(&at, file, 0.0).map(Some),
        }
    }

    fn thin_film(&self, name: &str, file: &ThinFilmFile) -> Result<AngleRamp, SceneError> {
        let at = |key: &str| format!("materials.{name}.thin_film.{key}");
        let film = ThinFilm {
            thickness_nm: self.within(&at("thickness_nm"), file.thickness_nm, 1.0, 5000.0)?,
            index: self.within(&at("index"), file.index, 1.0, 5.0)?,
            base_index: self.within(&at("base_index"), file.base_index, 1.0, 5.0)?,
        };
        Ok(AngleRamp::of_film(&film))
    }
}
