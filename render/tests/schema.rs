//! The schema of scenes and the reader accept the same documents.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::examples;

use examples::{Meshless, examples};
use files::json::Document;
use fixtures::program;
use fixtures::schema::{Judges, printed, undescribed};
use fixtures::variants::variants;
use jsonschema::Validator;
use render::scene::file::{PART_FORMAT, PartFile, SceneFile};
use render::scene::read::{self, Draft};
use render::scene::{MeshSource, limits, schema};
use serde_json::{Value, json};
use std::path::Path;

fn validator() -> Validator {
    jsonschema::draft202012::new(&schema::of_scene()).unwrap()
}

/// Returns the reader's complaint about a scene, if any. Missing meshes do not count.
fn complaint(scene: &Value) -> Option<String> {
    let text = scene.to_string();
    let document = Document::new("scene.json", text.as_bytes()).unwrap();
    let judged = read::parse(&document).and_then(|file| {
        let draft = Draft::gather(&document, &file, Path::new("examples/scenes"), &Meshless)?;
        draft.resolve(&Meshless, MeshSource::new())
    });
    judged.err().map(|error| error.to_string()).filter(|said| !said.contains("was not given"))
}

/// Returns whether the keys and types of a scene are those of the reader's types.
fn is_formed(scene: &Value) -> bool {
    if scene.get("format").is_some_and(|format| format == PART_FORMAT) {
        return serde_json::from_value::<PartFile>(scene.clone()).is_ok();
    }
    serde_json::from_value::<SceneFile>(scene.clone()).is_ok()
}

