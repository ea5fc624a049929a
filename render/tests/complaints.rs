//! Bad input gives one sentence with the position of the fault, the right exit code, and an
//! unchanged output.

use crate::bench;

use bench::{Bench, MESH_WALL, TEXTURED_WALL, WALL, WALL_OBJ, checks};

/// Asserts that the wall's scene with a part replaced is refused with these words.
fn refuse_scene(from: &str, to: &str, parts: &[&str]) {
    assert!(WALL.contains(from), "{from}");
    let bench = Bench::with_scene(&WALL.replacen(from, to, 1));
    bench.refuse(&["scene.json"], b"", 3, parts);
}

/// Asserts that the mesh wall with this OBJ is refused with these words.
fn refuse_obj(obj: impl AsRef<[u8]>, parts: &[&str]) {
    let bench = Bench::with_scene(MESH_WALL);
    bench.write("wall.obj", obj.as_ref());
    bench.refuse(&["scene.json", "--mesh", "wall=wall.obj"], b"", 3, parts);
    let parts: Vec<String> = parts.iter().map(|part| part.replace("wall.obj", "<stdin>")).collect();
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    bench.refuse(&["scene.json", "--mesh", "wall=-"], obj.as_ref(), 3, &parts);
}

/// Asserts that the textured wall with this file as its picture is refused with these words.
fn refuse_texture(picture: &[u8], parts: &[&str]) {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", picture);
    let place = ["scene.json:4:36: textures.checks.image: "];
    bench.refuse(&["scene.json"], b"", 3, &[&place, parts].concat());
}

#[test]
fn malformed_json_is_placed() {
    refuse_scene("\"ambient\": 0.5,", "\"ambient\": 0.5", &["scene.json:4:1: "]);
    refuse_scene("] }", "]", &["scene.json:6:"]);
    refuse_scene("0.5", "NaN", &["scene.json:3:"]);
    refuse_scene("0.5", "1e400", &["scene.json:3:", "number out of range"]);
    refuse_scene("0.5", "-Infinity", &["scene.json:3:"]);
    let bench = Bench::with_scene(" \n");
    bench.refuse(&["scene.json"], b"", 3, &["scene.json:1:1: found nothing"]);
    bench.refuse(&["-"], b"{", 3, &["<stdin>:1:1: "]);
    bench.refuse(&["-"], b"{}\n\xff", 3, &["<stdin>:2:1: ", "UTF-8"]);
    bench.refuse(&["-"], &WALL.as_bytes()[..100], 3, &["<stdin>:2:"]);
    bench.refuse(&["-"], &"[".repeat(100_000).into_bytes(), 3, &["<stdin>:1:"]);
}

#[test]
fn unknown_keys_are_met_with_a_suggestion() {
    refuse_scene(
        "\"ambient\"",
        "\"ambeint\"",
        &["scene.json:3:12: ambeint: unknown key", "(did you mean `ambient`?)"],
    );
    refuse_scene("\"diffuse\"", "\"difuse\"", &["scene.json:4:", "(did you mean `diffuse`?)"]);
    refuse_scene("\"rectangle\"", "\"rectangel\"", &["scene.json:5:", "`rectangle`?)"]);
    refuse_scene("\"corner\"", "\"center\"", &["scene.json:5:", "objects[0].rectangle"]);
    refuse_scene("\"eye\"", "\"eyes\"", &["scene.json:2:", "camera", "(did you mean `eye`?)"]);
}

#[test]
fn names_that_come_twice_are_refused() {
    let twice = r#""materials": { "wall": {}, "wall": "#;
    refuse_scene(
        r#""materials": { "wall": "#,
        twice,
        &["scene.json:4:", "materials: duplicate key `wall`"],
    );
    refuse_scene("\"ambient\"", "\"ambient\": 1, \"ambient\"", &["scene.json:3:", "duplicate key"]);
}

#[test]
fn wrong_types_and_missing_keys_are_placed() {
    refuse_scene("[0, 0, 1]", "[0, \"0\", 1]", &["scene.json:2:24: camera.eye[1]: "]);
    refuse_scene("[0, 0, 1]", "[0, 0]", &["scene.json:2:", "camera.eye"]);
    refuse_scene("[0, 0, 1]", "[0, 0, 1, 2]", &["scene.json:2:", "found more values"]);
    refuse_scene("0.5", "true", &["scene.json:3:12: ambient: ", "one number for grey"]);
    refuse_scene("0.5", "[1, 1]", &["scene.json:3:12: ambient: "]);
    refuse_scene("[1, 0.25, 0]", "[1, 0.25, 0, 1]", &["scene.json:4:35: materials.wall.color"]);
    refuse_scene(
        "\"fov_deg\": 90",
        "\"up\": [0, 1, 0]",
        &["scene.json:2:", "camera: found neither of fov_deg and height, expected fov_deg"],
    );
    refuse_scene("\"objects\"", "\"lights\"", &["scene.json:"]);
    refuse_scene("\"version\": 1", "\"version\": 1.5", &["scene.json:1:", "version"]);
}

