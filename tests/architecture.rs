//! The shape of the house, held against the source: who may import whom, how long a file may be,
//! and that what the pages name is there.

pub mod source;

use source::{code, has_word, paths, read, root, rust_files, spans, without_tests};
use std::collections::BTreeSet;

/// The crates, and which of ours each may import.
const CRATES: [(&str, &[&str]); 7] = [
    ("files", &[]),
    ("sweep", &["files"]),
    ("triangulate", &["files", "sweep"]),
    ("render", &["files"]),
    ("compare", &["files", "render"]),
    ("pipeline", &["files", "sweep", "triangulate", "render", "compare"]),
    ("fuzz", &["files", "sweep", "triangulate", "render", "compare", "pipeline"]),
];

/// The rooms of a crate from the bottom up, and into which others each one looks: only at rooms
/// above it in this list, which is below it in the house.
type Rooms = &'static [(&'static str, &'static [&'static str])];

/// The rooms of `render`.
const RENDER: Rooms = &[
    ("color", &[]),
    ("optics", &[]),
    ("ray", &[]),
    ("shape", &[]),
    ("texture", &["color"]),
    ("procedural", &["color"]),
    ("scene", &["color", "optics", "procedural", "ray", "shape", "texture"]),
    ("accel", &["ray", "shape"]),
    ("trace", &["accel", "color", "optics", "procedural", "ray", "scene", "shape"]),
    ("footprint", &["color", "shape", "trace"]),
    ("filter", &["color", "footprint", "texture"]),
    (
        "shade",
        &["accel", "color", "filter", "footprint", "optics", "ray", "scene", "shape", "trace"],
    ),
    ("prepared", &["accel", "filter", "scene", "shade", "shape", "trace"]),
    ("stats", &["shade", "trace"]),
    (
        "film",
        &["accel", "color", "filter", "footprint", "prepared", "scene", "shade", "stats", "trace"],
    ),
    ("inspect", &["color", "film", "footprint", "prepared", "scene", "shade", "trace"]),
];

