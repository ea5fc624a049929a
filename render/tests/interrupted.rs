//! Ctrl-C while a picture is rendered.

#![cfg(target_os = "linux")]

use crate::bench;

use bench::{Bench, WALL};
use fixtures::program::ending;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Output};
use std::thread::yield_now;

#[test]
fn ctrl_c_in_the_middle_of_a_picture_leaves_the_old_one() {
    for (signal, number) in [("-INT", 2), ("-TERM", 15)] {
        let bench = Bench::with_scene(WALL);
        bench.write("out.png", "old");
        // The picture takes minutes. The program starts its threads after it has read the scene.
        let threads = 8;
        let size = ["--size", "4096x4096", "--samples", "64", "--threads", "8"];
        let arguments = [&["-", "-o", "out.png"], &size[..]].concat();
        let ended = interrupted(&bench, &arguments, threads, signal);
        assert_eq!(ended.status.signal(), Some(number), "as a shell sees it: 128 + {number}");
        assert_eq!(bench.read("out.png"), b"old");
        assert_eq!(bench.names().len(), 2, "nothing is left beside it: {:?}", bench.names());
    }
}

/// With --partial the picture so far replaces the old one, and its error is stated.
#[test]
fn a_partial_picture_is_written_on_request_with_its_error() {
    let long = ["--size", "2048x2048", "--samples", "64", "--split", "none"];
    let requested = ["--size", "2048x2048", "--error", "0.001"];
    for flags in [&long[..], &requested] {
        let bench = Bench::with_scene(WALL);
        bench.write("out.png", "old");
        let arguments = [&["-", "-o", "out.png", "--partial", "--threads", "8"], flags].concat();
        let ended = interrupted(&bench, &arguments, 8, "-INT");
        let (_, words) = ending(&ended);
        assert_eq!(ended.status.signal(), Some(2), "{words}");
        let picture = image::load_from_memory(&bench.read("out.png")).unwrap();
        assert_eq!((picture.width(), picture.height()), (2048, 2048));
        assert!(words.contains(" pixels are not finished\n"), "{words}");
        let last = words.lines().last().unwrap();
        assert!(last.starts_with("error ") && last.contains("with 95 % confidence"), "{words}");
    }
}

/// Starts the program, which must work for long, and sends it a signal once its threads are there.
fn interrupted(bench: &Bench, arguments: &[&str], threads: usize, signal: &str) -> Output {
    let mut child = bench.command(arguments).spawn().unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), WALL.as_bytes()).unwrap();
    let tasks = format!("/proc/{}/task", child.id());
    while fs::read_dir(&tasks).unwrap().count() < threads {
        assert!(child.try_wait().unwrap().is_none(), "the program is at work");
        yield_now();
    }
    let kill = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(kill.success());
    child.wait_with_output().unwrap()
}
