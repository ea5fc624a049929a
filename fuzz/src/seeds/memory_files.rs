//! Files in memory: those that an input names, and the input itself.

use files::{FileError, Source};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Files by their paths from the root of the repository.
#[derive(Debug, Default)]
pub struct MemoryFiles(BTreeMap<PathBuf, Vec<u8>>);

impl MemoryFiles {
    /// Adds a file, in place of one with the same path.
    pub fn put(&mut self, path: impl Into<PathBuf>, bytes: Vec<u8>) {
        self.0.insert(path.into(), bytes);
    }

    /// Returns these files and one more.
    #[must_use]
    pub fn with<'a>(&'a self, path: &'a str, bytes: &'a [u8]) -> Overlay<'a> {
        Overlay { stored: self, path: Path::new(path), bytes }
    }
}

/// Files in memory and one more file, which hides a file of the same path.
#[derive(Debug)]
pub struct Overlay<'a> {
    stored: &'a MemoryFiles,
    path: &'a Path,
    bytes: &'a [u8],
}

impl Source for Overlay<'_> {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let wanted = files::input::normalized(path);
        if wanted == self.path {
            return Ok(self.bytes.to_vec());
        }
        self.stored.0.get(&wanted).cloned().ok_or_else(|| FileError::Read {
            name: path.display().to_string(),
            source: ErrorKind::NotFound.into(),
        })
    }
}

impl Source for MemoryFiles {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        self.with("", &[]).read(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_laid_over_hides_the_one_below() {
        let mut stored = MemoryFiles::default();
        stored.put("a/b.png", b"below".to_vec());
        let read = |source: &dyn Source| source.read(Path::new("a/c/../b.png")).unwrap();
        assert_eq!(read(&stored), b"below");
        assert_eq!(read(&stored.with("a/b.png", b"over")), b"over");
        assert!(stored.read(Path::new("a/d.png")).is_err());
    }
}
