//! The codes of many linear values, found in a table.
//!
//! A code grows with the linear value. The table holds the least value of each code, and for each bucket
//! of values the code of its least one. A bucket is the numbers that share their first 16 bits. It
//! meets few codes, so that a value finds its own in a few comparisons.

use crate::color::Encoding;

/// Bits of a number that do not select its bucket.
const WITHIN: u32 = 16;

/// The codes of an encoding.
pub struct Bytes {
    /// Code of the least value of each bucket, from 0 to 1.
    first: Vec<u8>,
    /// Least value of each code. No value has a code above 255: the value after the last is NaN.
    least: [f32; 257],
}

impl Bytes {
    /// Finds the least value of each code.
    #[must_use]
    pub fn of(encoding: Encoding) -> Self {
        let code = |bits: u32| encoding.to_byte(f64::from(f32::from_bits(bits)));
        let one = 1.0_f32.to_bits();
        let mut least = [f32::NAN; 257];
        for byte in 0..=u8::MAX {
            // The bits of positive numbers are in the order of the numbers.
            let (mut low, mut high) = (0, one);
            while low < high {
                let middle = low + (high - low) / 2;
                if code(middle) < byte { low = middle + 1 } else { high = middle }
            }
            least[usize::from(byte)] = f32::from_bits(low);
        }
        let first = (0..=one >> WITHIN).map(|bucket| code(bucket << WITHIN)).collect();
        Self { first, least }
    }

    /// Returns the nearest 8-bit code of a linear value: that of [`Encoding::to_byte`].
    #[must_use]
    pub fn at(&self, linear: f32) -> u8 {
        // NaN becomes 0, as in a cast to a whole number.
        let linear = if linear > 0.0 { linear.min(1.0) } else { 0.0 };
        let mut code = self.first[(linear.to_bits() >> WITHIN) as usize];
        while linear >= self.least[usize::from(code) + 1] {
            code += 1;
        }
        code
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_agrees_with_the_formula() {
        for encoding in
            [Encoding::Srgb, Encoding::Gamma(2.2), Encoding::Gamma(1.0), Encoding::Gamma(0.3)]
        {
            let bytes = Bytes::of(encoding);
            let special =
                [0.0, -0.0, -3.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-40, 1.0, 2.0];
            // Every 1009th number up to 1, and those on both sides of each change.
            let spread = (0..=1.0_f32.to_bits()).step_by(1009).map(f32::from_bits);
            let changes = bytes.least[..256].iter().flat_map(|&least| [least.next_down(), least]);
            for linear in special.into_iter().chain(spread).chain(changes) {
                let truth = encoding.to_byte(f64::from(linear));
                assert_eq!(bytes.at(linear), truth, "{linear:e} in {encoding:?}");
            }
        }
    }
}