/// The rooms of `sweep`.
const SWEEP: Rooms = &[
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

/// The doors of a crate, which see all rooms.
const DOORS: [&str; 3] = ["lib", "main", "cli"];

/// Lines of a file at most, its tests included.
const LONGEST: usize = 400;

/// Library files that may print, each with the reason.
const PRINTERS: [(&str, &str); 1] =
    [("files/src/exit.rs", "the one place where the programs print an error")];

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
fn rooms_of_render_look_only_one_way() {
    look_only_one_way("render", RENDER);
}

#[test]
fn rooms_of_sweep_look_only_one_way() {
    look_only_one_way("sweep", SWEEP);
}

/// Checks that the rooms of a crate import each other as their list says.
fn look_only_one_way(krate: &str, rooms: Rooms) {
    for (at, (room, allowed)) in rooms.iter().enumerate() {
        for below in *allowed {
            let known = rooms[..at].iter().any(|(name, _)| name == below);
            assert!(known, "the list lets {room} look at {below}, which is not above it there");
        }
    }
    let source = format!("{krate}/src");
    let mut looks = BTreeSet::new();
    for file in rust_files(&source) {
        let module = module_of(file.strip_prefix(&source).unwrap().trim_start_matches('/'));
        if DOORS.contains(&module[0].as_str()) {
            continue;
        }
        let room =
            room_of(rooms, &module).unwrap_or_else(|| panic!("{file}: in no room of the list"));
        for path in paths(&without_tests(&code(&read(&file))), &["crate", "super"]) {
            let path = from_the_root(&module, &path);
            let Some(other) = room_of(rooms, &path) else {
                panic!("{file}: found crate::{}, expected a room of the list", path.join("::"));
            };
            if other == room {
                continue;
            }
            let (_, allowed) = rooms.iter().find(|(name, _)| *name == room).unwrap();
            assert!(
                allowed.contains(&other),
                "{file}: {room} looks at {other}, as no list lets it"
            );
            looks.insert((room, other));
        }
    }
    for (room, allowed) in rooms {
        for other in *allowed {
            assert!(
                looks.contains(&(*room, *other)),
                "{room} looks at {other} no more; take it off the list"
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

/// Cargo compiles only what `tests/main.rs` names: a file that is not a module there would never run.
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
fn files_and_folders_that_pages_name_exist() {
    for page in [
        "ARCHITECTURE.md",
        "docs/compare.md",
        "docs/conventions.md",
        "docs/hard-cases.md",
        "docs/mapping.md",
        "docs/thesis-map.md",
    ] {
        let text = read(page);
        let named = spans(&text);
        let named = named.iter().filter(|span| span.ends_with(".rs") || span.ends_with('/'));
        for span in named {
            assert!(is_there(span), "{page}: found `{span}`, expected a file or a folder");
        }
    }
}

#[test]
fn the_thesis_map_names_code_and_tests_that_exist() {
    let tests = test_functions();
    let page = read("docs/thesis-map.md");
    let rows: Vec<Vec<&str>> = page
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| Thesis "))
        .map(|line| line.split('|').collect())
        .collect();
    assert!(rows.len() > 20, "found {} rows, expected the whole thesis", rows.len());
    for row in rows {
        assert_eq!(row.len(), 6, "expected four columns: {row:?}");
        let (place, held_by) = (row[2], row[3]);
        let mut source = String::new();
        for span in spans(place) {
            if span.contains('/') {
                assert!(root().join(span).exists(), "{span} does not exist: {row:?}");
                source = code(&read(span));
            } else {
                assert!(has_word(&source, span), "`{span}` is not in that file: {row:?}");
            }
        }
        assert_held(held_by, &tests, &row);
    }
}

#[test]
fn the_hard_cases_are_held_by_tests_that_exist() {
    let tests = test_functions();
    let page = read("docs/hard-cases.md");
    let rows: Vec<Vec<&str>> = page
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| Asked "))
        .map(|line| line.split('|').collect())
        .collect();
    assert!(rows.len() > 30, "found {} rows, expected all cases", rows.len());
    for row in rows {
        assert_eq!(row.len(), 5, "expected three columns: {row:?}");
        assert_held(row[3], &tests, &row);
    }
}

/// Checks that a cell names tests that exist, or says that there are none yet.
fn assert_held(held_by: &str, tests: &BTreeSet<String>, row: &[&str]) {
    let named = spans(held_by);
    assert!(!named.is_empty() || held_by.contains("none yet"), "held by what? {row:?}");
    for test in named {
        assert!(tests.contains(test), "no test is called `{test}`: {row:?}");
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

/// Clashes are found because every file of a program goes through its ledger.
#[test]
fn programs_open_files_only_through_the_ledger() {
    let doors = ["Disk", "File::", "fs::read", "fs::write", "OpenOptions", "Output::check"];
    let programs = ["triangulate/src/main.rs", "triangulate/src/cli.rs"];
    let programs = programs.map(String::from).into_iter();
    let cli = |file: &String| file.contains("/cli.rs") || file.contains("/cli/");
    let rooms = ["sweep/src", "render/src", "pipeline/src"];
    let rooms = rooms.into_iter().flat_map(rust_files).filter(cli);
    for file in programs.chain(rooms) {
        let code = without_tests(&code(&read(&file)));
        for door in doors {
            let past = code
                .match_indices(door)
                .any(|(at, _)| !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'));
            assert!(!past, "{file}: found {door}, expected the ledger");
        }
        // Standard output clashes with no file, and the numbers of a report are claimed before.
        for (at, _) in code.match_indices("Output::create(") {
            let rest = &code[at + "Output::create(".len()..];
            let allowed = rest.starts_with("Path::new(") || file == "pipeline/src/cli/report.rs";
            assert!(allowed, "{file}: found an output that is not claimed");
        }
    }
}

/// The module of a file under `src`: `filter/axis.rs` is `filter::axis`, `filter/mod.rs` `filter`.
fn module_of(file: &str) -> Vec<String> {
    let path = file.trim_end_matches(".rs").trim_end_matches("/mod");
    path.split('/').map(Into::into).collect()
}

/// A path that starts with `crate` or `super` in a module, from the root of its crate.
fn from_the_root(module: &[String], path: &[String]) -> Vec<String> {
    let up = path.iter().take_while(|word| *word == "super").count();
    if up == 0 {
        return path[1..].to_vec();
    }
    [&module[..module.len() - up], &path[up..]].concat()
}

/// The room that a path from the root of its crate leads into.
fn room_of(rooms: Rooms, path: &[String]) -> Option<&'static str> {
    let first = path.first()?;
    rooms.iter().map(|(name, _)| *name).find(|name| name == first)
}

/// Whether a page's name for a file or a folder (with a slash at its end) leads to one: from the
/// root, from a crate, or from a crate's source.
fn is_there(name: &str) -> bool {
    let mut places = vec![root()];
    for (krate, _) in CRATES {
        places.push(root().join(krate));
        places.push(root().join(krate).join("src"));
    }
    places
        .iter()
        .map(|place| place.join(name))
        .any(|path| if name.ends_with('/') { path.is_dir() } else { path.is_file() })
}

/// The names of all test functions of the tree.
fn test_functions() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for file in rust_files("") {
        let code = code(&read(&file));
        for (at, mark) in code.match_indices("#[test]") {
            let rest = &code[at + mark.len()..];
            let name = rest.split_once("fn ").and_then(|(_, rest)| rest.split(['(', '<']).next());
            names.extend(name.map(String::from));
        }
    }
    names
}

/// Folders of tests have names of their own: what their page calls a file or a folder is there.
#[test]
fn the_page_of_tests_names_files_and_folders_that_exist() {
    let text = read("tests/README.md");
    let named = spans(&text);
    let named: Vec<_> =
        named.iter().filter(|span| span.ends_with(".rs") || span.ends_with('/')).collect();
    assert!(named.len() > 10, "found {named:?}, expected all folders of tests");
    for span in named {
        assert!(is_there(span), "tests/README.md: found `{span}`, expected a file or a folder");
    }
}

/// Manifests switch off what would be compiled for nothing: then nothing may be there that ought to run.
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

/// The number of code blocks in doc comments that have no other language than Rust.
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
