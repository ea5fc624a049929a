//! Replaces files that belong together, and marks the time during which some are old and some new.
//!
//! Each file is replaced whole, but several files cannot be replaced at once. So before a batch
//! replaces the first file, it writes a marker beside the files, `NAME.incomplete`. The marker is a
//! text that lists the files:
//!
//! ```text
//! topobook: these files belong together and are being replaced one after another
//! file "vase-point.png"
//! file "vase.png"
//! new "vase-point.png"
//! ```
//!
//! A file with a line `new` has been replaced; the others may be old. The marker is removed when all
//! files are new. When a program fails, is killed or is interrupted in between, the marker stays, and
//! the next run with the same outputs can report it ([`Batch::remark`]). A batch of one file needs no
//! marker.

use crate::identity::folder_of;
use crate::output::{Ready, sync_folder};
use crate::{FileError, Output};
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The first line of a marker.
const HEADER: &str =
    "topobook: these files belong together and are being replaced one after another";

/// Files that belong together and are replaced one after another.
#[derive(Debug)]
pub struct Batch<'a> {
    marker: PathBuf,
    /// A larger batch to which these files also belong.
    larger: Option<&'a Batch<'a>>,
    /// The names of this batch's files in the marker.
    files: BTreeSet<String>,
    /// The existing files that the marker of an earlier run lists.
    earlier: Option<BTreeSet<String>>,
    progress: Mutex<Progress>,
}

#[derive(Debug, Default)]
struct Progress {
    /// The marker of this batch, open for appending; set before the first file is replaced.
    marker: Option<File>,
    replaced: BTreeSet<String>,
}

impl<'a> Batch<'a> {
    /// Makes a batch of `files` with its marker at `folder/NAME.incomplete`. A file may be given by a
    /// link or by the path that the link leads to. Nothing is written yet.
    ///
    /// # Errors
    /// When a file that is not a marker has the marker's name.
    pub fn new(folder: &Path, name: &str, files: &[PathBuf]) -> Result<Self, FileError> {
        let marker = folder.join(format!("{name}.incomplete"));
        let earlier = match fs::read_to_string(&marker) {
            Ok(text) if text.starts_with(HEADER) => Some(listed(&text, folder)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            _ => {
                let source = io::Error::other(
                    "this file is not a list of files that a run replaces: move this file",
                );
                return Err(failed(&marker, source));
            }
        };
        let files = files.iter().map(|file| name_in(folder, file)).collect();
        Ok(Self { marker, larger: None, files, earlier, progress: Mutex::default() })
    }

    /// Makes this batch a part of a larger one, whose marker also lists these files.
    #[must_use]
    pub fn within(self, larger: &'a Self) -> Self {
        Self { larger: Some(larger), ..self }
    }

    /// Replaces the files of outputs that belong together. All outputs are written and synced first,
    /// and then the files are replaced one right after another. If there are several files, the marker
    /// lies beside the first and is named after it. Returns the remark of [`Batch::remark`].
    ///
    /// # Errors
    /// When one of the outputs, or the marker, cannot be written.
    pub fn commit(outputs: Vec<Output>) -> Result<Option<String>, FileError> {
        let ready: Vec<Ready> = outputs.into_iter().map(Output::ready).collect::<Result<_, _>>()?;
        let files: Vec<PathBuf> = ready.iter().filter_map(Ready::target).map(Into::into).collect();
        let Some(first) = files.first() else { return Ok(None) };
        let name = first.file_name().unwrap_or_default().to_string_lossy();
        let batch = Self::new(folder_of(first), &name, &files)?;
        for output in ready {
            batch.replace_ready(output)?;
        }
        let remark = batch.remark();
        batch.finish()?;
        Ok(remark)
    }

    /// Returns a message for the user if an earlier run stopped between these files.
    #[must_use]
    pub fn remark(&self) -> Option<String> {
        let earlier = self.earlier.as_ref()?;
        let rest = earlier.difference(&self.files).count();
        let now = match rest {
            0 => "this run replaces all of the files".into(),
            1 => "this run replaces all of the files but one".into(),
            _ => format!("this run replaces all of the files but {rest}"),
        };
        let marker = self.marker.display();
        Some(format!(
            "{marker} lists files of which some are old and some are new, since an earlier run \
             stopped between two of the files: {now}"
        ))
    }

    /// Syncs an output and replaces its file.
    ///
    /// # Errors
    /// When the output or the marker cannot be written.
    pub fn replace(&self, output: Output) -> Result<(), FileError> {
        self.replace_ready(output.ready()?)
    }

    /// Ends the batch. Removes the marker if all files that it lists are new.
    ///
    /// # Errors
    /// When the marker cannot be removed.
    pub fn finish(self) -> Result<(), FileError> {
        let progress = self.progress();
        if progress.marker.is_none() && self.earlier.is_none() {
            return Ok(());
        }
        let mut listed = self.files.union(self.earlier.as_ref().unwrap_or(&self.files));
        if !listed.all(|file| progress.replaced.contains(file)) {
            return Ok(());
        }
        fs::remove_file(&self.marker)
            .and_then(|()| sync_folder(folder_of(&self.marker)))
            .map_err(|source| failed(&self.marker, source))
    }

    fn progress(&self) -> MutexGuard<'_, Progress> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn replace_ready(&self, output: Ready) -> Result<(), FileError> {
        let Some(target) = output.target().map(Path::to_path_buf) else { return output.replace() };
        self.begin()?;
        output.replace()?;
        self.record(&target)
    }

