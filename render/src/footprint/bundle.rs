//! Trees of several rays that are walked in step.
//!
//! Rays follow the same path if they are reflected and refracted in the same order at the same
//! objects. The thesis compares only the depths of reflection and refraction. Comparing the objects
//! as well distinguishes two mirrors that show the same floor.

use crate::shape::Charts;
use crate::trace::tree::{Away, Branch, Child, IntersectionTree, Node};
use glam::DVec2;

/// `N` trees, each with a current branch on the same path, and one of them that is shaded.
///
/// A tree agrees with the shaded one if the current nodes of both lie on the same textured area.
/// A tree that does not agree leaves the bundle at the next step.
#[derive(Debug, Clone, Copy)]
pub struct Bundle<'a, const N: usize> {
    trees: [&'a IntersectionTree; N],
    branches: [Branch; N],
    /// The current node of each tree that agrees with the shaded one.
    agreeing: [Option<&'a Node>; N],
    /// Index of the tree that is shaded.
    shaded: usize,
}

impl<'a, const N: usize> Bundle<'a, N> {
    /// Starts at the roots of the trees; `shaded` is the index of the tree that is shaded.
    #[must_use]
    pub fn of(trees: [&'a IntersectionTree; N], shaded: usize) -> Self {
        Self::at(trees, trees.map(|tree| tree.root), shaded)
    }

    fn at(trees: [&'a IntersectionTree; N], branches: [Branch; N], shaded: usize) -> Self {
        let mut agreeing = [None; N];
        if let Some(node) = trees[shaded].node(branches[shaded]) {
            for (k, agreeing) in agreeing.iter_mut().enumerate() {
                let other = trees[k].node(branches[k]);
                *agreeing = other.filter(|other| other.area() == node.area());
            }
        }
        Self { trees, branches, agreeing, shaded }
    }

    /// The tree that is shaded.
    #[must_use]
    pub fn tree(&self) -> &'a IntersectionTree {
        self.trees[self.shaded]
    }

    /// The current branch of the tree that is shaded.
    #[must_use]
    pub fn branch(&self) -> Branch {
        self.branches[self.shaded]
    }

    /// Returns the ray with which tree `k` left the scene at its current branch, if it did.
    #[must_use]
    pub fn away(&self, k: usize) -> Option<Away> {
        self.trees[k].away(self.branches[k])
    }

    /// Moves the trees that agree to a child of their nodes. The others are cut.
    #[must_use]
    pub fn step(&self, child: Child) -> Self {
        let next = |node: Option<&Node>| node.map_or(Branch::Cut, |node| node.child(child));
        Self::at(self.trees, self.agreeing.map(next), self.shaded)
    }

    /// Returns the difference between the texture coordinates of tree `k` and of `node`, the
    /// current node of the tree that is shaded. Returns `None` if tree `k` does not agree, or if no
    /// chart connects the two.
    #[must_use]
    pub fn difference(&self, k: usize, node: &Node, charts: &Charts) -> Option<DVec2> {
        let other = self.agreeing[k]?;
        charts.difference((node.piece.triangle, node.uv), (other.piece.triangle, other.uv))
    }

    /// Finds the first tree, by index, that does not agree. Returns its index, its current branch
    /// and the node of this branch, if any.
    #[must_use]
    pub fn stranger(&self) -> Option<(usize, Branch, Option<&'a Node>)> {
        let k = self.agreeing.iter().position(Option::is_none)?;
        Some((k, self.branches[k], self.trees[k].node(self.branches[k])))
    }
}
