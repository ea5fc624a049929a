//! Plots of a page: error against processor time.

use super::axis::{Axis, Unit};
use super::chart::{Band, Chart, Point, Series};
use super::look::Look;
use crate::number::{error, seconds};
use crate::report::measured::{Method, PageMeasured, Trial};
use crate::report::pareto;
use compare::Difference;
use render::filter::Filter;

const ACROSS: &str = "processor time";
const UP: &str = "RMS error in linear light, where white is 1";
const SUPERSAMPLED: &str = "supersampled";

/// The curves with the filters whose methods they join.
const CURVES: [(&str, &[Filter]); 9] = [
    ("point", &[Filter::Point]),
    ("bilinear", &[Filter::Bilinear]),
    ("mip", &[Filter::Mip]),
    ("box", &[Filter::Box]),
    ("tent", &[Filter::Tent]),
    ("quadratic", &[Filter::Quadratic]),
    ("ewa", &[Filter::Ewa8, Filter::Ewa16, Filter::Ewa64]),
    ("probes", &[Filter::Probes]),
    ("exact", &[Filter::Exact]),
];

/// Noise below this fraction of the smallest error does not extend the axis: it is negligible.
const NOISE_AT_LEAST: f64 = 0.08;

/// Plots the error over the whole picture.
#[must_use]
pub fn whole(page: &PageMeasured) -> Chart {
    let error = |trial: &Trial| Some(trial.whole);
    let [across, up] = axes(page, &[&error], &[page.truth.noise]);
    let title = format!("{}: error against time", page.title);
    Chart { title: Some(title), ..chart(page, &error, page.truth.noise, across, up) }
}

/// Plots the error in each region, all with the same axes.
#[must_use]
pub fn regions(page: &PageMeasured) -> Vec<Chart> {
    let all: Vec<_> = (0..page.regions.len())
        .map(|k| move |trial: &Trial| trial.by_region.get(k).copied())
        .collect();
    let errors: Vec<&Error<'_>> = all.iter().map(|of| of as &Error<'_>).collect();
    let [across, up] = axes(page, &errors, &page.truth.noise_by_region);
    let pixels = f64::from(page.size.0) * f64::from(page.size.1);
    page.regions
        .iter()
        .zip(&errors)
        .enumerate()
        .map(|(k, (region, of))| {
            let noise = page.truth.noise_by_region.get(k).copied().unwrap_or(0.0);
            let own = region.mask.iter().filter(|&&own| own).count() as f64;
            let share = 100.0 * own / pixels;
            let share = if share < 9.95 { format!("{share:.1}") } else { format!("{share:.0}") };
            let title = format!("{}, {share} % of the pixels", region.name);
            let chart = chart(page, of, noise, across.clone(), up.clone());
            Chart { title: Some(title), ..chart }
        })
        .collect()
}

type Error<'a> = dyn Fn(&Trial) -> Option<Difference> + 'a;

