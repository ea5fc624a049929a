//! Pictures of a mesh or a spec without a scene: `render MESH` and `pipeline show`.

use crate::support;

use std::fs;
use std::path::Path;
use support::{root, run, said};

/// A cube of side 2 with its middle at `at`, in quads without normals.
fn cube(at: [f64; 3]) -> String {
    let corner = |k: u32| {
        let side = |b: u32| if k >> b & 1 == 1 { 1.0 } else { -1.0 };
        format!("v {} {} {}\n", at[0] + side(0), at[1] + side(1), at[2] + side(2))
    };
    let corners: String = (0..8).map(corner).collect();
    corners + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
}

fn done(program: &str, arguments: &[&str], folder: &Path) -> String {
    let ran = run(program, arguments, folder);
    assert!(ran.status.success(), "{arguments:?}: {}", said(&ran));
    said(&ran)
}

fn pixels(path: &Path) -> image::RgbImage {
    image::open(path).unwrap().to_rgb8()
}

#[test]
fn a_scene_that_is_written_makes_the_same_picture() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cube.obj"), cube([0.0; 3])).unwrap();
    fs::create_dir(folder.path().join("scenes")).unwrap();
    let size = ["--size", "60x40"];
    for (scene, flags) in [
        ("s.json", &[][..]),
        ("scenes/s.json", &["--view", "top", "--color", "teal"]),
        ("s.json", &["--up", "-x", "--no-ground", "-D", "camera.fov_deg=20"]),
    ] {
        let words = ["cube.obj", "--scene-out", scene, "-o", "a.png"];
        done("render", &[&words[..], &size, flags].concat(), folder.path());
        done("render", &[&[scene, "-o", "b.png"][..], &size].concat(), folder.path());
        let read = |name: &str| pixels(&folder.path().join(name));
        assert_eq!(read("a.png"), read("b.png"), "{flags:?}");
        done("render", &["--check", scene], folder.path());
    }
}

#[test]
fn a_cube_looks_alike_wherever_it_is_and_however_large() {
    let folder = tempfile::tempdir().unwrap();
    let picture = |text: &str| {
        fs::write(folder.path().join("cube.obj"), text).unwrap();
        done("render", &["cube.obj", "--size", "64x64", "-o", "a.png"], folder.path());
        pixels(&folder.path().join("a.png"))
    };
    let near = picture(&cube([0.0; 3]));
    let scaled = |factor: f64| {
        let line = |line: &str| match line.strip_prefix("v ") {
            None => format!("{line}\n"),
            Some(rest) => {
                let numbers =
                    rest.split(' ').map(|x| (x.parse::<f64>().unwrap() * factor).to_string());
                format!("v {}\n", numbers.collect::<Vec<_>>().join(" "))
            }
        };
        cube([0.0; 3]).lines().map(line).collect::<String>()
    };
    let others = [cube([1e6, -3e5, 2e6]), scaled(1e-6), scaled(1e9)];
    for (k, other) in others.iter().map(|text| picture(text)).enumerate() {
        let differences = near.as_raw().iter().zip(other.as_raw()).map(|(a, b)| a.abs_diff(*b));
        let mean = differences.clone().map(f64::from).sum::<f64>() / near.as_raw().len() as f64;
        assert!(mean < 0.5, "cube {k}: the mean difference is {mean} codes");
    }
    // The front faces the lights more than the right side.
    let at = |x: u32, y: u32| i32::from(near.get_pixel(x, y).0[1]);
    assert!(at(20, 36) > at(50, 32) + 20, "{} {}", at(20, 36), at(50, 32));
}

#[test]
fn a_spec_its_grid_and_its_mesh_give_the_same_picture() {
    let folder = tempfile::tempdir().unwrap();
    done("pipeline", &["new", "knot"], folder.path());
    let size = ["--size", "48x48", "-q"];
    let show = |file: &str, picture: &str| {
        done("pipeline", &[&["show", file, "-o", picture][..], &size].concat(), folder.path());
        pixels(&folder.path().join(picture))
    };
    let by_spec = show("knot.json", "a.png");
    done("sweep", &["knot.json", "-o", "knot.grid"], folder.path());
    done("triangulate", &["knot.grid", "-o", "knot.obj"], folder.path());
    assert_eq!(by_spec, show("knot.grid", "b.png"));
    assert_eq!(by_spec, show("knot.obj", "c.png"));
    done("render", &[&["knot.obj", "-o", "d.png"][..], &size].concat(), folder.path());
    assert_eq!(by_spec, pixels(&folder.path().join("d.png")));
    // The stripes of the knot have another colour than the knot.
    let is_red = |pixel: &&image::Rgb<u8>| pixel.0[0].saturating_sub(pixel.0[2]) > 60;
    assert!(by_spec.pixels().filter(is_red).count() > 20);
}