    /// Writes the marker before the first file is replaced.
    fn begin(&self) -> Result<(), FileError> {
        if let Some(larger) = self.larger {
            larger.begin()?;
        }
        let mut progress = self.progress();
        if progress.marker.is_none() && self.files.len() > 1 {
            progress.marker = Some(self.mark()?);
        }
        Ok(())
    }

    /// Adds a line to the marker: this file is new.
    fn record(&self, target: &Path) -> Result<(), FileError> {
        if let Some(larger) = self.larger {
            larger.record(target)?;
        }
        let (name, mut progress) = (self.name_of(target), self.progress());
        if let Some(marker) = &mut progress.marker {
            let line = format!("new {}\n", quoted(&name));
            let written = marker.write_all(line.as_bytes()).and_then(|()| marker.sync_data());
            written.map_err(|source| failed(&self.marker, source))?;
        }
        progress.replaced.insert(name);
        Ok(())
    }

    /// Returns the marker's name of a target. The target may be the file that a link of the batch leads
    /// to.
    fn name_of(&self, target: &Path) -> String {
        let folder = folder_of(&self.marker);
        let leads = |name: &str| fs::canonicalize(folder.join(name)).is_ok_and(|f| f == target);
        let name = target.file_name().map(|name| Path::new(name).display().to_string());
        if let Some(name) = name.filter(|name| self.files.contains(name) && leads(name)) {
            return name;
        }
        let name = self.files.iter().find(|file| leads(file)).cloned();
        name.unwrap_or_else(|| name_in(folder, target))
    }

    /// Writes the marker, or adds the files of this batch to the marker of an earlier run.
    fn mark(&self) -> Result<File, FileError> {
        let known = self.earlier.as_ref();
        let new = self.files.iter().filter(|file| known.is_none_or(|known| !known.contains(*file)));
        let lines: String = new.map(|file| format!("file {}\n", quoted(file))).collect();
        if known.is_none() {
            let text = format!("{HEADER}\n{lines}");
            Output::create(&self.marker, true)?.commit_all(text.as_bytes())?;
        }
        let open = || {
            let mut file = File::options().append(true).open(&self.marker)?;
            if known.is_some() {
                // The last line of the earlier run may be cut short.
                file.write_all(format!("\n{lines}").as_bytes())?;
                file.sync_data()?;
            }
            Ok(file)
        };
        open().map_err(|source| failed(&self.marker, source))
    }
}

/// Returns the files that a marker's text lists, of those that exist. A file that does not exist cannot
/// be old.
fn listed(text: &str, folder: &Path) -> BTreeSet<String> {
    let names = text.lines().filter_map(|line| line.strip_prefix("file "));
    let names = names.filter_map(|name| serde_json::from_str(name).ok());
    names.filter(|name: &String| folder.join(name).exists()).collect()
}

/// Returns a file's name if the file lies in this folder, and its path otherwise.
fn name_in(folder: &Path, file: &Path) -> String {
    let inside = folder_of(file) == folder;
    let name = if inside { file.file_name().map(Path::new) } else { None };
    name.unwrap_or(file).display().to_string()
}

/// Returns a name as a JSON string, which is one line.
fn quoted(name: &str) -> String {
    serde_json::Value::from(name).to_string()
}

