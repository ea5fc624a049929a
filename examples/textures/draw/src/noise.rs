//! Noise on a lattice that wraps, from an integer hash. The noise is the same on every machine, and
//! tileable.

use glam::{DVec2, IVec2};

/// Returns a well mixed number for a lattice point.
///
/// Uses the multiply and shift rounds of the finaliser of `MurmurHash3`. `seed` distinguishes the
/// uses.
pub fn hash(point: IVec2, seed: u32) -> u32 {
    let mut h = seed.wrapping_mul(0x9e37_79b9);
    for part in [point.x as u32, point.y as u32] {
        h ^= part;
        h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
        h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
        h ^= h >> 16;
    }
    h
}

/// Returns a hash as a number in `[0, 1)`.
pub fn unit(hash: u32) -> f64 {
    f64::from(hash) / 4_294_967_296.0
}

/// Returns smooth noise in `[0, 1]`, from one random value per lattice point. The noise repeats
/// after `period` lattice cells.
fn value_noise(p: DVec2, period: IVec2, seed: u32) -> f64 {
    let corner = p.floor();
    let f = p - corner;
    // Zero slope at the lattice points hides the lattice.
    let s = f * f * (DVec2::splat(3.0) - 2.0 * f);
    let at = |dx, dy| {
        let point = (corner.as_ivec2() + IVec2::new(dx, dy)).rem_euclid(period);
        unit(hash(point, seed))
    };
    let low = at(0, 0) + (at(1, 0) - at(0, 0)) * s.x;
    let high = at(0, 1) + (at(1, 1) - at(0, 1)) * s.x;
    low + (high - low) * s.y
}

/// Returns three octaves of [`value_noise`], in `[0, 1]`.
pub fn cloud(p: DVec2, period: IVec2, seed: u32) -> f64 {
    let octave = |k: i32| value_noise(p * f64::from(k), period * k, seed + k as u32);
    (4.0 * octave(1) + 2.0 * octave(2) + octave(4)) / 7.0
}

/// The grain that contains a point; see [`grain`].
#[derive(Debug, Clone, Copy)]
pub struct Grain {
    /// Random bits of this grain.
    pub hash: u32,
    /// Distance to the grain's centre, in lattice cells.
    pub distance: f64,
    /// Distance to the second nearest centre minus `distance`, in lattice cells: 0 on the boundary
    /// between two grains.
    pub margin: f64,
}

/// Returns the grain that contains a point. The plane is divided among one random centre per
/// lattice cell (Worley's cells), and repeats after `period` cells.
///
/// Only the nine cells around the point are searched. A nearer centre two cells away is rare, and
/// only moves a boundary.
pub fn grain(p: DVec2, period: IVec2, seed: u32) -> Grain {
    let home = p.floor().as_ivec2();
    let mut nearest = Grain { hash: 0, distance: f64::INFINITY, margin: 0.0 };
    let mut second = f64::INFINITY;
    for dy in -1..=1 {
        for dx in -1..=1 {
            let cell = home + IVec2::new(dx, dy);
            let h = hash(cell.rem_euclid(period), seed);
            let jitter = DVec2::new(f64::from(h & 0xffff), f64::from(h >> 16)) / 65536.0;
            let distance = (cell.as_dvec2() + jitter).distance(p);
            if distance < nearest.distance {
                second = nearest.distance;
                nearest = Grain { hash: h.wrapping_mul(0x9e37_79b1), distance, margin: 0.0 };
            } else if distance < second {
                second = distance;
            }
        }
    }
    Grain { margin: second - nearest.distance, ..nearest }
}
