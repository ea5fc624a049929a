//! Ctrl-C while a file is written.

#![cfg(unix)]

use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Stdio};
use std::thread::yield_now;

#[test]
fn ctrl_c_removes_the_temporary_file_and_leaves_the_old_one() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("out.obj");
    fs::write(&output, "old").unwrap();
    let names = || -> Vec<String> {
        let entries = fs::read_dir(folder.path()).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    };
    for (signal, number) in [("-INT", 2), ("-TERM", 15)] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_triangulate"))
            .arg("-")
            .arg("-o")
            .arg(&output)
            .stdin(Stdio::piped())
            .spawn()
            .unwrap();
        // Waiting for the program would close its input. The end of an empty grid would then race
        // the signal.
        let _stdin = child.stdin.take();
        // The program opens its output and waits for a grid that does not come.
        while !names().iter().any(|name| name.ends_with(".part")) {
            assert!(child.try_wait().unwrap().is_none(), "the program waits for a grid");
            yield_now();
        }
        assert_eq!(names().len(), 2, "{:?}", names());
        let kill = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        assert!(kill.success());
        assert_eq!(child.wait().unwrap().signal(), Some(number));
        assert_eq!(names(), ["out.obj"]);
        assert_eq!(fs::read(&output).unwrap(), b"old");
    }
}
