//! What happens when a program is told to stop: Ctrl-C, or a signal to end.
//!
//! A signal ends a program where it stands, and its temporary files would stay. So a thread waits
//! for the three signals that ask a program to end; it removes the temporaries that are open, and
//! then lets the signal do what it does, so that whoever started the program sees that it was
//! interrupted (a shell says 130 for Ctrl-C) and not that it failed.
//!
//! Which temporaries are open is the one thing that a whole process shares: signals come to a
//! process. A temporary is made and entered, or removed and struck out, under one lock, which the
//! thread takes and never gives back; nothing comes to be while it works.
//!
//! A file that outgrows the limit of the system (`ulimit -f`) would end a program by SIGXFSZ as it
//! stands. The signal is caught and nothing is done about it, so that the write fails with an error
//! that the program reports.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

static OPEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn open() -> MutexGuard<'static, Vec<PathBuf>> {
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file's place on the list; off it when dropped, which must be after the file is gone.
#[derive(Debug)]
pub(crate) struct Entry(PathBuf);

impl Entry {
    /// Makes a temporary file and enters it, which `path` tells.
    pub(crate) fn of<T>(
        make: impl FnOnce() -> io::Result<T>,
        path: impl Fn(&T) -> &Path,
    ) -> io::Result<(T, Self)> {
        let mut open = open();
        let made = make()?;
        let entry = Self(path(&made).to_path_buf());
        open.push(entry.0.clone());
        Ok((made, entry))
    }
}

impl Drop for Entry {
    fn drop(&mut self) {
        open().retain(|path| *path != self.0);
    }
}

/// From now on a signal that ends the program removes its temporary files first.
///
/// Where there are no such signals, or no thread can be had, nothing changes: a temporary may then
/// stay, and the file that it was to replace is whole in any case.
pub fn clean_up_when_stopped() {
    #[cfg(unix)]
    {
        // Caught, the signal leaves the write to fail. What the handler sets, nobody reads.
        let caught = std::sync::Arc::default();
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, caught);
        let Ok(mut signals) = signal_hook::iterator::Signals::new(signals()) else { return };
        let wait = move || {
            if let Some(signal) = signals.forever().next() {
                let open = open();
                for path in open.iter() {
                    // One that is renamed already is not there any more.
                    let _ = std::fs::remove_file(path);
                }
                let _ = signal_hook::low_level::emulate_default_handler(signal);
            }
        };
        let _ = std::thread::Builder::new().name("signals".into()).spawn(wait);
    }
}

/// The signals that would end the program: not those that it was started to ignore, as SIGHUP
/// under `nohup`. Only Linux says which those are; elsewhere SIGHUP is left as it is.
#[cfg(unix)]
fn signals() -> Vec<i32> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let ignored = std::fs::read_to_string("/proc/self/status").ok().and_then(|status| {
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
        u64::from_str_radix(mask.trim(), 16).ok()
    });
    match ignored {
        None => vec![SIGINT, SIGTERM],
        Some(mask) => {
            let ends = |signal: &i32| mask >> (signal - 1) & 1 == 0;
            [SIGINT, SIGTERM, SIGHUP].into_iter().filter(ends).collect()
        }
    }
}
