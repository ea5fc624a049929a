//! Hostile files: each ends with one sentence, whatever its contents.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench;

use bench::{Bench, TEXTURED_WALL, WALL, ending};
use std::process::Command;

/// A PNG of one pixel with a palette of 4 bytes, on which the decoder panics.
pub const PALETTE_OF_4_BYTES: &[u8] = b"\x89PNG\r\n\x1a\n\
    \0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\x03\0\0\0\x28\xcb\x34\xbb\
    \0\0\0\x04PLTE\0\0\0\0\xb4\xa3\xae\x7a\
    \0\0\0\x0aIDAT\x78\x9c\x63\x60\0\0\0\x02\0\x01\x48\xaf\xa4\x71\
    \0\0\0\0IEND\xae\x42\x60\x82";

/// Returns the wall's scene with a bump in place of the texture.
fn bumped() -> String {
    TEXTURED_WALL
        .replace(r#""textures": { "checks": { "image": "checks.png" } },"#, "")
        .replace(
            r#""diffuse": 0 }"#,
            r#""diffuse": 0, "bump": { "image": { "file": "checks.png" }, "strength": 1 } }"#,
        )
        .replace(r#", "texture": "checks""#, "")
}

#[test]
fn a_palette_that_makes_the_decoder_panic_is_a_broken_file() {
    for text in [TEXTURED_WALL.to_string(), bumped()] {
        let bench = Bench::with_scene(&text);
        bench.write("checks.png", PALETTE_OF_4_BYTES);
        bench.refuse(&["scene.json"], b"", 3, &["scene.json:", "found no picture in checks.png ("]);
    }
}

#[cfg(unix)]
#[test]
fn named_pipes_and_devices_are_no_files() {
    let include = WALL.replace("\"ambient\"", "\"include\": [\"checks.png\"], \"ambient\"");
    for text in [TEXTURED_WALL.to_string(), bumped(), include] {
        let bench = Bench::with_scene(&text);
        assert!(Command::new("mkfifo").arg(bench.path("checks.png")).status().unwrap().success());
        let said = ["scene.json:", "cannot read checks.png: it is a pipe, expected a regular file"];
        bench.refuse(&["scene.json"], b"", 5, &said);
        std::fs::remove_file(bench.path("checks.png")).unwrap();
        std::os::unix::fs::symlink("/dev/zero", bench.path("checks.png")).unwrap();
        let said =
            ["scene.json:", "cannot read checks.png: it is a device, expected a regular file"];
        bench.refuse(&["scene.json"], b"", 5, &said);
    }
    let bench = Bench::with_scene(WALL);
    bench.refuse(&["/dev/zero"], b"", 5, &["cannot read /dev/zero: it is a device"]);
    bench.refuse(&["."], b"", 5, &["cannot read .: it is a folder"]);
}

#[test]
fn an_endless_standard_input_is_refused_by_the_budget() {
    let bench = Bench::new();
    let endless = vec![b' '; 3 << 20];
    bench.refuse(&["-", "--max-memory", "2M"], &endless, 6, &["reading <stdin> needs "]);
}

#[test]
fn names_in_a_report_stay_on_their_line_and_steer_nothing() {
    let name = "a\\u001b[2J\\n0 wrong\\u202e\\u009b";
    let text = WALL.replace("\"wall\"", &format!("\"{name}\""));
    let bench = Bench::with_scene(&text);
    for arguments in [&["scene.json", "--check"][..], &["scene.json", "--pixel", "0,0"]] {
        let run = bench.run(arguments, b"");
        let (_, said) = ending(&run);
        let text = String::from_utf8(run.stdout).unwrap() + &said;
        assert!(text.contains("a\\u{1b}[2J\\n0 wrong\\u{202e}\\u{9b}"), "{text}");
        assert!(!text.contains(|c: char| c != '\n' && files::words::unseen(c)), "{text:?}");
        assert!(!text.lines().any(|line| line.starts_with("0 wrong")), "{text}");
    }
}

#[test]
fn a_long_value_is_not_said_back_whole() {
    let long = "x".repeat(100_000);
    for (text, code) in [
        (WALL.replace("\"material\": \"wall\"", &format!("\"material\": \"{long}\"")), 3),
        (WALL.replace("tb-scene", &long), 3),
        (WALL.replace("\"color\"", &format!("\"{long}\"")), 3),
        (TEXTURED_WALL.replace("checks.png", &long), 5),
    ] {
        let (ended, said) =
            ending(&Bench::with_scene(&text).run(&["scene.json", "-o", "a.png"], b""));
        assert_eq!(ended, Some(code), "{said}");
        assert!(said.len() < 1500 && said.lines().count() == 1, "{} bytes: {said}", said.len());
    }
}
