//! Completions for shells, and pages for `man`: `render completions bash`, `render man`.
//!
//! Both are made of the arguments that clap reads, so that they are never out of date. They are answered before the
//! other arguments are read, since `render` and its companions take a file as their first argument. A file that is called
//! `man` or `completions` is named `./man`.

use crate::{FileError, Output, exit};
use clap::{Command, ValueEnum};
use clap_complete::Shell;
use clap_mangen::Man;
use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

/// A request in the first argument of a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Request {
    Completions(Shell),
    Man,
}

/// Prints the completions or the page that the arguments of the process request, and returns the exit code. Returns
/// `None` if they request neither.
#[must_use]
pub fn answer(command: Command) -> Option<ExitCode> {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    let request = request(&arguments)?;
    let name = command.get_name().to_string();
    Some(exit::run(&name, || Ok(print(request, command)?)))
}

/// Returns what the arguments request. `completions` without a known shell is an error that clap reports.
fn request(arguments: &[OsString]) -> Option<Request> {
    let words: Vec<&str> = arguments.iter().map(|word| word.to_str()).collect::<Option<_>>()?;
    match words.as_slice() {
        ["man"] => Some(Request::Man),
        ["completions", shell] => Shell::from_str(shell, true).ok().map(Request::Completions),
        _ => None,
    }
}

fn print(request: Request, mut command: Command) -> Result<(), FileError> {
    let mut bytes = Vec::new();
    let mut output = Output::create(Path::new("-"), true)?;
    match request {
        Request::Completions(shell) => {
            let name = command.get_name().to_string();
            clap_complete::generate(shell, &mut command, name, &mut bytes);
        }
        Request::Man => {
            Man::new(command).render(&mut bytes).map_err(|source| output.failed(source))?;
        }
    }
    std::io::Write::write_all(&mut output, &bytes).map_err(|source| output.failed(source))?;
    output.commit()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(words: &[&str]) -> Vec<OsString> {
        words.iter().map(Into::into).collect()
    }

    #[test]
    fn only_whole_requests_are_answered() {
        assert_eq!(request(&words(&["man"])), Some(Request::Man));
        let bash = Some(Request::Completions(Shell::Bash));
        assert_eq!(request(&words(&["completions", "bash"])), bash);
        for other in
            [&[][..], &["./man"], &["man", "-o"], &["completions"], &["completions", "dos"]]
        {
            assert_eq!(request(&words(other)), None, "{other:?}");
        }
    }
}
