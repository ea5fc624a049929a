//! Bad solids and bumps give one sentence with the position of the fault.

use crate::bench;

use bench::{Bench, WALL};

/// Asserts that a wall with this texture, in line 4, is refused with these words.
fn refuse_texture(texture: &str, parts: &[&str]) {
    let textures = format!("\"textures\": {{ \"t\":\n{texture} }},\n\"materials\"");
    let bench = Bench::with_scene(&WALL.replace("\"materials\"", &textures));
    bench.refuse(&["scene.json"], b"", 3, &[&["scene.json:5:"], parts].concat());
}

/// Asserts that a wall with this bump is refused with these words.
fn refuse_bump(bump: &str, parts: &[&str]) {
    let material = format!("\"diffuse\": 0, \"bump\":\n{bump} }} }},");
    let bench = Bench::with_scene(&WALL.replace("\"diffuse\": 0 } },", &material));
    bench.refuse(&["scene.json"], b"", 3, &[&["scene.json:5:"], parts].concat());
}

#[test]
fn a_texture_is_of_exactly_one_kind() {
    let kinds = "expected exactly one of: image, marble, granite, wood, wall, turbulence, clouds, \
                 checker, stripes, brick";
    refuse_texture("{}", &["textures.t: found none, ", kinds]);
    refuse_texture(
        r#"{ "marble": {}, "image": "a.png" }"#,
        &["textures.t: found image and marble, ", kinds],
    );
    refuse_texture(r#"{ "marbel": {} }"#, &["unknown key", "(did you mean `marble`?)"]);
    refuse_texture(r#"{ "marble": { "fold": 1 } }"#, &["(did you mean `folds`?)"]);
    refuse_texture(
        r#"{ "marble": {}, "wrap": "clamp" }"#,
        &["textures.t.wrap: found this key on a texture that fills space, expected it only on \
           pictures"],
    );
    refuse_texture(
        r#"{ "marble": {}, "values": "srgb" }"#,
        &["textures.t.values: ", "only on pictures"],
    );
    refuse_texture(
        r#"{ "image": "a.png", "place": {} }"#,
        &["textures.t.place: found this key on a picture, expected it only on textures that fill \
           space"],
    );
}

#[test]
fn numbers_of_solids_are_placed_with_their_range() {
    for (texture, place, expected) in [
        (r#"{ "marble": { "octaves": 0 } }"#, "marble.octaves", "found 0, expected 1 to 12"),
        (r#"{ "clouds": { "octaves": 13 } }"#, "clouds.octaves", "found 13, expected 1 to 12"),
        (r#"{ "turbulence": { "octaves": 99 } }"#, "turbulence.octaves", "expected 1 to 12"),
        (r#"{ "marble": { "folds": -1 } }"#, "marble.folds", "expected 0 to 100"),
        (r#"{ "marble": { "net": 2 } }"#, "marble.net", "expected 0 to 1"),
        (r#"{ "marble": { "colors": [] } }"#, "marble.colors", "found no stops"),
        (
            r#"{ "marble": { "colors": [[0, 1], [1, 0], [0.5, 1]] } }"#,
            "marble.colors[2][0]",
            "found 0.5, expected positions that rise",
        ),
        (r#"{ "marble": { "colors": [[0, [1, 1, -1]]] } }"#, "marble.colors[0][1]", "at least 0"),
        (r#"{ "granite": { "minerals": [] } }"#, "granite.minerals", "found none"),
        (r#"{ "granite": { "minerals": [[0, 1]] } }"#, "granite.minerals[0][0]", "found 0"),
        (r#"{ "granite": { "flakes": 1.5 } }"#, "granite.flakes", "expected 0 to 1"),
        (r#"{ "wood": { "grain": -0.1 } }"#, "wood.grain", "expected 0 to 1"),
        (r#"{ "wood": { "waver": 1e9 } }"#, "wood.waver", "expected 0 to 100"),
        (r#"{ "wall": { "clamp": [-2, 0] } }"#, "wall.clamp[0]", "expected -1 to 1"),
        (r#"{ "wall": { "clamp": [0.2, 0.2] } }"#, "wall.clamp[1]", "expected more than 0.2"),
        (r#"{ "wall": { "frequency": 0 } }"#, "wall.frequency", "expected 0.001 to 1000"),
        (r#"{ "stripes": { "layers": [[-1, 0]] } }"#, "stripes.layers[0][0]", "found -1"),
        (r#"{ "stripes": { "layers": [] } }"#, "stripes.layers", "found none"),
        (r#"{ "brick": { "size": [1, 0, 1] } }"#, "brick.size[1]", "found 0"),
        (r#"{ "brick": { "joint": 0.5 } }"#, "brick.joint", "found 0.5, expected at least 0"),
        (r#"{ "checker": { "colors": [0] } }"#, "checker.colors", "expected"),
        (
            r#"{ "wood": {}, "place": { "scale": 0 } }"#,
            "place.scale",
            "found 0, expected any other",
        ),
        (r#"{ "wood": {}, "place": { "scale": 1e7 } }"#, "place", "long, expected 1e-6 to 1e6"),
        (r#"{ "wood": { "interpolation": "cubic" } }"#, "wood.interpolation", "linear"),
    ] {
        refuse_texture(texture, &[&format!("textures.t.{place}"), expected]);
    }
}

#[test]
fn a_bump_has_exactly_one_relief_and_numbers_in_range() {
    for (bump, place, expected) in [
        (
            r#"{ "strength": 1 }"#,
            "",
            "found none, expected exactly one of: noise, turbulence, wall, dnoise, image",
        ),
        (r#"{ "noise": {}, "dnoise": {}, "strength": 1 }"#, "", "found noise and dnoise"),
        (r#"{ "noise": {} }"#, "", "missing key `strength`"),
        (r#"{ "noise": {}, "strength": 1e7 }"#, ".strength", "expected -1000000 to 1000000"),
        (r#"{ "noise": { "octaves": 0 }, "strength": 1 }"#, ".noise.octaves", "1 to 12"),
        (
            r#"{ "wall": { "colors": [[0, 1]] }, "strength": 1 }"#,
            ".wall.colors",
            "only on textures",
        ),
        (
            r#"{ "noise": {}, "strength": 1, "place": { "scale": -1e7 } }"#,
            ".place",
            "unit of the texture 10000000 long",
        ),
        (
            r#"{ "image": { "file": "a.png" }, "strength": 1, "place": {} }"#,
            ".place",
            "found this key on a picture",
        ),
        (
            r#"{ "image": { "file": "a.png", "repeat": [0, 1] }, "strength": 1 }"#,
            ".image.repeat[0]",
            "found 0",
        ),
    ] {
        refuse_bump(bump, &[&format!("materials.wall.bump{place}"), expected]);
    }
    let bump =
        "\"diffuse\": 0, \"bump\": { \"strength\": 1, \"image\": { \"file\": \"a.png\" } } } },";
    let bench = Bench::with_scene(&WALL.replace("\"diffuse\": 0 } },", bump));
    let place = "scene.json:4:";
    bench.refuse(&["scene.json"], b"", 5, &[place, "bump.image.file: cannot read a.png"]);
    bench.write("a.png", "not a picture");
    bench.refuse(&["scene.json"], b"", 3, &[place, "found no picture in a.png"]);
}
