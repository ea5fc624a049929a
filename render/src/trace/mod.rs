//! Follows rays through the scene and keeps what they hit (thesis 4.5.1, fig. 4.3).
//!
//! Tracing is classic: one ray at a time, mirrored and refracted at surfaces. What is unusual is
//! that nothing is shaded on the way. Each place on the film gets an [`tree::IntersectionTree`],
//! and shading waits until its neighbours have theirs.

pub mod medium;
pub mod rows;
mod split;
pub mod tree;
pub mod volume;

use crate::accel::Accel;
use crate::color::Color;
use crate::ray::{Hit, Ray};
use crate::scene::Scene;
use crate::shape::SurfacePoint;
use medium::{Boundary, Media};
use split::{Split, mirror};
use tree::{Branch, IntersectionTree, Node};
use volume::Volumes;

/// A ray passes at most so many boundaries that other volumes hide before it is given up: more
/// than any scene can mean, and a bound on the work for one ray.
const MOST_HIDDEN: usize = 1 << 12;

/// Follows rays through one scene.
#[derive(Debug)]
pub struct Tracer<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What finds the hits.
    pub accel: &'a Accel<'a>,
    /// Its volumes.
    pub volumes: &'a Volumes,
    /// Those that the camera stands in.
    pub around_eye: Media,
}

/// How many rays were sent, by kind, and how many of them hit something.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Rays from the eye.
    pub primary: u64,
    /// Mirrored rays, also those inside glass.
    pub reflected: u64,
    /// Rays that passed a surface.
    pub refracted: u64,
    /// Rays of all three kinds that hit something.
    pub hits: u64,
}

/// Where a ray ends: at a surface that is seen, or nowhere.
struct Arrival {
    end: End,
    /// What its way leaves of light that comes back along it.
    through: Color,
    /// The volumes it is in at its end, if they are not those of its start.
    media: Option<Media>,
}

enum End {
    Surface(Hit, SurfacePoint, Boundary),
    Background,
    Lost,
}

impl<'a> Tracer<'a> {
    /// A tracer for the scene's camera.
    #[must_use]
    pub fn new(scene: &'a Scene, accel: &'a Accel<'a>, volumes: &'a Volumes) -> Self {
        let around_eye = volumes.around(scene, accel, scene.camera.eye());
        Self { scene, accel, volumes, around_eye }
    }

    /// The intersection tree of a ray from the eye.
    pub fn trace(&self, ray: &Ray, tree: &mut IntersectionTree, counts: &mut RayCounts) {
        tree.clear();
        counts.primary += 1;
        (tree.root, tree.through) = self.follow(ray, &self.around_eye, 0, Color::ONE, tree, counts);
    }

