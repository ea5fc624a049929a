//! Files that the studio exports, against the command lines that it shows.
#![cfg(unix)]

use crate::support::http::Studio;
use crate::support::shell;
use serde_json::json;
use std::fs;

#[test]
fn the_commands_make_the_bytes_of_the_exports() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::start(folder.path(), &["vase"]);
    let view = json!({ "size": [48, 40], "error": 0.05, "beside": null });
    studio.told("view", &view);
    for end in ["obj", "stl", "ply", "glb", "3mf", "png", "exr"] {
        let path = format!("out/vase.{end}");
        let done = studio.told("export", &json!({ "path": path }));
        let ours = fs::read(folder.path().join(&path)).unwrap();
        assert_eq!(done["bytes"], ours.len());
        fs::remove_dir_all(folder.path().join("out")).unwrap();
        fs::create_dir(folder.path().join("out")).unwrap();
        let commands: Vec<&str> = done["commands"]
            .as_array()
            .unwrap()
            .iter()
            .map(|line| line.as_str().unwrap())
            .collect();
        let ran = shell(&commands.join("\n"), folder.path());
        assert!(ran.status.success(), "{commands:?}: {}", String::from_utf8_lossy(&ran.stderr));
        assert!(ours == fs::read(folder.path().join(&path)).unwrap(), "{commands:?}");
    }
}

#[test]
fn a_spec_without_a_scene_is_exported_with_the_scene_that_the_studio_made() {
    let folder = tempfile::tempdir().unwrap();
    let studio = Studio::start(folder.path(), &[]);
    studio.told("new", &json!({ "name": "bowl" }));
    studio.told("view", &json!({ "size": [40, 40], "error": null, "beside": null }));
    let (code, answer) = studio.ask("export", Some(&json!({ "path": "bowl.png" })));
    assert_eq!(code, 422, "{answer}");
    studio.told("save", &json!({}));
    let done = studio.told("export", &json!({ "path": "bowl.png" }));
    let ours = fs::read(folder.path().join("bowl.png")).unwrap();
    fs::remove_file(folder.path().join("bowl.png")).unwrap();
    let lines: Vec<&str> =
        done["commands"].as_array().unwrap().iter().map(|line| line.as_str().unwrap()).collect();
    let ran = shell(&lines.join("\n"), folder.path());
    assert!(ran.status.success(), "{lines:?}: {}", String::from_utf8_lossy(&ran.stderr));
    assert!(ours == fs::read(folder.path().join("bowl.png")).unwrap());
    let picture = image::load_from_memory(&ours).unwrap().to_luma8();
    let spread = picture.pixels().map(|pixel| pixel[0]).max().unwrap()
        - picture.pixels().map(|pixel| pixel[0]).min().unwrap();
    assert!(spread > 60, "the bowl stands out: {spread}");
}
