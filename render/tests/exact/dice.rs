//! Numbers that look random and are the same every time.

use glam::DVec3;

/// `SplitMix64` (Steele, Lea, Flood: *Fast splittable pseudorandom number generators*, 2014).
#[derive(Debug, Clone)]
pub struct Dice(pub u64);

impl Dice {
    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in `[low, high)`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 * 2f64.powi(-53)
    }

    /// A whole number in `0..count`.
    pub fn below(&mut self, count: u64) -> usize {
        (self.bits() % count) as usize
    }

    /// A direction.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::from(std::array::from_fn(|_| self.between(-1.0, 1.0)));
            if (0.1..=1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}
