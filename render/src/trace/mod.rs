//! Follows rays through the scene and keeps what they hit (thesis 4.5.1, fig. 4.3).
//!
//! Tracing is classic: one ray at a time, mirrored and refracted at surfaces. What is unusual is
//! that nothing is shaded on the way. Each place on the film gets an [`tree::IntersectionTree`],
//! and shading waits until its neighbours have theirs.

pub mod medium;
mod ranked;
pub mod rows;
mod split;
pub mod tree;
pub mod volume;

use crate::accel::Accel;
use crate::color::Color;
use crate::procedural::Place;
use crate::ray::{Hit, Ray};
use crate::scene::{Material, Scene};
use crate::shape::SurfacePoint;
use glam::DVec3;
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
enum End {
    Surface(Hit, SurfacePoint, Boundary),
    Background,
    Lost,
}

/// A surface that a ray has come to.
struct Seen {
    hit: Hit,
    point: SurfacePoint,
    boundary: Boundary,
    /// How often the ray was divided before.
    depth: u32,
    /// What it counts for in its pixel.
    weight: Color,
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
        let mut media = std::mem::take(&mut tree.media);
        media.start_in(&self.around_eye);
        (tree.root, tree.through) = self.follow(ray, &mut media, 0, Color::ONE, tree, counts);
        tree.media = media;
    }

    /// Adds what a ray hits, and what its mirrored and refracted rays hit, to the tree. Gives what
    /// it came to, and what its way there leaves of the light.
    ///
    /// `media` is what the ray starts in, and is left as it was; `weight` is what the ray counts for
    /// in its pixel.
    fn follow(
        &self,
        ray: &Ray,
        media: &mut Media,
        depth: u32,
        weight: Color,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) -> (Branch, Color) {
        if tree.is_full() {
            return (Branch::Cut, Color::ONE);
        }
        let start = media.mark();
        let (end, through) = self.arrive(ray, media);
        let branch = match end {
            End::Surface(hit, point, boundary) => {
                let seen = Seen { hit, point, boundary, depth, weight: weight * through };
                self.divide(ray, media, &seen, tree, counts)
            }
            End::Background => tree.leave(ray.direction),
            End::Lost => Branch::Cut,
        };
        media.back_to(start);
        (branch, through)
    }

    /// The normal to shade with, turned by the material's bump if it has one.
    fn bumped(&self, material: &Material, hit: &Hit, point: &SurfacePoint) -> DVec3 {
        let Some(bump) = material.bump.map(|bump| &self.scene.procedural.bumps[bump]) else {
            return point.shading_normal;
        };
        let object = &self.scene.objects[hit.piece.object as usize];
        let uv_gradients = if bump.wants_uv() {
            object.shape.uv_gradients(hit.piece.triangle, point.position)
        } else {
            [DVec3::ZERO; 2]
        };
        let (position, normal) = (point.position, point.shading_normal);
        let place = Place { point: position, normal, uv: point.uv, uv_gradients };
        bump.normal(&object.to_own_space, &place)
    }

    /// Adds a surface that a ray has come to, and what follows from it.
    #[inline]
    fn divide(
        &self,
        ray: &Ray,
        media: &mut Media,
        seen: &Seen,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) -> Branch {
        let Seen { hit, point, boundary, depth, weight } = *seen;
        counts.hits += 1;
        let object = &self.scene.objects[hit.piece.object as usize];
        let material = &self.scene.materials[object.parts[point.part as usize].material];

        // Turn both normals to the side the ray comes from.
        let inside = ray.direction.dot(point.geometric_normal) > 0.0;
        let side = if inside { -1.0 } else { 1.0 };
        let geometric_normal = side * point.geometric_normal;
        let mut normal = side * self.bumped(material, &hit, &point);
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
            return Branch::Node(slot);
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
            if let Some(own) = self.volumes.medium(self.scene, hit.piece.object, point.part) {
                media.cross(own, inside, &self.scene.materials);
            }
            let (branch, way) = self.follow(&passed, media, depth + 1, share, tree, counts);
            let node = tree.node_mut(slot);
            node.refracted = branch;
            node.refract_weight *= way;
        }
        Branch::Node(slot)
    }

    /// Sends a ray to the first surface that no other volume hides; gives what its way leaves of
    /// light that comes back along it. `media` becomes what it is in there.
    #[inline]
    fn arrive(&self, ray: &Ray, media: &mut Media) -> (End, Color) {
        let Self { scene, volumes, .. } = self;
        let mut through = Color::ONE;
        let mut ray = *ray;
        for _ in 0..MOST_HIDDEN {
            let Some(hit) = self.accel.closest(&ray, f64::INFINITY) else {
                let medium = media.current();
                return (End::Background, through * self.transmittance(medium, f64::INFINITY));
            };
            let point = self.accel.surface_point(&ray, &hit);
            let inside = ray.direction.dot(point.geometric_normal) > 0.0;
            let Some(own) = volumes.medium(scene, hit.piece.object, point.part) else {
                // A sheet has no inside that the way could lie in.
                let medium = media.current();
                through *= self.transmittance(medium, hit.t);
                let surface = scene.objects[hit.piece.object as usize].parts[point.part as usize];
                let boundary = media.sheet(surface.material as u32, inside);
                return (End::Surface(hit, point, boundary), through);
            };
            let boundary = media.boundary(own, inside, &scene.materials);
            through *= self.transmittance(boundary.before, hit.t);
            if boundary.seen {
                return (End::Surface(hit, point, boundary), through);
            }
            media.cross(own, inside, &scene.materials);
            ray = Ray::leaving(hit.piece, point.position, ray.direction);
        }
        (End::Lost, through)
    }

    /// What a way through a material leaves of the light.
    fn transmittance(&self, medium: Option<u32>, way: f64) -> Color {
        medium.map_or(Color::ONE, |material| {
            self.scene.materials[material as usize].transmittance(way)
        })
    }
}
