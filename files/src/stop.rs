//! Removes temporary files when a signal ends a program, such as that of Ctrl-C.
//!
//! A signal ends a program at once, and the program's temporary files would stay. So a thread waits
//! for the three signals that ask a program to end. The thread removes the open temporaries, and
//! then lets the signal have its usual effect. So the parent process sees that the program was
//! interrupted (a shell says 130 for Ctrl-C) and not that it failed.
//!
//! The list of open temporaries belongs to the whole process, since signals come to a process. One
//! lock guards the creation of a temporary with its entry, and the removal of an entry. The thread
//! takes the lock and never releases it, so no temporary is created while the thread works.
//!
//! A file that outgrows the limit of the system (`ulimit -f`) would end a program by SIGXFSZ at
//! once. The signal is caught and ignored, so the write fails with an error that the program
//! reports.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// True while the next signal is held back.
static HOLDS: AtomicBool = AtomicBool::new(false);

/// The signal that was held back, or 0.
static HELD: AtomicI32 = AtomicI32::new(0);

static OPEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn open() -> MutexGuard<'static, Vec<PathBuf>> {
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The entry of a temporary file in the list. The entry leaves the list when dropped, which must
/// happen after the file is gone.
#[derive(Debug)]
pub(crate) struct Entry(PathBuf);

impl Entry {
    /// Makes a temporary file and enters its path in the list. `path` returns the path of the file.
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

/// Makes every signal that ends the program remove its temporary files first.
///
/// On a system without such signals, or when no thread can start, nothing changes. A temporary may
/// then stay, and the file that it was to replace is complete in any case.
pub fn clean_up_when_stopped() {
    #[cfg(unix)]
    {
        // The caught signal leaves the write to fail. The flag that the handler sets is never read.
        let caught = std::sync::Arc::default();
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, caught);
        let Ok(mut signals) = signal_hook::iterator::Signals::new(signals()) else { return };
        let wait = move || {
            for signal in signals.forever() {
                if HOLDS.swap(false, Ordering::SeqCst) {
                    HELD.store(signal, Ordering::SeqCst);
                    continue;
                }
                let open = open();
                for path in open.iter() {
                    // A temporary that was already renamed no longer exists.
                    let _ = std::fs::remove_file(path);
                }
                let _ = signal_hook::low_level::emulate_default_handler(signal);
            }
        };
        let _ = std::thread::Builder::new().name("signals".into()).spawn(wait);
    }
}

/// Holds the next signal back, so that the program can save what it has. The program asks
/// [`is_stopped`], and calls [`end_if_stopped`] when it is done. A second signal has its usual effect at
/// once.
///
/// On a system without signals, nothing changes.
pub fn hold_next() {
    HOLDS.store(true, Ordering::SeqCst);
}

/// Returns whether a signal was held back.
#[must_use]
pub fn is_stopped() -> bool {
    HELD.load(Ordering::SeqCst) != 0
}

/// Lets a signal that was held back have its usual effect, which ends the program.
pub fn end_if_stopped() {
    HOLDS.store(false, Ordering::SeqCst);
    #[cfg(unix)]
    match HELD.load(Ordering::SeqCst) {
        0 => {}
        signal => {
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    }
}

/// Returns the signals that would end the program. Signals that the program was started to ignore,
/// such as SIGHUP under `nohup`, are omitted. Only Linux reports the ignored signals; on other
/// systems SIGHUP is left unchanged.
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
