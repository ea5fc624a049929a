//! From a scene file to a [`Scene`]: names become indices, pictures and meshes are read, and every
//! number is checked against its range.

mod background;
mod bumps;
mod draft;
mod given;
mod libraries;
mod lights;
mod materials;
mod objects;
mod place;
mod shapes;
mod solids;
mod textures;

pub use draft::{Draft, Sheet};

use super::file::{ColorFile, FORMAT, Lists, SceneFile, VERSION};
use super::obj::ObjError;
use super::schema::{DEEPEST, LARGEST, SMALLEST};
use super::{Camera, Names, Scene};
use crate::color::Color;
use crate::procedural::{NoiseLattice, Procedural};
use crate::shape::Mesh;
use crate::shape::mesh::MeshError;
use draft::Indices;
use files::json::Document;
use files::words::{LONGEST_LIST, cut, shown};
use files::{Budget, Exit, Failure, FileError, JsonError, MemoryError, Source, memory};
use given::Given;
use glam::DVec3;
use libraries::Libraries;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, OnceLock};
use textures::Memory;
use thiserror::Error;

/// Why there is no scene.
#[derive(Debug, Error)]
pub enum SceneError {
    /// The scene file is wrong.
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
    #[error(
        "--mesh {}: the scene has no mesh of that name; it has {}",
        shown(name),
        cut(known, LONGEST_LIST)
    )]
    UnknownMesh {
        /// The name given.
        name: String,
        /// The names there are, with a suggestion.
        known: String,
    },
    /// The scene has a mesh without a file, and none was given.
    #[error(
        "the scene's mesh {0} was not given: add --mesh {0}=FILE, or a \"file\" to {path} in {1}",
        shown(name),
        shown(scene)
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
            Self::Named(_, exit) => *exit,
            Self::TooLarge(_) => Exit::Resource,
            Self::Memory(error) => error.exit(),
            Self::UnknownMesh { .. } | Self::MissingMesh { .. } => Exit::Use,
            _ => Exit::Malformed,
        }
    }
}

/// Meshes given by name from outside the scene file.
pub type MeshSource = BTreeMap<String, Mesh>;

/// Reads a scene file's text, and checks of it no more than its types.
///
/// # Errors
/// On JSON that is not a scene of this version.
pub fn parse(document: &Document<'_>) -> Result<SceneFile, SceneError> {
    document.expect(FORMAT, u64::from(VERSION))?;
    Ok(document.parse()?)
}

/// Makes the scene of a file and what it includes. Paths count from `folder` and are read from
/// `source`; a mesh in `given` is taken before its own file.
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
    Draft::gather(document, file, folder, source)?.resolve(source, given)
}

impl Draft<'_> {
    /// Makes the scene, with files read from `source`; a mesh in `given` is taken before its own
    /// file.
    ///
    /// # Errors
    /// On the first thing that is wrong, with its place.
    pub fn resolve(&self, source: &dyn Source, given: MeshSource) -> Result<Scene, SceneError> {
        self.resolve_within(source, given, memory::of_process())
    }

    /// As [`Draft::resolve`], with memory from `budget` in place of that of the process. Pictures and
    /// meshes are measured before they are decoded.
    ///
    /// # Errors
    /// As above.
    pub fn resolve_within(
        &self,
        source: &dyn Source,
        given: MeshSource,
        budget: &Budget,
    ) -> Result<Scene, SceneError> {
        self.check_mesh_names(given.keys().map(String::as_str))?;
        let sheets = self.sheets()?;
        let indices = Indices::of(&sheets)?;
        let lattice = OnceLock::new();
        let memory = Memory::new(budget);
        let readers: Vec<Reader<'_>> = sheets
            .iter()
            .map(|sheet| Reader {
                document: &sheet.document,
                file: sheet.lists,
                folder: sheet.folder,
                source,
                indices: &indices,
                lattice: &lattice,
                memory: &memory,
            })
            .collect();
        let mut scene = self.view()?;
        for sheet in &sheets {
            scene.names.add(&sheet.lists);
        }
        let mut bumps = 0..;
        for reader in &readers {
            scene.lights.extend(reader.lights()?);
            scene.materials.extend(reader.materials(&mut bumps)?);
            reader.objects_without_meshes()?;
            reader.texture_kinds()?;
        }
        for reader in &readers {
            scene.procedural.solids.extend(reader.solids()?);
            scene.procedural.bumps.extend(reader.bumps()?);
        }
        for reader in &readers {
            scene.textures.extend(reader.textures()?);
        }
        let mut libraries = Libraries::default();
        for reader in &readers {
            reader.libraries(&mut libraries, &mut scene)?;
        }
        let mut given = Given::new(given, &sheets);
        for reader in &readers {
            scene.objects.extend(reader.objects(&mut given, &libraries)?);
        }
        scene.procedural.lattice = lattice.into_inner();
        Ok(scene)
    }

    /// What a scene says once: a scene with nothing in it.
    fn view(&self) -> Result<Scene, SceneError> {
        let (file, indices) = (self.file, Indices::default());
        let reader = Reader {
            document: self.document,
            file: file.lists(),
            folder: Path::new(""),
            source: &files::Embedded(&[]),
            indices: &indices,
            lattice: &OnceLock::new(),
            memory: &Memory::new(memory::of_process()),
        };
        reader.within("max_depth", f64::from(file.max_depth), 0.0, f64::from(DEEPEST))?;
        Ok(Scene {
            camera: reader.camera(file)?,
            background: reader.background(&file.background)?,
            ambient: reader.color("ambient", file.ambient)?,
            lights: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            procedural: Procedural::default(),
            objects: Vec::new(),
            max_depth: file.max_depth,
            min_weight: reader.within("min_weight", file.min_weight, 0.0, 1.0)?,
            names: Names::default(),
        })
    }
}

