//! An output that replaces its file only when it is whole.
//!
//! The bytes go to a temporary file beside the target, which is renamed over it by
//! [`Output::commit`]. A program that fails, or is told to stop, leaves the old file as it was.
//! Standard output (`-`), and targets that are not regular files (`/dev/null`, `/dev/full`, a
//! named pipe), are written directly.

use crate::FileError;
use crate::stop::Entry;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Bytes gathered before they are written.
const BUFFER: usize = 1 << 16;

/// A file to be replaced, or standard output.
#[derive(Debug)]
pub struct Output {
    name: String,
    sink: Sink,
}

#[derive(Debug)]
enum Sink {
    Stdout(BufWriter<io::Stdout>),
    Device(BufWriter<File>),
    /// The entry comes last, so that it outlives the temporary.
    Replace {
        temporary: BufWriter<NamedTempFile>,
        target: PathBuf,
        clobber: bool,
        entry: Entry,
    },
}

impl Output {
    /// Opens the output named on a command line; `-` is standard output. Nothing is replaced yet.
    ///
    /// # Errors
    /// When the folder cannot be written, or when the file exists and `clobber` is false.
    pub fn create(argument: &Path, clobber: bool) -> Result<Self, FileError> {
        let name = name_of(argument);
        let failed = |source| write_error(name.clone(), source);
        let sink = match Target::of(argument, clobber)? {
            Target::Stdout => Sink::Stdout(BufWriter::with_capacity(BUFFER, io::stdout())),
            Target::Device(path) => {
                let device = File::options().write(true).open(path).map_err(failed)?;
                Sink::Device(BufWriter::with_capacity(BUFFER, device))
            }
            Target::File { path, replaced } => {
                let (temporary, entry) = create_beside(&path, replaced.as_ref()).map_err(failed)?;
                let temporary = BufWriter::with_capacity(BUFFER, temporary);
                Sink::Replace { temporary, target: path, clobber, entry }
            }
        };
        Ok(Self { name, sink })
    }

    /// Finds out whether [`Output::create`] would succeed, before long work whose result it will
    /// take; leaves nothing behind if the program is stopped meanwhile.
    ///
    /// # Errors
    /// As [`Output::create`].
    pub fn check(argument: &Path, clobber: bool) -> Result<(), FileError> {
        match Target::of(argument, clobber)? {
            // A named pipe must be opened once only.
            Target::Stdout | Target::Device(_) => Ok(()),
            Target::File { path, replaced } => create_beside(&path, replaced.as_ref())
                .map(drop)
                .map_err(|source| write_error(name_of(argument), source)),
        }
    }

    /// Makes what was written the content of the file.
    ///
    /// # Errors
    /// When the last bytes cannot be written or the file cannot be replaced; the old file stays.
    pub fn commit(self) -> Result<(), FileError> {
        let name = self.name;
        match self.sink {
            Sink::Stdout(mut stdout) => stdout.flush().map_err(|source| write_error(name, source)),
            Sink::Device(mut device) => device.flush().map_err(|source| write_error(name, source)),
            Sink::Replace { temporary, target, clobber, entry: _entry } => {
                let temporary = match temporary.into_inner() {
                    Ok(file) => file,
                    Err(failed) => return Err(write_error(name, failed.into_error())),
                };
                let renamed = if clobber {
                    temporary.persist(&target)
                } else {
                    temporary.persist_noclobber(&target)
                };
                renamed.map(drop).map_err(|failed| match failed.error.kind() {
                    // Made by another program since we looked.
                    io::ErrorKind::AlreadyExists if !clobber => FileError::Exists { name },
                    _ => write_error(name, failed.error),
                })
            }
        }
    }

    /// The error to report for a failed write to this output.
    #[must_use]
    pub fn failed(&self, source: io::Error) -> FileError {
        write_error(self.name.clone(), source)
    }

    /// Writes all bytes and makes them the content of the file.
    ///
    /// # Errors
    /// As [`Output::commit`].
    pub fn commit_all(mut self, bytes: &[u8]) -> Result<(), FileError> {
        self.write_all(bytes).map_err(|source| self.failed(source))?;
        self.commit()
    }
}

