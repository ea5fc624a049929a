//! The sentences on exact averages over areas, compared with other filters and with the thesis's lattice.

use super::sentence::{AS_NEAR, Question, Sentence};
use crate::number::{bytes, error, times};
use crate::report::measured::{Method, PageMeasured, Trial};
use crate::report::pool::{evenly, in_region, time_ratio, trial, whole};
use render::Sampling;
use render::film::{Supersample, THRESHOLD};
use render::filter::Filter;

/// The region in which filters are compared. Silhouettes, whose errors no filter changes, would hide the
/// differences in a whole picture.
const FILTERED: &str = "far floor";

/// Returns all sentences on areas that the numbers support.
#[must_use]
pub fn sentences(pages: &[PageMeasured]) -> Vec<Sentence> {
    let mut all: Vec<Sentence> =
        [cost(pages), splits(pages), filters(pages)].into_iter().flatten().collect();
    let mut names: Vec<&'static str> = Vec::new();
    for region in pages.iter().flat_map(|page| &page.regions) {
        if !names.contains(&region.name) {
            names.push(region.name);
        }
    }
    all.extend(names.into_iter().filter_map(|name| region(pages, name)));
    all.extend(pages.iter().filter_map(worth));
    all
}

/// Returns the exact average over one area in each pixel, split at this threshold or whole.
fn exact(threshold: Option<f64>) -> Method {
    Method::area(Filter::Exact, 1, threshold)
}

/// Returns the time of a method over that of one bilinear ray, in the geometric mean of the pages.
fn by_bilinear(pages: &[PageMeasured], method: &Method) -> Option<f64> {
    time_ratio(pages, method, &evenly(Filter::Bilinear, 1))
}

/// Returns the time and the memory of the exact average over whole pixels.
fn cost(pages: &[PageMeasured]) -> Option<Sentence> {
    let more = pages.iter().filter_map(|page| {
        let own = trial(page, &exact(None))?.cost.peak_bytes;
        let one = trial(page, &evenly(Filter::Bilinear, 1))?.cost.peak_bytes;
        Some(own.saturating_sub(one) as u64)
    });
    let text = format!(
        "One exact average over each pixel's area takes {} times the time of one bilinear ray, \
         and up to {} more memory.",
        times(by_bilinear(pages, &exact(None))?),
        bytes(more.max()?)
    );
    Some(Sentence::general(Question::Areas, text))
}

/// Returns errors and times over all pages for each threshold of splitting.
fn splits(pages: &[PageMeasured]) -> Option<Sentence> {
    let methods = pages.first()?.trials.iter().map(|own| own.method);
    let splits = methods.filter(|method| {
        method.filter == Filter::Exact && matches!(method.areas(), Some((1, Some(_))))
    });
    let part = |method: &Method, words: &str| {
        let (error_of_all, ratio) = (whole(pages, method)?, by_bilinear(pages, method)?);
        Some(format!("{} {words} ({})", error(error_of_all), times(ratio)))
    };
    let mut parts = vec![part(&exact(None), "with whole pixels")?];
    parts.extend(splits.filter_map(|method| {
        let (_, threshold) = method.areas()?;
        part(&method, &format!("split at {}", threshold?))
    }));
    let text = format!(
        "The error of exact averages over all pages is {}; in brackets is the time relative to one \
         bilinear ray.",
        parts.join(", ")
    );
    (parts.len() > 1).then(|| Sentence::general(Question::Areas, text))
}

/// Returns the errors of all filters over the same whole pixels where filters matter, smallest first.
fn filters(pages: &[PageMeasured]) -> Option<Sentence> {
    let rated = Filter::ALL.into_iter().filter_map(|filter| {
        let method = Method::area(filter, 1, None);
        let own = in_region(pages, &method, FILTERED)?;
        Some((filter, own, by_bilinear(pages, &method)?))
    });
    let mut rated: Vec<(Filter, f64, f64)> = rated.collect();
    rated.sort_by(|a, b| a.1.total_cmp(&b.1));
    let parts: Vec<String> = rated
        .iter()
        .map(|(filter, own, ratio)| format!("{filter} {} ({})", error(*own), times(*ratio)))
        .collect();
    let text = format!(
        "Region {FILTERED}, over the same whole pixels: {} has the smallest error of the \
         filters. The errors are {}; in brackets is the time relative to one bilinear ray.",
        rated.first()?.0,
        parts.join(", ")
    );
    (rated.len() > 1).then(|| Sentence::general(Question::Areas, text))
}

/// Returns the errors in a region with whole and with split pixels, beside those of the thesis's method.
fn region(pages: &[PageMeasured], name: &str) -> Option<Sentence> {
    let of = |method: &Method| in_region(pages, method, name).map(error);
    let nine = [Supersample::Image, Supersample::Rays].into_iter().find_map(|nine| {
        of(&Method { filter: Filter::Tent, sampling: Sampling::Supersample(nine) })
    });
    let text = format!(
        "Region {name}: the error of exact averages is {} with whole pixels and {} with pixels \
         split at {THRESHOLD}; that of the tent is {} with one ray and {} supersampled.",
        of(&exact(None))?,
        of(&exact(Some(THRESHOLD)))?,
        of(&evenly(Filter::Tent, 1))?,
        nine?
    );
    Some(Sentence::general(Question::Areas, text))
}

