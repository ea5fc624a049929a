//! `dnoise` (thesis fig. 2.3): the direction in which noise increases, from its differences along
//! x, y and z.
//!
//! The figure keeps three lattices of forward differences of the noise lattice, interpolates each
//! and normalises the result. Here the differences are computed on demand. This gives the same
//! numbers and needs no lattice but the one of [`super::noise`].
//!
//! There are two departures. Where all three differences vanish, the figure divides by zero; here
//! the result is the zero vector. The figure takes the upper neighbour at
//! `(x + 1) % (MAXNOISE + 1)`, a remainder that its loop over `x < MAXNOISE` never needs. It leaves
//! the differences of the last layer unset, although interpolation reads them. Here the lattice
//! repeats after `MAXNOISE` cells, and its last layer meets the first.

use super::lattice::Cell;
use super::noise::{Noise, interpolated, step};
use glam::DVec3;

impl Noise {
    /// Returns the interpolated forward differences at a point of texture space, normalised: a unit
    /// vector, or zero.
    #[must_use]
    pub fn dnoise(&self, point: DVec3) -> DVec3 {
        self.differences(point).normalize_or_zero()
    }

    /// Returns the interpolated forward differences along x, y and z, each in `[-2, 2]`.
    #[must_use]
    pub fn differences(&self, point: DVec3) -> DVec3 {
        let cell = Cell::of(point);
        let offset = self.faded(&cell);
        let along = |axis: usize| {
            let difference = |k: usize| {
                let near = step(k);
                let mut far = near;
                far[axis] += 1;
                self.lattice.value(cell.at(far)) - self.lattice.value(cell.at(near))
            };
            interpolated(std::array::from_fn(difference), offset)
        };
        DVec3::new(along(0), along(1), along(2))
    }
}