#[test]
fn all_examples_to_start_from_make_their_pictures_and_check_well() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["vase", "tube", "knot", "klein", "moebius", "letter", "scene"] {
        let file = format!("{name}.json");
        let told = done("pipeline", &["new", name], folder.path());
        // The line that is printed is the command.
        let command = told.lines().last().unwrap().split_once(": ").unwrap().1;
        let words: Vec<&str> = command.split(' ').chain(["--size", "40x40", "-q"]).collect();
        done(words[0], &words[1..], folder.path());
        let picture = pixels(&folder.path().join(format!("{name}.png")));
        let colors: std::collections::BTreeSet<_> = picture.pixels().map(|pixel| pixel.0).collect();
        assert!(colors.len() > 50, "{name}: {} colours", colors.len());
        let program = if name == "scene" { "render" } else { "sweep" };
        done(program, &["--check", &file], folder.path());
        let again = run("pipeline", &["new", name], folder.path());
        assert_eq!(again.status.code(), Some(2));
        assert!(said(&again).contains("replaces no file"), "{}", said(&again));
    }
}

#[test]
fn a_file_of_another_kind_names_its_command() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| root().join("examples").join(name).display().to_string();
    for (program, words, hint) in [
        ("render", vec![path("curves/vase.json")], "`pipeline show"),
        ("render", vec![path("pages/vase.json")], "`pipeline run"),
        ("pipeline", vec!["show".into(), path("scenes/vase.json")], "`render"),
        ("pipeline", vec!["show".into(), path("pages/vase.json")], "`pipeline run"),
    ] {
        let words: Vec<&str> = words.iter().map(String::as_str).chain(["-o", "a.png"]).collect();
        let ran = run(program, &words, folder.path());
        assert!(said(&ran).contains(hint), "{words:?}: {}", said(&ran));
        assert!(!folder.path().join("a.png").exists());
    }
    let scene = path("scenes/glass-sphere.json");
    let ran = run("render", &[&scene, "--view", "top", "-o", "a.png"], folder.path());
    assert_eq!(ran.status.code(), Some(2));
    assert!(said(&ran).contains("--view is for a mesh without a scene"), "{}", said(&ran));
}

#[test]
fn variants_of_a_table_are_the_pictures_of_their_values() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cube.obj"), cube([0.0; 3])).unwrap();
    let table = "name,camera.fov_deg,ambient\nwide,50,\nnear,,0.6\n";
    fs::write(folder.path().join("table.csv"), table).unwrap();
    let size = ["--size", "40x30", "-q"];
    let words = ["cube.obj", "--jobs-from", "table.csv", "-o", "cube.png"];
    done("render", &[&words[..], &size].concat(), folder.path());
    for (name, set) in [("wide", "camera.fov_deg=50"), ("near", "ambient=0.6")] {
        let words = ["cube.obj", "-D", set, "-o", "one.png"];
        done("render", &[&words[..], &size].concat(), folder.path());
        let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
        assert_eq!(read(&format!("cube-{name}.png")), read("one.png"), "{name}");
    }
    assert!(!folder.path().join("cube.png").exists());
    let table = "specs.vase.mesh.cols,scene.camera.fov_deg\n24,30\n24,20\n";
    fs::write(folder.path().join("jobs.csv"), table).unwrap();
    let mode = ["--mode", "exact", "--size", "40x30", "-q"];
    let words = ["run", "vase", "--jobs-from", "jobs.csv", "-o", "out"];
    done("pipeline", &[&words[..], &mode].concat(), folder.path());
    let set = ["-D", "specs.vase.mesh.cols=24", "-D", "scene.camera.fov_deg=20"];
    done("pipeline", &[&["run", "vase", "-o", "one"][..], &set, &mode].concat(), folder.path());
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(read("out/vase-2-exact.png"), read("one/vase-exact.png"));
}

#[test]
fn every_program_has_completions_a_page_and_suggestions() {
    let folder = tempfile::tempdir().unwrap();
    for program in ["sweep", "triangulate", "render", "pipeline"] {
        for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
            let ran = run(program, &["completions", shell], folder.path());
            let text = String::from_utf8_lossy(&ran.stdout).into_owned();
            assert!(ran.status.success() && text.contains(program), "{program} {shell}");
        }
        let ran = run(program, &["man"], folder.path());
        let text = String::from_utf8_lossy(&ran.stdout).into_owned();
        assert!(text.contains(".TH") && text.contains("SYNOPSIS"), "{text}");
        let ran = run(program, &["--versoin"], folder.path());
        assert!(said(&ran).contains("--version"), "{}", said(&ran));
        let ran = run(program, &["--version"], folder.path());
        let version = String::from_utf8_lossy(&ran.stdout).into_owned();
        assert!(version.starts_with(program), "{version}");
    }
}

