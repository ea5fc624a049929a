//! The objects of a scene file: shapes, meshes, and what their surfaces look like.

use super::{MeshSource, Reader, SceneError, meshes};
use crate::scene::file::{MeshFile, ObjectFile};
use crate::scene::{Object, Surface, SurfaceTexture, obj};
use crate::shape::{Mesh, Quad, Shape, Sphere};
use files::json::nearest;
use glam::{DAffine3, DVec2, DVec3};
use std::collections::BTreeMap;

impl Reader<'_> {
    /// Checks the shapes that need no other file, before any is read.
    pub(super) fn objects_without_meshes(&self) -> Result<(), SceneError> {
        for (place, object) in self.file.objects.iter().enumerate() {
            match object {
                ObjectFile::Mesh(mesh) => {
                    self.mesh_bindings(place, mesh)?;
                }
                _ => {
                    self.object(place, object)?;
                }
            }
        }
        Ok(())
    }

    pub(super) fn objects(&self, mut given: MeshSource) -> Result<Vec<Object>, SceneError> {
        let mut objects = Vec::with_capacity(self.file.objects.len());
        for (place, object) in self.file.objects.iter().enumerate() {
            objects.push(match object {
                ObjectFile::Mesh(mesh) => {
                    // A name may stand for several objects; the last one takes the mesh itself.
                    let again = meshes(self.file).any(|(k, m)| k > place && m.name == mesh.name);
                    let found = if again {
                        given.get(&mesh.name).cloned()
                    } else {
                        given.remove(&mesh.name)
                    };
                    self.mesh(place, mesh, found)?
                }
                _ => self.object(place, object)?,
            });
        }
        Ok(objects)
    }

    /// Any object but a mesh.
    fn object(&self, place: usize, object: &ObjectFile) -> Result<Object, SceneError> {
        let (kind, shape, material, texture) = match object {
            ObjectFile::Sphere(sphere) => {
                let radius = format!("objects[{place}].sphere.radius");
                let radius = self.above_zero(&radius, sphere.radius)?;
                let shape = Shape::Sphere(Sphere { center: sphere.center.into(), radius });
                ("sphere", shape, &sphere.material, &sphere.texture)
            }
            ObjectFile::Rectangle(quad) => {
                let at = format!("objects[{place}].rectangle");
                for (k, &repeat) in quad.repeat.iter().enumerate() {
                    self.above_zero(&format!("{at}.repeat[{k}]"), repeat)?;
                }
                let corners = [quad.corner, quad.edge_u, quad.edge_v];
                let shape = self.quad(&at, corners, quad.repeat, true)?;
                ("rectangle", shape, &quad.material, &quad.texture)
            }
            ObjectFile::Plane(plane) => {
                let at = format!("objects[{place}].plane");
                let corners = [plane.point, plane.edge_u, plane.edge_v];
                let shape = self.quad(&at, corners, [1.0; 2], false)?;
                ("plane", shape, &plane.material, &plane.texture)
            }
            ObjectFile::Mesh(_) => return self.fault(&format!("objects[{place}]"), "found a mesh"),
        };
        let at = format!("objects[{place}].{kind}");
        let material = self.material_index(&format!("{at}.material"), material)?;
        let texture = match texture {
            Some(name) => Some(self.texture_index(&format!("{at}.texture"), name)?),
            None => None,
        };
        let parts = vec![Surface { material, texture }];
        Ok(Object { shape, parts, to_own_space: DAffine3::IDENTITY })
    }

    fn quad(
        &self,
        path: &str,
        corners: [[f64; 3]; 3],
        repeat: [f64; 2],
        bounded: bool,
    ) -> Result<Shape, SceneError> {
        let [corner, edge_u, edge_v] = corners.map(DVec3::from);
        match Quad::new(corner, edge_u, edge_v, DVec2::from(repeat), bounded) {
            Some(quad) => Ok(Shape::Quad(quad)),
            None => self.fault(
                &format!("{path}.edge_v"),
                "found edges that are parallel or without length, expected two directions",
            ),
        }
    }

    fn mesh(
        &self,
        place: usize,
        file: &MeshFile,
        given: Option<Mesh>,
    ) -> Result<Object, SceneError> {
        let at = format!("objects[{place}].mesh");
        let mesh = match (given, &file.file) {
            (Some(mesh), _) => {
                let named = |source| SceneError::Mesh { name: file.name.clone(), source };
                mesh.check().map_err(named)?;
                mesh
            }
            (None, Some(path)) => {
                let path = self.folder.join(path);
                let bytes = self.named_file(&format!("{at}.file"), &path)?;
                obj::read(&path.display().to_string(), &bytes)?
            }
            (None, None) => {
                return Err(SceneError::MissingMesh {
                    name: file.name.clone(),
                    path: at,
                    scene: self.document.file.into(),
                });
            }
        };
        let bindings = self.mesh_bindings(place, file)?;
        let parts: Result<_, _> =
            mesh.surfaces.iter().map(|name| self.bind(&at, file, &bindings, name)).collect();
        let shape = Shape::Mesh(mesh);
        Ok(Object { shape, parts: parts?, to_own_space: DAffine3::IDENTITY })
    }

    /// Finds the materials and textures that a mesh names.
    fn mesh_bindings(&self, place: usize, file: &MeshFile) -> Result<Bindings, SceneError> {
        let at = format!("objects[{place}].mesh");
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

    /// What a surface named `surface` by `usemtl` looks like.
    fn bind(
        &self,
        at: &str,
        file: &MeshFile,
        bindings: &Bindings,
        surface: &str,
    ) -> Result<Surface, SceneError> {
        let ids = obj::ids(surface);
        let [texture_key, material_key] = ids.unwrap_or([surface, surface]);
        let material = bindings.materials.get(material_key).copied().or(bindings.material);
        let Some(material) = material else {
            let message = format!(
                "found surface {material_key:?} in mesh {}, expected \"material\", or an entry for \
                 it in \"materials\"",
                file.name
            );
            return self.fault(at, message);
        };
        let texture = bindings.textures.get(texture_key).copied().or(bindings.texture);
        // Texture id 0 says that there is none; any other id was meant to be seen.
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
        self.index_of(path, "material", name, &self.file.materials)
    }

    fn texture_index(&self, path: &str, name: &str) -> Result<SurfaceTexture, SceneError> {
        let index = self.index_of(path, "texture", name, &self.file.textures)?;
        // Pictures and solids are counted apart.
        let textures = || self.file.textures.values();
        let pictures = textures().take(index).filter(|texture| texture.image.is_some()).count();
        Ok(match textures().nth(index) {
            Some(texture) if texture.image.is_none() => SurfaceTexture::Solid(index - pictures),
            _ => SurfaceTexture::Picture(pictures),
        })
    }

    fn index_of<T>(
        &self,
        path: &str,
        kind: &str,
        name: &str,
        known: &BTreeMap<String, T>,
    ) -> Result<usize, SceneError> {
        if let Some(index) = known.keys().position(|key| key == name) {
            return Ok(index);
        }
        let near = nearest(name, known.keys().map(String::as_str));
        let suggestion = near.map_or(String::new(), |near| format!(" (did you mean {near:?}?)"));
        let names: Vec<&str> = known.keys().map(String::as_str).collect();
        let names = if names.is_empty() { "none".into() } else { names.join(", ") };
        self.fault(
            path,
            format!("found unknown {kind} {name:?}, expected one of: {names}{suggestion}"),
        )
    }
}

/// The materials and textures of a mesh, by surface and texture id.
#[derive(Debug, Default)]
struct Bindings {
    material: Option<usize>,
    texture: Option<SurfaceTexture>,
    materials: BTreeMap<String, usize>,
    textures: BTreeMap<String, SurfaceTexture>,
}
