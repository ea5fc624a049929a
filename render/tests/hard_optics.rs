//! Glass at the critical angle, at grazing angles, and glass that is air.

use crate::exact;
use crate::studio;

use exact::dice::{Dice, Directions};
use fixtures::rounding::STEP;
use glam::DVec3;
use render::Scene;
use render::accel::{Accel, Structure};
use render::filter::Filter;
use render::optics::{fresnel, refract};
use render::ray::Ray;
use render::trace::tree::IntersectionTree;
use render::trace::volume::Volumes;
use render::trace::{RayCounts, Tracer};
use studio::objects::{ball, light, mesh, plane, quad, sphere, textured};
use studio::{assert_near, picture, png, scene};

const INDICES: [f64; 6] = [1.000_001, 1.1, 1.333, 1.5, 2.42, 4.0];

/// Largest change of the reflected share from one cosine to the next `f64`.
///
/// The cosine of refraction grows from 0 as a square root. For the index 4, one step of `2^-53` in
/// the cosine of incidence makes it 6e-8. The share falls by 2 (4 + 1/4) times this cosine, 5e-7.
const JUMP: f64 = 6e-7;

/// Returns cosines of the angle of incidence, from some ulps beyond the critical one to some ulps
/// before it.
fn critical(index: f64) -> impl Iterator<Item = f64> {
    let mut cosine = (1.0 - 1.0 / (index * index)).sqrt();
    for _ in 0..12 {
        cosine = cosine.next_down();
    }
    std::iter::successors(Some(cosine), |cosine| Some(cosine.next_up())).take(25)
}

#[test]
fn around_the_critical_angle_shares_are_finite_and_go_over_smoothly() {
    for index in INDICES {
        let mut before: Option<f64> = None;
        let mut kinds = [0; 2];
        for cosine in critical(index) {
            let share = fresnel(cosine, index);
            assert!((0.0..=1.0).contains(&share), "{index} {cosine}: {share}");
            let jump = before.map_or(0.0, |before: f64| (share - before).abs());
            assert!(jump <= JUMP, "{index} {cosine}: the share jumps by {jump:e}");
            before = Some(share);
            let incident = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, -cosine);
            match refract(incident, DVec3::Z, index) {
                Some(direction) => {
                    kinds[1] += 1;
                    assert!((direction.length() - 1.0).abs() < 1e-15, "{direction}");
                    assert!(direction.z <= 1e-15, "{direction}");
                }
                None => kinds[0] += 1,
            }
        }
        // For an index this close to that of air, an ulp of the cosine is lost in the difference
        // from one.
        let both = kinds[0] > 0 && kinds[1] > 0;
        assert!(both || index < 1.01, "{index}: both sides of it were tried, {kinds:?}");
    }
}

#[test]
fn around_the_critical_angle_weights_sum_to_one_and_the_colour_is_calm() {
    for index in INDICES {
        let keys = format!(
            r#""materials": {{ "glass": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1,
            "transparency": 1, "fresnel": true, "index_of_refraction": {index} }} }},
            "objects": [ {} ]"#,
            plane([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], "glass")
        );
        let scene = scene(&keys, &[]);
        let accel = Accel::build(
            scene.objects.iter().map(|object| &object.shape).collect(),
            Structure::Bvh,
        );
        let volumes = Volumes::of(&scene);
        let tracer = Tracer::new(&scene, &accel, &volumes);
        let mut before: Option<f64> = None;
        for cosine in critical(index) {
            let direction = DVec3::new((1.0 - cosine * cosine).sqrt(), cosine, 0.0);
            let mut tree = IntersectionTree::default();
            let eye = DVec3::new(0.0, -1.0, 0.0);
            tracer.trace(&Ray::from_eye(eye, direction), &mut tree, &mut RayCounts::default());
            let node = tree.node(tree.root).unwrap();
            let sum = (node.reflect_weight + node.refract_weight).x;
            assert!((sum - 1.0).abs() <= f64::EPSILON, "{index} {cosine}: {sum}");
            // The floor has light 1, and the sky above is black.
            let color = node.reflect_weight.x;
            let jump = before.map_or(0.0, |before: f64| (color - before).abs());
            assert!(jump <= JUMP, "{index} {cosine}: the colour jumps by {jump:e}");
            before = Some(color);
        }
    }
}

