//! Jobs and pages that request an error.

use crate::support;

use files::Disk;
use pipeline::run::{self, Accuracy, Event, Options};
use pipeline::{Job, pages};
use render::accuracy::census::Census;
use render::filter::Filter;
use render::{Picture, Prepared, Settings};
use std::fs;
use std::path::Path;
use std::sync::Mutex;
use support::{run as program, said};

const SPEC: &str = r#"{ "format": "tb-sweep", "version": 1, "name": "ring",
    "contour": { "circle": 0.3 }, "trajectory": { "circle": { "radius": 1.0 } },
    "mesh": MESH }"#;

const SCENE: &str = r#"{ "format": "tb-scene", "version": 1, "ambient": 0.3, "background": 0.9,
    "camera": { "eye": [0, 3, 3], "target": [0, 0, 0], "fov_deg": 40 },
    "lights": [ { "point": { "position": [4, 5, 2], "color": 0.7 } } ],
    "materials": { "dull": { "diffuse": 0.7 } },
    "objects": [ { "mesh": { "name": "ring", "material": "dull" } } ] }"#;

/// Writes a job with one mesh of this resolution, and reads it.
fn job(folder: &Path, mesh: &str, modes: &str) -> Job {
    fs::write(folder.join("ring.json"), SPEC.replace("MESH", mesh)).unwrap();
    fs::write(folder.join("scene.json"), SCENE).unwrap();
    let job = format!(
        r#"{{ "format": "tb-job", "version": 1, "scene": "scene.json",
            "meshes": {{ "ring": {{ "spec": "ring.json" }} }}, "modes": [{modes}] }}"#
    );
    fs::write(folder.join("job.json"), job).unwrap();
    Job::read(&folder.join("job.json"), &Disk).unwrap()
}

fn options(folder: &Path) -> Options {
    Options { folder: folder.into(), size: (64, 64), keep: false, clobber: true }
}

/// Runs a job with one mode, and returns its picture and what is known of the error.
fn made(job: &Job, folder: &Path) -> (Picture, Option<Accuracy>) {
    let last = Mutex::new(None);
    run::run(job, &Disk, &options(folder), &|event| {
        if let Event::Picture { picture, accuracy, .. } = event {
            *last.lock().unwrap() = Some((picture.clone(), accuracy.copied()));
        }
    })
    .unwrap();
    last.into_inner().unwrap().unwrap()
}

/// The stated tolerance of a tenth of the radius leaves a ring with corners. A request makes the mesh
/// finer. The error is then below the request, measured against a mesh within 0.0002, which is a
/// hundredth of a pixel.
#[test]
fn a_requested_error_holds_for_the_surface_and_not_only_for_its_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let fine = job(folder, r#"{ "tol": 0.0002 }"#, r#"{ "name": "exact" }"#);
    let scene = run::scene(&fine, &Disk, &options(folder), &|_| {}).unwrap();
    let settings = Settings::new(64, 64, Filter::Exact);
    let census = Census::take(&Prepared::new(&scene), &settings, 0.002);
    let true_error = |picture: &Picture| census.squared_error(picture).mean.max(0.0).sqrt();

    let stated = job(folder, r#"{ "tol": 0.05 }"#, r#"{ "name": "fine", "samples": 4 }"#);
    let corners = true_error(&made(&stated, folder).0);
    assert!(corners > 0.01, "{corners}");

    let request = job(folder, r#"{ "tol": 0.05 }"#, r#"{ "name": "error", "error": 0.01 }"#);
    let (picture, accuracy) = made(&request, folder);
    let accuracy = accuracy.unwrap();
    let error = true_error(&picture);
    assert!(error < 0.01 && accuracy.statement.missed.is_none(), "{accuracy:?}, true {error}");
    assert!(accuracy.pixels.is_some_and(|pixels| pixels < 1.0), "{accuracy:?}");
    // A third of the request, and a half more for the noise of a thousand draws.
    let [tessellation, ..] = [accuracy.sources.unwrap().tessellation.unwrap()];
    assert!(tessellation < 1.5 / 3.0 * 0.01 * 0.01, "{accuracy:?}");
}

/// Counted cells stay as they are. The error of the picture is that on its mesh, and the share of the
/// mesh is stated.
#[test]
fn the_share_of_a_mesh_with_counted_cells_is_stated() {
    let folder = tempfile::tempdir().unwrap();
    let mode = r#"{ "name": "error", "error": 0.02 }"#;
    let coarse = job(folder.path(), r#"{ "rows": 12, "cols": 8 }"#, mode);
    let accuracy = made(&coarse, folder.path()).1.unwrap();
    assert_eq!(accuracy.pixels, None);
    let sources = accuracy.sources.unwrap();
    let [tessellation, ..] = sources.shares();
    assert!(tessellation > 0.5, "corners are seen: {sources}");
    let fine = job(folder.path(), r#"{ "rows": 200, "cols": 80 }"#, mode);
    let accuracy = made(&fine, folder.path()).1.unwrap();
    let [tessellation, ..] = accuracy.sources.unwrap().shares();
    assert!(tessellation < 0.1, "{accuracy:?}");
}

#[test]
fn a_page_that_is_named_alone_has_a_picture_of_a_requested_error() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["run", "solids", "-o", "out", "--size", "24x24"];
    let ran = program("pipeline", &arguments, folder.path());
    let words = said(&ran);
    assert!(ran.status.success(), "{words}");
    assert!(words.contains("solids error: error 0.00"), "{words}");
    assert!(folder.path().join("out/solids-error.png").exists());
    // The strip shows the modes of the page only.
    let strip = image::open(folder.path().join("out/solids.png")).unwrap();
    let modes = pages::page("solids").unwrap().modes.len() as u32;
    assert_eq!(strip.width(), modes * 24 + (modes - 1) * 8);
}

#[test]
fn requests_out_of_range_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (error, message) in [
        ("0", "expected a number above 0 and below 1"),
        ("-1", "expected a number above 0"),
        ("NaN", "expected a number above 0"),
        ("1e-6", "expected at least 0.0000076"),
        ("much", "expected a number, such as 0.01, or 8bit"),
    ] {
        let ran =
            program("pipeline", &["run", "solids", &format!("--error={error}")], folder.path());
        assert_eq!(ran.status.code(), Some(2), "{error}");
        assert!(said(&ran).contains(message), "{error}: {}", said(&ran));
    }
    let both = ["run", "solids", "--error", "0.1", "--mode", "exact"];
    let ran = program("pipeline", &both, folder.path());
    assert_eq!(ran.status.code(), Some(2));
    assert!(said(&ran).contains("cannot be used with"), "{}", said(&ran));
}
