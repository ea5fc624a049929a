//! Bytes from a file, from standard input, or from files built into the program.

use crate::FileError;
use std::fmt::Debug;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

/// The name under which standard input appears in messages.
pub const STDIN: &str = "<stdin>";

/// A place that holds files under paths.
pub trait Source: Debug + Sync {
    /// The whole file at `path`.
    ///
    /// # Errors
    /// When there is no such file or it cannot be read.
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError>;
}

/// The file system; relative paths count from the working folder.
#[derive(Debug, Clone, Copy)]
pub struct Disk;

impl Source for Disk {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        std::fs::read(path).map_err(|source| read_error(path, source))
    }
}

/// Files built into the program, each with its path.
#[derive(Clone, Copy)]
pub struct Embedded(pub &'static [(&'static str, &'static [u8])]);

impl Debug for Embedded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.0.iter().map(|(path, _)| path)).finish()
    }
}

impl Source for Embedded {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let wanted = normalized(path);
        self.0
            .iter()
            .find(|(name, _)| Path::new(name) == wanted)
            .map(|(_, bytes)| bytes.to_vec())
            .ok_or_else(|| read_error(path, io::ErrorKind::NotFound.into()))
    }
}

/// The whole of the file named on a command line; `-` is standard input.
///
/// # Errors
/// When it cannot be read.
pub(crate) fn read(argument: &Path) -> Result<Vec<u8>, FileError> {
    if !is_stdin(argument) {
        return Disk.read(argument);
    }
    let mut bytes = Vec::new();
    io::stdin()
        .lock()
        .read_to_end(&mut bytes)
        .map_err(|source| FileError::Read { name: STDIN.into(), source })?;
    Ok(bytes)
}

/// The file named on a command line as a buffered reader; `-` is standard input.
///
/// # Errors
/// When it cannot be opened.
pub(crate) fn open(argument: &Path) -> Result<Box<dyn io::BufRead>, FileError> {
    if is_stdin(argument) {
        return Ok(Box::new(io::stdin().lock()));
    }
    let file = std::fs::File::open(argument).map_err(|source| read_error(argument, source))?;
    Ok(Box::new(io::BufReader::with_capacity(1 << 16, file)))
}

/// True for `-`, which names standard input on a command line.
#[must_use]
pub fn is_stdin(argument: &Path) -> bool {
    argument.as_os_str() == "-"
}

/// How messages name the file of a command line: as the user wrote it, or `<stdin>`.
#[must_use]
pub fn name_of(argument: &Path) -> String {
    if is_stdin(argument) { STDIN.into() } else { argument.display().to_string() }
}

fn read_error(path: &Path, source: io::Error) -> FileError {
    FileError::Read { name: path.display().to_string(), source }
}

/// The path without `.` and with each `..` taken against the name before it.
#[must_use]
pub fn normalized(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir if result.file_name().is_some() => {
                result.pop();
            }
            other => result.push(other),
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn embedded_files_are_found_by_relative_paths() {
        let pages = Embedded(&[("examples/textures/a.png", b"png")]);
        let path = Path::new("examples/scenes/../textures/./a.png");
        assert_eq!(pages.read(path).unwrap(), b"png");
        let missing = pages.read(Path::new("examples/b.png")).unwrap_err().to_string();
        assert!(missing.starts_with("cannot read examples/b.png"), "{missing}");
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = read(Path::new("no/such/file.json")).unwrap_err();
        assert!(error.to_string().contains("no/such/file.json"), "{error}");
    }
}
