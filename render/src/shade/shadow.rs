//! Traces shadow rays: the part of each light that reaches a point (thesis 4.5.2).

use super::{Shader, ShadowStart};
use crate::color::Color;
use crate::differential::{self, RayDifferential};
use crate::ray::{Hit, Ray};
use crate::scene::{Light, PointLight, Scene, SpotLight};
use crate::trace::medium::{Media, Medium};
use glam::DVec3;

/// A boundary of a volume between a point and a light: its distance from the point, the volume, and
/// whether a ray toward the light leaves the volume there.
type Crossing = (f64, Medium, bool);

/// A light that shines on the front of a surface.
#[derive(Debug, Clone, Copy)]
pub struct Facing {
    /// Index of the light in the scene's list.
    pub light: usize,
    /// Unit direction from the surface toward the light.
    pub toward: DVec3,
    /// Cosine of the angle between this direction and the normal, in (0, 1].
    pub cosine: f64,
}

/// Shadow rays that are collected and traced together, and the memory for their work.
///
/// The memory is kept from one row of rays to the next, so that a shadow ray allocates nothing once
/// the arrays are large enough.
#[derive(Debug, Default)]
pub struct Shadows {
    /// The rays, each with the distance to its light.
    rays: Vec<(Ray, f64)>,
    /// For each ray, its light.
    lights: Vec<Facing>,
    /// For each ray, its differential, if it is known.
    differentials: Vec<Option<RayDifferential>>,
    /// For each ray, true if it meets a surface with a mask.
    masked: Vec<bool>,
    /// For each ray, the transmittance to its light.
    transmittance: Vec<Color>,
    /// For each ray, true if it hits an opaque surface.
    blocked: Vec<bool>,
    /// For each ray, true if it hits any surface.
    met: Vec<bool>,
    /// Transparent surfaces that rays hit: ray, object and part.
    crossed: Vec<(usize, u32, u32)>,
    crossings: Vec<Crossing>,
    hits: Vec<Hit>,
    media: Media,
}

impl Shadows {
    /// Removes all rays and keeps the memory.
    pub fn clear(&mut self) {
        self.rays.clear();
        self.lights.clear();
        self.differentials.clear();
    }

    /// Adds the ray from a start to a light of the scene.
    pub fn add(&mut self, scene: &Scene, start: &ShadowStart, facing: Facing) {
        let mut turns = [DVec3::ZERO; 2];
        let (direction, distance) = match scene.lights[facing.light] {
            Light::Point(PointLight { position, .. })
            | Light::Spot(SpotLight { point: PointLight { position, .. }, .. }) => {
                let toward = position - start.position;
                let distance = toward.length();
                if let Some(changes) = start.changes {
                    turns = differential::normalized(toward, changes.map(|change| -change));
                }
                (toward / distance, distance)
            }
            Light::Directional(light) => (light.toward, f64::INFINITY),
        };
        self.rays.push((Ray::leaving(start.piece, start.position, direction), distance));
        let differential = start.changes.map(|origin| RayDifferential { origin, direction: turns });
        self.differentials.push(differential);
        self.lights.push(facing);
    }

    /// Returns the light of each ray, and the transmittance to it that [`Shader::trace_shadows`]
    /// found, linear RGB, [0, 1] per channel.
    pub fn results(&self) -> impl Iterator<Item = (&Facing, Color)> {
        self.lights.iter().zip(self.transmittance.iter().copied())
    }
}

