//! The sight of a single ray that was traced with its differential.

use super::{Footprint, PointReason, Sight};
use crate::differential::Spread;
use crate::shape::Charts;
use crate::trace::tree::{Branch, Child, IntersectionTree, Node};
use glam::{DVec2, DVec3};

/// A tree whose nodes have spreads. Every node sees the parallelogram that its spread spans on the
/// texture.
#[derive(Debug, Clone, Copy)]
pub struct Beam<'a> {
    tree: &'a IntersectionTree,
    branch: Branch,
    /// Position of the ray in its cell of the film, from the middle, in units of the cell.
    offset: DVec2,
}

impl<'a> Beam<'a> {
    /// Starts at the root of a tree. `offset` is the position of the tree's ray in its cell of the
    /// film, from the middle of the cell and in units of its sides. Footprints are those of the
    /// middle.
    #[must_use]
    pub fn of(tree: &'a IntersectionTree, offset: DVec2) -> Self {
        Self { tree, branch: tree.root, offset }
    }
}

impl Sight for Beam<'_> {
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
        match self.spread() {
            Some(&Spread { uv: sides, .. }) if sides.iter().all(|side| !side.is_nan()) => {
                let center = node.uv - self.offset.x * sides[0] - self.offset.y * sides[1];
                Footprint::Parallelogram { center, sides }
            }
            Some(_) | None => Footprint::Point(node.uv),
        }
    }

    fn point_reason(&self, _: &Node) -> PointReason<'_> {
        PointReason::NoDerivative
    }

    fn spread(&self) -> Option<&Spread> {
        self.tree.spread(self.branch)
    }

    fn middle(&self, node: &Node) -> DVec3 {
        let Some(Spread { position: [across, down], .. }) = self.spread() else {
            return node.position;
        };
        let middle = node.position - self.offset.x * *across - self.offset.y * *down;
        if middle.is_finite() { middle } else { node.position }
    }
}
