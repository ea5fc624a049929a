//! The files that a page is made of, as text.

use super::Entry;
use crate::PipelineError;
use files::Source;
use files::json::Document;
use render::scene::file::{PartFile, SceneFile};
use std::collections::HashSet;
use std::path::{Component, Path, PathBuf};

/// A file of a page.
#[derive(Debug)]
pub struct SourceText {
    /// The kind of the file: `job`, `scene`, `part of the scene` or `curves`.
    pub kind: &'static str,
    /// The path of the file.
    pub path: String,
    /// The content of the file.
    pub text: String,
}

/// Returns the texts of the job file, of its scene with the parts that it includes, and of its specs.
/// Each file occurs once.
///
/// # Errors
/// When a file cannot be read, or the scene is malformed.
pub fn texts(entry: &Entry<'_>) -> Result<Vec<SourceText>, PipelineError> {
    let mut texts = Texts { source: entry.source, known: HashSet::new(), texts: Vec::new() };
    texts.add("job", entry.path)?;
    let scene = &entry.job.scene;
    if let Some(bytes) = texts.add("scene", scene)? {
        let name = scene.display().to_string();
        let file: SceneFile = Document::new(&name, &bytes)?.parse()?;
        let mut included = beside(scene, &file.include);
        let mut at = 0;
        while let Some(path) = included.get(at).cloned() {
            at += 1;
            let Some(bytes) = texts.add("part of the scene", &path)? else { continue };
            let name = path.display().to_string();
            let part: PartFile = Document::new(&name, &bytes)?.parse()?;
            included.extend(beside(&path, &part.include));
        }
    }
    for mesh in &entry.job.meshes {
        texts.add("curves", &mesh.spec)?;
    }
    Ok(texts.texts)
}

/// Returns the paths that `file` names, from the folder of `file` and without detours.
fn beside(file: &Path, others: &[PathBuf]) -> Vec<PathBuf> {
    let folder = file.parent().unwrap_or(Path::new(""));
    others.iter().map(|other| plain(&folder.join(other))).collect()
}

/// Texts gathered so far.
struct Texts<'a> {
    source: &'a dyn Source,
    /// The paths of the texts, without detours.
    known: HashSet<PathBuf>,
    texts: Vec<SourceText>,
}

impl Texts<'_> {
    /// Reads and adds a file, and returns its bytes. Returns `None` if the file was added before.
    fn add(&mut self, kind: &'static str, path: &Path) -> Result<Option<Vec<u8>>, PipelineError> {
        let plain = plain(path);
        if self.known.contains(&plain) {
            return Ok(None);
        }
        let bytes = self.source.read(path)?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        self.texts.push(SourceText { kind, path: plain.display().to_string(), text });
        self.known.insert(plain);
        Ok(Some(bytes))
    }
}

/// Returns the path without steps up that undo a step down.
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
    use crate::Job;
    use files::FileError;
    use std::collections::BTreeMap;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn steps_that_undo_each_other_are_not_shown() {
        let shown = |path: &str| plain(Path::new(path)).display().to_string();
        assert_eq!(shown("examples/pages/../curves/a.json"), "examples/curves/a.json");
        assert_eq!(shown("../../b/../a.json"), "../../a.json");
    }

    /// A source that counts the files read.
    #[derive(Debug, Default)]
    struct Counted {
        files: BTreeMap<PathBuf, String>,
        reads: AtomicUsize,
    }

    impl Source for Counted {
        fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
            self.reads.fetch_add(1, Ordering::Relaxed);
            Ok(self.files[&files::input::normalized(path)].clone().into_bytes())
        }
    }

    #[test]
    fn parts_that_include_each_other_crosswise_are_read_and_shown_once_each() {
        const LEVELS: usize = 12;
        let mut source = Counted::default();
        let next = |level: usize| {
            ["a", "b", "c"].map(|other| format!("\"../{other}/{level}.json\"")).join(", ")
        };
        let mut file = |path: &str, text: String| {
            source.files.insert(path.into(), text);
        };
        for level in 0..LEVELS {
            let include = if level + 1 < LEVELS { next(level + 1) } else { String::new() };
            let head = r#""format": "tb-scene-part", "version": 1"#;
            for folder in ["a", "b", "c"] {
                let text = format!(r#"{{ {head}, "include": [{include}] }}"#);
                file(&format!("{folder}/{level}.json"), text);
            }
        }
        let camera = r#""camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 60 }"#;
        let head = r#""format": "tb-scene", "version": 1"#;
        let scene = format!(r#"{{ {head}, {camera}, "include": [{}], "objects": [] }}"#, next(0));
        file("s/scene.json", scene);
        let job = r#"{ "format": "tb-job", "version": 1, "scene": "scene.json" }"#;
        file("s/job.json", job.into());
        let path = Path::new("s/job.json");
        let job = Job::read(path, &source).unwrap();
        let before = source.reads.load(Ordering::Relaxed);
        let entry = Entry { job: &job, path, source: &source, argument: "s/job.json" };
        assert_eq!(texts(&entry).unwrap().len(), 3 * LEVELS + 2);
        assert_eq!(source.reads.load(Ordering::Relaxed) - before, 3 * LEVELS + 2);
    }
}
