//! The modes in which a scene is rendered, and the thesis's figures that they reproduce.

use super::file::ModeFile;
use super::requested::Requested;
use super::sampling::SamplingKeys;
use super::{check_word, figure};
use files::JsonError;
use files::json::Document;
use render::Sampling;
use render::accel::Structure;
use render::film::{PixelFilter, THRESHOLD};
use render::filter::Filter;
use std::collections::HashSet;

/// The settings of one rendering of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// The name of the mode. The name of its picture file is that of the job and this name.
    pub name: String,
    /// The filter that averages textures.
    pub filter: Filter,
    /// The rays of a pixel, and the areas that they stand for.
    pub sampling: Sampling,
    /// The error below which the picture must be, in linear light; `None` if the mode requests none.
    /// With it, the rays are chosen anew, and of `sampling` only the pixel filter is used.
    pub error: Option<f64>,
    /// The structure that finds the hits. All structures give the same picture.
    pub accel: Structure,
    /// The figure of the thesis that the mode reproduces, such as `A.5`.
    pub figure: Option<String>,
    /// The time of that figure in 1993, in minutes.
    pub thesis_minutes: Option<u32>,
}

impl Mode {
    /// Returns the mode of this name without a figure, by this filter and sampling.
    #[must_use]
    pub fn new(name: &str, filter: Filter, sampling: Sampling) -> Self {
        let (accel, figure, thesis_minutes) = (Structure::default(), None, None);
        Self { name: name.into(), filter, sampling, error: None, accel, figure, thesis_minutes }
    }

    /// Returns a mode of this name, whose rays are chosen for a requested error.
    #[must_use]
    pub fn of_error(name: &str, error: f64) -> Self {
        Self { name: name.into(), error: Some(error), ..Self::exact() }
    }

    /// Returns the mode `exact`: exact averages over areas, with pixels split at edges.
    #[must_use]
    pub fn exact() -> Self {
        let (pixel_filter, threshold) = (PixelFilter::Box, Some(THRESHOLD));
        let sampling = Sampling::Area { samples: 1, pixel_filter, threshold };
        Self::new("exact", Filter::Exact, sampling)
    }

    /// Returns whether the mode averages exactly over areas, as the mode [`Mode::exact`] does.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.filter == Filter::Exact && matches!(self.sampling, Sampling::Area { .. })
    }

    /// Returns the number of the figure that the mode reproduces.
    #[must_use]
    pub fn figure_number(&self) -> Option<u8> {
        figure::number(self.figure.as_deref()?)
    }
}

impl ModeFile {
    /// Returns the keys that choose the rays of a pixel.
    pub(super) fn sampling_keys(&self) -> SamplingKeys {
        let Self { sampling, samples, split, pattern, seed, pixel_filter, supersample, .. } = *self;
        let error = self.error;
        SamplingKeys { sampling, error, samples, split, pattern, seed, pixel_filter, supersample }
    }
}

/// Checks the modes of a job. A job file without modes has one, [`Mode::exact`].
pub(super) fn modes(
    document: &Document<'_>,
    modes: Option<Vec<ModeFile>>,
) -> Result<Vec<Mode>, JsonError> {
    let Some(modes) = modes else {
        return Ok(vec![Mode::exact()]);
    };
    if modes.is_empty() {
        return Err(document.fault("modes", "found no modes, expected at least one"));
    }
    let mut checked: Vec<Mode> = Vec::with_capacity(modes.len());
    let mut names = HashSet::new();
    for (k, mode) in modes.into_iter().enumerate() {
        let name_path = format!("modes[{k}].name");
        check_word(document, &name_path, &mode.name)?;
        if !names.insert(mode.name.clone()) {
            let message = format!("found {:?} twice, expected a name for each mode", mode.name);
            return Err(document.fault(&name_path, message));
        }
        let sampling = mode.sampling_keys().check(document, &format!("modes[{k}]"))?;
        if let Some(figure) = &mode.figure {
            check_figure(document, &format!("modes[{k}].figure"), figure)?;
        }
        let ModeFile { name, filter, error, accel, figure, thesis_minutes, .. } = mode;
        let filter = filter.unwrap_or(Filter::Exact);
        let error = error.map(Requested::number);
        checked.push(Mode { name, filter, sampling, error, accel, figure, thesis_minutes });
    }
    Ok(checked)
}

fn check_figure(document: &Document<'_>, path: &str, figure: &str) -> Result<(), JsonError> {
    if figure::number(figure).is_some() {
        return Ok(());
    }
    Err(document.fault(path, format!("found {figure:?}, expected a figure such as \"A.5\"")))
}
