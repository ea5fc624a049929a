//! The sentences on which method to use for a time, and from which size of picture on.

use super::sentence::{AS_NEAR, Question, Sentence};
use crate::report::measured::{Method, PageMeasured};
use crate::report::pool::{evenly, mean, trial};
use render::filter::Filter;

/// Times that may be spent, as multiples of the time of one bilinear ray in each pixel.
const BUDGETS: [u32; 5] = [2, 5, 20, 80, 300];

/// Sides of the square pictures for which advice is computed, in pixels.
const SIDES: [u32; 6] = [256, 512, 1024, 2048, 4096, 8192];

/// Returns all sentences on times and sizes that the numbers support.
#[must_use]
pub fn sentences(pages: &[PageMeasured]) -> Vec<Sentence> {
    let mut all = budgets(pages);
    all.extend(sizes(pages));
    all.extend(once(pages));
    all
}

/// Returns the method to use for a budget, in pictures with `scale` times as many pixels as were measured. A method is
/// rated on each page by its error over the least error within the budget, and keeps the budget on every page. The
/// rating is the geometric mean over the pages. Of all methods whose rating is as small as the smallest ([`AS_NEAR`])
/// the cheapest is returned: an error that is hardly smaller is no gain.
fn best(pages: &[PageMeasured], budget: u32, scale: f64) -> Option<Method> {
    let one = evenly(Filter::Bilinear, 1);
    let cost = |page: &PageMeasured, method: &Method| {
        let (own, one) = (trial(page, method)?, trial(page, &one)?);
        Some(own.cost.cpu_at(scale) / one.cost.cpu_at(scale))
    };
    let rated = {
        let error = |page: &PageMeasured, method: &Method| {
            let own = trial(page, method)?;
            (cost(page, method)? <= f64::from(budget)).then_some(own.whole.rmse)
        };
        let least = |page: &PageMeasured| {
            let errors = page.trials.iter().filter_map(|own| error(page, &own.method));
            errors.min_by(f64::total_cmp)
        };
        let methods = pages.first()?.trials.iter().map(|own| &own.method);
        let rated = methods.filter_map(|method| {
            let rating = mean(pages, |page| Some(error(page, method)? / least(page)?))?;
            Some((*method, rating, mean(pages, |page| cost(page, method))?))
        });
        rated.collect::<Vec<_>>()
    };
    let least = rated.iter().map(|own| own.1).min_by(f64::total_cmp)?;
    let near = rated.into_iter().filter(|own| own.1 <= AS_NEAR * least);
    near.min_by(|a, b| a.2.total_cmp(&b.2)).map(|(method, ..)| method)
}

/// Returns the advice for each budget at the measured size. Of equal advice for several budgets the last is kept.
fn budgets(pages: &[PageMeasured]) -> Vec<Sentence> {
    let advice: Vec<_> = BUDGETS.iter().filter_map(|&k| Some((k, best(pages, k, 1.0)?))).collect();
    let changes = advice
        .iter()
        .enumerate()
        .filter(|(k, (_, method))| advice.get(k + 1).is_none_or(|(_, next)| next != method));
    let text = |(_, (budget, method)): (usize, &(u32, Method))| {
        format!(
            "Use {} where up to {budget} times the time of one bilinear ray in each pixel may be spent.",
            method.name()
        )
    };
    changes.map(|change| Sentence::general(Question::Use, text(change))).collect()
}

/// Returns the sizes from which other methods are advised than at the measured size, since costs of the scene count less
/// in larger pictures. Times of other sizes are computed from those that were measured.
fn sizes(pages: &[PageMeasured]) -> Vec<Sentence> {
    let Some(page) = pages.first() else { return Vec::new() };
    let measured = f64::from(page.size.0) * f64::from(page.size.1);
    let mut all = Vec::new();
    for budget in BUDGETS {
        let Some(mut advised) = best(pages, budget, 1.0) else { continue };
        for side in SIDES {
            let pixels = f64::from(side) * f64::from(side);
            if pixels <= measured {
                continue;
            }
            match best(pages, budget, pixels / measured) {
                Some(method) if method != advised => {
                    let text = format!(
                        "From {side} x {side} pixels on, use {} where up to {budget} times the time of \
                         one bilinear ray in each pixel may be spent.",
                        method.name()
                    );
                    all.push(Sentence::general(Question::Use, text));
                    advised = method;
                }
                _ => {}
            }
        }
    }
    all
}

