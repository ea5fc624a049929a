//! Starting points for one's own work: values that the command line sets, and pages written into a folder.

use crate::support;

use std::fs;
use support::{root, run, said};

/// Returns the pixels of a PNG; its texts name the command.
fn pixels(folder: &std::path::Path, name: &str) -> Vec<u8> {
    image::open(folder.join(name)).unwrap().to_rgb8().into_raw()
}

/// Runs a program that must succeed.
fn done(program: &str, arguments: &[&str], folder: &std::path::Path) {
    let ran = run(program, arguments, folder);
    assert!(ran.status.success(), "{}", said(&ran));
}

#[test]
fn an_exported_page_makes_the_pictures_of_the_built_in_page() {
    let folder = tempfile::tempdir().unwrap();
    done("pipeline", &["export", "globe"], folder.path());
    let size = ["--size", "64x48", "-q"];
    done("pipeline", &[&["run", "globe", "-o", "a"], &size[..]].concat(), folder.path());
    let own = &["run", "globe/pages/globe.json", "-o", "b"];
    done("pipeline", &[&own[..], &size[..]].concat(), folder.path());
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(read("a/globe.png"), read("b/globe.png"));
    assert!(folder.path().join("globe/scenes/globe.json").exists());
    assert!(folder.path().join("globe/textures/graticule.png").exists());
}

#[test]
fn a_value_that_is_set_gives_the_picture_of_the_edited_file() {
    let folder = tempfile::tempdir().unwrap();
    let scene = fs::read_to_string(root().join("examples/scenes/glass-sphere.json")).unwrap();
    let textures = root().join("examples/textures");
    let scene = scene.replace("../textures", textures.to_str().unwrap());
    fs::write(folder.path().join("scene.json"), &scene).unwrap();
    let mut edited: serde_json::Value = serde_json::from_str(&scene).unwrap();
    edited["camera"]["fov_deg"] = 21.into();
    edited["camera"]["up"] = serde_json::json!([0.1, 0, 1]);
    fs::write(folder.path().join("edited.json"), edited.to_string()).unwrap();
    let set = ["-D", "camera.fov_deg=21", "-D", "camera.up=[0.1, 0, 1]"];
    let size = ["--size", "64x48"];
    let own = ["scene.json", "-o", "set.png"];
    done("render", &[&own[..], &set, &size].concat(), folder.path());
    done("render", &[&["edited.json", "-o", "edited.png"], &size[..]].concat(), folder.path());
    let read = |name: &str| pixels(folder.path(), name);
    assert_eq!(read("set.png"), read("edited.png"));
}

#[test]
fn a_job_sets_values_of_its_scene_and_of_its_specs() {
    let folder = tempfile::tempdir().unwrap();
    done("pipeline", &["export", "vase", "-q"], folder.path());
    for (file, path, value) in
        [("scenes/vase.json", "/camera/fov_deg", 20), ("curves/vase.json", "/mesh/cols", 24)]
    {
        let file = folder.path().join("vase").join(file);
        let mut json: serde_json::Value =
            serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
        *json.pointer_mut(path).unwrap() = value.into();
        fs::write(&file, json.to_string()).unwrap();
    }
    let more = ["--mode", "exact", "--size", "64x48", "-q"];
    let edited = ["run", "vase/pages/vase.json", "-o", "a"];
    done("pipeline", &[&edited[..], &more].concat(), folder.path());
    let set = ["-D", "scene.camera.fov_deg=20", "-D", "specs.vase.mesh.cols=24"];
    done("pipeline", &[&["run", "vase", "-o", "b"][..], &set, &more].concat(), folder.path());
    let read = |name: &str| pixels(folder.path(), name);
    assert_eq!(read("a/vase-exact.png"), read("b/vase-exact.png"));
}

#[test]
fn a_value_that_is_set_is_checked_like_one_that_is_written() {
    let folder = tempfile::tempdir().unwrap();
    done("pipeline", &["export", "vase", "-q"], folder.path());
    for (program, file, setting, code, message) in [
        (
            "render",
            "vase/scenes/vase.json",
            "camera.fov_deg=x",
            3,
            "found the string \"x\", expected a number",
        ),
        ("render", "vase/scenes/vase.json", "camera.fov_dge=3", 3, "did you mean `fov_deg`?"),
        (
            "render",
            "vase/scenes/vase.json",
            "objects[99].a=3",
            2,
            "found objects[99], expected a number below",
        ),
        ("sweep", "vase/curves/vase.json", "mesh.cols=-1", 3, "mesh.cols"),
    ] {
        let output = if program == "render" { "x.png" } else { "x.grid" };
        let ran = run(program, &[file, "-D", setting, "-o", output], folder.path());
        assert_eq!(ran.status.code(), Some(code), "{setting}: {}", said(&ran));
        assert!(said(&ran).contains(message), "{setting}: {}", said(&ran));
        assert!(!folder.path().join(output).exists());
    }
    let ran = run("pipeline", &["run", "vase", "-D", "specs.vsae.mesh.cols=9"], folder.path());
    assert_eq!(ran.status.code(), Some(2), "{}", said(&ran));
    assert!(said(&ran).contains("job vase makes vase"), "{}", said(&ran));
    let ran = run("pipeline", &["export", "vsae"], folder.path());
    assert!(said(&ran).contains("did you mean vase?"), "{}", said(&ran));
}
