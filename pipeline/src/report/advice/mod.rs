//! The sentences of a report: which method to use, what the thesis's method costs, and where it fails.
//!
//! Each sentence has one form, which is filled with numbers, and is left out where the numbers are
//! missing. The tent with one ray stands for the thesis's method, and one bilinear ray in each pixel is
//! the unit of time. `budget.rs` holds the advice for a time and a size, and `areas.rs` the sentences on area sampling.

mod areas;
mod budget;
mod sentence;

pub use sentence::{AS_NEAR, Question, Sentence};

use super::measured::{Measured, PageMeasured};
use super::pool::{counts, evenly, in_region, time_ratio, trial, whole};
use crate::number::{bytes, error, times};
use render::filter::Filter;

/// No filter helps where even the best leaves more than this fraction of the error of bilinear
/// interpolation.
const NO_HELP: f64 = 0.9;

/// Largest difference between the truth's two pictures, as a fraction of the smallest error, that
/// causes no doubt. Both are root mean squares.
const NOISE: f64 = 0.2;

/// Returns all sentences that the numbers support.
#[must_use]
pub fn sentences(measured: &Measured) -> Vec<Sentence> {
    let pages = &measured.pages;
    let mut all = budget::sentences(pages);
    all.extend(areas::sentences(pages));
    all.extend(cost(pages));
    all.extend(many_rays(pages));
    all.extend(regions(pages));
    all.extend(pages.iter().flat_map(|page| [worth(page), doubt(page)]).flatten());
    all
}

/// Returns the time and the memory of one ray with the tent.
fn cost(pages: &[PageMeasured]) -> Option<Sentence> {
    let (tent, one) = (evenly(Filter::Tent, 1), evenly(Filter::Bilinear, 1));
    let ratio = time_ratio(pages, &tent, &one)?;
    let more = pages.iter().filter_map(|page| {
        let [tent, one] = [&tent, &one].map(|method| Some(trial(page, method)?.cost.peak_bytes));
        Some(tent?.saturating_sub(one?) as u64)
    });
    let text = format!(
        "One ray with the tent takes {} times the time of one bilinear ray, and its tables take up to {} more memory.",
        times(ratio),
        bytes(more.max()?)
    );
    Some(Sentence::general(Question::Cost, text))
}

/// Returns the number of rays from which bilinear interpolation has as small an error as the tent.
fn many_rays(pages: &[PageMeasured]) -> Option<Sentence> {
    let errors = |n: u32| {
        let both = [Filter::Tent, Filter::Bilinear].map(|filter| whole(pages, &evenly(filter, n)));
        Some((n, both[0]?, both[1]?))
    };
    let counts = counts(pages.first()?, Filter::Tent);
    let errors: Vec<(u32, f64, f64)> = counts.into_iter().filter_map(errors).collect();
    let as_near = errors.iter().rev().take_while(|(_, tent, rays)| *rays <= AS_NEAR * tent);
    let &(n, tent, rays) = as_near.last()?;
    let text = format!(
        "From {n} x {n} rays in a pixel on, bilinear rays have as small an error as the tent ({} \
         and {}).",
        error(rays),
        error(tent)
    );
    Some(Sentence::general(Question::Fails, text))
}

/// Returns for each region the nearest filter with one ray on the thesis's lattice, and whether it
/// helps.
fn regions(pages: &[PageMeasured]) -> Vec<Sentence> {
    let mut names: Vec<&'static str> = Vec::new();
    for region in pages.iter().flat_map(|page| &page.regions) {
        if !names.contains(&region.name) {
            names.push(region.name);
        }
    }
    names.into_iter().filter_map(|name| region(pages, name)).collect()
}

fn region(pages: &[PageMeasured], name: &str) -> Option<Sentence> {
    let of = |filter: Filter| in_region(pages, &evenly(filter, 1), name);
    let bilinear = of(Filter::Bilinear)?;
    let areas = Filter::ALL.into_iter().filter(|filter| filter.wants_area());
    let errors = areas.filter_map(|filter| Some((filter, of(filter)?)));
    let (best, least) = errors.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (question, helps) = match least > NO_HELP * bilinear {
        true => (Question::Fails, "no filter helps"),
        false => (Question::Use, "a filter helps"),
    };
    let text = format!(
        "Region {name}: {helps} on the lattice. With one ray the filter with the smallest error is \
         the {best} ({}); the error of bilinear is {}.",
        error(least),
        error(bilinear)
    );
    Some(Sentence::general(question, text))
}

