//! The built-in pages, made in an empty folder.

use crate::support;

use files::json::Document;
use pipeline::pages;
use render::color::Encoding;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use support::{run, said};

fn make(arguments: &[&str], folder: &Path) -> Vec<(String, Vec<u8>)> {
    let ran = run("pipeline", arguments, folder);
    assert!(ran.status.success(), "{}", said(&ran));
    assert!(ran.stdout.is_empty(), "words go to standard error");
    let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(folder.join("out"))
        .expect("the folder is there")
        .map(|entry| entry.expect("the folder is read"))
        .map(|entry| {
            let bytes = fs::read(entry.path()).expect("the file is read");
            (entry.file_name().to_string_lossy().into_owned(), bytes)
        })
        .collect();
    files.sort();
    files
}

#[test]
fn all_pages_are_the_same_bytes_on_one_thread_and_on_five() {
    let make_with = |threads: &str| {
        let folder = tempfile::tempdir().unwrap();
        // The size exceeds a tile of 64 pixels, so that two threads have work.
        let size = ["--size", "70x36", "--threads", threads];
        make(&[&["run", "all", "-o", "out"], size.as_slice()].concat(), folder.path())
    };
    let (one, five) = (make_with("1"), make_with("5"));
    assert!(one == five, "threads show in the pictures");
    let names: Vec<&str> = one.iter().map(|(name, _)| name.as_str()).collect();
    for page in pages::names() {
        let modes = pages::page(page).unwrap().modes;
        let mut ends: Vec<String> = modes.iter().map(|mode| format!("-{}", mode.name)).collect();
        // Pages with several modes also have a strip.
        ends.extend((modes.len() > 1).then(String::new));
        for end in ends {
            let name = format!("{page}{end}.png");
            assert!(names.contains(&name.as_str()), "{name} is missing from {names:?}");
        }
    }
}

#[test]
fn a_sheet_shows_the_last_picture_of_each_page() {
    let folder = tempfile::tempdir().unwrap();
    let asked = ["run", "vase", "spring", "--sheet", "--size", "40x30", "-q", "-o", "out"];
    let files = make(&asked, folder.path());
    let picture = |name: &str| {
        let (_, bytes) = files.iter().find(|(file, _)| file == name).expect("the file is there");
        image::load_from_memory(bytes).unwrap().to_rgb8()
    };
    let sheet = picture("sheet.png");
    assert_eq!(sheet.dimensions(), (2 * 48 + 8, 38 + 8));
    for (k, last) in (0..).zip(["vase-exact.png", "spring-exact.png"]) {
        let shown = image::imageops::crop_imm(&sheet, 8 + 48 * k, 8, 40, 30).to_image();
        assert_eq!(shown, picture(last), "{last}");
    }
}

/// The topology of a patch in a report of `triangulate`.
#[derive(Debug, PartialEq, Deserialize)]
struct Patch {
    euler: i64,
    boundary_loops: usize,
    orientable: bool,
    manifold: bool,
}

#[derive(Debug, Deserialize)]
struct Report {
    euler: i64,
    closed: bool,
    manifold: bool,
    patches: Vec<Patch>,
}

/// Examples whose patches are joined by lids, or that have several parts: the Euler number of the whole mesh.
const JOINED: [(&str, i64); 5] =
    [("duct", -2), ("letter", 0), ("neurite", 24), ("tapered-screw", 4), ("vessel", 0)];

