//! Steps that can be undone and redone.
//!
//! A step holds a text before and after a change. Changes of one gesture, such as the dragging of a handle, are one
//! step.

use std::sync::Arc;

/// Most steps that can be undone.
pub const MOST: usize = 100;

/// A change of one text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// The path of the file.
    pub file: String,
    /// The text before the change.
    pub before: Arc<str>,
    /// The text after the change.
    pub after: Arc<str>,
    /// The gesture that the change belongs to; empty for a step of its own.
    pub gesture: String,
}

/// The steps of a user, oldest first.
#[derive(Debug, Default)]
pub struct History {
    steps: Vec<Change>,
    /// Number of steps that are done; those after it are undone.
    done: usize,
}

impl History {
    /// Adds a change. Steps that were undone are lost.
    pub fn add(&mut self, change: Change) {
        if change.before == change.after {
            return;
        }
        self.steps.truncate(self.done);
        if let Some(last) = self.steps.last_mut()
            && !change.gesture.is_empty()
            && last.gesture == change.gesture
            && last.file == change.file
        {
            last.after = change.after;
            return;
        }
        self.steps.push(change);
        if self.steps.len() > MOST {
            self.steps.remove(0);
        }
        self.done = self.steps.len();
    }

    /// Takes the last step back. Returns the file and the text that it had before.
    pub fn undo(&mut self) -> Option<(String, Arc<str>)> {
        self.done = self.done.checked_sub(1)?;
        let step = &self.steps[self.done];
        Some((step.file.clone(), step.before.clone()))
    }

    /// Repeats the step that was undone last. Returns the file and the text that it then has.
    pub fn redo(&mut self) -> Option<(String, Arc<str>)> {
        let step = self.steps.get(self.done)?;
        self.done += 1;
        Some((step.file.clone(), step.after.clone()))
    }

    /// Numbers of steps that can be undone and redone.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        [self.done, self.steps.len() - self.done]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(before: &str, after: &str, gesture: &str) -> Change {
        Change {
            file: "a".into(),
            before: before.into(),
            after: after.into(),
            gesture: gesture.into(),
        }
    }

    #[test]
    fn a_gesture_is_one_step() {
        let mut history = History::default();
        for (before, after) in [("1", "2"), ("2", "3"), ("3", "4")] {
            history.add(change(before, after, "drag-1"));
        }
        history.add(change("4", "4", ""));
        history.add(change("4", "5", "drag-2"));
        assert_eq!(history.counts(), [2, 0]);
        assert_eq!(history.undo(), Some(("a".into(), "4".into())));
        assert_eq!(history.undo(), Some(("a".into(), "1".into())));
        assert_eq!(history.undo(), None);
        assert_eq!(history.redo(), Some(("a".into(), "4".into())));
        history.add(change("4", "6", ""));
        assert_eq!((history.counts(), history.redo()), ([2, 0], None));
    }

    #[test]
    fn a_hundred_steps_are_kept() {
        let mut history = History::default();
        for k in 0..150 {
            history.add(change(&k.to_string(), &(k + 1).to_string(), ""));
        }
        let undone = std::iter::from_fn(|| history.undo()).count();
        assert_eq!(undone, MOST);
        assert_eq!(history.counts(), [0, MOST]);
    }
}
