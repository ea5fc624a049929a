//! Renders and measures a page of the book.

use super::Entry;
use super::detail::{Detail, most_different};
use super::sources::{SourceText, texts};
use crate::PipelineError;
use crate::job::{Mode, Place};
use crate::run::{self, Event};
use crate::stages::Stages;
use crate::truth::Pair;
use render::color::Encoding;
use render::film::Crop;
use render::film::encode::{self, Format};
use render::filter::Filter;
use render::stats::Stats;
use render::{Picture, Prepared, Sampling, Scene};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// The pictures, measures and texts of a job that the book shows.
#[derive(Debug)]
pub struct Plate {
    /// Each mesh of the job: its name and its number of triangles.
    pub meshes: Vec<(String, usize)>,
    /// Times of meshes and scene, which all modes share.
    pub shared: Stages,
    /// The pictures of the modes, those of the job first.
    pub shots: Vec<Shot>,
    /// Parts of the pictures, shown pixel by pixel.
    pub details: Vec<Detail>,
    /// Texts of the job, its scene and its specs.
    pub texts: Vec<SourceText>,
}

/// A picture in one mode.
#[derive(Debug)]
pub struct Shot {
    /// The mode.
    pub mode: Mode,
    /// True if the mode belongs to the job. False for a picture made only for comparison.
    pub own: bool,
    /// The picture.
    pub picture: Picture,
    /// Counts of rays and texels.
    pub stats: Stats,
    /// Times of this mode, without the stages that all modes share.
    pub stages: Stages,
    /// Root mean square error of the whole picture in linear light, where it was measured.
    pub error: Option<f64>,
}

impl Plate {
    /// Renders the pictures of a job and measures them. The truth of a detail has `truth * truth`
    /// rays in each pixel, for each of two seeds. The truth of a whole picture has a quarter of
    /// that number along each side. With `truth` 0 no truth is rendered and no error is measured.
    ///
    /// # Errors
    /// When a file cannot be read or is wrong.
    pub fn make(
        entry: &Entry<'_>,
        options: &run::Options,
        truth: u32,
    ) -> Result<Self, PipelineError> {
        let job = entry.job;
        let (scene, Shared { meshes, stages: shared }) = scene(entry, options)?;
        let prepared = Prepared::new(&scene);
        let mut shots = Vec::new();
        for mode in &job.modes {
            shots.push(Shot::make(&prepared, mode, true, options.size)?);
        }
        if !shots.iter().any(|shot| shot.mode.filter == Filter::Point) {
            let mode = Mode::new("point", Filter::Point, Sampling::regular(1));
            shots.push(Shot::make(&prepared, &mode, false, options.size)?);
        }
        // A job with several modes is a comparison, so whole pictures are measured too.
        if truth > 0 && job.modes.len() > 1 {
            let whole = Crop::whole(options.size.0, options.size.1);
            let truth = Pair::render(&prepared, options.size, whole, truth.div_ceil(4), &|_, _| {});
            for shot in &mut shots {
                shot.error = truth.error_of(&shot.picture, |_| true);
            }
        }
        let places = places(&job.crops, &shots);
        let pictures: Vec<&Picture> = in_details(&shots).map(|shot| &shot.picture).collect();
        let details = places.iter().map(|place| Detail::new(&prepared, place, &pictures, truth));
        Ok(Self { meshes, shared, details: details.collect(), shots, texts: texts(entry)? })
    }

    /// Returns the times of the whole job: meshes, scene and the job's own modes.
    #[must_use]
    pub fn total(&self) -> Stages {
        let mut total = self.shared;
        for shot in self.shots.iter().filter(|shot| shot.own) {
            total += shot.stages;
        }
        total
    }
}

impl Shot {
    fn make(
        prepared: &Prepared<'_>,
        mode: &Mode,
        own: bool,
        size: (u32, u32),
    ) -> Result<Self, PipelineError> {
        let (picture, mut stats) = render::render(prepared, &run::settings(mode, size), &|_, _| {});
        let started = Instant::now();
        // The picture is encoded as `run` encodes it, so that the times equal those of `run`.
        encode::encode(&picture, Format::Png, Encoding::Srgb)
            .map_err(|source| PipelineError::Encode { name: mode.name.clone(), source })?;
        stats.write_time = started.elapsed();
        let stages = Stages::of_mode(&stats);
        Ok(Self { mode: mode.clone(), own, picture, stats, stages, error: None })
    }
}

/// Returns the shots in the order of details. A point-sampled shot that was added for comparison comes
/// first.
pub fn in_details(shots: &[Shot]) -> impl Iterator<Item = &Shot> {
    let is_first = |shot: &&Shot| shot.mode.filter == Filter::Point && !shot.own;
    shots.iter().filter(is_first).chain(shots.iter().filter(move |shot| !is_first(shot)))
}

/// Returns the positions that the job names, or else the position where its modes differ most.
fn places(crops: &[Place], shots: &[Shot]) -> Vec<Place> {
    if !crops.is_empty() {
        return crops.to_vec();
    }
    let point = shots.iter().find(|shot| shot.mode.filter == Filter::Point);
    let best = shots.iter().rfind(|shot| shot.own);
    match (point, best) {
        (Some(point), Some(best)) => {
            vec![most_different("where the filter matters most", &point.picture, &best.picture)]
        }
        _ => Vec::new(),
    }
}

/// Results that all modes of a job share.
#[derive(Debug, Default)]
struct Shared {
    /// Each mesh: its name and its number of triangles.
    meshes: Vec<(String, usize)>,
    /// Times of the meshes and the scene.
    stages: Stages,
}

/// Makes the scene of a job and measures the time.
fn scene(entry: &Entry<'_>, options: &run::Options) -> Result<(Scene, Shared), PipelineError> {
    let shared = Mutex::new(Shared::default());
    let started = Instant::now();
    let scene = run::scene(entry.job, entry.source, options, &|event| {
        if let Event::Mesh { name, triangles, sweep, triangulate, .. } = event {
            let mut shared = shared.lock().unwrap_or_else(PoisonError::into_inner);
            shared.meshes.push((name.to_owned(), triangles));
            shared.stages += Stages { sweep, triangulate, ..Stages::default() };
        }
    })?;
    let all = started.elapsed();
    let mut shared = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
    shared.stages.read = all.saturating_sub(shared.stages.total());
    Ok((scene, shared))
}
