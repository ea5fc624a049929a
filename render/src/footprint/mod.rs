//! The part of a texture that a pixel sees.
//!
//! A [`Footprint`] separates tracing from texture filtering. Tracing knows nothing of textures, and
//! filtering knows nothing of rays. A filter averages a texture over the footprint.
//!
//! A [`Sight`] separates sampling from shading. Shading asks a sight for the current node, its
//! children and its footprint, and does not know how many rays determine the footprint:
//!
//! | sight | rays | footprint |
//! |---|---|---|
//! | [`Neighbourhood`] | 3 x 3 neighbours, the thesis's method | the box around nine points |
//! | [`Alone`] | one | a point |
//! | [`Beam`] | one, with its differential | a parallelogram |
//!
//! Another sampling method adds a file to this module and, if it needs a new shape, a variant of
//! [`Footprint`]. [`Bundle`] walks any number of trees in step and serves as its base.

pub mod alone;
pub mod beam;
pub mod bundle;
pub mod neighbours;

pub use alone::Alone;
pub use beam::Beam;
pub use bundle::Bundle;
pub use neighbours::Neighbourhood;

use crate::color::Color;
use crate::differential::Spread;
use crate::shape::Charts;
use crate::trace::tree::{Away, Branch, Child, IntersectionTree, Node};
use glam::{DVec2, DVec3};

/// A part of a texture, in texture coordinates. A texture fills the unit square, with `x` across
/// and `y` up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Footprint {
    /// One point. A filter still smooths the texture by the filter's smallest width.
    Point(DVec2),
    /// An axis-parallel rectangle.
    Rectangle {
        /// Middle of the rectangle.
        center: DVec2,
        /// Half the width and half the height of the rectangle, 0 or more.
        half: DVec2,
    },
    /// A convex quadrilateral with these corners, in order around it.
    Quadrilateral([DVec2; 4]),
    /// A parallelogram.
    Parallelogram {
        /// Middle of the parallelogram.
        center: DVec2,
        /// Two sides that meet at a corner. They may be parallel, or zero.
        sides: [DVec2; 2],
    },
}

impl Footprint {
    /// Returns the middle of the bounding rectangle, and half its width and height. Both halves are
    /// 0 for a point.
    #[must_use]
    pub fn bounds(&self) -> (DVec2, DVec2) {
        match *self {
            Self::Point(at) => (at, DVec2::ZERO),
            Self::Rectangle { center, half } => (center, half),
            Self::Quadrilateral([a, b, c, d]) => {
                let (low, high) = (a.min(b).min(c.min(d)), a.max(b).max(c.max(d)));
                (0.5 * (low + high), 0.5 * (high - low))
            }
            Self::Parallelogram { center, sides: [a, b] } => (center, 0.5 * (a.abs() + b.abs())),
        }
    }

    /// Returns the footprint, moved so that its bounding rectangle has this middle.
    #[must_use]
    pub fn centered_at(self, center: DVec2) -> Self {
        match self {
            Self::Point(_) => Self::Point(center),
            Self::Rectangle { half, .. } => Self::Rectangle { center, half },
            Self::Quadrilateral(corners) => {
                let (before, _) = self.bounds();
                Self::Quadrilateral(corners.map(|corner| corner + (center - before)))
            }
            Self::Parallelogram { sides, .. } => Self::Parallelogram { center, sides },
        }
    }

    /// Returns whether the footprint is a single point.
    #[must_use]
    pub fn is_point(&self) -> bool {
        match self {
            Self::Point(_) => true,
            Self::Rectangle { .. } | Self::Quadrilateral(_) | Self::Parallelogram { .. } => false,
        }
    }
}

/// One branch of an intersection tree as shading sees it, with the rays near it that determine
/// footprints.
///
/// A sight starts at the root of its tree. [`Sight::step`] leads to a child; the rays nearby then
/// move to the same child, as long as they follow the same path.
///
/// A new sight provides the tree, the current branch, the step, the footprint and the reason for a
/// footprint without area. The footprint may not depend on the tile or the thread.
pub trait Sight: Copy {
    /// The tree that is shaded.
    fn tree(&self) -> &IntersectionTree;

    /// The current branch of the tree that is shaded.
    fn branch(&self) -> Branch;

    /// Moves to a child of the current node. The branch is [`Branch::Cut`] where there is no node.
    #[must_use]
    fn step(&self, child: Child) -> Self;

    /// Returns the part of its texture that `node` sees. `node` is the current node, and `charts`
    /// are the charts of its shape.
    fn footprint(&self, node: &Node, charts: &Charts) -> Footprint;

    /// Returns the reason for which the footprint of `node`, the current node, is a point. The
    /// result means nothing if the footprint has an area.
    fn point_reason(&self, node: &Node) -> PointReason<'_>;

    /// Returns how the current node changes across and down the part of the film that the sight
    /// stands for; `None` if the sampling method does not tell. Solid textures and highlights are
    /// averaged with it.
    fn spread(&self) -> Option<&Spread> {
        None
    }

    /// Returns the point of the surface in the middle of that part of the film, for `node`, the current
    /// node. The ray may lie beside the middle.
    fn middle(&self, node: &Node) -> DVec3 {
        node.position
    }

    /// Transmittance from the eye to the root, linear RGB, [0, 1] per channel.
    fn through(&self) -> Color {
        self.tree().through
    }

    /// The node of the current branch, if the branch hit a surface.
    fn node(&self) -> Option<&Node> {
        self.tree().node(self.branch())
    }

    /// The ray with which the current branch left the scene, if it did.
    fn away(&self) -> Option<Away> {
        self.tree().away(self.branch())
    }
}

/// The reason for which a node sees a point of its texture and no area.
#[derive(Debug, Clone, Copy)]
pub enum PointReason<'a> {
    /// No rays are compared, since the filter averages over points.
    Alone,
    /// A ray nearby does not hit the same textured area along the same path.
    Stranger {
        /// Position of the ray beside the one that is shaded, such as "upper left".
        position: &'static str,
        /// Current branch of the ray's tree. It is [`Branch::Cut`] if the ray left the common path
        /// before.
        branch: Branch,
        /// The node of this branch, if any.
        node: Option<&'a Node>,
    },
    /// The ray has no derivative, because it meets a surface edge on or at the critical angle.
    NoDerivative,
    /// All rays hit the same textured area, but not the same chart of its texture coordinates.
    OtherChart,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadrilateral_has_the_bounds_of_its_corners_and_moves_with_them() {
        let corners = [[0.0, 1.0], [2.0, 0.0], [3.0, 2.0], [1.0, 4.0]].map(DVec2::from);
        let quadrilateral = Footprint::Quadrilateral(corners);
        assert_eq!(quadrilateral.bounds(), (DVec2::new(1.5, 2.0), DVec2::new(1.5, 2.0)));
        let moved = quadrilateral.centered_at(DVec2::new(2.5, 1.5));
        let expected = corners.map(|corner| corner + DVec2::new(1.0, -0.5));
        assert_eq!(moved, Footprint::Quadrilateral(expected));
        assert!(!moved.is_point());
    }

    #[test]
    fn a_point_has_no_size() {
        let at = DVec2::new(0.25, 0.5);
        assert_eq!(Footprint::Point(at).bounds(), (at, DVec2::ZERO));
        let rectangle = Footprint::Rectangle { center: DVec2::ONE, half: at };
        assert_eq!(rectangle.centered_at(at), Footprint::Rectangle { center: at, half: at });
    }
}
