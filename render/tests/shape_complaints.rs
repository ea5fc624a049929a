//! Bad shapes and placements give one sentence with the position of the fault.

use crate::bench;

use bench::{Bench, MESH_WALL, WALL, WALL_OBJ};

/// Asserts that the wall's scene with this object in front of the wall is refused with these words.
fn refuse(object: &str, parts: &[&str]) {
    let scene = WALL.replacen("{ \"rectangle\"", &format!("{object}, {{ \"rectangle\""), 1);
    Bench::with_scene(&scene).refuse(&["scene.json"], b"", 3, parts);
}

fn cuboid(low: &str, high: &str, more: &str) -> String {
    format!(r#"{{ "box": {{ "low": {low}, "high": {high}, "material": "wall" {more} }} }}"#)
}

fn superquadric(radii: &str, exponents: &str, more: &str) -> String {
    format!(
        r#"{{ "superquadric": {{ "center": [0, 0, 0], "radii": {radii}, "exponents": {exponents}, "material": "wall" {more} }} }}"#
    )
}

#[test]
fn boxes_without_room_are_refused() {
    refuse(
        &cuboid("[0, 0, 0]", "[1, 0, 1]", ""),
        &["scene.json:5:", "objects[0].box.high[1]: found 0, expected more than 0"],
    );
    refuse(&cuboid("[0, 0, 2]", "[1, 1, 1]", ""), &["scene.json:5:", "box.high[2]: found 1"]);
    refuse(&cuboid("[0, 0]", "[1, 1, 1]", ""), &["scene.json:5:", "box.low"]);
    // A case that the fuzzer found: the tree over all boxes panicked.
    refuse(
        &cuboid("[0, 0, 0]", "[1, 1, 1e308]", ", \"place\": [ { \"translate\": [1, 0, 0.1] } ]"),
        &["scene.json:5:", "objects[0].box.high[2]: found 1e308, expected -1e30 to 1e30"],
    );
    refuse(&cuboid("[0, 0, 0]", "[1, 1, 1]", ", \"radius\": 1"), &["scene.json:5:", "radius"]);
    refuse(
        &cuboid("[0, 0, 0]", "[1, 1, 1]", "").replace("wall", "wal"),
        &["scene.json:5:", "objects[0].box.material: ", "(did you mean \"wall\"?)"],
    );
}

#[test]
fn superquadrics_out_of_range_are_refused_with_it() {
    let at = "objects[0].superquadric.";
    refuse(
        &superquadric("[1, 1, 1]", "[1, 1]", "").replace("[0, 0, 0]", "[0, -1e308, 0]"),
        &["scene.json:5:", at, "center[1]: found -1e308, expected -1e30 to 1e30"],
    );
    refuse(
        &superquadric("[1, 0, 1]", "[1, 1]", ""),
        &["scene.json:5:", at, "radii[1]: found 0, expected more than 0"],
    );
    refuse(
        &superquadric("[1, 1, 1]", "[0.01, 1]", ""),
        &["scene.json:5:", at, "exponents[0]: found 0.01, expected 0.05 to 4"],
    );
    refuse(&superquadric("[1, 1, 1]", "[1, 5]", ""), &["scene.json:5:", at, "exponents[1]"]);
    refuse(&superquadric("[1, 1, 1]", "[1]", ""), &["scene.json:5:", at, "exponents"]);
    refuse(
        &superquadric("[1, 1, 1]", "[1, 1]", ", \"ring\": 0.5"),
        &["scene.json:5:", at, "ring: found 0.5, expected 1 to 1000"],
    );
}

#[test]
fn placements_that_cannot_be_are_refused() {
    let placed = |steps: &str, parts: &[&str]| {
        let place = format!(", \"place\": {steps}");
        let parts = [&["scene.json:5:", "objects[0].box.place"], parts].concat();
        refuse(&cuboid("[0, 0, 0]", "[1, 1, 1]", &place), &parts);
    };
    placed("[ { \"scale\": [1, 0, 1] } ]", &["place[0].scale[1]: found 0, expected any other"]);
    placed(
        "[ { \"translate\": [1, 0, 1] }, { \"rotate_deg\": { \"axis\": [0, 0, 0], \"angle\": 1 } } ]",
        &["place[1].rotate_deg.axis: found an axis without length"],
    );
    placed(
        "[ { \"scale\": [1, 1, 1e9] } ]",
        &["place: found a transform that flattens the object"],
    );
    placed(
        "[ { \"matrix\": [[1, 0, 0, 0], [0, 1, 0, 0], [1, 1, 0, 0]] } ]",
        &["place: found a transform that flattens the object"],
    );
    placed(
        "[ { \"scale\": [1e70, 1e70, 1e70] } ]",
        &["place: found a transform that stretches too much"],
    );
    placed(
        "[ { \"scale\": [1e200, 1, 1] }, { \"scale\": [1e200, 1, 1] } ]",
        &["place: found a transform that stretches too much"],
    );
    placed(
        "[ { \"translate\": [0, -1.7e308, 0] } ]",
        &["place: found a transform that moves points by more than 1e60"],
    );
    placed("[ { \"matrix\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } ]", &["place[0].matrix"]);
    placed("[ { \"rotate\": 1 } ]", &["place[0]", "expected one of `scale`, `rotate_deg`"]);
    placed("{ \"scale\": [1, 0, 1] }", &["place.scale[1]: found 0"]);
    placed("3", &["place", "a step (an object) or a list of steps"]);
}

#[test]
fn meshes_that_are_placed_beyond_their_numbers_are_refused() {
    let scene = |place: &str| {
        MESH_WALL
            .replace("\"name\": \"wall\"", &format!("\"name\": \"wall\", \"place\": [ {place} ]"))
    };
    let bench = Bench::with_scene(&scene("{ \"scale\": [1e39, 1e39, 1e39] }"));
    bench.write("wall.obj", WALL_OBJ);
    let parts =
        ["scene.json:5:", "objects[0].mesh.place: found vertex 0 moved beyond the range of single"];
    bench.refuse(&["scene.json", "--mesh", "wall=wall.obj"], b"", 3, &parts);
    // The placement is checked before the mesh is requested.
    let bench = Bench::with_scene(&scene("{ \"scale\": [1, 1, 0] }"));
    bench.refuse(&["scene.json"], b"", 3, &["scene.json:5:", "objects[0].mesh.place[0].scale[2]"]);
}
