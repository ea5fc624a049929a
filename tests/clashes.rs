//! No output destroys an input, under any name of the file, and an output's name states its format.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::support::{root, run, said, shell};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const SPEC: &str = r#"{ "format": "tb-sweep", "version": 1, "name": "rod",
"contour": { "circle": 1 }, "trajectory": { "line": [[0, 0, 0], [0, 0, 3]] },
"depth": { "mode": "factor", "image": { "file": "relief.png", "amp": 0.1 } },
"mesh": { "rows": 4, "cols": 6 } }"#;

const SCENE: &str = r#"{ "format": "tb-scene", "version": 1, "include": ["part.json"],
"camera": { "eye": [0, 0, 9], "target": [0, 0, 0], "fov_deg": 40 }, "ambient": 0.5,
"textures": { "checks": { "image": "checks.png" } },
"materials": { "hammered": { "bump": { "image": { "file": "bump.png" }, "strength": 0.1 } } },
"objects": [ { "sphere": { "center": [0, 0, 0], "radius": 1, "material": "hammered",
                           "texture": "checks" } },
             { "mesh": { "name": "rod", "file": "rod.obj", "mtl": "rod.mtl" } } ] }"#;

/// A scene with a mesh that a job makes.
const STAGE: &str = r#"{ "format": "tb-scene", "version": 1,
"camera": { "eye": [0, 0, 9], "target": [0, 0, 0], "fov_deg": 40 }, "ambient": 0.5,
"textures": { "checks": { "image": "checks.png" } },
"materials": { "plain": {} },
"objects": [ { "sphere": { "center": [0, 0, 0], "radius": 1, "material": "plain", "texture": "checks" } },
             { "mesh": { "name": "rod", "material": "plain" } } ] }"#;

const PART: &str = r#"{ "format": "tb-scene-part", "version": 1,
"textures": { "net": { "image": "net.png" } } }"#;

const JOB: &str = r#"{ "format": "tb-job", "version": 1, "scene": "stage.json",
"meshes": { "rod": { "spec": "spec.json" } } }"#;

const AREAS: &str = r#"{ "format": "tb-areas", "version": 1,
"areas": [ { "rows": [0, 2], "cols": [0, 2], "texture": 2 } ] }"#;

/// Creates a folder with every kind of input, valid for each program.
fn inputs() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let textures = root().join("examples/textures");
    for (name, texture) in [("checks", "checkerboard"), ("net", "net"), ("painted", "granite")] {
        let texture = textures.join(format!("{texture}.png"));
        fs::copy(texture, path(&format!("{name}.png"))).unwrap();
    }
    let heights = image::GrayImage::from_fn(4, 4, |x, y| image::Luma([50 * (x + y) as u8]));
    heights.save(path("relief.png")).unwrap();
    heights.save(path("bump.png")).unwrap();
    for (name, text) in [
        ("spec.json", SPEC),
        ("scene.json", SCENE),
        ("stage.json", STAGE),
        ("part.json", PART),
        ("job.json", JOB),
        ("areas.json", AREAS),
        ("rod.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1\n"),
        ("rod.mtl", "newmtl red\nKd 1 0 0\nmap_Kd painted.png\n"),
    ] {
        fs::write(path(name), text).unwrap();
    }
    for line in [
        &["sweep", "spec.json", "-o", "rod.grid"][..],
        &["triangulate", "rod.grid", "--areas", "areas.json", "-o", "a.obj"],
        &["render", "scene.json", "--size", "8x8", "-o", "a.png"],
        &["pipeline", "run", "job.json", "--size", "8x8", "-o", "first"],
    ] {
        let ran = run(line[0], &line[1..], folder.path());
        assert!(ran.status.success(), "{line:?}: {}", said(&ran));
    }
    folder
}

/// Returns all files of a folder and its subfolders, with their bytes.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(contents(&path));
        } else {
            files.push((path.display().to_string(), fs::read(&path).unwrap()));
        }
    }
    files.sort();
    files
}