/// Returns the parts of the time that are spent once for a scene, at the measured size.
fn once(pages: &[PageMeasured]) -> Option<Sentence> {
    let part = |method: &Method| {
        let shares = mean(pages, |page| {
            let cost = trial(page, method)?.cost;
            (cost.cpu > 0.0).then(|| (cost.once_cpu / cost.cpu).max(1e-4))
        })?;
        Some(format!("{:.0} % for {}", 100.0 * shares, method.name()))
    };
    let exact = Method::area(Filter::Exact, 1, None);
    let methods = [evenly(Filter::Bilinear, 1), evenly(Filter::Tent, 1), exact];
    let parts: Vec<String> = methods.iter().filter_map(part).collect();
    let (width, height) = pages.first()?.size;
    let text = format!(
        "Of the processor time of the first picture of {width} x {height} pixels, these parts are spent once \
         for a scene, on tables and the structure of its surfaces: {}.",
        parts.join(", ")
    );
    let is_any = pages.iter().flat_map(|page| &page.trials).any(|trial| trial.cost.once_cpu > 0.0);
    (is_any && !parts.is_empty()).then(|| Sentence::general(Question::Cost, text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::{self, edges, floor};

    fn said(pages: &[PageMeasured]) -> Vec<String> {
        sentences(pages).into_iter().map(|sentence| sentence.text).collect()
    }

    #[test]
    fn what_is_advised_keeps_the_time_and_is_nearest() {
        // One ray with the tent costs two bilinear rays, 3 x 3 with the tent 18.
        let uses = said(&[fixture::page("floor", &floor, &[])]);
        let of = |method: &str, budget: u32| {
            format!(
                "Use {method} where up to {budget} times the time of one bilinear ray in each pixel \
                 may be spent."
            )
        };
        // The advice for five times the time equals that for twice the time.
        let advised = [of("tent, 1 ray", 5), of("tent, 3 x 3 rays", 20)];
        assert_eq!(&uses[..2], &advised);
        // Where filters have no effect, cheaper rays are advised.
        let first = &said(&[fixture::page("edges", &edges, &[])])[0];
        assert!(first.starts_with("Use point") || first.starts_with("Use bilinear"), "{first}");
    }

    #[test]
    fn an_error_that_is_hardly_smaller_is_no_gain() {
        // The quadratic leaves 4 % less than the tent, at 2.7 times its time.
        let law = |filter, n: f64| match filter {
            Filter::Tent => (0.05 / n, 0.03 * n * n),
            Filter::Quadratic => (0.048 / n, 0.081 * n * n),
            filter => floor(filter, n),
        };
        let pages = vec![fixture::page("floor", &law, &[])];
        let advised = best(&pages, 5, 1.0).unwrap();
        assert_eq!(advised, evenly(Filter::Tent, 1), "{advised:?}");
        // With 10 % less it is one.
        let law = |filter, n: f64| match filter {
            Filter::Quadratic => (0.045 / n, 0.081 * n * n),
            filter => law(filter, n),
        };
        let pages = vec![fixture::page("floor", &law, &[])];
        assert_eq!(best(&pages, 5, 1.0).unwrap(), evenly(Filter::Quadratic, 1));
    }

    #[test]
    fn costs_of_the_scene_count_less_in_larger_pictures() {
        // One ray with the tent takes 0.12 s for its tables and 0.02 s for 96 x 64 pixels: 7 bilinear rays. From
        // 256 x 256 pixels on, ten times as many, it takes 1.6.
        let mut page = fixture::page("floor", &floor, &[]);
        page.trials.retain(|own| {
            own.method.evenly() == Some(1)
                && matches!(own.method.filter, Filter::Tent | Filter::Bilinear)
        });
        for own in page.trials.iter_mut().filter(|own| own.method.filter == Filter::Tent) {
            own.cost.once_cpu = 0.12;
            own.cost.cpu = 0.14;
        }
        let found = said(&[page]);
        let text = "From 256 x 256 pixels on, use tent, 1 ray where up to 2 times the time of one bilinear \
                    ray in each pixel may be spent.";
        assert!(found.iter().any(|own| own == text), "{found:?}");
    }
}
