//! Reads jobs, with the specs and scenes that they name.

use super::scene::picture;
use crate::seeds::memory_files::MemoryFiles;
use crate::seeds::{PAGES, small};
use crate::verdict::{Tried, refused};
use files::Source;
use pipeline::Job;
use pipeline::run::{self, Options};
use std::path::{Path, PathBuf};

/// The path of the tried job.
const PATH: &str = "examples/pages/tried.json";

/// Largest number of modes of a job that are rendered.
const MOST_MODES: usize = 2;

/// Reads a job, makes its meshes and its scene, and renders it in some of its modes.
///
/// # Errors
/// When the job is refused, or a picture is wrong.
pub fn read(bytes: &[u8], stored: &MemoryFiles) -> Tried {
    debug_assert!(Path::new(PATH).starts_with(PAGES));
    let source = stored.with(PATH, bytes);
    let job = Job::read(Path::new(PATH), &source).map_err(refused)?;
    if small::asks_for_much(bytes) {
        return Ok(());
    }
    make(&job, &source)
}

fn make(job: &Job, source: &dyn Source) -> Tried {
    let options = Options { folder: PathBuf::new(), size: (6, 5), keep: false, clobber: false };
    let scene = run::scene(job, source, &options, &|_| {}).map_err(refused)?;
    for mode in job.modes.iter().take(MOST_MODES) {
        picture(scene.clone(), mode.filter)?;
    }
    Ok(())
}
