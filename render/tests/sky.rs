//! The sky against closed forms: seen directly, mirrored, and through glass; and faults that are
//! refused.

use crate::studio;

use files::json::Document;
use fixtures::rounding::HALF_STEP;
use render::filter::Filter;
use render::scene::file::SceneFile;
use render::scene::{read, schema};
use serde_json::{Value, json};
use studio::{FILTERS, at, picture, pixels, scene, supersampled};

/// A sky whose horizon is one degree sharp, with colours below it.
const SKY: &str = r#""background": { "by_elevation": [[-60, [0.1, 0, 0]], [-1, [0.5, 0.25, 0.125]],
    [0, 0.75], [30, [0.25, 0.5, 1]]] }, "ambient": 0,"#;

/// Returns the colour of [`SKY`] at an elevation in degrees.
fn sky(elevation: f64) -> [f64; 3] {
    let stops = [
        (-60.0, [0.1, 0.0, 0.0]),
        (-1.0, [0.5, 0.25, 0.125]),
        (0.0, [0.75; 3]),
        (30.0, [0.25, 0.5, 1.0]),
    ];
    let elevation = elevation.clamp(-60.0, 30.0);
    let (low, high) = match elevation {
        x if x < -1.0 => (stops[0], stops[1]),
        x if x < 0.0 => (stops[1], stops[2]),
        _ => (stops[2], stops[3]),
    };
    let part = (elevation - low.0) / (high.0 - low.0);
    std::array::from_fn(|k| low.1[k] + part * (high.1[k] - low.1[k]))
}

/// Returns the elevation, in degrees, of the ray through a pixel of the usual camera, which looks
/// along -z.
fn elevation(x: u32, y: u32, side: u32) -> f64 {
    let [a, b] = studio::on_film(x, y, side);
    b.atan2(a.hypot(1.0)).to_degrees()
}

#[track_caller]
fn assert_pixel(shown: [f32; 3], truth: [f64; 3], tolerance: f64) {
    let near = shown.iter().zip(truth).all(|(&a, b)| (f64::from(a) - b).abs() <= tolerance);
    assert!(near, "{shown:?}, expected {truth:?}");
}

#[test]
fn a_sky_is_what_its_stops_say_at_each_elevation() {
    for filter in FILTERS {
        let shown = picture(&scene(&format!(r#"{SKY} "objects": []"#), &[]), 33, filter);
        for (x, y, pixel) in pixels(&shown) {
            assert_pixel(pixel, sky(elevation(x, y, 33)), HALF_STEP);
        }
    }
}

#[test]
fn a_level_mirror_shows_the_sky_upside_down() {
    let keys = format!(
        r#"{SKY} "materials": {{ "mirror": {{ "diffuse": 0, "reflectivity": 1 }} }}, "objects": [
        {{ "plane": {{ "point": [0, -1, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
        "material": "mirror" }} }} ]"#
    );
    let shown = picture(&scene(&keys, &[]), 32, Filter::Tent);
    for (x, y, pixel) in pixels(&shown) {
        assert_pixel(pixel, sky(elevation(x, y, 32).abs()), HALF_STEP);
    }
}

#[test]
fn a_pane_with_parallel_faces_shows_the_sky_in_its_place() {
    let keys = format!(
        r#"{SKY} "materials": {{ "pane": {{ "diffuse": 0, "transparency": 0.9,
        "index_of_refraction": 1.5 }} }}, "objects": [ {{ "box": {{ "low": [-9, -9, -0.5],
        "high": [9, 9, 0], "material": "pane" }} }} ]"#
    );
    let shown = picture(&scene(&keys, &[]), 32, Filter::Tent);
    for (x, y, pixel) in pixels(&shown) {
        let truth = sky(elevation(x, y, 32)).map(|light| 0.9 * 0.9 * light);
        // Two refractions round the direction by a few units in the last place. The sky's steepest
        // slope is 0.6 per degree.
        assert_pixel(pixel, truth, HALF_STEP);
    }
}

#[test]
fn one_stop_and_equal_stops_are_a_plain_background() {
    let ball = r#""materials": { "glass": { "diffuse": 0, "reflectivity": 1, "transparency": 1,
        "fresnel": true } }, "objects": [ { "sphere": { "center": [0.1, 0.2, 0], "radius": 0.5,
        "material": "glass" } } ]"#;
    let of = |background: &str| {
        supersampled(
            &scene(&format!(r#""background": {background}, {ball}"#), &[]),
            16,
            2,
            Filter::Tent,
        )
    };
    let plain = of("[0.25, 0.5, 0.75]");
    for stops in
        ["[[10, [0.25, 0.5, 0.75]]]", "[[-90, [0.25, 0.5, 0.75]], [90, [0.25, 0.5, 0.75]]]"]
    {
        let shown = of(&format!(r#"{{ "by_elevation": {stops} }}"#));
        assert!(shown.pixels == plain.pixels, "{stops}");
    }
    assert!(at(&plain, 0, 0) == [0.25, 0.5, 0.75]);
}

#[test]
fn a_sky_that_is_none_is_refused_with_its_place_by_reader_and_schema_alike() {
    let schema = schema::of_scene();
    let validator = jsonschema::validator_for(&schema).expect("it is a schema");
    let with = |background: Value| {
        json!({ "format": "tb-scene", "version": 1, "background": background, "objects": [],
            "camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 } })
    };
    let said = |scene: &Value| -> Option<String> {
        let text = scene.to_string();
        let document = Document::new("scene.json", text.as_bytes()).expect("it is JSON");
        let read = read::parse(&document).and_then(|file| {
            let source = files::Disk;
            read::resolve(&document, &file, "".as_ref(), &source, read::MeshSource::new())
        });
        read.err().map(|error| error.to_string())
    };
    for taken in [
        json!(null),
        json!(0.5),
        json!([0, 1, 2]),
        json!({ "by_elevation": [[-90, 0], [90, [0, 0, 1]]] }),
    ] {
        let scene = with(taken);
        assert!(validator.is_valid(&scene), "{scene}");
        assert_eq!(said(&scene), None, "{scene}");
    }
    // Both refuse a wrong form; only the reader refuses a value out of range.
    for (background, part, form) in [
        (json!("blue"), "background: found the string \"blue\", expected a colour", true),
        (json!({}), "background: expected by_elevation, or picture", true),
        (json!({ "by_elevation": [[0, 1]], "haze": 1 }), "unknown key `haze`", true),
        (json!({ "by_elevation": [[0]] }), "background.by_elevation[0]", true),
        (json!({ "by_elevation": [] }), "background.by_elevation: found no angles", false),
        (json!({ "by_elevation": [[1, 1], [1, 1]] }), "each angle larger than the one", false),
        (
            json!({ "by_elevation": [[-91, 1]] }),
            "by_elevation[0][0]: found -91, expected -90",
            false,
        ),
        (json!({ "by_elevation": [[0, [0, -1, 0]]] }), "by_elevation[0][1]: found -1", false),
    ] {
        let scene = with(background);
        let message = said(&scene).unwrap_or_else(|| panic!("{scene} is taken"));
        assert!(message.starts_with("scene.json:1:") && message.contains(part), "{message}");
        assert_eq!(serde_json::from_value::<SceneFile>(scene.clone()).is_err(), form, "{scene}");
        assert!(!form || !validator.is_valid(&scene), "the schema takes {scene}");
    }
}
