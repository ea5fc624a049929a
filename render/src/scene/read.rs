//! Reads a scene file into a [`Scene`]: names become indices, pictures and meshes are read, and every
//! number is checked against its range.

mod background;
mod bumps;
mod camera;
mod draft;
mod libraries;
mod lights;
mod materials;
mod mesh_files;
mod meshes;
mod objects;
mod place;
mod ranges;
mod reliefs;
mod shapes;
mod solids;
mod stored;
mod textures;

pub use draft::{Draft, SceneText};

use super::file::{BackgroundFile, FORMAT, Lists, SceneFile, VERSION};
use super::limits::DEEPEST;
use super::mesh_file::MeshFileError;
use super::obj::{ObjError, ObjFile};
use super::{Camera, Names, Scene};
use crate::procedural::{NoiseLattice, Procedural};
use crate::shape::mesh::MeshError;
use draft::Indices;
use files::check::Finding;
use files::json::Document;
use files::words::{LONGEST_LIST, cut, shown};
use files::{Budget, Exit, Failure, FileError, JsonError, MemoryError, Source, memory};
use libraries::Libraries;
use ranges::Ranges;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use stored::Stored;
use textures::Memory;
use thiserror::Error;

/// The reason why a scene cannot be read.
#[derive(Debug, Error)]
pub enum SceneError {
    /// The scene file is not valid.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file that the scene names cannot be read, with the exit code of the reason.
    #[error("{0}")]
    Named(JsonError, Exit),
    /// A file that the scene names takes more memory than is allowed.
    #[error(transparent)]
    TooLarge(JsonError),
    /// The scene takes more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// A mesh file is not valid.
    #[error(transparent)]
    MeshFile(#[from] MeshFileError),
    /// A material library is not valid.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// Arrays given as a mesh are not valid.
    #[error("mesh {name}: {source}")]
    Mesh {
        /// Name of the mesh in the scene.
        name: String,
        /// The fault of the arrays.
        source: MeshError,
    },
    /// A mesh was given for a name that the scene does not have.
    #[error(
        "--mesh {}: the scene has no mesh of that name; it has {}",
        shown(name),
        cut(known, LONGEST_LIST)
    )]
    UnknownMesh {
        /// The name that was given.
        name: String,
        /// The names of the scene's meshes, with a suggestion.
        known: String,
    },
    /// The scene has a mesh without a file, and none was given.
    #[error(
        "the scene's mesh {0} was not given: add --mesh {0}=FILE, or a \"file\" to {path} in {1}",
        shown(name),
        shown(scene)
    )]
    MissingMesh {
        /// Name of the mesh.
        name: String,
        /// JSON path of the mesh in the scene file.
        path: String,
        /// Name of the scene file.
        scene: String,
    },
}

impl Failure for SceneError {
    fn exit(&self) -> Exit {
        match self {
            Self::File(error) => error.exit(),
            Self::Named(_, exit) => *exit,
            Self::TooLarge(_) => Exit::Resource,
            Self::Memory(error) => error.exit(),
            Self::MeshFile(error) => error.exit(),
            Self::UnknownMesh { .. } | Self::MissingMesh { .. } => Exit::Use,
            Self::Json(_) | Self::Obj(_) | Self::Mesh { .. } => Exit::Malformed,
        }
    }
}

/// Meshes by name that are given to the reader, besides those that the scene file names.
pub type MeshSource = BTreeMap<String, ObjFile>;

/// Reads the text of a scene file and checks its types alone.
///
/// # Errors
/// If the JSON is not a scene of this version.
pub fn parse(document: &Document<'_>) -> Result<SceneFile, SceneError> {
    document.expect(FORMAT, u64::from(VERSION))?;
    Ok(document.parse()?)
}

/// Reads the camera of a scene file alone.
///
/// # Errors
/// If the camera has no view.
pub fn camera_of(document: &Document<'_>, file: &SceneFile) -> Result<Camera, SceneError> {
    camera::read(document, &file.camera)
}

/// Reads the scene of a file and of the files that it includes. Paths are relative to `folder` and are
/// read from `source`. A mesh in `given` replaces the file of the mesh.
///
/// # Errors
/// On the first fault. The error names its file, line and column.
pub fn resolve(
    document: &Document<'_>,
    file: &SceneFile,
    folder: &Path,
    source: &dyn Source,
    given: MeshSource,
) -> Result<Scene, SceneError> {
    Draft::gather(document, file, folder, source)?.resolve(source, given)
}

