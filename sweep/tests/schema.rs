//! The schema of specs against the reader: what one takes the other takes.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::Disk;
use files::json::Document;
use jsonschema::Validator;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use sweep::spec::{Parts, Resolution, Spec};
use sweep::{Object, schema};

fn validator() -> Validator {
    jsonschema::draft202012::new(&schema::of_spec()).unwrap()
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// What the reader says of a spec.
fn complaint(spec: &Value) -> Option<String> {
    let text = spec.to_string();
    let document = Document::new("a.json", text.as_bytes()).unwrap();
    let folder = root().join("examples/curves");
    let read = Object::read(&document, &folder, &Disk, &Resolution::default());
    read.err().map(|error| error.to_string())
}

/// Whether the keys and the types of a spec are what the reader's types ask for.
fn is_formed(spec: &Value) -> bool {
    if spec.get("parts").is_some_and(|parts| !parts.is_null()) {
        return serde_json::from_value::<Parts>(spec.clone()).is_ok();
    }
    let head = ["format", "version"].iter().all(|key| spec.get(key).is_some());
    head && serde_json::from_value::<Spec>(spec.clone()).is_ok()
}

/// The examples, by their names.
fn examples() -> Vec<(String, Value)> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(root().join("examples/curves"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|kind| kind == "json"))
        .collect();
    files.sort();
    let read = |path: &PathBuf| serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    files.iter().map(|path| (path.display().to_string(), read(path))).collect()
}

/// The specs on the pages of the spec.
fn snippets() -> Vec<(String, Value)> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut pages: Vec<PathBuf> = std::fs::read_dir(source.join("spec"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .chain([source.join("spec.rs")])
        .collect();
    pages.sort();
    let mut found = Vec::new();
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap();
        let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
        let text: String = lines.map(|line| format!("{line}\n")).collect();
        for snippet in text.split("```json").skip(1) {
            let spec: Value = serde_json::from_str(snippet.split("```").next().unwrap()).unwrap();
            // Areas are shown alone.
            let spec = if spec.is_array() { ring("areas", spec) } else { spec };
            found.push((page.display().to_string(), spec));
        }
    }
    found
}

/// A ring with one key set, or taken out by null.
fn ring(key: &str, value: Value) -> Value {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "ring",
        "contour": { "circle": 0.25 },
        "trajectory": { "circle": { "radius": 1 } },
        "mesh": { "rows": 96, "cols": 32 },
    });
    if value.is_null() {
        spec.as_object_mut().unwrap().remove(key).unwrap();
    } else {
        spec[key] = value;
    }
    spec
}

#[test]
fn the_schema_is_one_and_the_program_prints_it() {
    let schema = schema::of_spec();
    assert!(jsonschema::draft202012::meta::is_valid(&schema));
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_sweep")).arg("--emit-schema").output();
    let run = run.unwrap();
    assert_eq!((run.status.code(), run.stderr.len()), (Some(0), 0));
    assert!(run.stdout.ends_with(b"}\n"));
    assert_eq!(serde_json::from_slice::<Value>(&run.stdout).unwrap(), schema);
}

#[test]
fn every_example_and_every_snippet_is_valid() {
    let validator = validator();
    let (examples, snippets) = (examples(), snippets());
    assert!(examples.len() >= 12 && snippets.len() >= 18);
    for (name, mut spec) in examples.into_iter().chain(snippets) {
        validator.validate(&spec).unwrap_or_else(|error| panic!("{name}: {error}"));
        spec["$schema"] = json!("tb-sweep.schema.json");
        assert!(validator.is_valid(&spec) && is_formed(&spec), "{name}");
    }
}

