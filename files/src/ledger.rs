//! Records the inputs and outputs of a program, so that no output replaces an input.
//!
//! A program makes one ledger and uses it for every file. [`Ledger::claim`] enters an output before any
//! work is done; reading a file enters an input. If an output and an input are one file under two
//! names, the one entered second is refused. At that time no file has been replaced. Files named by
//! other files are also read through the ledger, since it is a [`Source`].

use crate::identity::{Identity, Number, folder_of, folds_case};
use crate::{Disk, Exit, Failure, FileError, Output, Source, input};
use std::collections::{BTreeSet, HashMap};
use std::io::BufRead;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use thiserror::Error;

/// The files of one run of a program.
#[derive(Debug)]
pub struct Ledger {
    clobber: bool,
    entries: Mutex<Entries>,
}

#[derive(Debug, Default)]
struct Entries {
    /// The names of inputs in messages.
    inputs: HashMap<Identity, String>,
    /// The paths of inputs.
    paths: BTreeSet<PathBuf>,
    outputs: HashMap<Identity, Claim>,
    /// Lowercase names of outputs in their folders, with the claim of the spelling used.
    spellings: HashMap<(Number, String), Claim>,
    /// Folders in which a file could be made.
    folders: BTreeSet<PathBuf>,
}

/// An output, and the remedy if it clashes with another file.
#[derive(Debug, Clone)]
struct Claim {
    name: String,
    change: String,
}

/// One file named for two purposes.
#[derive(Debug, Error)]
pub enum Clash {
    /// An output that would replace an input.
    #[error("the output {output} is also the input {input}: {change}")]
    Input {
        /// The output as the user named it.
        output: String,
        /// The input as the user or a file named it, with its role if known.
        input: String,
        /// The remedy.
        change: String,
    },
    /// Two outputs of which the second would replace the first.
    #[error("the output {second} is also the output {first}: {change}")]
    Outputs {
        /// The output claimed first.
        first: String,
        /// The output claimed after it.
        second: String,
        /// The remedy.
        change: String,
    },
}

impl Failure for Clash {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

impl Ledger {
    /// Makes an empty ledger. `clobber` says whether outputs may replace existing files.
    #[must_use]
    pub fn new(clobber: bool) -> Self {
        Self { clobber, entries: Mutex::default() }
    }

    /// Enters an output and checks that it can be written. `change` is the remedy if the output is also
    /// another file of this run: "name another file with -o".
    ///
    /// # Errors
    /// When the file is an input or another output; otherwise see [`Output::check`].
    pub fn claim(&self, argument: &Path, change: &str) -> Result<(), FileError> {
        self.enter(argument, change)?;
        Output::check_folder_once(argument, self.clobber, &mut self.entries().folders)
    }

    /// Enters an output and opens it at once. `change` is the remedy, as in [`Ledger::claim`].
    ///
    /// # Errors
    /// When the file is an input or another output; otherwise see [`Output::create`].
    pub fn output(&self, argument: &Path, change: &str) -> Result<Output, FileError> {
        self.enter(argument, change)?;
        Output::create(argument, self.clobber)
    }

    /// Opens an output that was claimed before. An output that was not claimed is entered first.
    ///
    /// # Errors
    /// See [`Output::create`]; for an output that was not claimed, also see [`Ledger::claim`].
    pub fn create(&self, argument: &Path) -> Result<Output, FileError> {
        let claimed = {
            let entries = self.entries();
            keys_of_output(argument).iter().any(|key| entries.outputs.contains_key(key))
        };
        if claimed || input::is_stdin(argument) {
            return Output::create(argument, self.clobber);
        }
        self.output(argument, "name another file")
    }

    /// Enters a file named on a command line that will be read. `role` describes the file: "the spec".
    ///
    /// # Errors
    /// When the file is an output.
    pub fn expect(&self, argument: &Path, role: &str) -> Result<(), FileError> {
        Ok(self.refuse(argument, role)?)
    }

    /// Reads the whole file named on a command line; `-` is standard input. `role` describes the file:
    /// "the spec".
    ///
    /// # Errors
    /// When the file is an output or cannot be read.
    pub fn argument(&self, argument: &Path, role: &str) -> Result<Vec<u8>, FileError> {
        self.refuse(argument, role)?;
        input::read(argument)
    }

    /// Reads a JSON file as [`Ledger::argument`] does, provided there is memory for its parsed values.
    ///
    /// # Errors
    /// See [`Ledger::argument`]; also when the memory budget of the process is too small.
    pub fn argument_json(&self, argument: &Path, role: &str) -> Result<Vec<u8>, FileError> {
        self.refuse(argument, role)?;
        input::read_json(argument)
    }

    /// Opens the file named on a command line as a buffered reader; `-` is standard input. `role`
    /// describes the file: "the grid".
    ///
    /// # Errors
    /// When the file is an output or cannot be opened.
    pub fn open(&self, argument: &Path, role: &str) -> Result<Box<dyn BufRead>, FileError> {
        self.refuse(argument, role)?;
        input::open(argument)
    }

    /// Returns the paths of the files that were read or looked for.
    #[must_use]
    pub fn inputs(&self) -> Vec<PathBuf> {
        self.entries().paths.iter().cloned().collect()
    }

