//! Hints of the check about where a contour lies and how its frame turns.

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