/// Runs command lines with a clash. Each must be refused in one sentence and change nothing.
fn refused(folder: &TempDir, lines: &[(&str, &str)]) {
    let before = contents(folder.path());
    for (line, expected) in lines {
        let ran = shell(line, folder.path());
        let said = said(&ran);
        assert_eq!(ran.status.code(), Some(2), "{line}: {said}");
        assert!(said.contains(expected), "{line}: {said}");
        assert_eq!(said.lines().count(), 1, "{line}: {said}");
        assert!(contents(folder.path()) == before, "{line}: changed a file");
    }
}

#[test]
fn sweep_refuses_to_write_over_what_it_reads() {
    let folder = inputs();
    let sentence = "sweep: the output spec.json is also the input spec.json (the spec): \
                    name another file with -o\n";
    refused(
        &folder,
        &[
            ("sweep spec.json -o spec.json", sentence),
            ("sweep spec.json -o ./spec.json --format json", "the output ./spec.json is also"),
            ("sweep spec.json --preview spec.json", "name another file with --preview"),
            ("sweep spec.json -o a --preview a", "the output a is also the output a"),
            ("sweep spec.json -o a --preview ../$(basename $PWD)/a", "is also the output a"),
            ("sweep - -o spec.json < spec.json", "is also the input <stdin> (the spec)"),
            ("sweep spec.json >> spec.json", "the output <stdout> is also the input spec.json"),
            ("sweep spec.json --preview relief.png", "relief.png would hold an SVG drawing"),
            (
                "ln -s relief.png link; sweep spec.json -o link; c=$?; rm link; exit $c",
                "relief.png",
            ),
            ("ln relief.png hard; sweep spec.json --preview hard; c=$?; rm hard; exit $c", "hard"),
        ],
    );
}

#[test]
fn triangulate_refuses_to_write_over_what_it_reads() {
    let folder = inputs();
    refused(
        &folder,
        &[
            ("triangulate rod.grid -o rod.grid", "the input rod.grid (the grid)"),
            ("triangulate rod.grid -o a.obj --report rod.grid", "another file with --report"),
            ("triangulate -o rod.grid < rod.grid", "the input <stdin> (the grid)"),
            ("triangulate rod.grid --areas areas.json -o areas.json", "areas.json (the areas)"),
            ("triangulate rod.grid --areas areas.json --report areas.json", "(the areas)"),
            (
                "cp rod.grid a.mtl; triangulate a.mtl --mtl -o a.obj; c=$?; rm a.mtl; exit $c",
                "the grid",
            ),
            ("triangulate rod.grid -o a.obj --report ./a.obj", "is also the output a.obj"),
            ("triangulate rod.grid -o a.obj --mtl --report a.mtl", "is also the output a.mtl"),
        ],
    );
}

#[test]
fn render_refuses_to_write_over_what_it_reads() {
    let folder = inputs();
    fs::create_dir(folder.path().join("links")).unwrap();
    let mut lines: Vec<(String, String)> = Vec::new();
    for (name, place) in [
        ("scene.json", "scene.json (the scene)"),
        ("part.json", "include[0]: the output"),
        ("checks.png", "textures.checks.image: the output"),
        ("net.png", "textures.net.image: the output"),
        ("bump.png", "materials.hammered.bump.image"),
        ("rod.obj", "rod.obj"),
        ("rod.mtl", "mesh.mtl: the output"),
        ("painted.png", "painted.png"),
    ] {
        // Every file is also addressed by a link with the name of a picture.
        std::os::unix::fs::symlink(format!("../{name}"), folder.path().join("links").join(name))
            .unwrap();
        fs::rename(
            folder.path().join("links").join(name),
            folder.path().join("links").join(format!("{name}.png")),
        )
        .unwrap();
        lines.push((format!("render scene.json -o links/{name}.png"), place.into()));
        lines.push((format!("render scene.json --format png -o {name}"), place.into()));
        if name.ends_with("png") {
            lines.push((format!("render scene.json -o {name}"), place.into()));
        }
    }
    let given = "render scene.json --mesh rod=rod.obj --format png -o rod.obj";
    lines.push((given.into(), "rod.obj (the mesh rod)".into()));
    let lines: Vec<(&str, &str)> = lines.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    refused(&folder, &lines);
}

