//! The material libraries that a scene's meshes name, read when a surface needs them.

use super::reliefs::{Carved, CarvedMaterials};
use super::textures::Kind;
use super::{Reader, SceneError};
use crate::scene::mtl::{self, Entry, Library, Map};
use crate::scene::text::before_comment;
use crate::scene::{Scene, SurfaceTexture};
use crate::texture::{Alpha, Texture, Values};
use files::FileError;
use files::check::{Finding, Severity};
use std::collections::{BTreeMap, HashMap};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The libraries read so far, and what surfaces took from them. Materials and textures follow those of
/// the scene files in the scene's lists.
#[derive(Debug, Default)]
pub(super) struct Libraries {
    files: BTreeMap<PathBuf, Library>,
    /// Indices of materials by library and by the number of the entry.
    materials: BTreeMap<(PathBuf, usize), usize>,
    /// Indices of textures by what they show. Pictures that cannot be read have none.
    textures: BTreeMap<Shown, Option<usize>>,
    /// Materials with reliefs.
    pub(super) carved: CarvedMaterials,
}

/// Paths of a picture and of a mask, each if there is one, the number of its continuation, and its use of alpha.
type Shown = (Option<PathBuf>, Option<PathBuf>, u8, Alpha);

/// A material of a library, as a surface takes it.
#[derive(Debug, Clone)]
pub(super) struct Taken {
    pub(super) material: usize,
    pub(super) picture: Option<Pictured>,
    pub(super) relief: Option<Carved>,
}

/// The pictures of a material of a library: its colours, its mask, or both.
#[derive(Debug, Clone)]
pub(super) struct Pictured {
    colors: Option<Map>,
    mask: Option<Map>,
    alpha: Alpha,
    /// The library that names the pictures.
    library: PathBuf,
}

impl Pictured {
    /// The map by whose options the texture coordinates are moved.
    pub(super) fn map(&self) -> Option<&Map> {
        self.colors.as_ref().or(self.mask.as_ref())
    }
}

impl Libraries {
    /// Adds the library at `path` if it is new, with the bytes that `read` returns.
    ///
    /// # Errors
    /// If the file cannot be read, or is not text.
    pub(super) fn add(
        &mut self,
        path: &Path,
        read: impl FnOnce() -> Result<Vec<u8>, SceneError>,
        scene: &mut Scene,
    ) -> Result<(), SceneError> {
        if self.files.contains_key(path) {
            return Ok(());
        }
        let file = files::input::name_of(path);
        let library = mtl::read(&file, &read()?)?;
        if !library.remarks.is_empty() {
            scene.remarks.push(remark(&file, &library.remarks));
        }
        self.files.insert(path.into(), library);
        Ok(())
    }

    /// Adds the materials that a mesh file itself holds, under the path of this file.
    pub(super) fn hold(&mut self, path: &Path, entries: &[Entry]) {
        self.files.entry(path.into()).or_insert_with(|| Library::of(entries));
    }

    /// Returns the material of this name from the first of these libraries that has it.
    pub(super) fn take<'p>(
        &mut self,
        paths: &'p [PathBuf],
        name: &str,
        scene: &mut Scene,
    ) -> Option<Taken> {
        let find = |path: &'p PathBuf| Some((path, self.files.get(path)?.find(name)?));
        let (path, number) = paths.iter().find_map(find)?;
        let entry = &self.files[path].entries[number];
        let material = *self.materials.entry((path.clone(), number)).or_insert_with(|| {
            scene.materials.push(entry.material.clone());
            scene.names.materials.push(entry.name.clone());
            scene.materials.len() - 1
        });
        let (colors, mask) = (entry.picture.clone(), entry.mask.clone());
        let is_pictured = colors.is_some() || mask.is_some();
        let picture = is_pictured.then(|| Pictured {
            colors,
            mask,
            alpha: entry.alpha,
            library: path.clone(),
        });
        let relief = entry.relief.clone();
        let relief = relief.map(|relief| Carved { relief, library: path.clone() });
        Some(Taken { material, picture, relief })
    }
}

/// Sentences on one file; further ones are counted.
const SENTENCES: usize = 6;

/// Joins the remarks on the same file, in the order of the files' first remarks.
pub(super) fn joined(remarks: Vec<Finding>) -> Vec<Finding> {
    let mut files: Vec<(String, Vec<String>)> = Vec::new();
    let mut numbers: HashMap<String, usize> = HashMap::new();
    for Finding { path, message, .. } in remarks {
        let number = *numbers.entry(path.clone()).or_insert(files.len());
        if number == files.len() {
            files.push((path, Vec::new()));
        }
        files[number].1.push(message);
    }
    let mut join = |(file, mut sentences): (String, Vec<String>)| {
        let more = sentences.len().saturating_sub(SENTENCES);
        sentences.truncate(SENTENCES);
        sentences.extend((more > 0).then(|| format!("{more} more remarks")));
        remark(&file, &sentences)
    };
    files.drain(..).map(&mut join).collect()
}