impl Draft<'_> {
    /// Reads the scene, with files read from `source`. A mesh in `given` replaces the file of the mesh.
    ///
    /// # Errors
    /// On the first fault. The error names its file, line and column.
    pub fn resolve(&self, source: &dyn Source, given: MeshSource) -> Result<Scene, SceneError> {
        self.resolve_within(source, given, memory::of_process())
    }

    /// Reads the scene as [`Draft::resolve`] does, with memory from `budget` instead of the budget of the
    /// process. The memory of pictures and meshes is reserved before they are decoded.
    ///
    /// # Errors
    /// See [`Draft::resolve`].
    pub fn resolve_within(
        &self,
        source: &dyn Source,
        given: MeshSource,
        budget: &Budget,
    ) -> Result<Scene, SceneError> {
        self.check_mesh_names(given.keys().map(String::as_str))?;
        let texts = self.texts()?;
        let indices = Indices::of(&texts)?;
        let lattice = OnceLock::new();
        let memory = Memory::new(budget);
        let (remarks, held) = (RefCell::default(), RefCell::default());
        let readers: Vec<Reader<'_>> = texts
            .iter()
            .map(|text| Reader {
                document: &text.document,
                file: text.lists,
                folder: text.folder,
                source,
                indices: &indices,
                lattice: &lattice,
                memory: &memory,
                remarks: &remarks,
                held: &held,
            })
            .collect();
        let mut scene = self.without_lists()?;
        for text in &texts {
            scene.names.add(&text.lists);
        }
        let mut bumps = 0..;
        let mut planned = Vec::with_capacity(readers.len());
        for reader in &readers {
            scene.lights.extend(reader.lights()?);
            scene.materials.extend(reader.materials(&mut bumps)?);
            planned.push(reader.planned_objects()?);
            reader.texture_kinds()?;
        }
        for reader in &readers {
            scene.procedural.solids.extend(reader.solids()?);
            scene.procedural.bumps.extend(reader.bumps()?);
        }
        for reader in &readers {
            scene.textures.extend(reader.textures()?);
        }
        if let Some(own) = readers.last() {
            own.environment(&self.file.background, &mut scene)?;
        }
        let mut libraries = Libraries::default();
        let mut stored = Stored::new(given, &texts);
        for (reader, planned) in readers.iter().zip(planned) {
            reader.objects(planned, &mut stored, &mut libraries, &mut scene)?;
        }
        scene.procedural.lattice = lattice.into_inner();
        let remarks = remarks.take().into_iter().chain(scene.remarks);
        scene.remarks = libraries::joined(remarks.collect());
        Ok(scene)
    }

    /// Reads the values of the scene file that no part has, and leaves all lists empty.
    fn without_lists(&self) -> Result<Scene, SceneError> {
        let (document, file) = (self.document, self.file);
        let deepest = f64::from(DEEPEST);
        document.within("max_depth", f64::from(file.max_depth), 0.0, deepest)?;
        Ok(Scene {
            camera: camera::read(document, &file.camera)?,
            background: background::read(document, &file.background)?,
            is_transparent: file.background == BackgroundFile::Nothing,
            ambient: document.color("ambient", file.ambient)?,
            lights: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            procedural: Procedural::default(),
            objects: Vec::new(),
            max_depth: file.max_depth,
            min_weight: document.within("min_weight", file.min_weight, 0.0, 1.0)?,
            names: Names::default(),
            remarks: Vec::new(),
        })
    }
}

/// Reads one file of a scene.
struct Reader<'a> {
    document: &'a Document<'a>,
    file: Lists<'a>,
    folder: &'a Path,
    source: &'a dyn Source,
    /// Indices of the names in all files of the scene.
    indices: &'a Indices<'a>,
    /// The noise lattice, once a texture or a bump uses noise.
    lattice: &'a OnceLock<Arc<NoiseLattice>>,
    memory: &'a Memory<'a>,
    /// Remarks on pictures.
    remarks: &'a RefCell<Vec<Finding>>,
    /// Pictures inside of mesh files, by the paths that their materials name.
    held: &'a RefCell<BTreeMap<PathBuf, Vec<u8>>>,
}

impl Ranges for Reader<'_> {
    fn document(&self) -> &Document<'_> {
        self.document
    }
}

impl Reader<'_> {
    /// Reads the file that the scene names at the JSON path `at`.
    fn named_file(&self, at: &str, path: &Path) -> Result<Vec<u8>, SceneError> {
        if let Some(bytes) = self.held.borrow().get(path) {
            return Ok(bytes.clone());
        }
        self.source.read(path).map_err(|error| named(self.document, at, &error))
    }
}

/// Returns the error about a file that cannot be read. `document` names the file at the JSON path `at`.
fn named(document: &Document<'_>, at: &str, error: &FileError) -> SceneError {
    let fault = document.fault(at, error.to_string());
    if matches!(error, FileError::Memory(_)) {
        SceneError::TooLarge(fault)
    } else {
        SceneError::Named(fault, error.exit())
    }
}
