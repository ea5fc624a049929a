//! The frames of animations on the command line of `pipeline run`.

use super::named::NamedJob;
use crate::animation::Animation;
use crate::animation::film::{self, Maker};
use crate::animation::frames::Frames;
use crate::job::Parts;
use crate::run::frames::{Wanted, run_frames};
use crate::run::{Event, Options};
use crate::stages::Stages;
use crate::{Job, PipelineError};
use clap::Args;
use files::{Ledger, Report, Setting};
use render::film::crop::Tile;
use std::borrow::Cow;
use std::path::PathBuf;

/// Flags for jobs with the key `animate` or `turntable`.
#[derive(Debug, Args)]
pub struct FrameArguments {
    /// Frames of an animation, from 1, such as 7, 1-240 or 1-240x10 [default: all]
    #[arg(long, visible_alias = "frame", value_name = "LIST")]
    frames: Option<Frames>,
    /// Make the pictures of an animated job without its animation
    #[arg(long, conflicts_with_all = ["frames", "film", "again"])]
    still: bool,
    /// Make frames again that exist and have the same inputs
    #[arg(long)]
    again: bool,
    /// Make part K of N bands of rows of each picture, as a file of its own; not if the whole picture is there
    #[arg(long, value_name = "K/N", value_parser = Tile::parse, conflicts_with_all = ["join", "film", "keep", "sheet"])]
    tile: Option<Tile>,
    /// Join the N parts of each picture; parts that are missing are made
    #[arg(long, value_name = "N", conflicts_with_all = ["keep", "sheet"],
        value_parser = clap::value_parser!(u32).range(1..=65536))]
    join: Option<u32>,
    /// Write the frames as a film too: a .png (animated), a .gif, or through ffmpeg a .mp4, .mkv, .mov or .webm
    #[arg(long, value_name = "FILE")]
    film: Option<PathBuf>,
}

/// The frames of a job that a run makes.
#[derive(Debug)]
pub struct Chosen<'a> {
    animation: Cow<'a, Animation>,
    frames: Vec<u32>,
    arguments: &'a FrameArguments,
    maker: Option<Maker>,
}

impl FrameArguments {
    /// Returns the parts in which the pictures are made, if the flags ask for parts.
    fn parts(&self) -> Option<Parts> {
        let of_tile = |Tile { number, count }| Parts { count, number: Some(number) };
        let joined = self.join.map(|count| Parts { count, number: None });
        self.tile.map(of_tile).or(joined)
    }

    /// Returns a job whose pictures are made in the parts that the flags ask for.
    #[must_use]
    pub fn in_parts(&self, job: Job) -> Job {
        Job { parts: self.parts(), ..job }
    }

    /// Returns whether the flags ask for frames or a film.
    fn ask(&self) -> bool {
        self.frames.is_some() || self.film.is_some() || self.again
    }

    /// Returns the frames of a job, or `None` if its pictures are still.
    ///
    /// # Errors
    /// If the job has no animation or not all of the frames, or a film of it cannot be made.
    pub fn of<'a>(&'a self, job: &'a Job, ledger: &Ledger) -> Result<Option<Chosen<'a>>, Report> {
        let Some(animation) = job.animation.as_ref().filter(|_| !self.still) else {
            if self.ask() {
                return Err(PipelineError::NoAnimation(job.name.clone()).into());
            }
            // The pictures of a job without its animation, one by one.
            let (animation, frames) = (Cow::Owned(Animation::still()), vec![1]);
            let still = Chosen { animation, frames, arguments: self, maker: None };
            return Ok(self.parts().map(|_| still));
        };
        let animation = Cow::Borrowed(animation);
        let frames = match &self.frames {
            None => (1..=animation.frames).collect(),
            Some(frames) => frames
                .of(animation.frames)
                .map_err(|message| PipelineError::Frames { job: job.name.clone(), message })?,
        };
        let maker = match &self.film {
            None => None,
            Some(_) if job.modes.len() != 1 => {
                let modes: Vec<&str> = job.modes.iter().map(|mode| mode.name.as_str()).collect();
                let (job, modes) = (job.name.clone(), modes.join(", "));
                return Err(PipelineError::FilmOfModes { job, modes }.into());
            }
            Some(path) => {
                let maker = Maker::of(path)?;
                ledger.claim(path, "name another film")?;
                Some(maker)
            }
        };
        Ok(Some(Chosen { animation, frames, arguments: self, maker }))
    }
}

impl Chosen<'_> {
    /// Returns the names of the files of all chosen frames.
    pub fn files(&self, job: &Job) -> Vec<String> {
        let of_frame = |&frame: &u32| self.animation.job(job, frame, &[]).files(false);
        self.frames.iter().flat_map(of_frame).collect()
    }

    /// Makes the frames, and the film if one is wanted.
    ///
    /// # Errors
    /// On the first fault. Frames already written stay.
    pub fn run(
        &self,
        named: &NamedJob<'_>,
        settings: &[Setting],
        options: &Options,
        tell: &(dyn Fn(Event<'_>) + Sync),
    ) -> Result<Stages, PipelineError> {
        let wanted = Wanted { frames: &self.frames, settings, again: self.arguments.again };
        run_frames((&named.job, &self.animation), named.source, wanted, options, tell)
    }

    /// Writes the film, if one is wanted. Returns its path.
    ///
    /// # Errors
    /// If a frame cannot be read, or the film cannot be written.
    pub fn film(
        &self,
        job: &Job,
        options: &Options,
        ledger: &Ledger,
    ) -> Result<Option<PathBuf>, Report> {
        let (Some(path), Some(maker)) = (&self.arguments.film, self.maker) else {
            return Ok(None);
        };
        let frames: Vec<PathBuf> =
            self.files(job).into_iter().map(|file| options.folder.join(file)).collect();
        let output = ledger.create(path)?;
        film::write(maker, path, output, &frames, self.animation.fps)?;
        Ok(Some(path.clone()))
    }
}
