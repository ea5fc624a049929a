//! Pictures with known results: glass, mirrors, light and shadow.
//!
//! Colours are summed in `f64` and rounded once, to `f32`. Where a tolerance is larger than that
//! rounding, the test states the reason.

use crate::studio;

use fixtures::rounding::{HALF_STEP, STEP};
use render::filter::Filter;
use render::{Picture, Scene};
use studio::{FILTERS, assert_near, at, on_film, picture, pixels, png, scene, supersampled};

/// Materials that show only reflected or refracted light.
const CLEAR: &str = r#"
"glass": { "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1, "fresnel": true },
"mirror": { "ambient": 0, "diffuse": 0, "reflectivity": 1 },
"air": { "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1 },
"pane": { "ambient": 0, "diffuse": 0, "transparency": 1 }"#;

/// A wall at z = 0, four units wide.
const WALL: &str = r#"{ "rectangle": { "corner": [-2, -2, 0], "edge_u": [4, 0, 0],
    "edge_v": [0, 4, 0], "material": "wall", "texture": "checks" } }"#;

/// A scene of a checkered, lit wall with `objects` in front of it.
fn before_checks(wall: &str, objects: &str) -> Scene {
    let checks: Vec<[u8; 3]> = (0..64)
        .map(|k| if (k + k / 8) % 2 == 0 { [230, 40, 90] } else { [25, 128, 200] })
        .collect();
    let comma = if objects.is_empty() { "" } else { "," };
    let keys = format!(
        r#""background": [0.3, 0.5, 0.7], "ambient": 1,
        "lights": [ {{ "point": {{ "position": [1, 2, 3], "color": 0.7 }} }} ],
        "textures": {{ "checks": {{ "image": "checks.png" }} }},
        "materials": {{ "wall": {wall}, {CLEAR} }}, "objects": [ {WALL} {comma} {objects} ]"#
    );
    scene(&keys, &[("checks.png", png(8, &checks))])
}

/// A scene of `objects` in front of a uniform background.
fn before_nothing(background: f64, more: &str, objects: &str) -> Scene {
    let keys = format!(
        r#""background": {background}, {more} "materials": {{ {CLEAR} }}, "objects": [ {objects} ]"#
    );
    scene(&keys, &[])
}

fn sphere(center: [f64; 3], radius: f64, material: &str) -> String {
    format!(
        r#"{{ "sphere": {{ "center": {center:?}, "radius": {radius}, "material": "{material}" }} }}"#
    )
}

fn all_are(picture: &Picture, expected: f32, tolerance: f32) {
    for (x, y, pixel) in pixels(picture) {
        let near = pixel.iter().all(|light| (light - expected).abs() <= tolerance);
        assert!(near, "at column {x}, row {y}: {pixel:?}, expected {expected}");
    }
}

#[test]
fn glass_of_index_1_is_invisible_to_the_last_bit() {
    // There are no lights, so only the choice of texels matters.
    let wall = r#"{ "diffuse": 0 }"#;
    let ball = sphere([0.1, 0.05, 0.4], 0.3, "air");
    let without = picture(&before_checks(wall, ""), 96, Filter::Point);
    let with = picture(&before_checks(wall, &ball), 96, Filter::Point);
    assert_eq!(with, without);
}

#[test]
fn glass_of_index_1_in_a_light_is_invisible_up_to_rounding() {
    // The path through the glass ends a rounding beside the straight path, and so does the angle to
    // the light.
    let wall = r#"{ "diffuse": 0.8 }"#;
    let ball = sphere([0.1, 0.05, 0.4], 0.3, "air");
    let without = picture(&before_checks(wall, ""), 96, Filter::Point);
    assert_near(&picture(&before_checks(wall, &ball), 96, Filter::Point), &without, STEP);
}

#[test]
fn a_perfect_mirror_in_a_uniform_background_disappears() {
    for filter in FILTERS {
        let scene = before_nothing(0.625, "", &sphere([0.1, 0.0, 0.0], 0.5, "mirror"));
        all_are(&picture(&scene, 40, filter), 0.625, 0.0);
    }
}

