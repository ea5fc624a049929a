//! Checks the structure of the source: imports between crates and between modules, and the length of
//! files. [`pages`] checks the names on the project's pages.

mod pages;
pub mod source;

use source::{code, has_word, paths, read, root, rust_files, without_tests};
use std::collections::BTreeSet;

/// The crates of the workspace, and for each the crates among them that it may import.
const CRATES: [(&str, &[&str]); 7] = [
    ("files", &[]),
    ("sweep", &["files"]),
    ("triangulate", &["files", "sweep"]),
    ("render", &["files"]),
    ("compare", &["files", "render"]),
    ("pipeline", &["files", "sweep", "triangulate", "render", "compare"]),
    ("fuzz", &["files", "sweep", "triangulate", "render", "compare", "pipeline"]),
];

/// The modules of a crate from the lowest layer to the highest, and for each the modules that it
/// imports. A module imports only modules above it in the list.
type Layers = &'static [(&'static str, &'static [&'static str])];

/// The modules of `render`.
const RENDER: Layers = &[
    ("color", &[]),
    ("differential", &[]),
    ("optics", &[]),
    ("ray", &[]),
    ("shape", &["differential"]),
    ("texture", &["color"]),
    ("procedural", &["color"]),
    ("scene", &["color", "differential", "optics", "procedural", "ray", "shape", "texture"]),
    ("showcase", &["color", "scene", "shape"]),
    ("accel", &["ray", "shape"]),
    (
        "trace",
        &[
            "accel",
            "color",
            "differential",
            "optics",
            "procedural",
            "ray",
            "scene",
            "shape",
            "texture",
        ],
    ),
    ("footprint", &["color", "differential", "shape", "trace"]),
    ("filter", &["color", "footprint", "texture"]),
    (
        "shade",
        &[
            "accel",
            "color",
            "differential",
            "filter",
            "footprint",
            "optics",
            "ray",
            "scene",
            "shape",
            "trace",
        ],
    ),
    ("stock", &["accel", "filter", "scene", "shape", "texture"]),
    ("prepared", &["accel", "filter", "scene", "shade", "shape", "stock", "trace"]),
    ("stats", &["shade", "trace"]),
    (
        "film",
        &[
            "accel",
            "color",
            "filter",
            "footprint",
            "prepared",
            "procedural",
            "ray",
            "scene",
            "shade",
            "shape",
            "stats",
            "trace",
        ],
    ),
    ("accuracy", &["film", "prepared", "stats"]),
    ("inspect", &["color", "film", "footprint", "prepared", "scene", "shade", "trace"]),
];

/// The modules of `sweep`.
const SWEEP: Layers = &[
    ("error", &[]),
    ("limits", &[]),
    ("curve", &[]),
    ("law", &["curve"]),
    ("frame", &["curve"]),
    ("grid", &["limits"]),
    ("spec", &["grid", "law", "limits"]),
    ("trajectory", &["curve", "frame", "law"]),
    ("surface", &["curve", "frame", "grid", "law", "trajectory"]),
    ("sampling", &["curve", "error", "grid", "spec", "surface", "trajectory"]),
    (
        "read",
        &[
            "curve",
            "error",
            "frame",
            "grid",
            "law",
            "limits",
            "sampling",
            "spec",
            "surface",
            "trajectory",
        ],
    ),
    ("check", &["curve", "grid", "sampling", "spec", "surface"]),
    ("preview", &["check", "curve", "frame", "grid", "law", "sampling"]),
];

/// The entry points of a crate, which may import all of its modules.
const ENTRY_POINTS: [&str; 3] = ["lib", "main", "cli"];

/// Largest number of lines of a file, including its tests.
const LONGEST: usize = 400;

/// Library files that may print, each with the reason.
const PRINTERS: [(&str, &str); 1] =
    [("files/src/exit.rs", "the only function with which the programs print an error")];

