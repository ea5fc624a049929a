//! Output of `--check`: the inventory, each finding with its JSON path, and the exit code.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench;

use bench::{Bench, MESH_WALL, TEXTURED_WALL, WALL, WALL_OBJ, checks, ending};

/// A ball in front of a wall, a scene without findings.
const ROOM: &str = r#"{ "format": "tb-scene", "version": 1,
"camera": { "eye": [0, 0, 4], "target": [0, 0, 0], "fov_deg": 60 },
"lights": [ { "point": { "position": [3, 3, 3] } } ],
"textures": { "checks": { "image": "checks.png" } },
"materials": { "wall": {}, "ball": { "specular": 0.5 } },
"objects": [
  { "rectangle": { "corner": [-2, -2, 0], "edge_u": [4, 0, 0], "edge_v": [0, 4, 0],
    "material": "wall", "texture": "checks" } },
  { "sphere": { "center": [0, 0, 1.5], "radius": 1, "material": "ball" } } ] }"#;

/// Checks [`ROOM`] with a part replaced. Returns the exit code and the output.
fn said(from: &str, to: &str) -> (i32, String) {
    assert!(ROOM.contains(from), "{from}");
    let bench = Bench::with_scene(&ROOM.replacen(from, to, 1));
    bench.write("checks.png", checks());
    let run = bench.run(&["--check", "scene.json"], b"");
    (run.status.code().unwrap(), String::from_utf8(run.stdout).unwrap())
}

/// Asserts that the scene with a part replaced has this finding, on one line.
#[track_caller]
fn finds(from: &str, to: &str, finding: &str) {
    let (code, said) = said(from, to);
    let lines: Vec<&str> = said.lines().filter(|line| line.starts_with(finding)).collect();
    assert_eq!(lines.len(), 1, "{finding}\n{said}");
    assert_eq!(code, if finding.starts_with("wrong") { 4 } else { 0 }, "{said}");
}

/// Checks a mesh of glass. Returns the exit code and the output.
fn glass(obj: &str) -> (i32, String) {
    let glass = MESH_WALL.replace("\"diffuse\": 0", "\"diffuse\": 0, \"transparency\": 1");
    let bench = Bench::with_scene(&glass);
    let run = bench.run(&["--check", "scene.json", "--mesh", "wall=-"], obj.as_bytes());
    (run.status.code().unwrap(), String::from_utf8(run.stdout).unwrap())
}

const TETRAHEDRON: &str =
    "v 0 0 0\nv 0.4 0 0\nv 0 0.4 0\nv 0 0 0.4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

#[test]
fn a_sound_scene_gets_its_inventory_and_no_finding() {
    let (code, said) = said("format", "format");
    // The memory of a table depends on the filter and is cut off.
    let start = |line: &str| line.split(", tables of").next().unwrap().to_string();
    let lines: Vec<String> = said.lines().map(start).collect();
    assert!(said.contains("24 bytes, tables of "), "{said}");
    assert_eq!(
        lines,
        [
            "camera: at (0, 0, 4), looks at (0, 0, 0), 60 degrees high",
            "lights[0]: point at (3, 3, 3), colour (1, 1, 1)",
            "texture checks: 2 x 2 texels, 24 bytes",
            "objects[0].rectangle: rectangle, material wall with texture checks, \
             from (-2, -2, 0) to (2, 2, 0), 4 x 4 x 0",
            "objects[1].sphere: sphere, material ball, from (-1, -1, 0.5) to (1, 1, 2.5), 2 x 2 x 2",
            "all: from (-2, -2, 0) to (2, 2, 2.5), 4 x 4 x 2.5",
        ]
    );
    assert_eq!(code, 0);
}

#[test]
fn what_is_not_used_is_named() {
    finds("\"wall\": {},", "\"wall\": {}, \"gold\": {},", "remark: materials.gold: no surface");
    finds(", \"texture\": \"checks\"", "", "remark: textures.checks: no surface");
    let hidden = "\"wall\": { \"ambient\": 0, \"diffuse\": 0, \"reflectivity\": 1 },";
    finds("\"wall\": {},", hidden, "hint: textures.checks: the texture is only on materials");
}

#[test]
fn an_eye_in_or_on_a_surface_is_told() {
    let eye = "\"eye\": [0, 0, 4]";
    finds(eye, "\"eye\": [0.1, 0.1, 1.5]", "hint: camera.eye: the eye sees only the inside");
    finds(eye, "\"eye\": [0, 1, 1.5]", "hint: camera.eye: the eye is on the surface of objects[1]");
    finds(eye, "\"eye\": [1.5, 1, 0]", "hint: camera.eye: the eye is on the surface of objects[0]");
}

