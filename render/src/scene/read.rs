//! From a scene file to a [`Scene`]: names become indices, pictures and meshes are read, and every
//! number is checked against its range.

mod lights;
mod materials;
mod objects;
mod textures;

use super::file::{ColorFile, MeshFile, ObjectFile, SceneFile};
use super::obj::ObjError;
use super::{Camera, Scene};
use crate::color::Color;
use crate::shape::Mesh;
use crate::shape::mesh::MeshError;
use crate::texture::USUAL_MEMORY;
use files::json::{Document, nearest};
use files::{Exit, Failure, FileError, JsonError, Source};
use std::collections::BTreeMap;
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
    /// A texture takes more memory than is allowed.
    #[error(transparent)]
    TooLarge(JsonError),
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
            Self::TooLarge(_) => Exit::Resource,
            Self::UnknownMesh { .. } | Self::MissingMesh { .. } => Exit::Use,
            _ => Exit::Malformed,
        }
    }
}

/// Meshes given by name from outside the scene file.
pub type MeshSource = BTreeMap<String, Mesh>;

/// Reads a scene file's text and checks what can be checked without other files.
///
/// # Errors
/// On JSON that is not a scene of this version.
pub fn parse(document: &Document<'_>) -> Result<SceneFile, SceneError> {
    document.expect("tb-scene", 1)?;
    Ok(document.parse()?)
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
    resolve_within(document, file, folder, source, given, USUAL_MEMORY)
}

/// The same with this much memory for textures, in bytes, in place of [`USUAL_MEMORY`]. Pictures
/// are measured before they are decoded.
///
/// # Errors
/// As above.
pub fn resolve_within(
    document: &Document<'_>,
    file: &SceneFile,
    folder: &Path,
    source: &dyn Source,
    given: MeshSource,
    max_texture_bytes: u64,
) -> Result<Scene, SceneError> {
    check_mesh_names(file, given.keys().map(String::as_str))?;
    let reader = Reader { document, file, folder, source, max_texture_bytes };
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
    max_texture_bytes: u64,
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
}
