//! Animations, parts of pictures and packed jobs, by the program from outside.
#![cfg(unix)]

use crate::support::animated::{SCENE, SPEC, files, folder, make, pixels};
use crate::support::{run, said, shell};
use image::RgbImage;
use std::fs;
use std::path::Path;
use std::time::SystemTime;

fn times(folder: &Path) -> Vec<SystemTime> {
    let names = files(folder).into_keys();
    names.map(|name| fs::metadata(folder.join(name)).unwrap().modified().unwrap()).collect()
}

/// A frame is the picture with its values set, of the camera alone and of scene, spec and camera.
#[test]
fn a_frame_is_the_picture_with_its_values() {
    let camera = r#""animate": { "frames": 5, "set": {
        "scene.camera.eye": { "keys": [[0, [0, 1, 6]], [1, [4, 3, 2]]] } } }"#;
    let all = r#""animate": { "frames": 5, "set": {
        "scene.camera.eye": { "keys": [[0, [0, 1, 6]], [1, [4, 3, 2]]] },
        "scene.materials.clay.color": { "total": [0, 1, 2] }, "specs.rod.twist": { "total": 240 } } }"#;
    for (keys, more) in [
        (camera, vec![]),
        (all, vec!["-D", "scene.materials.clay.color=[0, 0.5, 1]", "-D", "specs.rod.twist=120"]),
    ] {
        let folder = folder(keys);
        let path = folder.path();
        let told = make(path, &["-o", "out", "--frames", "2-3,5"]);
        let names: Vec<String> = files(&path.join("out")).into_keys().collect();
        let expected = ["job-exact.0002.png", "job-exact.0003.png", "job-exact.0005.png"];
        assert_eq!(names, expected, "{told}");
        let flags =
            [&["-o", "still", "--still", "-D", "scene.camera.eye=[2, 2, 4]"], &more[..]].concat();
        make(path, &flags);
        let [frame, still] =
            ["out/job-exact.0003.png", "still/job-exact.png"].map(|name| pixels(&path.join(name)));
        assert!(frame == still, "{keys}");
        assert!(frame != pixels(&path.join("out/job-exact.0005.png")));
        // Alone a frame has the same bytes.
        make(path, &["-o", "alone", "--frame", "3"]);
        let [one, other] = ["out", "alone"].map(|name| path.join(name).join("job-exact.0003.png"));
        assert!(fs::read(one).unwrap() == fs::read(other).unwrap());
    }
}

