//! Rays that graze surfaces, start on surfaces, or are caught in mirrors and glass. No ray is lost,
//! and none hits the surface on which it starts.

use crate::exact;
use crate::studio;

use exact::Sample;
use exact::dice::{Dice, Directions};
use glam::{DVec2, DVec3};
use render::accel::{Accel, Structure};
use render::optics::reflect;
use render::ray::Ray;
use render::scene::Scene;
use render::shape::{Quad, Shape, Sphere};
use render::trace::tree::{Branch, IntersectionTree, Node};
use render::trace::volume::Volumes;
use render::trace::{RayCounts, Tracer};
use studio::objects::{ball, mesh};
use studio::scene;

/// Returns angles to the surface, from a tenth down to 1e-12 radians.
fn angles() -> impl Iterator<Item = f64> {
    (1..=12).map(|k| 10f64.powi(-k))
}

/// Returns the triangle, and the parallelogram of which the triangle is one half.
fn shapes(corners: [[f32; 3]; 3]) -> [Shape; 2] {
    let obj = corners.map(|[x, y, z]| format!("v {x:?} {y:?} {z:?}\n")).concat() + "f 1 2 3\n";
    let mesh = render::scene::obj::read("m.obj", obj.as_bytes()).expect("a mesh");
    let [a, b, c] = corners.map(exact::doubles);
    let quad = Quad::new(a, b - a, c - a, DVec2::ONE, true).expect("a rectangle");
    [Shape::Mesh(mesh), Shape::Quad(quad)]
}

#[test]
fn grazing_rays_hit_where_they_should() {
    let mut dice = Dice::new(1);
    let mut hits = 0;
    for angle in angles() {
        for _ in 0..40 {
            let corners = exact::classes::classes()[0].samples(1 + dice.below(50)).pop().unwrap();
            let corners = corners.corners;
            let [a, b, c] = corners.map(exact::doubles);
            let normal = (b - a).cross(c - a).normalize();
            let target = (a + b + c) / 3.0;
            let along = dice.direction().reject_from(normal).normalize();
            let origin = target + 2.0 * (angle.cos() * along + angle.sin() * normal);
            let ray = Ray::from_eye(origin, (target - origin).normalize());
            let truth = Sample { corners, origin, direction: ray.direction };
            let truth = (truth.best_point(&truth.truth()) - origin).length();
            for shape in shapes(corners) {
                let accel = Accel::build(vec![&shape], Structure::Bvh);
                // A rounding of the coordinates, magnified by this angle.
                let bound = 16.0 * f64::EPSILON / angle;
                let hit = accel.closest(&ray, f64::INFINITY);
                let error = hit.map_or(f64::INFINITY, |hit| (hit.t / truth - 1.0).abs());
                assert!(error < bound, "{angle:e}: off by {error:e}, expected {bound:e}");
                hits += 1;
            }
        }
    }
    assert_eq!(hits, 2 * 12 * 40);
}

#[test]
fn grazing_rays_along_a_sphere_hit_it_where_they_should() {
    for angle in angles() {
        for scale in [1e-6, 1.0, 1e6] {
            let center = DVec3::new(0.3, -0.7, 0.2) * scale;
            let ball = Shape::Sphere(Sphere { center, radius: scale });
            let accel = Accel::build(vec![&ball], Structure::Bvh);
            // The ray passes the centre at this fraction of the radius. Its height above the middle
            // of the chord is the rest of the radius.
            let aside = angle.cos();
            let origin = center + scale * DVec3::new(-4.0, aside, 0.0);
            let hit = accel.closest(&Ray::from_eye(origin, DVec3::X), f64::INFINITY).unwrap();
            let truth = scale * (4.0 - angle.sin());
            // Half the chord is the root of a difference, which loses half of its digits.
            let bound = scale * 4.0 * (2.0 * f64::EPSILON / angle).min(f64::EPSILON.sqrt());
            assert!((hit.t - truth).abs() <= bound + 8.0 * f64::EPSILON * truth, "{angle:e}");
        }
    }
    let ball = Shape::Sphere(Sphere { center: DVec3::ZERO, radius: 1.0 });
    let accel = Accel::build(vec![&ball], Structure::Bvh);
    let past = Ray::from_eye(DVec3::new(-4.0, 1f64.next_up(), 0.0), DVec3::X);
    assert!(accel.closest(&past, f64::INFINITY).is_none());
}

