//! Sentences on what one ray with the thesis's filter is worth, for each page and for all pages.

use super::super::measured::{PageMeasured, Trial};
use super::numbers::{in_the_time, list};
use super::pool::{THESIS, counts, evenly};
use super::{AS_FAST, Claim, Topic, Verdict, as_near, nearer};
use crate::number::error;
use render::filter::Filter;

/// Largest difference between the truth's two pictures, as a fraction of the smallest error, that
/// causes no doubt. Both are root mean squares.
const NOISE: f64 = 0.2;

/// Returns the sentences on each page, and those on all pages.
pub fn claims(pages: &[PageMeasured]) -> Vec<Claim> {
    let mut claims = Vec::new();
    for page in pages {
        claims.extend([one_ray(page), beaten(page), noise(page)].into_iter().flatten());
    }
    let general = together(&claims);
    claims.extend(general);
    claims
}

fn claim(page: &PageMeasured, topic: Topic, verdict: Verdict, text: String) -> Claim {
    Claim { topic, verdict, page: Some(page.name.clone()), text }
}

/// Returns the trial of the thesis's method with one ray.
fn reference(page: &PageMeasured) -> Option<&Trial> {
    THESIS.iter().find_map(|&filter| evenly(page, filter, 1))
}

/// Returns a sentence on how many bilinear rays are as near as one ray with the thesis's filter, and on
/// the time of both.
fn one_ray(page: &PageMeasured) -> Option<Claim> {
    let own = reference(page)?;
    let counts = counts(page, Filter::Bilinear);
    let rays = |n: u32| evenly(page, Filter::Bilinear, n);
    let one = rays(1)?;
    let (name, filter, own_error) = (&page.name, own.method.filter, own.whole.rmse);
    let enough = counts
        .iter()
        .position(|&n| rays(n).is_some_and(|trial| as_near(trial.whole.rmse, own_error)));
    let Some(at) = enough else {
        let most = *counts.last()?;
        let trial = rays(most)?;
        let cost = in_the_time(own.cost.cpu / trial.cost.cpu);
        let text = if most == 1 {
            format!(
                "On {name} the {filter} with one ray is nearer to the truth than one bilinear ray \
                 ({} against {}), {cost}.",
                error(own_error),
                error(one.whole.rmse)
            )
        } else {
            format!(
                "On {name} the {filter} with one ray ({}) is nearer to the truth than any number of \
                 bilinear rays that was measured, up to {most} x {most} ({}), {cost}.",
                error(own_error),
                error(trial.whole.rmse)
            )
        };
        return Some(claim(page, Topic::OneRay, Verdict::Wins, text));
    };
    let (n, trial) = (counts[at], rays(counts[at])?);
    let ratio = own.cost.cpu / trial.cost.cpu;
    let (cost, rival) = (in_the_time(ratio), trial.whole.rmse);
    let as_near_as_it = as_near(own_error, rival);
    let verdict = match ratio {
        // A method that costs more loses, and so does one that costs the same and is farther off.
        r if r > AS_FAST || (r * AS_FAST >= 1.0 && !as_near_as_it) => Verdict::Loses,
        r if r * AS_FAST < 1.0 => Verdict::Wins,
        _ => Verdict::Even,
    };
    let (own_said, rival_said) = (error(own_error), error(rival));
    let text = match (n, as_near_as_it) {
        (1, true) => format!(
            "On {name} the {filter} with one ray is no nearer to the truth than one bilinear ray \
             ({own_said} and {rival_said}), {cost}."
        ),
        (1, false) => format!(
            "On {name} one bilinear ray is nearer to the truth than one with the {filter} \
             ({rival_said} against {own_said}); the {filter} is done {cost}."
        ),
        (n, true) => format!(
            "On {name} the {filter} with one ray is as near to the truth as {n} x {n} bilinear rays \
             ({own_said} and {rival_said}), {cost}."
        ),
        (n, false) => {
            let before = counts[at - 1];
            let less = if before == 1 {
                "one bilinear ray".to_string()
            } else {
                format!("{before} x {before} bilinear rays")
            };
            format!(
                "On {name} the {filter} with one ray ({own_said}) is nearer to the truth than {less} \
                 ({}), but not as near as {n} x {n} ({rival_said}); it is done {cost} of those.",
                error(rays(before)?.whole.rmse)
            )
            .replace("the same time of those", "the same time as those")
        }
    };
    Some(claim(page, Topic::OneRay, verdict, text))
}