#[test]
fn a_written_picture_is_told_and_progress_has_its_form() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cube.obj"), cube([0.0; 3])).unwrap();
    let words = ["cube.obj", "--size", "30x20", "-o", "a.png"];
    let told = String::from_utf8(run("render", &words, folder.path()).stderr).unwrap();
    assert!(told.starts_with("wrote a.png (30 x 20, ") && told.ends_with(" s)\n"), "{told}");
    let quiet = run("render", &[&words[..], &["-q"]].concat(), folder.path());
    assert!(quiet.status.success() && quiet.stderr.is_empty());
    let told = done("render", &[&words[..], &["--progress", "plain"]].concat(), folder.path());
    assert!(told.starts_with("render: 100 %, "), "{told}");
    let told = done("render", &[&words[..], &["--progress", "json"]].concat(), folder.path());
    let line: serde_json::Value = serde_json::from_str(told.lines().next().unwrap()).unwrap();
    assert_eq!((&line["progress"], &line["done"]), (&"render".into(), &line["total"]));
}

#[test]
fn a_job_that_show_writes_and_a_scene_make_the_same_picture() {
    let folder = tempfile::tempdir().unwrap();
    let size = ["--size", "60x40"];
    done("pipeline", &["new", "knot", "-o", "knot.json"], folder.path());
    for (scene, job) in [("s.json", "j.json"), ("a/s.json", "b/j.json")] {
        for file in [scene, job] {
            let parent = folder.path().join(file);
            fs::create_dir_all(parent.parent().unwrap()).unwrap();
        }
        let words = ["show", "knot.json", "-o", "a.png", "--scene-out", scene, "--job-out", job];
        let told = done("pipeline", &[&words[..], &size].concat(), folder.path());
        assert!(told.contains(&format!("pipeline run {job} -o out")), "{told}");
        done("pipeline", &[&["run", job, "-o", "out"], &size[..]].concat(), folder.path());
        let read = |name: &str| pixels(&folder.path().join(name));
        assert_eq!(read("a.png"), read("out/j-exact.png"));
    }
    // A scene without meshes is a job by itself, and its values and its frames may be set.
    done("pipeline", &["new", "scene", "-o", "scene.json"], folder.path());
    let set = ["-D", "scene.camera.fov_deg=30"];
    let words = ["run", "scene.json", "-o", "out", "-D", "turntable.frames=2", "--frames", "1"];
    done("pipeline", &[&words[..], &set, &size].concat(), folder.path());
    let own = ["scene.json", "-o", "own.png", "-D", "camera.fov_deg=30"];
    done("render", &[&own[..], &size].concat(), folder.path());
    let read = |name: &str| pixels(&folder.path().join(name));
    assert_eq!(read("own.png"), read("out/scene-exact.0001.png"));
}

#[test]
fn files_of_another_kind_are_refused_with_the_program_for_them() {
    let folder = tempfile::tempdir().unwrap();
    done("pipeline", &["new", "knot", "-o", "knot.json"], folder.path());
    done("pipeline", &["new", "scene", "-o", "scene.json"], folder.path());
    for (program, words, code, hint) in [
        ("pipeline", &["run", "knot.json"][..], 3, "`pipeline show` makes a picture of a spec"),
        ("sweep", &["scene.json", "-o", "a.grid"], 3, "`render` makes a picture of a scene"),
        (
            "pipeline",
            &["show", "scene.json", "-o", "a.png", "--scene-out", "s.json", "--job-out", "j.json"],
            2,
            "render",
        ),
    ] {
        let ran = run(program, words, folder.path());
        assert_eq!(ran.status.code(), Some(code), "{}", said(&ran));
        assert!(said(&ran).contains(hint), "{}", said(&ran));
    }
    let words =
        ["show", "knot.json", "-o", "a.png", "--scene-out", "s.json", "--job-out", "j.json"];
    let ran = run("pipeline", &[&words[..], &["-D", "contour.circle=0.2"]].concat(), folder.path());
    assert_eq!(ran.status.code(), Some(2), "{}", said(&ran));
    assert!(said(&ran).contains("leave -D contour.circle=0.2 out"), "{}", said(&ran));
}
