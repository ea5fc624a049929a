//! Repeats the work of a program whenever one of its input files changes.
//!
//! Folders are watched and not files, since many editors replace a file by another one of the same name. The files are
//! those that the last run read or looked for ([`crate::Ledger::inputs`]), so a file that was missing counts as well.

use crate::exit::{Exit, Failure, Report, say};
use crate::{Ledger, stop, words};
use notify::{EventKind, RecursiveMode, Watcher};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant, SystemTime};
use thiserror::Error;

/// Time without a change after which the work starts, so that several saved files cause one run.
const QUIET: Duration = Duration::from_millis(60);

/// The clock of files may lag behind that of programs by this time. It is less than [`QUIET`], so that a change is
/// seen once.
const LAG: Duration = Duration::from_millis(30);

/// Folders cannot be watched.
#[derive(Debug, Error)]
#[error("cannot watch {folder}: {source}; leave out --watch", folder = words::shown(folder))]
pub struct WatchError {
    folder: String,
    source: notify::Error,
}

impl Failure for WatchError {
    fn exit(&self) -> Exit {
        Exit::ReadWrite
    }
}

/// An input comes through a pipe, which does not change.
#[derive(Debug, Error)]
#[error("--watch needs files: {0}")]
pub struct PipeError(pub &'static str);

impl Failure for PipeError {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

/// Does a program's work, and again after each change of a file that it read. Errors of the work are printed, and the
/// program waits for the next change. A signal ends it. `ledger` makes the record of the files of one run.
///
/// Returns an exit code if the files cannot be watched.
#[must_use]
pub fn repeat(
    program: &str,
    ledger: impl Fn() -> Ledger,
    work: impl Fn(&Ledger) -> Result<(), Report>,
) -> ExitCode {
    stop::clean_up_when_stopped();
    loop {
        let started = SystemTime::now();
        let ledger = ledger();
        if let Err(report) = work(&ledger) {
            if report.exit() == Exit::Use {
                return crate::exit::run(program, || Err(report));
            }
            say(words::line(&format!("{program}: {report}")));
        }
        let inputs = ledger.inputs();
        say(format_args!("{program}: waiting for a change of {} files; Ctrl-C ends", inputs.len()));
        if let Err(error) = wait(&inputs, started) {
            return crate::exit::run(program, || Err(error.into()));
        }
    }
}

/// Waits until one of the files is younger than `started`, made or removed.
fn wait(inputs: &[PathBuf], started: SystemTime) -> Result<(), WatchError> {
    let failed =
        |folder: &Path, source| WatchError { folder: folder.display().to_string(), source };
    let (sender, changes) = channel();
    let mut watcher =
        notify::recommended_watcher(sender).map_err(|source| failed(Path::new("files"), source))?;
    let folders: BTreeSet<&Path> = inputs.iter().map(|input| folder_of(input)).collect();
    // A folder that is missing is watched by nothing until its input is read again.
    for folder in folders.into_iter().filter(|folder| folder.is_dir()) {
        watcher
            .watch(folder, RecursiveMode::NonRecursive)
            .map_err(|source| failed(folder, source))?;
    }
    let is_younger = |input: &PathBuf| {
        input.metadata().and_then(|found| found.modified()).is_ok_and(|time| time + LAG > started)
    };
    let names: BTreeSet<_> = inputs.iter().filter_map(|input| input.file_name()).collect();
    let concerns = |change: &notify::Result<notify::Event>| {
        change.as_ref().map_or(true, |event| {
            let is_input =
                |path: &PathBuf| path.file_name().is_some_and(|name| names.contains(name));
            !matches!(event.kind, EventKind::Access(_)) && event.paths.iter().any(is_input)
        })
    };
    if !inputs.iter().any(is_younger) {
        while changes.recv().is_ok_and(|change| !concerns(&change)) {}
    }
    settle(&changes, concerns);
    Ok(())
}

/// Waits until nothing that concerns the work has changed for a moment. Reading of other files is no change.
fn settle<T>(changes: &Receiver<T>, concerns: impl Fn(&T) -> bool) {
    let mut end = Instant::now() + QUIET;
    while let Ok(change) = changes.recv_timeout(end.saturating_duration_since(Instant::now())) {
        if concerns(&change) {
            end = Instant::now() + QUIET;
        }
    }
}

fn folder_of(input: &Path) -> &Path {
    match input.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::thread;

    #[test]
    fn a_file_that_is_replaced_made_or_removed_is_a_change() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("a.json"), "1").unwrap();
        let changes: [&(dyn Fn() + Sync); 4] = [
            &|| fs::write(path("a.json"), "2").unwrap(),
            &|| {
                fs::write(path("new"), "3").unwrap();
                fs::rename(path("new"), path("a.json")).unwrap();
            },
            &|| fs::write(path("missing.png"), "4").unwrap(),
            &|| fs::remove_file(path("a.json")).unwrap(),
        ];
        for change in changes {
            let inputs = [path("a.json"), path("missing.png")];
            thread::scope(|scope| {
                thread::sleep(2 * LAG);
                let waiting = scope.spawn(|| wait(&inputs, SystemTime::now()));
                thread::sleep(Duration::from_millis(50));
                // Another file is no change.
                fs::write(path("other"), "5").unwrap();
                change();
                waiting.join().unwrap().unwrap();
            });
        }
    }

    #[test]
    fn a_file_that_changed_during_the_work_is_a_change() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.json");
        // A file that is written at once may look older than the work.
        let started = SystemTime::now();
        fs::write(&file, "1").unwrap();
        wait(&[file], started).unwrap();
    }
}
