//! The state that all windows of the studio share, and the revisions by which threads notice its changes.
//!
//! A revision is a number that grows with each change of a text or of the view. A thread that works for an older
//! revision stops. Windows hear of changes by events.

use super::folder::Folder;
use super::opened::Opened;
use super::source::Edited;
use super::texts::Texts;
use super::view::View;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::{broadcast, oneshot};

/// Events that a slow window may lag behind.
const BACKLOG: usize = 256;

/// Pictures that are kept for windows that fetch them late.
const PICTURES: usize = 12;

/// An event for the windows: its name and its data as JSON.
pub type Event = (&'static str, Arc<str>);

/// A question about one pixel, and the channel of its answer.
#[derive(Debug)]
pub struct Question {
    /// The pixel, from the upper left corner.
    pub pixel: (u32, u32),
    /// Takes the answer: the pixel's intersection tree as text, or an error in a sentence.
    pub answer: oneshot::Sender<Result<String, String>>,
}

/// The work that a thread waits for.
#[derive(Debug)]
pub enum Task {
    /// A state that is newer than the last one.
    Draw(Box<Snapshot>),
    /// A question about the picture that is shown.
    Answer(Question),
    /// The program ends.
    End,
}

/// The state at one revision.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// The revision.
    pub revision: u64,
    /// The opened files.
    pub opened: Opened,
    /// The files as they are edited.
    pub source: Edited,
    /// The view.
    pub view: View,
    /// True while a handle or the camera moves.
    pub is_moving: bool,
    /// The time of the last change.
    pub since: Instant,
    /// Time from the last change until a thread took up the state, after the end of obsolete work.
    pub waited: Duration,
}

/// The state that all windows share.
#[derive(Debug)]
pub struct State {
    /// The opened files, if any.
    pub opened: Option<Opened>,
    /// Their texts.
    pub texts: Texts,
    /// The view.
    pub view: View,
    /// True while a handle or the camera moves.
    pub is_moving: bool,
    questions: VecDeque<Question>,
    since: Instant,
    is_ended: bool,
    pictures: VecDeque<(u64, Arc<[u8]>)>,
    last_picture: u64,
    /// The last event of each name that a new window needs.
    latest: Vec<Event>,
}

/// The shared state with its lock and its events.
#[derive(Debug)]
pub struct Board {
    /// The opened folder.
    pub folder: Folder,
    state: Mutex<State>,
    wake: Condvar,
    revision: AtomicU64,
    questions: AtomicU64,
    events: broadcast::Sender<Event>,
}

impl Board {
    /// Makes a board for a folder, with nothing opened.
    #[must_use]
    pub fn new(folder: Folder) -> Self {
        let state = State {
            opened: None,
            texts: Texts::default(),
            view: View::default(),
            is_moving: false,
            questions: VecDeque::new(),
            since: Instant::now(),
            is_ended: false,
            pictures: VecDeque::new(),
            last_picture: 0,
            latest: Vec::new(),
        };
        let (events, _) = broadcast::channel(BACKLOG);
        let (revision, questions) = (AtomicU64::new(0), AtomicU64::new(0));
        Self { folder, state: Mutex::new(state), wake: Condvar::new(), revision, questions, events }
    }

    /// Locks the state.
    pub fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Announces a change of the locked state: wakes the threads and tells the windows.
    pub fn changed(&self, mut state: MutexGuard<'_, State>) {
        self.revision.fetch_add(1, Ordering::SeqCst);
        state.since = Instant::now();
        let shown = state.shown(self.revision.load(Ordering::SeqCst));
        self.tell_in(&mut state, "state", &shown);
        drop(state);
        self.wake.notify_all();
    }

    /// Tells the windows of an event.
    pub fn tell(&self, name: &'static str, data: &Value) {
        self.tell_in(&mut self.state(), name, data);
    }

    fn tell_in(&self, state: &mut State, name: &'static str, data: &Value) {
        let event = (name, Arc::from(data.to_string()));
        if name != "progress" {
            state.latest.retain(|(other, _)| *other != name);
            state.latest.push(event.clone());
        }
        // Without a window nobody listens.
        let _ = self.events.send(event);
    }

    /// Returns the events that a new window needs, and those that follow.
    pub fn listen(&self) -> (Vec<Event>, broadcast::Receiver<Event>) {
        let state = self.state();
        (state.latest.clone(), self.events.subscribe())
    }

