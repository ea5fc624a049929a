//! The texts of the opened files, with their history and their states on disk.

use super::folder::{Folder, Stamp};
use super::history::{Change, History};
use files::Source;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// The most bytes of a text.
pub const LONGEST: usize = 4 << 20;

/// A text as it is edited.
#[derive(Debug, Clone)]
pub struct Text {
    /// The text now.
    pub now: Arc<str>,
    /// The text on disk when it was last read or saved; `None` if there is no file yet.
    pub saved: Option<Arc<str>>,
    /// The text that another program wrote meanwhile, if the user must choose.
    pub conflict: Option<Arc<str>>,
    /// Size and time of the file when it was last looked at.
    stamp: Option<Stamp>,
}

impl Text {
    /// Returns whether the text differs from the file.
    #[must_use]
    pub fn is_changed(&self) -> bool {
        self.saved.as_ref() != Some(&self.now)
    }
}

/// The opened texts by their paths.
#[derive(Debug, Default)]
pub struct Texts {
    all: BTreeMap<String, Text>,
    history: History,
}

impl Texts {
    /// Reads a text from the folder, unless it is there already.
    ///
    /// # Errors
    /// When the file cannot be read, is too long or is not UTF-8. The error is a sentence.
    pub fn read(&mut self, folder: &Folder, path: &str) -> Result<(), String> {
        if self.all.contains_key(path) {
            return Ok(());
        }
        let stamp = folder.stamp(Path::new(path));
        let now = on_disk(folder, path)?;
        let saved = Some(now.clone());
        self.all.insert(path.into(), Text { now, saved, conflict: None, stamp });
        Ok(())
    }

    /// Adds a text that has no file yet, unless it is there already.
    pub fn add(&mut self, path: &str, text: &str) {
        let new = || Text { now: text.into(), saved: None, conflict: None, stamp: None };
        self.all.entry(path.into()).or_insert_with(new);
    }

