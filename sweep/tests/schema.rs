//! The schema of specs and the reader accept the same documents.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::Disk;
use files::json::Document;
use fixtures::program;
use fixtures::schema::{Judges, documents, printed, undescribed};
use fixtures::variants::variants;
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

/// Returns the reader's complaint about a spec, if any.
fn complaint(spec: &Value) -> Option<String> {
    let text = spec.to_string();
    let document = Document::new("a.json", text.as_bytes()).unwrap();
    let folder = root().join("examples/curves");
    let read = Object::read(&document, &folder, &Disk, &Resolution::default());
    read.err().map(|error| error.to_string())
}

/// Returns whether the keys and types of a spec are those of the reader's types.
fn is_formed(spec: &Value) -> bool {
    if spec.get("parts").is_some_and(|parts| !parts.is_null()) {
        return serde_json::from_value::<Parts>(spec.clone()).is_ok();
    }
    let head = ["format", "version"].iter().all(|key| spec.get(key).is_some());
    head && serde_json::from_value::<Spec>(spec.clone()).is_ok()
}

/// Returns the examples with their paths.
fn examples() -> Vec<(String, Value)> {
    documents(&root().join("examples/curves"))
}

/// Returns the JSON snippets in the documentation of specs.
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
            // The documentation shows areas without their spec.
            let spec = if spec.is_array() { ring("areas", spec) } else { spec };
            found.push((page.display().to_string(), spec));
        }
    }
    found
}

/// Returns a ring with one key set, or removed by null.
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
    let program = Path::new(env!("CARGO_BIN_EXE_sweep"));
    let run = program::run(program, &["--emit-schema"], Path::new("."), b"");
    assert_eq!(printed(&run), schema);
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
    assert_eq!(undescribed(&schema::of_spec()), Vec::<String>::new());
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
        ("trajectory", json!({"free": {"points": [[0, 0, 0], [0, 0, 1]], "fit": 0}})),
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

#[test]
fn of_mutated_specs_both_refuse_the_same() {
    let validator = validator();
    let judges = Judges {
        schema: &|spec| validator.is_valid(spec),
        types: &is_formed,
        reader: &|spec| complaint(spec).is_none(),
    };
    let (mut refused, mut taken) = (0, 0);
    for (name, spec) in examples().into_iter().chain(snippets()) {
        let [of_form, valid] = judges.agree(&name, &variants(&spec));
        refused += of_form;
        taken += valid;
    }
    assert!(refused > 3000 && taken > 300, "{refused}, {taken}");
}
