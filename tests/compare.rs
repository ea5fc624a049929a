//! `pipeline compare`: its output, its exit codes, and its messages about bad input.

use crate::support;

use compare::Scale;
use image::{ImageFormat, Rgb, Rgb32FImage, RgbImage};
use serde_json::Value;
use std::path::Path;
use std::process::Output;
use support::{root, run};
use tempfile::TempDir;

/// Creates a folder with pictures of 12 x 16 pixels: `grey.exr`, `lighter.exr` (lighter by 1/8),
/// `dot.exr` (the red of pixel 7,4 is larger by 2) and `grey.png`. It also has `small.exr`.
fn pictures() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder is made");
    let save = |name: &str, picture: &Rgb32FImage| {
        picture
            .save_with_format(folder.path().join(name), ImageFormat::OpenExr)
            .expect("it is saved");
    };
    let grey = Rgb32FImage::from_pixel(12, 16, Rgb([0.25, 0.5, 0.75]));
    save("grey.exr", &grey);
    save("lighter.exr", &Rgb32FImage::from_pixel(12, 16, Rgb([0.375, 0.625, 0.875])));
    let mut dot = grey;
    dot.get_pixel_mut(7, 4).0[0] += 2.0;
    save("dot.exr", &dot);
    save("small.exr", &Rgb32FImage::new(4, 4));
    RgbImage::from_pixel(12, 16, Rgb([137, 188, 225]))
        .save(folder.path().join("grey.png"))
        .expect("it is saved");
    folder
}

/// Runs `pipeline compare` with the arguments of a line.
fn compare(line: &str, folder: &Path) -> Output {
    let arguments: Vec<&str> = std::iter::once("compare").chain(line.split(' ')).collect();
    run("pipeline", &arguments, folder)
}

fn data(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("text")
}

#[test]
fn the_numbers_are_printed_as_words_and_as_json() {
    let folder = pictures();
    let said = compare("lighter.exr grey.exr", folder.path());
    assert_eq!(said.status.code(), Some(0), "{}", support::said(&said));
    let text = data(&said);
    let numbers =
        "size  12x16\nrmse  0.125\nmax   0.125 at 0,0\np999  0.125\nbias  0.125\nssim  0.9";
    assert!(text.starts_with(numbers), "{text}");
    assert!(said.stderr.is_empty(), "{}", support::said(&said));

    let said = compare("grey.exr dot.exr --json", folder.path());
    let found: Value = serde_json::from_slice(&said.stdout).unwrap();
    // 4 over 12 * 16 * 3 values, and -2 over the same number.
    assert_eq!(found["rmse"], (4.0f64 / 576.0).sqrt());
    assert_eq!(found["bias"], -2.0 / 576.0);
    assert_eq!(found["max"], 2.0);
    assert_eq!(found["max_at"], serde_json::json!([7, 4]));
    // The size is that of the crop, and positions are those of the whole picture.
    let said = compare("grey.exr dot.exr --json --crop 6,3,4x5", folder.path());
    let found: Value = serde_json::from_slice(&said.stdout).unwrap();
    assert_eq!(found["rmse"], (4.0f64 / 60.0).sqrt());
    assert_eq!(found["max_at"], serde_json::json!([7, 4]));
    assert_eq!((&found["width"], &found["ssim"]), (&4.into(), &Value::Null));
}

#[test]
fn equal_pictures_are_equal() {
    let folder = pictures();
    for line in ["grey.exr grey.exr", "dot.exr dot.exr", "grey.exr dot.exr --crop 0,5,12x11"] {
        let said = compare(&format!("{line} --rmse 0 --max 0 --p999 0 --ssim 1"), folder.path());
        assert_eq!(said.status.code(), Some(0), "{line}: {}", support::said(&said));
        let numbers = "rmse  0.0\nmax   0.0\np999  0.0\nbias  0.0\nssim  1.0\n";
        assert!(data(&said).ends_with(numbers), "{line}: {}", data(&said));
    }
}

#[test]
fn a_png_is_taken_as_srgb() {
    let folder = pictures();
    // Half a code is at most 0.005 of light, and its steps are no larger.
    let said = compare("grey.png grey.exr --max 0.005", folder.path());
    assert_eq!(said.status.code(), Some(0), "{}", support::said(&said));
    let said = compare("grey.png grey.exr --max 1e-5", folder.path());
    assert_eq!(said.status.code(), Some(1), "codes are rounded");
}

