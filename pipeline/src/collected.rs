//! The files that a job reads: the job itself, its scene with its parts, its specs, meshes and textures.

use crate::run::{self, Options};
use crate::{Job, PipelineError};
use files::{FileError, Source, input};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The bytes of files by their paths, without `.` and `..` in the middle.
pub type Files = BTreeMap<PathBuf, Vec<u8>>;

/// A source that keeps the bytes of each file it reads.
#[derive(Debug)]
struct Keeper<'a> {
    source: &'a dyn Source,
    files: Mutex<Files>,
}

impl Source for Keeper<'_> {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let bytes = self.source.read(path)?;
        let mut files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        files.insert(input::normalized(path), bytes.clone());
        Ok(bytes)
    }

    fn same_but_case(&self, path: &Path) -> Option<PathBuf> {
        self.source.same_but_case(path)
    }
}

/// Returns the files of the job whose file is `path` in `source`. The job's meshes are swept, since only a sweep shows
/// which files its specs read; no picture is made.
///
/// # Errors
/// When a file cannot be read or is wrong.
pub fn files(path: &Path, source: &dyn Source) -> Result<Files, PipelineError> {
    let keeper = Keeper { source, files: Mutex::default() };
    let job = Job::read(path, &keeper)?;
    let options = Options { folder: PathBuf::new(), size: (1, 1), keep: false, clobber: false };
    run::scene(&job, &keeper, &options, &|_| {})?;
    Ok(keeper.files.into_inner().unwrap_or_else(PoisonError::into_inner))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pages;

    #[test]
    fn the_files_of_a_page_are_its_job_scene_specs_and_textures() {
        let files = files(&pages::path("vase"), &pages::FILES).unwrap();
        let names: Vec<&str> = files.keys().filter_map(|path| path.to_str()).collect();
        for name in
            ["examples/pages/vase.json", "examples/scenes/vase.json", "examples/curves/vase.json"]
        {
            assert!(names.contains(&name), "{names:?}");
        }
        assert!(names.iter().any(|name| name.ends_with(".png")), "{names:?}");
        for (path, bytes) in &files {
            assert_eq!(&pages::FILES.read(path).unwrap(), bytes);
        }
    }
}
