//! Ctrl-C while a picture is rendered.

#![cfg(target_os = "linux")]

use crate::bench;

use bench::{Bench, WALL};
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::Command;
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
        let mut child = bench.command(&arguments).spawn().unwrap();
        std::io::Write::write_all(&mut child.stdin.take().unwrap(), WALL.as_bytes()).unwrap();
        let tasks = format!("/proc/{}/task", child.id());
        while fs::read_dir(&tasks).unwrap().count() < threads {
            assert!(child.try_wait().unwrap().is_none(), "the program is at work");
            yield_now();
        }
        let kill = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        assert!(kill.success());
        let ended = child.wait_with_output().unwrap();
        assert_eq!(ended.status.signal(), Some(number), "as a shell sees it: 128 + {number}");
        assert_eq!(bench.read("out.png"), b"old");
        assert_eq!(bench.names().len(), 2, "nothing is left beside it: {:?}", bench.names());
    }
}
