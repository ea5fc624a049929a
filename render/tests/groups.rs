//! Rays that are traced together find the hits that each finds alone, to the last bit.

use glam::{DAffine3, DVec2, DVec3};
use proptest::prelude::*;
use render::accel::{Accel, Structure};
use render::ray::{Hit, Ray};
use render::shape::mesh::{Mesh, NONE, Triangle};
use render::shape::{Instance, Placement, Quad, Shape, SharedMesh, Sphere};
use std::f64::consts::TAU;

/// A bumpy sheet of `side` by `side` cells over the square from -1 to 1.
fn sheet(side: u32) -> Mesh {
    let at = |x: u32, y: u32| {
        let [x, y] = [x, y].map(|k| 2.0 * f64::from(k) / f64::from(side) - 1.0);
        [x, y, 0.2 * (5.0 * x).sin() * (4.0 * y).cos()].map(|x| x as f32)
    };
    let positions = (0..=side).flat_map(|y| (0..=side).map(move |x| at(x, y))).collect();
    let triangles = (0..side * side).flat_map(|k| {
        let a = k / side * (side + 1) + k % side;
        [[a, a + 1, a + side + 2], [a, a + side + 2, a + side + 1]]
    });
    let triangle = |position| Triangle { position, uv: [NONE; 3], normal: [NONE; 3], surface: 0 };
    Mesh {
        positions,
        triangles: triangles.map(triangle).collect(),
        surfaces: vec![String::new()],
        ..Mesh::default()
    }
}

/// A sheet alone; a sheet among spheres, a floor and instances; and more objects than a group looks at.
fn scenes() -> [Vec<Shape>; 3] {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let ball = |center| Shape::Sphere(Sphere { center, radius: 0.15 });
    let edges = [at(8.0, 0.0, 0.0), at(0.0, 0.0, 8.0)];
    let corner = at(-4.0, -1.25, -4.0);
    let floor =
        |bounded| Shape::Quad(Quad::new(corner, edges[1], edges[0], DVec2::ONE, bounded).unwrap());
    let shared = SharedMesh::new(sheet(12));
    let instance = |turn: f64, shift: DVec3| {
        let map = DAffine3::from_translation(shift) * DAffine3::from_rotation_y(turn);
        Shape::Instance(Instance::new(shared.clone(), Placement::new(map).unwrap()))
    };
    let mut mixed = vec![
        floor(false),
        Shape::Mesh(sheet(40)),
        ball(at(0.3, 0.2, 0.5)),
        instance(0.7, at(1.0, 0.5, -1.0)),
        instance(-0.4, at(-1.0, 0.0, -0.5)),
        floor(true),
    ];
    let many = (0..50).map(|k| ball(at(0.1 * f64::from(k) - 2.5, (f64::from(k)).sin(), 0.4)));
    let crowd = many.chain([Shape::Mesh(sheet(20))]).collect();
    mixed.push(ball(at(-0.5, 0.6, 0.3)));
    [vec![Shape::Mesh(sheet(40))], mixed, crowd]
}

/// A ray, and the distance within which its hits count.
type Bounded = (Ray, f64);

/// Rays of a small picture from an eye, those mirrored at their hits, and those to a light.
fn rays(accel: &Accel<'_>, eye: DVec3, toward: DVec3, spread: f64, count: u32) -> Vec<Bounded> {
    let forward = (toward - eye).normalize();
    let right = forward.any_orthonormal_vector();
    let up = right.cross(forward);
    let light = DVec3::new(2.0, 3.0, 4.0);
    let mut rays: Vec<Bounded> = (0..count)
        .map(|k| {
            let [x, y] = [k % 8, k / 8].map(|k| spread * (f64::from(k) / 8.0 - 0.5));
            (Ray::from_eye(eye, (forward + x * right + y * up).normalize()), f64::INFINITY)
        })
        .collect();
    for k in 0..rays.len() {
        let (ray, _) = rays[k];
        let Some(hit) = accel.closest(&ray, f64::INFINITY) else { continue };
        let point = accel.surface_point(&ray, &hit);
        let normal = point.geometric_normal;
        let mirrored = ray.direction - 2.0 * ray.direction.dot(normal) * normal;
        rays.push((Ray::leaving(hit.piece, point.position, mirrored.normalize()), f64::INFINITY));
        let toward = light - point.position;
        let shadow = Ray::leaving(hit.piece, point.position, toward.normalize());
        rays.push((shadow, toward.length()));
    }
    rays
}

