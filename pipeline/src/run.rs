//! Runs a job: from specs to grids, meshes and pictures.

pub mod frames;
mod requested;
mod scene;
mod shared;

pub use requested::Accuracy;
pub use shared::Shared;

use crate::animation::digest::Digest;
use crate::fineness::{Fineness, Kinds};
use crate::job::Mode;
use crate::stages::Stages;
use crate::{Job, PipelineError};
use files::memory::{Reserved, of_process};
use files::{Batch, MemoryError, Output, Source};
use render::color::Encoding;
use render::film::encode::{self, Coding, Format};
use render::film::{BasePicture, PixelFilter, memory};
use render::scene::Camera;
use render::stats::Stats;
use render::{Picture, Prepared, Scene, Settings};
use requested::Meshes;
use std::cell::Cell;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// White between the pictures of a strip, in pixels.
const GAP: u32 = 8;

/// The folder of a job's results, and their size.
#[derive(Debug, Clone)]
pub struct Options {
    /// The folder for all files. The folder must exist.
    pub folder: PathBuf,
    /// Width and height of each picture, in pixels.
    pub size: (u32, u32),
    /// True if grids and OBJ files are written too.
    pub keep: bool,
    /// True if existing files are replaced.
    pub clobber: bool,
}

/// An event in the course of a job.
#[derive(Debug)]
pub enum Event<'a> {
    /// A mesh is made.
    Mesh {
        /// The name of the mesh in the scene.
        name: &'a str,
        /// The number of triangles.
        triangles: usize,
        /// The time for its grid.
        sweep: Duration,
        /// The time for its triangles.
        triangulate: Duration,
        /// A sentence on the tolerance, if it is missed.
        missed: Option<String>,
    },
    /// A part of a mode's picture is done.
    Progress {
        /// The mode.
        mode: &'a str,
        /// Tiles done, of `total`.
        done: usize,
        /// All tiles.
        total: usize,
    },
    /// A mode's picture is done.
    Picture {
        /// The mode.
        mode: &'a str,
        /// The picture.
        picture: &'a Picture,
        /// The counts and times of the picture.
        stats: &'a Stats,
        /// The error that was reached, if the mode requests one.
        accuracy: Option<&'a Accuracy>,
    },
    /// A file is written.
    Written {
        /// Its path.
        path: &'a Path,
        /// Width and height in pixels, if the file is a picture.
        size: Option<(u32, u32)>,
    },
    /// A file of these inputs exists and is kept.
    Kept(&'a Path),
}

