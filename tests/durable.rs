//! Written files are durable, and files that cannot be written are reported.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]

use crate::support::{programs, said, shell_beside_examples as shell};
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

const PRINTERS: [&str; 6] = [
    "sweep examples/curves/vase.json",
    "sweep examples/curves/vase.json --check",
    "sweep --emit-schema",
    "render examples/scenes/glass-sphere.json --size 4x4 --format png -o -",
    "render examples/scenes/glass-sphere.json --size 4x4 --pixel 1,1",
    "pipeline list",
];

#[test]
fn a_standard_output_that_is_closed_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    for line in PRINTERS {
        for closed in
            [format!("{line} >&-"), format!("( {line} ) >&-"), format!("exec >&-; {line}")]
        {
            let ran = shell(&closed, folder.path());
            assert_eq!(ran.status.code(), Some(5), "{closed}: {}", said(&ran));
            let told = "cannot write <stdout>: it was closed when the program started\n";
            assert!(said(&ran).ends_with(told), "{closed}: {}", said(&ran));
        }
    }
}

#[test]
fn a_standard_output_that_is_thrown_away_or_not_used_is_none() {
    let folder = tempfile::tempdir().unwrap();
    for line in PRINTERS {
        let ran = shell(&format!("{line} > /dev/null"), folder.path());
        assert!(ran.status.success(), "{line}: {}", said(&ran));
    }
    let ran = shell("sweep examples/curves/vase.json -o a.grid >&-", folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    // The standard streams that Python and Node use to discard output: /dev/null, open for reading
    // and writing.
    let null = || File::options().read(true).write(true).open("/dev/null").unwrap();
    for stdout in [Stdio::from(null()), Stdio::null()] {
        let mut command = Command::new(programs().join("pipeline"));
        assert!(command.arg("list").stdout(stdout).status().unwrap().success());
    }
}

#[test]
fn a_file_that_outgrows_its_limit_is_told_by_its_name_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let made = shell("sweep examples/curves/vase.json -o vase.grid", folder.path());
    assert!(made.status.success(), "{}", said(&made));
    fs::write(folder.path().join("a.obj"), "old").unwrap();
    let before = names(folder.path());
    for (line, file) in [
        ("sweep examples/curves/vase.json -o a.grid", "a.grid"),
        ("triangulate vase.grid -o a.obj --mtl --report a.json", "a.obj"),
        ("triangulate vase.grid --format stl -o a.stl", "a.stl"),
        ("render examples/scenes/glass-sphere.json --size 64x64 -o a.png", "a.png"),
    ] {
        let ran = shell(&format!("ulimit -f 1; {line}"), folder.path());
        assert_eq!(ran.status.code(), Some(5), "{line}: {}", said(&ran));
        let said = said(&ran);
        let told = format!(": cannot write {file}: File too large");
        assert!(said.contains(&told) && said.lines().count() == 1, "{line}: {said}");
        assert!(!said.contains(".part"), "{said}");
        assert_eq!(names(folder.path()), before, "{line}");
    }
    assert_eq!(fs::read(folder.path().join("a.obj")).unwrap(), b"old");
    let ran = shell("ulimit -f 1; sweep examples/curves/vase.json > b.grid", folder.path());
    assert_eq!(ran.status.code(), Some(5));
    assert!(said(&ran).contains("cannot write <stdout>: File too large"), "{}", said(&ran));
}

