//! An output that replaces its file only when the output is complete.
//!
//! The bytes go to a temporary file beside the target. [`Output::commit`] syncs the temporary file,
//! renames it over the target and syncs the folder. So after a loss of power the target is the old
//! file or the new one. A program that fails, or is stopped, leaves the old file unchanged. A link
//! is followed; a link that leads to no file is refused. Standard output (`-`), and targets that
//! are not regular files (`/dev/null`, `/dev/full`, a named pipe), are written directly.

use crate::FileError;
use crate::identity::folder_of;
use crate::stop::Entry;
use crate::target::{Target, name_of};
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::TempPath;

/// Number of bytes gathered before they are written.
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
    Replace { content: BufWriter<File>, replacement: Replacement },
}

/// A temporary file and its target. The entry is the last field, so that it outlives the file.
#[derive(Debug)]
struct Replacement {
    temporary: TempPath,
    target: PathBuf,
    clobber: bool,
    entry: Entry,
}

/// An output whose bytes are written and, in a file, synced. No file is replaced yet.
#[derive(Debug)]
pub struct Ready {
    name: String,
    replacement: Option<Replacement>,
}

impl Output {
    /// Opens the output that an argument names; `-` is standard output. No file is replaced yet.
    ///
    /// # Errors
    /// When the folder cannot be written, or when the file exists and `clobber` is false. Also when
    /// the argument is a link that leads to no file, and when standard output was closed.
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
                let ((file, temporary), entry) =
                    create_beside(&path, replaced.as_ref()).map_err(failed)?;
                let content = BufWriter::with_capacity(BUFFER, file);
                let replacement = Replacement { temporary, target: path, clobber, entry };
                Sink::Replace { content, replacement }
            }
        };
        Ok(Self { name, sink })
    }

    /// Checks that [`Output::create`] would succeed, before long work whose result the output will
    /// take. Leaves no file behind if the program is stopped meanwhile.
    ///
    /// # Errors
    /// See [`Output::create`].
    pub fn check(argument: &Path, clobber: bool) -> Result<(), FileError> {
        Self::check_folder_once(argument, clobber, &mut BTreeSet::new())
    }

    /// Checks an output as [`Output::check`] does. `folders` are those in which a file could be made before; no other
    /// is made there. Thousands of outputs then cost a shared file system no file each.
    ///
    /// # Errors
    /// See [`Output::create`].
    pub(crate) fn check_folder_once(
        argument: &Path,
        clobber: bool,
        folders: &mut BTreeSet<PathBuf>,
    ) -> Result<(), FileError> {
        match Target::of(argument, clobber)? {
            // A named pipe must be opened only once.
            Target::Stdout | Target::Device(_) => Ok(()),
            Target::File { path, .. } if folders.contains(folder_of(&path)) => Ok(()),
            Target::File { path, replaced } => {
                create_beside(&path, replaced.as_ref())
                    .map_err(|source| write_error(name_of(argument), source))?;
                folders.insert(folder_of(&path).into());
                Ok(())
            }
        }
    }

    /// Makes the written bytes the content of the file, also for a machine that loses its power.
    ///
    /// # Errors
    /// When the last bytes cannot be written or the file cannot be replaced; the old file stays.
    pub fn commit(self) -> Result<(), FileError> {
        self.ready()?.replace()
    }

    /// Writes the last bytes and syncs them. The old file stays until [`Ready::replace`].
    ///
    /// # Errors
    /// When the last bytes cannot be written.
    pub fn ready(self) -> Result<Ready, FileError> {
        let Self { name, sink } = self;
        let failed = |source| write_error(name.clone(), source);
        let replacement = match sink {
            Sink::Stdout(mut stdout) => stdout.flush().map(|()| None).map_err(failed)?,
            Sink::Device(mut device) => device.flush().map(|()| None).map_err(failed)?,
            Sink::Replace { content, replacement } => {
                let file = content.into_inner().map_err(|error| failed(error.into_error()))?;
                file.sync_all().map_err(failed)?;
                Some(replacement)
            }
        };
        Ok(Ready { name, replacement })
    }

    /// Returns the error to report for a failed write to this output.
    #[must_use]
    pub fn failed(&self, source: io::Error) -> FileError {
        write_error(self.name.clone(), source)
    }

    /// Writes all bytes and makes them the content of the file.
    ///
    /// # Errors
    /// See [`Output::commit`].
    pub fn commit_all(mut self, bytes: &[u8]) -> Result<(), FileError> {
        self.write_all(bytes).map_err(|source| self.failed(source))?;
        self.commit()
    }
}

