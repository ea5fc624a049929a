//! `dnoise` (thesis fig. 2.3): how noise changes along x, y and z, as a direction.
//!
//! The figure keeps three lattices of forward differences of the noise lattice, interpolates each
//! and normalises. Here the differences are taken when they are asked for, which gives the same
//! numbers and keeps no lattice but the one of [`super::noise`].
//!
//! Two departures. Where all three differences vanish the figure divides by zero; here the result
//! is the zero vector. The figure takes the upper neighbour at `(x + 1) % (MAXNOISE + 1)`, a
//! remainder that its loop over `x < MAXNOISE` never needs, and leaves the differences of the last
//! layer unset, which interpolation reads; here the lattice repeats after `MAXNOISE` cells, and its
//! last layer meets the first.

use super::lattice::Cell;
use super::noise::{Noise, interpolated, step};
use glam::DVec3;

impl Noise {
    /// The interpolated forward differences, normalised: a unit vector, or zero.
    #[must_use]
    pub fn dnoise(&self, point: DVec3) -> DVec3 {
        self.differences(point).normalize_or_zero()
    }

    /// The interpolated forward differences along x, y and z, each in `[-2, 2]`.
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
