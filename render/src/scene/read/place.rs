//! Reads the places of objects, of instances and of textures.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::procedural;
use crate::scene::Object;
use crate::shape::Placement;
use files::Place;
use files::place::Map;
use glam::{DAffine3, DVec3};

impl Reader<'_> {
    /// Returns the placement of the object at the JSON path `path`; the identity without a step.
    pub(super) fn placement(&self, path: &str, place: &Place) -> Result<Placement, SceneError> {
        let path = format!("{path}.place");
        let map = self.map(&path, place)?;
        self.valid(&path, map.there)
    }

    /// Returns the placement of each instance of the mesh at the JSON path `path`, which is placed by
    /// `place` first.
    pub(super) fn instances(
        &self,
        path: &str,
        place: &Placement,
        instances: &[Place],
    ) -> Result<Vec<Placement>, SceneError> {
        if instances.is_empty() {
            let message =
                "found no placement, expected at least one: leave the key out for one object";
            return self.fault(&format!("{path}.instances"), message);
        }
        let bytes = instances.len() as u64 * size_of::<Object>() as u64;
        self.memory.keep(bytes, || format!("instances of {path}"))?;
        let placed = instances.iter().enumerate().map(|(k, instance)| {
            let path = format!("{path}.instances[{k}]");
            let map = self.map(&path, instance)?;
            self.valid(&path, map.there * place.to_scene())
        });
        placed.collect()
    }

    /// Returns the map from the space of a texture, whose place stands at the JSON path `path`, to the object's own
    /// space.
    pub(super) fn texture_place(
        &self,
        path: &str,
        place: Option<&Place>,
    ) -> Result<procedural::Placement, SceneError> {
        let Some(place) = place else {
            return Ok(procedural::Placement::default());
        };
        let map = self.map(path, place)?;
        self.valid(path, map.there)?;
        let linear = map.there.matrix3;
        for unit in [linear.x_axis, linear.y_axis, linear.z_axis].map(DVec3::length) {
            if !(1e-6..=1e6).contains(&unit) {
                let message =
                    format!("found a unit of the texture {unit} long, expected 1e-6 to 1e6");
                return self.fault(path, message);
            }
        }
        Ok(procedural::Placement::new(map.back))
    }

    fn map(&self, path: &str, place: &Place) -> Result<Map, SceneError> {
        match place.map() {
            Ok(map) => Ok(map),
            Err(fault) => self.fault(&format!("{path}{}", fault.path), fault.message),
        }
    }

    fn valid(&self, path: &str, whole: DAffine3) -> Result<Placement, SceneError> {
        match Placement::new(whole) {
            Ok(placement) => Ok(placement),
            Err(error) => self.fault(path, error.to_string()),
        }
    }
}
