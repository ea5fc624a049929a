//! The thesis's footprint: the bounding box of the texture coordinates of 3 x 3 neighbours (4.5.1,
//! fig. 4.4).
//!
//! A node sees the area between its eight neighbours if all of them hit the same textured area
//! along the same path ([`super::bundle`]). If one neighbour differs, the node sees a point. On a
//! mesh the textured area is a chart: [`crate::shape::charts`].

use super::{Bundle, Footprint, PointReason, Sight};
use crate::shape::Charts;
use crate::trace::tree::{Away, Branch, Child, IntersectionTree, Node};
use glam::DVec3;

/// Number of trees in a neighbourhood: 3 x 3.
pub const ALL: usize = 9;

/// Index of the middle tree.
const MIDDLE: usize = 4;

/// Position of each neighbour beside the middle, by its index.
const POSITIONS: [&str; ALL] = [
    "upper left",
    "upper",
    "upper right",
    "left",
    "middle",
    "right",
    "lower left",
    "lower",
    "lower right",
];

/// Nine trees that are walked in step.
#[derive(Debug, Clone, Copy)]
pub struct Neighbourhood<'a>(Bundle<'a, ALL>);

impl<'a> Neighbourhood<'a> {
    /// Starts at the roots of nine trees, given row by row. The middle tree is shaded.
    #[must_use]
    pub fn of(trees: [&'a IntersectionTree; ALL]) -> Self {
        Self::seen_by(trees, MIDDLE)
    }

    /// Starts at the roots of nine trees and shades the one with index `shaded`, less than nine.
    /// With it nine rays can all use the one footprint that they span together.
    #[must_use]
    pub fn seen_by(trees: [&'a IntersectionTree; ALL], shaded: usize) -> Self {
        Self(Bundle::of(trees, shaded))
    }
}

impl Sight for Neighbourhood<'_> {
    fn tree(&self) -> &IntersectionTree {
        self.0.tree()
    }

    fn branch(&self) -> Branch {
        self.0.branch()
    }

    fn step(&self, child: Child) -> Self {
        Self(self.0.step(child))
    }

    fn footprint(&self, node: &Node, charts: &Charts) -> Footprint {
        let (mut low, mut high) = (node.uv, node.uv);
        for k in 0..ALL {
            let Some(difference) = self.0.difference(k, node, charts) else {
                return Footprint::Point(node.uv);
            };
            let uv = node.uv + difference;
            low = low.min(uv);
            high = high.max(uv);
        }
        Footprint::Rectangle { center: 0.5 * (low + high), half: 0.5 * (high - low) }
    }

    /// The changes span the box around the directions of the neighbours, if all of them left the scene
    /// along the same path.
    fn away(&self) -> Option<Away> {
        let own = self.tree().away(self.branch())?;
        let to = |k: usize| self.0.away(k).map(|away| away.direction);
        let all = (0..ALL).all(|k| to(k).is_some());
        let [left, right, upper, lower] = [3, 5, 1, 7].map(|k| to(k).filter(|_| all));
        let change = |from: Option<DVec3>, to: Option<DVec3>| Some(to? - from?);
        let changes = change(left, right).zip(change(upper, lower)).map(|(x, y)| [x, y]);
        Some(Away { changes: own.changes.or(changes), ..own })
    }

    fn point_reason(&self, _: &Node) -> PointReason<'_> {
        self.0.stranger().map_or(PointReason::OtherChart, |(k, branch, node)| {
            PointReason::Stranger { position: POSITIONS[k], branch, node }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::footprint::Alone;
    use crate::ray::Piece;
    use glam::DVec2;

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
            pass_weight: DVec3::ZERO,
            inside: false,
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
        let alone = Alone::of(&trees[0]);
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
        let next = Neighbourhood::of(trees.each_ref()).step(Child::Reflected);
        assert_eq!(next.0.stranger().map(|(k, branch, _)| (k, branch)), Some((0, Branch::Cut)));
        assert_eq!(next.branch(), Branch::Background(0));
    }

    /// Shading one ray and shading nine rays differ only in the footprint.
    #[test]
    fn a_single_ray_walks_as_the_middle_of_nine() {
        let trees = grid(|_| 0, |x, y| DVec2::new(0.5 + 0.1 * x, 0.5 + 0.1 * y));
        let (nine, one) = (Neighbourhood::of(trees.each_ref()), Alone::of(&trees[MIDDLE]));
        assert_eq!((one.branch(), one.through()), (nine.branch(), nine.through()));
        let node = one.node().unwrap();
        assert_eq!(one.footprint(node, &Charts::default()), Footprint::Point(node.uv));
        let (center, _) = nine.footprint(node, &Charts::default()).bounds();
        assert!(center.abs_diff_eq(node.uv, 1e-15));
        for child in [Child::Reflected, Child::Refracted] {
            let (nine, one) = (nine.step(child), one.step(child));
            assert_eq!((one.branch(), one.away()), (nine.branch(), nine.away()));
            assert_eq!(one.step(child).branch(), Branch::Cut);
            assert_eq!(nine.step(child).branch(), Branch::Cut);
        }
    }
}
