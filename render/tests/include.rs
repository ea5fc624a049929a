//! Scenes in several files.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench;

use bench::{Bench, checks, ending};
use files::Embedded;
use files::json::Document;
use render::scene::{MeshSource, read};
use std::fs;
use std::path::Path;

/// A scene that takes its materials and lights from parts in another folder.
const SCENE: &str = r#"{ "format": "tb-scene", "version": 1,
"include": ["common/look.json", "common/walls.json"],
"camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 },
"ambient": 0.5,
"objects": [] }"#;

const LOOK: &str = r#"{ "format": "tb-scene-part", "version": 1,
"textures": { "checks": { "image": "pictures/checks.png" } },
"materials": { "wall": { "color": [1, 0.25, 0], "diffuse": 0 } } }"#;

const WALLS: &str = r#"{ "format": "tb-scene-part", "version": 1,
"include": ["look.json"],
"objects": [ { "rectangle": { "corner": [-2, -2, 0], "edge_u": [4, 0, 0], "edge_v": [0, 4, 0],
  "material": "wall", "texture": "checks" } } ] }"#;

/// The scene of [`SCENE`] in one file.
const WHOLE: &str = r#"{ "format": "tb-scene", "version": 1,
"camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 },
"ambient": 0.5,
"textures": { "checks": { "image": "common/pictures/checks.png" } },
"materials": { "wall": { "color": [1, 0.25, 0], "diffuse": 0 } },
"objects": [ { "rectangle": { "corner": [-2, -2, 0], "edge_u": [4, 0, 0], "edge_v": [0, 4, 0],
  "material": "wall", "texture": "checks" } } ] }"#;

fn bench(look: &str, walls: &str) -> Bench {
    let bench = Bench::with_scene(SCENE);
    fs::create_dir_all(bench.path("common/pictures")).unwrap();
    bench.write("common/pictures/checks.png", checks());
    bench.write("common/look.json", look);
    bench.write("common/walls.json", walls);
    bench
}

#[test]
fn a_scene_in_parts_is_the_scene_in_one_file() {
    let bench = bench(LOOK, WALLS);
    bench.write("whole.json", WHOLE);
    bench.make(&["scene.json", "-o", "parts.png", "--size", "9x7"], b"");
    bench.make(&["whole.json", "-o", "whole.png", "--size", "9x7"], b"");
    // The files state different names of the scene.
    let pixels = |name: &str| image::load_from_memory(&bench.read(name)).unwrap();
    assert_eq!(pixels("parts.png"), pixels("whole.png"));
    // From standard input, paths are relative to the working folder, which is the scene's here.
    bench.make(&["-", "-o", "piped.png", "--size", "9x7"], SCENE.as_bytes());
    assert_eq!(pixels("piped.png"), pixels("whole.png"));
}

#[test]
fn what_is_taken_in_stands_before_what_takes_it_in() {
    // Two coincident walls: the first in the scene's order is seen.
    let red = SCENE.replace(
        "\"objects\": []",
        r#""materials": { "red": { "color": [0, 1, 0], "diffuse": 0 } },
        "objects": [ { "rectangle": { "corner": [-2, -2, 0], "edge_u": [4, 0, 0],
        "edge_v": [0, 4, 0], "material": "red" } } ]"#,
    );
    let bench = bench(LOOK, &WALLS.replace(", \"texture\": \"checks\"", ""));
    bench.write("scene.json", red);
    bench.make(&["scene.json", "-o", "out.png", "--size", "2x2"], b"");
    let picture = image::load_from_memory(&bench.read("out.png")).unwrap().to_rgb8();
    assert!(picture.pixels().all(|pixel| pixel.0 == [188, 99, 0]));
}

#[test]
fn names_given_twice_are_placed_and_both_files_named() {
    let bench = bench(LOOK, WALLS);
    let twice = SCENE.replace("\"ambient\"", "\"materials\": { \"wall\": {} }, \"ambient\"");
    bench.write("scene.json", twice);
    let place = "scene.json:4:24: materials.wall: found a material \"wall\"";
    bench.refuse(&["scene.json"], b"", 3, &[place, "common/look.json has too"]);
    bench.write("scene.json", SCENE);
    let walls = WALLS.replace(
        "\"include\": [\"look.json\"]",
        "\"textures\": { \"checks\": { \"image\": \"a.png\" } }",
    );
    bench.write("common/walls.json", walls);
    let place = "common/walls.json:2:25: textures.checks: found a texture \"checks\"";
    bench.refuse(&["scene.json"], b"", 3, &[place, "common/look.json has too"]);
}

