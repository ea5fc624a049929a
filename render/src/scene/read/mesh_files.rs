//! Finds the files of a mesh: the mesh itself, the libraries that it names, and what it holds of its own.

use super::libraries::Libraries;
use super::{Reader, SceneError};
use crate::scene::file::MeshFile;
use crate::scene::mesh_file::{self, Near};
use crate::scene::obj::ObjFile;
use crate::scene::text::before_comment;
use std::path::{Path, PathBuf};

impl Reader<'_> {
    /// Returns the mesh that the caller gave, or reads its file.
    pub(super) fn mesh_file(
        &self,
        at: &str,
        file: &MeshFile,
        given: Option<ObjFile>,
    ) -> Result<ObjFile, SceneError> {
        match (given, &file.file) {
            (Some(given), _) => {
                let named = |source| SceneError::Mesh { name: file.name.clone(), source };
                given.mesh.check().map_err(named)?;
                Ok(given)
            }
            (None, Some(path)) => {
                let path = self.folder.join(path);
                let bytes = self.named_file(&format!("{at}.file"), &path)?;
                let name = files::input::name_of(&path);
                let folder = path.parent().unwrap_or(Path::new(""));
                let reserve = &mut |bytes| self.memory.keep(bytes, || format!("mesh {name}"));
                let near = Near { folder, source: self.source, reserve };
                Ok(mesh_file::read(&name, &bytes, near)?)
            }
            (None, None) => Err(SceneError::MissingMesh {
                name: file.name.clone(),
                path: at.into(),
                scene: self.document.file.into(),
            }),
        }
    }

    /// Makes the materials and pictures inside of a mesh file known. Returns the path of this library,
    /// which is that of the file.
    pub(super) fn held_materials(&self, read: &ObjFile, libraries: &mut Libraries) -> PathBuf {
        let name = Path::new(&read.file).file_name().unwrap_or_default();
        let path = read.folder.join(name);
        libraries.hold(&path, &read.materials);
        let pictures = read.pictures.iter();
        let named = pictures.map(|(name, bytes)| (read.folder.join(name), bytes.clone()));
        self.held.borrow_mut().extend(named);
        path
    }

    /// Returns the files that a text behind `mtllib` means: the whole text, one file for each part that ends in
    /// `.mtl` or stands in quotation marks, or one for each word.
    pub(super) fn library_paths(&self, folder: &Path, text: &str) -> Vec<PathBuf> {
        let text = text.replace('\\', "/");
        let near = |name: &str| {
            let beside = name.rsplit('/').next().unwrap_or(name);
            let mut paths = vec![folder.join(name), folder.join(beside)];
            paths.extend(paths.clone().iter().filter_map(|path| self.source.same_but_case(path)));
            paths.into_iter().find(|path| self.source.read(path).is_ok())
        };
        if let Some(path) = near(&text).or_else(|| near(before_comment(&text)?)) {
            return vec![path];
        }
        let mut paths = Vec::new();
        for part in parts(&text) {
            let found = |name: &str| near(name).unwrap_or_else(|| folder.join(name));
            let words: Vec<&str> = part.split_whitespace().collect();
            if words.len() > 1
                && near(&part).is_none()
                && words.iter().any(|word| near(word).is_some())
            {
                paths.extend(words.into_iter().map(found));
            } else {
                paths.push(found(&part));
            }
        }
        paths
    }
}

/// Divides the text behind `mtllib` into names that may have spaces: parts in quotation marks, parts that end in
/// `.mtl`, and the rest.
fn parts(text: &str) -> Vec<String> {
    if text.contains('"') {
        let quoted = text.split('"').map(str::trim).filter(|part| !part.is_empty());
        return quoted.map(Into::into).collect();
    }
    let mut parts = Vec::new();
    let mut open = String::new();
    for word in text.split_whitespace() {
        if !open.is_empty() {
            open.push(' ');
        }
        open.push_str(word);
        if word.to_ascii_lowercase().ends_with(".mtl") {
            parts.push(std::mem::take(&mut open));
        }
    }
    parts.extend(Some(open).filter(|open| !open.is_empty()));
    parts
}
