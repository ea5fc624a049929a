//! `--watch`: the picture follows its files.

use crate::bench;

use bench::{Bench, TEXTURED_WALL, WALL};
use std::fs;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Ends the program with the test.
struct Watching(Child);

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Waits until the picture has these bytes. The limit is far above the time that a change takes.
fn wait_for(bench: &Bench, expected: &[u8]) {
    let started = Instant::now();
    while fs::read(bench.path("out.png")).is_ok_and(|bytes| bytes != expected)
        || !bench.path("out.png").exists()
    {
        assert!(started.elapsed() < Duration::from_secs(60), "the picture does not follow");
        sleep(Duration::from_millis(5));
    }
}

fn picture(bench: &Bench) -> Vec<u8> {
    bench.make(&["scene.json", "--size", "16x16", "-o", "alone.png"], b"");
    // The command is part of a picture.
    let bytes = bench.read("alone.png");
    fs::remove_file(bench.path("alone.png")).unwrap();
    bytes
}

/// The scene, then a texture that was missing, then the texture again. A fault is no end.
#[test]
fn a_picture_follows_its_scene_and_its_textures() {
    let bench = Bench::with_scene(WALL);
    let first = picture(&bench);
    let other = Bench::with_scene(TEXTURED_WALL);
    let checks = |color| {
        let checks = image::RgbImage::from_fn(4, 4, |x, y| {
            image::Rgb(if (x + y) % 2 == 0 { color } else { [0, 0, 0] })
        });
        let mut bytes = std::io::Cursor::new(Vec::new());
        checks.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        bytes.into_inner()
    };
    let steps = [[255, 0, 0], [0, 255, 0]].map(|color| {
        other.write("checks.png", checks(color));
        picture(&other)
    });
    let watching = ["scene.json", "--size", "16x16", "-o", "out.png", "--watch", "-q"];
    let _watching = Watching(bench.command(&watching).spawn().unwrap());
    wait_for(&bench, &first);
    bench.write("scene.json", TEXTURED_WALL);
    bench.write("checks.png", checks([255, 0, 0]));
    wait_for(&bench, &steps[0]);
    bench.write("new.png", checks([0, 255, 0]));
    fs::rename(bench.path("new.png"), bench.path("checks.png")).unwrap();
    wait_for(&bench, &steps[1]);
    bench.write("scene.json", "{");
    bench.write("scene.json", WALL);
    wait_for(&bench, &first);
}

#[test]
fn pipes_are_not_watched() {
    let bench = Bench::with_scene(WALL);
    for arguments in [&["-", "-o", "out.png", "--watch"][..], &["scene.json", "-o", "-", "--watch"]]
    {
        let run = bench.run(arguments, WALL.as_bytes());
        assert_eq!(run.status.code(), Some(2));
        let said = fixtures::program::said(&run);
        assert!(said.contains("--watch needs files"), "{said}");
    }
}
