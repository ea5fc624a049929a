//! The thesis's footprint: the box around the texture coordinates of 3 x 3 neighbours (4.5.1, fig.
//! 4.4).
//!
//! A node sees the area between its eight neighbours if all of them came to the same textured area
//! by the same path: reflected and refracted in the same order, at the same objects. If one did
//! not, the node sees a point.
//!
//! The thesis asks for the same depths of reflection and refraction; asking for the same objects on
//! the way as well tells apart two mirrors that show one floor.

use super::Footprint;
use crate::shape::SeamPeriod;
use crate::trace::tree::{Branch, IntersectionTree, Node};
use glam::{DVec2, DVec3};

/// How many trees are looked at: the middle one has index 4.
const ALL: usize = 9;
const MIDDLE: usize = 4;

/// Nine trees walked in step: for each, the branch of it that corresponds to the middle one's.
#[derive(Debug, Clone, Copy)]
pub struct Neighbourhood<'a> {
    trees: [&'a IntersectionTree; ALL],
    branches: [Branch; ALL],
}

impl<'a> Neighbourhood<'a> {
    /// The roots of nine trees, row by row.
    #[must_use]
    pub fn of(trees: [&'a IntersectionTree; ALL]) -> Self {
        Self { trees, branches: trees.map(|tree| tree.root) }
    }

    /// A tree without neighbours: every node sees a point.
    #[must_use]
    pub fn alone(tree: &'a IntersectionTree) -> Self {
        let mut branches = [Branch::Cut; ALL];
        branches[MIDDLE] = tree.root;
        Self { trees: [tree; ALL], branches }
    }

    /// What the middle tree's branch came to.
    #[must_use]
    pub fn middle(&self) -> Branch {
        self.branches[MIDDLE]
    }

    /// What the way from the eye to the middle tree's root leaves of the light.
    #[must_use]
    pub fn through(&self) -> DVec3 {
        self.trees[MIDDLE].through
    }

    /// The middle tree's node, if its branch came to one.
    #[must_use]
    pub fn node(&self) -> Option<&'a Node> {
        self.trees[MIDDLE].node(self.middle())
    }

    /// One step along all trees; neighbours that are on another path are left behind.
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
        Self { trees: self.trees, branches }
    }

    /// What the middle node sees of its texture; `seam` is the period of its shape's coordinates.
    #[must_use]
    pub fn footprint(&self, node: &Node, seam: SeamPeriod) -> Footprint {
        let (mut low, mut high) = (node.uv, node.uv);
        for k in 0..ALL {
            let Some(other) = self.trees[k].node(self.branches[k]) else {
                return Footprint::Point(node.uv);
            };
            if other.area() != node.area() {
                return Footprint::Point(node.uv);
            }
            let uv = node.uv + unwrapped(other.uv - node.uv, seam);
            low = low.min(uv);
            high = high.max(uv);
        }
        Footprint::Rectangle { center: 0.5 * (low + high), half: 0.5 * (high - low) }
    }
}

/// The difference of two texture coordinates of one closed surface, taken the short way round.
fn unwrapped(difference: DVec2, seam: SeamPeriod) -> DVec2 {
    let short =
        |d: f64, period: f64| if period > 0.0 { d - period * (d / period).round() } else { d };
    DVec2::new(short(difference.x, seam.x), short(difference.y, seam.y))
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
            reflected: Branch::Background,
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
        around.footprint(around.node().unwrap(), seam)
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
        assert_eq!(alone.footprint(alone.node().unwrap(), DVec2::ZERO), Footprint::Point(at));
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
        assert_eq!(next.middle(), Branch::Background);
    }
}
