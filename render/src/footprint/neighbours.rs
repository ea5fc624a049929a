//! The thesis's footprint: the bounding box of the texture coordinates of 3 x 3 neighbours (4.5.1,
//! fig. 4.4).
//!
//! A node sees the area between its eight neighbours if all of them hit the same textured area
//! along the same path. Paths are the same if they are reflected and refracted in the same order at
//! the same objects. If one neighbour differs, the node sees a point. On a mesh the textured area
//! is a chart: [`crate::shape::charts`].
//!
//! The thesis compares only the depths of reflection and refraction. Comparing the objects on the
//! path as well distinguishes two mirrors that show the same floor.

use super::Footprint;
use crate::shape::Charts;
use crate::trace::tree::{Branch, IntersectionTree, Node};
use glam::{DVec2, DVec3};

/// Number of trees in a neighbourhood: 3 x 3.
pub const ALL: usize = 9;

/// Index of the middle tree.
const MIDDLE: usize = 4;

/// Nine trees that are walked in step. Each tree has a current branch that corresponds to the
/// branch of the middle tree.
#[derive(Debug, Clone, Copy)]
pub struct Neighbourhood<'a> {
    trees: [&'a IntersectionTree; ALL],
    branches: [Branch; ALL],
    /// Index of the tree that is shaded: the middle tree, unless [`Neighbourhood::seen_by`] chose
    /// another one.
    middle: usize,
}

impl<'a> Neighbourhood<'a> {
    /// Starts at the roots of nine trees, given row by row.
    #[must_use]
    pub fn of(trees: [&'a IntersectionTree; ALL]) -> Self {
        Self { trees, branches: trees.map(|tree| tree.root), middle: MIDDLE }
    }

    /// Shades the tree with index `shaded` instead of the middle one and keeps the nine trees. With
    /// it nine rays can all use the one footprint that they span together.
    #[must_use]
    pub fn seen_by(self, shaded: usize) -> Self {
        Self { middle: shaded, ..self }
    }

    /// A tree without neighbours. Every node of the tree sees a point.
    #[must_use]
    pub fn alone(tree: &'a IntersectionTree) -> Self {
        let mut branches = [Branch::Cut; ALL];
        branches[MIDDLE] = tree.root;
        Self { trees: [tree; ALL], branches, middle: MIDDLE }
    }

    /// Current branch of the tree that is shaded.
    #[must_use]
    pub fn middle(&self) -> Branch {
        self.branches[self.middle]
    }

    /// Transmittance from the eye to the root of the tree that is shaded, linear RGB, [0, 1] per
    /// channel.
    #[must_use]
    pub fn through(&self) -> DVec3 {
        self.trees[self.middle].through
    }

    /// Node of the current branch of the tree that is shaded, if this branch hit a surface.
    #[must_use]
    pub fn node(&self) -> Option<&'a Node> {
        self.trees[self.middle].node(self.middle())
    }

    /// Unit direction in which the current branch of the tree that is shaded left the scene, if it
    /// did.
    #[must_use]
    pub fn away(&self) -> Option<DVec3> {
        self.trees[self.middle].away(self.middle())
    }

    /// Moves all trees to the branch that `child` selects. Trees whose current node lies on another
    /// textured area are cut.
    #[must_use]
    pub fn step(&self, child: impl Fn(&Node) -> Branch) -> Self {
        let area = self.node().map(Node::area);
        let mut branches = [Branch::Cut; ALL];
        for (k, branch) in branches.iter_mut().enumerate() {
            let node = self.trees[k].node(self.branches[k]);
            if let Some(node) = node.filter(|node| Some(node.area()) == area) {
                *branch = child(node);
            }
        }
        Self { branches, ..*self }
    }

