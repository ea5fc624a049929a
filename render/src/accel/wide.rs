//! Collapses a binary tree of boxes into one whose nodes have up to four children.
//!
//! A ray tests the four boxes of a node at once. This costs little more than a test of two boxes,
//! and replaces up to three such tests. Dammertz, Hanika, Keller: *Shallow Bounding Volume
//! Hierarchies for Fast SIMD Ray Tracing of Incoherent Rays*, Computer Graphics Forum 27(4), 2008.

use super::build::Bounds;
use glam::{Vec3A, Vec4};

/// Number of boxes in a group.
pub const WIDTH: usize = 4;

/// Two siblings of the binary tree.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    /// Boxes of both siblings.
    pub bounds: [Bounds; 2],
    /// Both siblings, without their boxes.
    pub children: [Child; 2],
}

/// A node without its box.
#[derive(Debug, Clone, Copy, Default)]
pub struct Child {
    /// Index of its first box, or of its group of children.
    pub first: u32,
    /// Number of its boxes; 0 if the node has children.
    pub count: u32,
}

/// The children of a node, and their boxes.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// Along each axis the lower sides of all boxes, then the upper ones. An unused box has its
    /// lower sides at infinity and its upper sides at minus infinity, so that no ray crosses it.
    pub sides: [[Vec4; 2]; 3],
    /// The children.
    pub children: [Child; WIDTH],
}

/// A group under construction: its children and their boxes.
struct Members {
    members: [(Child, Bounds); WIDTH],
    count: usize,
}

impl Members {
    /// Starts with a pair. Replaces the largest child that is no leaf by its own two children,
    /// until the group is full.
    fn of(pair: &Pair, pairs: &[Pair]) -> Self {
        let nothing = Bounds { low: Vec3A::INFINITY, high: Vec3A::NEG_INFINITY };
        let mut group = Self { members: [(Child::default(), nothing); WIDTH], count: 0 };
        group.put(0, pair, 0);
        group.put(1, pair, 1);
        while group.count < WIDTH
            && let Some(at) = group.largest()
        {
            let pair = &pairs[group.members[at].0.first as usize];
            group.put(at, pair, 0);
            group.put(group.count, pair, 1);
        }
        group
    }

    fn put(&mut self, at: usize, pair: &Pair, side: usize) {
        self.members[at] = (pair.children[side], pair.bounds[side]);
        self.count = self.count.max(at + 1);
    }

    /// Returns the index of the child with the largest box that is no leaf.
    fn largest(&self) -> Option<usize> {
        let area = |k: &usize| self.members[*k].1.half_area();
        let inner = (0..self.count).filter(|&k| self.members[k].0.count == 0);
        inner.max_by(|a, b| area(a).total_cmp(&area(b)))
    }

    fn group(&self) -> Group {
        let sides = [0, 1, 2].map(|axis| {
            let low = self.members.map(|(_, bounds)| bounds.low[axis]);
            let high = self.members.map(|(_, bounds)| bounds.high[axis]);
            [Vec4::from_array(low), Vec4::from_array(high)]
        });
        Group { sides, children: self.members.map(|(child, _)| child) }
    }
}

/// Returns the root and the groups of a binary tree, parents first. Leaves stay as they are.
#[must_use]
pub fn collapsed(root: Child, pairs: &[Pair]) -> (Child, Vec<Group>) {
    let mut groups: Vec<Group> = Vec::new();
    if root.count > 0 {
        return (root, groups);
    }
    // Pairs that are not grouped yet, each with the group and the child that lead to it.
    let mut open: Vec<(u32, Option<(usize, usize)>)> = vec![(root.first, None)];
    while let Some((pair, parent)) = open.pop() {
        let members = Members::of(&pairs[pair as usize], pairs);
        let number = groups.len();
        if let Some((group, child)) = parent {
            groups[group].children[child].first = number as u32;
        }
        // The first child is grouped next and therefore lies beside its parent.
        for k in (0..members.count).rev() {
            let (child, _) = members.members[k];
            if child.count == 0 {
                open.push((child.first, Some((number, k))));
            }
        }
        groups.push(members.group());
    }
    (Child { first: 0, count: 0 }, groups)
}
