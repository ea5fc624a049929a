//! Reads the objects of a scene file: shapes, meshes, and the appearance of their surfaces.

use super::libraries::Libraries;
use super::meshes::PlannedMesh;
use super::ranges::Ranges;
use super::stored::Stored;
use super::{Reader, SceneError};
use crate::scene::file::ObjectFile;
use crate::scene::{Object, Scene, Surface, SurfaceTexture};
use crate::shape::{Placement, Quad, Shape, Sphere};
use files::json::nearest;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// An object that is checked as far as this needs no other file.
#[derive(Debug)]
pub(super) enum Planned<'a> {
    /// An object that is not a mesh.
    Whole(Object),
    /// A mesh whose triangles are not read yet.
    Mesh(PlannedMesh<'a>),
}

impl<'a> Reader<'a> {
    /// Reads the objects as far as they need no other file.
    pub(super) fn planned_objects(&self) -> Result<Vec<Planned<'a>>, SceneError> {
        let objects: &'a [ObjectFile] = self.file.objects;
        let objects = objects.iter().enumerate().map(|(number, object)| {
            let at = format!("objects[{number}].{}", object.kind());
            self.planned(at, object)
        });
        objects.collect()
    }

    /// Reads the meshes, completes the objects, and adds them to the scene.
    pub(super) fn objects(
        &self,
        planned: Vec<Planned<'a>>,
        stored: &mut Stored,
        libraries: &mut Libraries,
        scene: &mut Scene,
    ) -> Result<(), SceneError> {
        for object in planned {
            match object {
                Planned::Whole(object) => scene.objects.push(object),
                Planned::Mesh(mesh) => self.mesh(mesh, stored, libraries, scene)?,
            }
        }
        Ok(())
    }

    /// Reads the object at the JSON path `at`, as far as it needs no other file.
    fn planned(&self, at: String, object: &'a ObjectFile) -> Result<Planned<'a>, SceneError> {
        let (shape, material, texture, steps) = match object {
            ObjectFile::Sphere(sphere) => {
                let center = self.vector(&format!("{at}.center"), sphere.center)?;
                let radius = self.above_zero(&format!("{at}.radius"), sphere.radius)?;
                let shape = Shape::Sphere(Sphere { center, radius });
                (shape, &sphere.material, &sphere.texture, &sphere.place)
            }
            ObjectFile::Rectangle(quad) => {
                for (k, &repeat) in quad.repeat.iter().enumerate() {
                    self.above_zero(&format!("{at}.repeat[{k}]"), repeat)?;
                }
                let corner = self.vector(&format!("{at}.corner"), quad.corner)?;
                let corners = [corner, quad.edge_u.into(), quad.edge_v.into()];
                let shape = self.quad(&at, corners, quad.repeat, true)?;
                (shape, &quad.material, &quad.texture, &quad.place)
            }
            ObjectFile::Plane(plane) => {
                let point = self.vector(&format!("{at}.point"), plane.point)?;
                let corners = [point, plane.edge_u.into(), plane.edge_v.into()];
                let shape = self.quad(&at, corners, [1.0; 2], false)?;
                (shape, &plane.material, &plane.texture, &plane.place)
            }
            ObjectFile::Box(file) => {
                (self.cuboid(&at, file)?, &file.material, &file.texture, &file.place)
            }
            ObjectFile::Superquadric(file) => {
                (self.superquadric(&at, file)?, &file.material, &file.texture, &file.place)
            }
            ObjectFile::Mesh(file) => {
                if let Some(angle) = file.smooth_deg {
                    self.within(&format!("{at}.smooth_deg"), angle, 0.0, 180.0)?;
                }
                let bindings = self.mesh_bindings(&at, file)?;
                let placement = self.placement(&at, &file.place)?;
                let instances = match &file.instances {
                    Some(instances) => Some(self.instances(&at, &placement, instances)?),
                    None => None,
                };
                return Ok(Planned::Mesh(PlannedMesh { file, at, bindings, placement, instances }));
            }
        };
        let material = self.material_index(&format!("{at}.material"), material)?;
        let texture = match texture {
            Some(name) => Some(self.texture_index(&format!("{at}.texture"), name)?),
            None => None,
        };
        let parts = vec![Surface { material, texture }; shape.parts()];
        let placement = self.placement(&at, steps)?;
        self.placed(&at, shape, parts, &placement).map(Planned::Whole)
    }

    /// Returns the object after its placement.
    pub(super) fn placed(
        &self,
        path: &str,
        shape: Shape,
        parts: Vec<Surface>,
        placement: &Placement,
    ) -> Result<Object, SceneError> {
        match shape.placed(placement) {
            Ok(shape) => Ok(Object { shape, parts, to_own_space: placement.to_own() }),
            Err(error) => self.fault(&format!("{path}.place"), error.to_string()),
        }
    }

    fn quad(
        &self,
        path: &str,
        [corner, edge_u, edge_v]: [DVec3; 3],
        repeat: [f64; 2],
        bounded: bool,
    ) -> Result<Shape, SceneError> {
        for (key, edge) in [("edge_u", edge_u), ("edge_v", edge_v)] {
            self.vector(&format!("{path}.{key}"), edge.into())?;
        }
        match Quad::new(corner, edge_u, edge_v, DVec2::from(repeat), bounded) {
            Some(quad) => Ok(Shape::Quad(quad)),
            None => self.fault(
                &format!("{path}.edge_v"),
                "found edges that are parallel or without length, expected two directions",
            ),
        }
    }

    pub(super) fn material_index(&self, path: &str, name: &str) -> Result<usize, SceneError> {
        self.index_of(path, "material", name, &self.indices.materials)
    }

    pub(super) fn texture_index(
        &self,
        path: &str,
        name: &str,
    ) -> Result<SurfaceTexture, SceneError> {
        self.index_of(path, "texture", name, &self.indices.textures)
    }

    fn index_of<T: Copy>(
        &self,
        path: &str,
        kind: &str,
        name: &str,
        known: &BTreeMap<&str, T>,
    ) -> Result<T, SceneError> {
        if let Some(&index) = known.get(name) {
            return Ok(index);
        }
        let near = nearest(name, known.keys().copied());
        let suggestion = near.map_or(String::new(), |near| format!(" (did you mean {near:?}?)"));
        let names: Vec<&str> = known.keys().copied().collect();
        let names = if names.is_empty() { "none".into() } else { names.join(", ") };
        self.fault(
            path,
            format!("found unknown {kind} {name:?}, expected one of: {names}{suggestion}"),
        )
    }
}
