//! Cases that strain the arithmetic: eyes and lights on surfaces, coincident and degenerate
//! shapes, huge, tiny and far away scenes, seams and poles.

use crate::studio;

use fixtures::rounding::{HALF_STEP, STEP};
use glam::DVec3;
use render::filter::Filter;
use render::trace::tree::MOST_NODES;
use render::{Picture, Prepared, Scene, Settings};
use studio::{FILTERS, assert_near, at, on_film, picture, pixels, png, scene};

const MATERIALS: &str = r#""materials": { "white": { "diffuse": 0.8 }, "red": { "color": [1, 0, 0] },
    "unlit": { "diffuse": 0 }, "mirror": { "ambient": 0, "diffuse": 0, "reflectivity": 1 },
    "dim": { "diffuse": 0, "reflectivity": 0.5 },
    "lens": { "ambient": 0, "diffuse": 0, "transparency": 1 },
    "glass": { "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1, "fresnel": true } }"#;

fn sphere(center: [f64; 3], radius: f64, material: &str) -> String {
    format!(
        r#"{{ "sphere": {{ "center": {center:?}, "radius": {radius:?}, "material": "{material}" }} }}"#
    )
}

fn quad(corner: [f64; 3], edge_u: [f64; 3], edge_v: [f64; 3], material: &str) -> String {
    format!(
        r#"{{ "rectangle": {{ "corner": {corner:?}, "edge_u": {edge_u:?}, "edge_v": {edge_v:?},
        "material": "{material}" }} }}"#
    )
}

fn plane(point: [f64; 3], edge_u: [f64; 3], edge_v: [f64; 3], material: &str) -> String {
    format!(
        r#"{{ "plane": {{ "point": {point:?}, "edge_u": {edge_u:?}, "edge_v": {edge_v:?},
        "material": "{material}" }} }}"#
    )
}