#[test]
fn grazing_light_is_reflected_whole_and_what_passes_is_finite() {
    let mut dice = Dice::new(1);
    for angle in (1..=300).step_by(7).map(|k| 10f64.powi(-k)) {
        let normal = dice.direction();
        let along = dice.direction().reject_from(normal).normalize();
        let incident = (along - angle * normal).normalize();
        for eta in [0.25, 1.0 / 1.5, 1.0 - 1e-12, 1.0, 1.5, 4.0] {
            let cosine = (-incident.dot(normal)).max(0.0);
            let share = fresnel(cosine, eta);
            assert!((0.0..=1.0).contains(&share), "{angle:e} {eta}: {share}");
            // For indices that differ, Fresnel's equations transmit a share of about 4 cosines; the
            // bound allows 40.
            if (eta - 1.0).abs() > 0.1 {
                assert!(share >= 1.0 - 40.0 * cosine, "{angle:e} {eta}: {share}");
            }
            if let Some(direction) = refract(incident, normal, eta) {
                assert!((direction.length() - 1.0).abs() < 1e-14, "{angle:e} {eta}: {direction}");
            }
        }
    }
}

/// A wall with a picture, lit or not, and objects in front of it.
fn wall(keys: &str, material: &str, objects: &[String], obj: &[u8]) -> Scene {
    let texels: Vec<[u8; 3]> =
        (0..=255u8).map(|k| [k.wrapping_mul(37), 255 - k, k.wrapping_mul(91)]).collect();
    let wall =
        textured(&plane([0.0317, 0.0123, -2.0], [0.8731, 0.1, 0.2], [0.1, 0.7919, -0.1], material));
    let objects: Vec<String> = std::iter::once(wall).chain(objects.iter().cloned()).collect();
    let keys = format!(
        r#"{keys} "textures": {{ "image": {{ "image": "i.png" }} }}, "materials": {{
        "paper": {{ "ambient": 1, "diffuse": 0 }}, "chalk": {{ "diffuse": 0.8 }},
        "air": {{ "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1 }},
        "fresnel air": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1,
        "fresnel": true, "index_of_refraction": 1 }} }}, "objects": [ {} ]"#,
        objects.join(",")
    );
    scene(&keys, &[("i.png", png(16, &texels)), ("m.obj", obj.to_vec())])
}

#[test]
fn glass_of_index_one_is_not_there() {
    let smooth = ball(DVec3::new(0.1, -0.1, -0.4), 0.7, 9, 5, true);
    let facets = ball(DVec3::new(0.1, -0.1, -0.4), 0.7, 9, 5, false);
    for air in ["air", "fresnel air"] {
        for (object, obj) in [
            (sphere([0.1, 0.2, -0.5], 0.8, air), &b""[..]),
            // The eye is within this ball.
            (sphere([0.1, 0.2, 0.5], 0.9, air), b""),
            (quad([-0.7, -0.8, 0.1], [1.3, 0.2, -0.5], [0.1, 1.4, 0.2], air), b""),
            (plane([0.0, 0.0, -0.5], [1.0, 0.3, 0.1], [-0.2, 1.0, 0.3], air), b""),
            (mesh(air), &facets),
            (mesh(air), &smooth),
        ] {
            let objects = [object];
            let unlit = |objects: &[String]| wall(r#""ambient": 1,"#, "paper", objects, obj);
            // A rounding moves the point that is seen, so no pixel may look at the edge of a texel.
            let bare = picture(&unlit(&[]), 61, Filter::Point);
            assert_near(&picture(&unlit(&objects), 61, Filter::Point), &bare, 0.0);
            // The wall is lit through the object. A rounding moves the point on the wall, and with
            // it the cosine.
            let keys = light([1.0, 2.0, 3.0]);
            let bare = picture(&wall(&keys, "chalk", &[], obj), 61, Filter::Point);
            let through = picture(&wall(&keys, "chalk", &objects, obj), 61, Filter::Point);
            assert_near(&through, &bare, STEP);
        }
    }
}
