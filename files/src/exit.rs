//! Ends a program: its exit code, and the one line that a failed program prints.

use crate::{stop, words};
use std::error::Error;
use std::fmt::Display;
use std::io::{self, Write};
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

/// The exit codes of all four programs. 0 is success.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Two compared pictures differ by more than was allowed. `diff` has the same code for files
    /// that differ.
    Differ = 1,
    /// Bad use of the command line; clap ends with the same code.
    Use = 2,
    /// An input is malformed: JSON, grid, OBJ or picture.
    Malformed = 3,
    /// The requested geometry does not exist: a degenerate curve, a trajectory with a corner.
    Geometry = 4,
    /// A file could not be read or written.
    ReadWrite = 5,
    /// A limit on memory, threads or numbering was met.
    Resource = 6,
    /// A picture was written, and its requested error was not reached.
    Inaccurate = 7,
    /// A bug of ours.
    Bug = 70,
    /// The reader of our standard output closed it. No message is printed.
    ClosedPipe = 141,
}

/// An error that determines the exit code of its program.
pub trait Failure: Error {
    /// Returns the exit code of a program that fails with this error.
    fn exit(&self) -> Exit;
}

/// Any [`Failure`], so that `?` works in the programs.
#[derive(Debug)]
pub struct Report(Box<dyn Failure>);

impl Report {
    /// Returns the exit code of a program that fails with this report.
    #[must_use]
    pub fn exit(&self) -> Exit {
        self.0.exit()
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

impl<E: Failure + 'static> From<E> for Report {
    fn from(error: E) -> Self {
        Self(Box::new(error))
    }
}

/// Does a program's work, prints its error if there is one, and returns its exit code.
///
/// A signal that ends the program leaves no temporary files ([`crate::stop`]).
///
/// A panic is a bug of ours: the program ends with [`Exit::Bug`] and asks the user to report the
/// bug.
#[must_use]
pub fn run(program: &str, work: impl FnOnce() -> Result<(), Report>) -> ExitCode {
    stop::clean_up_when_stopped();
    let exit = match panic::catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => return ExitCode::SUCCESS,
        Ok(Err(report)) => {
            if report.exit() != Exit::ClosedPipe {
                say(one_line(&format!("{program}: {report}")));
            }
            report.exit()
        }
        Err(_) => {
            say(format!("{program}: this is a bug in {program}; please report it with the input"));
            Exit::Bug
        }
    };
    ExitCode::from(exit as u8)
}

/// Prints words for people on standard error, and a newline. Characters that would steer a terminal
/// are spelled out ([`words::printed`]); line ends are kept.
///
/// Words that cannot be printed are lost, and the program continues: these words are not its
/// result.
pub fn say(words: impl Display) {
    // One write, so that programs that share a terminal do not mix their lines.
    let text = words::printed(&format!("{words}\n")).into_owned();
    let _ = io::stderr().write_all(text.as_bytes());
}

/// Prints the line about a picture or another file that was written: `wrote x.png (512 x 512, 1.2 s)`. `size` is the
/// size of a picture in pixels.
pub fn wrote(path: &Path, size: Option<(u32, u32)>, time: Duration) {
    let size = size.map_or_else(String::new, |(width, height)| format!("{width} x {height}"));
    wrote_about(path, &size, time);
}

/// Prints the line about a file that was written, with words about its content: `wrote book.html (28 pages, 62.0 s)`.
pub fn wrote_about(path: &Path, content: &str, time: Duration) {
    let seconds = time.as_secs_f64();
    let comma = if content.is_empty() { "" } else { ", " };
    let path = path.to_string_lossy();
    say(format_args!("wrote {} ({content}{comma}{seconds:.1} s)", words::shown(&path)));
}

/// Returns a message on one line of bounded length, whatever the message quotes.
///
/// Messages quote names and keys from files, which may hold newlines, commands to a terminal, and
/// megabytes.
fn one_line(text: &str) -> String {
    words::line(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_stays_on_its_line() {
        assert_eq!(one_line("key `a\nb\u{1b}[2J`: Väse"), "key `a\\nb\\u{1b}[2J`: Väse");
    }

    #[test]
    fn a_message_is_not_as_long_as_what_it_quotes() {
        let line = one_line(&format!("found {}, expected less", "x".repeat(100_000)));
        assert!(line.starts_with("found xxx") && line.ends_with(", expected less"), "{line}");
        assert!(line.len() < 1000, "{}", line.len());
    }
}
