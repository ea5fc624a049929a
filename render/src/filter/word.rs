//! The integers of a prefiltered table.
//!
//! Sums in a table are taken modulo 2^B and may overflow freely. Addition and subtraction modulo
//! 2^B are exact, so a difference of sums is exact if the *difference* fits the word, however large
//! the sums are. A table therefore takes the shortest word that holds every result.

/// An integer whose sums wrap.
pub trait Word: Copy + Default + Send + Sync + std::fmt::Debug {
    /// Converts a texel's code to a word.
    fn from_code(code: u16) -> Self;
    /// Sum modulo 2^B.
    #[must_use]
    fn plus(self, other: Self) -> Self;
    /// Difference modulo 2^B.
    #[must_use]
    fn minus(self, other: Self) -> Self;
    /// Product with a factor of either sign, modulo 2^B.
    #[must_use]
    fn times(self, factor: i128) -> Self;
    /// Returns the value of the word as a signed integer, rounded to 53 bits.
    fn to_f64(self) -> f64;
}

macro_rules! word {
    ($type:ty, $signed:ty) => {
        impl Word for $type {
            #[inline(always)]
            fn from_code(code: u16) -> Self {
                Self::from(code)
            }
            #[inline(always)]
            fn plus(self, other: Self) -> Self {
                self.wrapping_add(other)
            }
            #[inline(always)]
            fn minus(self, other: Self) -> Self {
                self.wrapping_sub(other)
            }
            #[inline(always)]
            fn times(self, factor: i128) -> Self {
                self.wrapping_mul(factor as Self)
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self as $signed as f64
            }
        }
    };
}

word!(u32, i32);
word!(u64, i64);

impl Word for u128 {
    #[inline(always)]
    fn from_code(code: u16) -> Self {
        Self::from(code)
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self.wrapping_sub(other)
    }
    #[inline(always)]
    fn times(self, factor: i128) -> Self {
        self.wrapping_mul(factor as Self)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        // Most results are short, and the conversion of long ones is slow.
        let short = self as u64 as i64;
        if i128::from(short) == self as i128 { short as f64 } else { self as i128 as f64 }
    }
}