    /// Adds what a ray hits, and what its mirrored and refracted rays hit, to the tree. Gives what
    /// it came to, and what its way there leaves of the light.
    ///
    /// `media` is what the ray starts in, `weight` what it counts for in its pixel.
    fn follow(
        &self,
        ray: &Ray,
        media: &Media,
        depth: u32,
        weight: Color,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) -> (Branch, Color) {
        if tree.is_full() {
            return (Branch::Cut, Color::ONE);
        }
        let Arrival { end, through, media: passed } = self.arrive(ray, media);
        let (hit, point, boundary) = match end {
            End::Surface(hit, point, boundary) => (hit, point, boundary),
            End::Background => return (Branch::Background, through),
            End::Lost => return (Branch::Cut, through),
        };
        let (media, weight) = (passed.as_ref().unwrap_or(media), weight * through);
        counts.hits += 1;
        let object = &self.scene.objects[hit.piece.object as usize];
        let material = &self.scene.materials[object.parts[point.part as usize].material];

        // Turn both normals to the side the ray comes from.
        let inside = ray.direction.dot(point.geometric_normal) > 0.0;
        let side = if inside { -1.0 } else { 1.0 };
        let geometric_normal = side * point.geometric_normal;
        let mut normal = side * point.shading_normal;
        if ray.direction.dot(normal) >= 0.0 {
            // Seen from behind its interpolated normal: only the facet itself tells the truth.
            normal = geometric_normal;
        }

        let eta = boundary.eta(&self.scene.materials);
        let split = Split::at(material, ray.direction, normal, geometric_normal, eta);
        let tint = material.tint(-ray.direction.dot(normal));
        let (reflect_weight, refract_weight) =
            (split.reflect_weight * tint, Color::splat(split.refract_weight));
        let slot = tree.push(Node {
            piece: hit.piece,
            part: point.part,
            position: point.position,
            incident: ray.direction,
            geometric_normal,
            normal,
            uv: point.uv,
            reflected: Branch::Cut,
            refracted: Branch::Cut,
            reflect_weight,
            refract_weight,
        });
        if depth >= self.scene.max_depth {
            return (Branch::Node(slot), through);
        }

        // What counts for little in each channel is left out.
        let worth_it = |share: Color| {
            let most = (weight * share).max_element();
            most > 0.0 && most >= self.scene.min_weight
        };
        if worth_it(reflect_weight) {
            counts.reflected += 1;
            let direction = mirror(ray.direction, normal, geometric_normal);
            let mirrored = Ray::leaving(hit.piece, point.position, direction);
            let share = weight * reflect_weight;
            let (branch, way) = self.follow(&mirrored, media, depth + 1, share, tree, counts);
            let node = tree.node_mut(slot);
            node.reflected = branch;
            node.reflect_weight *= way;
        }
        if let Some(direction) = split.refracted.filter(|_| worth_it(refract_weight)) {
            counts.refracted += 1;
            let passed = Ray::leaving(hit.piece, point.position, direction);
            let share = weight * refract_weight;
            let own = self.volumes.medium(self.scene, hit.piece.object, point.part);
            let behind = own.map(|own| media.crossed(own, inside));
            let media = behind.as_ref().unwrap_or(media);
            let (branch, way) = self.follow(&passed, media, depth + 1, share, tree, counts);
            let node = tree.node_mut(slot);
            node.refracted = branch;
            node.refract_weight *= way;
        }
        (Branch::Node(slot), through)
    }

    /// Sends a ray to the first surface that no other volume hides.
    fn arrive(&self, ray: &Ray, start: &Media) -> Arrival {
        let Self { scene, volumes, .. } = self;
        let mut arrival = Arrival { end: End::Lost, through: Color::ONE, media: None };
        let mut ray = *ray;
        for _ in 0..MOST_HIDDEN {
            let media = arrival.media.as_ref().unwrap_or(start);
            let Some(hit) = self.accel.nearest(&ray) else {
                let medium = media.current(&scene.materials);
                arrival.through *= self.transmittance(medium, f64::INFINITY);
                arrival.end = End::Background;
                break;
            };
            let point = self.accel.surface_point(&ray, &hit);
            let inside = ray.direction.dot(point.geometric_normal) > 0.0;
            let area = [hit.piece.object, point.part];
            let boundary = volumes.boundary(scene, media, area, inside);
            let own = volumes.medium(scene, hit.piece.object, point.part);
            // A sheet has no inside that the way could lie in.
            let medium =
                if own.is_some() { boundary.before } else { media.current(&scene.materials) };
            arrival.through *= self.transmittance(medium, hit.t);
            if boundary.seen {
                arrival.end = End::Surface(hit, point, boundary);
                break;
            }
            arrival.media = own.map(|own| media.crossed(own, inside));
            ray = Ray::leaving(hit.piece, point.position, ray.direction);
        }
        arrival
    }

    /// What a way through a material leaves of the light.
    fn transmittance(&self, medium: Option<u32>, way: f64) -> Color {
        medium.map_or(Color::ONE, |material| {
            self.scene.materials[material as usize].transmittance(way)
        })
    }
}