impl Ready {
    /// Returns the file that will be replaced, with links followed, or `None` for standard output
    /// and devices.
    #[must_use]
    pub fn target(&self) -> Option<&Path> {
        self.replacement.as_ref().map(|replacement| replacement.target.as_path())
    }

    /// Renames the temporary file over the target and syncs the folder.
    ///
    /// # Errors
    /// When the file cannot be replaced, or the folder cannot be synced.
    pub fn replace(self) -> Result<(), FileError> {
        let Self { name, replacement } = self;
        let Some(replacement) = replacement else { return Ok(()) };
        let Replacement { temporary, target, clobber, entry: _entry } = replacement;
        let renamed =
            if clobber { temporary.persist(&target) } else { temporary.persist_noclobber(&target) };
        match renamed.map_err(|failed| failed.error) {
            // Another program made the file after the first check.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && !clobber => {
                Err(FileError::Exists { name })
            }
            renamed => renamed
                .and_then(|()| sync_folder(folder_of(&target)))
                .map_err(|source| write_error(name, source)),
        }
    }
}

/// Makes the names in a folder durable, if the system can sync a folder.
pub(crate) fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(not(unix)) {
        return Ok(());
    }
    let synced = File::open(folder).and_then(|folder| folder.sync_all());
    synced.or_else(|error| match error.kind() {
        // The folder may be written but not read, or the file system syncs no folders.
        io::ErrorKind::PermissionDenied
        | io::ErrorKind::InvalidInput
        | io::ErrorKind::Unsupported => Ok(()),
        _ => Err(error),
    })
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.sink {
            Sink::Stdout(stdout) => stdout.write(bytes),
            Sink::Device(device) => device.write(bytes),
            Sink::Replace { content, .. } => content.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.sink {
            Sink::Stdout(stdout) => stdout.flush(),
            Sink::Device(device) => device.flush(),
            Sink::Replace { content, .. } => content.flush(),
        }
    }
}

/// Creates a temporary file beside `target`. The temporary file has the permissions of the file
/// that it will replace, or those that the system gives a new file.
fn create_beside(
    target: &Path,
    replaced: Option<&fs::Metadata>,
) -> io::Result<((File, TempPath), Entry)> {
    let folder = folder_of(target);
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
        // Written as a plain file: tempfile's own writer would name the temporary in its errors.
        builder.tempfile_in(folder).map(tempfile::NamedTempFile::into_parts).map_err(plain)
    };
    let ((file, temporary), entry) = Entry::of(make, |(_, path)| path)?;
    if let Some(metadata) = replaced {
        file.set_permissions(metadata.permissions())?;
    }
    Ok(((file, temporary), entry))
}

/// Returns the error of the system inside an error of tempfile, whose text names the temporary
/// file.
fn plain(error: io::Error) -> io::Error {
    match error.kind() {
        io::ErrorKind::Other => error,
        kind => kind.into(),
    }
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

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_to_no_file_is_refused_and_stays() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("link");
        std::os::unix::fs::symlink("none", &link).unwrap();
        let error = Output::create(&link, true).unwrap_err().to_string();
        assert!(error.contains("it is a link to none, where no file is"), "{error}");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_that_vanishes_is_told_by_the_name_of_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sub/a.txt");
        fs::create_dir(folder.path().join("sub")).unwrap();
        let output = Output::create(&path, true).unwrap();
        fs::remove_dir_all(folder.path().join("sub")).unwrap();
        let error = output.commit_all(b"new").unwrap_err().to_string();
        let expected = format!("cannot write {}: ", path.display());
        assert!(error.starts_with(&expected) && !error.contains(".part"), "{error}");
    }
}
