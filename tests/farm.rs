//! Scripts for make and GNU parallel, run by the real programs, and the parts of pictures as tasks. Where a program is
//! missing, its test says so.
#![cfg(unix)]

use crate::support::animated::{files, folder, make};
use crate::support::{run, said, shell};

/// The makefile makes all frames and the film, also in several runs; where there is no make, the test says so.
#[test]
fn a_makefile_makes_the_frames_and_the_film() {
    let folder = folder(r#""turntable": { "frames": 5 }"#);
    let path = folder.path();
    let flags =
        ["--engine", "make", "--chunk", "2", "--size", "24x18", "--film", "film.gif", "-o", "out"];
    let arguments = [&["farm", "jobs/job.json", "--script", "tasks.mk"], &flags[..]].concat();
    let ran = run("pipeline", &arguments, path);
    assert!(ran.status.success(), "{}", said(&ran));
    if !shell("make --version", path).status.success() {
        println!("skipped: make is not installed");
        return;
    }
    let ran = shell("make -s -j 2 -f tasks.mk && make -s -f tasks.mk", path);
    assert!(ran.status.success(), "{}", said(&ran));
    make(path, &["-o", "alone", "-q"]);
    assert!(files(&path.join("out")) == files(&path.join("alone")));
    assert!(path.join("film.gif").exists());
}

/// GNU parallel makes the same frames, also again after one is lost; where there is no parallel, the test says so.
#[test]
fn parallel_makes_the_frames_and_the_film() {
    let folder = folder(r#""turntable": { "frames": 5 }"#);
    let path = folder.path();
    let flags = ["--chunk", "2", "--size", "24x18", "--film", "film.gif", "-o", "out"];
    let start = ["farm", "jobs/job.json", "--engine", "parallel", "--script", "tasks.sh"];
    let ran = run("pipeline", &[&start[..], &flags].concat(), path);
    assert!(ran.status.success(), "{}", said(&ran));
    if !shell("parallel --version | grep -q GNU", path).status.success() {
        println!("skipped: GNU parallel is not installed");
        return;
    }
    let ran = shell("sh tasks.sh && rm out/job-exact.0002.png && sh tasks.sh", path);
    assert!(ran.status.success(), "{}", said(&ran));
    make(path, &["-o", "alone", "-q"]);
    assert!(files(&path.join("out")) == files(&path.join("alone")));
    assert!(path.join("film.gif").exists());
}

/// Parts as tasks: joined pictures have the bytes of pictures that are made at once, of frames and of a job without an
/// animation.
#[test]
fn parts_of_pictures_are_tasks() {
    let modes =
        r#""modes": [ { "name": "a" }, { "name": "b", "filter": "tent", "sampling": "thesis" } ]"#;
    for (engine, run_it) in [("make", "make -s -j 2 -f tasks"), ("parallel", "sh tasks")] {
        if !shell(&format!("{engine} --version"), &std::env::temp_dir()).status.success() {
            println!("skipped: {engine} is not installed");
            continue;
        }
        for (keys, film) in [
            (
                r#""turntable": { "frames": 3 }"#.to_string(),
                &["--film", "film.gif", "--chunk", "2"][..],
            ),
            (modes.to_string(), &[]),
        ] {
            let folder = folder(&keys);
            let path = folder.path();
            let start = ["farm", "jobs/job.json", "--engine", engine, "--script", "tasks"];
            let flags = ["--tiles", "3", "--size", "24x18", "-o", "out"];
            let ran = run("pipeline", &[&start[..], &flags, film].concat(), path);
            assert!(ran.status.success(), "{}", said(&ran));
            let ran = shell(run_it, path);
            assert!(ran.status.success(), "{engine}: {}", said(&ran));
            make(path, &["-o", "alone", "-q"]);
            let (mut all, alone) = (files(&path.join("out")), files(&path.join("alone")));
            let parts = all.keys().filter(|name| name.contains("-of-3")).count();
            let wholes = if film.is_empty() { 2 } else { 3 };
            assert_eq!(parts, 3 * wholes, "{engine}: {:?}", all.keys());
            all.retain(|name, _| !name.contains("-of-3"));
            // A job of several modes has a picture of all beside them, which is made only at once.
            let alone: std::collections::BTreeMap<_, _> =
                alone.into_iter().filter(|(name, _)| name != "job.png").collect();
            assert_eq!(all.keys().collect::<Vec<_>>(), alone.keys().collect::<Vec<_>>());
            assert!(all == alone, "{engine}");
            assert_eq!(path.join("film.gif").exists(), !film.is_empty());
            // A frame that is whole needs no part. Other pictures do not state their inputs.
            if !film.is_empty() {
                assert!(shell("rm out/*-of-3.png", path).status.success());
                make(path, &["-o", "out", "--tile", "2/3", "-q"]);
                assert_eq!(files(&path.join("out")).len(), wholes);
            }
        }
    }
}

/// A join makes the parts that are missing, and parts of other inputs are no parts of it.
#[test]
fn a_join_makes_what_is_missing() {
    let folder = folder(r#""turntable": { "frames": 2 }"#);
    let path = folder.path();
    make(path, &["-o", "out", "--tile", "1/2", "-D", "scene.ambient=0.9", "-q"]);
    make(path, &["-o", "out", "--tile", "2/2", "-q"]);
    let told = make(path, &["-o", "out", "--join", "2"]);
    assert_eq!(told.matches("kept").count(), 2, "the second part of each frame: {told}");
    make(path, &["-o", "alone", "-q"]);
    let mut all = files(&path.join("out"));
    all.retain(|name, _| !name.contains("-of-2"));
    assert!(all == files(&path.join("alone")));
    for (flags, code, part) in [
        (&["--tile", "1/19"][..], 2, "found 19 parts for pictures of 18 rows"),
        (&["--tile", "3/2"], 2, "expected K/N with K from 1 to N"),
        (&["--tile", "1/2", "--join", "2"], 2, "cannot be used with"),
    ] {
        let all = [&["run", "jobs/job.json", "--size", "24x18", "-o", "x"], flags].concat();
        let ran = run("pipeline", &all, path);
        assert_eq!(ran.status.code(), Some(code), "{}", said(&ran));
        assert!(said(&ran).contains(part), "{}", said(&ran));
    }
    let ran = run(
        "pipeline",
        &["farm", "jobs/job.json", "--engine", "make", "--still", "--tiles", "1"],
        path,
    );
    assert_eq!(ran.status.code(), Some(2));
    assert!(said(&ran).contains("add --tiles N to divide each"), "{}", said(&ran));
}

/// Parts of a picture with a requested error: each reaches it, and so does the whole.
#[test]
fn parts_share_a_requested_error() {
    let folder = folder("\"title\": \"a\"");
    let path = folder.path();
    let error = 0.02;
    let flags = ["--error", "0.02", "--size", "48x36", "-q"];
    let made = |more: &[&str]| {
        let all = [&["run", "jobs/job.json"], &flags[..], more].concat();
        let ran = run("pipeline", &all, path);
        assert!(ran.status.success(), "{more:?}: {}", said(&ran));
    };
    made(&["-o", "out", "--tile", "1/3"]);
    made(&["-o", "out", "--join", "3"]);
    let whole = files(&path.join("out")).into_keys().filter(|name| !name.contains("-of-3"));
    let whole: Vec<String> = whole.collect();
    assert_eq!(whole.len(), 1, "{whole:?}");
    // Against a picture of a much smaller error.
    let ran = run(
        "pipeline",
        &["run", "jobs/job.json", "--error", "0.002", "--size", "48x36", "-o", "fine", "-q"],
        path,
    );
    assert!(ran.status.success(), "{}", said(&ran));
    let [own, fine] = ["out", "fine"].map(|folder| format!("{folder}/{}", whole[0]));
    let limit = format!("{}", error + 0.002);
    let ran = run("pipeline", &["compare", &own, &fine, "--rmse", &limit], path);
    assert!(ran.status.success(), "{}", said(&ran));
    // A second join of these parts leaves the joined picture as it is.
    let before = files(&path.join("out"));
    made(&["-o", "out", "--join", "3"]);
    assert!(before == files(&path.join("out")));
}