    /// Returns a text.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<&Text> {
        self.all.get(path)
    }

    /// Returns all texts with their paths.
    pub fn iter(&self) -> impl Iterator<Item = (&String, &Text)> {
        self.all.iter()
    }

    /// Returns the texts of all paths as they are now.
    #[must_use]
    pub fn snapshot(&self) -> BTreeMap<String, Arc<str>> {
        self.all.iter().map(|(path, text)| (path.clone(), text.now.clone())).collect()
    }

    /// Numbers of steps that can be undone and redone.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        self.history.counts()
    }

    /// Replaces a text, as one step or as a part of a gesture.
    ///
    /// # Errors
    /// When no such text is open, or the new one is too long.
    pub fn set(&mut self, path: &str, now: &str, gesture: &str) -> Result<(), String> {
        if now.len() > LONGEST {
            return Err(format!("found {} bytes, expected at most {LONGEST}", now.len()));
        }
        let text = self.all.get_mut(path).ok_or_else(|| format!("{path} is not open"))?;
        let before = std::mem::replace(&mut text.now, now.into());
        let (file, after, gesture) = (path.into(), text.now.clone(), gesture.into());
        self.history.add(Change { file, before, after, gesture });
        Ok(())
    }

    /// Takes the last step back.
    pub fn undo(&mut self) {
        if let Some((path, text)) = self.history.undo() {
            self.put(&path, text);
        }
    }

    /// Repeats the step that was undone last.
    pub fn redo(&mut self) {
        if let Some((path, text)) = self.history.redo() {
            self.put(&path, text);
        }
    }

    fn put(&mut self, path: &str, now: Arc<str>) {
        if let Some(text) = self.all.get_mut(path) {
            text.now = now;
        }
    }

    /// Writes a text to its file. A file that another program changed meanwhile is not replaced: the text then has a
    /// conflict.
    ///
    /// # Errors
    /// When there is a conflict, or the file cannot be written.
    pub fn save(&mut self, folder: &Folder, path: &str) -> Result<(), String> {
        let text = self.all.get_mut(path).ok_or_else(|| format!("{path} is not open"))?;
        let there = on_disk(folder, path).ok();
        if there.is_some() && there != text.saved && there.as_ref() != Some(&text.now) {
            text.conflict = there;
            return Err(format!("another program changed {path}: choose which text to keep"));
        }
        let written = folder.write(Path::new(path), text.now.as_bytes());
        written.map_err(|error| error.to_string())?;
        text.saved = Some(text.now.clone());
        text.conflict = None;
        text.stamp = folder.stamp(Path::new(path));
        Ok(())
    }

    /// Settles a conflict. With `mine` the text stays and may be saved over the file; otherwise the text becomes that of
    /// the file, which can be undone.
    pub fn settle(&mut self, path: &str, mine: bool) {
        let Some(text) = self.all.get_mut(path) else { return };
        let Some(theirs) = text.conflict.take() else { return };
        text.saved = Some(theirs.clone());
        if !mine {
            // A text of the file is not too long, since it was read.
            let _ = self.set(path, &theirs, "");
        }
    }

    /// Looks for files that another program changed. A text without changes of its own follows its file. Returns whether
    /// a text or a conflict changed.
    pub fn look(&mut self, folder: &Folder) -> bool {
        let mut found = Vec::new();
        for (path, text) in &mut self.all {
            let stamp = folder.stamp(Path::new(path));
            if stamp == text.stamp || stamp.is_none() {
                continue;
            }
            text.stamp = stamp;
            match on_disk(folder, path) {
                Ok(theirs) if text.saved.as_ref() != Some(&theirs) => {
                    found.push((path.clone(), theirs));
                }
                Ok(_) | Err(_) => {}
            }
        }
        for (path, theirs) in &found {
            let Some(text) = self.all.get_mut(path) else { continue };
            if *theirs == text.now || !text.is_changed() {
                text.saved = Some(theirs.clone());
                let _ = self.set(path, theirs, "");
            } else {
                text.conflict = Some(theirs.clone());
            }
        }
        !found.is_empty()
    }
}

fn on_disk(folder: &Folder, path: &str) -> Result<Arc<str>, String> {
    let bytes = folder.read(Path::new(path)).map_err(|error| error.to_string())?;
    if bytes.len() > LONGEST {
        return Err(format!("{path}: found {} bytes, expected at most {LONGEST}", bytes.len()));
    }
    let text = String::from_utf8(bytes).map_err(|_| format!("{path}: expected UTF-8 text"))?;
    Ok(text.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_file_that_changes_is_followed_and_a_conflict_loses_nothing() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("a.json");
        fs::write(&path, "one").unwrap();
        let folder = Folder::open(place.path()).unwrap();
        let mut texts = Texts::default();
        texts.read(&folder, "a.json").unwrap();
        assert!(!texts.look(&folder));
        fs::write(&path, "another").unwrap();
        assert!(texts.look(&folder));
        assert_eq!(&*texts.get("a.json").unwrap().now, "another");
        texts.set("a.json", "mine", "").unwrap();
        fs::write(&path, "theirs, longer").unwrap();
        // The conflict is found whether the user saves first or the program looks first.
        assert!(texts.save(&folder, "a.json").unwrap_err().contains("another program changed"));
        assert!(texts.look(&folder));
        let text = texts.get("a.json").unwrap();
        assert_eq!(text.conflict.as_deref(), Some("theirs, longer"));
        assert_eq!(
            (&*text.now, fs::read_to_string(&path).unwrap()),
            ("mine", "theirs, longer".into())
        );
        texts.settle("a.json", false);
        assert_eq!(&*texts.get("a.json").unwrap().now, "theirs, longer");
        texts.undo();
        assert_eq!(&*texts.get("a.json").unwrap().now, "mine");
        texts.save(&folder, "a.json").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
        assert!(!texts.get("a.json").unwrap().is_changed() && !texts.look(&folder));
    }
}
