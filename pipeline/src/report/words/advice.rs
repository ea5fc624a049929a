//! Advises which method to use within a time, and which to reach an error.

use super::super::measured::{Method, PageMeasured, Trial};
use super::numbers::in_the_time;
use super::pool::{everywhere, mean, time_ratio, trial, whole};
use super::{AS_FAST, AS_NEAR, Claim, Topic, Verdict, as_near};
use crate::number::times;
use render::Sampling;
use render::filter::Filter;

/// Times that may be spent, as multiples of the time of one bilinear ray in each pixel.
const BUDGETS: [f64; 5] = [2.0, 5.0, 20.0, 80.0, 300.0];

/// Errors to reach, as fractions of the error of one bilinear ray in each pixel, with their names.
const AIMS: [(f64, &str); 4] =
    [(0.5, "half"), (0.25, "a quarter"), (0.125, "an eighth"), (0.0625, "a sixteenth")];

/// Returns the sentences of advice.
pub fn claims(pages: &[PageMeasured]) -> Vec<Claim> {
    let one = Method { filter: Filter::Bilinear, sampling: Sampling::regular(1) };
    let methods = everywhere(pages);
    if !methods.contains(&&one) {
        return Vec::new();
    }
    let mut found: Vec<(&Method, Topic, String)> = Vec::new();
    for budget in BUDGETS {
        let next = for_budget(pages, &methods, &one, budget);
        found.extend(next.map(|(method, text)| (method, Topic::Budget, text)));
    }
    for aim in AIMS {
        let next = for_aim(pages, &methods, &one, aim);
        found.extend(next.map(|(method, text)| (method, Topic::Aim, text)));
    }
    // If the next larger time, or the next smaller error, has the same advice, only that sentence is
    // kept.
    let mut claims = Vec::new();
    for (k, (method, topic, text)) in found.iter().enumerate() {
        let again = found.get(k + 1).is_some_and(|next| (next.0, next.1) == (*method, *topic));
        if !again {
            claims.push(Claim::general(*topic, Verdict::Use, text.clone()));
        }
    }
    claims
}

/// Returns the method that is best within a time, with its sentence. On each page, a method is rated by
/// its error over the least error within that time. The best method has the smallest geometric mean of
/// these ratios and keeps the time on every page.
fn for_budget<'a>(
    pages: &[PageMeasured],
    methods: &[&'a Method],
    one: &Method,
    budget: f64,
) -> Option<(&'a Method, String)> {
    let keeps = |page: &PageMeasured, own: &Trial| {
        trial(page, one).is_some_and(|one| own.cost.cpu <= budget * one.cost.cpu)
    };
    let least = |page: &PageMeasured| {
        let kept = page.trials.iter().filter(|own| keeps(page, own));
        kept.map(|own| own.whole.rmse).min_by(f64::total_cmp)
    };
    let by_least = |page: &PageMeasured, method: &Method| {
        let own = trial(page, method).filter(|own| keeps(page, own))?;
        Some(own.whole.rmse / least(page)?)
    };
    let (method, _) = methods
        .iter()
        .filter_map(|&method| Some((method, mean(pages, |page| by_least(page, method))?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))?;
    let ratios: Option<Vec<f64>> = pages.iter().map(|page| by_least(page, method)).collect();
    let ratios = ratios?;
    let nearest = ratios.iter().filter(|&&ratio| as_near(ratio, 1.0)).count();
    let worst = ratios.iter().copied().fold(1.0, f64::max);
    let held = if worst <= AS_NEAR {
        format!("nothing that is done in that time is nearer{}", on_any(pages))
    } else {
        format!(
            "of what is done in that time it is the nearest on {nearest} of {} pages, and nowhere more than \
             {} times as far off as the nearest",
            pages.len(),
            // Rounded up, so that the sentence is true.
            (100.0 * worst).ceil() / 100.0
        )
    };
    let text = format!(
        "Use {} where up to {budget} times the time of one bilinear ray in each pixel may be spent: {held}.",
        method.name()
    );
    Some((method, text))
}

/// Returns the fastest method that reaches an error on every page, with its sentence. Times are
/// compared in the geometric mean of the pages. Of methods as fast as the fastest, the one with the
/// smallest error is taken.
fn for_aim<'a>(
    pages: &[PageMeasured],
    methods: &[&'a Method],
    one: &Method,
    (part, called): (f64, &str),
) -> Option<(&'a Method, String)> {
    let reaches = |method: &Method| {
        pages.iter().all(|page| {
            let errors = [method, one].map(|method| trial(page, method).map(|own| own.whole.rmse));
            matches!(errors, [Some(own), Some(one)] if own <= part * one)
        })
    };
    // Returns the method with the smallest error among those as fast as the fastest.
    let fastest = |of: &dyn Fn(&Method) -> bool| {
        let all: Vec<(&Method, f64, f64)> = methods
            .iter()
            .filter(|method| of(method) && reaches(method))
            .filter_map(|&own| Some((own, time_ratio(pages, own, one)?, whole(pages, own)?)))
            .collect();
        let least = all.iter().map(|own| own.1).min_by(f64::total_cmp)?;
        let as_fast = all.into_iter().filter(|own| own.1 <= AS_FAST * least);
        as_fast.min_by(|a, b| a.2.total_cmp(&b.2))
    };
    let (method, ratio, _) = fastest(&|_| true)?;
    let rays = fastest(&|method| method.filter == Filter::Bilinear);
    let against = match rays {
        Some((rays, ..)) if rays == method => String::new(),
        Some((rays, own, _)) => {
            let rays = match rays.sampling {
                Sampling::Supersample(_) => "the thesis's supersampling".into(),
                Sampling::Grid { .. } => rays.rays(),
            };
            let longer = in_the_time(own / ratio);
            format!("; with bilinear rays alone it takes {rays}, {longer}")
        }
        None => "; no number of bilinear rays that was measured does".into(),
    };
    let text = format!(
        "Use {} where the error is to be at most {called} of that of one bilinear ray: nothing faster gets there\
         {}, and it takes {} times the time of one bilinear ray{against}.",
        method.name(),
        on_all(pages),
        times(ratio)
    );
    Some((method, text))
}

fn on_any(pages: &[PageMeasured]) -> &'static str {
    if pages.len() == 1 { "" } else { " on any page" }
}

fn on_all(pages: &[PageMeasured]) -> &'static str {
    if pages.len() == 1 { "" } else { " on every page" }
}
