//! What a report measures, and how patiently.

use super::measured::Method;
use render::Sampling;
use render::film::{MOST_SAMPLES, Nine};
use render::filter::Filter;
use std::time::Duration;

/// What is measured of each page.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Pixels across and down, of all pictures.
    pub size: (u32, u32),
    /// Filters, from the simplest on.
    pub filters: Vec<Filter>,
    /// Ways to make a pixel of rays, from few rays to many.
    pub samplings: Vec<Sampling>,
    /// Rays along each side of a pixel for the truth, for each of two seeds: at least.
    pub truth_samples: u32,
    /// The same: at most, where the noise asks for more.
    pub most_truth_samples: u32,
    /// How long a method is measured at least, all its rounds together.
    pub patience: Duration,
    /// Whether it is made in haste.
    pub quick: bool,
}

/// Rays along each side of a pixel, evenly spread, in a full report.
const SAMPLES: [u32; 6] = [1, 2, 3, 4, 8, 16];

impl Plan {
    /// All methods, at 128 x 128.
    #[must_use]
    pub fn full() -> Self {
        let [one, two, rest @ ..] = SAMPLES.map(Sampling::regular);
        let thesis = [Sampling::Nine(Nine::Image), Sampling::Nine(Nine::Rays)];
        Self {
            size: (128, 128),
            filters: Filter::ALL.into(),
            samplings: [&[one, two], thesis.as_slice(), &rest].concat(),
            truth_samples: 32,
            most_truth_samples: MOST_SAMPLES,
            patience: Duration::from_millis(200),
            quick: false,
        }
    }

    /// Few methods and small pictures.
    #[must_use]
    pub fn quick() -> Self {
        let samplings =
            [Sampling::regular(1), Sampling::Nine(Nine::Rays), Sampling::regular(4)].into();
        Self {
            size: (64, 64),
            samplings,
            most_truth_samples: 64,
            patience: Duration::from_millis(20),
            quick: true,
            ..Self::full()
        }
    }

    /// Every method that makes a picture of its own. Without neighbours to look at, both forms of the
    /// thesis's supersampling are the same to the last bit: then one is left out.
    #[must_use]
    pub fn methods(&self) -> Vec<Method> {
        let image = Sampling::Nine(Nine::Image);
        let rays = Sampling::Nine(Nine::Rays);
        let twice = |filter: Filter, sampling| {
            !filter.wants_area() && sampling == rays && self.samplings.contains(&image)
        };
        let all = self.filters.iter().flat_map(|&filter| {
            self.samplings.iter().map(move |&sampling| Method { filter, sampling })
        });
        all.filter(|method| !twice(method.filter, method.sampling)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_report_has_every_filter_with_all_its_rays() {
        let methods = Plan::full().methods();
        // Six grids for each of six filters, and the thesis's supersampling: two forms for four of
        // them, one for the two that look at points.
        assert_eq!(methods.len(), 6 * 6 + 4 * 2 + 2);
        for filter in Filter::ALL {
            for samples in [1, 16] {
                let method = Method { filter, sampling: Sampling::regular(samples) };
                assert!(methods.contains(&method), "{method:?}");
            }
        }
        for (k, method) in methods.iter().enumerate() {
            assert!(!methods[..k].contains(method), "twice: {method:?}");
        }
    }

    #[test]
    fn a_quick_one_has_the_thesis_and_what_it_is_held_against() {
        let methods = Plan::quick().methods();
        assert_eq!(methods.len(), 6 * 3);
        let nine = Method { filter: Filter::Tent, sampling: Sampling::Nine(Nine::Rays) };
        assert!(methods.contains(&nine) && Plan::quick().truth_samples >= 32);
    }
}
