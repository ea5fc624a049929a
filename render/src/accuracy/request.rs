//! A request for a picture of some accuracy, and the result.

use super::search::{by_error, by_error_or_leave, by_time};
use super::{Sources, Statement};
use crate::film::course::{Shown, Told};
use crate::film::{Course, GoOn, Picture, PixelFilter, Settings};
use crate::prepared::Prepared;
use crate::stats::Stats;
use std::fmt;

/// Called with the finished parts and all parts of the picture, and the name of the step.
pub type Progress<'p> = dyn Fn(&str, usize, usize) + Sync + 'p;

/// The scene, the settings and the course of a request.
#[derive(Clone, Copy)]
pub struct Request<'r, 's> {
    /// The scene to render.
    pub prepared: &'r Prepared<'s>,
    /// The scene whose light is true. It is `prepared` itself, or the same scene with finer meshes.
    pub truth: &'r Prepared<'s>,
    /// The scene with finer meshes, to find the part of the error that the meshes cause.
    pub finer: Option<&'r Prepared<'s>>,
    /// Settings of the picture. The sampling is replaced.
    pub settings: &'r Settings,
    /// Pixel filter of the picture and of the true colours.
    pub pixel_filter: PixelFilter,
    /// Told after each tile.
    pub progress: &'r Progress<'r>,
    /// Returns false once the picture should be ended early.
    pub go_on: &'r GoOn<'r>,
    /// Shown each tile of the first rays and of the picture, if somebody watches.
    pub tile: Option<&'r Shown<'r>>,
}

/// A picture and what is known of its error.
#[derive(Debug)]
pub struct Reached {
    /// The picture.
    pub picture: Picture,
    /// Counts and times, with those of the audit.
    pub stats: Stats,
    /// The settings that were chosen. Unless the picture was ended early, `render` makes the same
    /// picture with them.
    pub settings: Settings,
    /// The result of the audit.
    pub statement: Statement,
    /// The sources of the error; `None` if the picture was ended early.
    pub sources: Option<Sources>,
}

impl fmt::Debug for Request<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { settings, pixel_filter, .. } = self;
        let mut shown = f.debug_struct("Request");
        shown
            .field("settings", settings)
            .field("pixel_filter", pixel_filter)
            .finish_non_exhaustive()
    }
}

impl<'r, 's> Request<'r, 's> {
    /// A request without progress that is never ended early. The light of the scene itself is true.
    #[must_use]
    pub fn new(
        prepared: &'r Prepared<'s>,
        settings: &'r Settings,
        pixel_filter: PixelFilter,
    ) -> Self {
        let (truth, finer) = (prepared, None);
        let progress: &Progress<'_> = &|_, _, _| {};
        let (go_on, tile) = (&|| true, None);
        Self { prepared, truth, finer, settings, pixel_filter, progress, go_on, tile }
    }

    /// Returns the course of a picture of the request.
    pub(super) fn course<'c>(&self, progress: &'c Told<'c>) -> Course<'c>
    where
        'r: 'c,
    {
        Course { progress, go_on: self.go_on, tile: self.tile }
    }

    /// Makes the cheapest picture whose error is below `error`, in linear light. If no sampling
    /// suffices, the picture is that of the finest sampling that was tried, and the statement says so.
    ///
    /// Runs on the threads of the current rayon pool. The picture and the statement are the same for
    /// any number of threads.
    #[must_use]
    pub fn reach(&self, error: f64) -> Reached {
        by_error(self, error)
    }

    /// Makes the picture of [`Request::reach`], or returns `None` soon after `go_on` returns false. The work ends within
    /// a row of a tile, or within one pixel of the audit.
    #[must_use]
    pub fn reach_or_leave(&self, error: f64) -> Option<Reached> {
        by_error_or_leave(self, error)
    }

    /// Makes the best picture in about `seconds` of wall-clock time. The choice depends on measured
    /// times, so the picture is not the same in each run.
    #[must_use]
    pub fn within(&self, seconds: f64) -> Reached {
        by_time(self, seconds)
    }
}
