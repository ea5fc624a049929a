//! Jobs with other modes than those of their files.

use super::{Job, Mode};
use crate::PipelineError;

impl Job {
    /// Returns the job with only the modes of these names, in the job's own order. Without names,
    /// all modes stay.
    ///
    /// # Errors
    /// When the job has no mode of one of the names.
    pub fn with_modes(mut self, names: &[String]) -> Result<Self, PipelineError> {
        let has = |name: &&String| self.modes.iter().any(|mode| mode.name == **name);
        if let Some(name) = names.iter().find(|name| !has(name)) {
            let known: Vec<&str> = self.modes.iter().map(|mode| mode.name.as_str()).collect();
            let (job, name, known) = (self.name.clone(), name.clone(), known.join(", "));
            return Err(PipelineError::UnknownMode { job, name, known });
        }
        let all = self.modes.len();
        self.modes.retain(|mode| names.is_empty() || names.contains(&mode.name));
        self.whole &= self.modes.len() == all;
        Ok(self)
    }

    /// Returns the job with one mode `error` in place of its own, which reaches this error.
    #[must_use]
    pub fn with_error(mut self, error: f64) -> Self {
        self.modes = vec![Mode::of_error("error", error)];
        self
    }

    /// Returns the job with a further mode `error` that reaches this error, unless it has a mode of that
    /// name.
    #[must_use]
    pub fn and_error(mut self, error: f64) -> Self {
        let mode = Mode::of_error("error", error);
        self.further = (!self.modes.iter().any(|own| own.name == mode.name)).then_some(mode);
        self
    }

    /// Returns the job with only those modes that show one of these figures.
    #[must_use]
    pub fn only(mut self, figures: &[u8]) -> Self {
        let all = self.modes.len();
        self.modes.retain(|mode| mode.figure_number().is_some_and(|k| figures.contains(&k)));
        self.whole &= self.modes.len() == all;
        self
    }
}
