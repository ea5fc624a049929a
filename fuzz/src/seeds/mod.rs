//! The seeds: inputs from which mutation starts.
//!
//! The seeds are the files of `examples/` and of `fuzz/seeds/`, made small. Grids have few cells
//! and pictures few texels, so that a case takes at most about a millisecond. Grids, meshes and
//! pictures are made from the examples when a worker starts. The same files give the same seeds in
//! the same order.

pub mod exr;
pub mod memory_files;
pub mod png;
pub mod small;

use crate::verdict::{Stop, refused};
use files::json::Document;
use memory_files::MemoryFiles;
use serde_json::Value;
use std::path::{Path, PathBuf};
use sweep::spec::Resolution;
use sweep::{GridMesh, Object};
use thiserror::Error;
use triangulate::TriMesh;

/// The folder of scenes in the corpus; scenes and parts that are tried have paths in this folder.
pub const SCENES: &str = "examples/scenes";
/// The folder of specs in the corpus.
pub const CURVES: &str = "examples/curves";
/// The folder of jobs in the corpus.
pub const PAGES: &str = "examples/pages";

/// A reason why there are no seeds.
#[derive(Debug, Error)]
pub enum SeedError {
    /// A folder or file cannot be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The folder or file.
        path: String,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A file is not of the kind that its folder holds.
    #[error("seed {path}: {found}")]
    Wrong {
        /// The file.
        path: String,
        /// The fault of the file.
        found: String,
    },
}

/// All seeds, and the files that they name.
#[derive(Debug)]
pub struct Corpus {
    /// The examples, made small.
    pub stored: MemoryFiles,
    /// Specs whose meshes have few cells.
    pub specs: Vec<Value>,
    /// Scenes.
    pub scenes: Vec<Value>,
    /// Jobs.
    pub jobs: Vec<Value>,
    /// The grids of some specs.
    pub grids: Vec<Vec<GridMesh>>,
}

impl Corpus {
    /// Reads the examples and makes them small.
    ///
    /// # Errors
    /// When a folder is missing or one of its files is broken.
    pub fn load() -> Result<Self, SeedError> {
        let mut stored = MemoryFiles::default();
        for (path, bytes) in folder(&root().join("examples/textures"), "png")? {
            let small = small::picture(&bytes).map_err(|error| wrong(&path, &error))?;
            stored.put(path_from_root("examples/textures", &path), small);
        }
        for ending in ["svg", "swc", "csv"] {
            for (path, bytes) in folder(&root().join(CURVES), ending)? {
                stored.put(path_from_root(CURVES, &path), bytes);
            }
        }
        let mut specs = Vec::new();
        for (path, mut spec) in values("examples/curves", "spec")? {
            small::bound(&mut spec);
            stored.put(path_from_root(CURVES, &path), spec.to_string().into_bytes());
            specs.push(spec);
        }
        let mut scenes = Vec::new();
        for (path, scene) in values("examples/scenes", "scene")? {
            stored.put(path_from_root(SCENES, &path), scene.to_string().into_bytes());
            scenes.push(scene);
        }
        let mut jobs = Vec::new();
        for (path, mut job) in values("examples/pages", "job")? {
            small::bound_job(&mut job);
            stored.put(path_from_root(PAGES, &path), job.to_string().into_bytes());
            jobs.push(job);
        }
        let grids = specs.iter().filter_map(|spec| grids_of(spec, &stored).ok()).collect();
        let mut corpus = Self { stored, specs, scenes, jobs, grids };
        let tube = corpus.obj(0).unwrap_or_default();
        corpus.stored.put("examples/meshes/tube.obj", tube);
        Ok(corpus)
    }

    /// Returns the mesh of one of the grids.
    #[must_use]
    pub fn mesh(&self, number: usize) -> Option<TriMesh> {
        triangulate::mesh(self.grids.get(number)?.as_slice(), &triangulate::Options::default()).ok()
    }

    /// Returns the OBJ file of one of the grids.
    #[must_use]
    pub fn obj(&self, number: usize) -> Option<Vec<u8>> {
        let mut bytes = Vec::new();
        let options = triangulate::Options::default();
        triangulate::write_obj(self.grids.get(number)?.as_slice(), &options, &mut bytes).ok()?;
        Some(bytes)
    }
}

/// Returns the files of `fuzz/seeds/` for a reader, in the order of their names; none without such
/// a folder.
///
/// # Errors
/// When a file cannot be read.
pub fn extra(reader: &str) -> Result<Vec<Vec<u8>>, SeedError> {
    let path = root().join("fuzz/seeds").join(reader);
    if !path.is_dir() {
        return Ok(Vec::new());
    }
    Ok(folder(&path, "")?.into_iter().map(|(_, bytes)| bytes).collect())
}

/// Sweeps a spec with very few cells.
fn grids_of(spec: &Value, stored: &MemoryFiles) -> Result<Vec<GridMesh>, Stop> {
    let mut spec = spec.clone();
    small::bound_to(&mut spec, 10, 200);
    let text = spec.to_string();
    let document = Document::new("spec.json", text.as_bytes()).map_err(refused)?;
    let object = Object::read(&document, CURVES.as_ref(), stored, &Resolution::default());
    object.and_then(|object| object.grids()).map_err(refused)
}

/// Returns the JSON files of `fuzz/seeds/` for a reader, in the order of their names.
///
/// # Errors
/// When a file cannot be read or is no JSON.
pub fn documents(reader: &str) -> Result<Vec<Value>, SeedError> {
    let files = folder(&root().join("fuzz/seeds").join(reader), "json")?;
    let parse = |(path, bytes): (PathBuf, Vec<u8>)| {
        serde_json::from_slice(&bytes).map_err(|error| wrong(&path, &error))
    };
    files.into_iter().map(parse).collect()
}

/// Returns the root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn path_from_root(folder: &str, path: &Path) -> PathBuf {
    Path::new(folder).join(path.file_name().unwrap_or_default())
}

fn wrong(path: &Path, found: &dyn std::error::Error) -> SeedError {
    SeedError::Wrong { path: path.display().to_string(), found: found.to_string() }
}

/// Reads the JSON files of a folder of the examples, followed by those of `fuzz/seeds/`.
fn values(examples: &str, reader: &str) -> Result<Vec<(PathBuf, Value)>, SeedError> {
    let mut files = folder(&root().join(examples), "json")?;
    let extra = root().join("fuzz/seeds").join(reader);
    if extra.is_dir() {
        files.extend(folder(&extra, "json")?);
    }
    let parse = |(path, bytes): (PathBuf, Vec<u8>)| {
        let value = serde_json::from_slice(&bytes).map_err(|error| wrong(&path, &error))?;
        Ok((path, value))
    };
    files.into_iter().map(parse).collect()
}

/// Reads the files of a folder whose names end in `ending`, in the order of their names.
fn folder(path: &Path, ending: &str) -> Result<Vec<(PathBuf, Vec<u8>)>, SeedError> {
    let error = |source| SeedError::Read { path: path.display().to_string(), source };
    let entries = std::fs::read_dir(path).map_err(error)?;
    let mut paths = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()
        .map_err(error)?;
    paths.retain(|path| path.to_string_lossy().ends_with(ending));
    paths.sort();
    let read = |path: PathBuf| match std::fs::read(&path) {
        Ok(bytes) => Ok((path, bytes)),
        Err(source) => Err(SeedError::Read { path: path.display().to_string(), source }),
    };
    paths.into_iter().map(read).collect()
}