#[test]
fn fresnel_glass_in_a_white_background_is_white() {
    let ball = sphere([0.0, 0.0, 0.0], 0.7, "glass");
    let scene = before_nothing(1.0, r#""max_depth": 64, "min_weight": 0,"#, &ball);
    // Light still inside after 64 reflections is lost. It is less than a thousandth, even at
    // grazing angles.
    all_are(&picture(&scene, 64, Filter::Point), 1.0, 1e-3);
}

#[test]
fn the_background_needs_no_depth_and_a_mirror_needs_one() {
    let ball = sphere([0.0, 0.0, 0.0], 0.5, "mirror");
    let scene = before_nothing(0.5, r#""max_depth": 0,"#, &ball);
    let shown = picture(&scene, 21, Filter::Tent);
    assert_eq!((at(&shown, 0, 0), at(&shown, 10, 10)), ([0.5; 3], [0.0; 3]));
    let scene = before_nothing(0.5, r#""max_depth": 1,"#, &ball);
    all_are(&picture(&scene, 21, Filter::Tent), 0.5, 0.0);
}

#[test]
fn a_wall_lit_from_straight_above_has_lamberts_colour() {
    let keys = r#""ambient": [0.1, 0.2, 0.3], "lights": [ { "point": { "position": [0, 0, 3],
        "color": [0.5, 1, 0.25] } } ],
        "materials": { "wall": { "color": [0.9, 0.6, 0.3], "ambient": 0.5, "diffuse": 0.8 } },
        "objects": [ { "plane": { "point": [7, 3, 0], "edge_u": [1, 0, 0], "edge_v": [1, 1, 0],
        "material": "wall" } } ]"#;
    let shown = picture(&scene(keys, &[]), 32, Filter::Point);
    for (x, y, pixel) in pixels(&shown) {
        let [a, b] = on_film(x, y, 32);
        let cosine = 3.0 / (a * a + b * b + 9.0).sqrt();
        let (color, ambient, light) = ([0.9, 0.6, 0.3], [0.1, 0.2, 0.3], [0.5, 1.0, 0.25]);
        for k in 0..3 {
            let truth = color[k] * (0.5 * ambient[k] + 0.8 * light[k] * cosine);
            assert!(
                (f64::from(pixel[k]) - truth).abs() < HALF_STEP,
                "{x} {y} {k}: {pixel:?} {truth}"
            );
        }
    }
}

#[test]
fn a_highlight_is_phongs() {
    // Light and eye coincide. The mirrored ray's angle to the light is twice the angle of
    // incidence.
    let keys = r#""ambient": 0, "lights": [ { "point": { "position": [0, 0, 1] } } ],
        "materials": { "wall": { "ambient": 0, "diffuse": 0, "specular": 0.7, "shininess": 9 } },
        "objects": [ { "plane": { "point": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0],
        "material": "wall" } } ]"#;
    let shown = picture(&scene(keys, &[]), 32, Filter::Point);
    for (x, y, pixel) in pixels(&shown) {
        let [a, b] = on_film(x, y, 32);
        let cosine_sq = 1.0 / (a * a + b * b + 1.0);
        let truth = 0.7 * (2.0 * cosine_sq - 1.0).max(0.0).powi(9);
        assert!((f64::from(pixel[1]) - truth).abs() < HALF_STEP, "{x} {y}: {pixel:?} {truth}");
    }
}

/// A white wall, half ambient, with a light behind the camera and `objects` between them.
fn shaded(objects: &str) -> Picture {
    let comma = if objects.is_empty() { "" } else { "," };
    let keys = format!(
        r#""ambient": 0.25, "lights": [ {{ "point": {{ "position": [0, 0, 3], "color": 0.5 }} }} ],
        "materials": {{ "wall": {{ "diffuse": 1 }}, "smoke": {{ "transparency": 0.375 }} }},
        "objects": [ {{ "plane": {{ "point": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0],
        "material": "wall" }} }} {comma} {objects} ]"#
    );
    picture(&scene(&keys, &[("sheets.obj", SHEETS.to_vec())]), 48, Filter::Point)
}

/// Two large sheets, one behind the other, between the camera and the light.
const SHEETS: &[u8] = b"v -9 -9 1.5\nv 9 -9 1.5\nv 9 9 1.5\nv -9 9 1.5\n\
    v -9 -9 2\nv 9 -9 2\nv 9 9 2\nv -9 9 2\nf 1 2 3 4\nf 5 6 7 8\n";

