//! The nodes of a tree as rays read them. Coordinates are those of a tree's [`super::frame::Frame`].

/// Number of boxes of a node.
pub const WIDTH: usize = 8;

/// A node or a leaf without its box.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct Child {
    /// Number of the node or of the leaf.
    pub first: u32,
    /// The longest side of the boxes in a leaf, in units of the tree; -1 for a node.
    pub longest: f32,
}

impl Child {
    /// A child that no ray meets.
    pub const NONE: Self = Self { first: 0, longest: -1.0 };

    /// A node.
    #[must_use]
    pub fn node(number: usize) -> Self {
        Self { first: number as u32, longest: -1.0 }
    }

    /// A leaf with the longest side of its boxes.
    #[must_use]
    pub fn leaf(number: usize, longest: f32) -> Self {
        Self { first: number as u32, longest }
    }

    /// Whether the child is a leaf.
    #[must_use]
    #[inline]
    pub fn is_leaf(&self) -> bool {
        self.longest >= 0.0
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
