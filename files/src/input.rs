//! Reads bytes from a file, from standard input, or from files built into the program.
//!
//! Files must be regular ones: a named pipe could block for ever, and a device need not end. Only
//! `-` may be a pipe or a device. Bytes are counted in the memory budget of the process while they
//! are read, so a file without an end is refused.

use crate::json::BYTES_OF_A_BYTE;
use crate::memory::{self, Budget};
use crate::{FileError, words};
use std::fmt::Debug;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

/// The name under which standard input appears in messages.
pub const STDIN: &str = "<stdin>";

/// A collection of files under paths.
pub trait Source: Debug + Sync {
    /// Returns the bytes of the whole file at `path`.
    ///
    /// # Errors
    /// When there is no such file or it cannot be read.
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError>;

    /// Returns the whole JSON file at `path`, if there is memory for its parsed values.
    ///
    /// # Errors
    /// See [`Source::read`]; also when the memory budget of the process is too small.
    fn read_json(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        room_for_values(self.read(path)?, || shown(path))
    }

    /// Returns the only file whose path differs from `path` in the case of its name alone. Returns `None`
    /// if there are several or none, or if this collection does not list its files.
    fn same_but_case(&self, path: &Path) -> Option<PathBuf> {
        let _ = path;
        None
    }
}

/// The file system. Relative paths are resolved from the working folder.
#[derive(Debug, Clone, Copy)]
pub struct Disk;

impl Source for Disk {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let (file, length) = regular(path)?;
        whole(file, length, memory::of_process(), || shown(path))
    }

    fn same_but_case(&self, path: &Path) -> Option<PathBuf> {
        let wanted = path.file_name()?.to_str()?.to_lowercase();
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let names = std::fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?;
        let names = names.filter_map(|entry| Some(entry.ok()?.file_name()));
        let same = |name: &std::ffi::OsString| {
            Some(name.as_os_str()) != path.file_name()
                && name.to_str().is_some_and(|name| name.to_lowercase() == wanted)
        };
        let mut found = names.filter(same);
        let (first, second) = (found.next()?, found.next());
        second.is_none().then(|| path.with_file_name(first))
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

/// Reads the whole file that an argument names; `-` is standard input.
///
/// # Errors
/// When the file cannot be read.
pub(crate) fn read(argument: &Path) -> Result<Vec<u8>, FileError> {
    if !is_stdin(argument) {
        return Disk.read(argument);
    }
    whole(io::stdin().lock(), 0, memory::of_process(), || STDIN.into())
}

/// Reads the whole JSON file that an argument names, if there is memory for its parsed values; `-`
/// is standard input.
///
/// # Errors
/// When the file cannot be read, and when the memory budget of the process is too small.
pub(crate) fn read_json(argument: &Path) -> Result<Vec<u8>, FileError> {
    room_for_values(read(argument)?, || name_of(argument))
}

/// Returns the text of a JSON file, if there is memory for its parsed values. `name` is the file's name in messages.
///
/// # Errors
/// When the memory budget of the process is too small.
pub fn room_for_values(text: Vec<u8>, name: impl Fn() -> String) -> Result<Vec<u8>, FileError> {
    let bytes = BYTES_OF_A_BYTE.saturating_mul(text.len() as u64);
    memory::of_process().check(bytes, || format!("{}: its values", name()))?;
    Ok(text)
}

/// Opens the file that an argument names as a buffered reader; `-` is standard input.
///
/// # Errors
/// When the file cannot be opened.
pub(crate) fn open(argument: &Path) -> Result<Box<dyn io::BufRead>, FileError> {
    if is_stdin(argument) {
        return Ok(Box::new(io::stdin().lock()));
    }
    let (file, _) = regular(argument)?;
    Ok(Box::new(io::BufReader::with_capacity(1 << 16, file)))
}

/// Returns true for `-`, which names standard input on a command line.
#[must_use]
pub fn is_stdin(argument: &Path) -> bool {
    argument.as_os_str() == "-"
}

/// Returns the name of an argument's file in messages: the user's spelling, or `<stdin>`.
#[must_use]
pub fn name_of(argument: &Path) -> String {
    if is_stdin(argument) { STDIN.into() } else { shown(argument) }
}

/// Returns a path in the form that messages show.
fn shown(path: &Path) -> String {
    words::shown(&path.to_string_lossy()).to_string()
}

fn read_error(path: &Path, source: io::Error) -> FileError {
    FileError::Read { name: shown(path), source }
}

/// Opens the regular file at `path`, and returns its length in bytes too. The kind of the file is
/// checked first, since opening a pipe waits for its other end.
fn regular(path: &Path) -> Result<(File, u64), FileError> {
    let failed = |source| read_error(path, source);
    let look = |found: std::fs::Metadata| match kind(&found) {
        None => Ok(found.len()),
        Some(found) => Err(FileError::NotRegular { name: shown(path), found }),
    };
    look(std::fs::metadata(path).map_err(failed)?)?;
    let file = File::open(path).map_err(failed)?;
    // Another file may have taken the name since the first check.
    let length = look(file.metadata().map_err(failed)?)?;
    Ok((file, length))
}

/// Names the kind of file that a path leads to, unless the file is a regular one.
fn kind(found: &std::fs::Metadata) -> Option<&'static str> {
    if found.is_file() {
        return None;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if found.file_type().is_fifo() {
            return Some("a pipe");
        }
        if found.file_type().is_socket() {
            return Some("a socket");
        }
    }
    Some(if found.is_dir() { "a folder" } else { "a device" })
}

