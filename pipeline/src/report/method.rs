//! Names of methods.

use super::measured::Method;
use render::Sampling;
use render::film::{Pattern, PixelFilter, Supersample};

impl Method {
    /// Returns filter and rays as tables and sentences name them: `tent, 3 x 3 rays`.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}, {}", self.filter, self.rays())
    }

    /// Returns the rays of a pixel in words, such as `3 x 3 rays`.
    #[must_use]
    pub fn rays(&self) -> String {
        match self.sampling {
            Sampling::Supersample(Supersample::Image) => "supersampled".into(),
            Sampling::Supersample(Supersample::Rays) => "nine rays".into(),
            Sampling::Grid { samples, pattern, pixel_filter } => {
                let grid = match samples {
                    1 => "1 ray".to_string(),
                    n => format!("{n} x {n} rays"),
                };
                let jitter = if pattern == Pattern::Regular { "" } else { ", jittered" };
                let tent =
                    if pixel_filter == PixelFilter::Box { "" } else { ", weighted by a tent" };
                format!("{grid}{jitter}{tent}")
            }
        }
    }

    /// Returns the rays along each side of a pixel, if the rays are evenly spread and have equal
    /// weights.
    #[must_use]
    pub fn evenly(&self) -> Option<u32> {
        match self.sampling {
            sampling @ Sampling::Grid { samples, .. } => {
                (sampling == Sampling::regular(samples)).then_some(samples)
            }
            Sampling::Supersample(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use render::filter::Filter;

    #[test]
    fn methods_are_named_by_filter_and_rays() {
        let jitter = Sampling::Grid {
            samples: 4,
            pattern: Pattern::Jitter { seed: 1 },
            pixel_filter: PixelFilter::Tent,
        };
        for (sampling, name, evenly) in [
            (Sampling::regular(1), "tent, 1 ray", Some(1)),
            (Sampling::regular(3), "tent, 3 x 3 rays", Some(3)),
            (Sampling::Supersample(Supersample::Image), "tent, supersampled", None),
            (Sampling::Supersample(Supersample::Rays), "tent, nine rays", None),
            (jitter, "tent, 4 x 4 rays, jittered, weighted by a tent", None),
        ] {
            let method = Method { filter: Filter::Tent, sampling };
            assert_eq!(method.name(), name);
            assert_eq!(method.evenly(), evenly, "{name}");
        }
    }
}