#[test]
fn a_mirrored_grazing_ray_leaves_flat_and_round_surfaces_for_good() {
    let mut dice = Dice::new(2);
    let flat = tilted(16);
    let flat = render::scene::obj::read("m.obj", &flat).unwrap();
    let floor = |bounded| {
        let (u, v) = (DVec3::new(4.0, 0.0, 1.0), DVec3::new(0.0, 4.0, -2.0));
        Quad::new(DVec3::new(-2.0, -2.0, 0.5), u, v, DVec2::ONE, bounded).unwrap()
    };
    let shapes = [
        Shape::Mesh(flat),
        Shape::Quad(floor(true)),
        Shape::Quad(floor(false)),
        Shape::Sphere(Sphere { center: DVec3::new(0.3, 5.0, -0.2), radius: 4.0 }),
    ];
    let (mut hits, mut again) = (0, 0);
    for shape in &shapes {
        let accel = Accel::build(vec![shape], Structure::Bvh);
        for angle in angles() {
            for _ in 0..100 {
                let (place, normal) = match shape {
                    Shape::Sphere(sphere) => {
                        let normal = dice.direction();
                        (sphere.center + sphere.radius * normal, normal)
                    }
                    _ => {
                        let [x, y] = [0, 1].map(|_| dice.between(-1.0, 1.0));
                        let normal = DVec3::new(-0.25, 0.5, 1.0).normalize();
                        (DVec3::new(x, y, 0.25 * x - 0.5 * y), normal)
                    }
                };
                let along = dice.direction().reject_from(normal).normalize();
                let from = angle.cos() * along + angle.sin() * normal;
                let ray = Ray::from_eye(place + 3.0 * from, -from);
                let Some(hit) = accel.closest(&ray, f64::INFINITY) else { continue };
                hits += 1;
                let point = accel.surface_point(&ray, &hit);
                let normal = point.geometric_normal;
                let normal = if ray.direction.dot(normal) > 0.0 { -normal } else { normal };
                let mirrored = reflect(ray.direction, normal);
                let next = Ray::leaving(hit.piece, point.position, mirrored);
                again += usize::from(accel.closest(&next, f64::INFINITY).is_some());
            }
        }
    }
    assert!(hits > 4500, "only {hits} rays hit");
    assert_eq!(again, 0, "of {hits} rays, so many hit what they left");
}

/// Returns a tilted square from -2 to 2 as n by n pairs of triangles. It is exact in f32, and so
/// flat, if n is a power of two.
fn tilted(n: usize) -> Vec<u8> {
    let place = |k: usize| 4.0 * k as f64 / n as f64 - 2.0;
    let mut text = String::new();
    for (x, y) in
        (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j))).map(|(i, j)| (place(i), place(j)))
    {
        text += &format!("v {x:?} {y:?} {:?}\n", 0.25 * x - 0.5 * y);
    }
    for k in (0..n * (n + 1)).filter(|k| k % (n + 1) < n) {
        let [a, b, c, d] = [k, k + 1, k + n + 2, k + n + 1].map(|i| i + 1);
        text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
    }
    text.into_bytes()
}

#[test]
fn in_a_hollow_mirror_a_ray_goes_round_for_ever() {
    let mut dice = Dice::new(3);
    for scale in [2f64.powi(-20), 1.0, 1e6] {
        for away in [0.0, 1e3] {
            let center = scale * away * DVec3::new(0.6, -0.48, 0.64);
            let ball = Shape::Sphere(Sphere { center, radius: scale });
            let accel = Accel::build(vec![&ball], Structure::Bvh);
            for grazing in [1.0, 1e-2, 1e-4, 1e-6] {
                let normal = dice.direction();
                let along = dice.direction().reject_from(normal).normalize();
                let start = center + 0.9999 * scale * normal;
                let mut ray = Ray::from_eye(start, (along - grazing * normal).normalize());
                let spin = (start - center).cross(ray.direction);
                for bounce in 0..1000 {
                    let hit = accel.closest(&ray, f64::INFINITY);
                    let hit = hit.unwrap_or_else(|| panic!("escaped after {bounce} bounces"));
                    let point = accel.surface_point(&ray, &hit);
                    let direction = reflect(ray.direction, -point.geometric_normal);
                    ray = Ray::leaving(hit.piece, point.position, direction);
                }
                // A spherical mirror keeps `(position - centre) x direction`; a thousand bounces
                // add a thousand roundings.
                let rounding = f64::EPSILON * scale * (1.0 + away);
                let drift = ((ray.origin - center).cross(ray.direction) - spin).length();
                assert!(drift < 2000.0 * rounding, "{scale} {away} {grazing}: {drift:e}");
            }
        }
    }
}

