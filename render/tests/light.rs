//! Lights against closed forms: fall-off, directions and colours by angle; and faults that are
//! refused.

use crate::studio;

use files::json::Document;
use fixtures::rounding::STEP;
use render::Picture;
use render::filter::Filter;
use render::scene::read;
use studio::{assert_near, on_film, picture, pixels, scene};

/// Renders a wall with these material keys under these lights, with `objects` in front of it.
fn lit(lights: &str, wall: &str, objects: &str) -> Picture {
    let comma = if objects.is_empty() { "" } else { "," };
    let keys = format!(
        r#""ambient": 0, "lights": [ {lights} ], "materials": {{ "wall": {{ {wall} }},
        "white": {{}} }}, "objects": [ {{ "plane": {{ "point": [0, 0, 0], "edge_u": [1, 0, 0],
        "edge_v": [0, 1, 0], "material": "wall" }} }} {comma} {objects} ]"#
    );
    picture(&scene(&keys, &[]), 32, Filter::Point)
}

/// Checks each channel of each pixel against a closed form in the position on the wall.
fn assert_is(shown: &Picture, truth: impl Fn(f64, f64) -> [f64; 3]) {
    for (x, y, pixel) in pixels(shown) {
        let [a, b] = on_film(x, y, shown.width);
        for (light, truth) in pixel.into_iter().zip(truth(a, b)) {
            let off = (f64::from(light) - truth).abs();
            // Half a step of f32 is at most 2^-24 of a light above 1.
            assert!(
                off <= f64::from(STEP) * truth.max(1.0),
                "at {x} {y}: {pixel:?}, expected {truth}"
            );
        }
    }
}

#[test]
fn light_fades_with_the_square_of_the_distance() {
    for (height, reference) in [(0.5, 1.0), (2.0, 1.0), (2.0, 4.0), (30.0, 10.0)] {
        let light = format!(
            r#"{{ "point": {{ "position": [0, 0, {height}], "color": [1, 0.5, 0.25],
            "falloff": {{ "quadratic": 1, "reference": {reference} }} }} }}"#
        );
        assert_is(&lit(&light, r#""diffuse": 0.8"#, ""), |a, b| {
            let distance = (a * a + b * b + height * height).sqrt();
            let bright = 0.8 * height / distance * (reference / distance).powi(2);
            [bright, 0.5 * bright, 0.25 * bright]
        });
    }
}

#[test]
fn a_directional_light_is_a_point_light_far_away() {
    let ball = r#"{ "sphere": { "center": [0.2, 0.1, 0.5], "radius": 0.3, "material": "white" } }"#;
    let wall = r#""diffuse": 0.8, "specular": 0.5"#;
    let sun = r#"{ "directional": { "direction": [-1e-200, -0.5e-200, -2e-200] } }"#;
    let far = r#"{ "point": { "position": [1e9, 0.5e9, 2e9] } }"#;
    // The directions differ by 1e-9, and the colours by less than a step of f32.
    assert_near(&lit(sun, wall, ball), &lit(far, wall, ball), STEP);
}

#[test]
fn the_way_to_a_directional_light_has_no_end() {
    let sun = r#"{ "directional": { "direction": [0, 0, -1] } }"#;
    let bare = lit(sun, r#""diffuse": 0.5"#, "");
    assert_is(&bare, |_, _| [0.5; 3]);
    let moon = r#"{ "sphere": { "center": [0, 0, 1e9], "radius": 1e6, "material": "white" } }"#;
    assert_is(&lit(sun, r#""diffuse": 0.5"#, moon), |_, _| [0.0; 3]);
    // A directional light does not shine through the wall from behind.
    let below = r#"{ "directional": { "direction": [0, 0, 1] } }"#;
    assert_is(&lit(below, r#""diffuse": 0.5"#, ""), |_, _| [0.0; 3]);
}

#[test]
fn a_light_on_a_surface_or_where_a_ray_lands_leaves_every_color_finite() {
    // Middle of pixel (16, 15) of 32, at the wall and just above it.
    let place = 1.0 / 32.0;
    for height in [0.0, 1e-300, 1e-12, 1e-3] {
        let light = format!(
            r#"{{ "point": {{ "position": [{place}, {place}, {height:e}],
            "falloff": {{ "quadratic": 1 }} }} }}"#
        );
        let shown = lit(&light, r#""diffuse": 1, "specular": 1"#, "");
        let bright = shown.pixels.iter().flatten().fold(0.0f32, |most, &light| most.max(light));
        // Diffuse light and a highlight, each at most a million times the light.
        assert!(bright <= 2e6, "{bright}");
        assert!(height > 0.0 || bright == 0.0, "it lies in the plane of the wall: {bright}");
    }
}

#[test]
fn colors_by_the_angle_follow_the_light_and_not_the_view() {
    let wall = r#""diffuse": 0.5, "by_angle": [[0, [1, 0, 0]], [30, [0, 1, 0]], [60, [0, 0, 1]]]"#;
    let light = r#"{ "point": { "position": [0.3, 0.2, 0.7] } }"#;
    assert_is(&lit(light, wall, ""), |a, b| {
        let flat = (a - 0.3).hypot(b - 0.2);
        let angle = flat.atan2(0.7).to_degrees();
        let bright = 0.5 * 0.7 / flat.hypot(0.7);
        let near = |stop: f64| (1.0 - (angle.min(60.0) - stop).abs() / 30.0).max(0.0);
        [0.0, 30.0, 60.0].map(|stop| bright * near(stop))
    });
}

#[test]
fn a_mirror_is_tinted_by_the_angle_of_the_view() {
    let keys = r#""background": [1, 0.5, 0.25], "materials": { "wall": { "ambient": 0, "diffuse": 0,
        "reflectivity": 1, "by_angle": [[0, [1, 1, 0]], [90, [0, 1, 1]]] } },
        "objects": [ { "plane": { "point": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0],
        "material": "wall" } } ]"#;
    assert_is(&picture(&scene(keys, &[]), 32, Filter::Point), |a, b| {
        let part = a.hypot(b).atan().to_degrees() / 90.0;
        [1.0 - part, 0.5, 0.25 * part]
    });
}

