//! The texts of a scene: the scene file, and the parts that it includes.

use super::{SceneError, named};
use crate::scene::SurfaceTexture;
use crate::scene::file::{Lists, MeshFile, ObjectFile, PART_FORMAT, PartFile, SceneFile, VERSION};
use files::json::{Document, nearest};
use files::{JsonError, Source, input};
use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};

/// Largest depth of includes. Deeper includes could exhaust the stack.
pub const DEEPEST_INCLUDE: usize = 16;

/// Largest number of parts of a scene, which bounds the time that hostile files take.
pub const MOST_PARTS: usize = 1000;

/// A scene file and all included files, each read into its types. Names are not resolved yet, and
/// numbers are not checked.
#[derive(Debug)]
pub struct Draft<'a> {
    /// The text of the scene file.
    pub document: &'a Document<'a>,
    /// Contents of the scene file.
    pub file: &'a SceneFile,
    folder: &'a Path,
    /// The included files, each after the files that it includes itself.
    parts: Vec<Part>,
}

/// A file that a scene includes.
#[derive(Debug)]
struct Part {
    name: String,
    bytes: Vec<u8>,
    path: PathBuf,
    file: PartFile,
}

/// The text of the scene file or of an included file, with its contents.
#[derive(Debug, Clone, Copy)]
pub struct SceneText<'a> {
    /// The text.
    pub document: Document<'a>,
    /// Folder to which the paths of the file are relative.
    pub folder: &'a Path,
    /// Lists of lights, textures, materials and objects.
    pub lists: Lists<'a>,
}

impl<'a> Draft<'a> {
    /// Reads the files that `file` includes from `source`. Paths are relative to `folder`.
    ///
    /// # Errors
    /// If a part cannot be read, is not a part of a scene, includes itself, or is included too deep.
    pub fn gather(
        document: &'a Document<'a>,
        file: &'a SceneFile,
        folder: &'a Path,
        source: &dyn Source,
    ) -> Result<Self, SceneError> {
        let mut gathering =
            Gathering { source, parts: Vec::new(), read: HashSet::new(), including: Vec::new() };
        gathering.include(document, &file.include, folder)?;
        Ok(Self { document, file, folder, parts: gathering.parts })
    }

    /// Returns the texts of the scene in the order of their lights and objects; the scene file is last.
    ///
    /// # Errors
    /// If a text is not JSON. This cannot happen, since each text was read before.
    pub fn texts(&self) -> Result<Vec<SceneText<'_>>, JsonError> {
        let parts = self.parts.iter().map(|part| {
            let document = Document::new(&part.name, &part.bytes)?;
            Ok(SceneText { document, folder: folder_of(&part.path), lists: part.file.lists() })
        });
        let own =
            SceneText { document: *self.document, folder: self.folder, lists: self.file.lists() };
        parts.chain([Ok(own)]).collect()
    }

    /// Checks that each name in `given` is that of a mesh of the scene.
    ///
    /// # Errors
    /// If a name is unknown. The error lists the names of the scene's meshes.
    pub fn check_mesh_names<'n>(
        &self,
        given: impl IntoIterator<Item = &'n str>,
    ) -> Result<(), SceneError> {
        let lists = self.parts.iter().map(|part| part.file.lists()).chain([self.file.lists()]);
        let names: Vec<&str> = lists.flat_map(meshes).map(|mesh| mesh.name.as_str()).collect();
        let known: HashSet<&str> = names.iter().copied().collect();
        for name in given {
            if !known.contains(name) {
                let mut known = if names.is_empty() { "none".into() } else { names.join(", ") };
                if let Some(near) = nearest(name, names.iter().copied()) {
                    known.push_str(&format!(" (did you mean {near}?)"));
                }
                return Err(SceneError::UnknownMesh { name: name.into(), known });
            }
        }
        Ok(())
    }
}

/// Returns the meshes among the objects of a file.
pub(super) fn meshes(lists: Lists<'_>) -> impl Iterator<Item = &MeshFile> {
    lists.objects.iter().filter_map(ObjectFile::mesh)
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

struct Gathering<'a> {
    source: &'a dyn Source,
    parts: Vec<Part>,
    /// Paths of all parts read so far.
    read: HashSet<PathBuf>,
    /// Paths of the parts whose includes are being read, each included by the part before.
    including: Vec<PathBuf>,
}

impl Gathering<'_> {
    fn include(
        &mut self,
        document: &Document<'_>,
        include: &[PathBuf],
        folder: &Path,
    ) -> Result<(), SceneError> {
        for (k, path) in include.iter().enumerate() {
            let at = format!("include[{k}]");
            let refuse = |message: String| Err(SceneError::Json(document.fault(&at, message)));
            let path = input::normalized(&folder.join(path));
            let name = input::name_of(&path);
            if self.including.contains(&path) {
                return refuse(format!("found {name}, which includes itself; expected no circle"));
            }
            if self.including.len() >= DEEPEST_INCLUDE {
                return refuse(format!(
                    "found files included by files more than {DEEPEST_INCLUDE} deep"
                ));
            }
            // Each part is read once, however many files include it.
            if !self.read.insert(path.clone()) {
                continue;
            }
            if self.read.len() > MOST_PARTS {
                return refuse(format!("found more files than {MOST_PARTS} included"));
            }
            let bytes =
                self.source.read_json(&path).map_err(|error| named(document, &at, &error))?;
            let part = Document::new(&name, &bytes)?;
            part.expect(PART_FORMAT, u64::from(VERSION))?;
            let file: PartFile = part.parse()?;
            self.including.push(path.clone());
            self.include(&part, &file.include, folder_of(&path))?;
            self.including.pop();
            self.parts.push(Part { name, bytes, path, file });
        }
        Ok(())
    }
}

/// The names of a scene's materials and textures, with their indices in the scene's lists.
#[derive(Debug, Default)]
pub(super) struct Indices<'a> {
    pub(super) materials: BTreeMap<&'a str, usize>,
    pub(super) textures: BTreeMap<&'a str, SurfaceTexture>,
}

impl<'a> Indices<'a> {
    /// Collects the names of all files.
    ///
    /// # Errors
    /// If two files define one name.
    pub(super) fn of(texts: &[SceneText<'a>]) -> Result<Self, JsonError> {
        let mut names = Self::default();
        let (mut pictures, mut solids) = (0.., 0..);
        for (k, text) in texts.iter().enumerate() {
            let Lists { materials, textures, .. } = text.lists;
            let clash = |key: &str, kind: &str, name: &str, has: fn(&Lists<'_>, &str) -> bool| {
                let other = texts[..k].iter().find(|other| has(&other.lists, name));
                let other = other.map_or("another file", |other| other.document.file);
                let message = format!(
                    "found a {kind} {name:?}, which {other} has too; expected each name in one file"
                );
                Err(text.document.fault(&format!("{key}.{name}"), message))
            };
            for name in materials.keys() {
                let index = names.materials.len();
                if names.materials.insert(name, index).is_some() {
                    let has = |lists: &Lists<'_>, name: &str| lists.materials.contains_key(name);
                    return clash("materials", "material", name, has);
                }
            }
            for (name, texture) in textures {
                // Pictures and solids have indices of their own.
                let index = match texture.image {
                    Some(_) => pictures.next().map(SurfaceTexture::Picture),
                    None => solids.next().map(SurfaceTexture::Solid),
                };
                let Some(index) = index else { continue };
                if names.textures.insert(name, index).is_some() {
                    let has = |lists: &Lists<'_>, name: &str| lists.textures.contains_key(name);
                    return clash("textures", "texture", name, has);
                }
            }
        }
        Ok(names)
    }
}
