//! How much of a light reaches a point (thesis 4.5.2).

use super::Shader;
use crate::color::Color;
use crate::ray::{Hit, Ray};
use crate::scene::{Light, PointLight, Scene};
use crate::trace::medium::{Media, Medium};
use crate::trace::tree::Node;

/// A boundary of a volume between a point and a light: how far from the point, whose, and whether
/// the way to the light leaves the volume there.
type Crossing = (f64, Medium, bool);

impl Shader<'_> {
    /// The part of a light that reaches the node's point, in `[0, 1]` for each channel.
    ///
    /// An opaque surface on the way takes all of it. A transparent one multiplies it by its
    /// transparency, once however often the way crosses it; the way itself stays straight, as in the
    /// thesis. What absorbs light does so along that straight way, by Beer's law: so a coloured
    /// glass throws a coloured shadow, and a deep one a dark shadow. A surface that the light lies
    /// on takes nothing. The way to a directional light has no end.
    #[must_use]
    pub fn transmission(&self, node: &Node, light: &Light, around_light: &Media) -> Color {
        let Self { scene, accel, .. } = *self;
        let (ray, distance) = match light {
            Light::Point(light) => {
                let way = light.position - node.position;
                let distance = way.length();
                (Ray::leaving(node.piece, node.position, way / distance), distance)
            }
            Light::Directional(light) => {
                (Ray::leaving(node.piece, node.position, light.toward), f64::INFINITY)
            }
        };
        // Measured across the surface, as at the ray's start.
        let holds_light = |hit: &Hit| {
            let Light::Point(PointLight { position, .. }) = *light else { return false };
            let normal = accel.surface_point(&ray, hit).geometric_normal;
            let gap = (distance - hit.t) * normal.dot(ray.direction).abs();
            gap <= accel.rounding(hit.piece.object, position)
                + accel.rounding(node.piece.object, position)
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
            if !blocked {
                crossed.push(area);
            }
            !blocked
        });
        if blocked {
            return Color::ZERO;
        }
        // In the scene's order, so that the product does not depend on the order of the hits.
        crossed.sort_unstable();
        crossed.dedup();
        let dimmed: f64 = crossed.into_iter().map(|area| transparency(scene, area)).product();
        if self.volumes.absorb() && dimmed > 0.0 {
            dimmed * self.absorbed(&ray, distance, around_light)
        } else {
            Color::splat(dimmed)
        }
    }

    /// What the volumes on the way to a light leave of it.
    fn absorbed(&self, ray: &Ray, distance: f64, around_light: &Media) -> Color {
        let Self { scene, accel, volumes, .. } = *self;
        // From the point to the light, since a directional one has no place to begin at.
        let mut crossings: Vec<Crossing> = Vec::new();
        let (mut step, mut start) = (*ray, 0.0);
        while let Some(hit) = accel.nearest(&step).filter(|hit| start + hit.t < distance) {
            start += hit.t;
            let point = accel.surface_point(&step, &hit);
            if let Some(own) = volumes.medium(scene, hit.piece.object, point.part) {
                let leaves = ray.direction.dot(point.geometric_normal) > 0.0;
                crossings.push((start, own, leaves));
            }
            step = Ray::leaving(hit.piece, point.position, ray.direction);
            if crossings.len() == MOST_STEPS {
                self.cross_the_rest(&step, start, distance, &mut crossings);
                break;
            }
        }
        // Back from the light, as the light goes: what is around it is known.
        let mut media = around_light.clone();
        let mut left = Color::ONE;
        let mut far = distance;
        let mut pass = |medium: Option<u32>, way: f64| {
            if let Some(material) = medium {
                left *= scene.materials[material as usize].transmittance(way);
            }
        };
        for (near, own, leaves) in crossings.into_iter().rev() {
            // What the way to the light leaves, the light enters.
            let boundary = media.boundary(own, !leaves, &scene.materials);
            pass(boundary.before, far - near);
            media.cross(own, !leaves, &scene.materials);
            far = near;
        }
        pass(media.current(), far);
        left
    }

    /// Adds the boundaries of volumes on a ray that begins `start` from the point, up to the light.
    fn cross_the_rest(&self, ray: &Ray, start: f64, distance: f64, crossings: &mut Vec<Crossing>) {
        let Self { scene, accel, volumes, .. } = *self;
        let mut hits: Vec<Hit> = Vec::new();
        accel.all_before(ray, distance - start, |hit| {
            hits.push(hit);
            true
        });
        hits.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.piece.cmp(&b.piece)));
        let boundaries = hits.iter().filter_map(|hit| {
            let own = volumes.medium(scene, hit.piece.object, accel.part(hit))?;
            let normal = accel.surface_point(ray, hit).geometric_normal;
            Some((start + hit.t, own, ray.direction.dot(normal) > 0.0))
        });
        crossings.extend(boundaries.take(MOST_CROSSINGS - MOST_STEPS));
    }
}

/// A way to a light is followed from boundary to boundary so far; the rest is found at once.
///
/// In volumes inside each other each step looks at all of them again. Larger, and thousands of such
/// volumes take long; smaller, and boundaries in one place are no longer told apart from one as often.
const MOST_STEPS: usize = 1 << 6;

/// Boundaries between a point and a light that are told apart at most: a bound on the work.
const MOST_CROSSINGS: usize = 1 << 12;

fn transparency(scene: &Scene, (object, part): (u32, u32)) -> f64 {
    let surface = scene.objects[object as usize].parts[part as usize];
    scene.materials[surface.material].transparency
}
