//! The texts in the picture files of a job: the encoding, and the command of `render` that makes them.

use crate::Job;
use render::Settings;
use render::color::Encoding;
use render::film::command::{Named, command};
use render::film::encode::{Bits, Coding};

/// Returns the texts of the file of one picture. `error` is the requested error of its mode, and `alpha` is true if the
/// picture has a coverage.
///
/// `render` states the same for the job's scene and meshes, so that both write equal files.
#[must_use]
pub fn of(job: &Job, settings: &Settings, error: Option<f64>, alpha: bool) -> Coding {
    let scene = job.scene.file_name().unwrap_or(job.scene.as_os_str()).to_string_lossy();
    let meshes: Vec<&str> = job.meshes.iter().map(|mesh| mesh.name.as_str()).collect();
    let error = error.map(|error| error.to_string());
    let named = Named {
        scene: &scene,
        meshes: &meshes,
        set: &job.set,
        look: &[],
        error: error.as_deref(),
        alpha,
        encoding: Encoding::Srgb,
        bits: Bits::Eight,
    };
    Coding { command: Some(command(&named, settings)), ..Coding::new(Encoding::Srgb) }
}
