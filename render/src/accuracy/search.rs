//! The search for the cheapest picture whose error is below a requested one.
//!
//! The pixels of the audit are drawn and judged first, once. Each sampling is then tried on these
//! pixels alone, and only the chosen one makes the whole picture. So the audit looks at the picture
//! before it exists: its pixels have the same bits.
//!
//! Many samplings are tried and one is chosen, which must not make the statement wrong. In a round,
//! the order of the trials is fixed before any pixel is seen. A round starts at a rung of the ladder
//! that should suffice. It goes to cheaper rungs while their bounds are below the request, and the
//! first that fails ends it. A wrong choice needs a wrong bound at the first insufficient rung of
//! the round, so the risk of one bound is the risk of the round (fixed sequence testing; A.
//! Angelopoulos et al., "Learn then Test", 2021, section 4). If the first rung of a round fails,
//! another round follows with new pixels, more of them, and a part of the rest of the risk. The
//! pixels of the round before show at which rung it should start.

use super::bound::{mean, upper};
use super::chances::Chances;
use super::ladder::{rungs, start};
use super::sample::Sample;
use super::statement::Statement;
use super::{CONFIDENCE, draws};
use crate::film::{BasePicture, Picture, PixelFilter, Sampling, Settings};
use crate::prepared::Prepared;
use crate::stats::Stats;
use std::time::{Duration, Instant};

/// Risks of the rounds. Their sum is the risk of the statement.
const RISKS: [f64; 5] = [0.035, 0.008, 0.004, 0.002, 0.001];

/// Pixels of each round, in those of the first.
const SIZES: [usize; 5] = [1, 2, 4, 8, 16];

/// Rungs that a round looks ahead for the start of the next.
const AHEAD: usize = 4;

/// Part of the requested error that a ray must weigh in its cell to be followed. True colours follow
/// all rays, so the audit counts what is lost.
const FOLLOWED: f64 = 0.1;

/// A rung should suffice if its estimated error is below this part of the requested one.
const PROMISING: f64 = 0.7;

/// A picture and what is known of its error.
#[derive(Debug)]
pub struct Reached {
    /// The picture.
    pub picture: Picture,
    /// Counts and times, with those of the audit.
    pub stats: Stats,
    /// The settings that were chosen. `render` makes the same picture with them.
    pub settings: Settings,
    /// The result of the audit.
    pub statement: Statement,
}

/// Calls with the finished parts and all parts of the picture, and the name of the step.
pub type Progress<'p> = dyn Fn(&str, usize, usize) + Sync + 'p;

/// Makes the cheapest picture whose error is below `error`, in linear light. The sampling of
/// `settings` is replaced; its pixel filter is `pixel_filter`. If no sampling suffices, the picture
/// is that of the finest, and the statement says so.
///
/// Runs on the threads of the current rayon pool. The picture and the statement are the same for
/// any number of threads.
#[must_use]
pub fn reach(
    prepared: &Prepared<'_>,
    settings: &Settings,
    pixel_filter: PixelFilter,
    error: f64,
    progress: &Progress<'_>,
) -> Reached {
    let mut search = Search::start(prepared, settings, pixel_filter, error, progress);
    let rungs = rungs(pixel_filter);
    let limit = error * error;
    let mut first = start(error);
    let mut missed = Some(error);
    let mut chosen = search.try_out(rungs[first]);
    for (round, risk) in RISKS.into_iter().enumerate() {
        if round > 0 {
            first = search.promising(&rungs, first, &chosen, PROMISING * error);
            search.draw(round, error);
            chosen = search.try_out(rungs[first]);
        }
        if upper(&chosen.values, risk) < limit {
            missed = None;
            // Cheaper rungs in order, until one fails.
            for &sampling in rungs[..first].iter().rev() {
                let tried = search.try_out(sampling);
                if upper(&tried.values, risk) >= limit {
                    break;
                }
                chosen = tried;
            }
            break;
        }
    }
    let Trial { sampling, values } = chosen;
    let bound = match missed {
        // The choice depends on the request and on nothing else that the audit found.
        None => error,
        Some(_) => upper(&values, 1.0 - CONFIDENCE).max(0.0).sqrt(),
    };
    search.finish(sampling, &values, bound, missed, progress)
}