    /// Node of the tree with index `k`, if this node lies on the same textured area as `node`.
    fn agreeing(&self, k: usize, node: &Node) -> Option<&'a Node> {
        self.trees[k].node(self.branches[k]).filter(|other| other.area() == node.area())
    }

    /// Finds the first tree, by index, that does not agree with `node`. Returns its index, its
    /// current branch and the node of this branch, if any. The branch is [`Branch::Cut`] if the
    /// tree left the common path before.
    #[must_use]
    pub fn stranger(&self, node: &Node) -> Option<(usize, Branch, Option<&'a Node>)> {
        let k = (0..ALL).find(|&k| self.agreeing(k, node).is_none())?;
        Some((k, self.branches[k], self.trees[k].node(self.branches[k])))
    }

    /// Returns the footprint of `node`, the node of the tree that is shaded. `charts` are the
    /// charts of the node's shape.
    #[must_use]
    pub fn footprint(&self, node: &Node, charts: &Charts) -> Footprint {
        let (mut low, mut high) = (node.uv, node.uv);
        for k in 0..ALL {
            let other = self.agreeing(k, node);
            let Some(way) = other.and_then(|other| way(charts, node, other)) else {
                return Footprint::Point(node.uv);
            };
            let uv = node.uv + way;
            low = low.min(uv);
            high = high.max(uv);
        }
        Footprint::Rectangle { center: 0.5 * (low + high), half: 0.5 * (high - low) }
    }
}

/// Difference of the texture coordinates of `to` and `from`, two nodes on the same area, if their
/// charts connect them.
fn way(charts: &Charts, from: &Node, to: &Node) -> Option<DVec2> {
    let [from, to] = [from, to].map(|node| (node.piece.triangle, node.uv));
    charts.difference(from, to)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::Piece;

    fn tree(object: u32, uv: DVec2) -> IntersectionTree {
        let mut tree = IntersectionTree::default();
        let slot = tree.push(Node {
            piece: Piece { object, triangle: 0 },
            part: 0,
            position: DVec3::ZERO,
            incident: DVec3::NEG_Z,
            geometric_normal: DVec3::Z,
            normal: DVec3::Z,
            uv,
            reflected: Branch::Background(0),
            refracted: Branch::Cut,
            reflect_weight: DVec3::ZERO,
            refract_weight: DVec3::ZERO,
        });
        tree.root = Branch::Node(slot);
        tree
    }

    fn grid(
        object: impl Fn(usize) -> u32,
        uv: impl Fn(f64, f64) -> DVec2,
    ) -> [IntersectionTree; 9] {
        std::array::from_fn(|k| tree(object(k), uv((k % 3) as f64 - 1.0, (k / 3) as f64 - 1.0)))
    }

    fn footprint(trees: &[IntersectionTree; 9], seam: DVec2) -> Footprint {
        let around = Neighbourhood::of(trees.each_ref());
        around.footprint(around.node().unwrap(), &Charts::one(seam))
    }

    #[test]
    fn agreeing_neighbours_give_their_box() {
        let trees = grid(|_| 0, |x, y| DVec2::new(0.5 + 0.1 * x, 0.5 + 0.2 * y * y));
        let Footprint::Rectangle { center, half } = footprint(&trees, DVec2::ZERO) else {
            panic!("all neighbours agree")
        };
        assert!(center.abs_diff_eq(DVec2::new(0.5, 0.6), 1e-15));
        assert!(half.abs_diff_eq(DVec2::new(0.1, 0.1), 1e-15));
    }

    #[test]
    fn one_neighbour_elsewhere_makes_it_a_point() {
        let trees = grid(|k| u32::from(k == 7), |x, _| DVec2::new(x, 0.0));
        assert_eq!(footprint(&trees, DVec2::ZERO), Footprint::Point(DVec2::ZERO));
        let alone = Neighbourhood::alone(&trees[0]);
        let at = DVec2::new(-1.0, 0.0);
        assert_eq!(
            alone.footprint(alone.node().unwrap(), &Charts::default()),
            Footprint::Point(at)
        );
    }

    #[test]
    fn a_seam_is_crossed_the_short_way() {
        let trees = grid(|_| 0, |x, _| DVec2::new((1.0 + 0.02 * x) % 1.0, 0.5));
        let Footprint::Rectangle { half, .. } = footprint(&trees, DVec2::new(1.0, 0.0)) else {
            panic!("all neighbours agree")
        };
        assert!((half.x - 0.02).abs() < 1e-12, "{half}");
    }

    #[test]
    fn a_step_leaves_others_behind() {
        let trees = grid(|k| u32::from(k == 0), |_, _| DVec2::ZERO);
        let next = Neighbourhood::of(trees.each_ref()).step(|node| node.reflected);
        assert_eq!(next.branches[0], Branch::Cut);
        assert_eq!(next.middle(), Branch::Background(0));
    }
}
