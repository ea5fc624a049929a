//! Nested media, against closed forms: Snell through layers, lenses, Beer's law.

use crate::studio;

use fixtures::rounding::{HALF_STEP, STEP};
use glam::DVec3;
use render::accel::{Accel, Structure};
use render::filter::Filter;
use render::ray::Ray;
use render::trace::tree::{Branch, IntersectionTree, Node};
use render::trace::volume::Volumes;
use render::trace::{RayCounts, Tracer};
use render::{Picture, Prepared, Scene};
use studio::{assert_near, on_film, picture, pixels, scene};

/// Materials that only let light through.
const CLEAR: &str = r#"
"glass": { "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1.5 },
"shiny": { "ambient": 0, "diffuse": 0, "transparency": 1, "reflectivity": 1, "fresnel": true },
"hard": { "ambient": 0, "diffuse": 0, "transparency": 1, "priority": 1 },
"water": { "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1.33 },
"shiny water": { "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1.33,
                 "reflectivity": 1, "fresnel": true },
"shiny air": { "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1,
               "reflectivity": 1, "fresnel": true },
"air": { "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1 },
"smoke": { "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1,
           "absorption": [1, 0.25, 0] },
"dark": { "ambient": 0, "diffuse": 0, "transparency": 0.5, "index_of_refraction": 1,
          "absorption": [0, 2, 0.5] },
"wall": { "diffuse": 1, "ambient": 0 }, "unlit": { "diffuse": 0 }"#;

fn of(keys: &str, objects: &[String], files: &[(&str, Vec<u8>)]) -> Scene {
    let objects = objects.join(",");
    scene(&format!(r#"{keys} "materials": {{ {CLEAR} }}, "objects": [ {objects} ]"#), files)
}

fn sphere(center: [f64; 3], radius: f64, material: &str) -> String {
    format!(
        r#"{{ "sphere": {{ "center": {center:?}, "radius": {radius:?}, "material": "{material}" }} }}"#
    )
}

/// A plane at this height, with its inside below.
fn below(z: f64, material: &str) -> String {
    format!(
        r#"{{ "plane": {{ "point": [0, 0, {z:?}], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0],
        "material": "{material}" }} }}"#
    )
}

fn block(name: &str, material: &str) -> String {
    format!(r#"{{ "mesh": {{ "name": "{name}", "file": "{name}", "material": "{material}" }} }}"#)
}

/// Returns a block from -`side` to `side` across, between two heights, as an OBJ.
fn obj(side: f64, low: f64, high: f64) -> Vec<u8> {
    let mut text = String::new();
    for z in [low, high] {
        for [x, y] in [[-side, -side], [side, -side], [side, side], [-side, side]] {
            text.push_str(&format!("v {x} {y} {z}\n"));
        }
    }
    (text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n").into_bytes()
}

/// Returns the nodes along the refracted path of a ray, up to the last surface.
fn path(scene: &Scene, origin: DVec3, direction: DVec3) -> Vec<Node> {
    let accel =
        Accel::build(scene.objects.iter().map(|object| &object.shape).collect(), Structure::Bvh);
    let volumes = Volumes::of(scene);
    let tracer = Tracer::new(scene, &accel, &volumes);
    let (mut tree, mut counts) = (IntersectionTree::default(), RayCounts::default());
    tracer.trace(&Ray::from_eye(origin, direction.normalize()), &mut tree, &mut counts);
    let mut nodes = Vec::new();
    let mut branch = tree.root;
    while let Some(node) = tree.node(branch) {
        nodes.push(*node);
        branch = node.refracted;
    }
    nodes
}

/// Returns the sine of the angle between a node's incident ray and the axis z.
fn sine(node: &Node) -> f64 {
    node.incident.x.hypot(node.incident.y)
}

const SLANTED: DVec3 = DVec3::new(0.6, 0.2, -0.5);

#[test]
fn a_slab_shifts_a_ray_and_keeps_its_direction() {
    let objects = [block("slab", "glass"), below(-3.0, "unlit")];
    let slab = of("", &objects, &[("slab", obj(20.0, -1.5, -0.5))]);
    let nodes = path(&slab, DVec3::Z, SLANTED);
    assert_eq!(nodes.len(), 3);
    let (start, end) = (SLANTED.normalize(), &nodes[2]);
    assert!(end.incident.abs_diff_eq(start, 1e-14));
    // Offset from the straight line: d sin(a - b) / cos b.
    let outer = start.x.hypot(start.y).asin();
    let inner = (outer.sin() / 1.5).asin();
    let shift = (end.position - DVec3::Z).cross(start).length();
    assert!((shift - (outer - inner).sin() / inner.cos()).abs() < 1e-12, "{shift}");
}

#[test]
fn water_in_glass_bends_as_snell_says_in_three_layers() {
    let objects = [block("glass", "glass"), block("water", "water"), below(-9.0, "unlit")];
    let files = [("glass", obj(90.0, -4.0, 0.0)), ("water", obj(80.0, -3.0, -1.0))];
    let nodes = path(&of("", &objects, &files), DVec3::Z, SLANTED);
    let outer = SLANTED.normalize().x.hypot(SLANTED.normalize().y);
    let truth = [1.0, 1.5, 1.33, 1.5, 1.0].map(|index| outer / index);
    assert_eq!(nodes.len(), truth.len());
    for (node, truth) in nodes.iter().zip(truth) {
        assert!((sine(node) - truth).abs() < 1e-14, "{node:?}: {truth}");
    }
}

#[test]
fn glass_that_dips_into_water_bends_the_same_both_ways() {
    let objects = [block("glass", "hard"), below(0.0, "water"), below(-5.0, "unlit")];
    let dipped = of("", &objects, &[("glass", obj(50.0, -0.25, 1.0))]);
    let down = path(&dipped, DVec3::new(0.0, 0.0, 2.0), SLANTED);
    // The surface of the water is hidden inside the glass, so there are three surfaces and not
    // four.
    let outer = SLANTED.normalize().x.hypot(SLANTED.normalize().y);
    let sines: Vec<f64> = down.iter().map(sine).collect();
    let truth = [1.0, 1.5, 1.33].map(|index| outer / index);
    assert!(sines.len() == 3 && sines.iter().zip(truth).all(|(s, t)| (s - t).abs() < 1e-14));
    assert!((down[1].position.z + 0.25).abs() < 1e-12);
    // The path is reversed from the floor, with the eye in the water.
    let back = of(
        &format!(
            r#""camera": {{ "eye": {:?}, "target": [0, 0, 0], "fov_deg": 9 }},"#,
            (down[2].position - 1e-3 * down[2].incident).to_array()
        ),
        &objects,
        &[("glass", obj(50.0, -0.25, 1.0))],
    );
    let up = path(&back, down[2].position, -down[2].incident);
    assert_eq!(up.len(), 2);
    assert!(up[1].position.abs_diff_eq(down[0].position, 1e-9));
    assert!((sine(&up[1]) - outer / 1.5).abs() < 1e-12);
}

/// Distance from the axis of the ray whose focus is found. The focus of a ball is nearer by less
/// than twice the square of this distance: 5/6 of the square for glass in air, 5/4 for air in
/// glass.
const HEIGHT: f64 = 1e-4;

/// Returns the distance behind the centre of a ball at which a ray near the axis crosses it.
fn focus(objects: &[String], files: &[(&str, Vec<u8>)], floor: usize) -> f64 {
    let nodes = path(&of("", objects, files), DVec3::new(HEIGHT, 0.0, 1.0), DVec3::NEG_Z);
    let after = &nodes[floor];
    let before = nodes[floor - 1].position;
    -(before.z - before.x / after.incident.x * after.incident.z)
}

#[test]
fn a_ball_is_a_lens_of_its_paraxial_focal_length() {
    let objects = [sphere([0.0; 3], 0.5, "glass"), below(-9.0, "unlit")];
    let truth = 1.5 * 0.5 / (2.0 * (1.5 - 1.0));
    assert!((focus(&objects, &[], 2) - truth).abs() < 2.0 * HEIGHT * HEIGHT);
}

#[test]
fn a_bubble_in_glass_is_a_lens_the_other_way_round() {
    // A block surrounds the bubble, and the ray meets its lower face after the bubble. Indices in
    // the block are relative.
    let objects = [block("glass", "glass"), sphere([0.0; 3], 0.5, "air")];
    let index = 1.0 / 1.5;
    let truth = index * 0.5 / (2.0 * (index - 1.0));
    let found = focus(&objects, &[("glass", obj(5.0, -5.0, 0.75))], 3);
    assert!((found - truth).abs() < 2.0 * HEIGHT * HEIGHT, "{found} {truth}");
}

#[test]
fn through_64_shells_in_each_other_index_times_offset_is_the_same() {
    // In spheres around one centre a ray keeps n r sin(angle), Bouguer's formula.
    let shells: Vec<String> = (0..64)
        .map(|k| {
            let material = ["glass", "water", "air"][k % 3];
            sphere([0.0; 3], 0.9 - 0.0125 * k as f64, material)
        })
        .collect();
    let index = |k: usize| if k == 0 { 1.0 } else { [1.5, 1.33, 1.0][(k - 1) % 3] };
    let invariant = |node: &Node, index: f64| index * node.position.cross(node.incident).length();
    let keys = r#""max_depth": 64, "min_weight": 0,"#;
    let origin = DVec3::new(0.03, 0.04, 1.0);
    let inward = path(&of(keys, &shells, &[]), origin, DVec3::NEG_Z);
    assert_eq!(inward.len(), 65);
    for (k, node) in inward.iter().take(64).enumerate() {
        assert!((invariant(node, index(k)) - 0.05).abs() < 1e-13, "{k}");
    }
    // The path leads out again, from an eye inside all of them.
    let keys = format!(
        r#"{keys} "camera": {{ "eye": [0.03, 0.04, 0], "target": [0, 0, 0], "fov_deg": 9 }},"#
    );
    let outward = path(&of(&keys, &shells, &[]), DVec3::new(0.03, 0.04, 0.0), DVec3::NEG_Z);
    assert_eq!(outward.len(), 64);
    for (k, node) in outward.iter().enumerate() {
        assert!((invariant(node, index(64 - k)) - 0.05 * index(64)).abs() < 1e-13, "{k}");
    }
}

/// Returns the weight of a branch's light that comes from the background, and the weight of rays
/// that were not sent.
fn sources(tree: &IntersectionTree, branch: Branch, weight: f64) -> [f64; 2] {
    match tree.node(branch) {
        _ if weight == 0.0 => [0.0; 2],
        None if matches!(branch, Branch::Background(_)) => [weight, 0.0],
        None => [0.0, weight],
        Some(node) => {
            let [a, b] = sources(tree, node.reflected, weight * node.reflect_weight.x);
            let [c, d] = sources(tree, node.refracted, weight * node.refract_weight.x);
            [a + c, b + d]
        }
    }
}

#[test]
fn glass_water_and_a_bubble_in_a_white_background_are_white() {
    let objects = [
        sphere([0.0; 3], 0.7, "shiny"),
        sphere([0.1, 0.0, 0.0], 0.5, "shiny water"),
        sphere([0.1, 0.1, 0.1], 0.2, "shiny air"),
    ];
    let scene = of(r#""max_depth": 64, "min_weight": 0.00001,"#, &objects, &[]);
    let accel =
        Accel::build(scene.objects.iter().map(|object| &object.shape).collect(), Structure::Bvh);
    let volumes = Volumes::of(&scene);
    let tracer = Tracer::new(&scene, &accel, &volumes);
    let (mut tree, mut counts) = (IntersectionTree::default(), RayCounts::default());
    let mut gray = 0;
    for k in 0..32 * 32 {
        let [a, b] = on_film(k % 32, k / 32, 32);
        let ray = Ray::from_eye(DVec3::Z, DVec3::new(a, b, -1.0).normalize());
        tracer.trace(&ray, &mut tree, &mut counts);
        let [white, lost] = sources(&tree, tree.root, 1.0);
        // However often light is divided, its weights sum to 1.
        assert!((white + lost - 1.0).abs() < 1e-12, "at {a} {b}: {white} and {lost}");
        gray += u32::from(white < 0.998);
    }
    // Near the outline, light is reflected inside more than 64 times.
    assert!(gray < 100, "{gray} of 1024 rays are not white");
}

#[test]
fn water_in_water_is_invisible_to_the_last_bit() {
    let keys = r#""ambient": 1, "background": 0.25, "camera": { "eye": [0, 0, 1], "target": [0, 0, 0],
        "fov_deg": 60 },"#;
    let wall = r#"{ "rectangle": { "corner": [-0.4, -0.3, -1], "edge_u": [1, 0, 0],
        "edge_v": [0, 0.9, 0.1], "material": "unlit" } }"#;
    let sea = [below(3.0, "shiny water"), wall.to_string()];
    let drop = [&sea[..], &[sphere([0.1, 0.05, -0.2], 0.3, "shiny water")]].concat();
    let shown = picture(&of(keys, &sea, &[]), 64, Filter::Point);
    assert_eq!(picture(&of(keys, &drop, &[]), 64, Filter::Point), shown);
    assert!(shown.pixels.contains(&[1.0; 3]) && shown.pixels.contains(&[0.25; 3]));
}

fn assert_exponential(shown: &Picture, absorption: [f64; 3], ways: impl Fn(f64, f64) -> f64) {
    for (x, y, pixel) in pixels(shown) {
        let [a, b] = on_film(x, y, shown.width);
        for k in 0..3 {
            let truth = (-absorption[k] * ways(a, b)).exp();
            assert!((f64::from(pixel[k]) - truth).abs() < HALF_STEP, "{x} {y}: {pixel:?} {truth}");
        }
    }
}

#[test]
fn a_slab_absorbs_as_beer_says_and_so_does_the_medium_of_the_eye() {
    let slab = [block("slab", "smoke")];
    let file = [("slab", obj(20.0, -0.75, 0.0))];
    let shown = picture(&of(r#""background": 1,"#, &slab, &file), 24, Filter::Point);
    let slant = |a: f64, b: f64| (1.0 + a * a + b * b).sqrt();
    assert_exponential(&shown, [1.0, 0.25, 0.0], |a, b| 0.75 * slant(a, b));
    // The camera is in the middle of a ball, and in an infinite sea.
    let ball = [sphere([0.0, 0.0, 1.0], 0.8, "smoke")];
    let shown = picture(&of(r#""background": 1,"#, &ball, &[]), 24, Filter::Point);
    assert_exponential(&shown, [1.0, 0.25, 0.0], |_, _| 0.8);
    let sea = [below(5.0, "smoke")];
    let shown = picture(&of(r#""background": 1,"#, &sea, &[]), 24, Filter::Point);
    assert!(shown.pixels.iter().all(|&pixel| pixel == [0.0, 0.0, 1.0]));
}

#[test]
fn a_ball_in_a_ball_throws_the_shadow_that_beer_says() {
    let keys = r#""ambient": 0, "lights": [ { "directional": { "direction": [0, 0, -3] } } ],"#;
    // The camera looks away from the light, and the objects are behind it.
    let objects = [
        below(0.0, "wall"),
        sphere([0.0, 0.0, 3.0], 0.8, "smoke"),
        sphere([0.0, 0.0, 3.2], 0.4, "dark"),
    ];
    let shown = picture(&of(keys, &objects, &[]), 48, Filter::Point);
    for (x, y, pixel) in pixels(&shown) {
        let [a, b] = on_film(x, y, 48);
        let chord = |radius: f64| 2.0 * (radius * radius - a * a - b * b).max(0.0).sqrt();
        let (outer, inner) = (chord(0.8) - chord(0.4), chord(0.4));
        let dimmed = if inner > 0.0 { 0.5 } else { 1.0 };
        for (k, [smoke, dark]) in [[1.0, 0.0], [0.25, 2.0], [0.0, 0.5]].into_iter().enumerate() {
            let truth = dimmed * (-smoke * outer - dark * inner).exp();
            assert!((f64::from(pixel[k]) - truth).abs() < HALF_STEP, "{x} {y}: {pixel:?} {truth}");
        }
    }
}

#[test]
fn under_water_light_is_absorbed_on_its_way_to_the_ground_and_to_the_eye() {
    // The lamp hangs below the surface; the sun is above it.
    let lamp = r#"{ "point": { "position": [0, 0, 1.5] } }"#;
    let sun = r#"{ "directional": { "direction": [0, 0, -1] } }"#;
    let objects = [below(0.0, "wall"), below(2.0, "smoke")];
    for (light, from_above) in [(lamp, false), (sun, true)] {
        let keys = format!(r#""ambient": 0, "lights": [ {light} ],"#);
        let shown = picture(&of(&keys, &objects, &[]), 24, Filter::Point);
        for (x, y, pixel) in pixels(&shown) {
            let [a, b] = on_film(x, y, 24);
            let flat = a.hypot(b);
            let lit =
                if from_above { (2.0, 1.0) } else { (flat.hypot(1.5), 1.5 / flat.hypot(1.5)) };
            for (k, absorption) in [1.0, 0.25, 0.0].into_iter().enumerate() {
                let truth = lit.1 * (-absorption * (lit.0 + flat.hypot(1.0))).exp();
                assert!(
                    (f64::from(pixel[k]) - truth).abs() < HALF_STEP,
                    "{x} {y}: {pixel:?} {truth}"
                );
            }
        }
    }
}

#[test]
fn two_half_transparent_balls_in_each_other_dim_a_light_twice() {
    let keys = r#""ambient": 0, "lights": [ { "directional": { "direction": [0, 0, -1] } } ],"#;
    let [one, two] = [0.9, 0.8].map(|radius| sphere([0.0, 0.0, 3.0], radius, "half"));
    let half = r#""half": { "transparency": 0.5 }, "wall": { "diffuse": 1, "ambient": 0 }"#;
    let wall = below(0.0, "wall");
    let keys = format!(r#"{keys} "materials": {{ {half} }}, "objects": [ {wall}, {one}, {two} ]"#);
    for (x, y, pixel) in pixels(&picture(&scene(&keys, &[]), 32, Filter::Point)) {
        let [a, b] = on_film(x, y, 32);
        let crossed = [0.9, 0.8].into_iter().filter(|&radius| a.hypot(b) < radius).count();
        assert_eq!(pixel, [0.5f32.powi(crossed as i32); 3], "at {x} {y}");
    }
}

#[test]
fn a_ray_that_counts_in_one_channel_is_followed() {
    // Nearly all red and green are absorbed, and no blue.
    let keys = r#""background": 0.5, "min_weight": 0.9,"#;
    let slab = [block("slab", "smoke"), block("second", "smoke")];
    let files = [("slab", obj(900.0, -99.0, 0.0)), ("second", obj(900.0, -200.0, -100.0))];
    let shown = picture(&of(keys, &slab, &files), 4, Filter::Point);
    let far = |pixel: &[f32; 3]| pixel[0] < 1e-30 && pixel[1] < 1e-9 && pixel[2] == 0.5;
    assert!(shown.pixels.iter().all(far), "{:?}", shown.pixels);
    // If the weight is too small in every channel, no ray is sent: three rays per pixel instead of
    // five.
    let materials = r#""materials": { "ink": { "ambient": 0, "diffuse": 0, "transparency": 1,
        "absorption": 1 } }"#;
    let objects = [block("slab", "ink"), block("second", "ink")].join(",");
    let scene = scene(&format!(r#"{keys} {materials}, "objects": [ {objects} ]"#), &files);
    let settings = render::Settings::new(4, 4, Filter::Point);
    let (shown, stats) = render::render(&Prepared::new(&scene), &settings, &|_, _| {});
    assert_eq!((stats.primary_rays, stats.refracted_rays), (16, 16));
    assert!(shown.pixels.iter().all(|&pixel| pixel == [0.0; 3]));
}

#[test]
fn what_is_left_out_is_less_than_the_least_weight_for_each_ray() {
    let objects =
        [sphere([0.0; 3], 0.7, "shiny"), sphere([0.2, 0.0, 0.0], 0.4, "dark"), below(-0.8, "wall")];
    let lit = r#""background": 1, "lights": [ { "point": { "position": [1, 2, 3] } } ],"#;
    let least = |weight: f64| {
        let keys = format!(r#"{lit} "max_depth": 12, "min_weight": {weight},"#);
        picture(&of(&keys, &objects, &[]), 32, Filter::Point)
    };
    let all = least(0.0);
    for weight in [1e-2, 1e-3, 1e-4] {
        let most = least(weight);
        for (all, most) in all.pixels.iter().flatten().zip(most.pixels.iter().flatten()) {
            // Light is at most 1 everywhere, and fewer than 30 branches are cut on the path.
            assert!(most <= all && f64::from(all - most) < 30.0 * weight, "{all} {most}");
        }
    }
    assert_near(&least(1e-9), &all, STEP);
}
