//! The SVG of `--preview`: well formed, within its borders, and reproducible.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use serde_json::json;
use std::fs;
use std::path::Path;
use std::process::Command;
use sweep::spec::Resolution;
use sweep::{Object, check, preview};

fn page(text: &[u8]) -> String {
    let document = Document::new("a.json", text).unwrap();
    let object = Object::read(
        &document,
        Path::new("../examples/curves"),
        &files::Disk,
        &Resolution::default(),
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let grids = object.grids().unwrap();
    let findings = check::check(&object, &grids, None);
    preview::svg(&object, &grids, &findings)
}

/// Returns the elements of a page: name and attributes. Asserts that every element is closed, that
/// every value is quoted, and that texts contain only valid XML.
fn elements(page: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut open: Vec<String> = Vec::new();
    let mut found = Vec::new();
    let mut rest = page;
    while let Some((text, tail)) = rest.split_once('<') {
        assert_escaped(text);
        assert!(open.is_empty() == text.is_empty() || text == "\n" || !open.is_empty());
        let (tag, tail) = tail.split_once('>').unwrap();
        rest = tail;
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name));
            continue;
        }
        let (tag, alone) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
        let (name, mut left) = tag.split_once(' ').unwrap();
        let mut attributes = Vec::new();
        while let Some((key, tail)) = left.split_once("=\"") {
            let (value, tail) = tail.split_once('"').unwrap();
            assert_escaped(value);
            attributes.push((key.trim().to_owned(), value.to_owned()));
            left = tail;
        }
        assert_eq!(left.trim(), "", "{tag}");
        if !alone {
            open.push(name.into());
        }
        found.push((name.to_owned(), attributes));
    }
    assert_eq!((open.len(), rest), (0, "\n"));
    found
}

fn assert_escaped(text: &str) {
    assert!(!text.contains(['>', '\u{0}']), "{text}");
    for part in text.split('&').skip(1) {
        let known = ["amp;", "lt;", "gt;", "quot;"].iter().any(|name| part.starts_with(name));
        assert!(known, "{text}");
    }
}

/// Asserts that a page is well formed and that all its elements lie on it. Returns the number of
/// words of its texts.
fn assert_sound(page: &str) -> usize {
    assert!(page.len() < 1_000_000, "{}", page.len());
    let elements = elements(page);
    assert_eq!(elements[0].0, "svg");
    let mut seen = 0;
    for (name, attributes) in &elements {
        for (key, value) in attributes {
            let numbers: Vec<f64> = match (name.as_str(), key.as_str()) {
                ("path", "d") => value
                    .split(['M', 'L', 'Z', ' '])
                    .filter(|number| !number.is_empty())
                    .map(|number| number.parse().unwrap())
                    .collect(),
                (_, "x" | "y" | "cx" | "cy" | "r" | "width" | "height" | "stroke-width") => {
                    vec![value.parse().unwrap()]
                }
                _ => Vec::new(),
            };
            for (i, &number) in numbers.iter().enumerate() {
                let vertical = key.contains('y') || key == "height" || key == "d" && i % 2 == 1;
                let most = if vertical { 900.0 } else { 1200.0 };
                assert!((0.0..=most).contains(&number), "{name} {key}: {number}");
                seen += 1;
            }
        }
    }
    seen
}

fn examples() -> Vec<(String, Vec<u8>)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves");
    let mut files: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "json"));
    files.sort();
    let named = |path: &std::path::PathBuf| path.file_stem().unwrap().to_str().unwrap().to_owned();
    files.iter().map(|path| (named(path), fs::read(path).unwrap())).collect()
}

#[test]
fn every_example_has_a_sound_page_that_is_the_same_twice() {
    for (name, text) in examples() {
        let first = page(&text);
        assert!(assert_sound(&first) > 5000, "{name}");
        assert_eq!(first, page(&text), "{name}");
        for word in [">Contour", ">Trajector", ">Surface<", ">check: nothing wrong<"] {
            let told = word.contains("check") && first.contains(">hint: ");
            assert!(first.contains(word) || told, "{name}: {word}");
        }
    }
}

#[test]
fn the_page_tells_laws_folds_and_names() {
    let text = json!({
        "format": "tb-sweep", "version": 1, "name": "a<b&\"c\"", "contour": {"svg": "M1 1H-1V-1H1Z"},
        "trajectory": {"circle": {"radius": 0.5, "angle_deg": 200}}, "twist": {"total": 90},
        "scale": {"keys": [[0, 1], [1, 0.2]]}, "mesh": {"rows": 30, "cols": 12}
    });
    let page = page(text.to_string().as_bytes());
    assert_sound(&page);
    for words in [
        "a&lt;b&amp;&quot;c&quot;",
        ">folded rows<",
        ">crease<",
        ">rim<",
        ">twist, degrees<",
        ">scale<",
        ">wrong: trajectory: the surface folds back",
    ] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn sizes_and_places_beyond_all_bounds_still_fit_the_page() {
    for (size, position) in [(1e-30, 0.0), (1e50, 0.0), (1.0, 1e59)] {
        let text = json!({
            "format": "tb-sweep", "version": 1, "name": "far", "contour": {"circle": 0.1 * size},
            "trajectory": {"circle": {"radius": size}}, "mesh": {"rows": 9, "cols": 8},
            "position": [position, 0, -position]
        });
        assert_sound(&page(text.to_string().as_bytes()));
    }
}

#[test]
fn several_parts_are_drawn_on_one_page() {
    let part = |name: &str, radius: f64| {
        json!({"name": name, "contour": {"circle": 0.2}, "mesh": {"rows": 48, "cols": 24},
            "trajectory": {"circle": {"radius": radius}}, "twist": {"total": 360}})
    };
    let text = json!({"format": "tb-sweep", "version": 1, "name": "two",
        "parts": [part("inner", 1.0), part("outer", 2.0)]});
    let page = page(text.to_string().as_bytes());
    assert_sound(&page);
    for words in [">Contours<", ">Trajectories<", ">inner<", ">outer<", ">outer twist, degrees<"] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn the_program_writes_the_page_and_no_grid() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("vase.svg");
    let spec = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves/vase.json");
    let run = Command::new(env!("CARGO_BIN_EXE_sweep"))
        .args([spec, "--preview", svg.to_str().unwrap(), "--threads", "1"])
        .output()
        .unwrap();
    assert_eq!((run.status.code(), run.stdout.len()), (Some(0), 0));
    assert_eq!(fs::read_to_string(&svg).unwrap(), page(&fs::read(spec).unwrap()));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