#[test]
fn every_surface_in_examples_is_what_the_gallery_says() {
    const SPHERE: (i64, usize, bool) = (2, 0, true);
    const DISC: (i64, usize, bool) = (1, 1, true);
    const TORUS: (i64, usize, bool) = (0, 0, true);
    const KLEIN_BOTTLE: (i64, usize, bool) = (0, 0, false);
    const MOEBIUS_BAND: (i64, usize, bool) = (0, 1, false);
    let folder = tempfile::tempdir().unwrap();
    for entry in fs::read_dir(support::root().join("examples/curves")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "json") {
            continue;
        }
        let name = path.file_stem().unwrap().to_str().unwrap();
        let expected = match name {
            "fluted-vase" | "relief-vase" | "horn" => DISC,
            "eight" | "figure-eight" | "trefoil" | "torus-knot" | "threefold-torus"
            | "picture-frame" | "smooth-ring" | "scaly-ring" | "klein-glass" | "knot-3-7" => TORUS,
            "klein-bottle" | "six" | "figure-eight-klein" | "figure-eight-immersion" => {
                KLEIN_BOTTLE
            }
            "moebius-band" => MOEBIUS_BAND,
            _ => SPHERE,
        };
        let swept = run("sweep", &[path.to_str().unwrap(), "-o", "a.grid"], folder.path());
        assert_eq!(said(&swept), "", "{name}");
        let arguments = ["-q", "a.grid", "-o", "a.obj", "--report", "a.json"];
        let split = run("triangulate", &arguments, folder.path());
        assert!(split.status.success(), "{name}: {}", said(&split));
        let report = fs::read(folder.path().join("a.json")).unwrap();
        let report: Report = Document::new("a.json", &report).unwrap().parse().unwrap();
        if let Some((_, euler)) = JOINED.iter().find(|joined| joined.0 == name) {
            assert_eq!(
                (report.euler, report.closed, report.manifold),
                (*euler, true, true),
                "{name}"
            );
            continue;
        }
        assert_eq!(report.patches.len(), if name.ends_with("cup") { 2 } else { 1 }, "{name}");
        for Patch { euler, boundary_loops, orientable, manifold } in report.patches {
            assert_eq!((euler, boundary_loops, orientable), expected, "{name}");
            assert!(manifold, "{name}");
        }
    }
}

#[test]
fn every_page_has_its_place_in_the_gallery() {
    let gallery = fs::read_to_string(support::root().join("docs/gallery.md")).unwrap();
    let shown: BTreeSet<&str> = gallery
        .lines()
        .filter_map(|line| line.strip_prefix("`pipeline run ")?.split_once('`'))
        .map(|(page, _)| page)
        .collect();
    // The gallery shows swept surfaces, and no page twice with other meshes. docs/peer-scenes.md
    // shows the two scenes that were compared with other renderers.
    let swept = |page: &&str| {
        *page != "glass-sphere" && !page.ends_with("-adaptive") && !page.starts_with("peer-")
    };
    assert_eq!(shown, pages::names().into_iter().filter(swept).collect());
    for page in shown {
        assert!(gallery.contains(&format!("](pictures/{page}.png)")), "{page}");
        assert!(support::root().join(format!("docs/pictures/{page}.png")).exists(), "{page}");
    }
}

#[test]
fn the_strip_shows_the_modes_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let files = make(&["run", "glass-sphere", "-o", "out", "--size", "60x40"], folder.path());
    let picture = |name: &str| {
        let (_, bytes) = files.iter().find(|(file, _)| file == name).unwrap();
        image::load_from_memory(bytes).unwrap().to_rgb8()
    };
    let strip = picture("glass-sphere.png");
    assert_eq!(strip.dimensions(), (60 * 4 + 8 * 3, 40));
    let second = picture("glass-sphere-prefiltered.png");
    for (x, y, pixel) in second.enumerate_pixels() {
        assert_eq!(strip.get_pixel(x + 68, y), pixel);
    }
}

