//! Steps from texel to texel, or from line to line, of a texture that continues beyond its edges.

use crate::texture::Wrap;
use std::ops::Range;

/// A place in a texture along one axis, which moves from texel to texel.
#[derive(Debug, Clone, Copy)]
pub struct Steps {
    wrap: Wrap,
    size: i64,
    /// The current place: within a period of the texture, or anywhere for one that is clamped.
    place: i64,
}

impl Steps {
    /// Starts at the place `at`, of either sign. `size` is the number of texels, at least 1.
    #[inline(always)]
    pub fn new(wrap: Wrap, size: usize, at: i64) -> Self {
        let size = size as i64;
        let place = match wrap {
            Wrap::Repeat if at < 0 || at >= size => at.rem_euclid(size),
            Wrap::Mirror if at < 0 || at >= 2 * size => at.rem_euclid(2 * size),
            Wrap::Repeat | Wrap::Mirror | Wrap::Clamp => at,
        };
        Self { wrap, size, place }
    }

    /// Returns the steps from `count` places further on.
    #[inline(always)]
    pub fn skip(self, count: usize) -> Self {
        Self::new(self.wrap, self.size as usize, self.place + count as i64)
    }

    /// Returns the indices of the next `count` texels if they follow one another.
    #[inline(always)]
    pub fn straight(&self, count: usize) -> Option<Range<usize>> {
        let end = self.place + count as i64;
        (self.place >= 0 && end <= self.size).then_some(self.place as usize..end as usize)
    }

    /// Returns the index of the texel at the current place, and moves on.
    #[inline(always)]
    pub fn next(&mut self) -> usize {
        let place = self.place;
        self.place += 1;
        match self.wrap {
            Wrap::Repeat => {
                if self.place == self.size {
                    self.place = 0;
                }
                place as usize
            }
            Wrap::Mirror => {
                if self.place == 2 * self.size {
                    self.place = 0;
                }
                place.min(2 * self.size - 1 - place) as usize
            }
            Wrap::Clamp => place.clamp(0, self.size - 1) as usize,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn steps_are_the_texels_of_the_wrap(
            size in 1usize..9, at in -40i64..40, skipped in 0usize..20,
            wrap in prop_oneof![Just(Wrap::Repeat), Just(Wrap::Clamp), Just(Wrap::Mirror)],
        ) {
            let mut steps = Steps::new(wrap, size, at).skip(skipped);
            let from = at + skipped as i64;
            for count in 1..12 {
                let indices = (0..count).map(|k| wrap.index((from + k) as f64, size));
                if let Some(straight) = steps.straight(count as usize) {
                    prop_assert!(straight.eq(indices));
                }
            }
            for k in 0..40 {
                prop_assert_eq!(steps.next(), wrap.index((from + k) as f64, size));
            }
        }
    }
}
