//! The nodes of a tree as rays read them. Coordinates are those of a tree's [`super::frame::Frame`].

/// Number of boxes of a node.
pub const WIDTH: usize = 8;

/// A node or a leaf without its box, in one word.
///
/// The lower half is the number of the node or leaf. The upper half holds the bits of the longest side
/// of a leaf's boxes, in units of the tree, or of -1 for a node.
#[derive(Debug, Clone, Copy)]
pub struct Child(u64);

impl Child {
    /// A child that no ray meets.
    pub const NONE: Self = Self::new(0, -1.0);

    const fn new(number: u32, longest: f32) -> Self {
        Self(number as u64 | (longest.to_bits() as u64) << 32)
    }

    /// A node.
    #[must_use]
    pub fn node(number: usize) -> Self {
        Self::new(number as u32, -1.0)
    }

    /// A leaf with the longest side of its boxes, at least 0.
    #[must_use]
    pub fn leaf(number: usize, longest: f32) -> Self {
        Self::new(number as u32, longest)
    }

    /// The number of the node or of the leaf.
    #[must_use]
    #[inline(always)]
    pub fn number(self) -> usize {
        self.0 as u32 as usize
    }

    /// The longest side of the boxes in a leaf, in units of the tree.
    #[must_use]
    #[inline(always)]
    pub fn longest(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    /// Returns whether the child is a leaf: the sign of the longest side is the first bit.
    #[must_use]
    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.0 >> 63 == 0
    }
}

/// The children of a node, and their boxes.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
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