/// Returns the time of one ray with the tent on a page, by that of the fewest bilinear rays that are as
/// near to the truth.
fn worth(page: &PageMeasured) -> Option<Sentence> {
    let own = trial(page, &evenly(Filter::Tent, 1))?;
    let counts = counts(page, Filter::Bilinear);
    let rays = |n: u32| trial(page, &evenly(Filter::Bilinear, n));
    let as_near =
        |n: &u32| rays(*n).is_some_and(|rays| rays.whole.rmse <= AS_NEAR * own.whole.rmse);
    let (n, which) = match counts.iter().copied().find(as_near) {
        Some(n) => (n, "the fewest measured rays with as small an error"),
        None => (*counts.last()?, "the most measured rays, whose error is larger"),
    };
    let rays = rays(n)?;
    let ratio = own.cost.cpu / rays.cost.cpu;
    let text = format!(
        "On {} one ray with the tent ({}) takes {} times the time of {n} x {n} bilinear rays ({}), {which}.",
        page.name,
        error(own.whole.rmse),
        times(ratio),
        error(rays.whole.rmse)
    );
    let question = if ratio > 1.0 { Question::Fails } else { Question::Cost };
    Some(Sentence { question, page: Some(page.name.clone()), text })
}

/// Returns the parts of a page in which the truth is too noisy to measure the smallest error.
fn doubt(page: &PageMeasured) -> Option<Sentence> {
    let mut parts: Vec<String> = Vec::new();
    let mut look = |name: &str, noise: f64, errors: &mut dyn Iterator<Item = f64>| {
        // The two pictures of the truth differ by twice the error of their mean.
        let least = errors.min_by(f64::total_cmp).filter(|least| 2.0 * noise > NOISE * least);
        parts.extend(
            least.map(|least| format!("{name} {} of {}", error(2.0 * noise), error(least))),
        );
    };
    let trials = || page.trials.iter();
    look("whole picture", page.truth.noise, &mut trials().map(|trial| trial.whole.rmse));
    for (k, (region, &noise)) in page.regions.iter().zip(&page.truth.noise_by_region).enumerate() {
        look(
            region.name,
            noise,
            &mut trials().filter_map(|trial| Some(trial.by_region.get(k)?.rmse)),
        );
    }
    let text = format!(
        "On {} the truth's two seeds differ by more than a fifth of the smallest error: {}.",
        page.name,
        parts.join(", ")
    );
    let sentence = Sentence { question: Question::Doubt, page: Some(page.name.clone()), text };
    (!parts.is_empty()).then_some(sentence)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::{self, edges, floor};

    fn said(pages: Vec<PageMeasured>) -> Vec<(Question, String)> {
        let all = sentences(&fixture::measured(pages)).into_iter();
        all.map(|sentence| (sentence.question, sentence.text)).collect()
    }

    /// Returns the only sentence that contains `words`, or `None`.
    fn one(said: &[(Question, String)], words: &str) -> Option<(Question, String)> {
        let own: Vec<_> = said.iter().filter(|(_, text)| text.contains(words)).collect();
        assert!(own.len() < 2, "{own:?}");
        own.first().map(|&own| own.clone())
    }

    fn expected(question: Question, text: &str) -> Option<(Question, String)> {
        Some((question, text.into()))
    }

    #[test]
    fn the_cost_of_one_ray_is_its_time_and_its_tables() {
        let pages = vec![fixture::page("a", &floor, &[]), fixture::page("b", &floor, &[])];
        let text = "One ray with the tent takes 2.0 times the time of one bilinear ray, and its tables take \
                    up to 16 MiB more memory.";
        assert_eq!(
            one(&said(pages), "takes 2.0 times the time of"),
            expected(Question::Cost, text)
        );
    }

    #[test]
    fn one_ray_is_worth_the_rays_that_are_as_near() {
        // The tent leaves 0.2 of the error of one bilinear ray, and 8 x 8 rays 0.125.
        let text = "On floor one ray with the tent (0.040) takes 0.031 times the time of 8 x 8 \
                    bilinear rays (0.025), the fewest measured rays with as small an error.";
        let said = |tent: f64, price: f64| {
            let law = move |filter, n: f64| match filter {
                Filter::Tent => (tent / n, price * n * n),
                filter => floor(filter, n),
            };
            one(&said(vec![fixture::page("floor", &law, &[])]), "On floor one ray")
        };
        assert_eq!(said(0.04, 0.04), expected(Question::Cost, text));
        for (tent, price, question, words) in [
            (0.05, 0.5, Question::Fails, "takes 1.6 times the time of 4 x 4 bilinear rays (0.050)"),
            (0.2, 0.02, Question::Cost, "takes 1.0 times the time of 1 x 1 bilinear rays (0.20)"),
            (
                0.01,
                0.04,
                Question::Cost,
                "8 x 8 bilinear rays (0.025), the most measured rays, whose error",
            ),
        ] {
            let (found, text) = said(tent, price).unwrap();
            assert_eq!(found, question, "{text}");
            assert!(text.contains(words), "{text}");
        }
    }

    #[test]
    fn in_silhouettes_no_filter_helps_unless_one_does() {
        let page = fixture::page("page", &floor, &[("silhouettes", &edges), ("far floor", &floor)]);
        let claims = said(vec![page]);
        let text = "Region silhouettes: no filter helps on the lattice. With one ray the filter with \
                    the smallest error is the mip (0.21); the error of bilinear is 0.21.";
        assert_eq!(one(&claims, "silhouettes"), expected(Question::Fails, text));
        let text = "Region far floor: a filter helps on the lattice. With one ray the filter with the \
                    smallest error is the quadratic (0.040); the error of bilinear is 0.20.";
        assert_eq!(one(&claims, "far floor"), expected(Question::Use, text));
        for (mip, question) in [(0.18, Question::Use), (0.20, Question::Fails)] {
            let law = |filter, n: f64| match filter {
                Filter::Mip => (mip / n, 0.1),
                filter => edges(filter, n),
            };
            let claims = said(vec![fixture::page("page", &floor, &[("silhouettes", &law)])]);
            assert_eq!(one(&claims, "silhouettes").unwrap().0, question, "{mip}");
        }
    }

    #[test]
    fn with_many_rays_the_filter_counts_as_long_as_it_does() {
        // 0.2 / n^0.8 against 1 / n: the tent stays ahead up to 8 x 8.
        assert_eq!(one(&said(vec![fixture::page("floor", &floor, &[])]), "From"), None);
        // The tent stays at 0.1. Bilinear interpolation, 0.2 / n, has as small an error with n = 2.
        let law = |filter, n: f64| match filter {
            Filter::Tent => (0.1, floor(filter, n).1),
            filter => floor(filter, n),
        };
        let text = "From 2 x 2 rays in a pixel on, bilinear rays have as small an error as the \
                    tent (0.10 and 0.10).";
        let said = said(vec![fixture::page("floor", &law, &[])]);
        assert_eq!(one(&said, "From"), expected(Question::Fails, text));
    }

    #[test]
    fn a_truth_that_is_too_noisy_is_said_to_be() {
        let mut page = fixture::page("floor", &floor, &[("far floor", &floor)]);
        assert_eq!(one(&said(vec![page]), "seeds"), None);
        page = fixture::page("floor", &floor, &[("far floor", &floor)]);
        page.truth.noise_by_region[0] = 0.01;
        let text = "On floor the truth's two seeds differ by more than a fifth of the smallest error: far \
                    floor 0.020 of 0.0075.";
        assert_eq!(one(&said(vec![page]), "seeds"), expected(Question::Doubt, text));
    }

    #[test]
    fn of_few_methods_little_is_said_and_nothing_false() {
        let mut page = fixture::page("floor", &floor, &[("silhouettes", &edges)]);
        page.trials.retain(|trial| trial.method.filter == Filter::Point);
        assert_eq!(said(vec![page]), []);
        let mut page = fixture::page("floor", &floor, &[]);
        for trial in &mut page.trials {
            trial.whole.rmse = 0.0;
        }
        // Errors of 0 have no ratios. The remaining sentences must not contain NaN.
        let claims = said(vec![page]);
        assert!(claims.iter().all(|(_, text)| !text.contains("NaN") && !text.contains("inf")));
    }
}
