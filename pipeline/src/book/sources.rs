//! The files that a page is made of, as text.

use super::Entry;
use crate::PipelineError;
use files::Source;
use files::json::Document;
use render::scene::file::{PartFile, SceneFile};
use std::path::{Component, Path, PathBuf};

/// A file of a page.
#[derive(Debug)]
pub struct SourceText {
    /// What it is: `job`, `scene`, `part of the scene` or `curves`.
    pub kind: &'static str,
    /// Its path.
    pub path: String,
    /// What it says.
    pub text: String,
}

/// The job file, its scene with the parts that it includes, and its specs; each once.
///
/// # Errors
/// When one cannot be read, or the scene is none.
pub fn texts(entry: &Entry<'_>) -> Result<Vec<SourceText>, PipelineError> {
    let mut texts = Vec::new();
    add(&mut texts, "job", entry.path, entry.source)?;
    let scene = &entry.job.scene;
    let bytes = add(&mut texts, "scene", scene, entry.source)?;
    let name = scene.display().to_string();
    let file: SceneFile = Document::new(&name, &bytes)?.parse()?;
    let mut included = beside(scene, &file.include);
    let mut at = 0;
    while let Some(path) = included.get(at).cloned() {
        let bytes = add(&mut texts, "part of the scene", &path, entry.source)?;
        let name = path.display().to_string();
        let part: PartFile = Document::new(&name, &bytes)?.parse()?;
        let new = beside(&path, &part.include);
        included
            .extend(new.into_iter().filter(|path| !included.contains(path)).collect::<Vec<_>>());
        at += 1;
    }
    for mesh in &entry.job.meshes {
        add(&mut texts, "curves", &mesh.spec, entry.source)?;
    }
    Ok(texts)
}

fn beside(file: &Path, others: &[PathBuf]) -> Vec<PathBuf> {
    let folder = file.parent().unwrap_or(Path::new(""));
    others.iter().map(|other| folder.join(other)).collect()
}

/// Adds a file, unless it is there; returned is what it holds.
fn add(
    texts: &mut Vec<SourceText>,
    kind: &'static str,
    path: &Path,
    source: &dyn Source,
) -> Result<Vec<u8>, PipelineError> {
    let bytes = source.read(path)?;
    let path = plain(path).display().to_string();
    if texts.iter().all(|text| text.path != path) {
        let text = String::from_utf8_lossy(&bytes).into_owned();
        texts.push(SourceText { kind, path, text });
    }
    Ok(bytes)
}

/// The path without steps up that undo a step down.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        let undoes = matches!(plain.components().next_back(), Some(Component::Normal(_)));
        if part == Component::ParentDir && undoes {
            plain.pop();
        } else {
            plain.push(part);
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_that_undo_each_other_are_not_shown() {
        let shown = |path: &str| plain(Path::new(path)).display().to_string();
        assert_eq!(shown("examples/pages/../curves/a.json"), "examples/curves/a.json");
        assert_eq!(shown("../../b/../a.json"), "../../a.json");
    }
}
