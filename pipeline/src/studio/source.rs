//! The files of a job as they are edited: the opened texts, over the files of the folder.

use super::folder::{Folder, slashed};
use files::{FileError, Source};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// The opened texts over the folder.
#[derive(Debug, Clone)]
pub struct Edited {
    /// The texts by path.
    pub texts: BTreeMap<String, Arc<str>>,
    /// The folder of all other files.
    pub folder: Folder,
}

impl Source for Edited {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        match self.texts.get(&slashed(path)) {
            Some(text) => Ok(text.as_bytes().to_vec()),
            None => self.folder.read(path),
        }
    }
}