#[test]
fn every_key_says_what_it_is() {
    fn undescribed(at: &str, schema: &Value, found: &mut Vec<String>) {
        for (name, property) in schema["properties"].as_object().into_iter().flatten() {
            let at = format!("{at}.{name}");
            if property["description"].as_str().is_none_or(|text| text.ends_with(':')) {
                found.push(at.clone());
            }
            undescribed(&at, property, found);
        }
    }
    let schema = schema::of_spec();
    let mut found = Vec::new();
    for (name, kind) in schema["$defs"].as_object().unwrap() {
        undescribed(name, kind, &mut found);
    }
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn what_the_reader_refuses_for_its_form_or_its_size_the_schema_refuses() {
    let validator = validator();
    let cases = [
        ("format", json!("tb-grid")),
        ("version", json!(2)),
        ("format", Value::Null),
        ("version", Value::Null),
        ("mesh", Value::Null),
        ("name", json!("a ring")),
        ("name", json!("")),
        ("position", json!([0, 1e99, 0])),
        ("position", json!([0, 1])),
        ("uv", json!({"repeat": [1, 0]})),
        ("uv", json!({"repeat": [1e31, 1]})),
        ("uv", json!({"accross": "contour"})),
        ("contour", json!({"circle": -1})),
        ("contour", json!({"circle": 1e-90})),
        ("contour", json!({"squircle": 1})),
        ("contour", json!({})),
        ("contour", json!({"circle": 1, "svg": ""})),
        ("contour", json!({"circle": 1, "blend": "smooth"})),
        ("contour", json!({"bezier": {"segments": []}})),
        ("contour", json!({"free": {"points": [[0, 0]]}})),
        ("contour", json!({"free": {"closed": true, "points": [[0, 0], [1, 0]]}})),
        ("contour", json!({"free": {"points": [[0, 0], [1, 0]], "fit": 0}})),
        ("contour", json!({"free": {"points": [[0, 0, 0], [1, 0]]}})),
        ("contour", json!({"polyline": {"points": [[1, 1], [2, 2]], "fit": 1}})),
        ("contour", json!({"sections": [{"at": 0, "contour": {"circle": 1}}]})),
        (
            "contour",
            json!({"sections": [
            {"at": 0, "contour": {"circle": 1}}, {"at": 1.5, "contour": {"circle": 2}}]}),
        ),
        ("contour", json!({"sections": [{"at": 0, "contour": {"circle": 1}}, {"at": 1}]})),
        ("trajectory", json!({"line": [[1, 1, 1], [1, 1e80, 1]]})),
        ("trajectory", json!({"circle": {"radius": 0}})),
        ("trajectory", json!({"circle": {"radius": 1, "angle_deg": 361}})),
        ("trajectory", json!({"rotation": {"angle_deg": 0}})),
        ("trajectory", json!({"helix": {"radius": 1, "rise": 1, "turns": 0}})),
        ("trajectory", json!({"helix": {"radius": 1, "turns": 1}})),
        ("trajectory", json!({"free": {"points": [[0, 0, 0], [0, 0, 1]], "fit": 1}})),
        ("trajectory", json!({"flat": {"curve": {"circle": 1}, "z": 0}})),
        ("trajectory", json!({"flat": {"curve": {"svg": "M0 0H1"}}})),
        (
            "trajectory",
            json!({"polyline": {
            "points": [[0, 0, 0], [0, 0, 1]], "corners": {"mitre": 0.5}}}),
        ),
        (
            "trajectory",
            json!({"polyline": {
            "points": [[0, 0, 0], [0, 0, 1]], "corners": {"round": 1, "mitre": 4}}}),
        ),
        ("frame", json!({"guide": {"rotation": {}}})),
        ("frame", json!({"up": [0, 1, 0], "frenet": {}})),
        ("frame", json!({"frenet": {"up": 1}})),
        ("scale", json!({"keys": []})),
        ("scale", json!({"keys": [[0, 1], [1.5, 1]]})),
        ("scale", json!({"total": 1, "ease": "smooth"})),
        ("scale", json!([1])),
        ("scale", json!([1, 1, 1])),
        ("twist", json!("270")),
        ("twist", json!(1e61)),
        ("depth", json!({"mode": "factor", "terms": []})),
        ("depth", json!({"mode": "deep", "terms": [{"amp": 0.1}]})),
        ("depth", json!({"mode": "factor", "terms": [{}]})),
        ("depth", json!({"mode": "factor", "terms": [{"amp": 0.1, "u": 1e7}]})),
        ("depth", json!({"mode": "factor", "image": {"amp": 0.1}})),
        ("seam", json!("moebius")),
        ("caps", json!({"start": {"dome": -1}})),
        ("caps", json!({"middle": "flat"})),
        ("deform", json!([{}])),
        ("deform", json!([{"taper": {"from": 0, "to": 1}}])),
        ("deform", json!([{"bend": {"from": 0, "to": 1, "degrees": 9e9, "toward": [1, 0, 0]}}])),
        ("areas", json!([{"rows": [0, 1], "cols": [0, 1], "repeat": [0, 1]}])),
        ("areas", json!([{"rows": [0, -1], "cols": [0, 1]}])),
        ("mesh", json!({"rows": 9})),
        ("mesh", json!({"rows": 0, "cols": 9})),
        ("mesh", json!({"rows": 9.5, "cols": 9})),
        ("mesh", json!({"rows": 9, "cols": 9, "tol": 1})),
        ("mesh", json!({"max_quads": 9})),
        ("mesh", json!({"tol": -1})),
        ("mesh", json!({"angle_deg": 90})),
        ("mesh", json!({"tol": 1, "pixels": 1})),
        (
            "mesh",
            json!({"tol": 1, "camera": {
            "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 40, "size": [9, 9]}}),
        ),
        (
            "mesh",
            json!({"pixels": 1, "camera": {
            "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 180, "size": [9, 9]}}),
        ),
        ("texture", json!(-1)),
        ("parts", json!([])),
        ("$schema", json!(7)),
    ];
    assert!(validator.is_valid(&ring("$schema", json!("a"))));
    for (key, value) in cases {
        let spec = ring(key, value.clone());
        assert!(complaint(&spec).is_some(), "the reader takes {key}: {value}");
        assert!(!validator.is_valid(&spec), "the schema takes {key}: {value}");
    }
}

/// All specs that differ from one in one place: a key dropped or renamed, a value of another type.
fn mutations(spec: &Value) -> Vec<Value> {
    fn places(at: String, value: &Value, found: &mut Vec<String>) {
        match value {
            Value::Object(keys) => {
                for (key, value) in keys {
                    places(format!("{at}/{key}"), value, found);
                }
            }
            // Of many elements the first two and the last stand for all.
            Value::Array(items) => {
                for (i, item) in items.iter().enumerate() {
                    if i < 2 || i + 1 == items.len() {
                        places(format!("{at}/{i}"), item, found);
                    }
                }
            }
            _ => {}
        }
        found.push(at);
    }
    let mut found = Vec::new();
    places(String::new(), spec, &mut found);
    let mut mutated = Vec::new();
    for place in found {
        let others = [
            json!(true),
            json!("word"),
            json!({}),
            json!({"a": 1}),
            json!(-1.5),
            json!([[1, 2], 3]),
        ];
        for other in others {
            let mut spec = spec.clone();
            *spec.pointer_mut(&place).unwrap() = other;
            mutated.push(spec);
        }
        let Some((above, key)) = place.rsplit_once('/') else { continue };
        let mut dropped = spec.clone();
        match dropped.pointer_mut(above).unwrap() {
            Value::Object(keys) => {
                let value = keys.remove(key).unwrap();
                mutated.push(dropped.clone());
                let keys = dropped.pointer_mut(above).unwrap().as_object_mut().unwrap();
                keys.insert(format!("{key}x"), value);
            }
            Value::Array(items) => {
                items.remove(key.parse().unwrap());
            }
            _ => {}
        }
        mutated.push(dropped);
    }
    mutated
}

#[test]
fn of_mutated_specs_both_refuse_the_same() {
    let validator = validator();
    let (mut formed, mut refused) = (0, 0);
    for (name, spec) in examples().into_iter().chain(snippets()) {
        for spec in mutations(&spec) {
            let valid = validator.is_valid(&spec);
            if !is_formed(&spec) {
                assert!(!valid, "{name}: the schema takes {spec}");
                refused += 1;
            } else if !valid {
                // The schema is never stricter than the reader in the end.
                assert!(complaint(&spec).is_some(), "{name}: the schema refuses {spec}");
            } else {
                formed += 1;
            }
        }
    }
    println!("{refused} refused for their form, {formed} taken");
    assert!(refused > 3000 && formed > 300, "{refused}, {formed}");
}
