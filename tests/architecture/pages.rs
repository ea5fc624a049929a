//! Pages of the project name files, code and tests that exist.

use super::CRATES;
use super::source::{code, has_word, read, root, rust_files, spans};
use std::collections::BTreeSet;

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
        let (position, held_by) = (row[2], row[3]);
        let mut source = String::new();
        for span in spans(position) {
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

/// Asserts that a cell names tests that exist, or states "none yet".
fn assert_held(held_by: &str, tests: &BTreeSet<String>, row: &[&str]) {
    let named = spans(held_by);
    assert!(
        !named.is_empty() || held_by.contains("none yet"),
        "expected a test or `none yet`: {row:?}"
    );
    for test in named {
        assert!(tests.contains(test), "no test is called `{test}`: {row:?}");
    }
}

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

/// Returns whether a path on a page is that of a file, or of a folder if it ends with a slash. The
/// path starts at the root, at a crate, or at a crate's source.
fn is_there(name: &str) -> bool {
    let mut folders = vec![root()];
    for (krate, _) in CRATES {
        folders.push(root().join(krate));
        folders.push(root().join(krate).join("src"));
    }
    folders
        .iter()
        .map(|folder| folder.join(name))
        .any(|path| if name.ends_with('/') { path.is_dir() } else { path.is_file() })
}

/// Returns the names of all test functions of the workspace.
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