#[test]
fn crates_import_only_what_they_may() {
    let ours = CRATES.map(|(name, _)| name);
    for (name, allowed) in CRATES {
        let may = |other: &str| other == name || allowed.contains(&other) || !ours.contains(&other);
        let mut table = String::new();
        for line in read(&format!("{name}/Cargo.toml")).lines() {
            if line.starts_with('[') {
                table = line.into();
            }
            let key = line.split(['.', ' ', '=']).next().unwrap_or_default();
            let fits = !table.contains("dependencies") || may(key);
            assert!(fits, "{name}/Cargo.toml: found {key} in {table}, expected only {allowed:?}");
        }
        for file in rust_files(name) {
            for path in paths(&code(&read(&file)), &ours) {
                assert!(may(&path[0]), "{file}: found {path:?}, expected only {allowed:?}");
            }
        }
    }
}

#[test]
fn modules_of_render_import_only_lower_layers() {
    assert_layers("render", RENDER);
}

#[test]
fn modules_of_sweep_import_only_lower_layers() {
    assert_layers("sweep", SWEEP);
}

/// Asserts that the modules of a crate import exactly the modules that `layers` allows.
fn assert_layers(krate: &str, layers: Layers) {
    for (at, (layer, allowed)) in layers.iter().enumerate() {
        for lower in *allowed {
            let known = layers[..at].iter().any(|(name, _)| name == lower);
            assert!(known, "the list allows {layer} to import {lower}, which is not above it");
        }
    }
    let source = format!("{krate}/src");
    let mut imports = BTreeSet::new();
    for file in rust_files(&source) {
        let module = module_of(file.strip_prefix(&source).unwrap().trim_start_matches('/'));
        if ENTRY_POINTS.contains(&module[0].as_str()) {
            continue;
        }
        let layer =
            layer_of(layers, &module).unwrap_or_else(|| panic!("{file}: in no module of the list"));
        for path in paths(&without_tests(&code(&read(&file))), &["crate", "super"]) {
            let path = from_the_root(&module, &path);
            let Some(other) = layer_of(layers, &path) else {
                panic!("{file}: found crate::{}, expected a module of the list", path.join("::"));
            };
            if other == layer {
                continue;
            }
            let (_, allowed) = layers.iter().find(|(name, _)| *name == layer).unwrap();
            assert!(
                allowed.contains(&other),
                "{file}: {layer} imports {other}, which the list does not allow"
            );
            imports.insert((layer, other));
        }
    }
    for (layer, allowed) in layers {
        for other in *allowed {
            assert!(
                imports.contains(&(*layer, *other)),
                "{layer} does not import {other}; remove it from the list"
            );
        }
    }
}

#[test]
fn no_file_is_long() {
    for file in rust_files("") {
        let lines = read(&file).lines().count();
        assert!(lines <= LONGEST, "{file}: found {lines} lines, expected at most {LONGEST}");
    }
}

/// Cargo compiles only the modules of `tests/main.rs`. The tests of any other file would never run.
#[test]
fn every_test_file_is_a_module_of_the_test_binary() {
    for folder in ["tests", "fuzz/tests", "render/tests", "sweep/tests", "triangulate/tests"] {
        let main = code(&read(&format!("{folder}/main.rs")));
        for file in rust_files(folder) {
            let name = file.strip_prefix(folder).unwrap().trim_start_matches('/');
            let module = name.trim_end_matches(".rs").trim_end_matches("/mod");
            if module != "main" && !module.contains('/') {
                assert!(
                    main.contains(&format!("mod {module};")),
                    "{file}: not in {folder}/main.rs"
                );
            }
        }
    }
}

#[test]
fn every_lint_let_pass_has_its_reason() {
    for file in rust_files("") {
        let code = code(&read(&file));
        for attribute in ["[allow(", "[expect("] {
            for (at, _) in code.match_indices(attribute) {
                let end = code[at..].find(']').map_or(code.len(), |end| at + end);
                let line = 1 + code[..at].matches('\n').count();
                assert!(code[at..end].contains("reason ="), "{file}:{line}: without a reason");
            }
        }
    }
}

#[test]
fn libraries_do_not_print() {
    for (name, _) in CRATES {
        let source = format!("{name}/src");
        let main = format!("{source}/main.rs");
        let of_program = |file: &str| {
            let module = module_of(file.strip_prefix(&format!("{source}/")).unwrap());
            root().join(&main).exists()
                && (file == main || code(&read(&main)).contains(&format!("mod {};", module[0])))
        };
        for file in rust_files(&source).iter().filter(|file| !of_program(file)) {
            let code = without_tests(&code(&read(file)));
            let prints = ["print!", "println!", "eprint!", "eprintln!", "dbg!"]
                .into_iter()
                .find(|print| has_word(&code, print));
            if !PRINTERS.iter().any(|(name, _)| name == file) {
                assert_eq!(prints, None, "{file}: a library prints");
            }
        }
    }
}