#[test]
fn scenes_of_another_format_or_version_are_refused() {
    let place = "scene.json:1:13: format: found \"tb-sweep\", expected \"tb-scene\"";
    refuse_scene("tb-scene", "tb-sweep", &[place]);
    refuse_scene(
        "\"version\": 1",
        "\"version\": 2",
        &["scene.json:1:36: version: found 2, expected 1"],
    );
    // A spec of the preceding program has none of a scene's keys.
    let bench = Bench::with_scene(r#"{ "format": "tb-sweep", "version": 1, "name": "pipe" }"#);
    bench.refuse(&["scene.json"], b"", 3, &["scene.json:1:", "tb-sweep"]);
}

#[test]
fn numbers_out_of_range_are_placed_with_their_range() {
    refuse_scene("0.5", "-0.5", &["scene.json:3:12: ambient: found -0.5, expected at least 0"]);
    refuse_scene("90", "180", &["scene.json:2:63: camera.fov_deg: found 180", "between 0 and 180"]);
    refuse_scene("[0, 0, 1]", "[0, 0, 0]", &["scene.json:2:11: camera: ", "at its target"]);
    refuse_scene("[0, 4, 0]", "[8, 0, 0]", &["scene.json:5:", "rectangle.edge_v", "parallel"]);
    refuse_scene(
        "\"diffuse\": 0",
        "\"diffuse\": 1.5",
        &["scene.json:4:", "found 1.5, expected 0 to 1"],
    );
    refuse_scene("\"diffuse\": 0", "\"shininess\": 0", &["scene.json:4:", "expected 1 to 1000000"]);
    refuse_scene("\"diffuse\": 0", "\"index_of_refraction\": 0", &["scene.json:4:", "0.1 to 10"]);
    refuse_scene(
        "\"ambient\": 0.5",
        "\"max_depth\": 65",
        &["scene.json:3:14: max_depth: ", "0 to 64"],
    );
    refuse_scene("\"ambient\": 0.5", "\"max_depth\": -1", &["scene.json:3:14: max_depth: "]);
    refuse_scene("\"ambient\": 0.5", "\"min_weight\": 2", &["scene.json:3:15: min_weight: "]);
    refuse_scene(
        "\"material\"",
        "\"repeat\": [1, 0], \"material\"",
        &["scene.json:6:", "repeat[1]"],
    );
    for radius in ["-1", "0", "-0.0"] {
        let sphere = format!(
            r#"{{ "sphere": {{ "center": [0, 0, 0], "radius": {radius}, "material": "wall" }} }}, {{ "rectangle""#
        );
        let place = "scene.json:5:59: objects[0].sphere.radius: found";
        refuse_scene("{ \"rectangle\"", &sphere, &[place, "expected more than 0"]);
    }
}

#[test]
fn unknown_materials_and_textures_are_met_with_a_suggestion() {
    refuse_scene(
        "\"material\": \"wall\"",
        "\"material\": \"walls\"",
        &[
            "scene.json:6:15: objects[0].rectangle.material: found unknown material \"walls\"",
            "expected one of: wall (did you mean \"wall\"?)",
        ],
    );
    refuse_scene(
        "\"material\": \"wall\"",
        "\"material\": \"wall\", \"texture\": \"a\"",
        &[
            "scene.json:6:34: objects[0].rectangle.texture: found unknown texture \"a\"",
            "expected one of: none",
        ],
    );
    let bench = Bench::with_scene(
        &TEXTURED_WALL.replace("\"texture\": \"checks\"", "\"texture\": \"check\""),
    );
    bench.refuse(&["scene.json"], b"", 3, &["scene.json:7:34: ", "(did you mean \"checks\"?)"]);
}

#[test]
fn files_that_cannot_be_read_end_with_5_and_are_named() {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.refuse(&["none.json"], b"", 5, &["cannot read none.json: "]);
    bench.refuse(
        &["scene.json"],
        b"",
        5,
        &["scene.json:4:36: textures.checks.image: cannot read checks.png: "],
    );
    let own = MESH_WALL.replace(r#""name": "wall","#, r#""name": "wall", "file": "none.obj","#);
    let bench = Bench::with_scene(&own);
    bench.refuse(
        &["scene.json"],
        b"",
        5,
        &["scene.json:5:50: objects[0].mesh.file: cannot read none.obj: "],
    );
    let arguments = ["scene.json", "--mesh", "wall=other.obj"];
    bench.refuse(&arguments, b"", 5, &["cannot read other.obj: "]);
    bench.refuse(&["."], b"", 5, &["cannot read .: "]);
}

#[test]
fn textures_that_are_no_picture_are_refused() {
    refuse_texture(
        b"not a picture\n",
        &["found no picture in checks.png", "expected a PNG, JPEG, TGA"],
    );
    refuse_texture(b"", &["found no picture in checks.png"]);
    let whole = checks();
    for kept in [8, 20, 40, whole.len() - 20] {
        refuse_texture(&whole[..kept], &["found no picture in checks.png"]);
    }
}

#[test]
fn a_mesh_without_triangles_is_refused() {
    refuse_obj("", &["wall.obj: found nothing", "did the program before the pipe fail?"]);
    refuse_obj("\n \n", &["wall.obj: found nothing"]);
    refuse_obj("# nothing yet\n", &["wall.obj: found no triangles"]);
    refuse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n", &["wall.obj: found no triangles"]);
}

#[test]
fn broken_lines_of_a_mesh_are_named() {
    for (line, part) in [
        ("v 0 0", "three numbers"),
        ("v 0 zero 0", "three numbers"),
        ("vt", "two numbers"),
        ("vn 0 0", "three numbers"),
        ("f 1/1/1/1 2 3", "three or more corners"),
        ("f 0 1 2", "three or more corners"),
        ("f one two three", "three or more corners"),
    ] {
        let place = format!("wall.obj:5: found `{line}`");
        refuse_obj(WALL_OBJ.replace("f 1 2 3 4", line), &[&place, part]);
    }
    for number in ["NaN", "1e400", "1e39"] {
        let obj = WALL_OBJ.replace("v 2 2 0", &format!("v 2 {number} 0"));
        refuse_obj(obj, &[&format!("wall.obj:3: found `v 2 {number} 0`"), "three finite numbers"]);
    }
    refuse_obj(b"v 0 0 0\nv 1 \0 0\n", &["wall.obj:2: ", "a byte 0"]);
}

#[test]
fn a_face_of_corners_that_are_not_there_is_named() {
    for face in ["f 1 2 5", "f -5 1 2", "f 1 2 99999999999"] {
        let place = format!("wall.obj:5: found `{face}`");
        refuse_obj(WALL_OBJ.replace("f 1 2 3 4", face), &[&place, "corner"]);
    }
}

#[test]
fn one_of_our_meshes_must_be_finished() {
    let ours = format!("# topobook triangulate OBJ 1\n{WALL_OBJ}");
    let bench = Bench::with_scene(MESH_WALL);
    let whole = format!("{ours}# end 4 1\n");
    let arguments = ["scene.json", "--mesh", "wall=-", "-o", "whole.png", "--size", "2x2"];
    bench.make(&arguments, whole.as_bytes());
    for end in ["", "# end 4", "# end 4 1", "# end 4 2\n"] {
        refuse_obj(format!("{ours}{end}"), &["wall.obj: found `", "stopped early"]);
    }
}

#[test]
fn surfaces_of_a_mesh_must_be_bound() {
    let bench = Bench::with_scene(MESH_WALL);
    let obj = WALL_OBJ.replace("f ", "usemtl tex2_surf1\nf ");
    bench.write("wall.obj", &obj);
    bench.refuse(
        &["scene.json", "--mesh", "wall=wall.obj"],
        b"",
        3,
        &["scene.json:5:24: objects[0].mesh: found texture id 2 in mesh wall", "\"textures\""],
    );
    bench.write(
        "scene.json",
        MESH_WALL.replace("\"material\": \"wall\"", "\"materials\": { \"7\": \"wall\" }"),
    );
    bench.refuse(
        &["scene.json", "--mesh", "wall=wall.obj"],
        b"",
        3,
        &["scene.json:5:24: objects[0].mesh: found surface \"1\" in mesh wall", "\"materials\""],
    );
}

#[test]
fn a_mesh_that_is_given_wrongly_ends_with_2() {
    let bench = Bench::with_scene(MESH_WALL);
    bench.write("wall.obj", WALL_OBJ);
    let refuse = |arguments: &[&str], parts: &[&str]| bench.refuse(arguments, b"", 2, parts);
    refuse(
        &["scene.json"],
        &[
            "the scene's mesh wall was not given: add --mesh wall=FILE",
            "objects[0].mesh in scene.json",
        ],
    );
    refuse(
        &["scene.json", "--mesh", "wal=wall.obj"],
        &["--mesh wal: the scene has no mesh of that name", "it has wall (did you mean wall?)"],
    );
    let twice = ["scene.json", "--mesh", "wall=wall.obj", "--mesh", "wall=-"];
    refuse(&twice, &["--mesh wall was given twice"]);
    refuse(
        &["-", "--mesh", "wall=-"],
        &["standard input (-) can be read once: found - for the scene and --mesh wall"],
    );
    let without = Bench::with_scene(WALL);
    let arguments = ["scene.json", "--mesh", "wall=wall.obj"];
    without.refuse(&arguments, b"", 2, &["--mesh wall: ", "it has none"]);
}

#[test]
fn an_output_of_unknown_kind_ends_with_2() {
    let bench = Bench::with_scene(WALL);
    for output in ["out.jpg", "out", "-", ".png"] {
        let (code, said) = bench::ending(&bench.run(&["scene.json", "-o", output], b""));
        assert_eq!(code, Some(2), "{said}");
        let start = format!("render: cannot tell the kind of picture from {output}: ");
        assert!(said.starts_with(&start) && said.contains("--format"), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    assert_eq!(bench.names().len(), 1, "nothing was made");
}

#[test]
fn the_order_of_keys_does_not_matter() {
    let value: serde_json::Value = serde_json::from_str(WALL).unwrap();
    // Keys are sorted by name, as in a file that a program wrote.
    let bench = Bench::with_scene(&serde_json::to_string(&value).unwrap());
    bench.make(&["scene.json", "-o", "wall.png", "--size", "2x2"], b"");
}

#[test]
fn a_texture_without_its_places_is_refused() {
    let textured = TEXTURED_WALL.replace("\"objects\": [", "\"objects\": [ { \"mesh\": { \"name\": \"m\", \"file\": \"m.obj\", \"material\": \"wall\", \"texture\": \"checks\" } },");
    let bench = Bench::with_scene(&textured);
    bench.write("checks.png", checks());
    bench.write("m.obj", WALL_OBJ);
    let place =
        "scene.json:6:24: objects[0].mesh: found 2 triangles without texture coordinates (vt)";
    bench.refuse(&["scene.json"], b"", 3, &[place, "mesh m", "expected vt"]);
    // Without the texture no texture coordinates are missing.
    bench.write("scene.json", textured.replacen(", \"texture\": \"checks\"", "", 1));
    bench.make(&["scene.json", "-o", "whole.png", "--size", "2x2"], b"");
}

#[test]
fn numbers_that_cannot_be_reckoned_with_are_placed_with_their_range() {
    let far = "found 1e200, expected -1e30 to 1e30";
    refuse_scene(
        "[-2, -2, 0]",
        "[-2, 1e200, 0]",
        &["scene.json:5:46: objects[0].rectangle.corner[1]: ", far],
    );
    refuse_scene("[0, 4, 0]", "[0, 1e200, 0]", &["scene.json:5:", "edge_v[1]: ", far]);
    refuse_scene("[0, 0, 1]", "[0, 0, 1e200]", &["scene.json:2:27: camera.eye[2]: ", far]);
    refuse_scene(
        "[1, 0.25, 0]",
        "1e31",
        &["scene.json:4:35: materials.wall.color: found 1e31", "at most 1e30"],
    );
    refuse_scene("0.5", "1e308", &["scene.json:3:12: ambient: found 1e308"]);
    let sphere = r#"{ "sphere": { "center": [0, 0, 0], "radius": 1e200, "material": "wall" } }, { "rectangle""#;
    refuse_scene(
        "{ \"rectangle\"",
        sphere,
        &[
            "scene.json:5:59: objects[0].sphere.radius: found 1e200, expected more than 0: 1e-30 to 1e30",
        ],
    );
    let light = "\"lights\": [ { \"point\": { \"position\": [0, 1e99, 0] } } ], \"ambient\"";
    refuse_scene(
        "\"ambient\"",
        light,
        &["scene.json:3:", "lights[0].point.position[1]: found 1e99"],
    );
}

#[test]
fn a_library_of_materials_that_is_wrong_is_named() {
    let with_library =
        MESH_WALL.replace("\"name\": \"wall\"", "\"name\": \"wall\", \"mtl\": \"a.mtl\"");
    let bench = Bench::with_scene(&with_library);
    bench.write("wall.obj", WALL_OBJ);
    let arguments = ["scene.json", "--mesh", "wall=wall.obj"];
    let place = "scene.json:5:49: objects[0].mesh.mtl: cannot read a.mtl: ";
    bench.refuse(&arguments, b"", 5, &[place]);
    bench.write("a.mtl", "newmtl a\n\0");
    bench.refuse(
        &arguments,
        b"",
        3,
        &["a.mtl:2: found a byte 0, expected the text of an MTL library"],
    );
    // A picture that no surface takes is not missed.
    bench.write("wall.obj", WALL_OBJ.replace("f ", "usemtl a\nf "));
    bench.write("a.mtl", "newmtl a\nmap_Kd none.png\n");
    bench.refuse(
        &arguments,
        b"",
        5,
        &["scene.json:5:49: objects[0].mesh.mtl: cannot read none.png: "],
    );
}