    /// Returns the number of windows that listen.
    #[must_use]
    pub fn windows(&self) -> usize {
        self.events.receiver_count()
    }

    /// Keeps a picture for the windows, and tells them of it with `facts`.
    pub fn show(&self, png: Vec<u8>, mut facts: Value, name: &'static str) {
        let mut state = self.state();
        state.last_picture += 1;
        let id = state.last_picture;
        state.pictures.push_back((id, png.into()));
        if state.pictures.len() > PICTURES {
            state.pictures.pop_front();
        }
        facts["id"] = json!(id);
        self.tell_in(&mut state, name, &facts);
    }

    /// Returns a picture that was shown a short time ago.
    #[must_use]
    pub fn picture(&self, id: u64) -> Option<Arc<[u8]>> {
        let state = self.state();
        state.pictures.iter().find(|(own, _)| *own == id).map(|(_, png)| png.clone())
    }

    /// Returns whether work for this revision is obsolete, or must make room for a question.
    #[must_use]
    pub fn is_newer(&self, revision: u64) -> bool {
        self.revision.load(Ordering::Relaxed) != revision
            || self.questions.load(Ordering::Relaxed) > 0
    }

    /// Asks a question about the picture.
    pub fn ask(&self, question: Question) {
        let mut state = self.state();
        state.questions.push_back(question);
        self.questions.fetch_add(1, Ordering::SeqCst);
        drop(state);
        self.wake.notify_all();
    }

    /// Waits for work that is newer than a revision. Questions are answered only by the thread that `answers`.
    pub fn next(&self, revision: u64, answers: bool) -> Task {
        let mut state = self.state();
        loop {
            if state.is_ended {
                return Task::End;
            }
            if answers && let Some(question) = state.questions.pop_front() {
                self.questions.fetch_sub(1, Ordering::SeqCst);
                return Task::Answer(question);
            }
            let now = self.revision.load(Ordering::SeqCst);
            if now != revision
                && let Some(snapshot) = self.snapshot(&state, now)
            {
                return Task::Draw(Box::new(snapshot));
            }
            state = self.wake.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Waits until work for this revision is obsolete, at most for a time.
    pub fn linger(&self, revision: u64, most: Duration) {
        let state = self.state();
        let waits = |state: &mut State| !state.is_ended && !self.is_newer(revision);
        let _ = self.wake.wait_timeout_while(state, most, waits);
    }

    /// Returns the state at its revision, if a file is opened.
    #[must_use]
    pub fn now(&self) -> Option<Snapshot> {
        let state = self.state();
        self.snapshot(&state, self.revision.load(Ordering::SeqCst))
    }

    fn snapshot(&self, state: &State, revision: u64) -> Option<Snapshot> {
        let opened = state.opened.clone()?;
        let source = Edited { texts: state.texts.snapshot(), folder: self.folder.clone() };
        let (view, is_moving, since) = (state.view.clone(), state.is_moving, state.since);
        let waited = since.elapsed();
        Some(Snapshot { revision, opened, source, view, is_moving, since, waited })
    }

    /// Ends the threads that wait for work.
    pub fn end(&self) {
        self.state().is_ended = true;
        self.wake.notify_all();
    }
}

impl State {
    /// Returns the state as the windows show it.
    fn shown(&self, revision: u64) -> Value {
        let Some(opened) = &self.opened else {
            return json!({ "revision": revision, "files": [] });
        };
        let kind = |path: &str| match path {
            _ if path == opened.job => "job",
            _ if path == opened.scene => "scene",
            _ => "spec",
        };
        let file = |(path, text): (&String, &super::texts::Text)| {
            json!({
                "path": path,
                "kind": kind(path),
                "text": &*text.now,
                "changed": text.is_changed(),
                "new": text.saved.is_none(),
                "conflict": text.conflict.as_deref(),
            })
        };
        let files: Vec<Value> = self.texts.iter().map(file).collect();
        let specs: Vec<Value> =
            opened.specs.iter().map(|(name, path)| json!({ "name": name, "path": path })).collect();
        let [undo, redo] = self.texts.counts();
        json!({
            "revision": revision,
            "main": opened.main, "job": opened.job, "scene": opened.scene, "specs": specs,
            "files": files, "undo": undo, "redo": redo,
            "view": self.view,
        })
    }
}
