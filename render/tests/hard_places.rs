//! Eyes and lights at degenerate positions: on surfaces, at corners, inside objects, and at the
//! eye.

use crate::exact;
use crate::studio;

use exact::dice::{Dice, Directions};
use fixtures::rounding::{HALF_STEP, STEP};
use glam::DVec3;
use render::filter::Filter;
use render::{Picture, Scene};
use studio::objects::{ball, light, mesh, plane, quad, sphere};
use studio::{assert_near, at, on_film, picture, pixels, scene};

const MATERIALS: &str = r#""materials": { "white": { "diffuse": 0.8 },
    "unlit": { "diffuse": 0 }, "smoke": { "ambient": 0, "diffuse": 0, "transparency": 0.375,
    "index_of_refraction": 1 } }"#;

fn with(keys: &str, objects: &[String], obj: &[u8]) -> Scene {
    let keys = format!("{keys} {MATERIALS}, \"objects\": [ {} ]", objects.join(","));
    scene(&keys, &[("m.obj", obj.to_vec())])
}

fn shown(keys: &str, objects: &[String], obj: &[u8]) -> Picture {
    picture(&with(keys, objects, obj), 48, Filter::Point)
}

fn wall() -> String {
    plane([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], "white")
}

fn camera(eye: DVec3, target: DVec3) -> String {
    // One of these axes always lies across the view.
    let up = if (target - eye).normalize().y.abs() < 0.9 { [0, 1, 0] } else { [1, 0, 0] };
    format!(
        r#""camera": {{ "eye": {:?}, "target": {:?}, "up": {up:?}, "fov_deg": 100 }},"#,
        eye.to_array(),
        target.to_array()
    )
}

#[test]
fn an_eye_on_a_ball_sees_the_world_outside_and_the_ball_inside() {
    let mut dice = Dice::new(1);
    for _ in 0..60 {
        let radius = 10f64.powf(dice.between(-3.0, 3.0));
        let center = radius * dice.between(0.0, 10.0) * dice.direction();
        let normal = dice.direction();
        let eye = center + radius * normal;
        let keys = |toward: DVec3| {
            camera(eye, eye + radius * toward) + r#""background": [1, 0, 0], "ambient": 0.5,"#
        };
        let objects = [sphere(center.to_array(), radius, "unlit")];
        // A view of 100 degrees leaves ten degrees between its corner and the ball.
        let out = picture(&with(&keys(normal), &objects, b""), 9, Filter::Point);
        assert!(out.pixels.iter().all(|&pixel| pixel == [1.0, 0.0, 0.0]), "{center} {radius}");
        let within = picture(&with(&keys(-normal), &objects, b""), 9, Filter::Point);
        assert!(within.pixels.iter().all(|&pixel| pixel == [0.5; 3]), "{center} {radius}");
    }
}

#[test]
fn an_eye_on_a_flat_surface_sees_past_it_to_both_sides() {
    let mut dice = Dice::new(2);
    for _ in 0..60 {
        let [u, v] = [dice.direction(), dice.direction()];
        let normal = u.cross(v).normalize();
        let corner = 10.0 * dice.direction();
        let eye = corner + dice.between(0.2, 0.4) * u + dice.between(0.2, 0.4) * v;
        for toward in [normal, -normal] {
            let keys = camera(eye, eye + toward) + r#""background": [1, 0, 0], "ambient": 0.5,"#;
            for flat in [plane, quad] {
                let object = flat(corner.to_array(), u.to_array(), v.to_array(), "unlit");
                let seen = picture(&with(&keys, &[object], b""), 9, Filter::Point);
                assert!(seen.pixels.iter().all(|&pixel| pixel == [1.0, 0.0, 0.0]), "{eye}");
            }
        }
    }
    // A point that lies on a triangle of f32 to the last bit, and one of its corners.
    let obj = b"v 0 0 0\nv 4 0 2\nv 0 4 -1\nf 1 2 3\n";
    for eye in [DVec3::new(1.0, 1.0, 0.25), DVec3::ZERO] {
        for toward in [1.0, -1.0] {
            let keys = camera(eye, eye + toward * DVec3::new(-0.5, 0.25, 1.0))
                + r#""background": [1, 0, 0], "ambient": 0.5,"#;
            let seen = picture(&with(&keys, &[mesh("unlit")], obj), 9, Filter::Point);
            assert!(seen.pixels.iter().all(|&pixel| pixel == [1.0, 0.0, 0.0]), "{eye}");
        }
    }
}