/// Checks the wall behind a ball at z = 2 whose shadow has the radius 3 tan(asin 0.3) = 0.943. The
/// light is multiplied by `passed` in the shadow, and by 1 outside.
fn assert_shadow(shown: &Picture, passed: f32) {
    let free = shaded("");
    for ((x, y, pixel), free) in pixels(shown).zip(&free.pixels) {
        let [a, b] = on_film(x, y, 48);
        let in_shadow = a.hypot(b) < 3.0 * 0.3f64.asin().tan();
        let truth = if in_shadow { 0.25 + passed * (free[0] - 0.25) } else { free[0] };
        let tolerance = if in_shadow && passed > 0.0 { STEP } else { 0.0 };
        assert!((pixel[0] - truth).abs() <= tolerance, "at {x} {y}: {pixel:?}, expected {truth}");
    }
}

#[test]
fn behind_an_opaque_ball_there_is_ambient_light_exactly_and_beside_it_nothing_changes() {
    assert_shadow(&shaded(&sphere([0.0, 0.0, 2.0], 0.3, "wall")), 0.0);
}

#[test]
fn a_transparent_ball_dims_the_light_once_though_it_is_crossed_twice() {
    assert_shadow(&shaded(&sphere([0.0, 0.0, 2.0], 0.3, "smoke")), 0.375);
}

#[test]
fn a_transparent_mesh_dims_the_light_once_though_two_of_its_sheets_are_crossed() {
    let sheets = r#"{ "mesh": { "name": "sheets", "file": "sheets.obj", "material": "smoke" } }"#;
    let (free, dimmed) = (shaded(""), shaded(sheets));
    for (free, dimmed) in free.pixels.iter().zip(&dimmed.pixels) {
        let truth = 0.25 + 0.375 * (free[0] - 0.25);
        assert!((dimmed[0] - truth).abs() <= STEP, "{dimmed:?}, expected {truth}");
    }
}

#[test]
fn two_transparent_balls_dim_it_twice_and_an_opaque_one_takes_the_rest() {
    let smoke = sphere([0.0, 0.0, 2.0], 0.3, "smoke");
    assert_shadow(&shaded(&format!("{smoke}, {smoke}")), 0.375 * 0.375);
    let wall = sphere([0.0, 0.0, 2.0], 0.3, "wall");
    assert_shadow(&shaded(&format!("{smoke}, {wall}")), 0.0);
}

#[test]
fn a_ball_beyond_the_light_casts_no_shadow() {
    assert_eq!(shaded(&sphere([0.0, 0.0, 4.0], 0.9, "wall")), shaded(""));
}

#[test]
fn below_the_surface_of_glass_light_turns_back_beyond_the_critical_angle() {
    // The eye is one unit below the surface of water whose floor has colour 0.75. Straight up it
    // sees the background. Beyond asin(1/1.5) from the vertical it sees the floor, totally
    // reflected.
    let keys = r#""camera": { "eye": [0, -1, 0], "target": [0, 0, 0], "up": [0, 0, 1],
        "fov_deg": 140 }, "background": 0.5, "ambient": 1,
        "materials": { "water": { "ambient": 0, "diffuse": 0, "transparency": 1 },
        "floor": { "color": 0.75, "diffuse": 0 } },
        "objects": [ { "plane": { "point": [0, 0, 0], "edge_u": [0, 0, 1], "edge_v": [1, 0, 0],
        "material": "water" } }, { "plane": { "point": [0, -3, 0], "edge_u": [1, 0, 0],
        "edge_v": [0, 0, 1], "material": "floor" } } ]"#;
    let shown = picture(&scene(keys, &[]), 64, Filter::Point);
    let critical = (1.0f64 / 1.5).asin().tan() / 70f64.to_radians().tan();
    for (x, y, pixel) in pixels(&shown) {
        let [a, b] = on_film(x, y, 64);
        let truth = if a.hypot(b) > critical { 0.75 } else { 0.5 };
        assert_eq!(pixel, [truth; 3], "at {x} {y}");
    }
}

