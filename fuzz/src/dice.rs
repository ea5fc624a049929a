//! Random numbers that depend on the seed, the reader and the case alone.

pub use fixtures::Dice;

/// Returns the stream of one case of one reader.
#[must_use]
pub fn of_case(seed: u64, reader: &str, case: u64) -> Dice {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(reader.as_bytes());
    let reader = u64::from(hasher.finalize());
    let mut dice = Dice::new(seed ^ reader.rotate_left(32));
    Dice::new(dice.bits() ^ case.wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_has_its_own_stream_and_always_the_same() {
        let first = |seed, reader, case| of_case(seed, reader, case).bits();
        assert_eq!(first(1, "obj", 7), first(1, "obj", 7));
        let others = [first(2, "obj", 7), first(1, "mtl", 7), first(1, "obj", 8)];
        assert!(others.iter().all(|other| *other != first(1, "obj", 7)));
    }
}
