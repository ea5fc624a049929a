//! Every kind of fault is noticed, by a reader that fails on purpose.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use fixtures::program::run;
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

fn fuzz(arguments: &[&str]) -> Output {
    run(env!("CARGO_BIN_EXE_fuzz").as_ref(), arguments, Path::new("."), b"")
}

fn tried(folder: &Path, reader: &str, input: &str) -> (Option<i32>, String) {
    let path = folder.join("input");
    std::fs::write(&path, input).unwrap();
    let output = fuzz(&["--reader", reader, "--input", path.to_str().unwrap()]);
    (output.status.code(), String::from_utf8(output.stdout).unwrap())
}

#[test]
fn every_kind_of_fault_is_noticed() {
    let folder = tempdir().unwrap();
    for (input, kind) in [
        ("panic", "panic: src/reader/trap.rs"),
        ("abort", "died: ended by signal 6"),
        ("overflow", "died: ended by signal 6"),
        // 3072 MB; pages that the process had before may count as its own or not.
        ("memory", "memory: 307"),
        ("slow", "slow: 10."),
        ("message", "message: found the word \\\"struct\\\" of Rust"),
        ("broken", "broken: point 3"),
    ] {
        let (code, words) = tried(folder.path(), "trap", input);
        assert_eq!(code, Some(1), "{input}: {words}");
        assert!(words.contains(kind), "{input}: {words}");
    }
}

#[test]
fn a_sentence_and_a_taken_input_are_no_faults() {
    let folder = tempdir().unwrap();
    let (code, words) = tried(folder.path(), "trap", "refuse");
    assert!(code == Some(0) && words.contains("refused"), "{words}");
    let (code, words) = tried(folder.path(), "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert!(code == Some(0) && words.contains("accepted"), "{words}");
}

#[test]
fn a_number_of_cases_gives_the_same_table_for_any_number_of_processes() {
    let table = |jobs| {
        let output =
            fuzz(&["--reader", "mtl,svg", "--cases", "400", "--seed", "3", "--jobs", jobs]);
        let text = String::from_utf8(output.stdout).unwrap();
        let counts = |line: &str| line.split_whitespace().take(6).map(String::from).collect();
        text.lines().take(4).map(counts).collect::<Vec<Vec<String>>>()
    };
    let first = table("1");
    assert_eq!(first, table("2"));
    assert_eq!(first[3][..2], ["all", "400"]);
}

#[test]
fn the_seed_is_printed_and_bad_use_has_its_code() {
    let output = fuzz(&["--reader", "words", "--cases", "20"]);
    assert!(String::from_utf8(output.stderr).unwrap().starts_with("fuzz: seed "));
    assert_eq!(fuzz(&["--reader", "objs"]).status.code(), Some(2));
    assert_eq!(fuzz(&["--case", "3"]).status.code(), Some(2));
}