/// Compares figures A.10 and A.11 of the thesis. The far floor of the point sampled picture is
/// noise, and that of the prefiltered picture is smooth. Near the eye both agree.
#[test]
fn the_far_floor_is_calm_only_when_prefiltered() {
    let folder = tempfile::tempdir().unwrap();
    let files = make(&["run", "glass-sphere", "-o", "out", "--size", "256x256"], folder.path());
    // Mean and standard deviation of the green light left of the sphere.
    let light = |name: &str, rows: std::ops::Range<u32>| {
        let (_, bytes) = files.iter().find(|(file, _)| file == name).unwrap();
        let picture = image::load_from_memory(bytes).unwrap().to_rgb8();
        let light: Vec<f64> = rows
            .flat_map(|y| (0..50).map(move |x| (x, y)))
            .map(|(x, y)| Encoding::Srgb.decode(f64::from(picture.get_pixel(x, y)[1]) / 255.0))
            .collect();
        let mean = light.iter().sum::<f64>() / light.len() as f64;
        let spread = light.iter().map(|c| (c - mean).powi(2)).sum::<f64>() / light.len() as f64;
        (mean, spread.sqrt())
    };
    let [point, filtered] = ["glass-sphere-point.png", "glass-sphere-prefiltered.png"];
    let (far, near) = (90..96, 200..256);
    // Half the checks are nearly black, so that the deviation of their noise is about its mean.
    let noise = |name: &str| light(name, far.clone()).1 / light(name, far.clone()).0;
    assert!(noise(point) > 0.7, "{}", noise(point));
    assert!(noise(filtered) < 0.1, "{}", noise(filtered));
    let lost = light(point, near.clone()).0 - light(filtered, near).0;
    // At either border of 56 rows a quarter of a row comes from beyond, with a difference of at
    // most 1 in light.
    assert!(lost.abs() < 0.01, "the near floor keeps its light, but for {lost}");
}

#[test]
fn a_job_of_ones_own_runs_from_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let job = format!(
        "{{\"format\": \"tb-job\", \"version\": 1, \"scene\": {:?}, \
         \"meshes\": {{\"vase\": {{\"spec\": {:?}, \"texture\": 2}}}}}}",
        support::root().join("examples/scenes/vase.json"),
        support::root().join("examples/curves/vase.json"),
    );
    fs::write(folder.path().join("mine.json"), job).unwrap();
    let files = make(&["run", "mine.json", "-o", "out", "--size", "16x16"], folder.path());
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["mine-exact.png"]);
}

#[test]
fn no_clobber_refuses_before_the_first_picture_is_made() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("out")).unwrap();
    // The file that is written last.
    fs::write(folder.path().join("out/glass-sphere.png"), "old").unwrap();
    let arguments = ["run", "glass-sphere", "-o", "out", "--size", "8x8", "--no-clobber"];
    let ran = run("pipeline", &arguments, folder.path());
    assert_eq!(ran.status.code(), Some(5), "{}", said(&ran));
    assert!(said(&ran).contains("out/glass-sphere.png exists"), "{}", said(&ran));
    let files: Vec<_> = fs::read_dir(folder.path().join("out")).unwrap().collect();
    assert_eq!(files.len(), 1, "{files:?}");
    assert_eq!(fs::read(folder.path().join("out/glass-sphere.png")).unwrap(), b"old");
}

#[test]
fn pixels_that_are_not_finite_are_told() {
    let folder = tempfile::tempdir().unwrap();
    // Each number is in its range, and their product exceeds the range of a pixel.
    let scene = "{\"format\": \"tb-scene\", \"version\": 1, \"ambient\": 1e30, \
        \"camera\": {\"eye\": [0, 0, 1], \"target\": [0, 0, 0], \"fov_deg\": 40}, \
        \"materials\": {\"sun\": {\"color\": 1e30}}, \"objects\": [{\"plane\": {\"point\": [0, 0, 0], \
        \"edge_u\": [1, 0, 0], \"edge_v\": [0, 1, 0], \"material\": \"sun\"}}]}";
    fs::write(folder.path().join("s.json"), scene).unwrap();
    let job = "{\"format\": \"tb-job\", \"version\": 1, \"scene\": \"s.json\"}";
    fs::write(folder.path().join("bright.json"), job).unwrap();
    let ran = run("pipeline", &["run", "bright.json", "-q", "--size", "3x2"], folder.path());
    let told = "pipeline: bright exact: 6 pixels are not finite and were made black\n";
    assert_eq!(said(&ran), told);
}

