//! Runs of the program: its output, its messages, and its exit codes.

use fixtures::program::{ending, run};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const PIPE: &str = r#"{"format": "tb-sweep", "version": 1, "name": "pipe",
"contour": {"circle": 1}, "trajectory": {"line": [[0, 0, 0], [0, 3, 0]]},
"mesh": {"rows": 2, "cols": 4}}"#;

/// Runs the program with a text on its standard input.
fn sweep(arguments: &[&str], text: &str) -> Output {
    run(env!("CARGO_BIN_EXE_sweep").as_ref(), arguments, Path::new("."), text.as_bytes())
}

#[test]
fn a_spec_on_standard_input_becomes_a_grid_on_standard_output() {
    let run = sweep(&["--format", "json"], PIPE);
    assert_eq!(ending(&run), (Some(0), String::new()));
    let text = String::from_utf8(run.stdout).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].contains("\"name\":\"pipe\""), "{}", lines[0]);
    assert!(lines[0].contains("\"seam_u\":\"closed\",\"seam_v\":\"open\""), "{}", lines[0]);
    assert_eq!(lines.len(), 1 + 3 + 1, "header, three rows, footer");
    assert!(lines[2].starts_with("[0.5,0,[[1.0,1.5,0.0],[0.0,1.5,-1.0],"), "{}", lines[2]);
}

#[test]
fn binary_is_the_default_and_files_work_like_pipes() {
    let folder = tempfile::tempdir().unwrap();
    let (spec, grid) = (folder.path().join("pipe.json"), folder.path().join("pipe.grid"));
    fs::write(&spec, PIPE).unwrap();
    let run = sweep(&[spec.to_str().unwrap(), "-o", grid.to_str().unwrap()], "");
    assert_eq!(ending(&run), (Some(0), String::new()));
    assert_eq!(fs::read(&grid).unwrap(), sweep(&["-", "--format", "bin"], PIPE).stdout);
    let refused = sweep(&["--no-clobber", "-o", grid.to_str().unwrap()], PIPE);
    let (code, message) = ending(&refused);
    assert_eq!(code, Some(5));
    assert!(message.contains("--no-clobber"), "{message}");
}

#[test]
fn rows_and_cols_take_the_place_of_the_specs() {
    let run = sweep(&["--rows", "5", "--cols", "7", "--stats", "--format", "json"], PIPE);
    let (code, message) = ending(&run);
    assert_eq!(code, Some(0));
    assert!(message.contains("cells       5 x 7"), "{message}");
    assert!(String::from_utf8_lossy(&run.stdout).starts_with("{\"format\":\"tb-grid\""));
    let (code, message) = ending(&sweep(&["--cols", "2"], PIPE));
    assert_eq!(code, Some(2));
    assert_eq!(message, "sweep: cols: found 2, expected at least 3 to go around\n");
    let (code, message) = ending(&sweep(&["--rows", "9000000000", "--cols", "9000000000"], PIPE));
    assert_eq!(code, Some(2));
    assert!(message.contains("expected at most 1048576"), "{message}");
    let (code, message) = ending(&sweep(&["--rows", "9000000000", "--cols", "9000"], PIPE));
    assert_eq!(code, Some(2));
    assert!(message.contains("expected at most 100000000"), "{message}");
}

#[test]
fn a_tolerance_takes_the_place_of_rows_and_cols() {
    let run = sweep(&["--tol", "1e-3", "--stats", "--format", "json"], PIPE);
    let (code, message) = ending(&run);
    assert_eq!(code, Some(0));
    assert!(message.contains("cells       1 x 71"), "{message}");
    assert!(message.contains("quads       71, after "), "{message}");
    let (code, message) = ending(&sweep(
        &["--tol", "1e-3", "--angle", "9", "--max-quads", "20", "--format", "json"],
        PIPE,
    ));
    assert_eq!(code, Some(0), "{message}");
    assert!(
        message.starts_with(
            "sweep: note: pipe: the tolerance is not kept: with 20 of at most 20 quads"
        ),
        "{message}"
    );
    let fine = PIPE.replace("\"rows\": 2, \"cols\": 4", "\"tol\": 0.1, \"max_quads\": 900");
    assert_eq!(ending(&sweep(&["--format", "json"], &fine)).0, Some(0));
    assert_eq!(
        ending(&sweep(&["--rows", "2", "--cols", "5", "--format", "json"], &fine)).0,
        Some(0)
    );
    for (arguments, expected) in [
        (&["--rows", "2"][..], "sweep: cols: found rows without cols, expected both\n"),
        (&["--tol", "0"], "sweep: tol: found 0.0, expected a number above 0 and below 1e60\n"),
        (&["--max-quads", "2"], "sweep: max_quads: found 2, expected at least 3, the fewest"),
        (
            &["--pixels", "1"],
            "sweep: pixels: found pixels without a camera, expected a camera in mesh.camera",
        ),
    ] {
        let (code, message) = ending(&sweep(arguments, &fine));
        assert_eq!(code, Some(2), "{message}");
        assert!(message.starts_with(expected), "{message}");
    }
    let (code, message) = ending(&sweep(&["--tol", "1", "--rows", "3"], PIPE));
    assert_eq!(code, Some(2), "{message}");
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let vase = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves/vase.json");
    let one = sweep(&[vase, "--threads", "1"], "");
    assert_eq!(ending(&one), (Some(0), String::new()));
    assert_eq!(one.stdout, sweep(&[vase, "--threads", "5"], "").stdout);
}

