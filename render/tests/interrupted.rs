//! Ctrl-C in the middle of a picture.

#![cfg(unix)]

use crate::bench;

use bench::{Bench, WALL};
use std::os::unix::process::ExitStatusExt;
use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

#[test]
fn ctrl_c_in_the_middle_of_a_picture_leaves_the_old_one() {
    for (signal, number) in [("-INT", 2), ("-TERM", 15)] {
        let bench = Bench::with_scene(WALL);
        bench.write("out.png", "old");
        // Minutes of work; the scene is read when standard input is closed.
        let arguments = ["-", "-o", "out.png", "--size", "4096x4096", "--samples", "64"];
        let mut child = bench.command(&arguments).spawn().unwrap();
        std::io::Write::write_all(&mut child.stdin.take().unwrap(), WALL.as_bytes()).unwrap();
        sleep(Duration::from_millis(200));
        assert!(child.try_wait().unwrap().is_none(), "it is at work");
        let kill = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        assert!(kill.success());
        let ended = child.wait_with_output().unwrap();
        assert_eq!(ended.status.signal(), Some(number), "as a shell sees it: 128 + {number}");
        assert_eq!(bench.read("out.png"), b"old");
        assert_eq!(bench.names().len(), 2, "nothing is left beside it: {:?}", bench.names());
    }
}
