//! The modes in which a scene is rendered, and the thesis's figures that they reproduce.

use super::{check_word, figure};
use files::JsonError;
use files::json::Document;
use render::Sampling;
use render::accel::Structure;
use render::film::{MOST_SAMPLES, PatternName, PixelFilter, Supersample};
use render::filter::Filter;
use serde::Deserialize;
use std::collections::HashSet;

/// The settings of one rendering of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mode {
    /// The name of the mode. The name of its picture file is that of the job and this name.
    pub name: String,
    /// The filter that averages textures.
    pub filter: Filter,
    /// The pattern of rays in a pixel.
    pub sampling: Sampling,
    /// The structure that finds the hits. All structures give the same picture.
    pub accel: Structure,
    /// The figure of the thesis that the mode reproduces, such as `A.5`.
    pub figure: Option<String>,
    /// The time of that figure in 1993, in minutes.
    pub thesis_minutes: Option<u32>,
}

impl Mode {
    /// Returns the number of the figure that the mode reproduces.
    #[must_use]
    pub fn figure_number(&self) -> Option<u8> {
        figure::number(self.figure.as_deref()?)
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ModeFile {
    name: String,
    filter: Filter,
    #[serde(default)]
    accel: Structure,
    #[serde(default)]
    samples: Option<u32>,
    #[serde(default)]
    pattern: Option<PatternName>,
    #[serde(default)]
    seed: Option<u64>,
    #[serde(default)]
    pixel_filter: Option<PixelFilter>,
    #[serde(default)]
    supersample: Option<Supersample>,
    #[serde(default)]
    figure: Option<String>,
    #[serde(default)]
    thesis_minutes: Option<u32>,
}

/// Checks the modes of a job. A job file without modes has one, with the tent filter.
pub(super) fn modes(
    document: &Document<'_>,
    modes: Option<Vec<ModeFile>>,
) -> Result<Vec<Mode>, JsonError> {
    let Some(modes) = modes else {
        return Ok(vec![Mode {
            name: "tent".into(),
            filter: Filter::Tent,
            sampling: Sampling::regular(1),
            accel: Structure::Bvh,
            figure: None,
            thesis_minutes: None,
        }]);
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
        let sampling = sampling(document, &format!("modes[{k}]"), &mode)?;
        if let Some(figure) = &mode.figure {
            check_figure(document, &format!("modes[{k}].figure"), figure)?;
        }
        let ModeFile { name, filter, accel, figure, thesis_minutes, .. } = mode;
        checked.push(Mode { name, filter, sampling, accel, figure, thesis_minutes });
    }
    Ok(checked)
}

/// Returns the pattern of rays in a pixel, for the mode at `path`.
fn sampling(document: &Document<'_>, path: &str, mode: &ModeFile) -> Result<Sampling, JsonError> {
    let fault = |key: &str, message: String| Err(document.fault(&format!("{path}.{key}"), message));
    if let Some(nine) = mode.supersample {
        let others = [
            ("samples", mode.samples.is_some()),
            ("pattern", mode.pattern.is_some()),
            ("seed", mode.seed.is_some()),
            ("pixel_filter", mode.pixel_filter.is_some()),
        ];
        return match others.iter().find(|(_, there)| *there) {
            Some((key, _)) => {
                fault(key, format!("found {key} beside supersample, expected one of them"))
            }
            None => Ok(Sampling::Supersample(nine)),
        };
    }
    let samples = mode.samples.unwrap_or(1);
    if !(1..=MOST_SAMPLES).contains(&samples) {
        return fault("samples", format!("found {samples}, expected 1 to {MOST_SAMPLES}"));
    }
    let Some(pattern) = mode.pattern.unwrap_or_default().pattern(mode.seed) else {
        return fault("seed", "found a seed, expected it beside \"pattern\": \"jitter\"".into());
    };
    let pixel_filter = mode.pixel_filter.unwrap_or_default();
    if pixel_filter == PixelFilter::Tent && samples < 2 {
        return fault("pixel_filter", "found tent, expected it beside samples of 2 or more".into());
    }
    Ok(Sampling::Grid { samples, pattern, pixel_filter })
}

fn check_figure(document: &Document<'_>, path: &str, figure: &str) -> Result<(), JsonError> {
    if figure::number(figure).is_some() {
        return Ok(());
    }
    Err(document.fault(path, format!("found {figure:?}, expected a figure such as \"A.5\"")))
}
