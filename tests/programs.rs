//! Conventions that all four programs share: versions, flags, lines about written files, and hints at unknown flags.

use crate::support;

use std::path::Path;
use support::{root, run, said};

const PROGRAMS: [&str; 4] = ["sweep", "triangulate", "render", "pipeline"];

/// Returns the arguments by which each program writes a file into the folder of a test.
fn working(program: &str) -> Vec<String> {
    let ring = root().join("examples/curves/trefoil.json").display().to_string();
    let words = match program {
        "sweep" => vec![ring.as_str(), "--rows", "60", "--cols", "6", "-o", "a.grid"],
        "triangulate" => vec!["a.grid", "-o", "a.obj"],
        "render" => vec!["a.obj", "--size", "32x24", "-o", "a.png"],
        _ => vec!["show", ring.as_str(), "--size", "32x24", "-o", "b.png"],
    };
    words.into_iter().map(str::to_owned).collect()
}

/// Returns what a run has written to standard error, with the lines about written files.
fn told(run: &std::process::Output) -> String {
    String::from_utf8(run.stderr.clone()).unwrap()
}

fn ran(program: &str, more: &[&str], folder: &Path) -> std::process::Output {
    let own = working(program);
    let words: Vec<&str> = own.iter().map(String::as_str).chain(more.iter().copied()).collect();
    run(program, &words, folder)
}

#[test]
fn all_programs_tell_their_version() {
    let folder = tempfile::tempdir().unwrap();
    for program in PROGRAMS {
        for flag in ["--version", "-V"] {
            let ran = run(program, &[flag], folder.path());
            let line = String::from_utf8(ran.stdout).unwrap();
            assert_eq!(line, format!("{program} {}\n", env!("CARGO_PKG_VERSION")));
        }
    }
}

/// The help of each program ends with its exit codes, in lines that no terminal of 80 columns breaks.
#[test]
fn all_programs_name_their_exit_codes() {
    let folder = tempfile::tempdir().unwrap();
    for program in PROGRAMS {
        let help = String::from_utf8(run(program, &["--help"], folder.path()).stdout).unwrap();
        let (_, codes) = help.split_once("\nExit codes:\n").unwrap_or_else(|| panic!("{help}"));
        for code in ["2 bad use", "3 malformed input", "141 closed pipe"] {
            assert!(codes.contains(code), "{program}: {codes}");
        }
        assert!(codes.lines().all(|line| line.starts_with("  ") && line.len() <= 80), "{codes}");
    }
}

#[test]
fn all_programs_have_the_same_flags_and_say_what_they_wrote() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    for (program, file) in [
        ("sweep", "a.grid ("),
        ("triangulate", "a.obj ("),
        ("render", "a.png (32 x 24, "),
        ("pipeline", "b.png (32 x 24, "),
    ] {
        let said_by = |more: &[&str]| {
            let ran = ran(program, more, path);
            assert!(ran.status.success(), "{program} {more:?}: {}", said(&ran));
            told(&ran)
        };
        let words = said_by(&["--threads", "2", "--max-memory", "500M"]);
        let line = words.lines().find(|line| line.starts_with("wrote ")).unwrap_or_default();
        assert!(
            line.starts_with(&format!("wrote {file}")) && line.ends_with(" s)"),
            "{program}: {words}"
        );
        for mode in ["bar", "plain", "json", "none"] {
            assert_eq!(said_by(&["-q", "--progress", mode]), "", "{program} {mode}");
        }
        let refused = ran(program, &["--no-clobber"], path);
        assert!(
            !refused.status.success() && said(&refused).contains("exists"),
            "{}",
            said(&refused)
        );
        for threads in ["0", "1025", "x"] {
            assert_eq!(ran(program, &["--threads", threads], path).status.code(), Some(2));
        }
    }
}

