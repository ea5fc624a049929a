//! Averages a texture over few texels directly, without a table.
//!
//! A table answers for any footprint at the same cost, 81 entries for a tent and 256 for a
//! quadratic. A footprint of a few texels is cheaper to average texel by texel, with the kernel's
//! weight on each. Both averages are exact and therefore equal.

use super::kernel;
use crate::color::Color;
use crate::texture::Texture;
use glam::{DVec2, DVec3};

/// Largest step in texels that is averaged directly, by order.
///
/// Such a tent covers at most six by six texels of 6 bytes, against 81 entries of 24 bytes that lie
/// far apart. At steps of 3 and more the two cost the same. The quadratic covers up to 20 by 20
/// texels, against 256 entries of 24 or 48 bytes. A box reads 16 entries, which is few enough.
pub const WIDEST: [f64; 4] = [0.0, 0.0, 2.0, 6.0];

/// Largest number of texels that a direct footprint covers along one axis.
const MOST: usize = 20;

/// Returns the average under the B-spline of order `n`, centred at `at`, linear RGB. `step` holds
/// the steps along both axes, 1 to [`WIDEST`]. Positions and steps are in texels.
#[must_use]
pub fn average(texture: &Texture, n: usize, at: DVec2, step: DVec2) -> Color {
    let columns = Weights::new(n, at.x, step.x);
    let rows = Weights::new(n, at.y, step.y);
    let mut places = [0; MOST];
    for (k, place) in places.iter_mut().enumerate().take(columns.count) {
        *place = texture.wrap.index(columns.first + k as f64, texture.width);
    }
    let mut sum = DVec3::ZERO;
    for (k, &row_weight) in rows.weights.iter().enumerate().take(rows.count) {
        let row = texture.wrap.index(rows.first + k as f64, texture.height) * texture.width;
        let mut along = DVec3::ZERO;
        for (&place, &weight) in places.iter().zip(&columns.weights).take(columns.count) {
            along += weight * DVec3::from(texture.texels[row + place].map(f64::from));
        }
        sum += row_weight * along;
    }
    sum * texture.unit()
}

/// Weights of the texels under a kernel along one axis.
struct Weights {
    /// Index of the first texel, a whole number of either sign.
    first: f64,
    count: usize,
    weights: [f64; MOST],
}

impl Weights {
    fn new(n: usize, x: f64, step: f64) -> Self {
        let first = (x - 0.5 * n as f64 * step).floor();
        let mut weights = [0.0; MOST];
        let mut count = 0;
        let mut below = 0.0;
        for (k, weight) in weights.iter_mut().enumerate() {
            let up_to = kernel::integral(n, (first + (k + 1) as f64 - x) / step);
            *weight = up_to - below;
            below = up_to;
            count = k + 1;
            if up_to >= 1.0 {
                break;
            }
        }
        Self { first, count, weights }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_weights_sum_to_one(x in -50.0..50.0f64, n in 2usize..=3, share in 0.0..=1.0f64) {
            let step = 1.0 + share * (WIDEST[n] - 1.0);
            let Weights { count, weights, .. } = Weights::new(n, x, step);
            let sum: f64 = weights[..count].iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-15, "{sum}");
            prop_assert!(weights.iter().all(|&weight| weight >= -1e-16));
        }
    }
}
