//! Hints of the check about contours, frames, reliefs, surfaces of one side and prints.

use files::json::Document;
use serde_json::{Value, json};
use std::path::Path;
use sweep::check::{Finding, Severity, check};
use sweep::{Object, spec::Resolution};

fn findings(keys: &Value) -> Vec<Finding> {
    let mut spec = json!({ "format": "tb-sweep", "version": 1, "name": "a" });
    for (key, value) in keys.as_object().unwrap() {
        spec[key] = value.clone();
    }
    let text = spec.to_string();
    let document = Document::new("a.json", text.as_bytes()).unwrap();
    let object =
        Object::read(&document, Path::new(""), &files::Disk, &Resolution::default()).unwrap();
    check(&object, &object.grids().unwrap(), None)
}

/// Returns whether a finding of this severity about this path contains these words.
fn says(found: &[Finding], severity: Severity, path: &str, words: &str) -> bool {
    found
        .iter()
        .any(|one| one.severity == severity && one.path == path && one.message.contains(words))
}

#[test]
fn a_contour_far_from_its_origin_is_told_to_be_centred() {
    let rail = |center: bool| {
        json!({
            "contour": { "svg": "M100 160h20v-10h-20z", "center": center },
            "trajectory": { "polyline": { "points": [[0, 0, 0], [300, 0, 0], [300, 200, 0]], "corners": { "round": 60 } } },
            "mesh": { "rows": 40, "cols": 8 },
        })
    };
    assert!(says(&findings(&rail(false)), Severity::Hint, "contour", "times its size"));
    assert_eq!(findings(&rail(true)), []);
}

#[test]
fn a_profile_drawn_downward_faces_its_axis() {
    let vase = |points: Value| {
        json!({
            "contour": { "free": { "points": points } }, "trajectory": { "rotation": {} }, "mesh": { "tol": 0.01 },
        })
    };
    let down = findings(&vase(json!([[3, 10], [2, 7], [3.5, 4], [2.5, 0]])));
    assert!(says(&down, Severity::Remark, "contour", "drawn downward"), "{down:?}");
    assert_eq!(findings(&vase(json!([[2.5, 0], [3.5, 4], [2, 7], [3, 10]]))), []);
}

#[test]
fn a_profile_that_almost_meets_its_axis_leaves_a_hole() {
    let bowl = |x: f64| {
        json!({
            "contour": { "polyline": { "points": [[x, 0], [2, 0.2], [3, 2]] } },
            "trajectory": { "rotation": {} }, "mesh": { "rows": 32, "cols": 8 },
        })
    };
    let found = findings(&bowl(0.01));
    assert!(says(&found, Severity::Hint, "contour", "leaves a hole"), "{found:?}");
    assert_eq!(findings(&bowl(0.0)), []);
}

#[test]
fn an_upright_frame_spins_where_the_trajectory_is_nearly_vertical() {
    let coaster = |frame: Value| {
        json!({
            "contour": { "polyline": { "closed": true, "points": [[0.5, -0.1], [0.5, 0.1], [-0.5, 0.1], [-0.5, -0.1]] } },
            "trajectory": { "free": { "points": [[0, 0, 0], [10, 0, 0], [15, 2, 1], [21.8, 0.3, 1], [25.6, 3.8, 1.5],
                [25.2, 9.0, 2], [20, 12, 2.5], [15.1, 9.4, 3], [14.2, 4.3, 3.5], [17.8, 0.4, 4], [25, 2, 5], [35, 0, 5]] } },
            "frame": frame, "mesh": { "tol": 0.01 },
        })
    };
    let found = findings(&coaster(json!({ "up": [0, 1, 0] })));
    assert!(says(&found, Severity::Hint, "frame.up", "within the contour's width"), "{found:?}");
    assert_eq!(findings(&coaster(json!({ "start": [0, 0, 1] }))), []);
}

/// Returns a cylinder with a relief, with other keys over it.
fn raised(keys: &Value) -> Value {
    let mut spec = json!({
        "contour": { "circle": 2 }, "trajectory": { "line": [[0, 0, 0], [0, 0, 3]] },
        "depth": { "mode": "offset", "terms": [{ "amp": 0.1, "u": 4 }] },
        "mesh": { "rows": 40, "cols": 60 },
    });
    for (key, value) in keys.as_object().unwrap() {
        spec[key] = value.clone();
    }
    spec
}

#[test]
fn a_relief_that_a_scale_changes_is_told_with_its_heights() {
    assert_eq!(findings(&raised(&json!({}))), []);
    let scaled = findings(&raised(&json!({ "scale": { "total": 3 }, "caps": { "end": "flat" } })));
    assert!(
        says(&scaled, Severity::Remark, "depth", "heights of 0.1 become 0 to 0.3 on the surface"),
        "{scaled:?}"
    );
}

#[test]
fn a_picture_finer_than_the_cells_is_told_with_numbers_that_do() {
    let example = |rows: usize, cols: usize| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves");
        let text = std::fs::read(format!("{folder}/relief-vase.json")).unwrap();
        let document = Document::new("a.json", &text).unwrap();
        let counts = Resolution { rows: Some(rows), cols: Some(cols), ..Resolution::default() };
        let object = Object::read(&document, Path::new(folder), &files::Disk, &counts).unwrap();
        check(&object, &object.grids().unwrap(), None)
    };
    // Pictures of 64 x 64 texels, 18 across and 10 up.
    let found = example(40, 60);
    let words = "640 rows and 1152 cols would show every texel";
    assert!(says(&found, Severity::Hint, "depth.image", words), "{found:?}");
    let enough = example(640, 1152);
    assert!(!says(&enough, Severity::Hint, "depth.image", ""), "{enough:?}");
}

#[test]
fn a_surface_of_one_side_is_told_to_take_a_wall_and_a_print_its_axis() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves");
    let text = std::fs::read(format!("{folder}/klein-bottle.json")).unwrap();
    let mut spec: Value = serde_json::from_slice(&text).unwrap();
    spec["mesh"] = json!({ "rows": 200, "cols": 60 });
    spec["areas"] = json!([]);
    assert!(says(&findings(&spec), Severity::Remark, "seam", "`\"wall\": thickness`"));
    spec["wall"] = json!(0.05);
    assert!(!says(&findings(&spec), Severity::Remark, "seam", "`\"wall\": thickness`"));
    let caps = json!({ "start": "flat", "end": "flat" });
    let printed = findings(&raised(&json!({ "unit": "mm", "caps": caps })));
    assert!(says(&printed, Severity::Remark, "unit", "`triangulate --up z`"), "{printed:?}");
}

#[test]
fn a_piece_of_five_points_is_told_that_it_takes_four() {
    let text = json!({
        "format": "tb-sweep", "version": 1, "name": "a",
        "contour": { "bezier": { "segments": [[[0, 0], [1, 0], [2, 0], [3, 1], [4, 4]]] } },
        "trajectory": { "line": [[0, 0, 0], [0, 0, 1]] }, "mesh": { "rows": 2, "cols": 8 },
    })
    .to_string();
    let document = Document::new("a.json", text.as_bytes()).unwrap();
    let read = Object::read(&document, Path::new(""), &files::Disk, &Resolution::default());
    let message = read.unwrap_err().to_string();
    assert!(message.contains("contour.bezier.segments[0]"), "{message}");
    assert!(message.contains("found 5 points, expected four per piece"), "{message}");
}