#[test]
fn a_right_angled_prism_turns_the_view_by_a_right_angle() {
    // Light that enters one leg of the prism perpendicularly meets the slope at 45 degrees. This is
    // beyond the critical angle of 41.8 degrees, so the light leaves through the other leg. A view
    // along +z therefore shows the floor.
    let prism = "v -1 -1 1\nv -1 -1 -1\nv -1 1 -1\nv 1 -1 1\nv 1 -1 -1\nv 1 1 -1\n\
        f 1 3 2\nf 4 5 6\nf 1 2 5 4\nf 2 3 6 5\nf 1 4 6 3\n";
    let prism = prism.as_bytes().to_vec();
    let keys = r#""camera": { "eye": [0.1, 0, -9], "target": [0.1, 0, 0], "fov_deg": 8 },
        "background": 0.125, "ambient": 1,
        "materials": { "prism": { "ambient": 0, "diffuse": 0, "transparency": 1 },
        "paint": { "color": [0.25, 0.5, 0.75], "diffuse": 0 } },
        "objects": [ { "mesh": { "name": "prism", "file": "prism.obj", "material": "prism" } },
        { "rectangle": { "corner": [-9, -5, -9], "edge_u": [18, 0, 0], "edge_v": [0, 0, 18],
        "material": "paint" } } ]"#;
    let shown = picture(&scene(keys, &[("prism.obj", prism)]), 24, Filter::Point);
    for (x, y, pixel) in pixels(&shown) {
        assert_eq!(pixel, [0.25, 0.5, 0.75], "at {x} {y}");
    }
}

#[test]
fn any_number_of_threads_and_any_repetition_gives_the_same_bytes() {
    let objects = [
        sphere([-0.3, 0.0, 0.3], 0.25, "glass"),
        sphere([0.4, 0.1, 0.4], 0.25, "mirror"),
        sphere([0.0, -0.5, 0.4], 0.2, "air"),
    ];
    let scene = before_checks(r#"{ "specular": 0.3, "reflectivity": 0.2 }"#, &objects.join(","));
    let first = supersampled(&scene, 70, 2, Filter::Tent);
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let again = pool.install(|| supersampled(&scene, 70, 2, Filter::Tent));
        assert!(again == first, "{threads} threads");
    }
}

#[test]
fn samples_are_the_average_of_a_larger_picture() {
    let objects =
        sphere([0.3, 0.1, 0.4], 0.3, "air") + "," + &sphere([-0.3, 0.0, 0.4], 0.3, "pane");
    let scene = before_checks(r#"{ "diffuse": 0.5 }"#, &objects);
    // Sizes are powers of two, so that both pictures send identical rays.
    for (samples, filter) in [(2, Filter::Point), (4, Filter::Point), (2, Filter::Tent)] {
        let large = picture(&scene, 24 * samples, filter);
        let small = supersampled(&scene, 24, samples, filter);
        for (x, y, pixel) in pixels(&small) {
            for (k, &light) in pixel.iter().enumerate() {
                let inside = |n: u32| (0..samples).map(move |d| n * samples + d);
                let sum: f64 = inside(y)
                    .flat_map(|y| inside(x).map(move |x| (x, y)))
                    .map(|(x, y)| f64::from(at(&large, x, y)[k]))
                    .sum();
                let average = sum / f64::from(samples * samples);
                // The larger picture was rounded to f32 once more.
                assert!((f64::from(light) - average).abs() <= 1.2e-7, "at {x} {y} {k}");
            }
        }
    }
}

#[test]
fn samples_of_black_and_white_texels_are_averaged_exactly() {
    let keys = r#""ambient": 1, "textures": { "checks": { "image": "checks.png" } },
        "materials": { "wall": { "diffuse": 0 } }, "objects": [ { "plane": { "point": [0.2, 0.1, 0],
        "edge_u": [0.3, 0.1, 0], "edge_v": [0, 0.3, 0], "material": "wall", "texture": "checks" } } ]"#;
    let scene = scene(keys, &[("checks.png", png(2, &[[255; 3], [0; 3], [0; 3], [255; 3]]))]);
    let (large, small) =
        (picture(&scene, 96, Filter::Point), supersampled(&scene, 24, 4, Filter::Point));
    for (x, y, pixel) in pixels(&small) {
        let white: f32 = (0..16).map(|k| at(&large, 4 * x + k % 4, 4 * y + k / 4)[0]).sum();
        assert_eq!(pixel, [white / 16.0; 3], "at {x} {y}");
    }
}
