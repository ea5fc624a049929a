//! Identifies the file that a path leads to, independent of the path.
//!
//! On Unix a file is identified by its device and its inode number. Symbolic links, hard links, `.` and
//! `..`, and either case of letters lead to the same pair. On other systems a file is identified by its
//! canonical path, which differs between hard links.

use std::ffi::OsString;
use std::fs::{self, Metadata};
use std::io;
use std::path::Path;

/// An identifier that is equal for two paths to the same file.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) enum Identity {
    /// A regular file that exists.
    There(Number),
    /// A name in a folder, whether or not a file of that name exists.
    Name {
        /// The folder.
        folder: Number,
        /// The name.
        name: OsString,
    },
}

/// Identifies a file or a folder: by device and inode number on Unix, by canonical path elsewhere.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Number(#[cfg(unix)] (u64, u64), #[cfg(not(unix))] std::path::PathBuf);

impl Identity {
    /// Returns the identifiers of a path, with links followed. The first is that of the file, if it
    /// exists. The second is that of the file's name, which stays valid when the file is replaced. The
    /// list is empty for a folder, a device or a pipe.
    pub(crate) fn keys(path: &Path) -> Vec<Self> {
        let there = match fs::metadata(path) {
            Ok(found) if found.is_file() => number(path, &found),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            _ => return Vec::new(),
        };
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let (folder, name) = (folder_of(&path), path.file_name());
        let folder = fs::metadata(folder).ok().and_then(|found| number(folder, &found));
        let named = folder.zip(name).map(|(folder, name)| Self::Name { folder, name: name.into() });
        there.map(Self::There).into_iter().chain(named).collect()
    }

    /// Returns the file that standard input is read from, if it is a regular file.
    pub(crate) fn of_stdin() -> Option<Self> {
        #[cfg(unix)]
        return of_descriptor(std::os::fd::AsFd::as_fd(&io::stdin()));
        #[cfg(not(unix))]
        None
    }

    /// Returns the file that standard output is written to, if it is a regular file.
    pub(crate) fn of_stdout() -> Option<Self> {
        #[cfg(unix)]
        return of_descriptor(std::os::fd::AsFd::as_fd(&io::stdout()));
        #[cfg(not(unix))]
        None
    }
}

/// Returns the folder that a path lies in, `.` for a bare name.
pub(crate) fn folder_of(path: &Path) -> &Path {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// Returns true if the file system treats `a` and `A` as one name in this folder, and also if this
/// cannot be tested.
pub(crate) fn folds_case(folder: &Path) -> bool {
    let trial = tempfile::Builder::new().prefix(".case-").suffix(".part").tempfile_in(folder);
    let Ok(trial) = trial else { return true };
    let name = trial.path().file_name().unwrap_or_default().to_string_lossy();
    folder.join(name.to_uppercase()).exists()
}

#[cfg(unix)]
fn number(_: &Path, found: &Metadata) -> Option<Number> {
    use std::os::unix::fs::MetadataExt;
    Some(Number((found.dev(), found.ino())))
}

#[cfg(not(unix))]
fn number(path: &Path, _: &Metadata) -> Option<Number> {
    fs::canonicalize(path).ok().map(Number)
}

#[cfg(unix)]
fn of_descriptor(descriptor: std::os::fd::BorrowedFd<'_>) -> Option<Identity> {
    let file = fs::File::from(descriptor.try_clone_to_owned().ok()?);
    let found = file.metadata().ok().filter(Metadata::is_file)?;
    number(Path::new(""), &found).map(Identity::There)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_the_same_by_every_path() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("a"), "").unwrap();
        fs::write(path("b"), "").unwrap();
        let a = Identity::keys(&path("a"));
        assert_eq!(Identity::keys(&path("./a")), a);
        assert!(Identity::keys(&path("b")).iter().all(|key| !a.contains(key)));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(path("a"), path("link")).unwrap();
            fs::hard_link(path("a"), path("hard")).unwrap();
            assert_eq!(Identity::keys(&path("link")), a);
            assert!(Identity::keys(&path("hard")).iter().any(|key| a.contains(key)));
        }
    }

    #[test]
    fn a_file_that_is_not_there_is_a_name_in_a_folder() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("sub")).unwrap();
        let new = Identity::keys(&path("new"));
        assert_eq!((new.len(), Identity::keys(&path("sub/../new"))), (1, new.clone()));
        assert_ne!(Identity::keys(&path("sub/new")), new);
        fs::write(path("new"), "").unwrap();
        assert!(Identity::keys(&path("new")).contains(&new[0]), "its name stays");
        for nothing in ["none/new", "sub"] {
            assert_eq!(Identity::keys(&path(nothing)), []);
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn case_is_kept_apart_where_the_file_system_does() {
        let folder = tempfile::tempdir().unwrap();
        assert!(!folds_case(folder.path()));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "the trial is removed");
    }
}