#[test]
fn unknown_flags_have_a_hint_in_all_programs() {
    let folder = tempfile::tempdir().unwrap();
    for (program, flag, hint) in [
        ("sweep", "--row", "--rows"),
        ("triangulate", "--textur", "--texture"),
        ("render", "--sice", "--size"),
        ("pipeline", "--collor", "--color"),
        ("sweep", "--thread", "--threads"),
        ("triangulate", "--thread", "--threads"),
        ("render", "--thread", "--threads"),
        ("pipeline", "--thread", "--threads"),
    ] {
        let ran = ran(program, &[flag], folder.path());
        assert_eq!(ran.status.code(), Some(2), "{program} {flag}");
        assert!(
            said(&ran).contains(&format!("a similar argument exists: '{hint}'")),
            "{}",
            said(&ran)
        );
    }
    let ran = run("pipeline", &["runs"], folder.path());
    assert!(said(&ran).contains("a similar subcommand exists: 'run'"), "{}", said(&ran));
}

#[test]
fn pipeline_run_says_what_it_wrote_and_nothing_when_quiet() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["run", "globe", "--size", "32x24", "-o", "out", "--sheet"];
    let told = told(&run("pipeline", &words, folder.path()));
    for file in ["out/globe-exact.png (32 x 24, ", "out/sheet.png ("] {
        assert!(told.contains(&format!("wrote {file}")), "{told}");
    }
    let quiet = run("pipeline", &[&words[..], &["-q"]].concat(), folder.path());
    assert!(quiet.status.success() && quiet.stderr.is_empty(), "{}", said(&quiet));
}

/// Data goes to standard output with `-o -`, and the words go to standard error.
#[test]
fn an_output_of_a_dash_is_standard_output_in_all_programs() {
    let folder = tempfile::tempdir().unwrap();
    for (program, file) in
        [("sweep", "a.grid"), ("triangulate", "a.obj"), ("render", "a.png"), ("pipeline", "b.png")]
    {
        let written = ran(program, &["-q"], folder.path());
        assert!(written.status.success(), "{}", said(&written));
        let own = working(program);
        let words: Vec<&str> =
            own.iter().map(|word| if word == file { "-" } else { word.as_str() }).collect();
        let format: &[&str] = if program == "render" { &["--format", "png"] } else { &[] };
        let piped = run(program, &[&words[..], format, &["-q"]].concat(), folder.path());
        assert!(piped.status.success(), "{program}: {}", said(&piped));
        let written = std::fs::read(folder.path().join(file)).unwrap();
        if file.ends_with(".png") {
            // The text in a PNG names its command.
            let pixels = |bytes: &[u8]| image::load_from_memory(bytes).unwrap().to_rgb8();
            assert_eq!(pixels(&piped.stdout), pixels(&written), "{program}");
        } else {
            assert_eq!(piped.stdout, written, "{program}");
        }
    }
}

#[test]
fn a_dry_run_names_the_files_and_makes_none() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["run", "vase", "globe", "-o", "out", "--keep", "--size", "16x16"];
    let dry = run("pipeline", &[&words[..], &["--dry-run"]].concat(), folder.path());
    assert!(dry.status.success() && !folder.path().join("out").exists(), "{}", said(&dry));
    let mut named: Vec<String> =
        String::from_utf8(dry.stdout).unwrap().lines().map(Into::into).collect();
    named.sort();
    let wet = run("pipeline", &[&words[..], &["-q"]].concat(), folder.path());
    assert!(wet.status.success(), "{}", said(&wet));
    let files = std::fs::read_dir(folder.path().join("out")).unwrap();
    let mut found: Vec<String> =
        files.map(|file| format!("out/{}", file.unwrap().file_name().to_str().unwrap())).collect();
    found.sort();
    assert_eq!(named, found);
    let refused = run("pipeline", &["run", "vase", "-o", "-"], folder.path());
    assert_eq!(refused.status.code(), Some(2));
    assert!(said(&refused).contains("-o names a folder"), "{}", said(&refused));
}

#[test]
fn a_missing_folder_is_named_with_its_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let spec = root().join("examples/curves/trefoil.json").display().to_string();
    let ran = run("sweep", &[&spec, "-o", "none/a.grid"], folder.path());
    assert_eq!(ran.status.code(), Some(5));
    assert!(said(&ran).contains("make its folder first"), "{}", said(&ran));
}
