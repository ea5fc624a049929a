//! Numbers of all cases of one kind together.

use super::measure::{Case, REQUESTS, SceneCases};

/// Numbers of the cases with one request, or of all audits without one.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Number of cases.
    pub cases: usize,
    /// Cases whose true error is below the stated bound.
    pub covered: usize,
    /// Cases above the bound by more than the noise of the truth.
    pub certainly_above: usize,
    /// Cases whose request was reported as not reached.
    pub missed: usize,
    /// Cases whose true error is at most 1.1 times the request, and at most twice the request.
    pub within: [usize; 2],
    /// Median and largest true error, in bounds.
    pub of_bound: [f64; 2],
    /// Means of the rays per pixel for picture and audit.
    pub rays: [f64; 2],
    /// Processor time of all cases, in seconds.
    pub seconds: f64,
}

impl Summary {
    /// Sums up cases; `None` without any.
    #[must_use]
    pub fn of(cases: &[&Case]) -> Option<Self> {
        let count = |holds: &dyn Fn(&Case) -> bool| cases.iter().filter(|case| holds(case)).count();
        let within = |times: f64| {
            count(&move |case: &Case| case.truth <= times * case.requested.unwrap_or(case.bound))
        };
        let mut of_bound: Vec<f64> = cases.iter().map(|case| case.truth / case.bound).collect();
        of_bound.sort_by(f64::total_cmp);
        let mean =
            |k: usize| cases.iter().map(|case| case.rays[k]).sum::<f64>() / cases.len() as f64;
        Some(Self {
            cases: cases.len(),
            covered: count(&|case| !case.above),
            certainly_above: count(&|case| case.certainly_above),
            missed: count(&|case| case.missed),
            within: [within(1.1), within(2.0)],
            of_bound: [of_bound.get(cases.len() / 2).copied()?, of_bound.last().copied()?],
            rays: [mean(0), mean(1)],
            seconds: cases.iter().map(|case| case.seconds).sum(),
        })
    }
}

/// Returns the cases of each request, and those of audits without one.
#[must_use]
pub fn by_request(scenes: &[SceneCases]) -> Vec<(Option<f64>, Vec<&Case>)> {
    let requests = REQUESTS.map(Some).into_iter().chain([None]);
    let of = |request: Option<f64>| {
        scenes.iter().flat_map(|scene| &scene.cases).filter(move |c| c.requested == request)
    };
    requests.map(|request| (request, of(request).collect())).collect()
}

/// Returns the power of one over the error with which the processor time grows, from the largest to
/// the smallest request. `None` without cases.
#[must_use]
pub fn exponent(scenes: &[SceneCases]) -> Option<f64> {
    let all = by_request(scenes);
    let seconds = |k: usize| Some(Summary::of(&all[k].1)?.seconds);
    let (first, last) = (seconds(0)?, seconds(REQUESTS.len() - 1)?);
    Some((last / first).ln() / (REQUESTS[0] / REQUESTS[REQUESTS.len() - 1]).ln())
}

/// Returns the median and the largest factor by which the processor time of a scene grows for half the
/// error, from the largest to the smallest request. `None` without scenes.
#[must_use]
pub fn halvings(scenes: &[SceneCases]) -> Option<[f64; 2]> {
    let last = REQUESTS.len() - 1;
    let steps = (REQUESTS[0] / REQUESTS[last]).log2();
    let of_scene = |scene: &SceneCases| {
        let (first, last) = (scene.cases.first()?, scene.cases.get(last)?);
        (first.seconds > 0.0).then(|| (last.seconds / first.seconds).powf(1.0 / steps))
    };
    let mut all: Vec<f64> = scenes.iter().filter_map(of_scene).collect();
    all.sort_by(f64::total_cmp);
    Some([*all.get(all.len() / 2)?, *all.last()?])
}

/// Returns the interval of chances with which `hits` of `count` trials agree, at 95 % confidence (E.
/// Wilson, "Probable Inference, the Law of Succession, and Statistical Inference", 1927).
#[must_use]
pub fn interval(hits: usize, count: usize) -> [f64; 2] {
    const Z: f64 = 1.959_964;
    if count == 0 {
        return [0.0, 1.0];
    }
    let (n, part) = (count as f64, hits as f64 / count as f64);
    let middle = part + Z * Z / (2.0 * n);
    let half = Z * (part * (1.0 - part) / n + Z * Z / (4.0 * n * n)).sqrt();
    [-1.0, 1.0].map(|sign| ((middle + sign * half) / (1.0 + Z * Z / n)).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(requested: Option<f64>, truth: f64, seconds: f64) -> Case {
        let bound = requested.unwrap_or(0.1);
        Case {
            requested,
            method: String::new(),
            stated: truth,
            bound,
            missed: false,
            truth,
            above: truth > bound,
            certainly_above: truth > 1.5 * bound,
            rays: [2.0, 0.5],
            seconds,
        }
    }

    #[test]
    fn cases_are_counted() {
        let scene = |truth| SceneCases {
            name: "a".into(),
            cases: REQUESTS.iter().map(|e| case(Some(*e), truth * e, 0.05 / e)).collect(),
        };
        let scenes = [scene(0.5), scene(0.9), scene(1.05), scene(3.0)];
        let all = by_request(&scenes);
        assert_eq!(all.len(), 5);
        let summary = Summary::of(&all[1].1).unwrap();
        assert_eq!((summary.cases, summary.covered, summary.certainly_above), (4, 2, 1));
        assert_eq!((summary.within, summary.missed), ([3, 3], 0));
        assert!((summary.of_bound[0] - 1.05).abs() < 1e-12);
        assert!((summary.of_bound[1] - 3.0).abs() < 1e-12);
        assert_eq!(Summary::of(&all[4].1), None);
        // A tenth of the error takes ten times the time.
        assert!((exponent(&scenes).unwrap() - 1.0).abs() < 1e-12);
        let [middle, most] = halvings(&scenes).unwrap();
        assert!((middle - 2.0).abs() < 1e-12 && (most - 2.0).abs() < 1e-12);
    }

    /// Of no hits in n trials, Wilson's upper end is z^2 / (n + z^2).
    #[test]
    fn intervals_are_those_of_wilson() {
        let z2 = 1.959_964_f64.powi(2);
        let [low, high] = interval(0, 100);
        assert!(low == 0.0 && (high - z2 / (100.0 + z2)).abs() < 1e-12);
        let [low, high] = interval(100, 100);
        assert!(high == 1.0 && (low - 100.0 / (100.0 + z2)).abs() < 1e-12);
        assert_eq!(interval(0, 0), [0.0, 1.0]);
    }
}
