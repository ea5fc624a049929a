//! A progress bar whose label changes with the work.

use files::progress::Progress;
use std::sync::{Mutex, PoisonError};

/// A progress bar on standard error for one kind of work after another.
#[derive(Debug)]
pub struct Bar {
    quiet: bool,
    /// The bar of the current work, with its label.
    current: Mutex<Option<(String, Progress)>>,
}

impl Bar {
    /// Makes a bar that is never drawn if `quiet`.
    pub fn new(quiet: bool) -> Self {
        Self { quiet, current: Mutex::default() }
    }

    /// Shows that `done` of `total` parts of the work are done. Another label starts a new bar.
    pub fn tell(&self, label: &str, done: usize, total: usize) {
        let mut current = self.current.lock().unwrap_or_else(PoisonError::into_inner);
        if current.as_ref().is_none_or(|(shown, _)| shown != label) {
            *current = Some((label.into(), Progress::new(label, self.quiet)));
        }
        if let Some((_, progress)) = current.as_ref() {
            progress.tell(done, total);
        }
    }

    /// Removes the bar from the screen.
    pub fn clear(&self) {
        *self.current.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }
}
