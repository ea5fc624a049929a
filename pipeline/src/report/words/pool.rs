//! Errors of several pages as one.

use super::super::measured::{Method, PageMeasured, Trial};
use crate::compare::Difference;
use render::Sampling;
use render::filter::Filter;

/// The thesis's filters, in the order in which one of them stands for its method: the tent is the
/// one that it settles on.
pub const THESIS: [Filter; 3] = [Filter::Tent, Filter::Box, Filter::Quadratic];

/// What a method made of a page, if it was measured.
pub fn trial<'a>(page: &'a PageMeasured, method: &Method) -> Option<&'a Trial> {
    page.trials.iter().find(|trial| trial.method == *method)
}

/// The trial of a filter with rays evenly spread.
pub fn evenly(page: &PageMeasured, filter: Filter, samples: u32) -> Option<&Trial> {
    trial(page, &Method { filter, sampling: Sampling::regular(samples) })
}

/// Numbers of rays along a side of a pixel with which a filter was measured, evenly spread; upward.
pub fn counts(page: &PageMeasured, filter: Filter) -> Vec<u32> {
    let own = page.trials.iter().filter(|trial| trial.method.filter == filter);
    let mut counts: Vec<u32> = own.filter_map(|trial| trial.method.evenly()).collect();
    counts.sort_unstable();
    counts.dedup();
    counts
}

/// The methods that were measured on every page, in the order of the first.
pub fn everywhere(pages: &[PageMeasured]) -> Vec<&Method> {
    let Some((first, others)) = pages.split_first() else { return Vec::new() };
    let methods = first.trials.iter().map(|trial| &trial.method);
    methods.filter(|method| others.iter().all(|page| trial(page, method).is_some())).collect()
}

/// The root mean square error over the pixels of several pictures. `None` without pixels.
pub fn pooled<'a>(differences: impl Iterator<Item = &'a Difference>) -> Option<f64> {
    let (mut sum, mut pixels) = (0.0, 0);
    for difference in differences {
        sum += difference.pixels as f64 * difference.rmse * difference.rmse;
        pixels += difference.pixels;
    }
    let error = (sum / pixels as f64).sqrt();
    error.is_finite().then_some(error)
}

/// The error of a method over all pixels of all pages.
pub fn whole(pages: &[PageMeasured], method: &Method) -> Option<f64> {
    let trials: Option<Vec<&Trial>> = pages.iter().map(|page| trial(page, method)).collect();
    pooled(trials?.iter().map(|trial| &trial.whole))
}

/// The geometric mean of what a function says of each page. `None` if it says nothing of one, or
/// something that has no logarithm.
pub fn mean(pages: &[PageMeasured], of: impl Fn(&PageMeasured) -> Option<f64>) -> Option<f64> {
    let logarithms: Option<Vec<f64>> = pages.iter().map(|page| of(page).map(f64::ln)).collect();
    let logarithms = logarithms.filter(|all| !all.is_empty())?;
    let mean = (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp();
    (mean.is_finite() && mean > 0.0).then_some(mean)
}

/// Processor time of one method by another's, in the geometric mean of the pages.
pub fn time_ratio(pages: &[PageMeasured], method: &Method, by: &Method) -> Option<f64> {
    mean(pages, |page| Some(trial(page, method)?.cost.cpu / trial(page, by)?.cost.cpu))
}
