//! Random numbers that depend on the seed, the reader and the case alone (`SplitMix64`).

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub struct Dice(u64);

impl Dice {
    /// The stream of one case of one reader.
    #[must_use]
    pub fn of_case(seed: u64, reader: &str, case: u64) -> Self {
        let mut hasher = crc32fast::Hasher::new();
        hasher.update(reader.as_bytes());
        let reader = u64::from(hasher.finalize());
        let mut dice = Self(seed ^ reader.rotate_left(32));
        Self(dice.next() ^ case.wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    /// The next number.
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 to `count - 1`; 0 where `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % (count.max(1) as u64)) as usize
    }

    /// True once in `count` times.
    pub fn once_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    /// One element of a list.
    ///
    /// # Panics
    /// When the list is empty.
    pub fn one<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }

    /// A number in [0, 1).
    pub fn fraction(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_has_its_own_stream_and_always_the_same() {
        let first = |seed, reader, case| Dice::of_case(seed, reader, case).next();
        assert_eq!(first(1, "obj", 7), first(1, "obj", 7));
        let others = [first(2, "obj", 7), first(1, "mtl", 7), first(1, "obj", 8)];
        assert!(others.iter().all(|other| *other != first(1, "obj", 7)));
    }

    #[test]
    fn fractions_lie_in_the_unit_interval() {
        let mut dice = Dice::of_case(0, "", 0);
        assert!((0..1000).all(|_| (0.0..1.0).contains(&dice.fraction())));
    }
}
