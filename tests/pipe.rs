//! The three programs in a pipe, as the README shows them.
#![cfg(unix)]

use crate::support;

use std::fs;
use support::{root, run, said, shell_beside_examples as shell};

/// Returns the command line of the pipe in the README.
fn readme_line() -> String {
    let readme = fs::read_to_string(root().join("README.md")).expect("there is a README");
    let line = readme.lines().find(|line| line.starts_with("sweep ")).expect("the README's pipe");
    assert_eq!(
        line,
        "sweep examples/curves/vase.json | triangulate --texture 2 | \
         render examples/scenes/vase.json --mesh vase=- -o vase.png"
    );
    line.into()
}

#[test]
fn the_pipe_in_the_readme_makes_the_picture_that_the_pipeline_makes() {
    let folder = tempfile::tempdir().unwrap();
    let line = readme_line().replace("-o vase.png", "--size 160x120 -o vase.png");
    let piped = shell(&line, folder.path());
    assert!(piped.status.success() && said(&piped).is_empty(), "{}", said(&piped));

    let arguments = ["run", "vase", "-o", "out", "--size", "160x120", "--keep"];
    let ran = run("pipeline", &arguments, folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(read("vase.png"), read("out/vase-exact.png"));

    // The kept files equal the data that went through the pipes.
    let line = "sweep examples/curves/vase.json | tee a.grid | triangulate --texture 2 > a.obj";
    assert!(shell(line, folder.path()).status.success());
    assert_eq!(read("a.grid"), read("out/vase-vase.grid"));
    assert_eq!(read("a.obj"), read("out/vase-vase.obj"));
}

#[test]
fn a_transparent_picture_of_a_job_is_that_of_render() {
    let folder = tempfile::tempdir().unwrap();
    let scene = r#"{ "format": "tb-scene", "version": 1, "background": null,
        "camera": { "eye": [0, -5, 0], "target": [0, 0, 0], "up": [0, 0, 1], "fov_deg": 30 },
        "lights": [ { "directional": { "direction": [1, 2, -1], "color": [1, 1, 1] } } ],
        "materials": { "clay": {} },
        "objects": [ { "sphere": { "center": [0, 0, 0], "radius": 1, "material": "clay" } } ] }"#;
    let job = r#"{ "format": "tb-job", "version": 1, "scene": "ball.json" }"#;
    fs::write(folder.path().join("ball.json"), scene).unwrap();
    fs::write(folder.path().join("job.json"), job).unwrap();
    let line =
        "render ball.json --size 40x30 -o a.png && pipeline run job.json -q --size 40x30 -o out";
    let ran = shell(line, folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(read("a.png"), read("out/job-exact.png"));
    let picture = image::open(folder.path().join("a.png")).unwrap().to_rgba8();
    assert_eq!((picture.get_pixel(0, 0)[3], picture.get_pixel(20, 15)[3]), (0, 255));
}

#[test]
fn the_surface_of_ones_own_in_the_readme_is_swept() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let spec = readme.split("```json\n").nth(1).and_then(|rest| rest.split("```").next());
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ring.json"), spec.expect("the README has a spec")).unwrap();
    let line = "sweep ring.json | triangulate | tail -n 1";
    let ran = shell(line, folder.path());
    assert_eq!(String::from_utf8_lossy(&ran.stdout), "# end 4608 9216\n", "{}", said(&ran));
}

#[test]
fn the_json_grid_gives_the_same_triangles_as_the_binary_one() {
    let folder = tempfile::tempdir().unwrap();
    let line = "sweep examples/curves/trefoil.json --rows 40 --cols 12 | triangulate > a.obj && \
                sweep examples/curves/trefoil.json --rows 40 --cols 12 --format json | \
                triangulate > b.obj && cmp a.obj b.obj";
    let compared = shell(line, folder.path());
    assert!(compared.status.success(), "{}", said(&compared));
}

#[test]
fn a_program_that_died_upstream_is_noticed_and_the_old_picture_stays() {
    for broken in [
        "sweep no-such-spec.json | triangulate --texture 2",
        "sweep examples/curves/vase.json | head -c 100000 | triangulate --texture 2",
        "sweep examples/curves/vase.json | triangulate --texture 2 | head -c 100000",
        "sweep examples/curves/vase.json | triangulate --texture 2 | head -n -1",
    ] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("vase.png"), "old").unwrap();
        let render = "render examples/scenes/vase.json --size 8x8 --mesh vase=- -o vase.png";
        let ran = shell(&format!("{broken} | {render}"), folder.path());
        assert_eq!(ran.status.code(), Some(3), "{broken}: {}", said(&ran));
        assert!(said(&ran).contains("render: <stdin>: "), "{broken}: {}", said(&ran));
        assert!(!said(&ran).contains("panicked"), "{broken}: {}", said(&ran));
        assert_eq!(fs::read_to_string(folder.path().join("vase.png")).unwrap(), "old");
        let left: Vec<_> =
            fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().path()).collect();
        assert_eq!(left.len(), 2, "only the picture and the examples are there: {left:?}");
    }
}

