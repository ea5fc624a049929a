//! How much of a light reaches a point (thesis 4.5.2).

use crate::accel::Accel;
use crate::ray::{Hit, Ray};
use crate::scene::Scene;
use crate::trace::tree::Node;
use glam::DVec3;

/// The part of the light at `light` that reaches the node's point, in `[0, 1]`.
///
/// An opaque surface on the way takes all of it. A transparent one multiplies it by its
/// transparency, once however often the way crosses it; the way itself stays straight, as in the
/// thesis. A surface that the light lies on takes nothing.
#[must_use]
pub fn transmission(scene: &Scene, accel: &Accel<'_>, node: &Node, light: DVec3) -> f64 {
    let way = light - node.position;
    let distance = way.length();
    let ray = Ray::leaving(node.piece, node.position, way / distance);
    // Measured across the surface, as at the ray's start.
    let holds_light = |hit: &Hit| {
        let normal = accel.surface_point(&ray, hit).geometric_normal;
        let gap = (distance - hit.t) * normal.dot(ray.direction).abs();
        gap <= accel.rounding(hit.piece.object, light) + accel.rounding(node.piece.object, light)
    };
    // Transparent surfaces on the way; pushing nothing allocates nothing.
    let mut crossed: Vec<(u32, u32)> = Vec::new();
    let mut blocked = false;
    accel.all_before(&ray, distance, |hit| {
        let area = (hit.piece.object, accel.part(&hit));
        if holds_light(&hit) {
            return true;
        }
        blocked = transparency(scene, area) == 0.0;
        if !blocked && !crossed.contains(&area) {
            crossed.push(area);
        }
        !blocked
    });
    if blocked {
        return 0.0;
    }
    // In the scene's order, so that the product does not depend on the order of the hits.
    crossed.sort_unstable();
    crossed.into_iter().map(|area| transparency(scene, area)).product()
}

fn transparency(scene: &Scene, (object, part): (u32, u32)) -> f64 {
    let surface = scene.objects[object as usize].parts[part as usize];
    scene.materials[surface.material].transparency
}