#[test]
fn what_is_wrong_in_a_part_is_placed_there() {
    for (from, to, parts) in [
        (
            "0.25",
            "-0.25",
            ["common/look.json:3:35: materials.wall.color: found -0.25", "at least 0"],
        ),
        ("diffuse", "difuse", ["common/look.json:3:", "did you mean `diffuse`?"]),
        ("0.25", "NaN", ["common/look.json:3:", "expected"]),
        (
            "tb-scene-part",
            "tb-scene",
            ["common/look.json:1:13: format: found \"tb-scene\"", "expected \"tb-scene-part\""],
        ),
        (
            "\"version\": 1",
            "\"version\": 2",
            ["common/look.json:1:41: version: found 2", "expected 1"],
        ),
        ("\"textures\"", "\"camera\"", ["common/look.json:2:", "camera: unknown key"]),
    ] {
        assert!(LOOK.contains(from), "{from}");
        bench(&LOOK.replacen(from, to, 1), WALLS).refuse(&["scene.json"], b"", 3, &parts);
    }
    let missing = LOOK.replace("checks.png", "none.png");
    let place =
        "common/look.json:2:36: textures.checks.image: cannot read common/pictures/none.png";
    bench(&missing, WALLS).refuse(&["scene.json"], b"", 5, &[place]);
    let unknown = WALLS.replace("\"material\": \"wall\"", "\"material\": \"wal\"");
    let place = "common/walls.json:4:15: objects[0].rectangle.material: found unknown material";
    bench(LOOK, &unknown).refuse(&["scene.json"], b"", 3, &[place, "did you mean \"wall\"?"]);
}

#[test]
fn parts_that_are_not_there_or_include_themselves_are_refused() {
    let bench = bench(LOOK, WALLS);
    bench.write("scene.json", SCENE.replace("walls.json", "wall.json"));
    let place = "scene.json:2:33: include[1]: cannot read common/wall.json: ";
    bench.refuse(&["scene.json"], b"", 5, &[place]);
    bench.write("scene.json", SCENE);
    bench.write(
        "common/look.json",
        r#"{ "format": "tb-scene-part", "version": 1, "include": ["../common/walls.json"] }"#,
    );
    let place = "common/walls.json:2:13: include[0]: found common/look.json, which includes itself";
    bench.refuse(&["scene.json"], b"", 3, &[place]);
    // A scene is not a part, and therefore cannot include itself.
    bench.write("scene.json", SCENE.replace("common/look.json", "scene.json"));
    bench.refuse(&["scene.json"], b"", 3, &["scene.json:1:13: format: found \"tb-scene\""]);
}

#[test]
fn parts_are_included_so_deep_and_no_deeper() {
    let bench = Bench::with_scene(&SCENE.replace(", \"common/walls.json\"", ""));
    fs::create_dir(bench.path("common")).unwrap();
    let part = |next: &str| format!(r#"{{ "format": "tb-scene-part", "version": 1{next} }}"#);
    let chain = |length: usize| {
        for k in 1..length {
            let next = format!(", \"include\": [\"{k}.json\"]");
            let name = if k == 1 { "look".into() } else { (k - 1).to_string() };
            bench.write(&format!("common/{name}.json"), part(&next));
        }
        bench.write(&format!("common/{}.json", length - 1), part(""));
    };
    chain(16);
    bench.make(&["scene.json", "-o", "deep.png", "--size", "2x2"], b"");
    chain(17);
    bench.refuse(&["scene.json"], b"", 3, &["common/15.json:1:", "more than 16 deep"]);
}

#[test]
fn a_mesh_of_a_part_may_be_given() {
    let walls = r#"{ "format": "tb-scene-part", "version": 1,
        "objects": [ { "mesh": { "name": "wall", "material": "wall" } } ] }"#;
    let bench = bench(LOOK, walls);
    let arguments = ["scene.json", "--mesh", "wall=-", "-o", "out.png", "--size", "2x2"];
    bench.make(&arguments, bench::WALL_OBJ.as_bytes());
    let run = bench.run(&["scene.json", "-o", "x.png"], b"");
    let (code, said) = ending(&run);
    assert_eq!(code, Some(2));
    assert!(said.contains("objects[0].mesh in common/walls.json"), "{said}");
}

#[test]
fn parts_built_into_a_program_are_found_there() {
    static FILES: Embedded = Embedded(&[(
        "pages/common/look.json",
        br#"{ "format": "tb-scene-part", "version": 1, "materials": { "wall": { "diffuse": 0.25 } } }"#,
    )]);
    let text = SCENE.replace("common/look.json\", \"common/walls.json", "../common/look.json");
    let document = Document::new("pages/scenes/scene.json", text.as_bytes()).unwrap();
    let file = read::parse(&document).unwrap();
    let folder = Path::new("pages/scenes");
    let scene = read::resolve(&document, &file, folder, &FILES, MeshSource::new()).unwrap();
    assert_eq!(scene.materials[0].diffuse, 0.25);
}