#[test]
fn a_reader_that_stops_reading_ends_the_programs_quietly() {
    let folder = tempfile::tempdir().unwrap();
    for line in [
        "{ sweep examples/curves/vase.json; echo $? >&2; } | head -c 10 > /dev/null",
        "sweep examples/curves/vase.json > a.grid; { triangulate a.grid; echo $? >&2; } | head -c 10 > /dev/null",
    ] {
        let ran = shell(line, folder.path());
        assert_eq!(said(&ran).trim(), "141", "{line}");
    }
}

#[test]
fn an_object_with_two_pictures_is_the_same_through_pipes_and_in_memory() {
    let folder = tempfile::tempdir().unwrap();
    let examples = root().join("examples");
    let spec = fs::read_to_string(examples.join("curves/vase.json")).unwrap();
    let areas = "\"areas\": [{ \"rows\": [40, 100], \"cols\": [30, 90], \"texture\": 3, \"surface\": 1 }],\n  \"mesh\"";
    fs::write(folder.path().join("vase.json"), spec.replace("\"mesh\"", areas)).unwrap();
    let scene = fs::read_to_string(examples.join("scenes/vase.json")).unwrap();
    let scene = scene.replace("\"2\": \"band\"", "\"2\": \"band\", \"3\": \"tiles\"");
    let scene = scene.replace("../textures", "examples/textures");
    fs::write(folder.path().join("scene.json"), scene).unwrap();
    let job = r#"{ "format": "tb-job", "version": 1, "scene": "scene.json",
        "meshes": { "vase": { "spec": "vase.json", "texture": 2 } } }"#;
    fs::write(folder.path().join("job.json"), job).unwrap();

    let line = "sweep vase.json | triangulate --texture 2 | tee a.obj | \
                render scene.json --mesh vase=- --size 160x120 -o piped.png";
    let piped = shell(line, folder.path());
    assert!(piped.status.success() && said(&piped).is_empty(), "{}", said(&piped));
    let arguments = ["run", "job.json", "-o", "out", "--size", "160x120", "--keep"];
    let ran = run("pipeline", &arguments, folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(read("a.obj"), read("out/job-vase.obj"));
    assert_eq!(read("piped.png"), read("out/job-exact.png"));
    assert!(String::from_utf8(read("a.obj")).unwrap().contains("\nusemtl tex3_surf1\n"));
    // The second picture is visible.
    let plain = "sweep examples/curves/vase.json | triangulate --texture 2 | \
                 render examples/scenes/vase.json --mesh vase=- --size 160x120 -o plain.png";
    assert!(shell(plain, folder.path()).status.success());
    assert_ne!(read("piped.png"), read("plain.png"));
}

#[test]
fn pixels_without_a_camera_are_those_of_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let vase = fs::read_to_string(root().join("examples/curves/vase.json")).unwrap();
    let with = |mesh: &str| vase.replace("{ \"rows\": 120, \"cols\": 160 }", mesh);
    fs::write(folder.path().join("bare.json"), with("{ \"pixels\": 0.5 }")).unwrap();
    let camera = "{ \"eye\": [0.9, 1.75, 4.6], \"target\": [0, 0.93, 0], \"fov_deg\": 36, \
                  \"size\": [64, 48] }";
    let seen = with(&format!("{{ \"pixels\": 0.5, \"camera\": {camera} }}"));
    fs::write(folder.path().join("seen.json"), seen).unwrap();
    let job = "{ \"format\": \"tb-job\", \"version\": 1, \"scene\": \"examples/scenes/vase.json\", \
                \"meshes\": { \"vase\": { \"spec\": \"bare.json\", \"texture\": 2 } } }";
    fs::write(folder.path().join("job.json"), job).unwrap();

    let refused = shell("sweep bare.json -o bare.grid", folder.path());
    assert_eq!(refused.status.code(), Some(3));
    assert!(said(&refused).contains("`pipeline run`"), "{}", said(&refused));
    let line = "pipeline run job.json --size 64x48 --keep -o out && sweep seen.json -o seen.grid";
    let ran = shell(line, folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(bytes("out/job-vase.grid"), bytes("seen.grid"));
}