#[test]
fn a_light_at_the_eye_shows_no_shadow() {
    // The light sees all that the eye sees. Lambert's law holds without shadows, up to the last
    // pixel of every outline.
    let obj = ball(DVec3::new(-0.4, 0.2, -0.6), 0.5, 16, 8, false);
    let keys = light([0.0, 0.0, 1.0]) + r#""ambient": 0,"#;
    let objects = [
        plane([0.3, 0.1, -2.0], [1.0, 0.1, 0.2], [0.1, 1.0, -0.3], "white"),
        sphere([0.5, 0.1, -0.2], 0.3, "white"),
        mesh("white"),
        quad([-0.9, -0.9, -0.5], [1.0, 0.0, 0.3], [0.0, 0.7, 0.1], "white"),
    ];
    let scene = with(&keys, &objects, &obj);
    let seen = picture(&scene, 64, Filter::Point);
    let shapes = scene.objects.iter().map(|object| &object.shape).collect();
    let accel = render::accel::Accel::build(shapes, render::accel::Structure::Bvh);
    let mut dark = 0;
    for (x, y, pixel) in pixels(&seen) {
        let [a, b] = on_film(x, y, 64);
        let eye = DVec3::new(0.0, 0.0, 1.0);
        let ray = render::ray::Ray::from_eye(eye, DVec3::new(a, b, -1.0).normalize());
        let hit = accel.closest(&ray, f64::INFINITY).unwrap();
        let cosine = accel.surface_point(&ray, &hit).shading_normal.dot(ray.direction).abs();
        dark += usize::from((f64::from(pixel[0]) - 0.8 * cosine).abs() > HALF_STEP);
    }
    assert_eq!(dark, 0, "false shadows");
}

#[test]
fn a_light_at_a_corner_or_on_an_edge_is_not_hidden_by_it() {
    // A cube behind the light. The light is one of its corners, or lies on an edge or on a face.
    let cube = "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\nv -1 -1 4\nv 1 -1 4\nv 1 1 4\nv -1 1 4\n\
        f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    let sight = camera(DVec3::new(0.0, 0.0, 1.5), DVec3::ZERO);
    for position in [[1.0, 1.0, 2.0], [-1.0, 1.0, 2.0], [0.25, 1.0, 2.0], [0.3, -0.2, 2.0]] {
        let keys = light(position) + &sight;
        let bare = shown(&keys, &[wall()], b"");
        let lit = shown(&keys, &[wall(), mesh("white")], cube.as_bytes());
        assert_near(&lit, &bare, 0.0);
    }
}

#[test]
fn a_light_inside_an_object_is_hidden_or_dimmed_once() {
    let keys = light([0.2, 0.1, 2.5]) + r#""ambient": 0.25,"#;
    let bare = shown(&keys, &[wall()], b"");
    let sight = sphere([0.2, 0.1, 2.4], 0.5, "white");
    let hidden = shown(&keys, &[wall(), sight], b"");
    assert!(hidden.pixels.iter().all(|&pixel| pixel == [0.25; 3]));
    let smoke = sphere([0.2, 0.1, 2.4], 0.5, "smoke");
    let obj = ball(DVec3::new(0.2, 0.1, 2.4), 0.5, 12, 6, true);
    for (object, obj) in [(smoke, &b""[..]), (mesh("smoke"), &obj)] {
        let dimmed = shown(&keys, &[wall(), object], obj);
        for (dimmed, bare) in dimmed.pixels.iter().zip(&bare.pixels) {
            let truth = 0.25 + 0.375 * (bare[0] - 0.25);
            assert!((dimmed[0] - truth).abs() <= STEP, "{dimmed:?} {truth}");
        }
    }
}