fn light(position: [f64; 3]) -> String {
    format!(r#""lights": [ {{ "point": {{ "position": {position:?} }} }} ],"#)
}

fn shown(keys: &str, objects: &[String], obj: &[u8]) -> Picture {
    let keys = format!("{keys} {MATERIALS}, \"objects\": [ {} ]", objects.join(","));
    picture(&scene(&keys, &[("m.obj", obj.to_vec())]), 48, Filter::Point)
}

/// A slightly tilted wall near z = 0.
fn wall(material: &str) -> String {
    plane([0.3, 0.1, 0.0], [1.0, 0.1, 0.2], [0.1, 1.0, -0.3], material)
}

#[test]
fn a_scene_without_objects_is_its_background() {
    for filter in FILTERS {
        let empty =
            picture(&scene(r#""background": [0.1, 0.2, 0.3], "objects": []"#, &[]), 5, filter);
        assert!(empty.pixels.iter().all(|&pixel| pixel == [0.1, 0.2, 0.3]));
    }
}

#[test]
fn from_the_centre_of_a_glass_ball_the_world_looks_as_it_is() {
    let lit = light([1.0, 2.0, 3.0]);
    let bare = shown(&lit, &[wall("white")], b"");
    let ball = sphere([0.0, 0.0, 1.0], 0.4, "lens");
    assert_near(&shown(&lit, &[wall("white"), ball], b""), &bare, STEP);
}

#[test]
fn from_anywhere_in_a_glass_ball_a_white_world_is_as_bright_as_fresnel_lets_out() {
    let keys = r#""background": 1, "max_depth": 64, "min_weight": 0,"#;
    for center in [[0.3, 0.0, 1.0], [0.0, -0.45, 1.1], [0.0, 0.0, 0.51]] {
        let seen = shown(keys, &[sphere(center, 0.5, "glass")], b"");
        for (x, y, pixel) in pixels(&seen) {
            // Every bounce meets the surface at one angle. The sine of this angle is the distance
            // of the ray from the centre over the radius.
            let [a, b] = on_film(x, y, 48);
            let ray = DVec3::new(a, b, -1.0).normalize();
            let sine = (DVec3::from(center) - DVec3::Z).cross(ray).length() / 0.5;
            // Fresnel's formula by angles. 63 bounces are followed, and each lets out a part of the
            // light.
            let (inner, outer) = (sine.asin(), (1.5 * sine).asin());
            let share = |f: fn(f64) -> f64| (f(inner - outer) / f(inner + outer)).powi(2);
            let reflected = 0.5 * (share(f64::sin) + share(f64::tan));
            let truth = if 1.5 * sine < 1.0 { 1.0 - reflected.powi(64) } else { 0.0 };
            assert!(
                (f64::from(pixel[0]) - truth).abs() < HALF_STEP,
                "at {x} {y}: {pixel:?} {truth}"
            );
        }
    }
}

#[test]
fn a_light_on_a_surface_is_not_hidden_by_it() {
    let position = [0.1, 0.2, 2.7];
    let bare = shown(&light(position), &[wall("white")], b"");
    for lamp in [
        plane(position, [1.0, 0.3, 0.1], [-0.2, 1.0, 0.3], "red"),
        quad([-0.9, -0.8, 2.7], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], "red"),
        sphere([0.1, 0.2, 3.7], 1.0, "red"),
        sphere([0.1, 0.2, 2.8], 2.8 - 2.7, "red"),
    ] {
        let lit = shown(&light(position), &[wall("white"), lamp.clone()], b"");
        assert_near(&lit, &bare, 0.0);
    }
}

#[test]
fn a_light_in_the_plane_of_a_wall_leaves_it_ambient() {
    let flat = plane([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], "white");
    let lit = shown(&light([0.0; 3]), &[flat], b"");
    assert!(lit.pixels.iter().all(|&pixel| pixel == [0.1; 3]));
}

#[test]
fn coincident_walls_neither_flicker_nor_shade_each_other() {
    let corners = [([-2.0, -2.0], 4.0), ([-3.0, -2.5], 7.0), ([-30.0, -20.0], 70.0)];
    let walls: Vec<String> = corners
        .iter()
        .map(|&([x, y], side)| {
            let corner = [x, y, 0.2 * x + 0.3 * y];
            quad(corner, [side, 0.0, 0.2 * side], [0.0, side, 0.3 * side], "white")
        })
        .collect();
    let lit = light([1.0, 2.0, 3.0]);
    let one = shown(&lit, &walls[..1], b"");
    assert_near(&shown(&lit, &walls, b""), &one, STEP);
}

/// Returns a tilted square from -2 to 2 as n by n pairs of triangles, with `z = 0.25 x - 0.5 y`
/// exact in f32.
fn grid(n: usize, more: &str) -> Vec<u8> {
    let mut text = String::new();
    for k in 0..(n + 1) * (n + 1) {
        let [x, y] = [k % (n + 1), k / (n + 1)].map(|i| 4.0 * i as f64 / n as f64 - 2.0);
        text.push_str(&format!("v {x} {y} {}\n", 0.25 * x - 0.5 * y));
    }
    for k in (0..n * (n + 1)).filter(|k| k % (n + 1) < n) {
        let [a, b, c, d] = [k, k + 1, k + n + 2, k + n + 1].map(|i| i + 1);
        text.push_str(&format!("f {a} {b} {c}\nf {a} {c} {d}\n"));
    }
    text.push_str(more);
    text.into_bytes()
}

fn mesh(material: &str) -> String {
    format!(r#"{{ "mesh": {{ "name": "m", "file": "m.obj", "material": "{material}" }} }}"#)
}

#[test]
fn triangles_of_one_plane_do_not_shade_or_mirror_each_other() {
    let flat = quad([-2.0, -2.0, 0.5], [4.0, 0.0, 1.0], [0.0, 4.0, -2.0], "white");
    // The second light is one thousandth above the plane.
    for position in [[1.0, 2.0, 3.0], [1.5, 0.5, 0.126]] {
        let one = shown(&light(position), std::slice::from_ref(&flat), b"");
        for n in [1, 16] {
            let many = shown(&light(position), &[mesh("white")], &grid(n, ""));
            assert_near(&many, &one, STEP);
        }
    }
    let mirrored = shown(r#""background": 0.5,"#, &[mesh("mirror")], &grid(16, ""));
    assert!(mirrored.pixels.iter().all(|&pixel| pixel == [0.5; 3]));
}

#[test]
fn triangles_without_area_are_not_there() {
    let lit = light([1.0, 2.0, 3.0]);
    let whole = shown(&lit, &[mesh("white")], &grid(4, ""));
    let flat = "f 1 1 2\nf 1 1 1\nf 1 2 3\nv 0.1 0.1 5\nv 0.3 0.3 5\nv 0.2 0.2 5\nf 26 27 28\n";
    assert_near(&shown(&lit, &[mesh("white")], &grid(4, flat)), &whole, 0.0);
}

#[test]
fn normals_without_length_stand_for_none() {
    let lit = light([1.0, 2.0, 3.0]);
    let square = "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\n";
    let bare = shown(&lit, &[mesh("white")], format!("{square}f 1 2 3 4\n").as_bytes());
    let zero = format!("{square}vn 0 0 0\nf 1//1 2//1 3//1 4//1\n");
    assert_near(&shown(&lit, &[mesh("white")], zero.as_bytes()), &bare, 0.0);
    // Two normals that cancel each other in the middle of the square.
    let opposed = format!("{square}vn 1 0 0\nvn -1 0 0\nf 1//1 2//2 3//2 4//1\n");
    let seen = shown(&lit, &[mesh("glass"), wall("white")], opposed.as_bytes());
    assert!(seen.pixels.iter().flatten().all(|light| (0.0..=1.0).contains(light)));
}

/// Renders a wall, balls of glass and of mirror, and a shadow, `scale` times as large and `away`
/// from the origin.
fn balls(scale: f64, away: [f64; 3]) -> Picture {
    let place = |p: [f64; 3]| [0, 1, 2].map(|k| p[k] * scale + away[k]);
    let edge = |p: [f64; 3]| p.map(|x| x * scale);
    let keys = format!(
        r#""camera": {{ "eye": {:?}, "target": {:?}, "fov_deg": 60 }}, "background": 0.25,
        "min_weight": 0.001, {}"#,
        place([0.0, 0.5, 3.0]),
        place([0.0; 3]),
        light(place([2.0, 4.0, 3.0])),
    );
    let objects = [
        quad(place([-2.0, -1.0, 2.0]), edge([4.0, 0.0, 0.0]), edge([0.0, 0.0, -4.0]), "white"),
        quad(place([-2.0, -1.0, -2.0]), edge([4.0, 0.0, 0.0]), edge([0.0, 4.0, 0.0]), "dim"),
        sphere(place([-0.75, 0.0, 0.0]), 0.5 * scale, "glass"),
        sphere(place([0.75, -0.25, 0.0]), 0.75 * scale, "mirror"),
        sphere(place([0.0, -0.5, 1.0]), 0.25 * scale, "red"),
    ];
    shown(&keys, &objects, b"")
}

#[test]
fn a_scene_looks_the_same_in_any_unit_of_length() {
    let meters = balls(1.0, [0.0; 3]);
    // Powers of two change no digit of any step, provided that no constant is a length.
    for scale in [2f64.powi(20), 2f64.powi(-20), 2f64.powi(40), 2f64.powi(-40)] {
        assert_near(&balls(scale, [0.0; 3]), &meters, 0.0);
    }
    // Powers of ten round differently, which moves the image in a mirror inside a ball.
    for scale in [1e6, 1e-6] {
        assert_alike(&balls(scale, [0.0; 3]), &meters, 1e-5);
    }
}

#[test]
fn a_scene_looks_the_same_a_million_units_from_the_origin() {
    let here = balls(1.0, [0.0; 3]);
    // Positions are rounded to 1e-10 there. Two balls magnify the rounding a thousandfold.
    assert_alike(&balls(1.0, [1e6, -1e6, 1e6]), &here, 1e-5);
}

/// Checks that two pictures differ by at most `tolerance`, except for a few pixels on outlines.
fn assert_alike(left: &Picture, right: &Picture, tolerance: f32) {
    let far = |(l, r): &(&[f32; 3], &[f32; 3])| (0..3).any(|k| (l[k] - r[k]).abs() > tolerance);
    let count = left.pixels.iter().zip(&right.pixels).filter(far).count();
    assert!(count <= 3, "{count} pixels differ");
}

#[test]
fn between_two_mirrors_light_is_a_geometric_series() {
    let mirrors = [
        plane([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], "dim"),
        plane([0.0, 0.0, 2.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], "dim"),
    ];
    for depth in [0, 1, 5, 64] {
        let keys = format!(r#""ambient": 0.5, "max_depth": {depth}, "min_weight": 0,"#);
        let sum = 1.0 - 0.5f64.powi(depth + 1);
        let seen = shown(&keys, &mirrors, b"");
        assert!(seen.pixels.iter().all(|pixel| pixel.map(f64::from) == [f64::from(sum as f32); 3]));
    }
}

#[test]
fn behind_many_half_transparent_panes_a_picture_still_comes() {
    // Each pane sends two rays on; 64 levels of them would not end.
    let materials = r#""materials": { "pane": { "ambient": 0, "diffuse": 0, "reflectivity": 1,
        "transparency": 1, "index_of_refraction": 1 } }"#;
    let panes: Vec<String> = (0..10)
        .map(|k| {
            quad([-9.0, -9.0, -0.2 * f64::from(k)], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], "pane")
        })
        .collect();
    let keys = format!(
        r#""max_depth": 64, "min_weight": 0, {materials}, "objects": [ {} ]"#,
        panes.join(",")
    );
    let settings = Settings::new(2, 2, Filter::Tent);
    let (_, stats) = render::render(&Prepared::new(&scene(&keys, &[])), &settings, &|_, _| {});
    assert_eq!(stats.hits, 4 * MOST_NODES as u64);
}

/// Returns an unlit square, or another object, with a picture on it.
fn textured(width: usize, texels: &[[u8; 3]], camera: &str, object: &str) -> Scene {
    let keys = format!(
        r#"{camera} "ambient": 1, {MATERIALS}, "objects": [ {object} ],
        "textures": {{ "image": {{ "image": "i.png", "values": "linear" }} }}"#
    );
    scene(&keys, &[("i.png", png(width, texels))])
}

const SQUARE: &str = r#"{ "rectangle": { "corner": [-1, -1, 0], "edge_u": [2, 0, 0],
    "edge_v": [0, 2, 0], "material": "unlit", "texture": "image" } }"#;

