//! The start page: the files of the opened folder, the built-in pages, and copies of them.

use super::folder::{Folder, slashed};
use super::opened::Kind;
use crate::{collected, pages};
use files::Source;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Most bytes of a file whose kind is looked up.
const LONGEST: u64 = 1 << 20;

/// A vase-like bowl, with which an empty page begins.
const NEW: &str = r#"{
  "format": "tb-sweep", "version": 1, "name": "NAME",
  "contour": {
    "bezier": {
      "segments": [
        [[0, 0], [0.25, 0], [0.5, 0.05], [0.5, 0.35]],
        [[0.5, 0.35], [0.5, 0.65], [0.3, 0.75], [0.35, 1.1]]
      ]
    }
  },
  "trajectory": { "rotation": { "angle_deg": 360 } },
  "mesh": { "rows": 96, "cols": 64 },
  "uv": { "across": "trajectory" }
}
"#;

/// Returns the contents of the start page.
#[must_use]
pub fn listed(folder: &Folder) -> Value {
    let kind = |path: &String| {
        let (length, _) = folder.stamp(Path::new(path))?;
        let bytes = (length <= LONGEST).then(|| folder.read(Path::new(path)).ok())??;
        let kind = Kind::of(std::str::from_utf8(&bytes).ok()?)?;
        Some(json!({ "path": path, "kind": kind.word() }))
    };
    let files: Vec<Value> = folder.listed().iter().filter_map(kind).collect();
    let pages = pages::in_order().unwrap_or_default();
    let pages: Vec<Value> =
        pages.iter().map(|job| json!({ "name": job.name, "title": job.title })).collect();
    let name = folder.root().file_name().unwrap_or_default().to_string_lossy();
    json!({ "folder": name, "files": files, "pages": pages })
}

/// Writes the files of a built-in page into a new folder of the opened one. Returns the path of its job.
///
/// # Errors
/// When there is no such page, or a file cannot be written. The error is a sentence.
pub fn copy(folder: &Folder, page: &str) -> Result<String, String> {
    let job = pages::page(page).map_err(|error| error.to_string())?;
    let files = collected::files(&pages::path(&job.name), &pages::FILES);
    let files = files.map_err(|error| error.to_string())?;
    let target = free(folder, &job.name, "");
    let below = |path: &Path| target.join(path.strip_prefix("examples").unwrap_or(path));
    for (path, bytes) in &files {
        folder.write(&below(path), bytes).map_err(|error| error.to_string())?;
    }
    Ok(slashed(&below(&pages::path(&job.name))))
}

/// Writes a new spec. Returns its path.
///
/// # Errors
/// When the name is no word, or the file cannot be written. The error is a sentence.
pub fn new(folder: &Folder, name: &str) -> Result<String, String> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if name.is_empty() || name.len() > 60 || !name.chars().all(is_plain) {
        return Err("expected a name of letters, digits, - and _".into());
    }
    let path = free(folder, name, ".json");
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let text = NEW.replace("NAME", &stem);
    folder.write(&path, text.as_bytes()).map_err(|error| error.to_string())?;
    Ok(slashed(&path))
}

/// Returns a path that nothing has yet: the name, or the name with a number.
fn free(folder: &Folder, name: &str, end: &str) -> PathBuf {
    let candidate = |k: u32| match k {
        1 => PathBuf::from(format!("{name}{end}")),
        k => PathBuf::from(format!("{name}-{k}{end}")),
    };
    let is_free = |path: &PathBuf| folder.stamp(path).is_none();
    (1..).map(candidate).find(is_free).unwrap_or_else(|| candidate(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_and_new_files_replace_nothing() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(place.path()).unwrap();
        assert_eq!(copy(&folder, "vase").unwrap(), "vase/pages/vase.json");
        assert_eq!(copy(&folder, "vase").unwrap(), "vase-2/pages/vase.json");
        assert!(copy(&folder, "vaze").unwrap_err().contains("did you mean vase?"));
        assert_eq!(new(&folder, "bowl").unwrap(), "bowl.json");
        assert_eq!(new(&folder, "bowl").unwrap(), "bowl-2.json");
        assert!(new(&folder, "../bowl").is_err());
        let files = listed(&folder);
        let found: Vec<&str> = files["files"]
            .as_array()
            .unwrap()
            .iter()
            .map(|f| f["kind"].as_str().unwrap())
            .collect();
        assert_eq!(found.iter().filter(|kind| **kind == "spec").count(), 4);
        assert_eq!(found.iter().filter(|kind| **kind == "job").count(), 2);
    }
}
