//! Sentences on the effect of the filters in the regions of the pictures.

use super::super::measured::{Method, PageMeasured};
use super::pool::{THESIS, pooled, trial};
use super::{Claim, HELPS, NO_HELP, Topic, Verdict, as_near, nearer};
use crate::compare::Difference;
use crate::number::{error, times};
use render::Sampling;
use render::filter::Filter;

/// Number of rays along a side of a pixel that stands for many rays.
const MANY: u32 = 4;

/// Returns one sentence for each region.
pub fn claims(pages: &[PageMeasured]) -> Vec<Claim> {
    let mut names: Vec<&'static str> = Vec::new();
    for region in pages.iter().flat_map(|page| &page.regions) {
        if !names.contains(&region.name) {
            names.push(region.name);
        }
    }
    names.into_iter().filter_map(|name| claim(pages, name)).collect()
}

/// A region on all pages that have it.
struct Everywhere<'a> {
    /// The pages, each with the index of the region among its regions.
    places: Vec<(&'a PageMeasured, usize)>,
}

impl Everywhere<'_> {
    /// Returns the error of a filter with `samples * samples` rays, if it was measured on all these
    /// pages.
    fn error(&self, filter: Filter, samples: u32) -> Option<f64> {
        let method = Method { filter, sampling: Sampling::regular(samples) };
        let found: Option<Vec<&Difference>> =
            self.places.iter().map(|&(page, at)| trial(page, &method)?.by_region.get(at)).collect();
        pooled(found?.into_iter())
    }
}

fn claim(pages: &[PageMeasured], name: &str) -> Option<Claim> {
    let at = |page: &PageMeasured| page.regions.iter().position(|region| region.name == name);
    let places = pages.iter().filter_map(|page| Some((page, at(page)?))).collect();
    let region = Everywhere { places };
    let bilinear = region.error(Filter::Bilinear, 1)?;
    let (filter, own) =
        THESIS.iter().find_map(|&filter| Some((filter, region.error(filter, 1)?)))?;
    let errors: Vec<(Filter, f64)> =
        Filter::ALL.iter().filter_map(|&filter| Some((filter, region.error(filter, 1)?))).collect();
    let &(best, least) = errors
        .iter()
        .filter(|(filter, _)| filter.wants_area())
        .min_by(|a, b| a.1.total_cmp(&b.1))?;
    let greatest = errors.iter().map(|(_, error)| *error).fold(0.0, f64::max);
    let smallest = errors.iter().map(|(_, error)| *error).fold(f64::INFINITY, f64::min);
    let place = place(name);
    let (verdict, mut text) = if least > NO_HELP * bilinear {
        let off = match (error(smallest), error(greatest)) {
            (low, high) if low == high => low,
            (low, high) => format!("{low} to {high}"),
        };
        let text =
            format!("{place} no filter helps: with one ray the error is {off} whatever the filter");
        (Verdict::Loses, text + &of_samples(&region, bilinear))
    } else {
        let (verdict, words) = if own <= HELPS * bilinear {
            (Verdict::Wins, format!("is {} times nearer", times(bilinear / own)))
        } else if nearer(bilinear, own) {
            (Verdict::Loses, "is farther off".to_string())
        } else {
            (Verdict::Even, "helps little".to_string())
        };
        let text = format!(
            "{place} the {filter} with one ray {words}: {} where one bilinear ray is {} off",
            error(own),
            error(bilinear)
        );
        (verdict, text + &worth(&region, own))
    };
    if best != filter && nearer(least, own) {
        text +=
            &format!("; with one ray the {best} is nearer than the {filter}, {} off", error(least));
    }
    text.push('.');
    Some(Claim::general(Topic::Region, verdict, text))
}

/// Returns the part of a sentence on the effect of many rays where no filter helps.
fn of_samples(region: &Everywhere<'_>, one: f64) -> String {
    let counts = (2..=MANY).rev();
    let Some((n, many)) =
        counts.filter_map(|n| Some((n, region.error(Filter::Bilinear, n)?))).next()
    else {
        return String::new();
    };
    let many_said = error(many);
    if many <= HELPS * one {
        format!("; samples are what counts: {n} x {n} bilinear rays are {many_said} off")
    } else {
        format!("; nor do samples help much: {n} x {n} bilinear rays are still {many_said} off")
    }
}

/// Returns the part of a sentence on how many bilinear rays are as near in the region.
fn worth(region: &Everywhere<'_>, own: f64) -> String {
    let counts = (2..=render::film::MOST_SAMPLES).map(|n| (n, region.error(Filter::Bilinear, n)));
    let measured: Vec<(u32, f64)> = counts.filter_map(|(n, found)| Some((n, found?))).collect();
    match (measured.iter().find(|(_, rays)| as_near(*rays, own)), measured.last()) {
        (Some((n, rays)), _) => {
            format!("; it takes {n} x {n} of those ({}) to be as near", error(*rays))
        }
        (None, Some((n, rays))) => {
            format!("; {n} x {n} of those are not as near ({})", error(*rays))
        }
        (None, None) => String::new(),
    }
}

fn place(name: &str) -> String {
    match name {
        "far floor" => "On the far floor".into(),
        "in mirrors" => "In mirrors".into(),
        "through glass" => "Through glass".into(),
        "silhouettes" => "At silhouettes".into(),
        other => format!("In the region \"{other}\""),
    }
}
