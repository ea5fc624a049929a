//! Pictures of a mode, with meshes as fine as its requested error needs.
//!
//! Meshes whose specs state a tolerance may cause a third of the squared error. They start within a
//! number of pixels that mostly suffices. The light on them is compared with that on meshes that are
//! eight times finer. If the difference is too large, they are made finer. The light on the finer
//! meshes is the truth that the audit of the picture compares with.

use super::{Event, Run, settings};
use crate::PipelineError;
use crate::coding;
use crate::fineness::Fineness;
use crate::job::{Mode, Parts};
use crate::stages::Stages;
use render::accuracy::{self, Reached, Request, Sources, Statement};
use render::film::encode::Coding;
use render::film::{PixelFilter, alpha};
use render::shade::View;
use render::stats::Stats;
use render::{Picture, Prepared, Sampling, Scene, Settings};
use std::time::{Duration, Instant};

/// Part of the requested squared error that tessellation may cause.
const SHARE: f64 = 1.0 / 3.0;

/// Pixels within which meshes are first made, in requested errors. An outline that is off by a tenth of
/// a pixel mostly costs an error of about 0.003.
const FIRST: f64 = 30.0;

/// Smallest and largest number of pixels within which meshes are first made.
const RANGE: [f64; 2] = [0.02, 1.0];

/// Most times that meshes are made.
const TRIALS: usize = 4;

/// Part of the allowed error at which the next trial aims.
const AIM: f64 = 0.7;

/// The meshes of a picture with a requested error.
#[derive(Debug, Clone, Copy)]
pub(super) enum Meshes<'m, 's> {
    /// As they are stated. The light on them is true.
    Stated,
    /// Meshes with a tolerance are made anew. If no mesh has one, this scene has finer meshes.
    Fine(Option<&'m Prepared<'s>>),
}

/// The error of a picture, and its sources.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// The result of the audit.
    pub statement: Statement,
    /// The sources of the error.
    pub sources: Option<Sources>,
    /// Pixels within which meshes with a tolerance were made, if there are any.
    pub pixels: Option<f64>,
}

impl Run<'_> {
    /// Returns the job's scene with finer meshes, if a mode requests an error and no mesh is made anew for
    /// it.
    pub(super) fn finer(&self) -> Result<Option<Scene>, PipelineError> {
        let kinds = self.kinds.get();
        let requested = self.job.modes.iter().any(|mode| mode.error.is_some());
        let wanted = requested && kinds.counted && !kinds.tolerance;
        wanted.then(|| self.scene(Fineness::Finest(1.0))).transpose()
    }

    /// Makes and writes the picture of a mode.
    pub(super) fn picture<'s>(
        &self,
        prepared: &Prepared<'s>,
        meshes: Meshes<'_, 's>,
        mode: &Mode,
        read_time: Duration,
    ) -> Result<Picture, PipelineError> {
        let mut settings = settings(mode, self.options.size);
        settings.camera = self.camera;
        let tile = self.job.parts.and_then(Parts::tile);
        settings.crop = tile.map(|tile| tile.crop(settings.width, settings.height));
        let is_transparent = prepared.scene().is_transparent;
        if is_transparent {
            settings.view = View::Foreground;
        }
        let progress = |done, total| (self.tell)(Event::Progress { mode: &mode.name, done, total });
        let told = |step: &str, done, total| {
            if step == "picture" {
                progress(done, total);
            }
        };
        let (mut picture, mut stats, accuracy) = match (mode.error, mode.sampling) {
            (Some(error), Sampling::Area { pixel_filter, .. }) => {
                let request = Request::new(prepared, &settings, pixel_filter);
                let request = Request { progress: &told, ..request };
                let (reached, pixels) = match meshes {
                    Meshes::Fine(_) if self.kinds.get().tolerance => {
                        self.with_meshes(&settings, pixel_filter, error, &told)?
                    }
                    Meshes::Fine(finer) => (Request { finer, ..request }.reach(error), None),
                    Meshes::Stated => (request.reach(error), None),
                };
                let Reached { picture, stats, statement, sources, .. } = reached;
                (picture, stats, Some(Accuracy { statement, sources, pixels }))
            }
            _ => {
                let (picture, stats) = render::render(prepared, &settings, &progress);
                (picture, stats, None)
            }
        };
        if is_transparent {
            let settings = Settings { view: View::Coverage, ..settings.clone() };
            let (open, _) = render::render(prepared, &settings, &|_, _| {});
            alpha::add(&mut picture, &open);
        }
        let started = Instant::now();
        let coding = Coding {
            inputs: self.inputs.map(|inputs| inputs.of_picture(self.job, mode, &settings)),
            ..coding::of(self.job, &settings, mode.error, is_transparent)
        };
        self.write_picture(&self.job.picture_file(mode), &picture, &coding)?;
        stats.read_time = read_time;
        stats.write_time = started.elapsed();
        self.took(Stages::of_mode(&stats));
        self.tell_picture(mode, &picture, &stats, accuracy.as_ref());
        Ok(picture)
    }

    fn tell_picture(
        &self,
        mode: &Mode,
        picture: &Picture,
        stats: &Stats,
        accuracy: Option<&Accuracy>,
    ) {
        (self.tell)(Event::Picture { mode: &mode.name, picture, stats, accuracy });
    }

    /// Makes meshes and a picture for a requested error. Returns the picture with the number of pixels
    /// within which the meshes were made.
    fn with_meshes(
        &self,
        settings: &Settings,
        pixel_filter: PixelFilter,
        error: f64,
        progress: &accuracy::Progress<'_>,
    ) -> Result<(Reached, Option<f64>), PipelineError> {
        let allowed = SHARE * error * error;
        let mut pixels = (FIRST * error).clamp(RANGE[0], RANGE[1]);
        let mut trials = 0;
        loop {
            trials += 1;
            let scenes = [Fineness::Pixels(pixels), Fineness::Truth(pixels)];
            let [scene, truth] = scenes.map(|fineness| self.scene(fineness));
            let (scene, truth) = (scene?, truth?);
            let (prepared, fine) = (Prepared::new(&scene), Prepared::new(&truth));
            let request = Request::new(&prepared, settings, pixel_filter);
            let request = Request { truth: &fine, finer: Some(&fine), progress, ..request };
            let found = accuracy::apart(&request, error);
            if found <= allowed || trials == TRIALS {
                let counted = self.kinds.get().counted;
                let finest = counted.then(|| self.scene(Fineness::Finest(pixels))).transpose()?;
                let finest = finest.as_ref().map(Prepared::new);
                let finer = finest.as_ref().unwrap_or(&fine);
                let reached = Request { finer: Some(finer), ..request }.reach(error);
                return Ok((reached, Some(pixels)));
            }
            // Squared errors grow with the square of the distance.
            pixels *= (AIM * allowed / found).sqrt().clamp(0.125, 0.7);
        }
    }
}
