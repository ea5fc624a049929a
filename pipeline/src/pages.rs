//! The pages built into the program: jobs with their specs, scenes and textures.
//!
//! They are the files of `examples/`, under the same paths, so that they work in an empty folder
//! and can be read as models for one's own.

use crate::{Job, PipelineError};
use files::Embedded;
use files::json::nearest;
use std::path::{Path, PathBuf};

macro_rules! examples {
    ($($path:literal),* $(,)?) => {
        &[$((
            concat!("examples/", $path),
            include_bytes!(concat!("../../examples/", $path)).as_slice(),
        )),*]
    };
}

/// The files built in.
pub const FILES: Embedded = Embedded(examples![
    "curves/vase.json",
    "pages/glass-sphere.json",
    "pages/vase.json",
    "scenes/glass-sphere.json",
    "scenes/vase.json",
    "textures/checkerboard.png",
    "textures/floor-tiles.png",
    "textures/vase-band.png",
]);

/// Where the jobs lie among the files.
const FOLDER: &str = "examples/pages";

/// The names of the pages, in alphabetical order.
#[must_use]
pub fn names() -> Vec<&'static str> {
    let jobs = FILES.0.iter().map(|(path, _)| Path::new(path));
    jobs.filter(|path| path.parent() == Some(Path::new(FOLDER)))
        .filter_map(|path| path.file_stem()?.to_str())
        .collect()
}

/// The job of a page.
///
/// # Errors
/// When there is no page of that name; with the names there are.
pub fn page(name: &str) -> Result<Job, PipelineError> {
    let names = names();
    if !names.contains(&name) {
        let mut known = names.join(", ");
        if let Some(near) = nearest(name, names.iter().copied()) {
            known.push_str(&format!(" (did you mean {near}?)"));
        }
        return Err(PipelineError::UnknownPage { name: name.into(), known });
    }
    let path: PathBuf = [FOLDER, &format!("{name}.json")].iter().collect();
    Job::read(&path, &FILES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_page_in_examples_is_built_in() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/pages");
        let mut on_disk: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_string())
            .collect();
        on_disk.sort();
        assert_eq!(names(), on_disk);
    }

    #[test]
    fn a_near_miss_is_met_with_a_suggestion() {
        let error = page("glas-sphere").unwrap_err().to_string();
        assert!(error.contains("did you mean glass-sphere?"), "{error}");
        assert!(page("x").unwrap_err().to_string().contains("glass-sphere, vase;"));
    }

    #[test]
    fn every_page_has_a_title() {
        for name in names() {
            assert!(!page(name).unwrap().title.is_empty(), "{name}");
        }
    }
}
