//! Reads the objects of a scene file: shapes, meshes, and the appearance of their surfaces.

use super::given::Given;
use super::libraries::Libraries;
use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::scene::file::{MeshFile, ObjectFile};
use crate::scene::{Object, Surface, SurfaceTexture, obj};
use crate::shape::mesh::{NONE, Triangle};
use crate::shape::{Mesh, Placement, Quad, Shape, Sphere};
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

/// A mesh whose triangles are not read yet.
#[derive(Debug)]
pub(super) struct PlannedMesh<'a> {
    file: &'a MeshFile,
    /// JSON path of the mesh.
    at: String,
    bindings: Bindings,
    placement: Placement,
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

    /// Reads the meshes and completes the objects.
    pub(super) fn objects(
        &self,
        planned: Vec<Planned<'a>>,
        given: &mut Given,
        libraries: &Libraries,
    ) -> Result<Vec<Object>, SceneError> {
        let objects = planned.into_iter().map(|object| match object {
            Planned::Whole(object) => Ok(object),
            Planned::Mesh(mesh) => {
                let given = given.take(&mesh.file.name);
                self.mesh(mesh, given, libraries)
            }
        });
        objects.collect()
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
                let bindings = self.mesh_bindings(&at, file)?;
                let placement = self.placement(&at, &file.place)?;
                return Ok(Planned::Mesh(PlannedMesh { file, at, bindings, placement }));
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
    fn placed(
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

    /// Reads the triangles of a mesh and binds its surfaces to materials and textures.
    fn mesh(
        &self,
        planned: PlannedMesh<'_>,
        given: Option<Mesh>,
        libraries: &Libraries,
    ) -> Result<Object, SceneError> {
        let PlannedMesh { file, at, bindings, placement } = planned;
        let mesh = match (given, &file.file) {
            (Some(mesh), _) => {
                let named = |source| SceneError::Mesh { name: file.name.clone(), source };
                mesh.check().map_err(named)?;
                mesh
            }
            (None, Some(path)) => {
                let path = self.folder.join(path);
                let bytes = self.named_file(&format!("{at}.file"), &path)?;
                let name = files::input::name_of(&path);
                self.memory.keep(obj::needed(&bytes), || format!("mesh {name}"))?;
                obj::read(&name, &bytes)?
            }
            (None, None) => {
                return Err(SceneError::MissingMesh {
                    name: file.name.clone(),
                    path: at,
                    scene: self.document.file.into(),
                });
            }
        };
        let library = file.mtl.as_ref().map(|path| self.folder.join(path));
        let mut parts = Vec::with_capacity(mesh.surfaces.len());
        for name in &mesh.surfaces {
            let own = library.as_ref().and_then(|path| libraries.surface(path, name));
            parts.push(self.bind(&at, file, &bindings, name, own)?);
        }
        self.check_texture_coordinates(&at, file, &mesh, &parts)?;
        self.placed(&at, Shape::Mesh(mesh), parts, &placement)
    }

    /// Refuses a mesh with a texture on triangles without texture coordinates.
    fn check_texture_coordinates(
        &self,
        at: &str,
        file: &MeshFile,
        mesh: &Mesh,
        parts: &[Surface],
    ) -> Result<(), SceneError> {
        let is_lost = |triangle: &&Triangle| {
            triangle.uv[0] == NONE && parts[triangle.surface as usize].picture().is_some()
        };
        match mesh.triangles.iter().filter(is_lost).count() {
            0 => Ok(()),
            count => {
                let message = format!(
                    "found {count} triangles without texture coordinates (vt) in mesh {} on surfaces \
                     with a texture, expected vt at each corner, or no texture",
                    file.name
                );
                self.fault(at, message)
            }
        }
    }

    /// Finds the materials and textures that a mesh names.
    fn mesh_bindings(&self, at: &str, file: &MeshFile) -> Result<Bindings, SceneError> {
        let mut bindings = Bindings::default();
        if let Some(name) = &file.material {
            bindings.material = Some(self.material_index(&format!("{at}.material"), name)?);
        }
        if let Some(name) = &file.texture {
            bindings.texture = Some(self.texture_index(&format!("{at}.texture"), name)?);
        }
        for (key, name) in &file.materials {
            let index = self.material_index(&format!("{at}.materials.{key}"), name)?;
            bindings.materials.insert(key.clone(), index);
        }
        for (key, name) in &file.textures {
            let index = self.texture_index(&format!("{at}.textures.{key}"), name)?;
            bindings.textures.insert(key.clone(), index);
        }
        Ok(bindings)
    }

    /// Returns the material and texture of the surface that `usemtl` names `surface`. `own` is the entry
    /// of the mesh's material library.
    fn bind(
        &self,
        at: &str,
        file: &MeshFile,
        bindings: &Bindings,
        surface: &str,
        own: Option<Surface>,
    ) -> Result<Surface, SceneError> {
        let ids = obj::ids(surface);
        let [texture_key, material_key] = ids.unwrap_or([surface, surface]);
        let material = bindings.materials.get(material_key).copied();
        let material = material.or(own.map(|own| own.material)).or(bindings.material);
        let Some(material) = material else {
            let message = format!(
                "found surface {material_key:?} in mesh {}, expected \"material\", or an entry for \
                 it in \"materials\" or the \"mtl\"",
                file.name
            );
            return self.fault(at, message);
        };
        let texture = bindings.textures.get(texture_key).copied();
        let texture = texture.or(own.and_then(|own| own.texture)).or(bindings.texture);
        // Texture id 0 means no texture; any other id was meant to be seen.
        if texture.is_none() && ids.is_some() && texture_key != "0" {
            let message = format!(
                "found texture id {texture_key} in mesh {}, expected an entry for it in \
                 \"textures\", or a \"texture\" for all",
                file.name
            );
            return self.fault(at, message);
        }
        Ok(Surface { material, texture })
    }

    fn material_index(&self, path: &str, name: &str) -> Result<usize, SceneError> {
        self.index_of(path, "material", name, &self.indices.materials)
    }

    fn texture_index(&self, path: &str, name: &str) -> Result<SurfaceTexture, SceneError> {
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

/// The materials and textures that a mesh binds, by surface id and by texture id.
#[derive(Debug, Default)]
struct Bindings {
    material: Option<usize>,
    texture: Option<SurfaceTexture>,
    materials: BTreeMap<String, usize>,
    textures: BTreeMap<String, SurfaceTexture>,
}
