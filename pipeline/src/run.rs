//! Runs a job: from specs to grids, meshes and pictures.

use crate::job::{MeshJob, Mode};
use crate::stages::Stages;
use crate::{Job, PipelineError, coding, mesh};
use files::json::Document;
use files::memory::{Reserved, of_process};
use files::words::shown;
use files::{Batch, MemoryError, Output, Source, input};
use render::accuracy::{self, Statement};
use render::color::Encoding;
use render::film::encode::{self, Coding, Format};
use render::film::{BasePicture, PixelFilter, memory};
use render::filter::Filter;
use render::scene::file::CameraFile;
use render::scene::read::{self, Draft};
use render::scene::{MeshSource, SceneError};
use render::stats::Stats;
use render::{Picture, Prepared, Sampling, Scene, Settings};
use std::cell::Cell;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use sweep::grid::file as grid_file;
use sweep::spec::{self, Camera};
use sweep::{GridMesh, Object, SweepError};
use triangulate::{ObjWriter, Patches, TriMesh, TriangulateError};

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
        statement: Option<&'a Statement>,
    },
    /// A file is written.
    Written(&'a Path),
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
    let run = Run { job, source, options, tell, batch: Some(batch), stages: Cell::default() };
    let scene = run.scene()?;
    // Sweeping and triangulating are stages of their own.
    let read_time = run.stages.get().read;
    let _reserved = run.reserve_pictures()?;
    let prepared = Prepared::new(&scene);
    let mut pictures = Vec::with_capacity(job.modes.len());
    for mode in &job.modes {
        pictures.push(run.picture(&prepared, mode, read_time)?);
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
    Run { job, source, options, tell, batch: None, stages: Cell::default() }.scene()
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
    stages: Cell<Stages>,
}

impl Run<'_> {
    /// Reserves memory for the pictures of all modes and for the strip of them.
    fn reserve_pictures(&self) -> Result<Reserved<'static>, MemoryError> {
        let (width, height) = self.options.size;
        let count = self.job.modes.len() as u64;
        let strip = memory::of_pixel(0, Some(Format::Png));
        let searches = self.job.modes.iter().any(|mode| mode.error.is_some());
        let first = if searches { BasePicture::of_pixel(PixelFilter::Gaussian) } else { 0 };
        let pixel = count * (memory::of_pixel(0, None) + strip) + first;
        let bytes = (u64::from(width) * u64::from(height)).saturating_mul(pixel);
        let what = || format!("{count} pictures of {width}x{height} pixels side by side");
        of_process().reserve(bytes, what)
    }

    fn took(&self, more: Stages) {
        let mut stages = self.stages.get();
        stages += more;
        self.stages.set(stages);
    }

    /// Makes the scene with the job's meshes.
    fn scene(&self) -> Result<Scene, PipelineError> {
        let started = Instant::now();
        let path = &self.job.scene;
        let (name, bytes) = (input::name_of(path), self.source.read_json(path)?);
        let document = Document::new(&name, &bytes)?;
        let file = read::parse(&document)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let draft = Draft::gather(&document, &file, folder, self.source)?;
        draft
            .check_mesh_names(self.job.meshes.iter().map(|mesh| mesh.name.as_str()))
            .map_err(|error| self.of_meshes(error))?;
        let mut meshes = MeshSource::new();
        for mesh in &self.job.meshes {
            meshes.insert(mesh.name.clone(), self.mesh(mesh, &file.camera)?.into());
        }
        let scene = draft.resolve(self.source, meshes).map_err(|error| self.of_meshes(error))?;
        // Reserves memory for each picture together with the tables that earlier modes keep.
        let mut kept: Vec<(Filter, Reserved<'_>)> = Vec::new();
        for mode in &self.job.modes {
            kept.retain(|(filter, _)| *filter != mode.filter);
            let settings = settings(mode, self.options.size);
            memory::reserve(&scene, &settings, Some(Format::Png), of_process()).map(drop)?;
            kept.push((mode.filter, memory::reserve_tables(&scene, mode.filter, of_process())?));
        }
        // The meshes are made in between, and their times belong to other stages.
        let read = started.elapsed().saturating_sub(self.stages.get().total());
        self.took(Stages { read, ..Stages::default() });
        Ok(scene)
    }

    /// Turns an error of the scene into an error of the job, if the job has a mesh too many or too
    /// few.
    fn of_meshes(&self, error: SceneError) -> PipelineError {
        let job = self.job.name.clone();
        match error {
            SceneError::UnknownMesh { name, known } => {
                PipelineError::UnknownMesh { job, name, known }
            }
            SceneError::MissingMesh { name, path, scene } => {
                PipelineError::MissingMesh { job, name, path, scene }
            }
            other => other.into(),
        }
    }

    fn mesh(
        &self,
        mesh: &MeshJob,
        camera: &CameraFile,
    ) -> Result<render::shape::Mesh, PipelineError> {
        let started = Instant::now();
        let (name, bytes) = (input::name_of(&mesh.spec), self.source.read_json(&mesh.spec)?);
        let folder = mesh.spec.parent().unwrap_or(Path::new(""));
        // A scene does not move its meshes, so the scene's camera sees each mesh as a camera in the
        // spec would.
        let CameraFile { eye, target, up, .. } = *camera;
        let fov_deg = camera.angle_deg();
        let size = [self.options.size.0, self.options.size.1];
        let camera = Some(Camera { eye, target, up, fov_deg, size });
        let seen = spec::Resolution {
            camera: mesh.resolution.camera.or(camera),
            ..mesh.resolution.clone()
        };
        let document = Document::new(&name, &bytes)?;
        let object =
            Object::read(&document, folder, self.source, &seen).map_err(|error| match error {
                // The complaint is about the resolution that the job states in place of the spec's.
                SweepError::Resolution(message) => mesh.resolution_fault(message).into(),
                other => PipelineError::from(other),
            })?;
        let points = object.parts().iter().map(|part| {
            let [rows, cols] = part.points();
            (rows as u64).saturating_mul(cols as u64)
        });
        let points: u64 = points.sum();
        // Memory for the grid, its triangles, and the copy of them that is rendered.
        let bytes = points.saturating_mul(36).saturating_add(TriMesh::bytes_for(2 * points));
        of_process().check(bytes, || format!("mesh {} of {points} points", shown(&mesh.name)))?;
        let grids = object.grids()?;
        let sweep = started.elapsed();
        let keep = self.batch.filter(|_| self.options.keep);
        if let Some(batch) = keep {
            self.write(batch, &self.job.grid_file(mesh), |out| {
                grid_file::write_all(&grids, grid_file::Encoding::Binary, out)
                    .map_err(|source| out.failed(source).into())
            })?;
        }
        let write = started.elapsed() - sweep;
        let started = Instant::now();
        let triangles = match keep {
            Some(batch) => self.write(batch, &self.job.obj_file(mesh), |out| {
                mesh_and_obj(&grids, &mesh.options, out).map_err(|error| match error {
                    TriangulateError::Write(source) => out.failed(source).into(),
                    error => error.into(),
                })
            })?,
            None => triangulate::mesh(grids.as_slice(), &mesh.options)?,
        };
        let triangles = mesh::for_render(triangles);
        let triangulate = started.elapsed();
        self.took(Stages { sweep, triangulate, write, ..Stages::default() });
        (self.tell)(Event::Mesh {
            name: &mesh.name,
            triangles: triangles.triangles.len(),
            sweep,
            triangulate,
            missed: object.missed(),
        });
        Ok(triangles)
    }

    fn picture(
        &self,
        prepared: &Prepared<'_>,
        mode: &Mode,
        read_time: Duration,
    ) -> Result<Picture, PipelineError> {
        let settings = settings(mode, self.options.size);
        let progress = |done, total| (self.tell)(Event::Progress { mode: &mode.name, done, total });
        let (picture, mut stats, statement) = match (mode.error, mode.sampling) {
            (Some(error), Sampling::Area { pixel_filter, .. }) => {
                let progress = |step: &str, done, total| {
                    if step == "picture" {
                        progress(done, total);
                    }
                };
                let reached = accuracy::reach(prepared, &settings, pixel_filter, error, &progress);
                (reached.picture, reached.stats, Some(reached.statement))
            }
            _ => {
                let (picture, stats) = render::render(prepared, &settings, &progress);
                (picture, stats, None)
            }
        };
        let started = Instant::now();
        let coding = coding::of(self.job, &settings, mode.error);
        self.write_picture(&self.job.picture_file(mode), &picture, &coding)?;
        stats.read_time = read_time;
        stats.write_time = started.elapsed();
        self.took(Stages::of_mode(&stats));
        let statement = statement.as_ref();
        (self.tell)(Event::Picture {
            mode: &mode.name,
            picture: &picture,
            stats: &stats,
            statement,
        });
        Ok(picture)
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
        self.write(batch, name, |out| {
            out.write_all(&bytes).map_err(|source| out.failed(source).into())
        })
    }

    /// Replaces a file of the batch by what `fill` writes, and returns what `fill` returns.
    fn write<T>(
        &self,
        batch: &Batch<'_>,
        name: &str,
        fill: impl FnOnce(&mut Output) -> Result<T, PipelineError>,
    ) -> Result<T, PipelineError> {
        let path = self.options.folder.join(name);
        let mut output = Output::create(&path, self.options.clobber)?;
        let filled = fill(&mut output)?;
        batch.replace(output)?;
        (self.tell)(Event::Written(&path));
        Ok(filled)
    }
}

/// Makes the triangles of grids in memory, and writes them as OBJ in the same pass.
fn mesh_and_obj(
    grids: &[GridMesh],
    options: &triangulate::Options,
    out: &mut impl Write,
) -> Result<TriMesh, TriangulateError> {
    let sinks = (ObjWriter::new(out), TriMesh::default());
    let ((writer, mesh), counts) = grids.run(options, sinks)?;
    writer.finish(&counts).map_err(TriangulateError::Write)?;
    Ok(mesh)
}