impl Shader<'_> {
    /// Finds for each ray of `shadows` the part of its light that reaches its start.
    ///
    /// An opaque surface between the start and the light blocks all light. A transparent surface
    /// multiplies the light by its transparency, once for each object and part, however often the
    /// ray crosses it. The ray stays straight, as in the thesis. Volumes absorb light along the ray
    /// by Beer's law: coloured glass casts a coloured shadow, and thick glass a dark one. A surface
    /// on which the light itself lies blocks nothing. The ray to a directional light has no end.
    pub fn trace_shadows(&self, shadows: &mut Shadows) {
        let Self { scene, accel, .. } = *self;
        let Shadows { rays, lights, transmittance, blocked, met, masked, crossed, .. } = shadows;
        crossed.clear();
        for flags in [&mut *blocked, &mut *met, &mut *masked] {
            flags.clear();
            flags.resize(rays.len(), false);
        }
        let has_masks = self.has_masks;
        let opaque = |k: usize, hit: Hit| {
            met[k] = true;
            let (ray, distance) = &rays[k];
            let (object, part) = (hit.piece.object, accel.part(&hit));
            let opaque = transparency(scene, (object, part)) == 0.0;
            if self.holds_light(ray, *distance, &hit, &scene.lights[lights[k].light]) {
                return false;
            }
            let surface = scene.objects[object as usize].parts[part as usize];
            if has_masks && surface.mask(scene).is_some() {
                masked[k] = true;
                return false;
            }
            if !opaque {
                crossed.push((k, object, part));
            }
            opaque
        };
        accel.any_of(rays, opaque, blocked);
        // The scene's order is used, so that the product does not depend on the order of the hits.
        crossed.sort_unstable();
        crossed.dedup();
        transmittance.clear();
        let mut next = 0;
        for k in 0..shadows.rays.len() {
            let mut dimmed = 1.0;
            while let Some(&(ray, object, part)) = shadows.crossed.get(next)
                && ray == k
            {
                dimmed *= transparency(scene, (object, part));
                next += 1;
            }
            if shadows.masked[k] && !shadows.blocked[k] && dimmed > 0.0 {
                let (ray, distance) = shadows.rays[k];
                dimmed *= self.passed_by_masks(&ray, distance, shadows.differentials[k].as_ref());
            }
            let reaching = if shadows.blocked[k] {
                Color::ZERO
            } else if self.volumes.absorb() && dimmed > 0.0 {
                dimmed * self.absorbed(k, shadows)
            } else {
                Color::splat(dimmed)
            };
            shadows.transmittance.push(reaching);
        }
    }

    /// Returns whether a light lies on the surface that its ray hits. The distance between both is
    /// measured across the surface, as at the ray's start.
    fn holds_light(&self, ray: &Ray, distance: f64, hit: &Hit, light: &Light) -> bool {
        let (Light::Point(PointLight { position, .. })
        | Light::Spot(SpotLight { point: PointLight { position, .. }, .. })) = *light
        else {
            return false;
        };
        let Some(from) = ray.leaving else { return false };
        let normal = self.accel.geometric_normal(ray, hit);
        let gap = (distance - hit.t) * normal.dot(ray.direction).abs();
        gap <= self.accel.rounding(hit.piece.object, position)
            + self.accel.rounding(from.object, position)
    }

    /// Returns the transmittance of the volumes between the start of ray `k` and its light, linear
    /// RGB, [0, 1] per channel.
    fn absorbed(&self, k: usize, shadows: &mut Shadows) -> Color {
        let Self { scene, accel, volumes, .. } = *self;
        let (ray, distance) = shadows.rays[k];
        let Shadows { crossings, hits, media, .. } = shadows;
        // Crossings are found from the point to the light, since a directional light has no
        // position.
        crossings.clear();
        if shadows.met[k] {
            let (mut step, mut start) = (ray, 0.0);
            while let Some(hit) = self.next_boundary(&step, start, distance) {
                start += hit.t;
                let point = accel.surface_point(&step, &hit);
                if let Some(own) = volumes.medium(scene, hit.piece.object, point.part) {
                    let leaves = ray.direction.dot(point.geometric_normal) > 0.0;
                    crossings.push((start, own, leaves));
                }
                step = Ray::leaving(hit.piece, point.position, ray.direction);
                if crossings.len() == MOST_STEPS {
                    self.cross_the_rest(&step, start, distance, hits, crossings);
                    break;
                }
            }
        }
        // The media are followed from the light to the point, since the volumes around the light
        // are known.
        media.start_in(&self.around_lights[shadows.lights[k].light]);
        let mut left = Color::ONE;
        let mut far = distance;
        let mut pass = |medium: Option<u32>, length: f64| {
            if let Some(material) = medium {
                left *= scene.materials[material as usize].transmittance(length);
            }
        };
        for &(near, own, leaves) in crossings.iter().rev() {
            // Light enters the volumes that a ray toward the light leaves.
            let boundary = media.boundary(own, !leaves, &scene.materials);
            pass(boundary.before, far - near);
            media.cross(own, !leaves, &scene.materials);
            far = near;
        }
        pass(media.current(), far);
        left
    }

    /// Returns the closest hit of a ray whose origin lies at distance `start` from the point, if
    /// the hit lies before the light at `distance`.
    fn next_boundary(&self, ray: &Ray, start: f64, distance: f64) -> Option<Hit> {
        // No hit beyond this distance passes the exact test below, whatever its rounding.
        let t_max = (distance - start) * (1.0 + 1e-9) + f64::EPSILON * start;
        self.accel.closest(ray, t_max).filter(|hit| start + hit.t < distance)
    }

    /// Adds the boundaries of volumes on a ray whose origin lies at distance `start` from the
    /// point, up to the light.
    fn cross_the_rest(
        &self,
        ray: &Ray,
        start: f64,
        distance: f64,
        hits: &mut Vec<Hit>,
        crossings: &mut Vec<Crossing>,
    ) {
        let Self { scene, accel, volumes, .. } = *self;
        hits.clear();
        accel.any(ray, distance - start, |hit| {
            hits.push(hit);
            false
        });
        hits.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.piece.cmp(&b.piece)));
        let boundaries = hits.iter().filter_map(|hit| {
            let own = volumes.medium(scene, hit.piece.object, accel.part(hit))?;
            let normal = accel.geometric_normal(ray, hit);
            Some((start + hit.t, own, ray.direction.dot(normal) > 0.0))
        });
        crossings.extend(boundaries.take(MOST_CROSSINGS - MOST_STEPS));
    }
}

/// Largest number of boundaries that are found one after another on a shadow ray. The others are
/// found by a single search.
///
/// In nested volumes each step tests all volumes again. If larger, thousands of nested volumes take
/// long. If smaller, more rays count coincident boundaries separately, which a step counts as one.
const MOST_STEPS: usize = 1 << 6;

