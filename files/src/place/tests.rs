//! Tests of places: known images of points, and sentences about faults.

use super::*;
use crate::json::Document;

fn read(text: &str) -> Result<Place, String> {
    let document = Document::new("p.json", text.as_bytes()).unwrap();
    document.parse().map_err(|error| error.to_string())
}

fn image(text: &str, point: [f64; 3]) -> DVec3 {
    let map = read(text).unwrap().map().unwrap();
    let image = map.there.transform_point3(DVec3::from(point));
    assert!(map.back.transform_point3(image).abs_diff_eq(DVec3::from(point), 1e-12), "{text}");
    image
}

#[test]
fn the_examples_on_this_page_are_read_and_mean_what_it_says() {
    let page = include_str!("../place.rs");
    let lines = page.lines().skip_while(|line| *line != "//! ```json").skip(1);
    let text: String = lines
        .take_while(|line| *line != "//! ```")
        .map(|line| line.trim_start_matches("//!").to_string() + "\n")
        .collect();
    let document = Document::new("page", text.as_bytes()).unwrap();
    let places: Vec<Place> = document.parse().unwrap();
    assert_eq!(places.len(), 2);
    // The first scales (0, 0, 2) to (0, 0, 1), turns it toward x by 30 degrees, and moves it up.
    let image = places[0].map().unwrap().there.transform_point3(DVec3::Z * 2.0);
    assert!(image.abs_diff_eq(DVec3::new(0.5, 1.0, 0.75_f64.sqrt()), 1e-15), "{image}");
}

#[test]
fn keys_of_a_step_apply_in_their_order_and_equal_a_list() {
    let one = r#"{ "translate": [5, 0, 0], "rotate_deg": [0, 0, 90], "scale": 2 }"#;
    let list = r#"[{ "scale": [2, 2, 2] }, { "rotate_deg": { "axis": [0, 0, 7], "angle": 90 } }, { "translate": [5, 0, 0] }]"#;
    let matrix = r#"{ "matrix": [[0, -2, 0, 5], [2, 0, 0, 0], [0, 0, 2, 0]] }"#;
    for place in [one, list, matrix] {
        assert_eq!(image(place, [1.0, 0.0, 0.0]), DVec3::new(5.0, 2.0, 0.0), "{place}");
    }
    for nothing in ["[]", "{}", "[{}]"] {
        assert_eq!(image(nothing, [1.0, 2.0, 3.0]), DVec3::new(1.0, 2.0, 3.0));
    }
    // z is turned about x to -y, which the rotation about y leaves unchanged.
    assert_eq!(image(r#"{ "rotate_deg": [90, 90, 0] }"#, [0.0, 0.0, 1.0]), DVec3::NEG_Y);
    assert_eq!(image(r#"{ "scale": [1, -1, 3] }"#, [1.0; 3]), DVec3::new(1.0, -1.0, 3.0));
}

#[test]
fn turns_are_counter_clockwise_and_quarters_exact() {
    let turn = |axis, angle| Rotation::About(Turn { axis, angle }).matrix();
    let of = |axis, angle| turn(axis, angle).unwrap();
    assert_eq!(of([0.0, 3.0, 0.0], 90.0) * DVec3::Z, DVec3::X);
    assert_eq!(of([0.0, 0.0, 1.0], -450.0) * DVec3::X, DVec3::NEG_Y);
    assert_eq!(of([1.0, 0.0, 0.0], 720.0), DMat3::IDENTITY);
    let truth = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.3);
    let ours = of([3.0, 0.0, 4.0], 0.3f64.to_degrees());
    assert!(ours.abs_diff_eq(truth, 1e-15), "{ours}");
    assert!(turn([0.0; 3], 1.0).is_none());
    // The three angles are those of the usual matrices, the last one leftmost.
    let [x, y, z] = [0.3, 1.1, -0.7];
    let truth = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
    let ours = Rotation::Angles([x, y, z].map(f64::to_degrees)).matrix().unwrap();
    assert!(ours.abs_diff_eq(truth, 1e-15), "{ours}");
}

#[test]
fn a_place_is_written_as_it_was_read() {
    for text in [
        r#"{"scale":2.0}"#,
        r#"[{"scale":[1.0,2.0,3.0],"rotate_deg":[0.0,90.0,0.0]},{"matrix":[[1.0,0.0,0.0,0.0],[0.0,1.0,0.0,0.0],[0.0,0.0,1.0,4.0]]}]"#,
        r#"[{"rotate_deg":{"axis":[0.0,1.0,0.0],"angle":30.0}},{"translate":[1.0,0.0,0.0]}]"#,
    ] {
        assert_eq!(serde_json::to_string(&read(text).unwrap()).unwrap(), text);
    }
}

#[test]
fn faults_have_their_path() {
    let fault = |text: &str| {
        let fault = read(text).unwrap().map().unwrap_err();
        format!("{}: {}", fault.path, fault.message)
    };
    assert_eq!(
        fault(r#"[{"scale": [1, 0, 1]}]"#),
        "[0].scale[1]: found 0, expected any other number"
    );
    assert!(fault(r#"{"scale": 0}"#).starts_with(".scale: found 0"));
    assert!(
        fault(r#"[{"scale": 1}, {"rotate_deg": {"axis": [0, 0, 0], "angle": 1}}]"#)
            .starts_with("[1].rotate_deg.axis: found an axis without length")
    );
    assert!(
        fault(r#"{"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]], "scale": 1}"#)
            .starts_with(".matrix: found other keys beside `matrix`")
    );
    for (text, parts) in [
        (r#"[{"scale": "2"}]"#, ["p.json:1:", "[0].scale", "a factor or three factors [x, y, z]"]),
        (r#"{"scale": [1, 2]}"#, ["p.json:1:", "scale", "3"]),
        (
            r#"[{"rotate_deg": 30}]"#,
            ["p.json:1:", "[0].rotate_deg", "three angles [x, y, z] in degrees"],
        ),
        (r#"[{"turn": 30}]"#, ["p.json:1:", "[0].turn", "expected one of `scale`, `rotate_deg`"]),
        ("3", ["p.json:1:", "a step (an object) or a list of steps", ""]),
    ] {
        let said = read(text).unwrap_err();
        assert!(parts.iter().all(|part| said.contains(part)), "{text}: {said}");
    }
}
