//! The intersection tree of one ray from the eye (thesis figs. 4.2 and 4.3).

use super::medium::Media;
use crate::color::Color;
use crate::ray::Piece;
use glam::{DVec2, DVec3};

/// A tree has at most so many nodes; rays that would lead to more are cut.
///
/// Where many half transparent surfaces stand behind each other, each hit sends two rays and the
/// number of hits doubles with the depth. Larger, and such a scene ends for want of memory, since
/// each thread holds two hundred trees; this many hold every ray of a depth of 12, the default.
/// Rays are followed depth first, so what a full tree lacks is what the first surfaces let through.
pub const MOST_NODES: usize = (1 << 13) - 1;

/// All hits of one ray from the eye and of the rays that follow from it.
///
/// The thesis links its nodes in lists, across for reflection and down for refraction; here they
/// lie in one array and name their children by index, so a tree that is cleared and filled again
/// allocates nothing.
#[derive(Debug, Clone, Default)]
pub struct IntersectionTree {
    /// What the ray from the eye came to.
    pub root: Branch,
    /// What the way from the eye to there leaves of the light; less than 1 where the eye is in
    /// something that absorbs it.
    pub through: Color,
    nodes: Vec<Node>,
    /// Where to those rays went that left the scene, unit.
    away: Vec<DVec3>,
    /// Room for what rays are in while the tree is made.
    pub(super) media: Media,
}

/// What became of a ray.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Branch {
    /// It was not sent: too deep, or it would count for too little, or the tree was full.
    #[default]
    Cut,
    /// It left the scene: an index into the directions in which rays of the tree did.
    Background(u32),
    /// It hit something: an index into the tree's nodes.
    Node(u32),
}

/// One hit: what shading needs and no more.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// What was hit.
    pub piece: Piece,
    /// Which of the object's surfaces; with the object it is the textured area.
    pub part: u32,
    /// Where.
    pub position: DVec3,
    /// Direction of the ray, unit, pointing at the surface.
    pub incident: DVec3,
    /// The surface's own unit normal, on the side the ray came from.
    pub geometric_normal: DVec3,
    /// The unit normal to shade with, on the side the ray came from.
    pub normal: DVec3,
    /// Texture coordinates.
    pub uv: DVec2,
    /// What the mirrored ray came to.
    pub reflected: Branch,
    /// What the refracted ray came to.
    pub refracted: Branch,
    /// What the mirrored ray's light counts for in each channel, after what it lost on its way.
    pub reflect_weight: Color,
    /// What the refracted ray's light counts for, likewise.
    pub refract_weight: Color,
}

impl Node {
    /// The textured area that was hit: object and surface.
    #[must_use]
    pub fn area(&self) -> (u32, u32) {
        (self.piece.object, self.part)
    }
}

impl IntersectionTree {
    /// Forgets all hits and keeps the memory.
    pub fn clear(&mut self) {
        self.root = Branch::Cut;
        self.through = Color::ONE;
        self.nodes.clear();
        self.away.clear();
    }

    /// Whether it has [`MOST_NODES`] nodes.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.nodes.len() >= MOST_NODES
    }

    /// Adds a node and gives its index.
    pub fn push(&mut self, node: Node) -> u32 {
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    /// The node that a branch came to.
    #[must_use]
    pub fn node(&self, branch: Branch) -> Option<&Node> {
        match branch {
            Branch::Node(slot) => self.nodes.get(slot as usize),
            Branch::Cut | Branch::Background(_) => None,
        }
    }

    /// Adds a ray that left the scene in a direction, unit.
    pub fn leave(&mut self, direction: DVec3) -> Branch {
        self.away.push(direction);
        Branch::Background(self.away.len() as u32 - 1)
    }

    /// The direction in which a branch left the scene.
    #[must_use]
    pub fn away(&self, branch: Branch) -> Option<DVec3> {
        match branch {
            Branch::Background(slot) => self.away.get(slot as usize).copied(),
            Branch::Cut | Branch::Node(_) => None,
        }
    }

    /// The node with an index that [`IntersectionTree::push`] gave.
    pub fn node_mut(&mut self, slot: u32) -> &mut Node {
        &mut self.nodes[slot as usize]
    }
}
