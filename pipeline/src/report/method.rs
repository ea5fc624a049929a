//! Methods by areas and on the thesis's lattice, and the names of methods.

use super::measured::Method;
use render::Sampling;
use render::film::{Pattern, PixelFilter, Supersample};
use render::filter::Filter;

impl Method {
    /// Returns a method by areas, with `samples * samples` of them in a pixel. An area is split if its
    /// error, in linear light times its part of a pixel, is estimated to be above `threshold`.
    #[must_use]
    pub fn area(filter: Filter, samples: u32, threshold: Option<f64>) -> Self {
        let pixel_filter = PixelFilter::Box;
        Self { filter, sampling: Sampling::Area { samples, pixel_filter, threshold } }
    }

    /// Returns filter and rays as tables and sentences name them: `tent, 3 x 3 rays`.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}, {}", self.filter, self.rays())
    }

    /// Returns the rays of a pixel in words, such as `3 x 3 rays`, or its areas, such as `1 area`.
    #[must_use]
    pub fn rays(&self) -> String {
        match self.sampling {
            Sampling::Supersample(Supersample::Image) => "supersampled".into(),
            Sampling::Supersample(Supersample::Rays) => "nine rays".into(),
            Sampling::Grid { samples, pattern, pixel_filter } => {
                let jitter = if pattern == Pattern::Regular { "" } else { ", jittered" };
                format!("{}{jitter}{}", squared(samples, "ray"), weighted(pixel_filter))
            }
            Sampling::Area { samples, pixel_filter, threshold } => {
                let split = threshold.map_or(String::new(), |at| format!(" split at {at}"));
                format!("{}{split}{}", squared(samples, "area"), weighted(pixel_filter))
            }
        }
    }

    /// Returns the rays along each side of a pixel, if the rays are on the thesis's lattice, evenly
    /// spread, and have equal weights.
    #[must_use]
    pub fn evenly(&self) -> Option<u32> {
        match self.sampling {
            sampling @ Sampling::Grid { samples, .. } => {
                (sampling == Sampling::regular(samples)).then_some(samples)
            }
            Sampling::Supersample(_) | Sampling::Area { .. } => None,
        }
    }

    /// Returns the areas along each side of a pixel and the threshold of splitting, if the method is one
    /// by areas.
    #[must_use]
    pub fn areas(&self) -> Option<(u32, Option<f64>)> {
        match self.sampling {
            Sampling::Area { samples, threshold, .. } => Some((samples, threshold)),
            Sampling::Grid { .. } | Sampling::Supersample(_) => None,
        }
    }
}

/// Returns `1 ray` or `3 x 3 rays`.
fn squared(samples: u32, word: &str) -> String {
    match samples {
        1 => format!("1 {word}"),
        n => format!("{n} x {n} {word}s"),
    }
}

fn weighted(pixel_filter: PixelFilter) -> &'static str {
    match pixel_filter {
        PixelFilter::Box => "",
        PixelFilter::Tent => ", weighted by a tent",
        PixelFilter::Gaussian => ", weighted by a Gaussian",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_are_named_by_filter_and_rays() {
        let jitter = Sampling::Grid {
            samples: 4,
            pattern: Pattern::Jitter { seed: 1 },
            pixel_filter: PixelFilter::Tent,
        };
        let gaussian =
            Sampling::Area { samples: 1, pixel_filter: PixelFilter::Gaussian, threshold: None };
        let area = |samples, threshold| Method::area(Filter::Tent, samples, threshold).sampling;
        for (sampling, name, evenly, areas) in [
            (Sampling::regular(1), "tent, 1 ray", Some(1), None),
            (Sampling::regular(3), "tent, 3 x 3 rays", Some(3), None),
            (Sampling::Supersample(Supersample::Image), "tent, supersampled", None, None),
            (Sampling::Supersample(Supersample::Rays), "tent, nine rays", None, None),
            (jitter, "tent, 4 x 4 rays, jittered, weighted by a tent", None, None),
            (area(1, None), "tent, 1 area", None, Some((1, None))),
            (area(1, Some(0.02)), "tent, 1 area split at 0.02", None, Some((1, Some(0.02)))),
            (area(2, Some(0.1)), "tent, 2 x 2 areas split at 0.1", None, Some((2, Some(0.1)))),
            (gaussian, "tent, 1 area, weighted by a Gaussian", None, Some((1, None))),
        ] {
            let method = Method { filter: Filter::Tent, sampling };
            assert_eq!(method.name(), name);
            assert_eq!((method.evenly(), method.areas()), (evenly, areas), "{name}");
        }
    }
}
