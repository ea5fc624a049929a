//! The rays, for both libraries from the same numbers in `f32`.

use crate::embree::RtcRay;
use crate::leaks::hash;
use glam::DVec3;
use render::accel::Accel;
use render::ray::Ray;
use std::f64::consts::TAU;

const EYE: DVec3 = DVec3::new(0.6, -8.0, 4.6);
const LIGHT: DVec3 = DVec3::new(5.0, -6.0, 9.0);

/// Distance above its surface at which a secondary ray starts. If smaller, rays start below a surface
/// that is rounded to `f32`. Both libraries get the same start.
const LIFT: f64 = 1e-4;

/// Names of the sets of rays.
pub const NAMES: [&str; 4] = ["primary", "mirrored", "shadow", "diffuse"];

/// Rays with the distances at which they end.
#[derive(Debug, Default)]
pub struct Rays {
    pub ours: Vec<(Ray, f64)>,
    pub embree: Vec<RtcRay>,
}

impl Rays {
    fn push(&mut self, origin: DVec3, direction: DVec3, end: f64) {
        let (origin, direction) = (origin.as_vec3(), direction.as_vec3());
        self.embree.push(RtcRay::new(origin.to_array(), direction.to_array(), end as f32));
        let direction = direction.as_dvec3().normalize();
        self.ours.push((Ray::from_eye(origin.as_dvec3(), direction), f64::from(end as f32)));
    }
}

/// Returns the direction of a camera ray; the picture covers [-1, 1] across and up.
fn camera(x: f64, y: f64) -> DVec3 {
    let forward = (DVec3::new(0.0, 0.0, -0.35) - EYE).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    (forward + 0.3 * (x * right + y * up)).normalize()
}

/// Returns camera rays through a picture of `side` x `side` pixels in row order, and from their hits
/// mirrored rays, rays to a light, and one ray each into the hemisphere above.
pub fn sets(accel: &Accel<'_>, side: u32) -> [Rays; 4] {
    let mut sets: [Rays; 4] = Default::default();
    let place = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(side) - 1.0;
    for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
        sets[0].push(EYE, camera(place(x), -place(y)), f64::INFINITY);
    }
    for k in 0..sets[0].ours.len() {
        let (ray, end) = sets[0].ours[k];
        let Some(hit) = accel.closest(&ray, end) else { continue };
        let point = accel.surface_point(&ray, &hit);
        let normal = point.geometric_normal * -point.geometric_normal.dot(ray.direction).signum();
        let start = point.position + LIFT * normal;
        let mirrored = ray.direction - 2.0 * ray.direction.dot(normal) * normal;
        sets[1].push(start, mirrored, f64::INFINITY);
        let toward = LIGHT - start;
        sets[2].push(start, toward.normalize(), 0.9999 * toward.length());
        let (z, angle) = (2.0 * hash(2 * k as u64) - 1.0, TAU * hash(2 * k as u64 + 1));
        let out = (1.0 - z * z).sqrt();
        let sphere = DVec3::new(out * angle.cos(), out * angle.sin(), z);
        sets[3].push(start, (normal + 0.999 * sphere).normalize(), f64::INFINITY);
    }
    sets
}

/// Camera rays through the middle of a picture of `side` x `side` pixels with 4 x 4 rays per pixel, in
/// groups of 64: blocks of 2 x 2 pixels.
pub fn sub_pixels(side: u32) -> Rays {
    let mut rays = Rays::default();
    let blocks = side / 8;
    let start = f64::from(side / 2 - blocks);
    for (block_y, block_x) in (0..blocks).flat_map(|y| (0..blocks).map(move |x| (y, x))) {
        for k in 0..64 {
            let place = |block: u32, k: u32| {
                let pixel = start + 2.0 * f64::from(block) + (f64::from(k) + 0.5) / 4.0;
                2.0 * pixel / f64::from(side) - 1.0
            };
            let direction = camera(place(block_x, k % 8), -place(block_y, k / 8));
            rays.push(EYE, direction, f64::INFINITY);
        }
    }
    rays
}
