//! Runs the frames of a job's animation.
//!
//! Each frame has the picture that `pipeline run` makes of a job with the frame's values set. If only the camera
//! moves, the scene is read once, with the camera of the first frame: meshes, trees and tables are those of
//! this frame, whichever frames are made. Otherwise each frame is a scene of its own, which takes meshes, trees and
//! tables that do not change from the frame before.

use super::{Event, Options, Run, Shared, settings};
use crate::animation::digest::{Digest, Recorded, is_complete};
use crate::animation::{Animation, scene_text};
use crate::fineness::Fineness;
use crate::job::{Mode, Parts};
use crate::run::requested::Meshes;
use crate::settings::Changed;
use crate::stages::Stages;
use crate::{Job, PipelineError};
use files::json::Document;
use files::{Batch, FileError, Setting, Source, input};
use render::film::join::{join, join_without_digest};
use render::scene::read;
use render::{Prepared, Scene, Stock};
use std::fs;
use std::io::Write;
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
/// If the job makes its pictures in parts ([`Job::parts`]), one part of each is made, or all of them are joined. Parts that
/// are missing are made first.
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
    let height = options.size.1;
    if let Some(Parts { count, .. }) = job.parts.filter(|parts| parts.count > height) {
        return Err(PipelineError::ThinParts { count, height });
    }
    let mut stages = Stages::default();
    let (shared, mut before) = (Shared::default(), None::<(Scene, Stock)>);
    let first = frame((job, animation), source, wanted.settings, 1)?;
    let recorded = Recorded::new(&first.source);
    let run = Run { shared: Some(&shared), ..Run::new(&first.job, &recorded, options, tell) };
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
        let left = |job: &Job| left(job, inputs, wanted, options, tell);
        let wholes = left(&frame.job);
        let parts = job.parts.filter(|parts| parts.number.is_none());
        let jobs: Vec<Job> = match parts {
            // Only pictures that are not whole need their parts.
            Some(parts) if !wholes.is_empty() => parts
                .each()
                .map(|part| Job { modes: wholes.clone(), parts: Some(part), ..frame.job.clone() })
                .map(|part| Job { modes: left(&part), ..part })
                .collect(),
            Some(_) => Vec::new(),
            None => vec![Job { modes: wholes.clone(), ..frame.job.clone() }],
        };
        let batch = Batch::new(&options.folder, &format!("{}.{number:04}", job.name), &[])?;
        for job in jobs.iter().filter(|job| !job.modes.is_empty()) {
            let run = Run::new(job, &frame.source, options, tell);
            run.kinds.set(kinds);
            let camera = if once { Some(camera(&frame)?) } else { None };
            let shared = Some(&shared);
            let run = Run { batch: Some(&batch), inputs: Some(inputs), camera, shared, ..run };
            if once {
                run.pictures(&prepared, finer.as_ref())?;
            } else {
                let scene = run.scene(Fineness::Stated)?;
                let finer = run.finer()?;
                let stock = before.take().map(|(before, stock)| stock.between(&before, &scene));
                let prepared = Prepared::stocked(&scene, stock.unwrap_or_default());
                run.pictures(&prepared, finer.as_ref().map(Prepared::new).as_ref())?;
                let stock = prepared.into_stock();
                before = Some((scene, stock));
            }
            stages += run.stages.get();
        }
        if let Some(parts) = parts {
            let run = Run { batch: Some(&batch), ..Run::new(&frame.job, source, options, tell) };
            wholes.iter().try_for_each(|mode| run.join(mode, parts))?;
        }
        shared.forget_unused();
        batch.finish()?;
    }
    Ok(stages)
}

impl Run<'_> {
    /// Makes the pictures of all modes.
    fn pictures<'s>(
        &self,
        prepared: &Prepared<'s>,
        finer: Option<&Prepared<'s>>,
    ) -> Result<(), PipelineError> {
        for mode in &self.job.modes {
            self.picture(prepared, Meshes::Fine(finer), mode, Duration::ZERO)?;
        }
        Ok(())
    }

    /// Joins the parts of a mode's picture, whose files are complete.
    fn join(&self, mode: &Mode, parts: Parts) -> Result<(), PipelineError> {
        let Some(batch) = self.batch else { return Ok(()) };
        let files = parts.each().map(|part| {
            let job = Job { parts: Some(part), ..self.job.clone() };
            let path = self.options.folder.join(job.picture_file(mode));
            let name = path.display().to_string();
            let bytes =
                fs::read(&path).map_err(|source| FileError::Read { name: name.clone(), source })?;
            Ok((name, bytes))
        });
        let files = files.collect::<Result<Vec<_>, FileError>>()?;
        // A picture that is made at once states no digest unless it is a frame.
        let is_frame = self.job.frame.is_some();
        let bytes = if is_frame { join(&files)? } else { join_without_digest(&files)? };
        let size = Some(self.options.size);
        self.write((batch, &self.job.picture_file(mode), size), |out| {
            out.write_all(&bytes).map_err(|source| out.failed(source).into())
        })
    }
}

/// Returns the modes of a frame whose pictures are not complete. A part is not needed if its whole picture is.
fn left(
    job: &Job,
    inputs: Digest,
    wanted: Wanted<'_>,
    options: &Options,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Vec<Mode> {
    let mut left = Vec::new();
    let whole =
        job.parts.map(|parts| Job { parts: Some(Parts { number: None, ..parts }), ..job.clone() });
    for mode in &job.modes {
        let text = inputs.of_picture(job, mode, &settings(mode, options.size));
        let complete = |job: &Job| {
            let path = options.folder.join(job.picture_file(mode));
            is_complete(&path, &text).then_some(path)
        };
        match complete(job).or_else(|| complete(whole.as_ref()?)).filter(|_| !wanted.again) {
            Some(path) => tell(Event::Kept(&path)),
            None => left.push(mode.clone()),
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
