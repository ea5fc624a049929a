//! The start of the shadow rays of a node.

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
}

impl ShadowStart {
    /// Returns the start of a node's shadow rays.
    #[must_use]
    pub fn of(scene: &Scene, node: &Node) -> Self {
        let own = Self {
            piece: node.piece,
            position: node.position,
            normal: node.geometric_normal,
        };
        let shape = &scene.objects[node.piece.object as usize].shape;
        let Some(facet) = shape.mesh().map(|mesh| mesh.normal(node.piece.triangle)) else {
            return own;
        };
        let side = if facet.dot(node.geometric_normal) < 0.0 { -1.0 } else { 1.0 };
        match shape.smooth_point(node.piece.triangle, node.position, side) {
            Some(smooth) if node.incident.dot(side * smooth.normal) < 0.0 => {
                Self { position: smooth.position, normal: side * smooth.normal, ..own }
            }
            // The facet's normal replaces an interpolated normal that is seen from its back.
            Some(_) | None => own,
        }
    }
}