/// Runs a job, whose files are read from `source`.
///
/// Each mode gives a picture `JOB-MODE.png`; several modes also give `JOB.png`, all of them side by
/// side. With `keep`, each mesh gives `JOB-MESH.grid` and `JOB-MESH.obj`, the bytes that the programs
/// would have piped. Returns the time of each stage.
///
/// # Errors
/// On the first fault. Files already written stay, and so does their marker (see [`Batch`]).
pub fn run(
    job: &Job,
    source: &dyn Source,
    options: &Options,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Result<Stages, PipelineError> {
    let batch = batch(job, options)?;
    let stages = run_in(&batch, job, source, options, tell)?;
    batch.finish()?;
    Ok(stages)
}

/// Returns the batch of a job's files. Their marker is `JOB.incomplete`.
///
/// # Errors
/// When another file than a marker has the marker's name.
pub fn batch<'a>(job: &Job, options: &Options) -> Result<Batch<'a>, PipelineError> {
    let files = job.files(options.keep).into_iter().map(|file| options.folder.join(file));
    Ok(Batch::new(&options.folder, &job.name, &files.collect::<Vec<_>>())?)
}

/// Runs a job as [`run()`] does, with its files in a batch that stays unfinished.
///
/// # Errors
/// See [`run()`].
pub fn run_in(
    batch: &Batch<'_>,
    job: &Job,
    source: &dyn Source,
    options: &Options,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Result<Stages, PipelineError> {
    run_sharing(batch, job, source, options, None, tell)
}

/// Runs a job as [`run_in`] does, with the meshes that `shared` has. It keeps the others for the jobs that follow.
///
/// # Errors
/// See [`run()`].
pub fn run_sharing(
    batch: &Batch<'_>,
    job: &Job,
    source: &dyn Source,
    options: &Options,
    shared: Option<&Shared>,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Result<Stages, PipelineError> {
    let run = Run { batch: Some(batch), shared, ..Run::new(job, source, options, tell) };
    let scene = run.scene(Fineness::Stated)?;
    // Sweeping and triangulating are stages of their own.
    let read_time = run.stages.get().read;
    let _reserved = run.reserve_pictures(scene.is_transparent)?;
    let finer = run.finer()?;
    let (prepared, finer) = (Prepared::new(&scene), finer.as_ref().map(Prepared::new));
    let meshes = Meshes::Fine(finer.as_ref());
    let mut pictures = Vec::with_capacity(job.modes.len());
    for mode in &job.modes {
        pictures.push(run.picture(&prepared, meshes, mode, read_time)?);
    }
    if let Some(mode) = &job.further {
        run.picture(&prepared, Meshes::Stated, mode, read_time)?;
    }
    if let Some(strip) = job.strip_file() {
        let started = Instant::now();
        let coding = Coding::new(Encoding::Srgb);
        run.write_picture(&strip, &Picture::side_by_side(&pictures, GAP), &coding)?;
        run.took(Stages { write: started.elapsed(), ..Stages::default() });
    }
    Ok(run.stages.get())
}

/// Returns the scene of a job with its meshes, as [`run()`] renders it. No file is written.
///
/// # Errors
/// When a file cannot be read or is wrong, or the textures take too much memory in one of the job's modes.
pub fn scene(
    job: &Job,
    source: &dyn Source,
    options: &Options,
    tell: &(dyn Fn(Event<'_>) + Sync),
) -> Result<Scene, PipelineError> {
    Run::new(job, source, options, tell).scene(Fineness::Stated)
}

/// Returns the settings of a mode for a picture of this width and height.
#[must_use]
pub fn settings(mode: &Mode, (width, height): (u32, u32)) -> Settings {
    let Mode { filter, sampling, accel, .. } = *mode;
    Settings { sampling, accel, ..Settings::new(width, height, filter) }
}

/// A job while it runs.
struct Run<'a> {
    job: &'a Job,
    source: &'a dyn Source,
    options: &'a Options,
    tell: &'a (dyn Fn(Event<'_>) + Sync),
    /// The batch of the job's files; `None` if nothing is written.
    batch: Option<&'a Batch<'a>>,
    /// Meshes that several jobs have in common.
    shared: Option<&'a Shared>,
    stages: Cell<Stages>,
    /// The kinds of resolution of the job's meshes, once they were made.
    kinds: Cell<Kinds>,
    /// The digest of the inputs of all pictures, if it is known.
    inputs: Option<Digest>,
    /// The camera, if it is not that of the scene.
    camera: Option<Camera>,
}

impl<'a> Run<'a> {
    fn new(
        job: &'a Job,
        source: &'a dyn Source,
        options: &'a Options,
        tell: &'a (dyn Fn(Event<'_>) + Sync),
    ) -> Self {
        let (stages, kinds) = (Cell::default(), Cell::default());
        let (shared, inputs, camera) = (None, None, None);
        Self { job, source, options, tell, batch: None, shared, stages, kinds, inputs, camera }
    }

    /// Reserves memory for the pictures of all modes and for the strip of them.
    fn reserve_pictures(&self, is_transparent: bool) -> Result<Reserved<'static>, MemoryError> {
        let (width, height) = self.options.size;
        let count = self.job.all_modes().count() as u64;
        let strip = memory::of_pixel(0, Some(Format::Png));
        let searches = self.job.all_modes().any(|mode| mode.error.is_some());
        let first = if searches { BasePicture::of_pixel(PixelFilter::Gaussian) } else { 0 };
        // The coverage and its picture.
        let more = if is_transparent { 16 + 4 } else { 0 };
        let pixel = count * (memory::of_pixel(0, None) + strip + more) + first;
        let bytes = (u64::from(width) * u64::from(height)).saturating_mul(pixel);
        let what = || format!("{count} pictures of {width}x{height} pixels side by side");
        of_process().reserve(bytes, what)
    }

    fn took(&self, more: Stages) {
        let mut stages = self.stages.get();
        stages += more;
        self.stages.set(stages);
    }

    fn write_picture(
        &self,
        name: &str,
        picture: &Picture,
        coding: &Coding,
    ) -> Result<(), PipelineError> {
        let Some(batch) = self.batch else { return Ok(()) };
        let bytes = encode::encode_as(picture, Format::Png, coding)
            .map_err(|source| PipelineError::Encode { name: name.into(), source })?;
        let size = Some((picture.width, picture.height));
        self.write((batch, name, size), |out| {
            out.write_all(&bytes).map_err(|source| out.failed(source).into())
        })
    }

    /// Replaces a file of the batch by what `fill` writes, and returns what `fill` returns. A picture has a size.
    fn write<T>(
        &self,
        (batch, name, size): (&Batch<'_>, &str, Option<(u32, u32)>),
        fill: impl FnOnce(&mut Output) -> Result<T, PipelineError>,
    ) -> Result<T, PipelineError> {
        let path = self.options.folder.join(name);
        let mut output = Output::create(&path, self.options.clobber)?;
        let filled = fill(&mut output)?;
        batch.replace(output)?;
        (self.tell)(Event::Written { path: &path, size });
        Ok(filled)
    }
}