/// The ledger finds clashes only if a program opens every file through it.
#[test]
fn programs_open_files_only_through_the_ledger() {
    let direct = ["Disk", "File::", "fs::read", "fs::write", "OpenOptions", "Output::check"];
    let programs = ["triangulate/src/main.rs", "triangulate/src/cli.rs"];
    let programs = programs.map(String::from).into_iter();
    let cli = |file: &String| file.contains("/cli.rs") || file.contains("/cli/");
    let sources = ["sweep/src", "render/src", "pipeline/src"];
    let sources = sources.into_iter().flat_map(rust_files).filter(cli);
    for file in programs.chain(sources) {
        let code = without_tests(&code(&read(&file)));
        for name in direct {
            let found = code
                .match_indices(name)
                .any(|(at, _)| !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'));
            assert!(!found, "{file}: found {name}, expected the ledger");
        }
        // Standard output clashes with no file, and the ledger knows the numbers of a report.
        for (at, _) in code.match_indices("Output::create(") {
            let rest = &code[at + "Output::create(".len()..];
            let allowed = rest.starts_with("Path::new(") || file == "pipeline/src/cli/report.rs";
            assert!(allowed, "{file}: found an output that is not claimed");
        }
    }
}

/// Returns the module path of a file under `src`: `filter::axis` for `filter/axis.rs`, `filter` for
/// `filter/mod.rs`.
fn module_of(file: &str) -> Vec<String> {
    let path = file.trim_end_matches(".rs").trim_end_matches("/mod");
    path.split('/').map(Into::into).collect()
}

/// Returns a path that starts with `crate` or `super` in a module as a path from the crate's root.
fn from_the_root(module: &[String], path: &[String]) -> Vec<String> {
    let up = path.iter().take_while(|word| *word == "super").count();
    if up == 0 {
        return path[1..].to_vec();
    }
    [&module[..module.len() - up], &path[up..]].concat()
}

/// Returns the module of the list that contains a path from the root of its crate.
fn layer_of(layers: Layers, path: &[String]) -> Option<&'static str> {
    let first = path.first()?;
    layers.iter().map(|(name, _)| *name).find(|name| name == first)
}

/// Manifests disable targets without tests, which saves their compilation. Such a target may then
/// have no tests.
#[test]
fn targets_that_are_not_tested_have_no_tests() {
    for (name, _) in CRATES {
        let manifest = read(&format!("{name}/Cargo.toml"));
        let source = format!("{name}/src");
        let cli =
            [format!("{source}/main.rs"), format!("{source}/cli.rs"), format!("{source}/cli/")];
        for file in rust_files(&source) {
            let text = read(&file);
            let of_program = cli.iter().any(|start| file.starts_with(start));
            if manifest.contains("\ntest = false") && of_program {
                assert!(!code(&text).contains("#[test]"), "{file}: a test that never runs");
            }
            if manifest.contains("doctest = false") {
                assert_eq!(rust_examples(&text), 0, "{file}: an example that is never tried");
            }
        }
    }
}

/// Returns the number of Rust code blocks in doc comments.
fn rust_examples(text: &str) -> usize {
    let docs = text.lines().map(str::trim_start);
    let docs = docs.filter_map(|line| line.strip_prefix("//!").or(line.strip_prefix("///")));
    let fences = docs.filter_map(|line| line.trim_start().strip_prefix("```"));
    // Every other fence opens a block.
    fences.step_by(2).filter(|language| language.is_empty() || language.starts_with("rust")).count()
}

#[test]
fn only_tests_link_the_fixtures_of_tests() {
    for (name, _) in CRATES.into_iter().filter(|(name, _)| *name != "fuzz") {
        let manifest = read(&format!("{name}/Cargo.toml"));
        let of_product = manifest.split("[dev-dependencies]").next().unwrap_or_default();
        assert!(!of_product.contains("fixtures"), "{name}/Cargo.toml: fixtures outside of tests");
    }
}
