//! A progress bar on standard error, for work that takes longer than a second.

use crate::words;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Time after which the bar appears.
const PATIENCE: Duration = Duration::from_secs(1);

/// A bar that appears after a second, and only on a terminal.
#[derive(Debug)]
pub struct Progress {
    label: String,
    started: Instant,
    shown: bool,
    bar: OnceLock<ProgressBar>,
}

impl Progress {
    /// Makes a bar with a label. The bar is never shown when `quiet` is true or standard error is
    /// not a terminal.
    #[must_use]
    pub fn new(label: &str, quiet: bool) -> Self {
        let shown = !quiet && std::io::stderr().is_terminal();
        Self {
            label: words::shown(label).to_string(),
            started: Instant::now(),
            shown,
            bar: OnceLock::new(),
        }
    }

    /// Shows that `done` of `total` steps are done.
    pub fn tell(&self, done: usize, total: usize) {
        if !self.shown || self.started.elapsed() < PATIENCE {
            return;
        }
        let bar = self.bar.get_or_init(|| {
            let bar = ProgressBar::with_draw_target(
                Some(total as u64),
                ProgressDrawTarget::stderr_with_hz(10),
            );
            let template = "{msg} [{bar:32}] {percent:>3} %  {elapsed} of about {duration}";
            let style = ProgressStyle::with_template(template);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.set_message(self.label.clone());
            bar.with_elapsed(self.started.elapsed())
        });
        // Tiles may finish out of order; the bar never moves back.
        bar.set_position(bar.position().max(done as u64));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}