/// Largest number of boundaries on a shadow ray that are counted, a bound on the work.
const MOST_CROSSINGS: usize = 1 << 12;

fn transparency(scene: &Scene, (object, part): (u32, u32)) -> f64 {
    let surface = scene.objects[object as usize].parts[part as usize];
    scene.materials[surface.material].transparency
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{Accel, Structure};
    use crate::procedural::Procedural;
    use crate::ray::Piece;
    use crate::scene::{Background, Camera, Material, Names, Object, Surface};
    use crate::shade::View;
    use crate::shape::{Quad, Shape, Sphere};
    use crate::trace::tree::{Branch, Node};
    use crate::trace::volume::Volumes;
    use glam::{DAffine3, DVec2};

    /// Two balls of dark glass and one of stone, between a floor and a light.
    fn scene() -> Scene {
        let glass = Material {
            transparency: 0.5,
            absorption: DVec3::new(0.1, 0.2, 0.4),
            ..Material::default()
        };
        let object = |shape, material| Object {
            shape,
            parts: vec![Surface { material, texture: None }],
            to_own_space: DAffine3::IDENTITY,
        };
        let ball = |x: f64, radius, material| {
            let center = DVec3::new(x, 0.0, 2.0);
            object(Shape::Sphere(Sphere { center, radius }), material)
        };
        let floor = Quad::new(DVec3::ZERO, DVec3::X, DVec3::Y, DVec2::ONE, false).unwrap();
        Scene {
            camera: Camera::new(DVec3::NEG_Z, DVec3::ZERO, DVec3::Y, 1.0).unwrap(),
            background: Background::Uniform(Color::ZERO),
            is_transparent: false,
            ambient: Color::ZERO,
            lights: vec![Light::Point(PointLight {
                position: DVec3::new(0.0, 0.0, 9.0),
                color: Color::ONE,
                falloff: None,
            })],
            materials: vec![glass, Material::default()],
            textures: Vec::new(),
            procedural: Procedural::default(),
            objects: vec![
                object(Shape::Quad(floor), 1),
                ball(0.0, 1.0, 0),
                ball(0.5, 0.4, 0),
                ball(3.0, 1.0, 1),
            ],
            max_depth: 1,
            min_weight: 0.0,
            names: Names::default(),
            remarks: Vec::new(),
        }
    }

    /// A point of the floor.
    fn node(x: f64) -> Node {
        Node {
            piece: Piece { object: 0, triangle: 0 },
            part: 0,
            position: DVec3::new(x, 0.1, 0.0),
            incident: DVec3::NEG_Z,
            geometric_normal: DVec3::Z,
            normal: DVec3::Z,
            uv: DVec2::ZERO,
            reflected: Branch::Cut,
            refracted: Branch::Cut,
            reflect_weight: Color::ZERO,
            refract_weight: Color::ZERO,
            pass_weight: Color::ZERO,
            inside: false,
        }
    }

    #[test]
    fn a_row_of_shadow_rays_is_one_by_one_and_allocates_only_once() {
        let scene = scene();
        let shapes = scene.objects.iter().map(|object| &object.shape);
        let accel = Accel::build(shapes.collect(), Structure::Bvh);
        let volumes = Volumes::of(&scene);
        let shader = Shader {
            scene: &scene,
            accel: &accel,
            textures: &[],
            charts: &[],
            wants_area: false,
            volumes: &volumes,
            around_lights: &volumes.around_lights(&scene, &accel),
            has_masks: false,
            view: View::Whole,
        };
        let trace = |nodes: &[Node], shadows: &mut Shadows| {
            shadows.clear();
            for node in nodes {
                let facing = Facing { light: 0, toward: DVec3::Z, cosine: 1.0 };
                shadows.add(&scene, &ShadowStart::of(&scene, node, None), facing);
            }
            shader.trace_shadows(shadows);
            shadows.results().map(|(_, reaching)| reaching).collect::<Vec<Color>>()
        };
        let nodes: Vec<Node> = (-50..50).map(|k| node(0.1 * f64::from(k))).collect();
        let mut shadows = Shadows::default();
        let together = trace(&nodes, &mut shadows);
        let alone = nodes.iter().map(|node| trace(&[*node], &mut Shadows::default())[0]);
        assert_eq!(together, alone.collect::<Vec<Color>>());
        let kinds = [Color::ZERO, Color::ONE].map(|kind| together.contains(&kind));
        assert_eq!(kinds, [true, true]);
        assert!(together.iter().any(|light| light.x > light.z && light.z > 0.0));

        let capacities = |shadows: &Shadows| {
            let Shadows { rays, crossed, crossings, transmittance, .. } = shadows;
            [rays.capacity(), crossed.capacity(), crossings.capacity(), transmittance.capacity()]
        };
        let before = capacities(&shadows);
        assert!(before.iter().all(|&capacity| capacity > 0), "{before:?}");
        assert_eq!(trace(&nodes, &mut shadows), together);
        assert_eq!(capacities(&shadows), before);
    }
}
