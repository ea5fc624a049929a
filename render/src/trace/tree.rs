//! The intersection tree of one ray from the eye (thesis figs. 4.2 and 4.3).

use super::medium::Media;
use crate::color::Color;
use crate::differential::Spread;
use crate::ray::Piece;
use glam::{DVec2, DVec3};

/// Largest number of nodes in a tree. Further rays are cut.
///
/// Where many half transparent surfaces stand behind each other, each hit sends two rays and the
/// number of hits doubles with the depth. A larger limit makes such a scene run out of memory,
/// since each thread holds two hundred trees. A smaller limit cuts rays at the default depth of 12,
/// all of which this limit just holds. Rays are followed depth first, so a full tree lacks the rays
/// that the first surfaces let through.
pub const MOST_NODES: usize = (1 << 13) - 1;

/// All hits of one ray from the eye and of its reflected and refracted descendants.
///
/// The thesis links its nodes in lists: across for reflection and down for refraction. Here the
/// nodes lie in one array and refer to their children by index. A tree that is cleared and filled
/// again therefore allocates nothing.
#[derive(Debug, Clone, Default)]
pub struct IntersectionTree {
    /// Result of the ray from the eye.
    pub root: Branch,
    /// Transmittance from the eye to the root, linear RGB, [0, 1] per channel. It is below 1 where
    /// the eye is inside an absorbing volume.
    pub through: Color,
    nodes: Vec<Node>,
    /// Spreads of the nodes, by index; empty if the ray was traced without a differential.
    spreads: Vec<Spread>,
    /// The rays that left the scene.
    away: Vec<Away>,
    /// Media of the current ray while the tree is made; kept here for its allocation.
    pub(super) media: Media,
}

/// Result of following a ray.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Branch {
    /// The ray was not sent: the depth was reached, its weight was too small or the tree was full.
    #[default]
    Cut,
    /// The ray left the scene. The index selects one of the tree's directions; see
    /// [`IntersectionTree::away`].
    Background(u32),
    /// The ray hit a surface. The index selects one of the tree's nodes; see
    /// [`IntersectionTree::node`].
    Node(u32),
}

/// A ray that left the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Away {
    /// Unit direction of the ray.
    pub direction: DVec3,
    /// Change of the direction across and down the film, if the ray was traced with a differential.
    pub changes: Option<[DVec3; 2]>,
}

/// One of the two rays that continue a path at a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Child {
    /// The ray that the node mirrors.
    Reflected,
    /// The ray that passes through the node's surface.
    Refracted,
}

/// One hit, with only the data that shading needs.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// Object and triangle that the ray hit.
    pub piece: Piece,
    /// Index of the surface within the object. Object and surface together identify the textured
    /// area.
    pub part: u32,
    /// Point of the hit, in scene space.
    pub position: DVec3,
    /// Unit direction of the ray, pointing at the surface.
    pub incident: DVec3,
    /// The surface's own unit normal, on the side the ray came from.
    pub geometric_normal: DVec3,
    /// The unit normal to shade with, on the side the ray came from.
    pub normal: DVec3,
    /// Texture coordinates of the hit.
    pub uv: DVec2,
    /// Branch of the mirrored ray.
    pub reflected: Branch,
    /// Branch of the refracted ray.
    pub refracted: Branch,
    /// Weight of the mirrored ray's light per channel, including the transmittance along that ray.
    pub reflect_weight: Color,
    /// Weight of the refracted ray's light per channel, including the transmittance along that ray.
    pub refract_weight: Color,
    /// Weight of the same ray's light where the mask of the surface is transparent; 0 if the surface is
    /// opaque around the hit. Such a ray runs straight on, unless the surface refracts.
    pub pass_weight: Color,
    /// True if the ray met the surface from the inside of its volume.
    pub inside: bool,
}

impl Node {
    /// Returns the textured area that was hit: the object's index and the surface's index.
    #[must_use]
    pub fn area(&self) -> (u32, u32) {
        (self.piece.object, self.part)
    }

    /// Returns the branch of a child.
    #[must_use]
    pub fn child(&self, child: Child) -> Branch {
        match child {
            Child::Reflected => self.reflected,
            Child::Refracted => self.refracted,
        }
    }
}

impl IntersectionTree {
    /// Removes all hits and keeps the memory.
    pub fn clear(&mut self) {
        self.root = Branch::Cut;
        self.through = Color::ONE;
        self.nodes.clear();
        self.spreads.clear();
        self.away.clear();
    }

    /// Returns whether the tree has [`MOST_NODES`] nodes.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.nodes.len() >= MOST_NODES
    }

    /// Adds a node and returns its index.
    pub fn push(&mut self, node: Node) -> u32 {
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    /// Stores the spread of the node that was added last.
    pub fn push_spread(&mut self, spread: Spread) {
        self.spreads.push(spread);
    }

    /// Returns the spread of a branch's node, or `None` if the branch hit nothing or the ray was
    /// traced without a differential.
    #[must_use]
    pub fn spread(&self, branch: Branch) -> Option<&Spread> {
        match branch {
            Branch::Node(slot) => self.spreads.get(slot as usize),
            Branch::Cut | Branch::Background(_) => None,
        }
    }

    /// Returns the node of a branch, or `None` if the branch hit nothing.
    #[must_use]
    pub fn node(&self, branch: Branch) -> Option<&Node> {
        match branch {
            Branch::Node(slot) => self.nodes.get(slot as usize),
            Branch::Cut | Branch::Background(_) => None,
        }
    }

    /// Records a ray that left the scene and returns its branch.
    pub fn leave(&mut self, away: Away) -> Branch {
        self.away.push(away);
        Branch::Background(self.away.len() as u32 - 1)
    }

    /// Returns the ray with which a branch left the scene, or `None` if it did not.
    #[must_use]
    pub fn away(&self, branch: Branch) -> Option<Away> {
        match branch {
            Branch::Background(slot) => self.away.get(slot as usize).copied(),
            Branch::Cut | Branch::Node(_) => None,
        }
    }

    /// Returns the node with an index from [`IntersectionTree::push`].
    ///
    /// # Panics
    /// If there is no such node.
    pub fn node_mut(&mut self, slot: u32) -> &mut Node {
        &mut self.nodes[slot as usize]
    }
}