/// Returns the time of split pixels on a page, by that of the fastest method on the thesis's lattice that
/// is as near to the truth.
fn worth(page: &PageMeasured) -> Option<Sentence> {
    let own = trial(page, &exact(Some(THRESHOLD)))?;
    let lattice = || page.trials.iter().filter(|trial| trial.method.areas().is_none());
    let as_near = |trial: &&Trial| trial.whole.rmse <= AS_NEAR * own.whole.rmse;
    let fastest = lattice().filter(as_near).min_by(|a, b| a.cost.cpu.total_cmp(&b.cost.cpu));
    let nearest = || lattice().min_by(|a, b| a.whole.rmse.total_cmp(&b.whole.rmse));
    let (other, which) = match fastest {
        Some(other) => (other, "the fastest measured method of the lattice with as small an error"),
        None => (nearest()?, "the nearest measured method of the lattice, whose error is larger"),
    };
    let text = format!(
        "On {} exact averages split at {THRESHOLD} ({}) take {} times the time of {} ({}), {which}.",
        page.name,
        error(own.whole.rmse),
        times(own.cost.cpu / other.cost.cpu),
        other.method.name(),
        error(other.whole.rmse)
    );
    Some(Sentence { question: Question::Areas, page: Some(page.name.clone()), text })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::{Law, edges, floor, page, with_areas};

    /// Returns the only sentence with these words.
    fn one(pages: &[PageMeasured], words: &str) -> String {
        let mut all = sentences(pages);
        all.retain(|sentence| sentence.text.contains(words));
        let [sentence] = &all[..] else { panic!("{words}: {all:?}") };
        assert_eq!(sentence.question, Question::Areas);
        sentence.text.clone()
    }

    #[test]
    fn the_cost_of_an_area_is_its_time_and_its_memory() {
        let mut pages = vec![with_areas("a", &floor, &[])];
        let own = pages[0].trials.iter_mut().find(|own| own.method == exact(None)).unwrap();
        own.cost.peak_bytes += 3 << 20;
        // The price of exact is 1.5 in the fixture, and that of bilinear 1.
        let text = "One exact average over each pixel's area takes 1.5 times the time of one \
                    bilinear ray, and up to 3.0 MiB more memory.";
        assert_eq!(one(&pages, "One exact average"), text);
    }

    #[test]
    fn splitting_is_rated_at_each_threshold() {
        let pages = [with_areas("a", &floor, &[]), with_areas("b", &floor, &[])];
        // One area split at t stands for n = 1 + 0.02 / t rays along a side: 1.2, 1.7 and 3. The error is 0.006 / n^0.8,
        // and the time 1.5 n^2.
        let text = "The error of exact averages over all pages is 0.0060 with whole pixels \
                    (1.5), 0.0052 split at 0.1 (2.2), 0.0040 split at 0.03 (4.2), 0.0025 split \
                    at 0.01 (14); in brackets is the time relative to one bilinear ray.";
        assert_eq!(one(&pages, "split at 0.03"), text);
    }

    #[test]
    fn the_nearest_filter_over_the_same_areas_is_named() {
        let far: [(&str, &Law<'_>); 1] = [("far floor", &floor)];
        let words = "over the same whole pixels";
        let text = one(&[with_areas("a", &edges, &far)], words);
        assert!(text.contains("pixels: exact has the smallest error of the filters."), "{text}");
        assert!(
            text.contains("are exact 0.0060 (1.5), ewa64 0.0090 (7.0), ewa16 0.010 (4.0)"),
            "{text}"
        );
        let probes = |filter, n: f64| match filter {
            Filter::Probes => (0.001 / n, 0.1),
            filter => floor(filter, n),
        };
        let text = one(&[with_areas("a", &edges, &[("far floor", &probes)])], words);
        assert!(text.contains("pixels: probes has the smallest error"), "{text}");
    }

    #[test]
    fn each_region_has_both_errors_beside_those_of_the_thesis() {
        // The error on edges is 0.212 / n.
        let pages = [with_areas("a", &floor, &[("silhouettes", &edges)])];
        let text = "Region silhouettes: the error of exact averages is 0.21 with whole pixels \
                    and 0.18 with pixels split at 0.1; that of the tent is 0.21 with one ray \
                    and 0.11 supersampled.";
        assert_eq!(one(&pages, "Region silhouettes"), text);
    }

    #[test]
    fn split_areas_are_worth_the_fastest_method_that_is_as_near() {
        // Split at 0.1, exact stands for 1.2 rays along a side, with a time of 0.02 * 1.5 * 1.44 s.
        let said = |left: f64| {
            let law = move |filter, n: f64| match filter {
                Filter::Exact => (left, floor(filter, n).1),
                filter => floor(filter, n),
            };
            one(&[with_areas("a", &law, &[])], "On a exact averages")
        };
        // The tent leaves 0.04 at 2.0 times the time of one bilinear ray: 2.16 by 2.
        let text = "On a exact averages split at 0.1 (0.040) take 1.1 times the time of tent, \
                    1 ray (0.040), the fastest measured method of the lattice with as small an \
                    error.";
        assert_eq!(said(0.04), text);
        // The smallest error of the lattice is that of the quadratic with 8 x 8 rays, 0.0396 / 8^0.8.
        let text = "take 0.0056 times the time of quadratic, 8 x 8 rays (0.0075), the nearest \
                    measured method of the lattice, whose error is larger.";
        assert!(said(0.001).ends_with(text), "{}", said(0.001));
    }

    #[test]
    fn without_areas_nothing_is_said() {
        assert_eq!(sentences(&[page("a", &floor, &[("far floor", &floor)])]), []);
        assert_eq!(sentences(&[]), []);
    }
}
