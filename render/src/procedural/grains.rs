//! Division of space into grains, one for each cell of a lattice (S. Worley, "A Cellular Texture
//! Basis Function", 1996).
//!
//! Each cell of side 1 holds one random centre, and a point belongs to the nearest centre. Only the
//! 27 cells around a point are searched. A nearer centre two cells away is rare and only moves a
//! boundary.

use super::lattice::{Cell, mixed, mixed_at, share};
use glam::DVec3;

/// The grain that contains a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grain {
    /// Random bits of this grain.
    pub hash: u32,
    /// Distance of the point from the grain's centre, in cells.
    pub distance: f64,
    /// Distance from the second nearest centre minus `distance`, in cells. It is 0 on the boundary
    /// between two grains.
    pub margin: f64,
}

impl Grain {
    /// Finds the grain that contains a point of texture space. Different values of `seed` give
    /// independent divisions of the same space.
    #[must_use]
    pub fn of(point: DVec3, seed: u32) -> Self {
        let home = Cell::of(point);
        let mut nearest = Self { hash: 0, distance: f64::INFINITY, margin: 0.0 };
        let mut second = f64::INFINITY;
        for k in 0..27 {
            let step = [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1];
            let hash = mixed_at(home.at(step), seed);
            // Each coordinate of the centre within its cell has ten bits.
            let center =
                [hash, hash >> 10, hash >> 20].map(|bits| (f64::from(bits & 0x3ff) + 0.5) / 1024.0);
            let center = DVec3::from(center) + DVec3::from(step.map(|x| x as f64));
            let distance = center.distance(home.offset);
            if distance < nearest.distance {
                second = nearest.distance;
                nearest = Self { hash, distance, margin: 0.0 };
            } else if distance < second {
                second = distance;
            }
        }
        Self { margin: second - nearest.distance, ..nearest }
    }

    /// Returns a pseudo-random number in `[0, 1)` for this grain. Different values of `which` give
    /// independent numbers.
    #[must_use]
    pub fn share(&self, which: u32) -> f64 {
        share(mixed(self.hash, which))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The distance from a centre is 1-Lipschitz, and the margin is not negative.
        #[test]
        fn distances_to_centres_do_not_jump(
            p in prop::array::uniform3(-50.0..50.0f64), d in prop::array::uniform3(-0.01..0.01f64),
        ) {
            let (p, d) = (DVec3::from(p), DVec3::from(d));
            let (here, there) = (Grain::of(p, 1), Grain::of(p + d, 1));
            prop_assert!(here.margin >= 0.0 && here.distance < 3f64.sqrt());
            // The 27 cells contain all centres nearer than 1.
            prop_assume!(here.distance.max(there.distance) < 0.95);
            if here.hash == there.hash {
                prop_assert!((here.distance - there.distance).abs() <= d.length() + 1e-12);
            } else {
                // The point crossed a boundary and therefore was near it.
                prop_assert!(here.margin <= 2.0 * d.length() + 1e-12);
            }
        }
    }
}
