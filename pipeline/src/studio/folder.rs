//! The opened folder: the only files that the studio reads and writes.
//!
//! Paths are relative to the folder and use `/`. A path that leads out of the folder is refused, whether by `..` or by a
//! link. The check resolves all links of the longest part of the path that exists.

use files::input::normalized;
use files::words::shown;
use files::{Disk, FileError, Output, Source};
use std::io;
use std::path::{Component, Path, PathBuf};
use std::time::SystemTime;

/// Most files that a listing holds.
const MOST_LISTED: usize = 2000;

/// Most folders below each other that a listing enters.
const DEEPEST: usize = 6;

/// A folder on disk, with all links resolved.
#[derive(Debug, Clone)]
pub struct Folder {
    root: PathBuf,
}

/// The size and the time of a file, by which a change is noticed.
pub type Stamp = (u64, Option<SystemTime>);

impl Folder {
    /// Opens a folder.
    ///
    /// # Errors
    /// When there is no such folder.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        let failed = |source| FileError::Read { name: path.display().to_string(), source };
        let root = path.canonicalize().map_err(failed)?;
        if !root.is_dir() {
            return Err(FileError::NotRegular {
                name: path.display().to_string(),
                found: "a file where a folder is expected",
            });
        }
        Ok(Self { root })
    }

    /// The folder with all links resolved.
    #[must_use]
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Returns the path on disk of a path in the folder.
    ///
    /// # Errors
    /// When the path leads out of the folder, or cannot be resolved.
    pub fn inside(&self, path: &Path) -> Result<PathBuf, FileError> {
        let refused = |why: &str| FileError::Read {
            name: path.display().to_string(),
            source: io::Error::new(io::ErrorKind::PermissionDenied, why.to_owned()),
        };
        let path = normalized(path);
        let plain = |component: Component<'_>| matches!(component, Component::Normal(_));
        if path.as_os_str().is_empty() || !path.components().all(plain) {
            return Err(refused("it lies outside of the opened folder; start with --folder"));
        }
        let whole = self.root.join(&path);
        // The longest part that exists, links included: what is missing cannot lead elsewhere.
        let exists = |part: &&Path| part.symlink_metadata().is_ok();
        let there = whole.ancestors().find(exists).unwrap_or(&self.root);
        let resolved = there.canonicalize().map_err(|_| refused("it is a link to nothing"))?;
        if !resolved.starts_with(&self.root) {
            return Err(refused("it is a link that leads out of the opened folder"));
        }
        Ok(whole)
    }

    /// Replaces a file by a whole one, and creates the folders above it.
    ///
    /// # Errors
    /// When the path leads out of the folder, or the file cannot be written; the old file then stays.
    pub fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        let target = self.inside(path)?;
        if let Some(folder) = target.parent() {
            let failed = |source| FileError::Write { name: folder.display().to_string(), source };
            std::fs::create_dir_all(folder).map_err(failed)?;
        }
        Output::create(&target, true)?.commit_all(bytes)
    }

    /// Returns size and time of a file, or `None` if there is none.
    #[must_use]
    pub fn stamp(&self, path: &Path) -> Option<Stamp> {
        let found = std::fs::metadata(self.inside(path).ok()?).ok()?;
        Some((found.len(), found.modified().ok()))
    }

    /// Returns the paths of the JSON files in the folder, sorted. Hidden folders, links and folders of build results are
    /// not entered.
    #[must_use]
    pub fn listed(&self) -> Vec<String> {
        let mut found = Vec::new();
        self.list(Path::new(""), 0, &mut found);
        found.sort();
        found
    }

    fn list(&self, below: &Path, depth: usize, found: &mut Vec<String>) {
        let Ok(entries) = std::fs::read_dir(self.root.join(below)) else { return };
        for entry in entries.flatten() {
            let (name, Ok(kind)) = (entry.file_name(), entry.file_type()) else { continue };
            let Some(name) = name.to_str() else { continue };
            if found.len() >= MOST_LISTED || name.starts_with('.') {
                continue;
            }
            let path = below.join(name);
            if kind.is_dir() && depth < DEEPEST && !matches!(name, "target" | "node_modules") {
                self.list(&path, depth + 1, found);
            } else if kind.is_file() && name.ends_with(".json") {
                found.push(slashed(&path));
            }
        }
    }
}

impl Source for Folder {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let whole = self.inside(path)?;
        // Messages name the path in the folder.
        Disk.read(&whole).map_err(|error| match error {
            FileError::Read { source, .. } => {
                FileError::Read { name: shown(&slashed(path)).to_string(), source }
            }
            other => other,
        })
    }
}

/// Returns a path with `/` between its names, without `.` and `..`.
#[must_use]
pub fn slashed(path: &Path) -> String {
    let path = normalized(path);
    let names: Vec<_> = path.components().map(|name| name.as_os_str().to_string_lossy()).collect();
    names.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn nothing_outside_of_the_folder_is_read_or_written() {
        let whole = tempfile::tempdir().unwrap();
        let inner = whole.path().join("mine");
        fs::create_dir(&inner).unwrap();
        fs::write(whole.path().join("secret.json"), "secret").unwrap();
        fs::write(inner.join("a.json"), "mine").unwrap();
        let folder = Folder::open(&inner).unwrap();
        assert_eq!(folder.read(Path::new("b/../a.json")).unwrap(), b"mine");
        let absolute = whole.path().join("secret.json");
        for path in [Path::new("../secret.json"), Path::new("b/../../secret.json"), &absolute] {
            let error = folder.read(path).unwrap_err().to_string();
            assert!(error.contains("outside of the opened folder"), "{error}");
            assert!(folder.write(path, b"x").is_err());
        }
        #[cfg(unix)]
        {
            use std::os::unix::fs::symlink;
            symlink(whole.path(), inner.join("up")).unwrap();
            symlink(&absolute, inner.join("link.json")).unwrap();
            symlink(whole.path().join("new.json"), inner.join("dangling.json")).unwrap();
            for path in ["up/secret.json", "link.json", "up/new.json", "dangling.json"] {
                assert!(folder.read(Path::new(path)).is_err(), "{path}");
                assert!(folder.write(Path::new(path), b"x").is_err(), "{path}");
            }
            assert!(!whole.path().join("new.json").exists());
        }
        assert_eq!(fs::read(&absolute).unwrap(), b"secret");
        assert_eq!(folder.listed(), ["a.json"]);
    }
}
