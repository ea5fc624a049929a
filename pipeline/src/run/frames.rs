//! Runs the frames of a job's animation.
//!
//! Each frame has the picture that `pipeline run` makes of a job with the frame's values set. If only the camera
//! moves, the scene is read once, with the camera of the first frame: meshes, trees and tables are those of
//! this frame, whichever frames are made. Otherwise each frame is a scene of its own.

use super::{Event, Options, Run, settings};
use crate::animation::digest::{Digest, Recorded, is_complete};
use crate::animation::{Animation, scene_text};
use crate::fineness::Fineness;
use crate::job::Mode;
use crate::run::requested::Meshes;
use crate::settings::Changed;
use crate::stages::Stages;
use crate::{Job, PipelineError};
use files::json::Document;
use files::{Batch, Setting, Source, input};
use render::Prepared;
use render::scene::read;
use std::time::Duration;

/// The frames to be made.
#[derive(Debug, Clone, Copy)]
pub struct Wanted<'a> {
    /// Their numbers, from 1.
    pub frames: &'a [u32],
    /// Values that the command line sets.
    pub settings: &'a [Setting],
    /// True if complete frames of the same inputs are made again.
    pub again: bool,
}

/// A frame with its source.
struct Frame<'a> {
    job: Job,
    source: Changed<'a>,
    /// The values that are set, as text.
    text: String,
}

/// Makes the pictures of frames in all modes of a job. A picture file that exists, is whole and was made of the same
/// inputs is kept. Returns the time of each stage.
///
/// # Errors
/// On the first fault. Frames already written stay.
pub fn run_frames(
    (job, animation): (&Job, &Animation),
    source: &dyn Source,
    wanted: Wanted<'_>,
    options: &Options,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Result<Stages, PipelineError> {
    let mut stages = Stages::default();
    let first = frame((job, animation), source, wanted.settings, 1)?;
    let recorded = Recorded::new(&first.source);
    let run = Run::new(&first.job, &recorded, options, tell);
    // The scene of the first frame shows which files are read.
    let scene = run.scene(Fineness::Stated)?;
    let inputs = recorded.digest();
    let once = animation.moves_camera_only();
    let finer = if once { run.finer()? } else { None };
    let prepared = Prepared::new(&scene);
    let finer = finer.as_ref().map(Prepared::new);
    let kinds = run.kinds.get();
    let _reserved = run.reserve_pictures(scene.is_transparent)?;
    stages += run.stages.get();
    for &number in wanted.frames {
        let frame = frame((job, animation), source, wanted.settings, number)?;
        let inputs = inputs.and(frame.text.as_bytes());
        let left = left(&frame.job, inputs, wanted, options, tell);
        if left.is_empty() {
            continue;
        }
        let frame = Frame { job: Job { modes: left, ..frame.job }, ..frame };
        let batch = Batch::new(&options.folder, &format!("{}.{number:04}", job.name), &[])?;
        let run = Run::new(&frame.job, &frame.source, options, tell);
        run.kinds.set(kinds);
        let camera = if once { Some(camera(&frame)?) } else { None };
        let run = Run { batch: Some(&batch), inputs: Some(inputs), camera, ..run };
        if once {
            for mode in &frame.job.modes {
                run.picture(&prepared, Meshes::Fine(finer.as_ref()), mode, Duration::ZERO)?;
            }
        } else {
            let scene = run.scene(Fineness::Stated)?;
            let finer = run.finer()?;
            let (prepared, finer) = (Prepared::new(&scene), finer.as_ref().map(Prepared::new));
            for mode in &frame.job.modes {
                run.picture(&prepared, Meshes::Fine(finer.as_ref()), mode, Duration::ZERO)?;
            }
        }
        stages += run.stages.get();
        batch.finish()?;
    }
    Ok(stages)
}

/// Returns the modes of a frame whose pictures are not complete.
fn left(
    job: &Job,
    inputs: Digest,
    wanted: Wanted<'_>,
    options: &Options,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Vec<Mode> {
    let mut left = Vec::new();
    for mode in &job.modes {
        let path = options.folder.join(job.picture_file(mode));
        let text = inputs.of_picture(job, mode, &settings(mode, options.size));
        if !wanted.again && is_complete(&path, &text) {
            tell(Event::Kept(&path));
        } else {
            left.push(mode.clone());
        }
    }
    left
}

/// Returns a frame of a job.
fn frame<'a>(
    (job, animation): (&Job, &Animation),
    source: &'a dyn Source,
    settings: &[Setting],
    number: u32,
) -> Result<Frame<'a>, PipelineError> {
    let changed = |own: &[Setting]| {
        let all: Vec<Setting> = settings.iter().chain(own).cloned().collect();
        Changed::parts(source, job, &all)
    };
    let own = animation.settings(number, |laws| scene_text(job, &changed(laws)?))?;
    let text: Vec<String> = own.iter().map(Setting::text).collect();
    let source = changed(&own)?;
    Ok(Frame { job: animation.job(job, number, &own), source, text: text.join("\n") })
}

/// Returns the camera of a frame.
fn camera(frame: &Frame<'_>) -> Result<render::scene::Camera, PipelineError> {
    let bytes = scene_text(&frame.job, &frame.source)?;
    let name = input::name_of(&frame.job.scene);
    let document = Document::new(&name, &bytes)?;
    Ok(read::camera_of(&document, &read::parse(&document)?)?)
}