#[test]
fn pipeline_refuses_to_write_over_what_it_reads() {
    let folder = inputs();
    // A job whose outputs have the names of its inputs.
    let named = |job: &str, scene: &str, spec: &str| {
        let text = JOB.replace("stage.json", scene).replace("spec.json", spec);
        fs::write(folder.path().join(job), text).unwrap();
    };
    let staged = |scene: &str, checks: &str| {
        fs::write(folder.path().join(scene), STAGE.replace("checks.png", checks)).unwrap();
        fs::copy(folder.path().join("checks.png"), folder.path().join(checks)).unwrap();
    };
    named("checks.json", "tented.json", "spec.json");
    staged("tented.json", "checks-exact.png");
    named("kept.json", "stage.json", "kept-rod.grid");
    fs::write(folder.path().join("kept-rod.grid"), SPEC).unwrap();
    // The second job reads the output of the first.
    named("second.json", "later.json", "spec.json");
    staged("later.json", "job-exact.png");
    named("table.json", "stage.json", "report.csv");
    fs::write(folder.path().join("report.csv"), SPEC).unwrap();
    named("told.json", "stage.json", "book.html");
    fs::write(folder.path().join("book.html"), SPEC).unwrap();
    let folder_clash = "choose another folder with -o";
    refused(
        &folder,
        &[
            ("pipeline run -q checks.json --size 8x8 -o .", folder_clash),
            ("pipeline run -q kept.json --size 8x8 --keep -o .", folder_clash),
            ("pipeline run -q job.json second.json --size 8x8 -o .", folder_clash),
            ("pipeline run -q second.json job.json --size 8x8 -o .", folder_clash),
            ("pipeline report table.json --quick --size 4x4 -o .", folder_clash),
            ("pipeline book told.json --size 8x8 --truth 0 -o . --quiet", folder_clash),
            (
                "pipeline compare checks.png a.png --map checks.png",
                "the input checks.png (a picture)",
            ),
            ("pipeline compare a.png checks.png --map ./checks.png", "another file with --map"),
        ],
    );
}

#[test]
fn a_name_that_belongs_to_another_format_is_refused() {
    let folder = inputs();
    refused(
        &folder,
        &[
            (
                "sweep spec.json -o a.obj",
                "a.obj would hold a grid, but its extension names another format",
            ),
            ("sweep spec.json -o a.json", "expected .grid"),
            ("sweep spec.json --format json -o a.stl", "expected .grid or .json"),
            ("sweep spec.json --preview a.png", "a.png would hold an SVG drawing"),
            ("triangulate rod.grid -o a.jpg", "a.jpg would hold an OBJ mesh"),
            ("triangulate rod.grid -o a.png", "expected .obj"),
            ("triangulate rod.grid -o a.grid", "expected .obj"),
            ("triangulate rod.grid -o a.obj --report b.obj", "b.obj would hold a JSON report"),
            ("render scene.json -o b.obj", "cannot tell the kind of picture from b.obj"),
        ],
    );
    for line in [
        "sweep spec.json --format json -o b.json && sweep spec.json -o b.new --preview b",
        "triangulate rod.grid -o c --report c.txt && triangulate rod.grid -o c.mesh --format stl",
        "render scene.json -o d --format png --size 8x8",
        "triangulate rod.grid -o e.stl --format obj && render scene.json -o e.png --format exr --size 8x8",
    ] {
        let ran = shell(line, folder.path());
        assert!(ran.status.success(), "{line}: {}", said(&ran));
    }
}