#[test]
fn every_scene_in_examples_renders() {
    let folder = tempfile::tempdir().unwrap();
    let scenes = support::root().join("examples/scenes");
    for entry in fs::read_dir(&scenes).unwrap() {
        let scene = entry.unwrap().path();
        // The job of a page makes its meshes.
        if pages::names().iter().any(|page| scene.file_stem() == Some(OsStr::new(page))) {
            continue;
        }
        let scene = scene.to_str().unwrap();
        let ran = run("render", &[scene, "--size", "16x16", "-o", "a.exr"], folder.path());
        assert!(ran.status.success(), "{scene}: {}", said(&ran));
    }
}

#[test]
fn what_is_wrong_is_said_in_one_line_with_its_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let job = "{\"format\": \"tb-job\", \"version\": 1, ";
    write("typo.json", &format!("{job}\"scen\": \"s.json\"}}"));
    write("lost.json", &format!("{job}\"scene\": \"no.json\"}}"));
    write(
        "stray.json",
        &format!("{job}\"scene\": \"s.json\", \"meshes\": {{\"a\": {{\"spec\": \"c.json\"}}}}}}"),
    );
    write(
        "s.json",
        "{\"format\": \"tb-scene\", \"version\": 1, \"camera\": {\"eye\": [0, 0, 1], \
         \"target\": [0, 0, 0], \"fov_deg\": 40}, \"objects\": []}",
    );
    write("bare.json", &format!("{job}\"scene\": \"bare-scene.json\"}}"));
    write(
        "bare-scene.json",
        "{\"format\": \"tb-scene\", \"version\": 1, \"camera\": {\"eye\": [0, 0, 1], \
         \"target\": [0, 0, 0], \"fov_deg\": 40}, \"materials\": {\"m\": {}}, \
         \"objects\": [{\"mesh\": {\"name\": \"vase\", \"material\": \"m\"}}]}",
    );
    // The picture of mode `b` of one page has the name of the other page's strip.
    let mode = |name: &str| format!("{{\"name\": \"{name}\", \"filter\": \"point\"}}");
    let modes = format!("\"modes\": [{}, {}]", mode("b"), mode("c"));
    write("a.json", &format!("{job}\"scene\": \"s.json\", {modes}}}"));
    write("a-b.json", &format!("{job}\"scene\": \"s.json\", {modes}}}"));
    for (arguments, code, expected) in [
        (vec!["run", "vaes"], 2, "did you mean vase?"),
        (vec!["run", "typo.json"], 3, "typo.json:1:"),
        (vec!["run", "lost.json"], 5, "cannot read no.json"),
        (
            vec!["run", "stray.json"],
            2,
            "job stray makes mesh a: the scene has no mesh of that name",
        ),
        (vec!["run", "bare.json"], 2, "job bare makes no mesh vase, which bare-scene.json needs"),
        (vec!["run", "a.json", "a-b.json"], 2, "a.json and a-b.json would both write a-b.png"),
        (vec!["run", "vase", "-o", "s.json"], 5, "cannot write s.json: "),
        (vec!["run", "missing.json"], 5, "cannot read missing.json"),
        (vec!["run", "vase", "-o", "s.json/out"], 5, "cannot write s.json/out"),
        (vec!["run", "vase", "--size", "0x9"], 2, "WIDTHxHEIGHT"),
        (vec!["run"], 2, "required"),
    ] {
        let ran = run("pipeline", &arguments, folder.path());
        let words = said(&ran);
        assert_eq!(ran.status.code(), Some(code), "{arguments:?}: {words}");
        assert!(words.contains(expected), "{arguments:?}: {words}");
        assert!(!words.contains("panicked"), "{arguments:?}: {words}");
    }
}