    fn entries(&self) -> MutexGuard<'_, Entries> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn enter(&self, argument: &Path, change: &str) -> Result<(), Clash> {
        let (keys, mut entries) = (keys_of_output(argument), self.entries());
        let name =
            if input::is_stdin(argument) { "<stdout>".into() } else { input::name_of(argument) };
        let claim = Claim { name, change: change.into() };
        for key in &keys {
            if let Some(input) = entries.inputs.get(key) {
                let Claim { name: output, change } = claim;
                return Err(Clash::Input { output, input: input.clone(), change });
            }
            let spelling = spelling_of(key);
            let first = entries.outputs.get(key).or_else(|| {
                let first = entries.spellings.get(spelling.as_ref()?)?;
                folds_case(folder_of(argument)).then_some(first)
            });
            if let Some(first) = first {
                let (first, Claim { name: second, change }) = (first.name.clone(), claim);
                return Err(Clash::Outputs { first, second, change });
            }
        }
        for key in keys {
            if let Some(spelling) = spelling_of(&key) {
                entries.spellings.insert(spelling, claim.clone());
            }
            entries.outputs.insert(key, claim.clone());
        }
        Ok(())
    }

    /// Enters an input, or fails if the file is an output.
    fn refuse(&self, argument: &Path, role: &str) -> Result<(), Clash> {
        let keys = match input::is_stdin(argument) {
            true => Identity::of_stdin().into_iter().collect(),
            false => Identity::keys(argument),
        };
        let mut input = input::name_of(argument);
        if !role.is_empty() {
            input = format!("{input} ({role})");
        }
        let mut entries = self.entries();
        if let Some(Claim { name, change }) = keys.iter().find_map(|key| entries.outputs.get(key)) {
            let (output, change) = (name.clone(), change.clone());
            return Err(Clash::Input { output, input, change });
        }
        for key in keys {
            entries.inputs.entry(key).or_insert_with(|| input.clone());
        }
        if !input::is_stdin(argument) {
            entries.paths.insert(argument.to_path_buf());
        }
        Ok(())
    }
}

impl Source for Ledger {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        self.refuse(path, "")?;
        Disk.read(path)
    }

    fn same_but_case(&self, path: &Path) -> Option<PathBuf> {
        Disk.same_but_case(path)
    }
}

fn keys_of_output(argument: &Path) -> Vec<Identity> {
    match input::is_stdin(argument) {
        true => Identity::of_stdout().into_iter().collect(),
        false => Identity::keys(argument),
    }
}

/// Returns the folder of a name and its lowercase form. Two names that differ only in case have equal
/// results.
fn spelling_of(key: &Identity) -> Option<(Number, String)> {
    match key {
        Identity::There(_) => None,
        Identity::Name { folder, name } => {
            Some((folder.clone(), name.to_string_lossy().to_lowercase()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const CHANGE: &str = "name another file with -o";

    #[test]
    fn an_output_that_is_an_input_is_refused_whichever_comes_first() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("a"), "mine").unwrap();
        fs::hard_link(path("a"), path("b")).unwrap();
        for other in ["a", "./a", "b"] {
            let ledger = Ledger::new(true);
            ledger.claim(&path(other), CHANGE).unwrap();
            let error = ledger.argument(&path("a"), "the spec").unwrap_err();
            assert_eq!(error.exit(), Exit::Use);
            let (output, input) = (path(other), path("a"));
            let expected = format!(
                "the output {} is also the input {} (the spec): {CHANGE}",
                output.display(),
                input.display()
            );
            assert_eq!(error.to_string(), expected);

            let ledger = Ledger::new(true);
            assert_eq!(ledger.argument(&path("a"), "the spec").unwrap(), b"mine");
            assert_eq!(ledger.output(&path(other), CHANGE).unwrap_err().to_string(), expected);
        }
        assert_eq!(fs::read(path("a")).unwrap(), b"mine");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing is left beside them");
    }

    #[test]
    fn a_file_that_another_names_is_an_input() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        fs::write(&path, "").unwrap();
        let ledger = Ledger::new(true);
        ledger.read(&path).unwrap();
        assert_eq!(ledger.create(&path).unwrap_err().exit(), Exit::Use);
    }

    #[test]
    fn an_output_is_an_input_also_once_it_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new");
        let ledger = Ledger::new(true);
        ledger.claim(&path, CHANGE).unwrap();
        ledger.create(&path).unwrap().commit_all(b"ours").unwrap();
        assert_eq!(ledger.read(&path).unwrap_err().exit(), Exit::Use);
        ledger.create(&path).unwrap().commit_all(b"again").unwrap();
    }

    #[test]
    fn two_outputs_are_two_files() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let ledger = Ledger::new(true);
        ledger.claim(&path("a"), CHANGE).unwrap();
        ledger.claim(&path("b"), CHANGE).unwrap();
        let error = ledger.claim(&path("./a"), "name another file with --report").unwrap_err();
        let message = error.to_string();
        assert!(message.contains("/a: name another file with --report"), "{message}");
        #[cfg(target_os = "linux")]
        ledger.claim(&path("A"), CHANGE).unwrap();
    }
}
