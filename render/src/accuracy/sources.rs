//! The sources of the error of a picture: meshes, textures and edges.

use super::request::Request;
use super::sample::Sample;
use super::truth::Truth;
use crate::film::BasePicture;
use crate::stats::Stats;
use std::fmt;
use std::time::Instant;

/// Most draws by which meshes are compared.
const COMPARED: usize = 1500;

/// Parts of the mean squared error of a picture. They sum to the squared error up to noise.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sources {
    /// The squared difference between the light on the scene's meshes and on finer ones; `None` if no
    /// mesh has a finer one.
    pub tessellation: Option<f64>,
    /// The squared error of pixels that an edge cuts, or that lie beside one: silhouettes, shadows,
    /// highlights, folds of textures. Without the part of the meshes.
    pub edges: f64,
    /// The squared error of all other pixels, where textures change. Without the part of the meshes.
    pub texture: f64,
}

impl Sources {
    /// Returns the parts of tessellation, texture and edges, which sum to 1, or zeros if there is no
    /// error. A part that noise makes negative counts as 0.
    #[must_use]
    pub fn shares(&self) -> [f64; 3] {
        let parts = [self.tessellation.unwrap_or(0.0), self.texture, self.edges];
        let parts = parts.map(|part| part.max(0.0));
        let sum: f64 = parts.iter().sum();
        if sum > 0.0 { parts.map(|part| part / sum) } else { parts }
    }
}

impl fmt::Display for Sources {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [tessellation, texture, edges] = self.shares().map(|share| 100.0 * share);
        write!(f, "of the squared error: ")?;
        if self.tessellation.is_some() {
            write!(f, "tessellation {tessellation:.0} %, ")?;
        }
        write!(f, "texture {texture:.0} %, edges {edges:.0} %")
    }
}

/// Finds the sources of the error of a picture. `color` is its colour at each pixel of the sample. The
/// work is added to the audit's in `stats`.
pub(super) fn by_cause(
    request: &Request<'_, '_>,
    base: &BasePicture<'_, '_>,
    sample: &Sample,
    color: impl Fn(usize) -> [f32; 3],
    stats: &mut Stats,
) -> Sources {
    let &Request { prepared, truth, finer, .. } = request;
    let started = Instant::now();
    let count = if finer.is_some() { COMPARED.min(sample.len()) } else { sample.len() };
    // True colours on the meshes of the picture, and on finer ones.
    let again = |scene| sample.again(scene, base.settings(), count);
    let own = (!std::ptr::eq(prepared, truth)).then(|| again(prepared));
    let fine = finer.filter(|finer| !std::ptr::eq(*finer, truth)).map(again);
    let mut sources = Sources { tessellation: finer.map(|_| 0.0), ..Sources::default() };
    for (k, (draw, found)) in sample.first(count).enumerate() {
        let own = own.as_ref().map_or(found, |truths| &truths[k]);
        let fine = fine.as_ref().map_or(found, |truths| &truths[k]);
        let part = draw.weight / count as f64;
        if let Some(tessellation) = &mut sources.tessellation {
            *tessellation += part * own.squared_distance(fine);
        }
        let error = part * own.squared_error(color(sample.index(k)));
        if base.edges[draw.place] {
            sources.edges += error;
        } else {
            sources.texture += error;
        }
    }
    let rays =
        |truths: &Option<Vec<Truth>>| truths.iter().flatten().map(|truth| truth.rays).sum::<u64>();
    stats.audit_rays += rays(&own) + rays(&fine);
    stats.audit_time += started.elapsed();
    sources
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_sum_to_one_and_are_not_negative() {
        let sources = Sources { tessellation: Some(1e-5), edges: 3e-5, texture: -1e-6 };
        assert_eq!(sources.shares(), [0.25, 0.0, 0.75]);
        let words = "of the squared error: tessellation 25 %, texture 0 %, edges 75 %";
        assert_eq!(sources.to_string(), words);
        let scene = Sources { tessellation: None, edges: 1.0, texture: 1.0 };
        assert_eq!(scene.to_string(), "of the squared error: texture 50 %, edges 50 %");
        assert_eq!(Sources::default().shares(), [0.0; 3]);
    }
}