#[test]
fn textures_may_be_one_texel_wide_or_high() {
    let bands: Vec<[u8; 3]> = (0..8).map(|k| [30 * k, 0, 255 - 30 * k]).collect();
    let shade = |k: u32| [30 * k as u8, 0, 255 - 30 * k as u8].map(|code| f32::from(code) / 255.0);
    for filter in FILTERS {
        let one = picture(&textured(1, &[[51, 102, 255]], "", SQUARE), 16, filter);
        assert!(one.pixels.iter().all(|pixel| {
            pixel
                .iter()
                .zip([0.2, 0.4, 1.0])
                .all(|(light, truth): (_, f32)| (light - truth).abs() < STEP)
        }));
        let across = picture(&textured(8, &bands, "", SQUARE), 64, filter);
        let down = picture(&textured(1, &bands, "", SQUARE), 64, filter);
        for (x, y, pixel) in pixels(&across) {
            let near = |a: [f32; 3], b: [f32; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < STEP);
            assert!(near(pixel, at(&down, y, x)), "{filter:?}: across is not down at {x} {y}");
            // Bands are uniform in their middle, and linear between for all filters but `point`.
            if filter == Filter::Point {
                assert!(near(pixel, shade(x / 8)), "{x} {y} {pixel:?}");
            }
        }
    }
}

