//! Hostile files and names, passed through all programs.

use crate::support::{root, run, said};
use files::json::Document;
use files::words::unseen;
use files::{Disk, FileError, Source};
use proptest::prelude::*;
use render::scene::file::{PartFile, SceneFile};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use sweep::Object;
use sweep::spec::{Parts, Resolution, Spec};
use tempfile::tempdir;

/// A PNG of one pixel with a palette of 4 bytes, on which the decoder panics.
const PALETTE_OF_4_BYTES: &[u8] = b"\x89PNG\r\n\x1a\n\
    \0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x03\0\0\0\x28\xcb\x34\xbb\
    \0\0\0\x04PLTE\0\0\0\0\xb4\xa3\xae\x7a\
    \0\0\0\x0aIDAT\x78\x9c\x63\x60\0\0\0\x02\0\x01\x48\xaf\xa4\x71\
    \0\0\0\0IEND\xae\x42\x60\x82";

const TUBE: &str = r#"{"format": "tb-sweep", "version": 1, "name": "a", "contour": {"circle": 0.6},
"trajectory": {"line": [[0, 0, 0], [0, 2, 0]]}, "mesh": {"rows": 12, "cols": 12}}"#;

#[test]
fn a_palette_that_makes_the_decoder_panic_is_a_broken_file_everywhere() {
    let folder = tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).expect(name);
    write("a.png", PALETTE_OF_4_BYTES);
    let depth = r#""depth": {"mode": "factor", "image": {"file": "a.png", "amp": 0.1}}, "mesh""#;
    write("a.json", TUBE.replace("\"mesh\"", depth).as_bytes());
    for (program, arguments) in
        [("sweep", &["a.json", "-o", "a.grid"][..]), ("pipeline", &["compare", "a.png", "a.png"])]
    {
        let output = run(program, arguments, folder.path());
        let said = said(&output);
        assert_eq!(output.status.code(), Some(3), "{said}");
        assert!(said.contains("found no picture") && said.lines().count() == 1, "{said}");
    }
}

#[test]
fn a_grid_that_promises_more_than_there_is_memory_for_is_refused() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("a.json"), TUBE).expect("the spec");
    let made = run("sweep", &["a.json", "--format", "json", "-o", "a.grid"], folder.path());
    assert_eq!(made.status.code(), Some(0), "{}", said(&made));
    let text = fs::read_to_string(folder.path().join("a.grid")).expect("a grid of text");
    let text = text.replacen("\"rows\":13", "\"rows\":100000000", 1);
    assert!(text.contains("100000000"), "the header has changed");
    fs::write(folder.path().join("b.grid"), text).expect("the other grid");
    let output = run("triangulate", &["b.grid", "-o", "b.stl"], folder.path());
    let message = said(&output);
    assert_eq!(output.status.code(), Some(6), "{message}");
    assert!(message.contains("a mesh of ") && message.contains("--max-memory"), "{message}");
    // As OBJ the mesh is written row by row, until the end of the cut grid is found.
    let output = run("triangulate", &["b.grid", "-o", "b.obj"], folder.path());
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
}