#[test]
fn what_is_out_of_sight_is_told() {
    let ball = "\"center\": [0, 0, 1.5]";
    finds(
        ball,
        "\"center\": [0, 0, 9]",
        "remark: objects[1].sphere: the whole object is behind the camera, at a distance of 4",
    );
    finds(
        ball,
        "\"center\": [9, 0, 1.5]",
        "remark: objects[1].sphere: the whole object is outside",
    );
    // The shape of the picture matters: a wide picture contains the ball.
    finds(
        ball,
        "\"center\": [3.5, 0, 1.5]",
        "remark: objects[1].sphere: the whole object is outside",
    );
    let bench = Bench::with_scene(&ROOM.replace(ball, "\"center\": [3.5, 0, 1.5]"));
    bench.write("checks.png", checks());
    let wide = bench.run(&["--check", "scene.json", "--size", "400x100"], b"");
    assert!(!String::from_utf8(wide.stdout).unwrap().contains("outside the picture"));
    finds(
        "\"target\": [0, 0, 0]",
        "\"target\": [0, 0, 9]",
        "wrong: camera: found no object in front",
    );
}

#[test]
fn lights_that_are_shut_in_or_missing_are_told() {
    let place = "\"position\": [3, 3, 3]";
    let shut = "hint: lights[0]: the light is inside objects[1].sphere";
    finds(place, "\"position\": [0, 0, 1.4]", shut);
    finds(
        "\"lights\": [ { \"point\": { \"position\": [3, 3, 3] } } ]",
        "\"ambient\": 0",
        "hint: lights: there are no lights and no ambient light",
    );
}

#[test]
fn surfaces_in_the_same_place_are_told() {
    let ball = "{ \"sphere\": { \"center\": [0, 0, 1.5], \"radius\": 1, \"material\": \"ball\" } }";
    let tile = |corner: &str, size: f64| {
        format!(
            "{{ \"rectangle\": {{ \"corner\": {corner}, \"edge_u\": [{size}, 0, 0], \
             \"edge_v\": [0, {size}, 0], \"material\": \"ball\" }} }}"
        )
    };
    let in_it =
        "remark: objects[1].rectangle: the surface lies in the same plane as objects[0].rectangle";
    finds(ball, &tile("[1, 1, 0]", 0.5), in_it);
    finds(ball, &tile("[1.9, 1.9, 0]", 0.5), in_it);
    // Beside the wall with a common edge, and above the wall, there is no finding.
    for corner in ["[2, 0, 0]", "[0, 0, 1e-6]", "[-2.5, -2.5, 0]"] {
        let (_, said) = said(ball, &tile(corner, 0.5));
        assert!(!said.contains("the surface lies in"), "{corner}\n{said}");
    }
    // A glass mesh whose bottom lies exactly in the floor.
    let scene = MESH_WALL.replace("\"diffuse\": 0", "\"diffuse\": 0, \"transparency\": 1").replace(
        "\"objects\": [",
        "\"objects\": [ { \"plane\": { \"point\": [0, 0, 0], \"edge_u\": [1, 0, 0], \
             \"edge_v\": [0, 1, 0], \"material\": \"wall\" } }, ",
    );
    let bench = Bench::with_scene(&scene);
    bench.write("wall.obj", TETRAHEDRON);
    let run = bench.run(&["--check", "scene.json", "--mesh", "wall=wall.obj"], b"");
    let text = String::from_utf8(run.stdout).unwrap();
    let finding = "hint: objects[1].mesh: 1 triangle lies exactly on objects[0].plane (plane)";
    assert!(text.contains(finding) && text.contains("leave a small gap"), "{text}");
}

#[test]
fn glass_must_have_an_inside() {
    let (code, said) = glass(TETRAHEDRON);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("mesh wall, 4 triangles, closed, volume 0.0107"), "{said}");
    let open = TETRAHEDRON.replace("f 2 3 4\n", "");
    let (code, said) = glass(&open);
    assert_eq!(code, 4);
    assert!(
        said.contains("wrong: objects[0].mesh: the mesh refracts and is not closed (3 edges"),
        "{said}"
    );
    let inward = TETRAHEDRON
        .lines()
        .map(|line| match line.strip_prefix("f ") {
            Some(corners) => format!("f {}\n", corners.chars().rev().collect::<String>()),
            None => format!("{line}\n"),
        })
        .collect::<String>();
    let (code, said) = glass(&inward);
    assert_eq!(code, 4);
    assert!(said.contains("its triangles face inward"), "{said}");
    let turned = TETRAHEDRON.replace("f 2 3 4", "f 2 4 3");
    let (code, said) = glass(&turned);
    assert_eq!(code, 4);
    assert!(said.contains("do not agree on the outside (3 edges)"), "{said}");
}