#[test]
fn a_film_shows_other_colors_at_other_angles() {
    let wall = r#""diffuse": 1, "thin_film": { "thickness_nm": 420 }"#;
    let light = r#"{ "point": { "position": [0, 0, 0.6] } }"#;
    let shown = lit(light, wall, "");
    let hue = |x: u32| {
        let [r, g, b] = studio::at(&shown, x, 16);
        [r, g, b].map(|light| light / (r + g + b))
    };
    let (middle, edge) = (hue(16), hue(31));
    assert!((0..3).any(|k| (middle[k] - edge[k]).abs() > 0.2), "{middle:?} {edge:?}");
}

/// Asserts that a scene with these keys is refused with these words.
fn refuse(keys: &str, parts: &[&str]) {
    let text = format!(
        r#"{{ "format": "tb-scene", "version": 1, "objects": [],
"camera": {{ "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 }},
{keys} }}"#
    );
    let document = Document::new("scene.json", text.as_bytes()).expect("it is text");
    let source = files::Disk;
    let refused = read::parse(&document).and_then(|file| {
        read::resolve(&document, &file, "".as_ref(), &source, read::MeshSource::new())
    });
    let message = refused.expect_err(keys).to_string();
    for part in [&["scene.json:3:"], parts].concat() {
        assert!(message.contains(part), "{message:?} lacks {part:?}");
    }
    assert_eq!(message.lines().count(), 1, "{message}");
}

#[test]
fn lights_out_of_range_are_refused_with_their_place() {
    let light = |light: &str, parts: &[&str]| refuse(&format!(r#""lights": [ {light} ]"#), parts);
    let point = |more: &str, parts: &[&str]| {
        light(&format!(r#"{{ "point": {{ "position": [0, 0, 0], {more} }} }}"#), parts);
    };
    point(r#""falloff": {}"#, &["lights[0].point.falloff: found", "\"quadratic\" above 0"]);
    point(r#""falloff": { "linear": -1 }"#, &["falloff.linear: found -1, expected at least 0"]);
    point(
        r#""falloff": { "linear": 1, "reference": 0 }"#,
        &["falloff.reference: found 0, expected more than 0"],
    );
    point(r#""falloff": { "square": 1 }"#, &["unknown key", "square"]);
    light(
        r#"{ "directional": { "direction": [0, 0, 0] } }"#,
        &["lights[0].directional.direction: found a direction without length"],
    );
    light(r#"{ "directional": {} }"#, &["missing key `direction`"]);
    light(
        r#"{ "directional": { "direction": [0, 1, 0], "color": -1 } }"#,
        &["lights[0].directional.color: found -1"],
    );
}

#[test]
fn materials_out_of_range_are_refused_with_their_place() {
    let material = |keys: &str, parts: &[&str]| {
        refuse(&format!(r#""materials": {{ "m": {{ {keys} }} }}"#), parts);
    };
    material(
        r#""absorption": [0, -1, 0]"#,
        &["materials.m.absorption: found -1, expected at least 0"],
    );
    material(r#""priority": 256"#, &["materials.m.priority", "256"]);
    material(r#""priority": -1"#, &["materials.m.priority", "-1"]);
    material(r#""by_angle": []"#, &["materials.m.by_angle: found no angles"]);
    material(r#""by_angle": [[0, 1], [0, 1]]"#, &["materials.m.by_angle: found", "ascend"]);
    material(r#""by_angle": [[0, 1], [91, 1]]"#, &["by_angle[1][0]: found 91, expected 0 to 90"]);
    material(r#""by_angle": [[0, -1]]"#, &["by_angle[0][1]: found -1, expected at least 0"]);
    material(r#""by_angle": [[0]]"#, &["materials.m.by_angle[0]"]);
    material(
        r#""thin_film": { "thickness_nm": 0 }"#,
        &["thickness_nm: found 0, expected 1 to 5000"],
    );
    material(
        r#""thin_film": { "thickness_nm": 100, "index": 0.9 }"#,
        &["thin_film.index: found 0.9, expected 1 to 5"],
    );
    material(r#""thin_film": {}"#, &["missing key `thickness_nm`"]);
    material(
        r#""by_angle": [[0, 1]], "thin_film": { "thickness_nm": 100 }"#,
        &["materials.m.by_angle: found this key beside \"thin_film\""],
    );
}