/// Reads one file of a scene.
struct Reader<'a> {
    document: &'a Document<'a>,
    file: Lists<'a>,
    folder: &'a Path,
    source: &'a dyn Source,
    /// Those of all files of the scene.
    indices: &'a Indices<'a>,
    /// What noise is made of, once something asks for it.
    lattice: &'a OnceLock<Arc<NoiseLattice>>,
    memory: &'a Memory<'a>,
}

impl Reader<'_> {
    fn fault<T>(&self, path: &str, message: impl Into<String>) -> Result<T, SceneError> {
        Err(self.document.fault(path, message).into())
    }

    /// The file that the scene names at `place`.
    fn named_file(&self, place: &str, path: &Path) -> Result<Vec<u8>, SceneError> {
        self.source.read(path).map_err(|error| named(self.document, place, &error))
    }

    /// The value, if it lies in the closed range.
    fn within(&self, path: &str, value: f64, low: f64, high: f64) -> Result<f64, SceneError> {
        if (low..=high).contains(&value) {
            return Ok(value);
        }
        let range = if high == LARGEST && low == 0.0 {
            format!("at least 0 and at most {LARGEST:e}")
        } else {
            format!("{low} to {high}")
        };
        self.fault(path, format!("found {}, expected {range}", number(value)))
    }

    /// The value, if it is above 0 and can be reckoned with.
    fn above_zero(&self, path: &str, value: f64) -> Result<f64, SceneError> {
        if (SMALLEST..=LARGEST).contains(&value) {
            return Ok(value);
        }
        let range = format!("more than 0: {SMALLEST:e} to {LARGEST:e}");
        self.fault(path, format!("found {}, expected {range}", number(value)))
    }

    /// A point or a direction, if its coordinates can be reckoned with.
    fn vector(&self, path: &str, coordinates: [f64; 3]) -> Result<DVec3, SceneError> {
        let too_large = |x: &f64| !(-LARGEST..=LARGEST).contains(x);
        match coordinates.iter().position(too_large) {
            None => Ok(coordinates.into()),
            Some(k) => {
                let found = coordinates[k];
                let found = number(found);
                let message = format!("found {found}, expected {:e} to {LARGEST:e}", -LARGEST);
                self.fault(&format!("{path}[{k}]"), message)
            }
        }
    }

    fn color(&self, path: &str, color: ColorFile) -> Result<Color, SceneError> {
        for channel in color.0 {
            self.within(path, channel, 0.0, LARGEST)?;
        }
        Ok(Color::from(color.0))
    }

    fn camera(&self, file: &SceneFile) -> Result<Camera, SceneError> {
        let camera = &file.camera;
        let eye = self.vector("camera.eye", camera.eye)?;
        let target = self.vector("camera.target", camera.target)?;
        let up = self.vector("camera.up", camera.up)?;
        if !(camera.fov_deg > 0.0 && camera.fov_deg < 180.0) {
            let message =
                format!("found {}, expected an angle between 0 and 180", number(camera.fov_deg));
            return self.fault("camera.fov_deg", message);
        }
        match Camera::new(eye, target, up, camera.fov_deg.to_radians()) {
            Some(camera) => Ok(camera),
            None => self.fault(
                "camera",
                "found an eye at its target, or an up along the view; expected three directions apart",
            ),
        }
    }
}

/// What is said of a file that `document` names at `place` and that cannot be read.
fn named(document: &Document<'_>, place: &str, error: &FileError) -> SceneError {
    let fault = document.fault(place, error.to_string());
    if matches!(error, FileError::Memory(_)) {
        SceneError::TooLarge(fault)
    } else {
        SceneError::Named(fault, error.exit())
    }
}

/// A number as one writes it: whole ones without a point, very large and small ones with a power.
fn number(value: f64) -> String {
    let usual = value == 0.0 || (1e-5..1e16).contains(&value.abs());
    if usual { value.to_string() } else { format!("{value:?}") }
}