#[test]
fn cells_of_a_tolerance_and_grids_in_memory_are_asked_for() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("a.json"), TUBE).expect("the spec");
    for arguments in [
        &["a.json", "--max-memory", "10M", "--tol", "1e-6", "-o", "a.grid"][..],
        &["a.json", "--max-memory", "10M", "--rows", "1000", "--cols", "1000", "--check"],
    ] {
        let output = run("sweep", arguments, folder.path());
        let said = said(&output);
        assert_eq!(output.status.code(), Some(6), "{said}");
        assert!(said.starts_with("sweep: a: ") && said.contains("--max-memory"), "{said}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    /// A name that `sweep` accepts is accepted by the programs after it.
    #[test]
    fn a_name_that_sweep_accepts_reaches_the_scene(
        name in prop::collection::vec(
            prop_oneof![
                any::<char>(),
                prop::sample::select(vec!['#', '\\', '"', '/', '-', '\u{202e}', '\u{feff}', '\u{85}', 'ä']),
            ],
            1..12,
        )
    ) {
        let name: String = name.into_iter().collect();
        let mut spec: Value = serde_json::from_str(TUBE).expect("it is JSON");
        spec["name"] = json!(name);
        let text = spec.to_string();
        let document = Document::new("a.json", text.as_bytes()).expect("it is text");
        let Ok(object) = Object::read(&document, Path::new(""), &Disk, &Resolution::default()) else {
            return Ok(());
        };
        let mut grid = Vec::new();
        object.write(sweep::grid::file::Encoding::Binary, &mut grid).expect("a grid");
        let mut reader = sweep::grid::file::GridReader::open("a.grid", &grid[..]).expect("a grid");
        prop_assert_eq!(&reader.header().name, &name);
        let mut obj = Vec::new();
        triangulate::write_obj(&mut reader, &triangulate::Options::default(), &mut obj)
            .expect("a mesh");
        let text = String::from_utf8(obj.clone()).expect("an OBJ is text");
        prop_assert!(!text.contains(|c: char| c != '\n' && unseen(c)), "{}", text);
        render::scene::obj::read("a.obj", &obj).expect("a mesh that render takes");
        let svg = sweep::preview::svg(&object, &[], &[]);
        prop_assert!(!svg.contains(|c: char| c != '\n' && c != '\t' && unseen(c)), "{}", svg);
    }
}

/// Replaces the values of a JSON text, one after another, by each of `by`. Values deeper than
/// `deep` stay.
fn mutated(value: &Value, by: &[Value], each: &mut impl FnMut(&Value)) {
    fn paths(value: &Value, path: &mut String, all: &mut Vec<String>) {
        all.push(path.clone());
        let length = path.len();
        let mut step = |key: &str, child: &Value, all: &mut Vec<String>| {
            path.push('/');
            path.push_str(key);
            paths(child, path, all);
            path.truncate(length);
        };
        match value {
            // In a long list the first few elements represent all.
            Value::Array(list) => list
                .iter()
                .take(3)
                .enumerate()
                .for_each(|(k, child)| step(&k.to_string(), child, all)),
            Value::Object(map) => map.iter().for_each(|(key, child)| step(key, child, all)),
            _ => {}
        }
    }
    let mut all = Vec::new();
    paths(value, &mut String::new(), &mut all);
    for path in all {
        for other in by {
            let mut mutant = value.clone();
            if let Some(place) = mutant.pointer_mut(&path) {
                *place = other.clone();
                each(&mutant);
            }
        }
    }
}

/// A source in which all files have one text.
#[derive(Debug)]
struct Text(String);

impl Source for Text {
    fn read(&self, _: &Path) -> Result<Vec<u8>, FileError> {
        Ok(self.0.clone().into_bytes())
    }
}

/// Returns the complaint about a text of one of the project's formats, if any.
fn complaint(format: &str, text: &str) -> Option<String> {
    let document = Document::new("a.json", text.as_bytes()).ok()?;
    let error = match format {
        "tb-scene" => document.parse::<SceneFile>().err(),
        "tb-scene-part" => document.parse::<PartFile>().err(),
        "tb-job" => {
            let source = Text(text.into());
            let job = pipeline::Job::read(Path::new("a.json"), &source);
            return job.err().map(|error| error.to_string());
        }
        _ if text.contains("\"parts\"") => document.parse::<Parts>().err(),
        _ => document.parse::<Spec>().err(),
    };
    error.map(|error| error.to_string())
}

#[test]
fn no_complaint_about_an_example_names_a_type_of_rust() {
    let by = [
        json!(null),
        json!(true),
        json!(-1.5),
        json!("zzz"),
        json!([]),
        json!([[[]]]),
        json!({}),
        json!({"zzz": 1}),
        json!(["zzz", {}]),
    ];
    let rusts = [
        "struct",
        "enum ",
        "tuple",
        "newtype",
        "variant",
        "unit",
        "f64",
        "f32",
        "u64",
        "u32",
        "usize",
        "i64",
        "string or map",
        "::",
        "Option",
        "sequence",
        "identifier",
    ];
    let (mut seen, mut texts) = (0, 0);
    for folder in ["examples/curves", "examples/scenes", "examples/pages"] {
        for entry in fs::read_dir(root().join(folder)).expect("the folder") {
            let path = entry.expect("a file").path();
            let Ok(text) = fs::read_to_string(&path) else { continue };
            let Ok(value) = serde_json::from_str::<Value>(&text) else { continue };
            let Some(format) = value["format"].as_str() else { continue };
            texts += 1;
            mutated(&value, &by, &mut |mutant| {
                let Some(said) = complaint(format, &mutant.to_string()) else { return };
                seen += 1;
                let expected = said.rsplit_once(", expected ").map_or(said.as_str(), |(_, e)| e);
                // `unit` is also a key of specs.
                let expected = expected.replace("`unit`", "").replace("unit: ", "");
                for rust in rusts {
                    assert!(!expected.contains(rust), "{}: {said}", path.display());
                }
                assert!(!said.contains("variant,") && !said.contains("sequence"), "{said}");
            });
        }
    }
    assert!(texts > 50 && seen > 10_000, "{texts} texts, {seen} complaints");
}