/// Returns axes that show all trials, and the noise if it is not negligible.
fn axes(page: &PageMeasured, errors: &[&Error<'_>], noise: &[f64]) -> [Axis; 2] {
    let trials = || page.trials.iter();
    let of_all = errors.iter().flat_map(|of| trials().filter_map(of));
    let mut all: Vec<f64> = of_all.map(|found| found.rmse).filter(|&error| error > 0.0).collect();
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let noise = noise.iter().copied().fold(0.0, f64::max);
    if least.is_finite() && noise >= NOISE_AT_LEAST * least {
        all.push(noise.min(least));
    }
    [
        Axis::around(ACROSS, Unit::Seconds, trials().map(|trial| trial.cost.cpu)),
        Axis::around(UP, Unit::Plain, all.into_iter()),
    ]
}

fn chart(page: &PageMeasured, of: &Error<'_>, noise: f64, across: Axis, up: Axis) -> Chart {
    let points: Vec<(f64, f64)> = page
        .trials
        .iter()
        .map(|trial| (trial.cost.cpu, of(trial).map_or(f64::NAN, |found| found.rmse)))
        .collect();
    let front = pareto::front(&points);
    let point = |k: usize| {
        let (trial, (x, y)) = (&page.trials[k], points[k]);
        let name = format!("{}: error {}, {}", trial.method.name(), error(y), seconds(x));
        let note = note(&trial.method).filter(|_| front.contains(&k));
        Point { x, y, name, note }
    };
    let mut series: Vec<Series> = Vec::new();
    let mut key = Vec::new();
    for (name, filters) in CURVES {
        let look = Look::filter(filters[0]);
        let own = |k: &usize| filters.contains(&page.trials[*k].method.filter);
        let (areas, lattice): (Vec<usize>, Vec<usize>) = (0..page.trials.len())
            .filter(own)
            .partition(|&k| page.trials[k].method.areas().is_some());
        let (mut even, other): (Vec<usize>, Vec<usize>) =
            lattice.into_iter().partition(|&k| page.trials[k].method.evenly().is_some());
        even.sort_by_key(|&k| page.trials[k].method.evenly());
        if !other.is_empty() {
            let points = other.into_iter().map(point).collect();
            series.push(Series { name: String::new(), look: look.hollow(), joined: false, points });
            key = vec![(Look::filter(Filter::Tent).hollow(), SUPERSAMPLED.to_string())];
        }
        // Only the first curve has the name.
        let mut name = name.to_string();
        let areas = areas.chunk_by(|&a, &b| samples(page, a) == samples(page, b));
        for curve in std::iter::once(even.as_slice()).chain(areas).filter(|own| !own.is_empty()) {
            let points = curve.iter().copied().map(point).collect();
            series.push(Series { name: std::mem::take(&mut name), look, joined: true, points });
        }
    }
    let front = front.iter().map(|&k| points[k]).collect();
    let band = Band { up_to: noise, label: format!("noise of the truth, {}", error(noise)) };
    Chart { title: None, across, up, series, band: Some(band), front, key }
}

/// Returns the areas along each side of a pixel of trial `k`.
fn samples(page: &PageMeasured, k: usize) -> Option<u32> {
    page.trials[k].method.areas().map(|(samples, _)| samples)
}

/// Returns the number that stands beside a method on the front: the rays along each side of a pixel, or
/// the threshold of splitting.
fn note(method: &Method) -> Option<String> {
    match method.areas() {
        Some((_, Some(threshold))) => Some(threshold.to_string()),
        Some((samples, None)) => Some(samples.to_string()),
        None => method.evenly().map(|samples| samples.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn a_page_has_a_line_for_each_filter_over_its_samples() {
        let page = fixture::page("floor", &fixture::floor, &[("silhouettes", &fixture::edges)]);
        let chart = whole(&page);
        let joined: Vec<&Series> = chart.series.iter().filter(|series| series.joined).collect();
        assert_eq!(joined.len(), 6);
        for series in joined {
            assert_eq!(series.points.len(), fixture::COUNTS.len());
            assert!(series.points.windows(2).all(|w| w[0].x < w[1].x && w[0].y > w[1].y));
        }
        // A method that another one beats in cost and error is not on the front: no quadratic, no
        // point.
        let points = |name: &str| {
            let named = chart.series.iter().find(|series| series.name == name).unwrap();
            named.points.iter().filter(|place| place.note.is_some()).count()
        };
        assert!(points("tent") > 0 && points("bilinear") > 0);
        assert!(chart.front.windows(2).all(|w| w[0].0 <= w[1].0 && w[0].1 >= w[1].1));
        let [region] = &regions(&page)[..] else { panic!("one region") };
        assert!(region.title.as_ref().unwrap().starts_with("silhouettes, 50 %"));
    }

    #[test]
    fn methods_by_areas_are_joined_for_each_number_of_areas() {
        let page = fixture::with_areas("floor", &fixture::floor, &[]);
        let chart = whole(&page);
        let of = |filter| chart.series.iter().filter(move |own| own.look == Look::filter(filter));
        let points = |filter| of(filter).map(|own| own.points.len()).collect::<Vec<_>>();
        // Three elliptic filters; one area whole and split at three thresholds, and 2 x 2 areas.
        assert_eq!(points(Filter::Ewa16), [3]);
        assert_eq!(points(Filter::Probes), [1]);
        assert_eq!(points(Filter::Exact), [4, 2]);
        let names: Vec<&str> = of(Filter::Exact).map(|own| own.name.as_str()).collect();
        assert_eq!(names, ["exact", ""]);
        let notes = of(Filter::Exact).flat_map(|own| &own.points).map(|own| own.note.as_deref());
        // In the fixture no other filter is as near in as little time.
        let expected = ["1", "0.1", "0.03", "0.01", "2", "0.1"].map(Some);
        let notes: Vec<Option<&str>> = notes.collect();
        assert!(notes.iter().zip(expected).all(|(found, own)| found.is_none() || *found == own));
        assert!(notes[..4].iter().all(Option::is_some), "{notes:?}");
        for filter in Filter::ALL {
            assert!(
                CURVES.iter().filter(|(_, own)| own.contains(&filter)).count() == 1,
                "{filter}"
            );
        }
    }
}