#[test]
fn a_limit_that_is_passed_ends_with_1_and_says_which() {
    let folder = pictures();
    for (limits, code, passed) in [
        ("--rmse 0.125 --max 0.125 --p999 0.125 --ssim 0.5", 0, ""),
        ("--rmse 0.12", 1, "rmse 0.125 is above 0.12\n"),
        ("--max 0.12 --rmse 1", 1, "max 0.125 is above 0.12\n"),
        ("--p999 0", 1, "p999 0.125 is above 0\n"),
        ("--rmse 0.1 --max 0", 1, "rmse 0.125 is above 0.1, max 0.125 is above 0\n"),
        ("--ssim 0.999", 1, " is below 0.999\n"),
    ] {
        let said = compare(&format!("lighter.exr grey.exr {limits}"), folder.path());
        assert_eq!(said.status.code(), Some(code), "{limits}: {}", support::said(&said));
        let sentence = support::said(&said);
        assert!(sentence.ends_with(passed), "{limits}: {sentence}");
        if code == 1 {
            let start = "pipeline: lighter.exr differs from grey.exr by more than is allowed: ";
            assert!(sentence.starts_with(start), "{sentence}");
        }
        // The numbers are printed although they exceed the limit, when they matter most.
        assert!(data(&said).contains("rmse  0.125\n"));
    }
}

#[test]
fn the_map_shows_where() {
    let folder = pictures();
    let line = "dot.exr grey.exr --map map.png --map-scale linear:4 --max 1";
    assert_eq!(compare(line, folder.path()).status.code(), Some(1));
    let map = image::open(folder.path().join("map.png")).unwrap().to_rgb8();
    let scale = Scale::Linear { most: 4.0 };
    assert_eq!(map.dimensions(), (12, 16));
    for (x, y, pixel) in map.enumerate_pixels() {
        let error = if (x, y) == (7, 4) { 2.0 } else { 0.0 };
        assert_eq!(pixel.0, scale.color(error), "{x},{y}");
    }
    let said = compare("dot.exr grey.exr --map map.png --no-clobber", folder.path());
    assert_eq!(said.status.code(), Some(5), "{}", support::said(&said));
}

#[test]
fn bad_input_is_named() {
    let folder = pictures();
    std::fs::write(folder.path().join("words.png"), "no picture").unwrap();
    let whole = std::fs::read(folder.path().join("grey.exr")).unwrap();
    std::fs::write(folder.path().join("half.exr"), &whole[..whole.len() / 2]).unwrap();
    for (line, code, sentence) in [
        ("grey.exr missing.png", 5, "pipeline: cannot read missing.png: "),
        ("words.png grey.exr", 3, "pipeline: words.png: found no picture (its first bytes"),
        ("grey.exr half.exr", 3, "pipeline: half.exr: found no picture ("),
        (
            "grey.exr small.exr",
            2,
            "pipeline: grey.exr is 12x16 pixels and small.exr 4x4: expected the same size\n",
        ),
        (
            "grey.exr dot.exr --crop 5,0,8x4",
            2,
            "pipeline: the crop 5,0,8x4 does not lie in grey.exr, which is 12x16 pixels\n",
        ),
        ("small.exr small.exr --ssim 0.5", 2, "pipeline: pictures of 4x4 pixels have no struct"),
        ("grey.exr dot.exr --map map.exr", 2, "pipeline: a map is a PNG file: found map.exr"),
        ("grey.exr dot.exr --map no/map.png", 5, "pipeline: cannot write no/map.png: "),
        ("- -", 2, "pipeline: standard input was named twice"),
        ("grey.exr dot.exr --rmse -1", 2, "error: invalid value '-1' for '--rmse <X>': expected"),
        ("grey.exr dot.exr --max nan", 2, "error: invalid value 'nan' for '--max <X>': expected"),
        ("grey.exr dot.exr --ssim 1.5", 2, "error: invalid value '1.5' for '--ssim <X>': expect"),
        ("grey.exr dot.exr --map m.png --map-scale log:1:0", 2, "error: invalid value 'log:1:0'"),
        ("grey.exr", 2, "error: the following required arguments were not provided"),
    ] {
        let said = compare(line, folder.path());
        assert_eq!(said.status.code(), Some(code), "{line}: {}", support::said(&said));
        assert!(support::said(&said).starts_with(sentence), "{line}: {}", support::said(&said));
        assert!(said.stdout.is_empty(), "{line}: {}", data(&said));
    }
    assert!(!folder.path().join("map.exr").exists());
}

#[test]
fn every_exit_code_is_told_in_the_help_and_in_the_conventions() {
    let conventions = std::fs::read_to_string(root().join("docs/conventions.md")).unwrap();
    assert!(conventions.contains("| 1 | `pipeline compare`: the pictures differ by more"));
    let help = data(&run("pipeline", &["--help"], &root()));
    assert!(
        help.contains("Exit codes:\n  1 pictures that differ by more than is allowed, 2 bad use")
    );
}
