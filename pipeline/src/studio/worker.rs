//! The thread that makes pictures: a draft at once, then the whole picture, then the requested error.
//!
//! A draft is small and has coarse meshes while a handle moves. Its size follows the time that the last drafts took.
//! Later steps stop as soon as the state changes. A scene and its structures stay while only the camera moves.

use super::board::{Board, Question, Snapshot, Task};
use super::folder::slashed;
use super::kept::{Files, Kept, position};
use super::mesh::Finish;
use super::{curves, png};
use crate::PipelineError;
use files::memory::of_process;
use rayon::ThreadPool;
use render::accuracy::{Request, Statement};
use render::color::Encoding;
use render::film::{Course, PixelFilter, memory, render_while};
use render::filter::Filter;
use render::{Picture, Prepared, Sampling, Settings, inspect};
use serde_json::{Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Time that a draft should take, in seconds.
const DRAFT: f64 = 0.03;

/// Least weight of a ray in a draft. Mirrors in mirrors and the faint rays of glass are left out.
const FOLLOWED: f64 = 0.1;

/// Fewest pixels of a draft.
const FEWEST: f64 = 64.0 * 64.0;

/// Time for which a moving handle is awaited before finer work starts.
const PATIENCE: Duration = Duration::from_millis(220);

/// Time between two tellings of the curves while a handle moves.
const CURVES: Duration = Duration::from_millis(120);

/// Time between two reports of progress.
const REPORTS: Duration = Duration::from_millis(80);

/// Makes pictures until the board ends.
pub fn run(board: &Board, pool: &ThreadPool) {
    let mut worker =
        Worker { board, kept: None, seconds_per_pixel: [2e-6; 2], drawn: 0, told: Instant::now() };
    let mut carried: Option<Snapshot> = None;
    let mut seen = 0;
    loop {
        let snapshot = match carried.take() {
            Some(snapshot) => snapshot,
            None => match board.next(seen, true) {
                Task::Draw(snapshot) => *snapshot,
                Task::Answer(question) => {
                    refuse(question, "there is no picture yet");
                    continue;
                }
                Task::End => return,
            },
        };
        seen = snapshot.revision;
        // A panic is a bug of ours; the page stays usable and says so.
        let work = AssertUnwindSafe(|| pool.install(|| worker.serve(snapshot)));
        match catch_unwind(work) {
            Ok(Served::Next(next)) => {
                seen = next.revision;
                carried = Some(*next);
            }
            Ok(Served::Again(next)) => carried = Some(*next),
            Ok(Served::Done) => {}
            Ok(Served::End) => return,
            Err(_) => {
                worker.kept = None;
                let words = "this is a bug in pipeline; please report it with the input";
                board.tell("fault", &json!({ "message": words }));
            }
        }
    }
}

/// The result of the work on a scene.
enum Served {
    /// A state that needs another scene.
    Next(Box<Snapshot>),
    /// The same state, whose draft is done, and whose stated meshes are wanted.
    Again(Box<Snapshot>),
    /// The state has a fault.
    Done,
    /// The program ends.
    End,
}

struct Worker<'b> {
    board: &'b Board,
    kept: Option<Kept>,
    /// Time of a draft's pixel, with draft meshes and with stated ones.
    seconds_per_pixel: [f64; 2],
    /// The last revision whose draft is done.
    drawn: u64,
    /// The time when the curves were told last.
    told: Instant,
}

