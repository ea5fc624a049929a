//! The nodes of a tree as rays read them. Coordinates are those of a tree's [`super::frame::Frame`].

/// Number of boxes of a node.
pub const WIDTH: usize = 8;

/// A node or a leaf without its box, in one word.
///
/// The first bit is set for a leaf. The next five bits of a leaf state the longest side of its boxes, and
/// the others are the number of the node or leaf.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(transparent)]
pub struct Child(u32);

/// The first bit of a leaf.
const LEAF: u32 = 1 << 31;

/// Number of bits of a number.
const BITS: u32 = 26;

/// The exponent of 2 as the bits of an `f32` hold it.
const OF_TWO: u32 = 128;

impl Child {
    /// Numbers of nodes and leaves are below this one.
    pub const MOST: u32 = 1 << BITS;

    /// A child that no ray meets.
    pub const NONE: Self = Self(0);

    /// A node.
    #[must_use]
    pub fn node(number: usize) -> Self {
        debug_assert!(number < Self::MOST as usize);
        Self(number as u32)
    }

    /// A leaf with the longest side of its boxes, from 0 to 2. It is stored as the next power of two from
    /// 2^-30 on.
    #[must_use]
    pub fn leaf(number: usize, longest: f32) -> Self {
        debug_assert!(number < Self::MOST as usize && (0.0..=2.0).contains(&longest));
        // The exponent of the number, and one more if the number is no power of two.
        let exponent = (longest.to_bits() + 0x007f_ffff) >> 23;
        let below = OF_TWO.saturating_sub(exponent).min(31);
        Self(LEAF | below << BITS | number as u32)
    }

    /// Returns the child with this word.
    #[must_use]
    #[inline(always)]
    pub fn of_word(word: u32) -> Self {
        Self(word)
    }

    /// The word.
    #[must_use]
    #[inline(always)]
    pub fn word(self) -> u32 {
        self.0
    }

    /// The number of the node or of the leaf.
    #[must_use]
    #[inline(always)]
    pub fn number(self) -> usize {
        (self.0 & (Self::MOST - 1)) as usize
    }

    /// A bound on the longest side of the boxes in a leaf, in units of the tree: a power of two.
    #[must_use]
    #[inline(always)]
    pub fn longest(self) -> f32 {
        f32::from_bits((OF_TWO - (self.0 >> BITS & 31)) << 23)
    }

    /// Returns whether the child is a leaf.
    #[must_use]
    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.0 >= LEAF
    }
}

/// The children of a node, and their boxes.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(32))]
pub struct Node {
    /// Along each axis the lower sides of all boxes, then the upper ones. An unused box has its
    /// lower sides at infinity and its upper sides at minus infinity, so that no ray crosses it.
    pub sides: [[[f32; WIDTH]; 2]; 3],
    /// The children.
    pub children: [Child; WIDTH],
}

impl Node {
    /// A node without children.
    pub const EMPTY: Self = Self {
        sides: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
        children: [Child::NONE; WIDTH],
    };

    /// Sets the box of a child.
    pub fn put(&mut self, child: usize, low: [f32; 3], high: [f32; 3]) {
        for axis in 0..3 {
            self.sides[axis][0][child] = low[axis];
            self.sides[axis][1][child] = high[axis];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The bound of a leaf is less than twice the longest side, and never below it.
        #[test]
        fn a_leaf_keeps_its_number_and_a_bound(
            number in 0..Child::MOST, longest in prop_oneof![0.0..=2.0f32, Just(1.0f32), 0.0..1e-5f32],
        ) {
            let leaf = Child::leaf(number as usize, longest);
            prop_assert!(leaf.is_leaf());
            prop_assert_eq!(leaf.number(), number as usize);
            prop_assert!(leaf.longest() >= longest && leaf.longest() < (2.0 * longest).max(2e-9));
            let node = Child::node(number as usize);
            prop_assert!(!node.is_leaf());
            prop_assert_eq!(node.number(), number as usize);
        }
    }
}
