//! Follows rays through the scene and keeps what they hit (thesis 4.5.1, fig. 4.3).
//!
//! Tracing is classic: one ray at a time, mirrored and refracted at surfaces. What is unusual is
//! that nothing is shaded on the way. Each place on the film gets an [`tree::IntersectionTree`],
//! and shading waits until its neighbours have theirs.

pub mod rows;
pub mod tree;

use crate::accel::Accel;
use crate::optics;
use crate::procedural::Place;
use crate::ray::{Hit, Ray};
use crate::scene::{Material, Scene};
use crate::shape::SurfacePoint;
use glam::DVec3;
use tree::{Branch, IntersectionTree, Node};

/// Follows rays through one scene.
#[derive(Debug)]
pub struct Tracer<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What finds the hits.
    pub accel: &'a Accel<'a>,
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

impl Tracer<'_> {
    /// The intersection tree of a ray from the eye.
    pub fn trace(&self, ray: &Ray, tree: &mut IntersectionTree, counts: &mut RayCounts) {
        tree.clear();
        counts.primary += 1;
        tree.root = self.follow(ray, 0, 1.0, tree, counts);
    }

    /// Adds what a ray hits, and what its mirrored and refracted rays hit, to the tree.
    ///
    /// `weight` is what the ray counts for in its pixel.
    fn follow(
        &self,
        ray: &Ray,
        depth: u32,
        weight: f64,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) -> Branch {
        if tree.is_full() {
            return Branch::Cut;
        }
        let Some(hit) = self.accel.nearest(ray) else { return Branch::Background };
        counts.hits += 1;
        let point = self.accel.surface_point(ray, &hit);
        let object = &self.scene.objects[hit.piece.object as usize];
        let material = &self.scene.materials[object.parts[point.part as usize].material];

        // Turn both normals to the side the ray comes from.
        let inside = ray.direction.dot(point.geometric_normal) > 0.0;
        let side = if inside { -1.0 } else { 1.0 };
        let geometric_normal = side * point.geometric_normal;
        let mut normal = side * self.bumped(material, &hit, &point);
        if ray.direction.dot(normal) >= 0.0 {
            // Seen from behind its interpolated or bumped normal: only the facet itself tells the truth.
            normal = geometric_normal;
        }

        let split = Split::at(material, ray.direction, normal, geometric_normal, inside);
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
            reflect_weight: split.reflect_weight,
            refract_weight: split.refract_weight,
        });
        if depth >= self.scene.max_depth {
            return Branch::Node(slot);
        }

        let worth_it = |share: f64| share > 0.0 && weight * share >= self.scene.min_weight;
        if worth_it(split.reflect_weight) {
            counts.reflected += 1;
            let direction = mirror(ray.direction, normal, geometric_normal);
            let mirrored = Ray::leaving(hit.piece, point.position, direction);
            let share = weight * split.reflect_weight;
            let branch = self.follow(&mirrored, depth + 1, share, tree, counts);
            tree.node_mut(slot).reflected = branch;
        }
        if let Some(direction) = split.refracted.filter(|_| worth_it(split.refract_weight)) {
            counts.refracted += 1;
            let passed = Ray::leaving(hit.piece, point.position, direction);
            let share = weight * split.refract_weight;
            let branch = self.follow(&passed, depth + 1, share, tree, counts);
            tree.node_mut(slot).refracted = branch;
        }
        Branch::Node(slot)
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
}

/// How light divides at a surface.
#[derive(Debug, Clone, Copy)]
struct Split {
    reflect_weight: f64,
    refract_weight: f64,
    refracted: Option<DVec3>,
}

impl Split {
    fn at(
        material: &Material,
        incident: DVec3,
        normal: DVec3,
        geometric_normal: DVec3,
        inside: bool,
    ) -> Self {
        let Material { reflectivity, transparency, index_of_refraction, .. } = *material;
        let mirror_only =
            Self { reflect_weight: reflectivity, refract_weight: 0.0, refracted: None };
        if transparency == 0.0 && !material.fresnel {
            return mirror_only;
        }
        let eta = if inside { index_of_refraction } else { 1.0 / index_of_refraction };
        let share =
            if material.fresnel { optics::fresnel(-incident.dot(normal), eta) } else { 1.0 };
        if transparency == 0.0 {
            return Self { reflect_weight: reflectivity * share, ..mirror_only };
        }
        // Where the interpolated normal would keep the ray on this side, the facet's does not.
        let refracted = optics::refract(incident, normal, eta).and_then(|direction| {
            if direction.dot(geometric_normal) < 0.0 {
                Some(direction)
            } else {
                optics::refract(incident, geometric_normal, eta)
            }
        });
        match refracted {
            Some(direction) if material.fresnel => Self {
                reflect_weight: reflectivity * share,
                refract_weight: transparency * (1.0 - share),
                refracted: Some(direction),
            },
            Some(direction) => Self {
                reflect_weight: reflectivity,
                refract_weight: transparency,
                refracted: Some(direction),
            },
            // Total internal reflection: what would have passed is mirrored as well.
            None => Self { reflect_weight: reflectivity.max(transparency), ..mirror_only },
        }
    }
}

/// The mirrored direction; about the facet itself where the interpolated normal would send the
/// ray through the surface.
fn mirror(incident: DVec3, normal: DVec3, geometric_normal: DVec3) -> DVec3 {
    let direction = optics::reflect(incident, normal);
    if direction.dot(geometric_normal) > 0.0 {
        direction
    } else {
        optics::reflect(incident, geometric_normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Color;
    use proptest::prelude::*;

    fn unit() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0f64)
            .prop_map(DVec3::from)
            .prop_filter("a direction", |v| v.length() > 0.1)
            .prop_map(DVec3::normalize)
    }

    proptest! {
        /// However wrong the interpolated normal, mirrored light stays on its side of the facet
        /// and refracted light leaves it, and no light is made.
        #[test]
        fn an_interpolated_normal_sends_no_ray_through_the_facet(
            incident in unit(), facet in unit(), normal in unit(), inside in any::<bool>(),
            fresnel in any::<bool>(),
        ) {
            let facet = if incident.dot(facet) < 0.0 { facet } else { -facet };
            prop_assume!(incident.dot(facet) < -1e-3 && incident.dot(normal) < -1e-3);
            prop_assert!(mirror(incident, normal, facet).dot(facet) > 0.0);
            let glass = Material {
                color: Color::ONE,
                ambient: 0.0,
                diffuse: 0.0,
                specular: 0.0,
                shininess: 1.0,
                reflectivity: 1.0,
                transparency: 1.0,
                index_of_refraction: 1.5,
                fresnel,
                bump: None,
            };
            let split = Split::at(&glass, incident, normal, facet, inside);
            if let Some(direction) = split.refracted {
                prop_assert!(direction.dot(facet) < 0.0);
            }
            if fresnel {
                prop_assert!((split.reflect_weight + split.refract_weight - 1.0).abs() < 1e-12);
            }
        }
    }
}