/// Returns a sentence on a method without the thesis's filters that is nearer in no more time, or
/// faster and no farther off.
fn beaten(page: &PageMeasured) -> Option<Claim> {
    let own = reference(page)?;
    let beats = |other: &&Trial| {
        let (error, cost) = (other.whole.rmse, other.cost.cpu);
        !THESIS.contains(&other.method.filter)
            && ((nearer(error, own.whole.rmse) && cost <= own.cost.cpu)
                || (error <= own.whole.rmse && AS_FAST * cost < own.cost.cpu))
    };
    let other =
        page.trials.iter().filter(beats).min_by(|a, b| a.whole.rmse.total_cmp(&b.whole.rmse))?;
    let text = format!(
        "On {} the {} with one ray is beaten by {}: {} against {}, {}.",
        page.name,
        own.method.filter,
        other.method.name(),
        error(other.whole.rmse),
        error(own.whole.rmse),
        in_the_time(other.cost.cpu / own.cost.cpu)
    );
    Some(claim(page, Topic::Beaten, Verdict::Loses, text))
}

/// Returns a sentence if the truth is too noisy to measure the smallest error, in the whole picture or
/// in regions.
fn noise(page: &PageMeasured) -> Option<Claim> {
    let smallest = |of: &dyn Fn(&Trial) -> Option<f64>| {
        page.trials.iter().filter_map(of).min_by(f64::total_cmp)
    };
    // The two pictures of the truth differ by twice the error of their mean.
    let doubtful = |noise: f64, smallest: Option<f64>| {
        smallest.filter(|&smallest| 2.0 * noise > NOISE * smallest)
    };
    let mut places: Vec<String> = Vec::new();
    let mut look = |name: &str, noise: f64, least: Option<f64>| {
        if let Some(least) = doubtful(noise, least) {
            places.push(format!("{name} ({} of {})", error(2.0 * noise), error(least)));
        }
    };
    look("in the whole", page.truth.noise, smallest(&|trial| Some(trial.whole.rmse)));
    for (k, (region, &noise)) in page.regions.iter().zip(&page.truth.noise_by_region).enumerate() {
        let least = smallest(&|trial| trial.by_region.get(k).map(|own| own.rmse));
        look(region.name, noise, least);
    }
    let text = format!(
        "On {} the smallest errors are in doubt: the truth's two seeds differ by more than a fifth of them: {}.",
        page.name,
        list(&places)
    );
    (!places.is_empty()).then(|| claim(page, Topic::Noise, Verdict::Doubt, text))
}

/// Returns sentences on how many pages one ray with the thesis's filter is worth its time.
fn together(claims: &[Claim]) -> Vec<Claim> {
    let of = |topic: Topic, verdict: Verdict| -> Vec<String> {
        let own = claims.iter().filter(|claim| claim.topic == topic && claim.verdict == verdict);
        own.filter_map(|claim| claim.page.clone()).collect()
    };
    let all = claims.iter().filter(|claim| claim.topic == Topic::OneRay).count();
    let (wins, even) = (of(Topic::OneRay, Verdict::Wins), of(Topic::OneRay, Verdict::Even));
    let loses = of(Topic::OneRay, Verdict::Loses);
    if all < 2 {
        return Vec::new();
    }
    let mut general = Vec::new();
    let mut say = |topic, verdict, text| general.push(Claim::general(topic, verdict, text));
    if !wins.is_empty() {
        say(
            Topic::OneRay,
            Verdict::Wins,
            format!(
                "On {} of {all} pages one ray with the thesis's filter costs less than the bilinear rays that come \
                 as near to the truth.",
                wins.len()
            ),
        );
    }
    if !even.is_empty() {
        say(Topic::OneRay, Verdict::Even, format!("It costs as much as those on {}.", list(&even)));
    }
    if !loses.is_empty() {
        say(
            Topic::OneRay,
            Verdict::Loses,
            format!(
                "On {} one ray with the thesis's filter costs more than bilinear rays that come as near to the \
                 truth, or as much as such that come nearer.",
                list(&loses)
            ),
        );
    }
    let beaten = of(Topic::Beaten, Verdict::Loses);
    if !beaten.is_empty() {
        say(
            Topic::Beaten,
            Verdict::Loses,
            format!(
                "On {} of {all} pages ({}) something without tables is nearer than one ray with the thesis's \
                 filter in no more time, or as near in less.",
                beaten.len(),
                list(&beaten)
            ),
        );
    }
    general
}
