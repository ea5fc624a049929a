//! Programs that are killed at random moments. Every file is the complete old or the complete new
//! one, inputs are unchanged, and a mixture of old and new files is announced.
//!
//! Each program is killed 40 times, or as often as the environment variable `TOPOBOOK_KILLS`
//! states. The moments depend on a seed, `TOPOBOOK_KILL_SEED` or 1, which is printed. Half of the
//! moments are anywhere in a run. The other half follow the first appearance of the marker, since
//! files are replaced in a small part of a run.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::print_stdout, reason = "the seed and the counts are what a run is for")]

use crate::support::{programs, root};
use fixtures::Dice;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::{sleep, yield_now};
use std::time::{Duration, Instant};

/// A run of a program and the files that it replaces.
struct Case {
    line: &'static [&'static str],
    targets: &'static [&'static str],
    marker: &'static str,
}

const CASES: [Case; 4] = [
    Case {
        line: &["sweep", "spec.json", "-q", "-o", "a.grid", "--preview", "a.svg"],
        targets: &["a.grid", "a.svg"],
        marker: "a.grid.incomplete",
    },
    Case {
        line: &["triangulate", "in.grid", "-q", "-o", "a.obj", "--mtl", "--report", "a.json"],
        targets: &["a.obj", "a.mtl", "a.json"],
        marker: "a.obj.incomplete",
    },
    Case {
        line: &["render", "scene.json", "-q", "--size", "40x30", "-o", "a.png"],
        targets: &["a.png"],
        marker: "a.png.incomplete",
    },
    Case {
        line: &["pipeline", "run", "job.json", "-q", "--keep", "--size", "24x18", "-o", "."],
        targets: &[
            "job-rod.grid",
            "job-rod.obj",
            "job-point.png",
            "job-box.png",
            "job-tent.png",
            "job.png",
        ],
        marker: "job.incomplete",
    },
];

const SPEC: &str = r#"{ "format": "tb-sweep", "version": 1, "name": "rod",
"contour": { "circle": 1 }, "trajectory": { "line": [[0, 0, 0], [0, 0, 3]] },
"mesh": { "rows": 30, "cols": 24 } }"#;

const SCENE: &str = r#"{ "format": "tb-scene", "version": 1,
"camera": { "eye": [0, 3, 9], "target": [0, 0, 0], "fov_deg": 40 }, "ambient": 0.5,
"textures": { "checks": { "image": "checks.png" } }, "materials": { "plain": {} },
"objects": [ { "sphere": { "center": [0, 0, 0], "radius": 2, "material": "plain",
                           "texture": "checks" } },
             { "mesh": { "name": "rod", "file": "in.obj", "material": "plain" } } ] }"#;

const JOB: &str = r#"{ "format": "tb-job", "version": 1, "scene": "scene.json",
"meshes": { "rod": { "spec": "spec.json" } },
"modes": [ { "name": "point", "filter": "point" }, { "name": "box", "filter": "box" },
           { "name": "tent", "filter": "tent" } ] }"#;

const INPUTS: [&str; 6] =
    ["spec.json", "scene.json", "job.json", "checks.png", "in.grid", "in.obj"];

fn start(line: &[&str], folder: &Path) -> Child {
    let mut command = Command::new(programs().join(line[0]));
    command.args(&line[1..]).current_dir(folder);
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

fn finish(line: &[&str], folder: &Path) {
    assert!(start(line, folder).wait().unwrap().success(), "{line:?}");
}

fn inputs(folder: &Path) {
    fs::write(folder.join("spec.json"), SPEC).unwrap();
    fs::write(folder.join("scene.json"), SCENE).unwrap();
    fs::write(folder.join("job.json"), JOB).unwrap();
    let checks = root().join("examples/textures/checkerboard.png");
    fs::copy(checks, folder.join("checks.png")).unwrap();
    finish(&["sweep", "spec.json", "-o", "in.grid"], folder);
    finish(&["triangulate", "in.grid", "-o", "in.obj"], folder);
}

/// Returns a number from the environment, or `default`.
fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Numbers of kills by the state of the files afterwards.
#[derive(Debug, Default)]
struct Counts {
    all_old: usize,
    all_new: usize,
    mixed: usize,
    marked: usize,
    ended_before: usize,
    temporaries: usize,
}

#[test]
fn a_killed_program_leaves_whole_files_and_announces_a_mix() {
    let (kills, seed) = (setting("TOPOBOOK_KILLS", 40), setting("TOPOBOOK_KILL_SEED", 1));
    println!("{kills} kills of each program, TOPOBOOK_KILL_SEED={seed}");
    let mut dice = Dice::new(seed);
    let mut up_to = |longest: Duration| longest.mul_f64(dice.fraction());
    for Case { line, targets, marker } in CASES {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| -> PathBuf { folder.path().join(name) };
        let read = |name: &str| fs::read(path(name)).unwrap();
        inputs(folder.path());
        let before: Vec<Vec<u8>> = INPUTS.iter().map(|name| read(name)).collect();
        let started = Instant::now();
        finish(line, folder.path());
        let takes = started.elapsed();
        let new: Vec<Vec<u8>> = targets.iter().map(|name| read(name)).collect();
        let mut counts = Counts::default();
        for kill in 0..kills {
            targets.iter().for_each(|name| fs::write(path(name), format!("old {name}")).unwrap());
            let _ = fs::remove_file(path(marker));
            let mut child = start(line, folder.path());
            if kill % 2 == 0 || targets.len() == 1 {
                sleep(up_to(takes));
            } else {
                while !path(marker).exists() && child.try_wait().unwrap().is_none() {
                    yield_now();
                }
                sleep(up_to(takes / 4));
            }
            counts.ended_before += usize::from(child.try_wait().unwrap().is_some());
            child.kill().unwrap();
            child.wait().unwrap();

            let is_new: Vec<bool> = targets
                .iter()
                .zip(&new)
                .map(|(name, new)| {
                    let found = read(name);
                    let old = format!("old {name}").into_bytes();
                    assert!(found == *new || found == old, "kill {kill}: {name} is torn");
                    found == *new
                })
                .collect();
            let mixed = is_new.contains(&true) && is_new.contains(&false);
            let marked = path(marker).exists();
            assert!(marked || !mixed, "kill {kill}: {is_new:?} of {targets:?} without {marker}");
            counts.mixed += usize::from(mixed);
            counts.marked += usize::from(marked);
            counts.all_new += usize::from(!is_new.contains(&false));
            counts.all_old += usize::from(!is_new.contains(&true));
            for (name, before) in INPUTS.iter().zip(&before) {
                assert!(read(name) == *before, "kill {kill}: the input {name} has changed");
            }
            if kill % 10 == 9 {
                finish(line, folder.path());
                assert!(targets.iter().zip(&new).all(|(name, new)| read(name) == *new));
                assert!(!path(marker).exists(), "kill {kill}: a whole run leaves no marker");
            }
        }
        let left = fs::read_dir(folder.path()).unwrap();
        let left = left.filter(|entry| {
            let name = entry.as_ref().unwrap().file_name().into_string().unwrap();
            name.starts_with('.') && name.ends_with(".part")
        });
        counts.temporaries = left.count();
        println!("{}: {counts:?}", line[0]);
    }
}