/// Returns the remark on a file, from its sentences.
pub(super) fn remark(file: &str, sentences: &[String]) -> Finding {
    Finding::new(Severity::Remark, file, sentences.join("; "))
}

impl Reader<'_> {
    /// Returns the texture of a library's pictures. A picture that cannot be read is a fault if the scene
    /// names the library, at the JSON path `at`; otherwise it is a remark, and there is no texture.
    pub(super) fn library_picture(
        &self,
        at: &str,
        named: bool,
        pictured: &Pictured,
        libraries: &mut Libraries,
        scene: &mut Scene,
    ) -> Result<Option<SurfaceTexture>, SceneError> {
        let Some(map) = pictured.map() else { return Ok(None) };
        let folder = pictured.library.parent().unwrap_or(Path::new(""));
        let path = |map: &Option<Map>| map.as_ref().map(|map| folder.join(&map.path));
        let key = (path(&pictured.colors), path(&pictured.mask), map.wrap as u8, pictured.alpha);
        if let Some(&known) = libraries.textures.get(&key) {
            return Ok(known.map(SurfaceTexture::Picture));
        }
        let file = files::input::name_of(&pictured.library);
        let mut read = |map: &Map, is_mask: bool| {
            let (values, alpha) = (Values::Srgb, pictured.alpha);
            let kind = Kind { values, alpha, wrap: map.wrap };
            match self.found_picture(at, folder, map, (!is_mask).then_some(kind)) {
                Ok((texture, found)) => {
                    if found != folder.join(&map.path) {
                        let sentence = format!("{} is taken for {}", found.display(), map.path);
                        scene.remarks.push(remark(&file, &[sentence]));
                    }
                    Ok(Some(texture))
                }
                Err(error) if named => Err(error),
                Err(error) => {
                    scene.remarks.push(remark(&file, &[format!("no picture: {error}")]));
                    Ok(None)
                }
            }
        };
        let colors = pictured.colors.as_ref().map(|map| read(map, false)).transpose()?.flatten();
        let mask = pictured.mask.as_ref().map(|map| read(map, true)).transpose()?.flatten();
        if let (Some(colors), Some(mask)) = (&pictured.colors, &pictured.mask)
            && (colors.scale, colors.offset) != (mask.scale, mask.offset)
        {
            let sentence = "`map_d` is laid as `map_Kd` is, whose options differ".to_string();
            scene.remarks.push(remark(&file, &[sentence]));
        }
        let texture = match (colors, mask) {
            (Some(colors), Some(mask)) => Some(colors.cut_out_by(&mask)),
            (None, Some(mask)) => Some(Texture::white(map.wrap).cut_out_by(&mask)),
            (colors, None) => colors,
        };
        let index = texture.map(|texture| {
            scene.textures.push(texture);
            scene.names.textures.push(map.path.clone());
            scene.textures.len() - 1
        });
        libraries.textures.insert(key, index);
        Ok(index.map(SurfaceTexture::Picture))
    }

    /// Reads the picture that [`Reader::found_path`] finds. Without a `kind` the picture becomes a mask.
    fn found_picture(
        &self,
        at: &str,
        folder: &Path,
        map: &Map,
        kind: Option<Kind>,
    ) -> Result<(Texture, PathBuf), SceneError> {
        let path = self.found_path(folder, map);
        let texture = match kind {
            Some(kind) => self.texels(at, &path, kind)?,
            None => self.texture_of(at, &path, |file| Texture::mask_of_picture(file, map.wrap))?,
        };
        Ok((texture, path))
    }

    /// Returns the path of a picture. If there is no file, the path without a comment, the file of that
    /// name in the library's folder, and one that differs in upper and lower case are tried.
    pub(super) fn found_path(&self, folder: &Path, map: &Map) -> PathBuf {
        let mut paths = vec![folder.join(&map.path)];
        let short = before_comment(&map.path);
        paths.extend(short.map(|path| folder.join(path)));
        let name = |path: &str| path.rsplit('/').next().map(|name| folder.join(name));
        paths.extend(name(short.unwrap_or(&map.path)));
        for path in paths.clone() {
            paths.extend(self.source.same_but_case(&path));
        }
        let is_missing = |error: &FileError| matches!(error, FileError::Read { source, .. } if source.kind() == ErrorKind::NotFound);
        let is_held = |path: &PathBuf| self.held.borrow().contains_key(path);
        let exists = |path: &&PathBuf| {
            is_held(path) || !self.source.read(path).is_err_and(|error| is_missing(&error))
        };
        paths.iter().find(exists).unwrap_or(&paths[0]).clone()
    }
}
