//! From a scene file to a [`Scene`]: names become indices, pictures and meshes are read, and every
//! number is checked against its range.

use super::file::{
    ColorFile, LightFile, MaterialFile, MeshFile, ObjectFile, SceneFile, TextureFile, ValuesFile,
    WrapFile,
};
use super::obj::{self, ObjError};
use super::{Camera, Material, Object, PointLight, Scene, Surface};
use crate::color::Color;
use crate::filter::texture::{Texture, Values, Wrap};
use crate::shape::mesh::MeshError;
use crate::shape::{Mesh, Quad, Shape, Sphere};
use files::json::{Document, nearest};
use files::{Exit, Failure, FileError, JsonError, Source};
use glam::{DVec2, DVec3};
use image::ImageReader;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use thiserror::Error;

/// Deeper recursion is refused: it would show nothing more and could exhaust the stack.
const DEEPEST: u32 = 64;

/// Why there is no scene.
#[derive(Debug, Error)]
pub enum SceneError {
    /// The scene file is wrong.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file that the scene names cannot be read.
    #[error(transparent)]
    Named(JsonError),
    /// A mesh file is wrong.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// Arrays given as a mesh are wrong.
    #[error("mesh {name}: {source}")]
    Mesh {
        /// The mesh's name in the scene.
        name: String,
        /// What is wrong with it.
        source: MeshError,
    },
    /// A mesh was given for a name that the scene does not have.
    #[error("--mesh {name}: the scene has no mesh of that name; it has {known}")]
    UnknownMesh {
        /// The name given.
        name: String,
        /// The names there are, with a suggestion.
        known: String,
    },
    /// The scene has a mesh without a file, and none was given.
    #[error(
        "the scene's mesh {name} was not given: add --mesh {name}=FILE, or a \"file\" to {path} in {scene}"
    )]
    MissingMesh {
        /// The mesh's name.
        name: String,
        /// Its place in the scene file.
        path: String,
        /// The scene file.
        scene: String,
    },
}

impl Failure for SceneError {
    fn exit(&self) -> Exit {
        match self {
            Self::File(error) => error.exit(),
            Self::Named(_) => Exit::ReadWrite,
            Self::UnknownMesh { .. } | Self::MissingMesh { .. } => Exit::Use,
            _ => Exit::Malformed,
        }
    }
}

/// Meshes given by name from outside the scene file.
pub type MeshSource = BTreeMap<String, Mesh>;

/// What is looked at of any JSON file, whatever else is in it.
#[derive(Debug, Deserialize)]
struct FormatOnly {
    format: Option<String>,
}

/// Reads a scene file's text and checks what can be checked without other files.
///
/// # Errors
/// On JSON that is not a scene of this version.
pub fn parse(document: &Document<'_>) -> Result<SceneFile, SceneError> {
    // First, since the keys of another format would be taken for misspelt ones of a scene.
    if let Ok(FormatOnly { format: Some(format) }) = document.parse()
        && format != "tb-scene"
    {
        let message = format!("found format {format:?}, expected \"tb-scene\"");
        return Err(document.fault("format", message).into());
    }
    let file: SceneFile = document.parse()?;
    if file.version != 1 {
        let message = format!("found version {}, expected 1", file.version);
        return Err(document.fault("version", message).into());
    }
    Ok(file)
}

/// Checks that each of `given` names a mesh of the scene.
///
/// # Errors
/// With the names there are.
pub fn check_mesh_names<'n>(
    file: &SceneFile,
    given: impl IntoIterator<Item = &'n str>,
) -> Result<(), SceneError> {
    let names: Vec<&str> = meshes(file).map(|(_, mesh)| mesh.name.as_str()).collect();
    for name in given {
        if !names.contains(&name) {
            let mut known = if names.is_empty() { "none".into() } else { names.join(", ") };
            if let Some(near) = nearest(name, names.iter().copied()) {
                known.push_str(&format!(" (did you mean {near}?)"));
            }
            return Err(SceneError::UnknownMesh { name: name.into(), known });
        }
    }
    Ok(())
}

fn meshes(file: &SceneFile) -> impl Iterator<Item = (usize, &MeshFile)> {
    file.objects.iter().enumerate().filter_map(|(place, object)| match object {
        ObjectFile::Mesh(mesh) => Some((place, mesh)),
        _ => None,
    })
}

/// Makes the scene. Paths count from `folder` and are read from `source`; a mesh in `given` is
/// taken before its own file.
///
/// # Errors
/// On the first thing that is wrong, with its place.
pub fn resolve(
    document: &Document<'_>,
    file: &SceneFile,
    folder: &Path,
    source: &dyn Source,
    given: MeshSource,
) -> Result<Scene, SceneError> {
    check_mesh_names(file, given.keys().map(String::as_str))?;
    let reader = Reader { document, file, folder, source };
    let camera = reader.camera()?;
    let background = reader.color("background", file.background)?;
    let ambient = reader.color("ambient", file.ambient)?;
    let lights = reader.lights()?;
    let materials = reader.materials()?;
    reader.within("max_depth", f64::from(file.max_depth), 0.0, f64::from(DEEPEST))?;
    reader.within("min_weight", file.min_weight, 0.0, 1.0)?;
    reader.objects_without_meshes()?;
    let textures = reader.textures()?;
    let objects = reader.objects(given)?;
    Ok(Scene {
        camera,
        background,
        ambient,
        lights,
        materials,
        textures,
        objects,
        max_depth: file.max_depth,
        min_weight: file.min_weight,
    })
}