impl Worker<'_> {
    /// Makes the pictures of a state, and of those after it that show the same scene.
    fn serve(&mut self, mut snapshot: Snapshot) -> Served {
        let board = self.board;
        let Some(mut files) = self.read(&snapshot) else { return Served::Done };
        let is_stated = |kept: &Kept| kept.shows(&files, Finish::Stated);
        let is_drawn = self.drawn == snapshot.revision;
        let finish = match &self.kept {
            Some(kept) if is_stated(kept) => Finish::Stated,
            _ if is_drawn => Finish::Stated,
            _ => Finish::Draft,
        };
        let started = Instant::now();
        let made = Kept::make(&mut self.kept, &files, &snapshot.source, finish);
        let mut making = started.elapsed();
        if !self.judge(made) {
            return Served::Done;
        }
        let Some(mut kept) = self.kept.take() else { return Served::Done };
        let stock = kept.take_stock();
        let is_stated = kept.shows(&files, Finish::Stated);
        let (result, left) = {
            let prepared = Prepared::stocked(&kept.scene, stock);
            let result = loop {
                if self.drawn != snapshot.revision {
                    self.draft(&prepared, &files, &snapshot, (is_stated, making));
                    making = Duration::ZERO;
                    self.drawn = snapshot.revision;
                    // The editors draw the moving handle themselves, so their curves may come less often.
                    if !snapshot.is_moving || self.told.elapsed() >= CURVES {
                        curves::tell(board, &snapshot, &kept.objects);
                        self.told = Instant::now();
                    }
                }
                let mut is_refined = false;
                let next = loop {
                    if !board.is_newer(snapshot.revision) {
                        if !is_stated {
                            if snapshot.is_moving {
                                board.linger(snapshot.revision, PATIENCE);
                            }
                            if !board.is_newer(snapshot.revision) {
                                break None;
                            }
                        } else if !is_refined {
                            is_refined = self.refine(&prepared, &files, &snapshot);
                            continue;
                        }
                    }
                    match board.next(snapshot.revision, true) {
                        Task::Draw(next) => break Some(next),
                        Task::Answer(question) => answer(question, &prepared, &files, &snapshot),
                        Task::End => return Served::End,
                    }
                };
                let Some(next) = next else { break Served::Again(Box::new(snapshot)) };
                let Some(new) = self.read(&next) else { break Served::Next(next) };
                let finish = if is_stated { Finish::Stated } else { Finish::Draft };
                if !kept.shows(&new, finish) {
                    break Served::Next(next);
                }
                (snapshot, files) = (*next, new);
            };
            (result, prepared.into_stock())
        };
        kept.keep(left);
        self.kept = Some(kept);
        result
    }

    /// Reads the files of a state, or tells their fault.
    fn read(&self, snapshot: &Snapshot) -> Option<Files> {
        let read = Files::read(&snapshot.opened.job, &snapshot.source, snapshot.view.pixels());
        match read {
            Ok(files) => Some(files),
            Err(error) => {
                self.judge(Err(error));
                None
            }
        }
    }

    /// Tells the windows of a fault, or that there is none. Returns whether there is none.
    fn judge(&self, made: Result<(), PipelineError>) -> bool {
        match made {
            Ok(()) => {
                self.board.tell("fault", &Value::Null);
                true
            }
            Err(error) => {
                self.board.tell("fault", &fault(&error));
                false
            }
        }
    }

    /// Shows a small picture at once.
    fn draft(
        &mut self,
        prepared: &Prepared<'_>,
        files: &Files,
        snapshot: &Snapshot,
        (is_stated, making): (bool, Duration),
    ) {
        let (width, height) = snapshot.view.pixels();
        let all = f64::from(width) * f64::from(height);
        let known = &mut self.seconds_per_pixel[usize::from(is_stated)];
        let part = ((DRAFT / *known).max(FEWEST) / all).sqrt().min(1.0);
        let side = |side: u32| ((f64::from(side) * part).round() as u32).max(1);
        let (width, height) = (side(width), side(height));
        let settings = Settings {
            camera: Some(files.camera),
            least_weight: Some(FOLLOWED),
            ..Settings::new(width, height, Filter::Mip)
        };
        let started = Instant::now();
        let (picture, _) = render_while(prepared, &settings, &Course::told(&|_, _| {}));
        let spent = started.elapsed().as_secs_f64() / f64::from(width * height);
        // A slow draft shrinks the next one at once, and a fast one lets it grow slowly.
        *known = if spent > *known { spent } else { 0.7 * *known + 0.3 * spent };
        let [waited, meshes, spent] =
            [snapshot.waited, making, started.elapsed()].map(|time| time.as_secs_f64() * 1e3);
        let times = json!({ "waited": waited, "meshes": meshes, "picture": spent });
        self.show("draft", &picture, snapshot, (None, times));
    }

    /// Shows the whole picture, then that of the requested error, then that of the method beside it. Returns false if
    /// the work was ended early.
    fn refine(&self, prepared: &Prepared<'_>, files: &Files, snapshot: &Snapshot) -> bool {
        let board = self.board;
        let go_on = || !board.is_newer(snapshot.revision);
        let camera = Some(files.camera);
        let settings = Settings { camera, ..snapshot.view.settings() };
        let reserved = memory::reserve(prepared.scene(), &settings, None, of_process());
        let _reserved = match reserved {
            Ok(reserved) => reserved,
            Err(error) => {
                board.tell("fault", &json!({ "message": error.to_string() }));
                return true;
            }
        };
        let progress = Progress::new(board, snapshot.revision);
        let tell = |done, total| progress.tell("picture", done, total);
        let (picture, stats) =
            render_while(prepared, &settings, &Course { go_on: &go_on, ..Course::told(&tell) });
        if stats.unfinished > 0 || !go_on() {
            return false;
        }
        self.show("whole", &picture, snapshot, (None, Value::Null));
        if let Some(error) = snapshot.view.error {
            let tell = |step: &str, done, total| progress.tell(step, done, total);
            let request = Request::new(prepared, &settings, PixelFilter::Box);
            let request = Request { progress: &tell, go_on: &go_on, ..request };
            let Some(reached) = request.reach_or_leave(error) else { return false };
            self.show("exact", &reached.picture, snapshot, (Some(&reached.statement), Value::Null));
        }
        if let Some(method) = snapshot.view.beside {
            let settings = Settings { camera, ..method.settings(snapshot.view.pixels()) };
            let tell = |done, total| progress.tell("beside", done, total);
            let (picture, stats) =
                render_while(prepared, &settings, &Course { go_on: &go_on, ..Course::told(&tell) });
            if stats.unfinished > 0 {
                return false;
            }
            self.show("beside", &picture, snapshot, (None, Value::Null));
        }
        board.tell("progress", &json!({ "revision": snapshot.revision, "step": "done" }));
        true
    }

    fn show(
        &self,
        step: &str,
        picture: &Picture,
        snapshot: &Snapshot,
        (statement, times): (Option<&Statement>, Value),
    ) {
        let png = png::encoded(picture);
        let statement = statement.map(|statement| {
            json!({ "error": statement.error, "bound": statement.bound,
                "text": statement.to_string(), "missed": statement.missed })
        });
        let facts = json!({
            "revision": snapshot.revision, "step": step,
            "size": [picture.width, picture.height],
            "milliseconds": snapshot.since.elapsed().as_millis() as u64,
            "statement": statement,
            "times": times,
        });
        self.board.show(png, facts, if step == "beside" { "beside" } else { "picture" });
    }
}