#[test]
fn in_a_closed_mirror_mesh_no_ray_escapes() {
    let mut dice = Dice::new(4);
    for (columns, rows) in [(24, 12), (7, 4), (4, 2)] {
        let obj = ball(DVec3::new(0.1, 0.2, -0.3), 1.0, columns, rows, false);
        let shape = Shape::Mesh(render::scene::obj::read("m.obj", &obj).unwrap());
        let accel = Accel::build(vec![&shape], Structure::Bvh);
        let mut escaped = 0;
        for _ in 0..400 {
            let mut ray = Ray::from_eye(DVec3::new(0.15, 0.1, -0.25), dice.direction());
            for _ in 0..50 {
                let Some(hit) = accel.closest(&ray, f64::INFINITY) else {
                    escaped += 1;
                    break;
                };
                let point = accel.surface_point(&ray, &hit);
                let direction = reflect(ray.direction, -point.geometric_normal);
                ray = Ray::leaving(hit.piece, point.position, direction);
            }
        }
        assert_eq!(escaped, 0, "{columns} by {rows} cells");
    }
}

/// Counts impossible branches in the tree of one convex closed glass object around `center`: a ray
/// inside that reaches the background, or a ray outside that hits the object again.
fn impossible(tree: &IntersectionTree, node: &Node, center: DVec3, most: &mut [usize; 2]) {
    let inside = (node.position - center).dot(node.geometric_normal) < 0.0;
    for (branch, inside) in [(node.reflected, inside), (node.refracted, !inside)] {
        match branch {
            Branch::Cut => {}
            Branch::Background(_) => most[0] += usize::from(inside),
            Branch::Node(_) => {
                most[1] += usize::from(!inside);
                if let Some(next) = tree.node(branch) {
                    impossible(tree, next, center, most);
                }
            }
        }
    }
}

#[test]
fn in_glass_no_ray_escapes_and_none_hits_what_it_left() {
    let center = DVec3::new(0.1, -0.2, -3.0);
    let keys = |object: &str| {
        format!(
            r#""max_depth": 9, "min_weight": 0, "materials": {{ "glass": {{ "ambient": 0,
            "diffuse": 0, "reflectivity": 1, "transparency": 1, "fresnel": true }} }},
            "objects": [ {object} ]"#
        )
    };
    let round = studio::objects::sphere(center.to_array(), 1.0, "glass");
    let scenes: Vec<Scene> = [(false, 16), (true, 16), (true, 5)]
        .map(|(normals, columns)| {
            let obj = ball(center, 1.0, columns, columns / 2, normals);
            scene(&keys(&mesh("glass")), &[("m.obj", obj)])
        })
        .into_iter()
        .chain([scene(&keys(&round), &[])])
        .collect();
    for (which, scene) in scenes.iter().enumerate() {
        let shapes = scene.objects.iter().map(|object| &object.shape).collect();
        let accel = Accel::build(shapes, Structure::Bvh);
        let volumes = Volumes::of(scene);
        let tracer = Tracer::new(scene, &accel, &volumes);
        let (mut tree, mut counts) = (IntersectionTree::default(), RayCounts::default());
        let mut found = [0; 2];
        // Rays from outside over the whole ball, its rim included, and from inside in all
        // directions. Many rays are aimed exactly at its poles and rings.
        for k in 0..900u32 {
            let [x, y] = [k % 30, k / 30].map(|i| f64::from(i) / 29.0 * 2.1 - 1.05);
            let target = center + DVec3::new(x, y, 0.0);
            let eye = DVec3::new(0.1, -0.2, 3.0);
            tracer.trace(&Ray::from_eye(eye, (target - eye).normalize()), &mut tree, &mut counts);
            if let Some(root) = tree.node(tree.root) {
                impossible(&tree, root, center, &mut found);
            }
            let direction = DVec3::new(x, y, 0.3).normalize();
            let within = center + 0.5 * DVec3::new(y, x, 0.1).normalize();
            tracer.trace(&Ray::from_eye(within, direction), &mut tree, &mut counts);
            let root = tree.node(tree.root).expect("a ray from inside hits");
            impossible(&tree, root, center, &mut found);
        }
        assert!(counts.hits > 10_000, "{counts:?}");
        assert_eq!(found, [0, 0], "scene {which}: escapes and hits that cannot be, of {counts:?}");
    }
}
