//! The progress of work that takes longer than a second, on standard error.
//!
//! | mode | shown |
//! |---|---|
//! | `bar` | a bar, and only on a terminal |
//! | `plain` | a line each second: `render: 40 %, 3.2 s` |
//! | `json` | a line each second: `{"progress":"render","done":40,"total":100,"seconds":3.2}` |
//! | `none` | nothing |
//!
//! In the modes of lines the last line states that all parts are done, however short the work was.

use crate::exit::say;
use crate::words;
use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// Time after which the bar appears, and between two lines.
const PATIENCE: Duration = Duration::from_secs(1);

/// The form in which progress is shown.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum Mode {
    /// A bar, on a terminal
    #[default]
    Bar,
    /// Lines for people
    Plain,
    /// Lines of JSON
    Json,
    /// Nothing
    None,
}

/// The mode of this process.
static MODE: OnceLock<Mode> = OnceLock::new();

/// Sets the mode for all progress of this process. The first call counts.
pub fn choose(mode: Mode) {
    let _ = MODE.set(mode);
}

/// The progress of one work. A bar appears after a second.
#[derive(Debug)]
pub struct Progress {
    label: String,
    started: Instant,
    mode: Mode,
    bar: OnceLock<ProgressBar>,
    /// The lines that were printed.
    lines: Mutex<Lines>,
}

#[derive(Debug, Default)]
struct Lines {
    last: Option<Instant>,
    most: usize,
}

impl Progress {
    /// Makes a progress with a label. Nothing is shown when `quiet` is true, and no bar when standard error is not a
    /// terminal.
    #[must_use]
    pub fn new(label: &str, quiet: bool) -> Self {
        let mode = match MODE.get().copied().unwrap_or_default() {
            _ if quiet => Mode::None,
            Mode::Bar if !std::io::stderr().is_terminal() => Mode::None,
            mode => mode,
        };
        Self {
            label: words::shown(label).to_string(),
            started: Instant::now(),
            mode,
            bar: OnceLock::new(),
            lines: Mutex::default(),
        }
    }

    /// Shows that `done` of `total` steps are done.
    pub fn tell(&self, done: usize, total: usize) {
        match self.mode {
            Mode::None => {}
            Mode::Bar => self.draw(done, total),
            Mode::Plain | Mode::Json => self.print(done, total),
        }
    }

    fn draw(&self, done: usize, total: usize) {
        if self.started.elapsed() < PATIENCE {
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

    fn print(&self, done: usize, total: usize) {
        let mut lines = self.lines.lock().unwrap_or_else(PoisonError::into_inner);
        let since = lines.last.unwrap_or(self.started).elapsed();
        if done <= lines.most || (since < PATIENCE && done < total) {
            return;
        }
        *lines = Lines { last: Some(Instant::now()), most: done };
        say(line(self.mode, &self.label, [done, total], self.started.elapsed()));
    }
}

/// Returns the line of a mode of lines.
fn line(mode: Mode, label: &str, [done, total]: [usize; 2], time: Duration) -> String {
    let seconds = time.as_secs_f64();
    if mode == Mode::Json {
        let label = serde_json::Value::from(label);
        return format!(
            "{{\"progress\":{label},\"done\":{done},\"total\":{total},\"seconds\":{seconds:.1}}}"
        );
    }
    let percent = 100 * done / total.max(1);
    format!("{label}: {percent} %, {seconds:.1} s")
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_for_people_or_for_programs() {
        let time = Duration::from_millis(3210);
        assert_eq!(line(Mode::Plain, "render", [2, 5], time), "render: 40 %, 3.2 s");
        let json = line(Mode::Json, "a \"b\"", [2, 5], time);
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert_eq!(json["progress"], "a \"b\"");
        assert_eq!((json["done"].as_u64(), json["total"].as_u64()), (Some(2), Some(5)));
        assert_eq!(json["seconds"], 3.2);
    }
}
