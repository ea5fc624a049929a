//! A small animated job in a folder, for tests of animations and of schedulers.
#![cfg(unix)]
#![allow(clippy::missing_panics_doc, reason = "a test that cannot go on fails")]

use super::{run, said};
use image::RgbImage;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The spec of a rod.
pub const SPEC: &str = r#"{ "format": "tb-sweep", "version": 1, "name": "rod",
"contour": { "svg": "M.5 .2H-.5V-.2H.5Z" }, "trajectory": { "line": [[0, -1, 0], [0, 1, 0]] },
"mesh": { "rows": 12, "cols": 8 } }"#;

/// A scene with the rod on a floor of checks.
pub const SCENE: &str = r#"{ "format": "tb-scene", "version": 1, "ambient": 0.3,
"camera": { "eye": [0, 1, 6], "target": [0, 0, 0], "fov_deg": 35 },
"lights": [ { "directional": { "direction": [-1, -2, -3], "color": 0.7 } } ],
"textures": { "checks": { "image": "checks.png" } },
"materials": { "clay": { "color": [0.8, 0.6, 0.4] }, "floor": {} },
"objects": [ { "mesh": { "name": "rod", "material": "clay" } },
  { "plane": { "point": [0, -1, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1], "material": "floor",
    "texture": "checks" } } ] }"#;

/// A folder with `jobs/job.json`, its scene, spec and texture, and these keys of the job.
pub fn folder(keys: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for name in ["jobs", "parts"] {
        fs::create_dir(path(name)).unwrap();
    }
    let job = format!(
        r#"{{ "format": "tb-job", "version": 1, "scene": "../parts/scene.json",
        "meshes": {{ "rod": {{ "spec": "../parts/rod.json" }} }}, {keys} }}"#
    );
    fs::write(path("jobs/job.json"), job).unwrap();
    fs::write(path("parts/scene.json"), SCENE).unwrap();
    fs::write(path("parts/rod.json"), SPEC).unwrap();
    let checks = |x, y| image::Rgb([if (x + y) % 2 == 0 { 255 } else { 60 }; 3]);
    RgbImage::from_fn(2, 2, checks).save(path("parts/checks.png")).unwrap();
    folder
}

/// Runs `pipeline run jobs/job.json` with these flags, which must succeed. Returns what was said.
pub fn make(folder: &Path, flags: &[&str]) -> String {
    let arguments = [&["run", "jobs/job.json", "--size", "24x18"], flags].concat();
    let ran = run("pipeline", &arguments, folder);
    assert!(ran.status.success(), "{flags:?}: {}", said(&ran));
    said(&ran)
}

/// Reads a picture.
pub fn pixels(path: &Path) -> RgbImage {
    image::open(path).unwrap().to_rgb8()
}

/// Returns the names of the files in a folder with their bytes.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .map(|path| (path.file_name().unwrap().to_str().unwrap().into(), fs::read(&path).unwrap()))
        .collect()
}
