//! Plans the measurements of a report and their duration.

use super::measured::Method;
use render::film::{MOST_SAMPLES, Supersample, THRESHOLD};
use render::filter::Filter;
use render::{Picture, Sampling};
use std::time::Duration;

/// The measurements to make of each page.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Width and height of all pictures, in pixels.
    pub size: (u32, u32),
    /// Filters over the boxes of the thesis's lattice, from the simplest to the most costly.
    pub filters: Vec<Filter>,
    /// Patterns of rays of the thesis's lattice, from few rays to many.
    pub lattices: Vec<Sampling>,
    /// Methods by areas, from few rays to many.
    pub areas: Vec<Method>,
    /// Least number of rays along each side of a pixel of the truth, for each of two seeds.
    pub truth_samples: u32,
    /// Largest number of rays along each side of a pixel of the truth, where the noise requires more.
    pub most_truth_samples: u32,
    /// Time after which a method is not measured again: the sum of its rounds so far.
    pub patience: Duration,
    /// True if the report is made quickly, with small pictures and few methods.
    pub quick: bool,
    /// The truth, if it is given.
    pub reference: Option<Picture>,
}

/// Filters that are measured over the same areas as the exact average.
const OF_AREAS: [Filter; 4] = [Filter::Ewa8, Filter::Ewa16, Filter::Ewa64, Filter::Probes];

/// Numbers of rays along each side of a pixel, evenly spread, in a full report.
const SAMPLES: [u32; 6] = [1, 2, 3, 4, 8, 16];

/// Thresholds of splitting in a full report, from few splits to many.
const THRESHOLDS: [f64; 3] = [THRESHOLD, 0.03, 0.01];

impl Plan {
    /// Returns a plan of all methods, at 128 x 128 pixels.
    #[must_use]
    pub fn full() -> Self {
        let [one, two, rest @ ..] = SAMPLES.map(Sampling::regular);
        let thesis =
            [Sampling::Supersample(Supersample::Image), Sampling::Supersample(Supersample::Rays)];
        let exact = |samples, threshold| Method::area(Filter::Exact, samples, threshold);
        let whole = OF_AREAS.map(|filter| Method::area(filter, 1, None));
        let split = THRESHOLDS.map(|threshold| exact(1, Some(threshold)));
        let more = [exact(2, None), exact(2, Some(THRESHOLD))];
        Self {
            size: (128, 128),
            filters: Filter::THESIS.into(),
            lattices: [&[one, two], thesis.as_slice(), &rest].concat(),
            areas: [&whole[..], &[exact(1, None)], &split, &more].concat(),
            truth_samples: 32,
            most_truth_samples: MOST_SAMPLES,
            patience: Duration::from_millis(200),
            quick: false,
            reference: None,
        }
    }

    /// Returns a plan of few methods and small pictures, 64 x 64 pixels.
    #[must_use]
    pub fn quick() -> Self {
        let lattices =
            [Sampling::regular(1), Sampling::Supersample(Supersample::Rays), Sampling::regular(4)]
                .into();
        let whole = [Filter::Ewa16, Filter::Probes, Filter::Exact];
        let whole = whole.map(|filter| Method::area(filter, 1, None));
        let split = Method::area(Filter::Exact, 1, Some(THRESHOLD));
        Self {
            size: (64, 64),
            lattices,
            areas: [whole.as_slice(), &[split]].concat(),
            most_truth_samples: 64,
            patience: Duration::from_millis(20),
            quick: true,
            ..Self::full()
        }
    }

    /// Keeps the methods of these filters alone, in the order of the plan. Nothing is left out if there are none.
    pub fn keep_filters(&mut self, filters: &[Filter]) {
        if !filters.is_empty() {
            self.filters.retain(|filter| filters.contains(filter));
            self.areas.retain(|method| filters.contains(&method.filter));
        }
    }