fn bits(hit: Hit) -> (u64, render::ray::Piece, [u64; 2]) {
    (hit.t.to_bits(), hit.piece, hit.barycentric.map(f64::to_bits))
}

/// Asserts that groups of these rays find the hits of single rays.
fn agree(accel: &Accel<'_>, rays: &[Bounded]) -> Result<(), TestCaseError> {
    let mut hits = vec![None; rays.len()];
    accel.closest_of(rays, &mut hits);
    let odd = |hit: &Hit| hit.piece.triangle % 2 == 1;
    let mut found = vec![true; rays.len()];
    accel.any_of(rays, |_, hit| odd(&hit), &mut found);
    // A test that accepts no hit sees every hit once.
    let mut seen = vec![Vec::new(); rays.len()];
    let mut none = vec![true; rays.len()];
    accel.any_of(
        rays,
        |k, hit| {
            seen[k].push(bits(hit));
            false
        },
        &mut none,
    );
    for (k, (ray, t_max)) in rays.iter().enumerate() {
        prop_assert_eq!(
            hits[k].map(bits),
            accel.closest(ray, *t_max).map(bits),
            "ray {}: {:?}",
            k,
            ray
        );
        prop_assert_eq!(found[k], accel.any(ray, *t_max, |hit| odd(&hit)), "ray {}: {:?}", k, ray);
        let mut all = Vec::new();
        accel.any(ray, *t_max, |hit| {
            all.push(bits(hit));
            false
        });
        all.sort_unstable();
        seen[k].sort_unstable();
        prop_assert_eq!(&seen[k], &all, "ray {}: {:?}", k, ray);
        prop_assert!(!none[k]);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Narrow and wide groups, near and far, whole and partial, in front of and among the objects.
    #[test]
    fn groups_find_the_hits_of_single_rays(
        eye in prop::array::uniform3(-3.0..3.0f64), toward in prop::array::uniform3(-1.0..1.0f64),
        far in prop::sample::select(vec![1.0, 1.0, 30.0, 1e6]),
        spread in prop::sample::select(vec![1e-9, 0.002, 0.05, 0.6, 3.0]),
        count in prop::sample::select(vec![3u32, 17, 64, 70]),
    ) {
        let (eye, toward) = (far * DVec3::from(eye), DVec3::from(toward));
        prop_assume!(eye.distance(toward) > 0.1);
        for shapes in &scenes() {
            for structure in [Structure::Bvh, Structure::Grid] {
                let accel = Accel::build(shapes.iter().collect(), structure);
                agree(&accel, &rays(&accel, eye, toward, spread, count))?;
            }
        }
    }
}

/// Directions along the axes and diagonals, with zeros of both signs, through vertices and edges.
#[test]
fn groups_along_the_axes_find_the_hits_of_single_rays() {
    let shapes = [Shape::Mesh(sheet(16))];
    let accel = Accel::build(shapes.iter().collect(), Structure::Bvh);
    for (x, y) in [(0.0, 0.0), (-0.0, 0.0), (0.0, -0.0), (-0.0, -0.0), (0.5, 0.0), (-0.5, 0.5)] {
        for z in [-1.0, 1.0] {
            let direction = DVec3::new(x, y, z).normalize();
            let rays: Vec<Bounded> = (0..289)
                .map(|k| {
                    let start = DVec3::new(
                        f64::from(k % 17) / 8.0 - 1.0,
                        f64::from(k / 17) / 8.0 - 1.0,
                        -z,
                    );
                    (Ray::from_eye(start, direction), f64::INFINITY)
                })
                .collect();
            agree(&accel, &rays).unwrap();
        }
    }
}

/// Rays in all directions from one point, as a group that goes apart at once.
#[test]
fn rays_in_all_directions_find_the_hits_of_single_rays() {
    let [_, shapes, _] = scenes();
    let accel = Accel::build(shapes.iter().collect(), Structure::Bvh);
    let rays: Vec<Bounded> = (0..200)
        .map(|k| {
            let k = f64::from(k);
            let z = 2.0 * (k * 0.618_034).fract() - 1.0;
            let (sine, cosine) = (TAU * (k * 0.754_877).fract()).sin_cos();
            let out = (1.0 - z * z).sqrt();
            let direction = DVec3::new(out * cosine, out * sine, z).normalize();
            (Ray::from_eye(DVec3::new(0.1, 0.2, 0.9), direction), f64::INFINITY)
        })
        .collect();
    agree(&accel, &rays).unwrap();
}
