//! A scene's texts: its own, and those of the parts that it includes.

use super::{SceneError, named};
use crate::scene::SurfaceTexture;
use crate::scene::file::{Lists, MeshFile, ObjectFile, PART_FORMAT, PartFile, SceneFile, VERSION};
use files::json::{Document, nearest};
use files::{JsonError, Source, input};
use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};

/// Parts may include parts this deep.
pub const DEEPEST_INCLUDE: usize = 16;

/// A scene may include this many parts.
pub const MOST_PARTS: usize = 1000;

/// A scene file and all that it includes, each read into its types; names are not resolved, and of
/// the numbers none is checked.
#[derive(Debug)]
pub struct Draft<'a> {
    /// The text of the scene file.
    pub document: &'a Document<'a>,
    /// What it says.
    pub file: &'a SceneFile,
    folder: &'a Path,
    /// In the order in which they are taken in: each after those that it includes itself.
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

/// One of the files of a draft.
#[derive(Debug, Clone, Copy)]
pub struct Sheet<'a> {
    /// Its text.
    pub document: Document<'a>,
    /// The folder that its paths count from.
    pub folder: &'a Path,
    /// What it says.
    pub lists: Lists<'a>,
}

impl<'a> Draft<'a> {
    /// Reads what `file` includes from `source`; paths count from `folder`.
    ///
    /// # Errors
    /// When a part cannot be read, is no part of a scene, includes itself, or is included too deep.
    pub fn gather(
        document: &'a Document<'a>,
        file: &'a SceneFile,
        folder: &'a Path,
        source: &dyn Source,
    ) -> Result<Self, SceneError> {
        let mut gathering =
            Gathering { source, parts: Vec::new(), read: HashSet::new(), way: Vec::new() };
        gathering.include(document, &file.include, folder)?;
        Ok(Self { document, file, folder, parts: gathering.parts })
    }

    /// The files of the scene in the order in which their lights and objects follow; its own last.
    ///
    /// # Errors
    /// Never in fact: the text of each was read before.
    pub fn sheets(&self) -> Result<Vec<Sheet<'_>>, JsonError> {
        let parts = self.parts.iter().map(|part| {
            let document = Document::new(&part.name, &part.bytes)?;
            Ok(Sheet { document, folder: folder_of(&part.path), lists: part.file.lists() })
        });
        let own = Sheet { document: *self.document, folder: self.folder, lists: self.file.lists() };
        parts.chain([Ok(own)]).collect()
    }

    /// Checks that each of `given` names a mesh of the scene.
    ///
    /// # Errors
    /// With the names there are.
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

/// The meshes among a file's objects.
pub(super) fn meshes(lists: Lists<'_>) -> impl Iterator<Item = &MeshFile> {
    lists.objects.iter().filter_map(|object| match object {
        ObjectFile::Mesh(mesh) => Some(mesh),
        _ => None,
    })
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

struct Gathering<'a> {
    source: &'a dyn Source,
    parts: Vec<Part>,
    /// The paths of all parts read so far.
    read: HashSet<PathBuf>,
    /// The parts whose includes are being read, each included by the one before.
    way: Vec<PathBuf>,
}

impl Gathering<'_> {
    fn include(
        &mut self,
        document: &Document<'_>,
        include: &[PathBuf],
        folder: &Path,
    ) -> Result<(), SceneError> {
        for (k, path) in include.iter().enumerate() {
            let place = format!("include[{k}]");
            let refuse = |message: String| Err(SceneError::Json(document.fault(&place, message)));
            let path = input::normalized(&folder.join(path));
            let name = input::name_of(&path);
            if self.way.contains(&path) {
                return refuse(format!("found {name}, which includes itself; expected no circle"));
            }
            if self.way.len() >= DEEPEST_INCLUDE {
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
                self.source.read_json(&path).map_err(|error| named(document, &place, &error))?;
            let part = Document::new(&name, &bytes)?;
            part.expect(PART_FORMAT, u64::from(VERSION))?;
            let file: PartFile = part.parse()?;
            self.way.push(path.clone());
            self.include(&part, &file.include, folder_of(&path))?;
            self.way.pop();
            self.parts.push(Part { name, bytes, path, file });
        }
        Ok(())
    }
}

/// The names of a scene's materials and textures, each with its place in the scene's lists.
#[derive(Debug, Default)]
pub(super) struct Indices<'a> {
    pub(super) materials: BTreeMap<&'a str, usize>,
    pub(super) textures: BTreeMap<&'a str, SurfaceTexture>,
}

impl<'a> Indices<'a> {
    /// The names in all files.
    ///
    /// # Errors
    /// When one is given in two files.
    pub(super) fn of(sheets: &[Sheet<'a>]) -> Result<Self, JsonError> {
        let mut names = Self::default();
        let (mut pictures, mut solids) = (0.., 0..);
        for (k, sheet) in sheets.iter().enumerate() {
            let Lists { materials, textures, .. } = sheet.lists;
            let clash = |key: &str, kind: &str, name: &str, has: fn(&Lists<'_>, &str) -> bool| {
                let other = sheets[..k].iter().find(|other| has(&other.lists, name));
                let other = other.map_or("another file", |other| other.document.file);
                let message = format!(
                    "found a {kind} {name:?}, which {other} has too; expected each name in one file"
                );
                Err(sheet.document.fault(&format!("{key}.{name}"), message))
            };
            for name in materials.keys() {
                let index = names.materials.len();
                if names.materials.insert(name, index).is_some() {
                    let has = |lists: &Lists<'_>, name: &str| lists.materials.contains_key(name);
                    return clash("materials", "material", name, has);
                }
            }
            for (name, texture) in textures {
                // Pictures and solids are counted apart.
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