struct Reader<'a> {
    document: &'a Document<'a>,
    file: &'a SceneFile,
    folder: &'a Path,
    source: &'a dyn Source,
}

impl Reader<'_> {
    fn fault<T>(&self, path: &str, message: impl Into<String>) -> Result<T, SceneError> {
        Err(self.document.fault(path, message).into())
    }

    /// The file that the scene names at `place`.
    fn named_file(&self, place: &str, path: &Path) -> Result<Vec<u8>, SceneError> {
        let named =
            |error: FileError| SceneError::Named(self.document.fault(place, error.to_string()));
        self.source.read(path).map_err(named)
    }

    /// The value, if it lies in the closed range.
    fn within(&self, path: &str, value: f64, low: f64, high: f64) -> Result<f64, SceneError> {
        if (low..=high).contains(&value) {
            return Ok(value);
        }
        let range =
            if high == f64::MAX { format!("at least {low}") } else { format!("{low} to {high}") };
        self.fault(path, format!("found {value}, expected {range}"))
    }

    fn above_zero(&self, path: &str, value: f64) -> Result<f64, SceneError> {
        if value > 0.0 {
            return Ok(value);
        }
        self.fault(path, format!("found {value}, expected more than 0"))
    }

    fn color(&self, path: &str, color: ColorFile) -> Result<Color, SceneError> {
        for channel in color.0 {
            self.within(path, channel, 0.0, f64::MAX)?;
        }
        Ok(Color::from(color.0))
    }

    fn camera(&self) -> Result<Camera, SceneError> {
        let camera = &self.file.camera;
        if !(camera.fov_deg > 0.0 && camera.fov_deg < 180.0) {
            let message = format!("found {}, expected an angle between 0 and 180", camera.fov_deg);
            return self.fault("camera.fov_deg", message);
        }
        let angle = camera.fov_deg.to_radians();
        match Camera::new(camera.eye.into(), camera.target.into(), camera.up.into(), angle) {
            Some(camera) => Ok(camera),
            None => self.fault(
                "camera",
                "found an eye at its target, or an up along the view; expected three directions apart",
            ),
        }
    }

    fn lights(&self) -> Result<Vec<PointLight>, SceneError> {
        let lights = self.file.lights.iter().enumerate().map(|(k, light)| {
            let LightFile::Point(light) = light;
            let color = self.color(&format!("lights[{k}].point.color"), light.color)?;
            Ok(PointLight { position: light.position.into(), color })
        });
        lights.collect()
    }

    fn materials(&self) -> Result<Vec<Material>, SceneError> {
        self.file.materials.iter().map(|(name, material)| self.material(name, material)).collect()
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
        })
    }

    fn textures(&self) -> Result<Vec<Texture>, SceneError> {
        self.file.textures.iter().map(|(name, texture)| self.texture(name, texture)).collect()
    }

    fn texture(&self, name: &str, texture: &TextureFile) -> Result<Texture, SceneError> {
        let place = format!("textures.{name}.image");
        let path = self.folder.join(&texture.image);
        let bytes = self.named_file(&place, &path)?;
        let decoded = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(image::ImageError::IoError)
            .and_then(ImageReader::decode);
        let picture = match decoded {
            Ok(picture) => picture,
            Err(error) => {
                let message = format!(
                    "found no picture in {} ({error}), expected a PNG or JPEG file",
                    path.display()
                );
                return self.fault(&place, message);
            }
        };
        let wrap = match texture.wrap {
            WrapFile::Repeat => Wrap::Repeat,
            WrapFile::Clamp => Wrap::Clamp,
        };
        let values = match texture.values {
            ValuesFile::Srgb => Values::Srgb,
            ValuesFile::Linear => Values::Linear,
        };
        match Texture::from_picture(&picture, values, wrap) {
            Some(texture) => Ok(texture),
            None => self.fault(
                &place,
                format!("found floating point values in {}, expected 8 or 16 bits", path.display()),
            ),
        }
    }

    /// Checks the shapes that need no other file, before any is read.
    fn objects_without_meshes(&self) -> Result<(), SceneError> {
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

    fn objects(&self, mut given: MeshSource) -> Result<Vec<Object>, SceneError> {
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
        Ok(Object { shape, parts: vec![Surface { material, texture }] })
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
        Ok(Object { parts: parts?, shape: Shape::Mesh(mesh) })
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

    fn texture_index(&self, path: &str, name: &str) -> Result<usize, SceneError> {
        self.index_of(path, "texture", name, &self.file.textures)
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
    texture: Option<usize>,
    materials: BTreeMap<String, usize>,
    textures: BTreeMap<String, usize>,
}
