//! The sight of a single ray, for filters that average over points.

use super::{Footprint, PointReason, Sight};
use crate::shape::Charts;
use crate::trace::tree::{Branch, Child, IntersectionTree, Node};

/// A tree without neighbours. Every node of the tree sees a point.
#[derive(Debug, Clone, Copy)]
pub struct Alone<'a> {
    tree: &'a IntersectionTree,
    branch: Branch,
}

impl<'a> Alone<'a> {
    /// Starts at the root of a tree.
    #[must_use]
    pub fn of(tree: &'a IntersectionTree) -> Self {
        Self { tree, branch: tree.root }
    }
}

impl Sight for Alone<'_> {
    fn tree(&self) -> &IntersectionTree {
        self.tree
    }

    fn branch(&self) -> Branch {
        self.branch
    }

    fn step(&self, child: Child) -> Self {
        let branch = self.node().map_or(Branch::Cut, |node| node.child(child));
        Self { branch, ..*self }
    }

    fn footprint(&self, node: &Node, _: &Charts) -> Footprint {
        Footprint::Point(node.uv)
    }

    fn point_reason(&self, _: &Node) -> PointReason<'_> {
        PointReason::Alone
    }
}
