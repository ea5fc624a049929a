//! Detects a standard output that was closed when the program started, as in `sweep spec.json >&-`.
//!
//! Rust's runtime opens `/dev/null` in place of a standard stream that is closed, before any code of
//! ours runs. Data written there is lost without an error. The replacement differs from the
//! `> /dev/null` of a shell: the runtime opens for reading and writing, a shell for writing.
//!
//! Some launchers also open `/dev/null` for both on purpose (Python's `DEVNULL`, the `ignore` of
//! Node). So the processes that started this one are examined, nearest first. Standard output was
//! closed if a parent has none itself, or if a parent is a shell with another one: a shell that
//! redirects opens for writing only. A parent with the same `/dev/null` handed down its own, so its
//! own parent is examined next.
//!
//! Limits: the answer is read from `/proc`, so it is always no on a system without `/proc`, such as
//! any but Linux. It is also no if a launcher that is not a shell closed standard output, because
//! this case looks like `DEVNULL`.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::os::unix::process::parent_id;

/// Programs that start others with the redirections of a command line.
const SHELLS: [&str; 11] =
    ["sh", "bash", "dash", "ash", "busybox", "zsh", "ksh", "mksh", "fish", "csh", "tcsh"];

/// Most ancestors examined.
const DEEPEST: usize = 64;

/// The standard output of a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stdout {
    /// The process has no such descriptor.
    None,
    /// `/dev/null`, open for reading and writing.
    NullBoth,
    /// Anything else.
    Other,
    /// The system does not report the descriptor.
    Unknown,
}

/// A process that started this one, or that started such a process.
#[derive(Debug, Clone)]
struct Ancestor {
    stdout: Stdout,
    name: String,
}

/// Returns true if standard output was closed when the program started.
pub(crate) fn was_closed() -> bool {
    stdout_of("self") == Stdout::NullBoth && closed_by(ancestors().take(DEEPEST))
}

/// Returns true if one of these processes, the nearest first, left this one without standard
/// output.
fn closed_by(ancestors: impl Iterator<Item = Ancestor>) -> bool {
    for ancestor in ancestors {
        match ancestor.stdout {
            Stdout::None => return true,
            Stdout::NullBoth => {}
            Stdout::Other => return SHELLS.contains(&ancestor.name.as_str()),
            Stdout::Unknown => return false,
        }
    }
    false
}

/// Lists the processes that started this one, the nearest first.
fn ancestors() -> impl Iterator<Item = Ancestor> {
    let parent = |pid: &u32| parent_of(*pid);
    std::iter::successors(Some(parent_id()), parent).filter(|pid| *pid > 0).map(|pid| {
        let name = fs::read_to_string(format!("/proc/{pid}/comm")).unwrap_or_default();
        Ancestor { stdout: stdout_of(&pid.to_string()), name: name.trim_end().into() }
    })
}

fn parent_of(pid: u32) -> Option<u32> {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    let parent = status.lines().find_map(|line| line.strip_prefix("PPid:"))?;
    parent.trim().parse().ok().filter(|parent| *parent > 0)
}

fn stdout_of(process: &str) -> Stdout {
    let target = match fs::read_link(format!("/proc/{process}/fd/1")) {
        Ok(target) => OsString::from(target),
        // A process that has ended has no descriptors either, which proves nothing.
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let there = fs::metadata(format!("/proc/{process}/fd")).is_ok();
            return if there { Stdout::None } else { Stdout::Unknown };
        }
        Err(_) => return Stdout::Unknown,
    };
    if target != "/dev/null" {
        return Stdout::Other;
    }
    match fs::read_to_string(format!("/proc/{process}/fdinfo/1")).ok().and_then(|i| access(&i)) {
        Some(2) => Stdout::NullBoth,
        Some(_) => Stdout::Other,
        None => Stdout::Unknown,
    }
}

/// Returns the access mode of a descriptor from its page in `fdinfo`: 0 for reading, 1 for writing,
/// 2 for both.
fn access(info: &str) -> Option<u32> {
    let flags = info.lines().find_map(|line| line.strip_prefix("flags:"))?;
    Some(u32::from_str_radix(flags.trim(), 8).ok()? & 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(ancestors: &[(Stdout, &str)]) -> bool {
        let ancestor = |&(stdout, name): &(Stdout, &str)| Ancestor { stdout, name: name.into() };
        closed_by(ancestors.iter().map(ancestor))
    }

    #[test]
    fn a_shell_or_a_parent_without_one_closed_standard_output() {
        use Stdout::{None, NullBoth, Other, Unknown};
        assert!(closed(&[(Other, "bash")]));
        assert!(closed(&[(None, "timeout"), (Other, "bash")]));
        // The runtime also replaces the standard output of `cargo run`, which hands it down.
        assert!(closed(&[(NullBoth, "cargo"), (Other, "zsh")]));
        // Python's DEVNULL, also through a shell that it starts.
        assert!(!closed(&[(Other, "python3"), (Other, "bash")]));
        assert!(!closed(&[(NullBoth, "sh"), (Other, "python3")]));
        assert!(!closed(&[(Unknown, "sudo"), (Other, "bash")]));
        assert!(!closed(&[]));
    }

    #[test]
    fn the_access_of_a_descriptor_is_read_from_its_flags() {
        assert_eq!(access("pos:\t0\nflags:\t0100002\nmnt_id:\t24\n"), Some(2));
        assert_eq!(access("pos:\t0\nflags:\t0100001\n"), Some(1));
        assert_eq!(access("pos:\t0\n"), None);
    }
}