/// Returns an error as the windows show it.
#[must_use]
pub fn fault(error: &PipelineError) -> Value {
    match position(error) {
        // Paths of a job start at its folder: `pages/../curves/vase.json`.
        Some(at) => {
            json!({ "file": slashed(Path::new(&at.file)), "line": at.line, "column": at.column,
            "path": at.path, "message": at.message })
        }
        None => json!({ "message": error.to_string() }),
    }
}

fn refuse(question: Question, words: &str) {
    // A window that was closed needs no answer.
    let _ = question.answer.send(Err(words.into()));
}

/// Answers a question with the settings of the whole picture.
fn answer(question: Question, prepared: &Prepared<'_>, files: &Files, snapshot: &Snapshot) {
    let settings = Settings { camera: Some(files.camera), ..snapshot.view.settings() };
    let (x, y) = question.pixel;
    if x >= settings.width || y >= settings.height {
        return refuse(question, "the pixel is not in the picture");
    }
    let settings = match settings.sampling {
        Sampling::Area { .. } => settings,
        _ => return refuse(question, "the picture has no areas"),
    };
    let text = inspect::pixel(prepared, &settings, (x, y), Encoding::Srgb, false);
    let _ = question.answer.send(Ok(text));
}

/// Reports of progress, at most some in a second.
struct Progress<'b> {
    board: &'b Board,
    revision: u64,
    last: Mutex<Instant>,
}

impl<'b> Progress<'b> {
    fn new(board: &'b Board, revision: u64) -> Self {
        Self { board, revision, last: Mutex::new(Instant::now()) }
    }

    fn tell(&self, step: &str, done: usize, total: usize) {
        // A thread that does not get the lock has no news.
        let Ok(mut last) = self.last.try_lock() else { return };
        if last.elapsed() >= REPORTS {
            *last = Instant::now();
            let facts =
                json!({ "revision": self.revision, "step": step, "done": done, "total": total });
            self.board.tell("progress", &facts);
        }
    }
}