/// Returns a scene with one value set, at its JSON pointer.
fn scene(place: &str, value: Value) -> Value {
    let mut scene = json!({
        "format": "tb-scene", "version": 1,
        "camera": { "eye": [0, 1.5, 6], "target": [0, 0.9, 0], "up": [0, 1, 0], "fov_deg": 40 },
        "background": [0.5, 0.7, 0.9], "ambient": 0.2,
        "lights": [ { "point": { "position": [4, 8, 5], "color": 0.9 } } ],
        "max_depth": 12, "min_weight": 0.0001,
        "textures": { "t": { "image": "../textures/checkerboard.png", "wrap": "repeat", "values": "srgb" } },
        "materials": { "m": { "color": 1, "ambient": 1, "diffuse": 0.9, "specular": 0.5,
            "shininess": 50, "reflectivity": 1, "transparency": 1, "index_of_refraction": 1.5,
            "fresnel": true } },
        "objects": [
            { "sphere": { "center": [0, 1.3, 0], "radius": 1, "material": "m", "texture": "t" } },
            { "rectangle": { "corner": [-4, 0, 4], "edge_u": [8, 0, 0], "edge_v": [0, 0, -8],
                             "material": "m", "texture": "t", "repeat": [4, 4] } },
            { "plane": { "point": [0, -1, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
                         "material": "m" } },
        ],
    });
    *scene.pointer_mut(place).unwrap() = value;
    scene
}

#[test]
fn the_schema_is_one_and_the_program_prints_it() {
    let schema = schema::of_scene();
    assert!(jsonschema::draft202012::meta::is_valid(&schema));
    let program = Path::new(env!("CARGO_BIN_EXE_render"));
    let run = program::run(program, &["--emit-schema"], Path::new("."), b"");
    assert_eq!(printed(&run), schema);
}

#[test]
fn every_example_is_valid() {
    let validator = validator();
    let examples = examples();
    assert!(examples.len() >= 23);
    for (name, mut scene) in examples {
        validator.validate(&scene).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(complaint(&scene), None, "{name}");
        scene["$schema"] = json!("tb-scene.schema.json");
        assert!(validator.is_valid(&scene) && is_formed(&scene), "{name}");
    }
}

#[test]
fn every_key_says_what_it_is() {
    assert_eq!(undescribed(&schema::of_scene()), Vec::<String>::new());
}

#[test]
fn what_is_out_of_its_range_both_refuse() {
    let validator = validator();
    let plain = scene("/max_depth", json!(12));
    assert!(validator.is_valid(&plain));
    assert_eq!(complaint(&plain), None);
    // Both accept the ends of a range, and both refuse values beyond them.
    let (large, small) = (limits::LARGEST, limits::SMALLEST);
    let unit = ["ambient", "diffuse", "specular", "reflectivity", "transparency"];
    let mut ranges: Vec<(String, [f64; 2], [f64; 2])> = vec![
        ("/max_depth".into(), [0.0, 64.0], [-1.0, 65.0]),
        ("/min_weight".into(), [0.0, 1.0], [-1e-9, 1.000_001]),
        ("/ambient".into(), [0.0, large], [-1e-9, 1.001 * large]),
        ("/background/1".into(), [0.0, large], [-1e-9, 1e308]),
        ("/lights/0/point/color".into(), [0.0, large], [-1.0, 1e308]),
        ("/lights/0/point/position/2".into(), [-large, large], [-1e31, 1e31]),
        ("/camera/fov_deg".into(), [1e-300, 179.9], [0.0, 180.0]),
        ("/camera/eye/0".into(), [-100.0, large], [-1e31, 1e31]),
        ("/materials/m/color".into(), [0.0, large], [-1.0, 1e31]),
        ("/materials/m/shininess".into(), [1.0, 1e6], [0.999, 1_000_001.0]),
        ("/materials/m/index_of_refraction".into(), [0.1, 10.0], [0.099, 10.01]),
        ("/objects/0/sphere/radius".into(), [small, large], [0.0, 1e200]),
        ("/objects/0/sphere/center/1".into(), [-large, large], [-1e200, 1e200]),
        ("/objects/1/rectangle/repeat/0".into(), [small, large], [0.0, 1e31]),
        ("/objects/1/rectangle/corner/0".into(), [-large, large], [-1e31, 1e31]),
        ("/objects/1/rectangle/edge_u/0".into(), [-large, large], [-1e31, 1e31]),
        ("/objects/2/plane/point/1".into(), [-large, large], [-1e31, 1e31]),
    ];
    ranges.extend(unit.map(|key| (format!("/materials/m/{key}"), [0.0, 1.0], [-1e-9, 1.000_001])));
    for (place, within, beyond) in ranges {
        for value in within {
            let whole = place == "/max_depth";
            let value = if whole { json!(value as u32) } else { json!(value) };
            let scene = scene(&place, value.clone());
            assert!(validator.is_valid(&scene), "the schema refuses {place}: {value}");
            assert_eq!(complaint(&scene), None, "{place}: {value}");
        }
        for value in beyond {
            let value = if place == "/max_depth" { json!(value as i64) } else { json!(value) };
            let scene = scene(&place, value.clone());
            assert!(!validator.is_valid(&scene), "the schema takes {place}: {value}");
            let said = complaint(&scene).unwrap_or_else(|| panic!("{place}: {value} is taken"));
            assert!(said.starts_with("scene.json:1:"), "{said}");
        }
    }
}

#[test]
fn of_mutated_scenes_both_refuse_the_same() {
    let validator = validator();
    let judges = Judges {
        schema: &|scene| validator.is_valid(scene),
        types: &is_formed,
        reader: &|scene| complaint(scene).is_none(),
    };
    let part = json!({ "format": PART_FORMAT, "version": 1, "include": ["a.json"],
        "materials": { "m": { "color": [1, 0.5, 0], "diffuse": 0.5 } },
        "lights": [ { "point": { "position": [0, 9, 0] } } ] });
    let scenes = examples()
        .into_iter()
        .chain([("scene".into(), scene("/max_depth", json!(3))), ("part".into(), part)]);
    let (mut refused, mut taken) = (0, 0);
    for (name, scene) in scenes {
        let [of_form, valid] = judges.agree(&name, &variants(&scene));
        refused += of_form;
        taken += valid;
    }
    assert!(refused > 3000 && taken > 300, "{refused}, {taken}");
}
