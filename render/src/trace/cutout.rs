//! Surfaces that a mask cuts out.
//!
//! A ray that meets such a surface is followed beyond it, unless the mask is opaque all around the hit.
//! The part of its light that passes is known when the mask is averaged over the footprint.

use crate::texture::Texture;
use glam::DVec2;

/// Largest number of surfaces with masks, one behind another, through which a ray is followed. The work
/// and the depth of the recursion are bounded by it. Beyond them a mask counts as opaque.
pub const MOST_PASSED: u32 = 256;

/// Largest side of a rectangle of texels that is examined. In a larger one, some texel is taken to be
/// transparent.
///
/// If larger, distant leaves take long to examine. If smaller, more rays are followed behind opaque
/// surfaces, and count for nothing.
const MOST_EXAMINED: f64 = 12.0;

/// Texels around a footprint that filters read.
const AROUND: f64 = 1.5;

/// Returns whether a mask may let light pass within a footprint. `uv` are the texture coordinates of the
/// hit, and `sides` their changes across and down the footprint; `None` if the footprint is not known.
#[must_use]
pub fn may_pass(mask: &Texture, uv: DVec2, sides: Option<[DVec2; 2]>) -> bool {
    let Some([a, b]) = sides else { return true };
    let size = DVec2::new(mask.width as f64, mask.height as f64);
    let reach = 0.5 * (a.abs() + b.abs()) * size + AROUND;
    // Comparisons with NaN are false.
    if !(reach.x <= MOST_EXAMINED && reach.y <= MOST_EXAMINED) {
        return true;
    }
    let middle = mask.in_texels(uv);
    let (low, high) = ((middle - reach).floor(), (middle + reach).floor());
    let steps = |low: f64, high: f64| (0..=(high - low) as u32).map(move |k| low + f64::from(k));
    steps(low.y, high.y).any(|y| {
        let row = mask.wrap.index(y, mask.height) * mask.width;
        steps(low.x, high.x).any(|x| {
            let texel = mask.texels[row + mask.wrap.index(x, mask.width)];
            texel[0] < mask.white
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_around_transparent_texels_light_may_pass() {
        let mut texels = vec![[u16::MAX; 3]; 400];
        texels[10 * 20 + 10] = [0; 3];
        let mask = Texture { width: 20, height: 20, texels, white: u16::MAX, ..Texture::default() };
        let at = |x: f64, y: f64| DVec2::new(x / 20.0, 1.0 - y / 20.0);
        let sides = Some([DVec2::new(0.05, 0.0), DVec2::new(0.0, 0.05)]);
        assert!(may_pass(&mask, at(10.5, 10.5), sides));
        assert!(may_pass(&mask, at(12.0, 9.0), sides), "within the reach of a filter");
        assert!(!may_pass(&mask, at(15.5, 10.5), sides));
        assert!(may_pass(&mask, at(15.5, 10.5), sides.map(|sides| sides.map(|side| 9.0 * side))));
        assert!(may_pass(&mask, at(15.5, 10.5), None));
        assert!(may_pass(&mask, at(15.5, 10.5), Some([DVec2::NAN; 2])));
    }
}