fn failed(marker: &Path, source: io::Error) -> FileError {
    FileError::Write { name: marker.display().to_string(), source }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    fn filled(path: &Path, text: &str) -> Output {
        let mut output = Output::create(path, true).unwrap();
        output.write_all(text.as_bytes()).unwrap();
        output
    }

    fn three(folder: &TempDir) -> Vec<PathBuf> {
        ["a", "b", "c"].map(|name| folder.path().join(name)).to_vec()
    }

    fn names(folder: &TempDir) -> BTreeSet<String> {
        let entries = fs::read_dir(folder.path()).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn a_marker_lists_what_is_new_until_all_is() {
        let folder = tempfile::tempdir().unwrap();
        let files = three(&folder);
        let marker = folder.path().join("all.incomplete");
        let batch = Batch::new(folder.path(), "all", &files).unwrap();
        assert!(!marker.exists() && batch.remark().is_none());
        batch.replace(filled(&files[0], "new")).unwrap();
        let text = fs::read_to_string(&marker).unwrap();
        let expected = "file \"a\"\nfile \"b\"\nfile \"c\"\nnew \"a\"\n";
        assert_eq!(text, format!("{HEADER}\n{expected}"));
        batch.replace(filled(&files[1], "new")).unwrap();
        batch.replace(filled(&files[2], "new")).unwrap();
        assert!(marker.exists());
        batch.finish().unwrap();
        assert_eq!(names(&folder).len(), 3);
    }

    #[test]
    fn the_next_run_tells_of_a_batch_that_stopped_and_completes_it() {
        let folder = tempfile::tempdir().unwrap();
        let files = three(&folder);
        files.iter().for_each(|file| fs::write(file, "old").unwrap());
        let marker = folder.path().join("all.incomplete");
        let stopped = Batch::new(folder.path(), "all", &files).unwrap();
        stopped.replace(filled(&files[0], "new")).unwrap();
        drop(stopped);
        assert!(marker.exists());
        fs::write(&marker, fs::read(&marker).unwrap().split_last().unwrap().1).unwrap();

        // A run of some of the files leaves the marker, one of all removes it.
        for (some, left) in [(&files[..1], 2), (&files[..2], 1), (&files[..], 0)] {
            let batch = Batch::new(folder.path(), "all", some).unwrap();
            let remark = batch.remark().unwrap();
            let rest = match left {
                0 => "this run replaces all of the files".into(),
                1 => "all of the files but one".into(),
                _ => format!("all of the files but {left}"),
            };
            assert!(remark.ends_with(&rest), "{remark}");
            some.iter().for_each(|file| batch.replace(filled(file, "again")).unwrap());
            batch.finish().unwrap();
            assert_eq!(marker.exists(), left > 0);
        }
    }

    #[test]
    fn files_committed_together_are_all_new_and_leave_no_marker() {
        let folder = tempfile::tempdir().unwrap();
        let outputs = three(&folder).iter().map(|file| filled(file, "new")).collect();
        assert_eq!(Batch::commit(outputs).unwrap(), None);
        assert_eq!(names(&folder), ["a", "b", "c"].map(String::from).into());
    }

    #[test]
    fn a_file_of_the_user_that_has_the_name_of_a_marker_stays() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("all.incomplete"), "mine").unwrap();
        let error = Batch::new(folder.path(), "all", &three(&folder)).unwrap_err().to_string();
        assert!(error.contains("all.incomplete: this file is not a list of files"), "{error}");
    }

    #[test]
    fn a_larger_batch_tells_of_the_files_of_its_parts() {
        let folder = tempfile::tempdir().unwrap();
        let files = three(&folder);
        let larger = Batch::new(folder.path(), "larger", &files).unwrap();
        let part = Batch::new(folder.path(), "part", &files[..2]).unwrap().within(&larger);
        files[..2].iter().for_each(|file| part.replace(filled(file, "new")).unwrap());
        part.finish().unwrap();
        let text = fs::read_to_string(folder.path().join("larger.incomplete")).unwrap();
        assert!(text.ends_with("file \"c\"\nnew \"a\"\nnew \"b\"\n"), "{text}");
        larger.replace(filled(&files[2], "new")).unwrap();
        larger.finish().unwrap();
        assert_eq!(names(&folder).len(), 3);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_in_a_batch_is_the_file_it_leads_to() {
        let (folder, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let files = three(&folder);
        fs::write(other.path().join("a"), "old").unwrap();
        std::os::unix::fs::symlink(other.path().join("a"), &files[0]).unwrap();
        let batch = Batch::new(folder.path(), "all", &files).unwrap();
        files.iter().for_each(|file| batch.replace(filled(file, "new")).unwrap());
        batch.finish().unwrap();
        assert_eq!(names(&folder).len(), 3, "the marker is gone");
        assert_eq!(fs::read(other.path().join("a")).unwrap(), b"new");
    }
}