/// What an argument names.
enum Target {
    Stdout,
    /// Anything that is there and is not a regular file.
    Device(PathBuf),
    /// A file, links followed, and what is known of the one that it replaces.
    File {
        path: PathBuf,
        replaced: Option<fs::Metadata>,
    },
}

impl Target {
    fn of(argument: &Path, clobber: bool) -> Result<Self, FileError> {
        if argument.as_os_str() == "-" {
            return Ok(Self::Stdout);
        }
        let refused = |kind: io::ErrorKind| write_error(name_of(argument), kind.into());
        // A link is followed, so that the file it points at is replaced and not the link.
        let path = fs::canonicalize(argument).unwrap_or_else(|_| argument.to_path_buf());
        let replaced = fs::metadata(&path).ok();
        match &replaced {
            Some(found) if found.is_dir() => Err(refused(io::ErrorKind::IsADirectory)),
            Some(found) if !found.is_file() => Ok(Self::Device(path)),
            Some(_) if !clobber => Err(FileError::Exists { name: name_of(argument) }),
            Some(found) if found.permissions().readonly() => {
                Err(refused(io::ErrorKind::PermissionDenied))
            }
            _ => Ok(Self::File { path, replaced }),
        }
    }
}

fn name_of(argument: &Path) -> String {
    if argument.as_os_str() == "-" { "<stdout>".into() } else { argument.display().to_string() }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.sink {
            Sink::Stdout(stdout) => stdout.write(bytes),
            Sink::Device(device) => device.write(bytes),
            Sink::Replace { temporary, .. } => temporary.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.sink {
            Sink::Stdout(stdout) => stdout.flush(),
            Sink::Device(device) => device.flush(),
            Sink::Replace { temporary, .. } => temporary.flush(),
        }
    }
}

/// A temporary file beside `target` with the permissions of the file it will replace, or those the
/// system gives a new one.
fn create_beside(
    target: &Path,
    replaced: Option<&fs::Metadata>,
) -> io::Result<(NamedTempFile, Entry)> {
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    // tempfile's own complaint about a folder would name the temporary file.
    fs::metadata(folder)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let make = || {
        builder.tempfile_in(folder).map_err(|error| match error.kind() {
            io::ErrorKind::Other => error,
            kind => kind.into(),
        })
    };
    let (temporary, entry) = Entry::of(make, NamedTempFile::path)?;
    if let Some(metadata) = replaced {
        temporary.as_file().set_permissions(metadata.permissions())?;
    }
    Ok((temporary, entry))
}

fn write_error(name: String, source: io::Error) -> FileError {
    if source.kind() == io::ErrorKind::BrokenPipe {
        FileError::ClosedPipe
    } else {
        FileError::Write { name, source }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_old_file_stays_until_commit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let mut output = Output::create(&path, true).unwrap();
        output.write_all(b"new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        drop(output);
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no part file is left");
        Output::create(&path, true).unwrap().commit_all(b"new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    }

    #[test]
    fn no_clobber_refuses_an_existing_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let error = Output::create(&path, false).unwrap_err().to_string();
        assert!(error.contains("--no-clobber"), "{error}");
    }

    #[test]
    fn no_clobber_keeps_a_file_that_was_made_meanwhile() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let output = Output::create(&path, false).unwrap();
        fs::write(&path, "theirs").unwrap();
        let error = output.commit_all(b"ours").unwrap_err().to_string();
        assert!(error.contains("--no-clobber"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "theirs");
    }

    #[cfg(unix)]
    #[test]
    fn no_clobber_lets_a_device_be_written() {
        Output::create(Path::new("/dev/null"), false).unwrap().commit_all(b"gone").unwrap();
    }

    #[test]
    fn a_missing_folder_is_noticed_before_any_work() {
        let error = Output::create(Path::new("no/such/folder/a.png"), true).unwrap_err();
        assert!(error.to_string().starts_with("cannot write no/such/folder/a.png"), "{error}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_device_is_an_error_and_stays_a_device() {
        let output = Output::create(Path::new("/dev/full"), true).unwrap();
        let error = output.commit_all(&[0; 100]).unwrap_err().to_string();
        assert!(error.starts_with("cannot write /dev/full"), "{error}");
        assert!(!fs::metadata("/dev/full").unwrap().is_file());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_followed() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        Output::create(&link, true).unwrap().commit_all(b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
    }
}