/// Makes the best picture in about `seconds` of wall-clock time. The choice depends on measured
/// times, so the picture is not the same in each run.
#[must_use]
pub fn within(
    prepared: &Prepared<'_>,
    settings: &Settings,
    pixel_filter: PixelFilter,
    seconds: f64,
    progress: &Progress<'_>,
) -> Reached {
    let started = Instant::now();
    let mut search = Search::start(prepared, settings, pixel_filter, TIMED, progress);
    let rungs = rungs(pixel_filter);
    let mut chosen = search.try_out(rungs[0]);
    for &sampling in &rungs[1..] {
        let before = (Instant::now(), search.stats.audit_rays);
        let tried = search.try_out(sampling);
        let took = before.0.elapsed().as_secs_f64();
        // The pixels of the audit take longer than others; their rays tell by how much.
        let traced = (search.stats.audit_rays - before.1).max(1) as f64;
        let needed = search.rays_per_pixel * search.base.errors.len() as f64 * took / traced;
        if started.elapsed().as_secs_f64() + needed > seconds {
            break;
        }
        chosen = tried;
    }
    // The values were not used for the choice.
    let bound = upper(&chosen.values, 1.0 - CONFIDENCE).max(0.0).sqrt();
    search.finish(chosen.sampling, &chosen.values, bound, None, progress)
}

/// The accuracy for which a search by time judges pixels.
const TIMED: f64 = 0.005;

/// A sampling that was tried.
struct Trial {
    sampling: Sampling,
    /// Weighted squared errors of the drawn pixels.
    values: Vec<f64>,
}

struct Search<'p, 's> {
    prepared: &'p Prepared<'s>,
    base: BasePicture<'p, 's>,
    chances: Chances,
    /// The pixels of the round.
    sample: Sample,
    stats: Stats,
    /// Rays from the eye per pixel of a picture with the sampling that was tried last.
    rays_per_pixel: f64,
}

impl<'p, 's> Search<'p, 's> {
    fn start(
        prepared: &'p Prepared<'s>,
        settings: &Settings,
        pixel_filter: PixelFilter,
        error: f64,
        progress: &Progress<'_>,
    ) -> Self {
        let tell = |done, total| progress("first rays", done, total);
        let settings = Settings { least_weight: Some(FOLLOWED * error), ..settings.clone() };
        let base = BasePicture::new(prepared, &settings, pixel_filter, &tell);
        let chances = Chances::new(&base.picture, &base.errors);
        let sample = Sample::default();
        let mut search =
            Self { prepared, base, chances, sample, stats: Stats::default(), rays_per_pixel: 0.0 };
        search.draw(0, error);
        search
    }

    /// Draws and judges the pixels of a round.
    fn draw(&mut self, round: usize, error: f64) {
        let started = Instant::now();
        let count = SIZES[round] * draws(error);
        let settings = self.base.settings();
        self.sample =
            Sample::take(self.prepared, settings, &self.chances, (count, round as u64), error);
        self.stats.audit_rays += self.sample.rays();
        self.stats.audit_time += started.elapsed();
    }

    /// Returns the first rung, from `first` on, whose estimated error is at most `wanted`, or the
    /// last one that it looks at. `tried` is the trial of `first`.
    fn promising(&mut self, rungs: &[Sampling], first: usize, tried: &Trial, wanted: f64) -> usize {
        let suffices = |values: &[f64]| mean(values) <= wanted * wanted;
        if suffices(&tried.values) {
            return first;
        }
        let last = (first + AHEAD).min(rungs.len() - 1);
        let mut ahead = first + 1..last;
        ahead.find(|&rung| suffices(&self.try_out(rungs[rung]).values)).unwrap_or(last)
    }

    /// Finishes the drawn pixels with a sampling.
    fn try_out(&mut self, sampling: Sampling) -> Trial {
        let started = Instant::now();
        let pixels = self.base.pixels(sampling, &self.sample.pixels);
        let values = self.sample.values(|k| pixels[k].color);
        self.rays_per_pixel = self.sample.mean(|k| pixels[k].rays as f64);
        self.stats.audit_rays += pixels.iter().map(|pixel| pixel.traced).sum::<u64>();
        self.stats.audit_time += started.elapsed();
        Trial { sampling, values }
    }

    /// Makes the whole picture with the chosen sampling.
    fn finish(
        self,
        sampling: Sampling,
        values: &[f64],
        bound: f64,
        missed: Option<f64>,
        progress: &Progress<'_>,
    ) -> Reached {
        let (picture, mut stats) =
            self.base.finish(sampling, &|done, total| progress("picture", done, total));
        let Stats { audit_rays, audit_time, .. } = self.stats;
        stats.audit_rays = audit_rays;
        stats.audit_time = audit_time.max(Duration::ZERO);
        let statement = stated(values, bound, missed, &stats, picture.pixels.len());
        Reached { picture, stats, settings: self.base.with(sampling), statement }
    }
}

/// Returns the statement on a picture of this many pixels.
pub(super) fn stated(
    values: &[f64],
    bound: f64,
    missed: Option<f64>,
    stats: &Stats,
    pixels: usize,
) -> Statement {
    let per_pixel = |rays: u64| rays as f64 / pixels.max(1) as f64;
    Statement {
        error: mean(values).max(0.0).sqrt(),
        bound,
        confidence: CONFIDENCE,
        rays: per_pixel(stats.primary_rays),
        audit: per_pixel(stats.audit_rays),
        missed,
    }
}