#[test]
fn bad_flags_end_with_2() {
    for arguments in [
        &["--threads", "0"][..],
        &["--rows", "-1"],
        &["--rows", "many"],
        &["--format", "obj"],
        &["--colour"],
        &["a", "b"],
    ] {
        assert_eq!(sweep(arguments, PIPE).status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn help_has_examples() {
    let run = sweep(&["--help"], "");
    assert_eq!(run.status.code(), Some(0));
    let help = String::from_utf8(run.stdout).unwrap();
    assert!(help.contains("sweep vase.json -o vase.grid"), "{help}");
}

#[test]
fn complaints_have_their_place_and_exit_code() {
    let cases = [
        (PIPE.replace("\"rows\"", "\"rowz\""), 3, "<stdin>:3:18: mesh.rowz: unknown key"),
        (PIPE.replace("\"rows\"", "\"rowz\""), 3, "(did you mean `rows`?)"),
        (PIPE.replace("\"circle\": 1}", "\"circle\": 1]"), 3, "<stdin>:2:24: "),
        (PIPE.replace("[0, 3, 0]", "[0, 0, 0]"), 4, "<stdin>:2:50: trajectory.line: found ends"),
        (PIPE.replace("[0, 3, 0]", "[0, NaN, 0]"), 3, "<stdin>:2:"),
        (PIPE.replace("[0, 3, 0]", "[0, 1e400, 0]"), 3, "<stdin>:2:"),
        (String::new(), 3, "<stdin>:1:1: found nothing, expected a JSON object"),
    ];
    for (text, expected, part) in cases {
        let run = sweep(&[], &text);
        let (code, message) = ending(&run);
        assert_eq!(code, Some(expected), "{message}");
        assert!(message.starts_with("sweep: <stdin>:") && message.contains(part), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(run.stdout.is_empty());
    }
}

#[test]
fn a_missing_file_is_named() {
    let (code, message) = ending(&sweep(&["no/such/curve.json"], ""));
    assert_eq!(code, Some(5));
    assert!(message.starts_with("sweep: cannot read no/such/curve.json"), "{message}");
}

#[test]
fn a_failure_leaves_the_output_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let grid = folder.path().join("old.grid");
    fs::write(&grid, "old").unwrap();
    let bad = PIPE.replace("[0, 3, 0]", "[0, 0, 0]");
    assert_eq!(sweep(&["-o", grid.to_str().unwrap()], &bad).status.code(), Some(4));
    assert_eq!(fs::read_to_string(&grid).unwrap(), "old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing is left beside it");
    let nowhere = folder.path().join("no/such/folder.grid");
    assert_eq!(sweep(&["-o", nowhere.to_str().unwrap()], PIPE).status.code(), Some(5));
    assert!(!Path::new(&nowhere).exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_ends_with_5() {
    let (code, message) = ending(&sweep(&["-o", "/dev/full"], PIPE));
    assert_eq!(code, Some(5));
    assert!(message.starts_with("sweep: cannot write /dev/full"), "{message}");
}

#[cfg(target_os = "linux")]
#[test]
fn words_that_cannot_be_printed_change_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (spec, grid) = (folder.path().join("pipe.json"), folder.path().join("pipe.grid"));
    fs::write(&spec, PIPE).unwrap();
    for (spec, code) in [(spec.as_path(), 0), (Path::new("no/such/curve.json"), 5)] {
        let status = Command::new(env!("CARGO_BIN_EXE_sweep"))
            .arg(spec)
            .args(["--stats", "-o", grid.to_str().unwrap()])
            .stderr(fs::OpenOptions::new().write(true).open("/dev/full").unwrap())
            .status()
            .unwrap();
        assert_eq!(status.code(), Some(code));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_grid_larger_than_memory_is_written_row_by_row() {
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("pipe.json");
    fs::write(&spec, PIPE).unwrap();
    // A grid of 360 MB in an address space of 200 MB.
    let run = Command::new("sh")
        .args(["-c", "ulimit -v 200000 && exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_sweep")])
        .arg(&spec)
        .args(["--rows", "4000", "--cols", "2500", "--threads", "2", "-o", "/dev/null"])
        .output()
        .unwrap();
    let (code, message) = ending(&run);
    assert_eq!(code, Some(0), "{message}");
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_quietly_with_141() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_sweep"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    child.stdin.take().unwrap().write_all(PIPE.as_bytes()).unwrap();
    let run = child.wait_with_output().unwrap();
    assert_eq!(ending(&run), (Some(141), String::new()));
}

#[test]
fn folds_are_noted_unless_quiet() {
    let hook = PIPE
        .replace("{\"line\": [[0, 0, 0], [0, 3, 0]]}", "{\"circle\": {\"radius\": 0.5}}")
        .replace("\"rows\": 2", "\"rows\": 8");
    let (code, message) = ending(&sweep(&[], &hook));
    assert_eq!(code, Some(0));
    assert!(message.starts_with("sweep: note: pipe: the surface folds back on itself in 8 rows"));
    assert_eq!(ending(&sweep(&["-q"], &hook)), (Some(0), String::new()));
    // Requested statistics are printed in spite of -q.
    let (_, message) = ending(&sweep(&["-q", "--stats"], &hook));
    assert!(message.starts_with("object      pipe"), "{message}");
}