    /// Replaces the numbers of rays and of areas along each side of a pixel. Areas keep the thresholds of the plan.
    /// The thesis's supersampling, whose number is fixed, is left out.
    pub fn set_samples(&mut self, samples: &[u32]) {
        if samples.is_empty() {
            return;
        }
        self.lattices = samples.iter().map(|&samples| Sampling::regular(samples)).collect();
        let mut areas: Vec<Method> = Vec::new();
        for &samples in samples {
            for method in &self.areas {
                let Some((_, threshold)) = method.areas() else { continue };
                let method = Method::area(method.filter, samples, threshold);
                if !areas.contains(&method) {
                    areas.push(method);
                }
            }
        }
        self.areas = areas;
    }

    /// Returns every method that makes a picture of its own. For filters that do not average over
    /// an area, both forms of the thesis's supersampling give the same picture to the last bit. One
    /// form is then left out.
    #[must_use]
    pub fn methods(&self) -> Vec<Method> {
        let image = Sampling::Supersample(Supersample::Image);
        let rays = Sampling::Supersample(Supersample::Rays);
        let twice = |filter: Filter, sampling| {
            !filter.wants_area() && sampling == rays && self.lattices.contains(&image)
        };
        let lattice = self.filters.iter().flat_map(|&filter| {
            self.lattices.iter().map(move |&sampling| Method { filter, sampling })
        });
        let lattice = lattice.filter(|method| !twice(method.filter, method.sampling));
        lattice.chain(self.areas.iter().copied()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_report_has_every_filter_with_all_its_rays() {
        let methods = Plan::full().methods();
        // Six grids for each of six filters. The thesis's supersampling has two forms for four filters,
        // and one for the two that look up points. Four filters and the exact average over the same
        // areas, three thresholds, and two methods with more areas.
        assert_eq!(methods.len(), 6 * 6 + 4 * 2 + 2 + 5 + 3 + 2);
        for filter in Filter::THESIS {
            for samples in [1, 16] {
                let method = Method { filter, sampling: Sampling::regular(samples) };
                assert!(methods.contains(&method), "{method:?}");
            }
        }
        for filter in Filter::ALL {
            assert!(methods.iter().any(|method| method.filter == filter), "{filter}");
        }
        for (k, method) in methods.iter().enumerate() {
            assert!(!methods[..k].contains(method), "twice: {method:?}");
        }
    }

    #[test]
    fn methods_and_rays_may_be_chosen() {
        let mut plan = Plan::quick();
        plan.keep_filters(&[Filter::Exact, Filter::Tent]);
        plan.set_samples(&[1, 3]);
        let methods = plan.methods();
        // The tent with 1 and 9 rays; exact whole and split, with 1 and 9 areas.
        let exact = |samples, threshold| Method::area(Filter::Exact, samples, threshold);
        let tent = |samples| Method { filter: Filter::Tent, sampling: Sampling::regular(samples) };
        let split = Some(THRESHOLD);
        let expected =
            [tent(1), tent(3), exact(1, None), exact(1, split), exact(3, None), exact(3, split)];
        assert_eq!(methods, expected);
        let (mut same, all) = (Plan::full(), Plan::full().methods());
        same.keep_filters(&[]);
        same.set_samples(&[]);
        assert_eq!(same.methods(), all);
    }

    #[test]
    fn a_quick_one_has_the_thesis_and_what_it_is_held_against() {
        let methods = Plan::quick().methods();
        assert_eq!(methods.len(), 6 * 3 + 4);
        let nine =
            Method { filter: Filter::Tent, sampling: Sampling::Supersample(Supersample::Rays) };
        assert!(methods.contains(&nine) && Plan::quick().truth_samples >= 32);
        let areas = Plan::full().areas;
        assert!(Plan::quick().areas.iter().all(|own| areas.contains(own)), "it has no others");
        let exact = |threshold| Method::area(Filter::Exact, 1, threshold);
        assert!(methods.contains(&exact(None)) && methods.contains(&exact(Some(THRESHOLD))));
    }
}