/// Reads all bytes of `input`, which are about `length`. Memory is reserved before it is allocated,
/// and only for bytes that arrived.
fn whole(
    mut input: impl Read,
    length: u64,
    budget: &Budget,
    name: impl Fn() -> String,
) -> Result<Vec<u8>, FileError> {
    let what = || format!("reading {}", name());
    // One byte more than expected, so that the end of the file is seen without another step.
    let mut step = match usize::try_from(length) {
        Ok(0) => STEP,
        length => length.unwrap_or(usize::MAX).saturating_add(1),
    };
    let mut reserved = budget.reserve(0, what)?;
    let mut bytes = Vec::new();
    loop {
        reserved.grow(step as u64, what)?;
        bytes.reserve(step);
        let read = input.by_ref().take(step as u64).read_to_end(&mut bytes);
        let read = read.map_err(|source| FileError::Read { name: name(), source })?;
        if read < step {
            return Ok(bytes);
        }
        step = bytes.len().max(STEP);
    }
}

/// Number of bytes that are read first when the length is not known.
const STEP: usize = 1 << 16;

/// Returns the path without `.`, and with each `..` cancelled against the name before it.
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

    #[test]
    fn a_folder_is_said_to_be_one() {
        let error = Disk.read(Path::new("src")).unwrap_err().to_string();
        assert_eq!(
            error,
            "cannot read src: it is a folder, expected a regular file (only - may be a pipe)"
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_device_that_never_ends_is_refused_before_it_is_read() {
        for read in [Disk.read(Path::new("/dev/zero")), read(Path::new("/dev/zero"))] {
            let error = read.unwrap_err().to_string();
            assert!(
                error.starts_with("cannot read /dev/zero: it is a device, expected a regular"),
                "{error}"
            );
        }
        assert!(open(Path::new("/dev/zero")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_named_pipe_is_refused_before_it_is_opened() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
        assert!(made.success());
        // A link leads to the pipe as well.
        let link = folder.path().join("link");
        std::os::unix::fs::symlink(&pipe, &link).unwrap();
        for path in [pipe, link] {
            for error in [Disk.read(&path).unwrap_err(), open(&path).err().unwrap()] {
                assert!(
                    error.to_string().contains(": it is a pipe, expected a regular"),
                    "{error}"
                );
            }
        }
    }

    #[test]
    fn a_stream_without_an_end_is_refused_by_the_budget() {
        let budget = Budget::new(1 << 20);
        let error = whole(io::repeat(0), 0, &budget, || "<stdin>".into()).unwrap_err();
        assert!(error.to_string().starts_with("reading <stdin> needs "), "{error}");
        assert_eq!(crate::Failure::exit(&error), crate::Exit::Resource);
        assert_eq!(budget.left(), 1 << 20);
    }

    #[test]
    fn a_file_longer_than_the_budget_is_refused_before_it_is_read() {
        struct Unread;
        impl Read for Unread {
            fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
                unreachable!("it is too long")
            }
        }
        let error = whole(Unread, 1 << 40, &Budget::new(1 << 30), || "a.obj".into()).unwrap_err();
        assert!(error.to_string().starts_with("reading a.obj needs 1024.0 GB"), "{error}");
    }

    #[test]
    fn all_bytes_come_whatever_length_was_announced() {
        let bytes: Vec<u8> = (0..300_000u32).map(|k| k as u8).collect();
        for length in [0, 7, 299_999, 300_000, 300_001, 1 << 20] {
            let read = whole(&bytes[..], length, &Budget::new(1 << 30), String::new).unwrap();
            assert_eq!(read, bytes, "{length}");
        }
    }
}
