//! The lattice of random values from which all noise is interpolated (thesis 2.1).
//!
//! Space is divided into cells of side 1. The corners of a cell carry random values in `[-1, 1)`.
//! The values come from an integer hash and not from a generator with a state, so they are the same
//! in every run and on every machine. The lattice repeats after [`MAXNOISE`] cells in each
//! direction.

use glam::DVec3;

/// Number of lattice points in each direction before the values repeat; a power of two.
///
/// The thesis does not state its number. With a smaller number the repetition shows on large
/// objects. With a larger number the table (4 bytes per point of the cube, 1 MB here) no longer
/// fits the nearer caches.
pub const MAXNOISE: usize = 64;

/// Distinguishes this lattice from others that the same hash could fill.
const SEED: u32 = 0x1993;

/// Random values at the points of a cube of side [`MAXNOISE`], which is repeated to fill space.
#[derive(Clone, PartialEq)]
pub struct NoiseLattice {
    /// Values with x running fastest, then y, then z. Each is a multiple of 2^-23, which `f32`
    /// holds exactly.
    values: Vec<f32>,
}

/// The lattice cell that contains a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Lower corner of the cell, a lattice point.
    pub corner: [i64; 3],
    /// Position of the point within the cell, each coordinate in `[0, 1]`.
    pub offset: DVec3,
}

impl Cell {
    /// Returns the cell of a point. If any coordinate is not finite, the point is replaced by the
    /// origin. A coordinate of 2^53 or more is itself a lattice point.
    #[must_use]
    pub fn of(point: DVec3) -> Self {
        let point = if point.is_finite() { point } else { DVec3::ZERO };
        let corner = point.floor();
        let offset = point - corner;
        Self { corner: corner.to_array().map(|x| x as i64), offset }
    }

    /// Returns the lattice point `step` cells from the lower corner.
    #[must_use]
    pub fn at(&self, step: [i64; 3]) -> [i64; 3] {
        std::array::from_fn(|k| self.corner[k].wrapping_add(step[k]))
    }
}

impl NoiseLattice {
    /// Fills the lattice.
    #[must_use]
    pub fn new() -> Self {
        let count = MAXNOISE.pow(3) as u32;
        Self { values: (0..count).map(|index| signed(mixed(index, SEED))).collect() }
    }

    /// Returns the value at a lattice point, in `[-1, 1)`.
    #[must_use]
    pub fn value(&self, point: [i64; 3]) -> f64 {
        let [x, y, z] = point.map(|x| x as usize & (MAXNOISE - 1));
        f64::from(self.values[x + MAXNOISE * (y + MAXNOISE * z)])
    }

    /// Memory of the table, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.values.as_slice())
    }
}

impl Default for NoiseLattice {
    fn default() -> Self {
        Self::new()
    }
}

impl std::fmt::Debug for NoiseLattice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("NoiseLattice").field("values", &self.values.len()).finish()
    }
}

/// Maps the upper 24 bits of a 32-bit hash to a number in `[-1, 1)`.
fn signed(hash: u32) -> f32 {
    (hash >> 8) as f32 / (1 << 23) as f32 - 1.0
}

/// Hashes a number with a seed, by the finaliser of `MurmurHash3` (A. Appleby).
#[must_use]
pub fn mixed(number: u32, seed: u32) -> u32 {
    let mut h = number ^ seed.wrapping_mul(0x9e37_79b9);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

/// Hashes a lattice point with a seed. The result does not repeat before 2^32 cells.
#[must_use]
pub fn mixed_at(point: [i64; 3], seed: u32) -> u32 {
    point.into_iter().fold(seed, |h, x| mixed(x as u32, h.wrapping_add(1)))
}

/// Maps a hash to a number in `[0, 1)`.
#[must_use]
pub fn share(hash: u32) -> f64 {
    f64::from(hash) / 4_294_967_296.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values were computed with a separate program in another language.
    #[test]
    fn the_first_values_of_the_lattice_are_these() {
        let lattice = NoiseLattice::new();
        for (point, code) in [
            ([0, 0, 0], 9417826),
            ([1, 0, 0], 3864150),
            ([0, 1, 0], 1014191),
            ([0, 0, 1], 8870859),
            ([63, 62, 61], 1765323),
        ] {
            assert_eq!(lattice.value(point), f64::from(code) / 8_388_608.0 - 1.0, "{point:?}");
        }
    }

    #[test]
    fn the_lattice_repeats_after_maxnoise_cells_also_below_zero() {
        let lattice = NoiseLattice::new();
        let period = MAXNOISE as i64;
        for point in [[0, 0, 0], [3, 60, 17], [63, 63, 63]] {
            let value = lattice.value(point);
            assert_eq!(value, lattice.value(point.map(|x| x + period)));
            assert_eq!(value, lattice.value(point.map(|x| x - 5 * period)));
        }
        assert_ne!(lattice.value([0, 0, 0]), lattice.value([32, 0, 0]));
    }

    /// Uniform values in [-1, 1) have mean 0 and mean square 1/3. With 2^18 of them the mean
    /// deviates by 0.0011 and the mean square by 0.0006. Neighbours are independent, so their
    /// products deviate by 0.00065. The test allows five times as much.
    #[test]
    fn the_values_look_uniform_and_neighbours_independent() {
        let lattice = NoiseLattice::new();
        let count = lattice.values.len() as f64;
        let mean =
            |of: &dyn Fn(usize) -> f64| (0..lattice.values.len()).map(of).sum::<f64>() / count;
        let value = |k: usize| f64::from(lattice.values[k % lattice.values.len()]);
        assert!(mean(&value).abs() < 0.0055);
        assert!((mean(&|k| value(k) * value(k)) - 1.0 / 3.0).abs() < 0.003);
        for step in [1, MAXNOISE, MAXNOISE * MAXNOISE] {
            assert!(mean(&|k| value(k) * value(k + step)).abs() < 0.0033, "{step}");
        }
        assert!(lattice.values.iter().all(|v| (-1.0..1.0).contains(v)));
    }

    #[test]
    fn far_and_unmeasurable_points_have_a_cell() {
        for x in [1e9 + 0.5, -1e9 - 0.25, 1e18, -1e300, f64::NAN, f64::INFINITY] {
            let cell = Cell::of(DVec3::new(x, 0.5, -0.5));
            assert!(cell.offset.is_finite(), "{x}");
            assert!(cell.offset.min_element() >= 0.0 && cell.offset.max_element() <= 1.0, "{x}");
            assert!(NoiseLattice::new().value(cell.at([1, 1, 1])).is_finite());
        }
        let cell = Cell::of(DVec3::new(-1e9 - 0.25, 2.75, 0.0));
        assert_eq!(
            (cell.corner, cell.offset),
            ([-1_000_000_001, 2, 0], DVec3::new(0.75, 0.75, 0.0))
        );
    }
}
