//! Finds trials by their method, and combines the numbers of several pages into one.

use super::measured::{Method, PageMeasured, Trial};
use compare::Difference;
use render::Sampling;
use render::filter::Filter;

/// Returns the trial of a method on a page, if the method was measured.
pub fn trial<'a>(page: &'a PageMeasured, method: &Method) -> Option<&'a Trial> {
    page.trials.iter().find(|trial| trial.method == *method)
}

/// Returns the method of a filter with `samples * samples` evenly spread rays in a pixel.
pub fn evenly(filter: Filter, samples: u32) -> Method {
    Method { filter, sampling: Sampling::regular(samples) }
}

/// Returns the numbers of evenly spread rays along a side of a pixel with which a filter was measured,
/// in rising order.
pub fn counts(page: &PageMeasured, filter: Filter) -> Vec<u32> {
    let own = page.trials.iter().filter(|trial| trial.method.filter == filter);
    let mut counts: Vec<u32> = own.filter_map(|trial| trial.method.evenly()).collect();
    counts.sort_unstable();
    counts.dedup();
    counts
}

/// Returns the root mean square error over the pixels of several pictures. `None` without pixels.
pub fn pooled<'a>(differences: impl Iterator<Item = &'a Difference>) -> Option<f64> {
    let (mut sum, mut pixels) = (0.0, 0);
    for difference in differences {
        sum += difference.pixels as f64 * difference.rmse * difference.rmse;
        pixels += difference.pixels;
    }
    let error = (sum / pixels as f64).sqrt();
    error.is_finite().then_some(error)
}

/// Returns the root mean square error of a method over all pixels of all pages. `None` if the method
/// was not measured on a page.
pub fn whole(pages: &[PageMeasured], method: &Method) -> Option<f64> {
    let trials: Option<Vec<&Trial>> = pages.iter().map(|page| trial(page, method)).collect();
    pooled(trials?.iter().map(|trial| &trial.whole))
}

/// Returns the geometric mean of the values that `of` returns for the pages. `None` if `of` returns
/// `None` for a page or the mean is not finite and positive.
pub fn mean(pages: &[PageMeasured], of: impl Fn(&PageMeasured) -> Option<f64>) -> Option<f64> {
    let logarithms: Option<Vec<f64>> = pages.iter().map(|page| of(page).map(f64::ln)).collect();
    let logarithms = logarithms.filter(|all| !all.is_empty())?;
    let mean = (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp();
    (mean.is_finite() && mean > 0.0).then_some(mean)
}

/// Returns the root mean square error of a method over the pixels of a region of all pages that have
/// it. `None` if no page has it, or the method was not measured on a page that has it.
pub fn in_region(pages: &[PageMeasured], method: &Method, name: &str) -> Option<f64> {
    let parts = pages.iter().filter_map(|page| {
        Some((page, page.regions.iter().position(|region| region.name == name)?))
    });
    let parts: Option<Vec<&Difference>> =
        parts.map(|(page, k)| trial(page, method)?.by_region.get(k)).collect();
    pooled(parts?.into_iter())
}

/// Returns the processor time of one method over that of another, in the geometric mean of the pages.
pub fn time_ratio(pages: &[PageMeasured], method: &Method, by: &Method) -> Option<f64> {
    mean(pages, |page| Some(trial(page, method)?.cost.cpu / trial(page, by)?.cost.cpu))
}
