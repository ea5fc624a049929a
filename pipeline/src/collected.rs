//! The files that a job reads: the job itself, its scene with its parts, its specs, meshes and textures.

use crate::run::{self, Options};
use crate::{Job, PipelineError};
use files::{Disk, FileError, Source, input};
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

/// Returns paths relative to the deepest folder that contains them all.
#[must_use]
pub fn placed<'p>(paths: impl Iterator<Item = &'p PathBuf>) -> Vec<PathBuf> {
    let here = std::env::current_dir().unwrap_or_default();
    let whole: Vec<PathBuf> = paths.map(|path| input::normalized(&here.join(path))).collect();
    let mut common = whole.first().and_then(|path| path.parent()).unwrap_or(Path::new(""));
    while !whole.iter().all(|path| path.starts_with(common)) {
        common = common.parent().unwrap_or(Path::new(""));
    }
    whole.iter().map(|path| path.strip_prefix(common).unwrap_or(path).to_path_buf()).collect()
}

/// Returns a file outside of `folder` that the job at `path` reads, if there is one.
///
/// # Errors
/// When a file cannot be read or is wrong.
pub fn outside(path: &Path, folder: &Path) -> Result<Option<PathBuf>, PipelineError> {
    let folder = input::normalized(folder);
    let mut all = files(path, &Disk)?.into_keys();
    Ok(all.find(|path| !path.starts_with(&folder)))
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

    #[test]
    fn files_keep_the_folders_between_them() {
        let of = |paths: &[&str]| -> Vec<String> {
            let paths: Vec<PathBuf> = paths.iter().map(PathBuf::from).collect();
            placed(paths.iter()).iter().map(|path| path.display().to_string()).collect()
        };
        assert_eq!(of(&["a/jobs/b.json", "a/scenes/c.json"]), ["jobs/b.json", "scenes/c.json"]);
        assert_eq!(of(&["../x/b.json", "a.json"]).len(), 2);
        assert_eq!(of(&["/q/b.json", "/q/c/d.json"]), ["b.json", "c/d.json"]);
        assert_eq!(of(&["b.json"]), ["b.json"]);
    }
}
