//! Pictures of one pixel, the smallest and largest spheres and planes, and scenes that are a single
//! point to their shapes.

use crate::studio;

use fixtures::rounding::STEP;
use render::filter::Filter;
use render::{Picture, Scene};
use studio::objects::{light, mesh, plane, quad, sphere, textured};
use studio::{FILTERS, assert_near, at, picture, pixels, png, scene, sized};

const MATERIALS: &str = r#""materials": { "white": { "diffuse": 0.8 },
    "unlit": { "diffuse": 0 }, "mirror": { "ambient": 0, "diffuse": 0, "reflectivity": 1 },
    "glass": { "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1, "fresnel": true } }"#;

const IMAGE: &str = r#""textures": { "image": { "image": "i.png", "values": "linear" } },"#;

/// A scene with a picture of 5 by 3 texels of many colours.
fn with(keys: &str, objects: &[String]) -> Scene {
    let keys = format!("{keys} {IMAGE} {MATERIALS}, \"objects\": [ {} ]", objects.join(","));
    let texels: Vec<[u8; 3]> =
        (0..15u8).map(|k| [k * 17, 255 - k * 11, k.wrapping_mul(57)]).collect();
    scene(&keys, &[("i.png", png(5, &texels))])
}

#[test]
fn a_row_a_column_and_a_pixel_are_parts_of_a_larger_picture() {
    let tilted = plane([0.1, -0.3, -1.0], [0.3, 0.1, 0.2], [0.1, 0.2, -0.4], "unlit");
    let objects = [textured(&tilted), sphere([0.2, 0.1, -0.5], 0.4, "glass")];
    let scene = with(r#""background": [0.1, 0.2, 0.3],"#, &objects);
    for filter in FILTERS {
        // The height determines the size of pixels. A column is therefore the middle column of a
        // square picture, to the last bit. The neighbours that its footprints need are traced as
        // well.
        let square = picture(&scene, 9, filter);
        let column = sized(&scene, 1, 9, filter);
        for y in 0..9 {
            assert_eq!(at(&column, 0, y), at(&square, 4, y), "{filter:?} {y}");
        }
        let row = sized(&scene, 7, 1, filter);
        let pixel = sized(&scene, 1, 1, filter);
        assert_eq!(at(&row, 3, 0), at(&pixel, 0, 0), "{filter:?}");
        assert!(row.pixels.iter().flatten().all(|light| (0.0..=2.0).contains(light)));
    }
}

/// Renders a ball of this radius. The distances of eye and light are proportional to the radius.
fn round(radius: f64) -> Picture {
    let eye = [0.0, 0.0, 4.0 * radius];
    let keys = format!(
        r#""camera": {{ "eye": {eye:?}, "target": [0, 0, 0], "fov_deg": 40 }}, "background": 0.25, {}"#,
        light([3.0 * radius, 5.0 * radius, 4.0 * radius])
    );
    let globe = textured(&sphere([0.0; 3], radius, "white"));
    picture(&with(&keys, &[globe]), 33, Filter::Tent)
}

#[test]
fn balls_of_any_size_look_the_same() {
    let unit = round(1.0);
    for power in [-96, -30, 40, 95] {
        assert_near(&round(2f64.powi(power)), &unit, 0.0);
    }
    for radius in [1e-29, 1e-12, 1e12, 1e29] {
        assert_near(&round(radius), &round(1.0), STEP);
    }
}

#[test]
fn a_ball_around_everything_may_be_as_large_as_scenes_go() {
    // The inside of the large ball is seen everywhere, and the small ball in it is unchanged.
    let small = sphere([0.0, 0.0, -1.0], 0.5, "unlit");
    let keys = r#""ambient": 0.5, "background": [1, 0, 0],"#;
    let bare = picture(&with(keys, std::slice::from_ref(&small)), 31, Filter::Point);
    for radius in [1e6, 1e12, 1e20, 1e30] {
        let sky = sphere([0.0; 3], radius, "unlit");
        let seen = picture(&with(keys, &[small.clone(), sky]), 31, Filter::Point);
        assert!(seen.pixels.iter().all(|&pixel| pixel == [0.5; 3]), "radius {radius:e}");
        // A mirror shows the inside all around.
        let mirror = sphere([0.0, 0.0, -1.0], 0.5, "mirror");
        let sky = sphere([0.0; 3], radius, "unlit");
        let seen = picture(&with(keys, &[mirror, sky]), 31, Filter::Point);
        assert!(seen.pixels.iter().all(|&pixel| pixel == [0.5; 3]), "radius {radius:e}");
    }
    assert!(bare.pixels.contains(&[1.0, 0.0, 0.0]));
}

#[test]
fn balls_too_small_to_be_met_are_not_seen() {
    let keys = r#""background": [1, 0.5, 0.25],"#;
    for radius in [1e-18, 1e-24, 1e-30] {
        // There are nine objects, so that some are leaves of a tree.
        let dust: Vec<String> =
            (0..9).map(|k| sphere([0.013 * f64::from(k), 0.017, -1.0], radius, "white")).collect();
        let seen = picture(&with(keys, &dust), 16, Filter::Point);
        assert!(seen.pixels.iter().all(|&pixel| pixel == [1.0, 0.5, 0.25]), "radius {radius:e}");
    }
}

#[test]
fn a_plane_is_the_same_however_long_its_edges() {
    let keys = light([1.0, 2.0, 3.0]);
    let wall = |size: f64| {
        let [u, v] = [[1.0, 0.25, 0.5], [0.125, 1.0, -0.25]].map(|e: [f64; 3]| e.map(|x| x * size));
        picture(&with(&keys, &[plane([0.3, 0.1, -1.0], u, v, "white")]), 24, Filter::Point)
    };
    let unit = wall(1.0);
    for power in [-90, -30, 30, 99] {
        assert_near(&wall(2f64.powi(power)), &unit, 0.0);
    }
    // A texture on the plane shows one texel everywhere, or the mean of all texels.
    let mean = [0.0, 1.0, 2.0].map(|k: f32| match k as u8 {
        0 => 119.0 / 255.0,
        1 => 178.0 / 255.0,
        _ => (0..15u8).map(|k| f32::from(k.wrapping_mul(57))).sum::<f32>() / 15.0 / 255.0,
    });
    for size in [1e30, 1e-6, 1e-12] {
        let edge = |x: f64, y: f64| [x * size, y * size, 0.0];
        let wall = plane([-0.3 * size, -0.4 * size, 0.0], edge(1.0, 0.0), edge(0.0, 1.0), "unlit");
        let scene = with(r#""ambient": 1,"#, &[textured(&wall)]);
        for filter in [Filter::Box, Filter::Tent] {
            let seen = picture(&scene, 8, filter);
            let truth = if size > 1.0 { at(&seen, 0, 0) } else { mean };
            // Beyond its last whole period a footprint of a hundred thousand periods has little
            // weight.
            let far = |pixel: &[f32; 3]| (0..3).any(|k| (pixel[k] - truth[k]).abs() > 1e-4);
            assert!(!seen.pixels.iter().any(far), "{size:e} {filter:?} {:?}", at(&seen, 0, 0));
        }
    }
}

#[test]
fn a_rectangle_as_large_as_scenes_go_is_still_seen() {
    for size in [1e12, 1e28, 1e30] {
        let wall = quad([-3.0, -3.0, -1.0], [size, 0.0, 0.0], [0.0, size, 0.0], "unlit");
        let scene = with(r#""ambient": 0.5,"#, &[wall.clone(), sphere([0.0; 3], 1e-3, "unlit")]);
        let seen = picture(&scene, 9, Filter::Point);
        assert!(seen.pixels.iter().all(|&pixel| pixel == [0.5; 3]), "{size:e}");
        // More walls than may stand apart from the tree.
        let many = vec![wall; 12];
        let seen = picture(&with(r#""ambient": 0.5,"#, &many), 9, Filter::Point);
        assert!(seen.pixels.iter().all(|&pixel| pixel == [0.5; 3]), "{size:e}");
    }
}

#[test]
fn a_thousand_coincident_triangles_look_like_one() {
    let square = "v -2 -2 0\nv 2 -2 0.5\nv 2 2 0.25\nv -2 2 -0.25\n";
    let obj = |count: usize| {
        let faces = "f 1 2 3\nf 1 3 4\n".repeat(count);
        format!("{square}{faces}").into_bytes()
    };
    for material in ["white", "mirror", "glass"] {
        let shown = |count: usize| {
            let keys = format!(
                "{} \"background\": [0.5, 0.25, 1], \"max_depth\": 4, {MATERIALS}, \
                 \"objects\": [ {}, {} ]",
                light([1.0, 2.0, 3.0]),
                mesh(material),
                sphere([0.3, 0.2, -1.5], 0.6, "white"),
            );
            picture(&scene(&keys, &[("m.obj", obj(count))]), 24, Filter::Point)
        };
        // Of a thousand walls the first is hit. The others do not block the rays that start on it.
        assert_near(&shown(500), &shown(1), 0.0);
    }
    let black = picture(
        &scene(&format!("{MATERIALS}, \"objects\": [ {} ]", mesh("white")), &[("m.obj", obj(1))]),
        24,
        Filter::Point,
    );
    assert!(pixels(&black).all(|(_, _, pixel)| pixel[0] > 0.0));
}