#[test]
fn a_turntable_turns_once_about_its_axis() {
    let folder = folder(r#""turntable": { "frames": 4, "about": [0, 0, 0] }"#);
    let path = folder.path();
    make(path, &["-o", "out"]);
    assert_eq!(files(&path.join("out")).len(), 4);
    make(path, &["-o", "still", "--still"]);
    let at = |name: &str| pixels(&path.join(name));
    assert!(at("out/job-exact.0001.png") == at("still/job-exact.png"));
    // Half a turn: the camera is behind. The rod looks the same from there, and the checks have the same pattern
    // after half a turn; the light does not turn.
    make(path, &["-o", "behind", "--still", "-D", "scene.camera.eye=[0, 1, -6]"]);
    let (turned, behind) = (at("out/job-exact.0003.png"), at("behind/job-exact.png"));
    for (a, b) in turned.iter().zip(behind.iter()) {
        // The turned camera is rounded.
        assert!(a.abs_diff(*b) <= 2, "{a} {b}");
    }
}

/// Frames of the same inputs are kept, whichever run made them, and frames of other inputs are made again.
#[test]
fn complete_frames_are_kept() {
    let folder = folder(r#""turntable": { "frames": 3 }"#);
    let path = folder.path();
    let out = path.join("out");
    make(path, &["-o", "out", "--threads", "1"]);
    let (first, before) = (files(&out), times(&out));
    let told = make(path, &["-o", "out", "--threads", "2"]);
    assert_eq!(told.matches("kept").count(), 3, "{told}");
    assert_eq!(times(&out), before);
    // A frame that is cut off or gone is made again, and is the same.
    let frame = out.join("job-exact.0002.png");
    fs::write(&frame, &first["job-exact.0002.png"][..200]).unwrap();
    fs::remove_file(out.join("job-exact.0003.png")).unwrap();
    let told = make(path, &["-o", "out"]);
    assert_eq!(told.matches("kept").count(), 1, "{told}");
    assert!(files(&out) == first);
    // Flags, values and each of the inputs change the digest.
    assert!(!make(path, &["-o", "out", "--again"]).contains("kept"));
    assert!(!make(path, &["-o", "out", "-D", "scene.ambient=0.31"]).contains("kept"));
    assert!(!make(path, &["-o", "out"]).contains("kept"));
    fs::write(path.join("parts/rod.json"), SPEC.replace(".5 .2", ".5 .3")).unwrap();
    assert!(!make(path, &["-o", "out"]).contains("kept"));
    RgbImage::new(2, 2).save(path.join("parts/checks.png")).unwrap();
    assert!(!make(path, &["-o", "out"]).contains("kept"));
    assert_eq!(make(path, &["-o", "out"]).matches("kept").count(), 3);
    // Two runs of the same frames at once do no harm.
    let both = "pipeline run jobs/job.json --size 24x18 -q -o both & pipeline run jobs/job.json --size 24x18 -q -o both && wait";
    let ran = shell(both, path);
    assert!(ran.status.success(), "{}", said(&ran));
    assert!(files(&path.join("both")) == files(&out));
}

#[test]
fn a_film_has_the_frames() {
    let folder = folder(r#""turntable": { "frames": 3, "fps": 10 }"#);
    let path = folder.path();
    make(path, &["-o", "out", "--film", "film.png", "-q"]);
    let decoder = image::codecs::png::PngDecoder::new(
        fs::File::open(path.join("film.png")).map(std::io::BufReader::new).unwrap(),
    );
    use image::AnimationDecoder;
    let frames = decoder.unwrap().apng().unwrap().into_frames().collect_frames().unwrap();
    assert_eq!(frames.len(), 3);
    for (k, frame) in frames.into_iter().enumerate() {
        let delay = std::time::Duration::from(frame.delay());
        assert_eq!(delay, std::time::Duration::from_millis(100));
        let own = pixels(&path.join(format!("out/job-exact.000{}.png", k + 1)));
        let shown = image::DynamicImage::ImageRgba8(frame.into_buffer()).to_rgb8();
        assert!(own == shown, "{k}");
    }
    let before = times(&path.join("out"));
    make(path, &["-o", "out", "--film", "film.gif", "-q"]);
    assert!(fs::read(path.join("film.gif")).unwrap().starts_with(b"GIF89a"));
    assert_eq!(times(&path.join("out")), before, "the frames were complete");
}

#[test]
fn mistakes_are_named() {
    for (keys, flags, code, parts) in [
        (
            "\"title\": \"a\"",
            &["--frames", "1"][..],
            2,
            ["job job has no animation", "add \"animate\""],
        ),
        (
            r#""turntable": { "frames": 3 }"#,
            &["--frames", "2-4"],
            2,
            ["found frame 4", "at most 3"],
        ),
        (r#""turntable": { "frames": 3 }"#, &["--frames", "x"], 2, ["'x'", "expected frames"]),
        (
            r#""turntable": { "frames": 3 }"#,
            &["--film", "a.jpg"],
            2,
            ["--film a.jpg", "ends in .png"],
        ),
        (
            r#""turntable": {}, "modes": [ { "name": "a" }, { "name": "b" } ]"#,
            &["--film", "a.gif"],
            2,
            ["has a, b", "add --mode"],
        ),
        (r#""turntabel": {}"#, &[], 3, ["jobs/job.json:2:", "did you mean `turntable`?"]),
        (
            r#""animate": { "frames": 2, "set": { "scene.camera.eyee": [1, 2, 3] } }"#,
            &[],
            3,
            ["parts/scene.json", "did you mean `eye`?"],
        ),
        (
            r#""animate": { "frames": 2, "set": { "scene.camera.eye": 3 } }"#,
            &[],
            3,
            ["parts/scene.json", "camera.eye"],
        ),
        (
            r#""animate": { "frames": 2, "set": { "specs.rood.mesh.rows": 3 } }"#,
            &[],
            3,
            ["jobs/job.json:2:", "(did you mean `rod`?)"],
        ),
    ] {
        let folder = folder(keys);
        let arguments = [&["run", "jobs/job.json", "-o", "out", "--size", "8x6"], flags].concat();
        let ran = run("pipeline", &arguments, folder.path());
        let said = said(&ran);
        assert_eq!(ran.status.code(), Some(code), "{keys} {flags:?}: {said}");
        for part in parts {
            assert!(said.contains(part), "{keys}: `{part}` in: {said}");
        }
    }
}

/// Returns a window of an EXR file, from the bytes of its header: the first column and row, and the last ones.
fn window(bytes: &[u8], name: &str) -> [i32; 4] {
    let key = format!("{name}\0box2i\0");
    let at = bytes.windows(key.len()).position(|own| own == key.as_bytes()).unwrap();
    // The size of the value stands before it.
    let value = &bytes[at + key.len() + 4..];
    [0, 1, 2, 3].map(|k| i32::from_le_bytes(value[4 * k..4 * k + 4].try_into().unwrap()))
}

/// Tiles of a picture, joined, are the file of the whole picture.
#[test]
fn tiles_join_to_the_whole_picture() {
    let folder = folder("\"title\": \"a\"");
    let path = folder.path();
    let obj = "sweep parts/rod.json | triangulate > rod.obj";
    assert!(shell(obj, path).status.success());
    for (name, flags) in [
        ("a.png", ""),
        ("b.png", "--bits 16 --alpha"),
        ("c.exr", "--layers normal,depth,uv,object,footprint,rays"),
        ("d.exr", "--alpha --samples 2 --gamma 2"),
    ] {
        let (stem, end) = name.split_once('.').unwrap();
        let line = format!(
            "r='render parts/scene.json --mesh rod=rod.obj --size 33x29 -q {flags}'\n\
             $r -o {name} && for k in 1 2 3; do $r --tile $k/3 -o {stem}-$k.{end} || exit 9; done\n\
             pipeline join {stem}-3.{end} {stem}-1.{end} {stem}-2.{end} -o {stem}-all.{end}"
        );
        let ran = shell(&line, path);
        assert!(ran.status.success(), "{name}: {}", said(&ran));
        let read = |name: String| fs::read(path.join(name)).unwrap();
        assert!(read(name.into()) == read(format!("{stem}-all.{end}")), "{name}");
    }
    // Data windows of bands and of the whole, as their headers state them. Corners belong to a window.
    let bands = [[0, 0, 32, 8], [0, 9, 32, 18], [0, 19, 32, 28]];
    let whole = [0, 0, 32, 28];
    for (file, data) in [("c-1", bands[0]), ("c-2", bands[1]), ("c-3", bands[2]), ("c-all", whole)]
    {
        let bytes = fs::read(path.join(format!("{file}.exr"))).unwrap();
        let windows = ["dataWindow", "displayWindow"].map(|name| window(&bytes, name));
        assert_eq!(windows, [data, whole], "{file}");
    }
    let crop =
        ["--size", "33x29", "--crop", "5,7,11x13", "--mesh", "rod=rod.obj", "-q", "-o", "e.exr"];
    let ran = run("render", &[&["parts/scene.json"], &crop[..]].concat(), path);
    assert!(ran.status.success(), "{}", said(&ran));
    let bytes = fs::read(path.join("e.exr")).unwrap();
    let windows = ["dataWindow", "displayWindow"].map(|name| window(&bytes, name));
    assert_eq!(windows, [[5, 7, 15, 19], whole]);
    let ran = run("pipeline", &["join", "a-1.png", "a-3.png", "-o", "x.png"], path);
    assert_eq!(ran.status.code(), Some(2));
    assert!(said(&ran).contains("the parts leave out"), "{}", said(&ran));
    let ran =
        run("render", &["parts/scene.json", "--size", "4x2", "--tile", "1/3", "-o", "x.png"], path);
    assert_eq!(ran.status.code(), Some(2));
    assert!(said(&ran).contains("ask for at most 2 parts") && !path.join("x.png").exists());
}

/// A packed job makes the same pictures in another place.
#[test]
fn a_packed_job_makes_the_same_pictures() {
    let folder = folder(r#""turntable": { "frames": 2 }"#);
    let path = folder.path();
    make(path, &["-o", "out", "-q"]);
    let ran = run("pipeline", &["pack", "jobs/job.json", "-o", "packed"], path);
    assert!(ran.status.success(), "{}", said(&ran));
    for name in ["jobs/job.json", "parts/scene.json", "parts/rod.json", "parts/checks.png"] {
        assert_eq!(
            fs::read(path.join("packed").join(name)).unwrap(),
            fs::read(path.join(name)).unwrap()
        );
    }
    let elsewhere = tempfile::tempdir().unwrap();
    let there = elsewhere.path().join("there");
    fs::rename(path.join("packed"), &there).unwrap_or_else(|_| {
        // Another file system.
        assert!(shell(&format!("cp -r packed {}", there.display()), path).status.success());
    });
    make(&there, &["-o", "out", "-q"]);
    assert!(files(&path.join("out")) == files(&there.join("out")));
    let absolute =
        SCENE.replace("checks.png", &path.join("parts/checks.png").display().to_string());
    fs::write(path.join("parts/scene.json"), absolute).unwrap();
    let ran = run("pipeline", &["pack", "jobs/job.json", "-o", "again"], path);
    assert_eq!(ran.status.code(), Some(3), "{}", said(&ran));
    assert!(said(&ran).contains("is named by a path from the root"), "{}", said(&ran));
}
