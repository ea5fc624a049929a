//! The flags that request an accuracy, and the picture that they choose.

use super::UseError;
use super::sampling::SamplingArguments;
use clap::Args;
use files::exit::say;
use files::progress::Progress;
use files::{Exit, Failure, stop};
use render::accuracy::{self, Request, Statement};
use render::film::course::Shown;
use render::film::{Course, PixelFilter, render_while};
use render::stats::Stats;
use render::{Picture, Prepared, Settings};
use thiserror::Error;

#[derive(Debug, Args)]
pub struct AccuracyArguments {
    /// Make the picture with the fewest rays whose error is below this, and print what was reached. A
    /// request is a number between 0 and 1, root mean square in linear light, or 8bit for half a code of
    /// an 8-bit picture. The rays are chosen for you
    #[arg(long, value_name = "E|8bit", allow_hyphen_values = true)]
    error: Option<String>,
    /// Make the best picture in about this many seconds, and print its error. The picture is not the
    /// same each time
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<f64>,
    /// Measure the error of the picture on some of its pixels by brute force, and print it
    #[arg(long)]
    audit: bool,
    /// On Ctrl-C, write the picture as far as it is done, and print its error. A second Ctrl-C ends the
    /// program at once
    #[arg(long, requires = "output")]
    partial: bool,
}

/// The requested error was not reached. The picture was written.
#[derive(Debug, Error)]
#[error("{0}")]
pub struct Missed(Statement);

impl Failure for Missed {
    fn exit(&self) -> Exit {
        Exit::Inaccurate
    }
}

impl AccuracyArguments {
    /// Checks that the flags agree with each other and with those of the rays.
    pub fn check(&self, sampling: &SamplingArguments) -> Result<(), UseError> {
        self.requested()?;
        let flag = match (&self.error, self.time) {
            (Some(_), Some(_)) => {
                return Err(UseError::Accuracies("--error", "--time".into()));
            }
            (Some(_), None) => "--error",
            (None, Some(_)) => "--time",
            (None, None) if self.audit && sampling.pixel.is_some() => {
                return Err(UseError::AccuracyOfPixel("--audit"));
            }
            (None, None) => return Ok(()),
        };
        if sampling.pixel.is_some() {
            return Err(UseError::AccuracyOfPixel(flag));
        }
        match sampling.choices() {
            Some(other) => Err(UseError::Accuracies(flag, other.into())),
            None => Ok(()),
        }
    }

    /// Returns the text of the requested error, if there is one.
    pub fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    /// Returns the requested error, if there is one.
    fn requested(&self) -> Result<Option<f64>, UseError> {
        let error = self.error.as_ref().map(|text| {
            accuracy::error(text).map_err(|expected| UseError::Request(text.clone(), expected))
        });
        error.transpose()
    }

    /// Returns whether the flags choose the rays of the picture.
    pub fn chooses(&self) -> bool {
        self.error.is_some() || self.time.is_some()
    }

    /// Renders the picture that the flags request, and audits it if they request that. The settings become
    /// those that were chosen. Finished tiles are shown to `tile`. The flags must have been checked.
    pub fn render(
        &self,
        prepared: &Prepared<'_>,
        settings: &mut Settings,
        pixel_filter: PixelFilter,
        progress: &Progress,
        tile: Option<&Shown<'_>>,
    ) -> (Picture, Stats, Option<Statement>) {
        let tell = |step: &str, done, total| {
            if step == "picture" {
                progress.tell(done, total);
            }
        };
        let go_on = || !(self.partial && stop::is_stopped());
        let request = Request::new(prepared, settings, pixel_filter);
        let request = Request { progress: &tell, go_on: &go_on, tile, ..request };
        let reached = match (self.requested().ok().flatten(), self.time) {
            (Some(error), _) => request.reach(error),
            (None, Some(seconds)) => request.within(seconds),
            (None, None) => {
                let tell = |done, total| progress.tell(done, total);
                let course = Course { progress: &tell, go_on: &go_on, tile };
                let (picture, mut stats) = render_while(prepared, settings, &course);
                let audits = self.audit || stats.unfinished > 0;
                let statement =
                    audits.then(|| accuracy::audit(prepared, settings, &picture, &mut stats));
                return (picture, stats, statement);
            }
        };
        *settings = reached.settings;
        (reached.picture, reached.stats, Some(reached.statement))
    }

    /// Holds Ctrl-C back if the picture so far is wanted.
    pub fn hold_signals(&self) {
        if self.partial {
            stop::hold_next();
        }
    }

    /// Prints that the picture is not finished, if it is not.
    pub fn state_unfinished(&self, stats: &Stats, picture: &Picture) {
        if stats.unfinished > 0 {
            let (count, all) = (stats.unfinished, picture.pixels.len());
            say(format_args!("render: interrupted: {count} of {all} pixels are not finished"));
        }
    }

    /// Prints a statement as the last line of the run. If the run was interrupted, the program ends here
    /// by the signal.
    ///
    /// # Errors
    /// If the requested error was not reached; the error is the statement.
    pub fn state(&self, statement: Option<Statement>, quiet: bool) -> Result<(), Missed> {
        if let Some(statement) = statement.filter(|_| stop::is_stopped()) {
            say(statement);
        }
        stop::end_if_stopped();
        match statement {
            Some(statement) if statement.missed.is_some() => Err(Missed(statement)),
            Some(statement) if self.audit || !quiet => {
                say(statement);
                Ok(())
            }
            Some(_) | None => Ok(()),
        }
    }
}

/// Reads the value of --time.
fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds| (0.001..=1e6).contains(seconds));
    seconds.ok_or_else(|| "expected a number of seconds from 0.001 to 1000000".into())
}