/// Returns the system calls of a command line that write, sync and rename files of its folder, in
/// order: `write part`, `sync part`, `rename a`, `sync folder` and so on. Returns `None` without
/// `strace`.
fn trace(line: &str, folder: &Path) -> Option<Vec<String>> {
    if Command::new("strace").arg("-V").output().is_err() {
        eprintln!(
            "skipped: strace is not installed, so the order of system calls was not looked at"
        );
        return None;
    }
    let calls = "write,writev,fsync,fdatasync,rename,renameat,renameat2,unlink,unlinkat";
    let traced = format!("strace -f -y -qq -e signal=none -e trace={calls} -o trace.txt {line}");
    let ran = shell(&traced, folder);
    assert!(ran.status.success(), "{line}: {}", said(&ran));
    let folder = fs::canonicalize(folder).unwrap().display().to_string();
    let text = fs::read_to_string(format!("{folder}/trace.txt")).unwrap();
    let name = |path: &str| match path.rsplit('/').next() {
        _ if path == folder => "folder".to_string(),
        Some(name) if name.starts_with('.') => "part".into(),
        name => name.unwrap_or_default().into(),
    };
    let mut seen: Vec<String> = Vec::new();
    for call in text.lines().filter_map(|line| line.split_once(' ')) {
        let call = call.1.trim_start();
        let (verb, rest) = call.split_once('(').unwrap_or((call, ""));
        let open = rest.split_once('<').and_then(|(_, rest)| rest.split_once('>'));
        let quoted: Vec<&str> = rest.split('"').skip(1).step_by(2).collect();
        let event = match (verb, open) {
            ("write" | "writev", Some((path, _))) if path.starts_with(&folder) => {
                format!("write {}", name(path))
            }
            ("fsync" | "fdatasync", Some((path, _))) => format!("sync {}", name(path)),
            (rename, _) if rename.starts_with("rename") => format!("rename {}", name(quoted[1])),
            (unlink, _) if unlink.starts_with("unlink") => format!("remove {}", name(quoted[0])),
            _ => continue,
        };
        if seen.last() != Some(&event) {
            seen.push(event);
        }
    }
    Some(seen)
}

/// Returns the calls from the first `write` on. Earlier calls test whether files can be written.
fn from_first_write(calls: &[String]) -> Vec<&str> {
    let first = calls.iter().position(|call| call.starts_with("write")).unwrap();
    calls[first..].iter().map(String::as_str).collect()
}

#[test]
fn a_file_is_written_synced_renamed_and_its_folder_synced() {
    let folder = tempfile::tempdir().unwrap();
    for (line, file) in [
        ("sweep examples/curves/vase.json -o a.grid", "a.grid"),
        ("triangulate a.grid -o a.obj", "a.obj"),
        ("render examples/scenes/glass-sphere.json --size 4x4 -o a.png", "a.png"),
    ] {
        let Some(calls) = trace(line, folder.path()) else { return };
        let rename = format!("rename {file}");
        let expected = ["write part", "sync part", &rename, "sync folder"];
        assert_eq!(from_first_write(&calls), expected, "{line}");
    }
}

#[test]
fn files_that_belong_together_are_renamed_between_a_marker_and_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let made = shell("sweep examples/curves/vase.json -o a.grid", folder.path());
    assert!(made.status.success(), "{}", said(&made));
    let line = "triangulate a.grid -o a.obj --mtl --report a.json";
    let Some(calls) = trace(line, folder.path()) else { return };
    let calls = from_first_write(&calls);
    let marker = "a.obj.incomplete";
    let at = |event: &str| {
        let found = calls.iter().position(|call| *call == event);
        found.unwrap_or_else(|| panic!("no `{event}` in {calls:?}"))
    };
    let renames = ["a.obj", "a.mtl", "a.json"].map(|file| at(&format!("rename {file}")));
    let marked = at(&format!("rename {marker}"));
    let ends = at(&format!("remove {marker}"));
    assert!(renames.iter().all(|at| (marked..ends).contains(at)), "{calls:?}");
    // The marker is synced before the first rename, and each rename before the next one and the
    // end.
    for at in renames.into_iter().chain([marked, ends]) {
        assert_eq!(calls[at + 1], "sync folder", "{calls:?}");
    }
    let written = calls[..marked].iter().filter(|call| **call == "sync part").count();
    assert_eq!(written, 4, "three files and the marker are synced before: {calls:?}");
}