const GLOBE: &str = r#"{ "sphere": { "center": [0, 0, 0], "radius": 1, "material": "unlit",
    "texture": "image" } }"#;

fn camera(eye: [f64; 3], up: [f64; 3]) -> String {
    format!(r#""camera": {{ "eye": {eye:?}, "target": [0, 0, 0], "up": {up:?}, "fov_deg": 50 }},"#)
}

#[test]
fn the_seam_of_a_globe_is_not_seen() {
    // The seam is behind. Rotating the picture and the eye by half a turn moves it to the front.
    let texel =
        |i: usize, j: usize| [(i * 37 % 256) as u8, (j * 53 % 256) as u8, (i * j % 256) as u8];
    let map: Vec<_> = (0..512).map(|k| texel(k % 32, k / 32)).collect();
    let turned: Vec<_> = (0..512).map(|k| texel((k + 16) % 32, k / 32)).collect();
    for filter in FILTERS {
        let front = camera([0.0, 0.2, 3.0], [0.0, 1.0, 0.0]);
        let back = camera([0.0, 0.2, -3.0], [0.0, 1.0, 0.0]);
        let away = picture(&textured(32, &map, &front, GLOBE), 49, filter);
        let across = picture(&textured(32, &turned, &back, GLOBE), 49, filter);
        for ((x, y, shown), expected) in pixels(&across).zip(&away.pixels) {
            // The middle one of 49 columns looks along the edge between two texels. Point sampling
            // sees the left or the right texel there, depending on a rounding. Averages do not
            // jump.
            let edge = filter == Filter::Point && x == 24;
            let sides = [at(&across, x - u32::from(edge), y), at(&across, x + u32::from(edge), y)];
            let near = |truth: [f32; 3]| (0..3).all(|k| (shown[k] - truth[k]).abs() <= STEP);
            let found = near(*expected) || edge && sides.into_iter().any(near);
            assert!(found, "{filter:?} at {x} {y}: {shown:?}, expected {expected:?}");
        }
    }
}

#[test]
fn at_a_pole_a_globe_shows_nothing_of_the_other_pole() {
    // The rows next to the north pole are white or black, those next to the south pole red.
    let map: Vec<[u8; 3]> = (0..512)
        .map(|k| match (k / 32, k % 32) {
            (8.., _) => [255, 0, 0],
            (_, 16..) => [255; 3],
            _ => [0; 3],
        })
        .collect();
    // The square of a pyramid is as wide as the part of the pole's row that the pixel sees: the
    // whole row.
    for filter in FILTERS.into_iter().filter(|&filter| filter != Filter::Mip) {
        for (y, truth) in [(4.0, 0.0), (-4.0, 1.0)] {
            // With an odd number of pixels the middle one looks straight at the pole.
            let eye = camera([0.0, y, 0.0], [0.0, 0.0, 1.0]);
            let shown = picture(&textured(32, &map, &eye, GLOBE), 49, filter);
            for (x, y, pixel) in pixels(&shown) {
                let [a, b] = on_film(x, y, 49);
                let near = (pixel[0] - pixel[1] - truth).abs() < STEP;
                assert!(near || a.hypot(b) > 0.3, "{filter:?} at {x} {y}: {pixel:?}");
            }
        }
    }
}