#[test]
fn a_depth_that_ends_inside_of_glass_is_told() {
    let ball = |z: f64| {
        format!(
            "{{ \"sphere\": {{ \"center\": [0, 0, {z}], \"radius\": 0.3, \"material\": \"ball\" }} }}"
        )
    };
    let clear = ROOM.replace("\"specular\": 0.5", "\"transparency\": 1");
    let row = format!("{}, {}, {}", ball(1.0), ball(1.7), ball(2.4));
    let start = clear.find("{ \"sphere\"").unwrap();
    let scene = format!("{}{row} ] }}", &clear[..start]);
    for (depth, expected) in [(6, false), (5, true)] {
        let bench = Bench::with_scene(
            &scene.replace("\"lights\"", &format!("\"max_depth\": {depth}, \"lights\"")),
        );
        bench.write("checks.png", checks());
        let text = String::from_utf8(bench.run(&["--check", "scene.json"], b"").stdout).unwrap();
        let finding = "hint: max_depth: a line of sight passes through 6 transparent surfaces";
        assert_eq!(text.contains(finding), expected, "{depth}\n{text}");
    }
}

#[test]
fn triangles_and_normals_that_cannot_be_meant_are_counted() {
    let check = |obj: &str| {
        let bench = Bench::with_scene(MESH_WALL);
        let run = bench.run(&["--check", "scene.json", "--mesh", "wall=-"], obj.as_bytes());
        (run.status.code().unwrap(), String::from_utf8(run.stdout).unwrap())
    };
    for (obj, code, finding) in [
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".into(), 4, "no triangle of the mesh has an area"),
        (format!("{WALL_OBJ}f 1 1 2\n"), 0, "remark: objects[0].mesh: 1 triangle is of 3 without"),
        (format!("{WALL_OBJ}f 3 1 2\n"), 0, "1 triangle has the corners of an earlier triangle"),
        (
            WALL_OBJ.replace("f 1 2 3 4", "vn 0 0 0\nf 1//1 2//1 3//1 4//1"),
            0,
            "1 normal (vn) is zero",
        ),
        (
            WALL_OBJ.replace("f 1 2 3 4", "vn 0 0 -1\nf 1//1 2//1 3//1 4//1"),
            0,
            "the normals (vn) of 2 triangles of 2 point to the side",
        ),
        // A file of `triangulate` holds numbers of single precision; others are read with all digits.
        (
            "# topobook triangulate OBJ 1\nv 9e6 0 0\nv 9000001 0 0\nv 9e6 1 0\nv 9e6 0 1\nf 1 2 3\nf 1 2 4\n\
             # end 4 2\n"
                .into(),
            4,
            "move the mesh nearer",
        ),
    ] {
        let (found, said) = check(&obj);
        let lines = said.lines().filter(|line| line.contains(finding)).count();
        assert_eq!((found, lines), (code, 1), "{finding}\n{said}");
    }
}

#[test]
fn what_cannot_be_read_ends_as_it_does_without_the_check() {
    let bench = Bench::with_scene(&WALL.replace("0.5", "-0.5"));
    let (code, said) = ending(&bench.run(&["--check", "scene.json"], b""));
    assert_eq!(code, Some(3));
    assert!(said.starts_with("render: scene.json:3:12: ambient: found -0.5"), "{said}");
    let bench = Bench::with_scene(TEXTURED_WALL);
    assert_eq!(ending(&bench.run(&["--check", "scene.json"], b"")).0, Some(5));
    let bench = Bench::with_scene(MESH_WALL);
    assert_eq!(ending(&bench.run(&["--check", "scene.json"], b"")).0, Some(2));
    let bench = Bench::with_scene(WALL);
    let (code, said) = ending(&bench.run(&["--check", "scene.json", "-o", "a.png"], b""));
    assert_eq!(code, Some(2), "{said}");
}

#[test]
fn a_scene_from_standard_input_is_checked_and_wrong_ends_with_4() {
    let bench = Bench::new();
    let away = WALL.replace("\"target\": [0, 0, 0]", "\"target\": [0, 0, 2]");
    let run = bench.run(&["--check", "-"], away.as_bytes());
    let (code, said) = ending(&run);
    assert_eq!(
        (code, said.as_str()),
        (Some(4), "render: <stdin>: number of findings marked `wrong`: 1\n")
    );
    assert!(String::from_utf8(run.stdout).unwrap().contains("wrong: camera: found no object"));
    assert!(bench.names().is_empty(), "nothing is written");
}

#[test]
fn findings_in_a_part_name_its_file() {
    let bench =
        Bench::with_scene(&WALL.replace("\"ambient\"", "\"include\": [\"a.json\"], \"ambient\""));
    bench.write(
        "a.json",
        r#"{ "format": "tb-scene-part", "version": 1, "materials": { "gold": {} } }"#,
    );
    let run = bench.run(&["--check", "scene.json"], b"");
    let text = String::from_utf8(run.stdout).unwrap();
    assert!(text.contains("remark: a.json: materials.gold: no surface"), "{text}");
}