#[test]
fn a_light_at_the_point_that_is_seen_or_along_the_surface_leaves_it_ambient() {
    for position in [[0.0; 3], [0.5, 0.25, 0.0], [1e-300, 0.0, 0.0], [1e6, 0.0, 0.0]] {
        let keys = light(position) + r#""ambient": 0.25,"#;
        // With an odd number of pixels the middle one looks straight at the light.
        let seen = picture(&with(&keys, &[wall()], b""), 49, Filter::Point);
        assert!(seen.pixels.iter().all(|&pixel| pixel == [0.25; 3]), "{position:?}");
    }
    // Just above the wall only the cosine counts.
    for height in [1e-3, 1e-6, 1e-9, 1e-12, 1e-100] {
        let keys = light([0.0, 0.0, height]) + r#""ambient": 0,"#;
        let seen = picture(&with(&keys, &[wall()], b""), 49, Filter::Point);
        for (x, y, pixel) in pixels(&seen).filter(|(x, y, _)| (*x, *y) != (24, 24)) {
            let [a, b] = on_film(x, y, 49);
            let truth = 0.8 * height / a.hypot(b).hypot(height);
            let error = (f64::from(pixel[0]) - truth).abs();
            // Half a step of f32 is at most 2^-24 of the light, and the point that is seen lies
            // within a rounding of the wall.
            assert!(
                error <= f64::from(STEP) * truth + 1e-16,
                "{height:e} at {x} {y}: {pixel:?} {truth:e}"
            );
        }
        // The foot of the light sees the light straight above.
        assert!((at(&seen, 24, 24)[0] - 0.8).abs() < STEP, "{height:e}: {:?}", at(&seen, 24, 24));
    }
}

#[test]
fn faces_without_parts_do_not_get_those_of_others() {
    // The file has normals and texture coordinates, but not every face uses them.
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let text = format!(
        "{square}vn 0 1 0\nf 1 2 3 4\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1//1 2//1 3//1\n\
         usemtl a\nf 4/1 2/2 3/3 1/4\nf 1/1 2/2 3/3\n"
    );
    let mesh = render::scene::obj::read("a.obj", text.as_bytes()).unwrap();
    let has = |part: [u32; 3]| part != [render::shape::mesh::NONE; 3];
    let kinds: Vec<_> =
        mesh.triangles.iter().map(|triangle| (has(triangle.uv), has(triangle.normal))).collect();
    let [bare, uv, normal] = [(false, false), (true, false), (false, true)];
    assert_eq!(kinds, [bare, bare, uv, normal, uv, uv, uv]);
}

#[test]
fn of_surfaces_that_coincide_the_first_of_the_scene_is_seen() {
    let flat = |material| quad([-2.0, -2.0, -0.3], [4.0, 0.1, 0.3], [0.2, 4.0, -0.7], material);
    let obj = b"v -3 -3 0.1\nv 3 -3 0.7\nv 0 4 -0.3\nf 1 2 3\n";
    let ball = |material| sphere([0.1, 0.2, -1.0], 0.7, material);
    let surfaces: [[String; 2]; 3] =
        [["white", "unlit"].map(flat), ["white", "unlit"].map(mesh), ["white", "unlit"].map(ball)];
    let keys = light([1.0, 2.0, 3.0]) + r#""ambient": 0.25,"#;
    for [one, other] in surfaces {
        let seen = |objects: &[String]| shown(&keys, objects, obj);
        let both = [one.clone(), other.clone()];
        assert_near(&seen(&both), &seen(std::slice::from_ref(&one)), 0.0);
        assert_near(&seen(&[other.clone(), one]), &seen(&[other]), 0.0);
    }
}
