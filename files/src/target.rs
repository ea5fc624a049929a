//! What an output's argument names: standard output, a device, or a file to be replaced.

use crate::FileError;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What an argument names.
#[derive(Debug)]
pub(crate) enum Target {
    /// `-`, standard output.
    Stdout,
    /// Anything that is there and is not a regular file.
    Device(PathBuf),
    /// A file, links followed, and what is known of the one that it replaces.
    File {
        /// Its path.
        path: PathBuf,
        /// The file that is there.
        replaced: Option<fs::Metadata>,
    },
}

impl Target {
    /// Looks at what is there. A link stands for the file that it leads to.
    ///
    /// # Errors
    /// When it is a folder, a link that leads to nothing, read-only, or a file that exists where
    /// `clobber` is false; when it is a standard output that was closed.
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
            // A file without a path, as some of /proc are, cannot be replaced by a rename.
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

/// How messages name an output.
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
