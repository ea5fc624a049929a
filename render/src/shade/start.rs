//! The start of the shadow rays of a node.

use crate::differential::Spread;
use crate::ray::Piece;
use crate::scene::Scene;
use crate::trace::tree::Node;
use glam::DVec3;

/// The start of the shadow rays of a node.
///
/// On a mesh with interpolated normals it lies on the smooth surface that the normals stand for. A facet
/// that only its plane turns from the light would otherwise shade itself, and the edge of light would
/// be a staircase of facets.
#[derive(Debug, Clone, Copy)]
pub struct ShadowStart {
    /// The piece of surface that the rays leave.
    pub piece: Piece,
    /// Start of the rays, in scene space.
    pub position: DVec3,
    /// Unit normal of the smooth surface, without bumps. Only lights on its side shine on the node.
    pub normal: DVec3,
    /// Change of the position across and down the film, if it is known.
    pub changes: Option<[DVec3; 2]>,
}

impl ShadowStart {
    /// Returns the start of a node's shadow rays. `spread` is that of the node.
    #[must_use]
    pub fn of(scene: &Scene, node: &Node, spread: Option<&Spread>) -> Self {
        let changes = spread.map(|spread| spread.position);
        let Node { piece, position, geometric_normal: normal, .. } = *node;
        let own = Self { piece, position, normal, changes };
        let shape = &scene.objects[node.piece.object as usize].shape;
        match shape.smooth_point(node.piece.triangle, node.position, normal) {
            Some(smooth) if node.incident.dot(smooth.normal) < 0.0 => {
                Self { position: smooth.position, normal: smooth.normal, ..own }
            }
            // The facet's normal replaces an interpolated normal that is seen from its back.
            Some(_) | None => own,
        }
    }
}
