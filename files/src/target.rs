//! Finds what an output's argument names: standard output, a device, or a file to be replaced.

use crate::FileError;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The target of an output's argument.
#[derive(Debug)]
pub(crate) enum Target {
    /// Standard output, named `-`.
    Stdout,
    /// An existing path that is not a regular file.
    Device(PathBuf),
    /// A regular file, with links followed.
    File {
        /// The path of the file.
        path: PathBuf,
        /// Metadata of the existing file at this path, if any.
        replaced: Option<fs::Metadata>,
    },
}

impl Target {
    /// Finds the target of an argument. A link stands for the file that it leads to.
    ///
    /// # Errors
    /// When the target is a folder, a link that leads to nothing, a read-only file, an existing file
    /// while `clobber` is false, or a standard output that was closed.
    pub(crate) fn of(argument: &Path, clobber: bool) -> Result<Self, FileError> {
        let refused = |source| FileError::Write { name: name_of(argument), source };
        if argument.as_os_str() == "-" {
            if stdout_was_closed() {
                return Err(refused(io::Error::other("it was closed when the program started")));
            }
            return Ok(Self::Stdout);
        }
        let resolved = fs::canonicalize(argument);
        let path = resolved.as_deref().unwrap_or(argument);
        let replaced = fs::metadata(path).ok();
        match &replaced {
            Some(found) if found.is_dir() => Err(refused(io::ErrorKind::IsADirectory.into())),
            // A file without a path, such as some in /proc, cannot be replaced by a rename.
            Some(found) if !found.is_file() || resolved.is_err() => Ok(Self::Device(path.into())),
            Some(_) if !clobber => Err(FileError::Exists { name: name_of(argument) }),
            Some(found) if found.permissions().readonly() => {
                Err(refused(io::ErrorKind::PermissionDenied.into()))
            }
            None if fs::symlink_metadata(path).is_ok_and(|found| found.is_symlink()) => {
                let leads = fs::read_link(path).unwrap_or_default();
                Err(refused(io::Error::other(format!(
                    "it is a link to {}, where no file is: make one there or remove the link",
                    leads.display()
                ))))
            }
            _ => Ok(Self::File { path: path.into(), replaced }),
        }
    }
}

/// Returns the name of an output in messages.
pub(crate) fn name_of(argument: &Path) -> String {
    if argument.as_os_str() == "-" { "<stdout>".into() } else { argument.display().to_string() }
}

#[cfg(target_os = "linux")]
fn stdout_was_closed() -> bool {
    crate::stdout::was_closed()
}

#[cfg(not(target_os = "linux"))]
fn stdout_was_closed() -> bool {
    false
}
