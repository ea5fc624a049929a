//! The requests of the page.

use super::board::{Board, Question, State};
use super::edit::{self, Edit};
use super::opened::Opened;
use super::texts::Texts;
use super::view::View;
use super::{assets, export, start, upload};
use axum::Json;
use axum::body::Bytes;
use axum::extract::{DefaultBodyLimit, Path, State as Shared};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::sse::{self, Sse};
use axum::response::{IntoResponse, Response};
use axum::routing::{Router, get, post};
use futures_util::stream::{self, Stream};
use rayon::ThreadPool;
use serde::Deserialize;
use serde_json::{Value, json};
use std::convert::Infallible;
use std::path::Path as FilePath;
use std::sync::Arc;
use std::sync::MutexGuard;
use std::time::Duration;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::oneshot;

/// The largest request, in bytes.
pub const LARGEST: usize = 8 << 20;

/// Windows that are open at the same time.
const WINDOWS: usize = 16;

/// Time between signs of life to a window.
const BEAT: Duration = Duration::from_secs(4);

/// The data of all requests.
#[derive(Debug)]
pub struct Studio {
    /// The shared state.
    pub board: Arc<Board>,
    /// The threads for exports.
    pub pool: Arc<ThreadPool>,
    /// A word that differs in each run of the program, so that a page notices a new run.
    pub instance: String,
}

type Own = Shared<Arc<Studio>>;
type Answer = Result<Json<Value>, Refusal>;

/// A request that cannot be served, with the reason.
#[derive(Debug)]
pub struct Refusal(String);

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        (StatusCode::UNPROCESSABLE_ENTITY, Json(json!({ "message": self.0 }))).into_response()
    }
}

impl From<String> for Refusal {
    fn from(reason: String) -> Self {
        Self(reason)
    }
}

/// Returns the routes below the token.
pub fn router(studio: Arc<Studio>) -> Router {
    Router::new()
        .route("/page/{name}", get(|Path(name): Path<String>| async move { assets::serve(&name) }))
        .route("/api/start", get(listed))
        .route("/api/events", get(events))
        .route("/api/picture/{id}", get(picture))
        .route("/api/schema/{kind}", get(schema))
        .route("/api/open", post(open))
        .route("/api/close", post(close))
        .route("/api/copy", post(copy))
        .route("/api/new", post(new))
        .route("/api/edit", post(edit))
        .route("/api/text", post(text))
        .route("/api/step", post(step))
        .route("/api/save", post(save))
        .route("/api/settle", post(settle))
        .route("/api/view", post(view))
        .route("/api/pixel", post(pixel))
        .route("/api/export", post(exported))
        .route(
            "/api/picture/{beside}/{name}",
            post(given).layer(DefaultBodyLimit::max(upload::LARGEST)),
        )
        .with_state(studio)
}

async fn listed(Shared(studio): Own) -> Answer {
    let board = studio.board.clone();
    let mut found = blocking(move || Ok(start::listed(&board.folder))).await?;
    found["instance"] = json!(studio.instance);
    Ok(Json(found))
}

/// The events of a window: those that a new window needs, then all that follow.
async fn events(
    Shared(studio): Own,
) -> Result<Sse<impl Stream<Item = Result<sse::Event, Infallible>>>, Refusal> {
    if studio.board.windows() >= WINDOWS {
        return Err(Refusal(format!("{WINDOWS} windows are open already: close one of them")));
    }
    let (before, receiver) = studio.board.listen();
    let hello: (_, Arc<str>) = ("hello", json!({ "instance": studio.instance }).to_string().into());
    let known: Vec<_> = std::iter::once(hello).chain(before).collect();
    let follow = stream::unfold((known.into_iter(), receiver), |(mut known, mut receiver)| async {
        if let Some((name, data)) = known.next() {
            return Some((event(name, &data), (known, receiver)));
        }
        match receiver.recv().await {
            Ok((name, data)) => Some((event(name, &data), (known, receiver))),
            // A window that lags asks for everything again.
            Err(RecvError::Lagged(_)) => Some((event("lagged", "null"), (known, receiver))),
            Err(RecvError::Closed) => None,
        }
    });
    Ok(Sse::new(follow).keep_alive(sse::KeepAlive::new().interval(BEAT).text("alive")))
}

fn event(name: &str, data: &str) -> Result<sse::Event, Infallible> {
    Ok(sse::Event::default().event(name).data(data))
}

async fn picture(Shared(studio): Own, Path(id): Path<u64>) -> Response {
    match studio.board.picture(id) {
        Some(png) => ([(CONTENT_TYPE, "image/png")], png.to_vec()).into_response(),
        None => (StatusCode::NOT_FOUND, "a newer picture has replaced it").into_response(),
    }
}

async fn schema(Path(kind): Path<String>) -> Answer {
    match kind.as_str() {
        "spec" => Ok(Json(sweep::schema::of_spec())),
        "scene" => Ok(Json(render::scene::schema::of_scene())),
        _ => Err(Refusal(format!("there is no schema of \"{kind}\""))),
    }
}

#[derive(Debug, Deserialize)]
struct Named {
    name: String,
}

async fn open(Shared(studio): Own, Json(Named { name }): Json<Named>) -> Answer {
    let board = studio.board.clone();
    blocking(move || open_file(&board, &name)).await.map(Json)
}

/// Opens a file in place of the one that is open. The page asks before changes that are not saved are lost.
///
/// # Errors
/// When the file or one that it names cannot be read. The error is a sentence.
pub fn open_file(board: &Board, path: &str) -> Result<Value, String> {
    let mut texts = Texts::default();
    let opened = Opened::open(&board.folder, path, &mut texts)?;
    let mut state = board.state();
    (state.opened, state.texts, state.is_moving) = (Some(opened), texts, false);
    board.changed(state);
    Ok(json!({ "path": path }))
}

async fn close(Shared(studio): Own) -> Answer {
    let mut state = studio.board.state();
    (state.opened, state.texts) = (None, Texts::default());
    studio.board.changed(state);
    Ok(Json(json!({})))
}

async fn copy(Shared(studio): Own, Json(Named { name }): Json<Named>) -> Answer {
    let board = studio.board.clone();
    blocking(move || open_file(&board, &start::copy(&board.folder, &name)?)).await.map(Json)
}

async fn new(Shared(studio): Own, Json(Named { name }): Json<Named>) -> Answer {
    let board = studio.board.clone();
    blocking(move || open_file(&board, &start::new(&board.folder, &name)?)).await.map(Json)
}

#[derive(Debug, Deserialize)]
struct Edited {
    file: String,
    edits: Vec<Edit>,
    /// A word for all edits of one gesture; empty for a step of its own.
    #[serde(default)]
    gesture: String,
    /// True once the gesture ends.
    #[serde(default)]
    ends: bool,
}

async fn edit(Shared(studio): Own, Json(edited): Json<Edited>) -> Answer {
    let mut state = studio.board.state();
    let text = state.texts.get(&edited.file).map(|text| text.now.clone());
    let text = text.ok_or_else(|| format!("{} is not open", edited.file))?;
    let now = edit::apply(&text, &edited.edits)?;
    state.texts.set(&edited.file, &now, &edited.gesture)?;
    state.is_moving = !edited.gesture.is_empty() && !edited.ends;
    follow(&studio.board, state)
}

#[derive(Debug, Deserialize)]
struct Typed {
    file: String,
    text: String,
    /// The text that the window had before the user typed.
    base: String,
    #[serde(default)]
    gesture: String,
}

async fn text(Shared(studio): Own, Json(typed): Json<Typed>) -> Answer {
    let mut state = studio.board.state();
    let now = state.texts.get(&typed.file).map(|text| text.now.clone());
    if now.is_some_and(|now| *now != *typed.base) {
        return Err(Refusal("the text was changed elsewhere meanwhile; it is shown now".into()));
    }
    state.texts.set(&typed.file, &typed.text, &typed.gesture)?;
    state.is_moving = false;
    follow(&studio.board, state)
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Direction {
    Undo,
    Redo,
}

async fn step(Shared(studio): Own, Json(direction): Json<Direction>) -> Answer {
    let mut state = studio.board.state();
    match direction {
        Direction::Undo => state.texts.undo(),
        Direction::Redo => state.texts.redo(),
    }
    state.is_moving = false;
    follow(&studio.board, state)
}

/// Follows the names of specs and scenes that a text may have changed, and announces the change.
fn follow(board: &Board, mut state: MutexGuard<'_, State>) -> Answer {
    if let Some(main) = state.opened.as_ref().map(|opened| opened.main.clone()) {
        let State { texts, opened, .. } = &mut *state;
        // A text with a fault keeps the files that were open before.
        if let Ok(new) = Opened::open(&board.folder, &main, texts) {
            *opened = Some(new);
        }
    }
    board.changed(state);
    Ok(Json(json!({ "revision": board.now().map(|now| now.revision) })))
}

#[derive(Debug, Deserialize)]
struct Saved {
    /// The file; all changed files if it is left out.
    file: Option<String>,
    /// The new path of the file, for a copy of it.
    to: Option<String>,
}

async fn save(Shared(studio): Own, Json(saved): Json<Saved>) -> Answer {
    let board = studio.board.clone();
    let save = move || {
        let mut state = board.state();
        if let (Some(file), Some(to)) = (&saved.file, &saved.to) {
            let text = state.texts.get(file).ok_or_else(|| format!("{file} is not open"))?;
            if !to.ends_with(".json") {
                return Err(format!("found {to}, expected a name that ends in .json"));
            }
            if board.folder.stamp(FilePath::new(to)).is_some() {
                return Err(format!("{to} exists already: choose another name"));
            }
            let written = board.folder.write(FilePath::new(to), text.now.as_bytes());
            written.map_err(|error| error.to_string())?;
            drop(state);
            return open_file(&board, to);
        }
        let changed = |(path, text): (&String, &super::texts::Text)| {
            let is_wanted = saved.file.as_ref().is_none_or(|file| file == path);
            (is_wanted && text.is_changed()).then(|| path.clone())
        };
        let files: Vec<String> = state.texts.iter().filter_map(changed).collect();
        let done: Result<Vec<()>, String> =
            files.iter().map(|file| state.texts.save(&board.folder, file)).collect();
        board.changed(state);
        done.map(|_| json!({ "saved": files }))
    };
    blocking(save).await.map(Json)
}

#[derive(Debug, Deserialize)]
struct Settled {
    file: String,
    /// True to keep the text of the page, false to take that of the file.
    mine: bool,
}

async fn settle(Shared(studio): Own, Json(settled): Json<Settled>) -> Answer {
    let mut state = studio.board.state();
    state.texts.settle(&settled.file, settled.mine);
    follow(&studio.board, state)
}

async fn view(Shared(studio): Own, Json(view): Json<View>) -> Answer {
    view.check()?;
    let mut state = studio.board.state();
    if state.view != view {
        state.view = view;
        studio.board.changed(state);
    }
    Ok(Json(json!({})))
}

#[derive(Debug, Deserialize)]
struct At {
    x: u32,
    y: u32,
}

async fn pixel(Shared(studio): Own, Json(At { x, y }): Json<At>) -> Answer {
    let (answer, receiver) = oneshot::channel();
    studio.board.ask(Question { pixel: (x, y), answer });
    let text = receiver.await.map_err(|_| "the picture has changed".to_string())??;
    Ok(Json(json!({ "text": text })))
}

/// Takes a picture, which becomes a file beside another one.
async fn given(
    Shared(studio): Own,
    Path((beside, name)): Path<(String, String)>,
    bytes: Bytes,
) -> Answer {
    let board = studio.board.clone();
    blocking(move || upload::picture(&board.folder, &beside, &name, &bytes)).await.map(Json)
}

#[derive(Debug, Deserialize)]
struct Wanted {
    /// The path of the file, whose extension says the format.
    path: String,
    /// The name of the mesh, for a mesh file.
    #[serde(default)]
    mesh: String,
}

async fn exported(Shared(studio): Own, Json(wanted): Json<Wanted>) -> Answer {
    let (board, pool) = (studio.board.clone(), studio.pool.clone());
    let make = move || {
        let snapshot = board.now().ok_or("nothing is open")?;
        let path = FilePath::new(&wanted.path);
        if snapshot.source.texts.contains_key(&super::folder::slashed(path)) {
            return Err("an export must not replace an opened file: choose another name".into());
        }
        if board.state().texts.iter().any(|(_, text)| text.is_changed()) {
            return Err("save the changed files first: the commands read the saved files".into());
        }
        let made =
            pool.install(|| export::export(&snapshot, &board.folder, &wanted.path, &wanted.mesh))?;
        board.folder.write(path, &made.bytes).map_err(|error| error.to_string())?;
        Ok(json!({ "path": wanted.path, "bytes": made.bytes.len(), "commands": made.commands }))
    };
    blocking(make).await.map(Json)
}

/// Runs work that reads files or renders, on a thread of its own.
async fn blocking(
    work: impl FnOnce() -> Result<Value, String> + Send + 'static,
) -> Result<Value, Refusal> {
    match tokio::task::spawn_blocking(work).await {
        Ok(done) => Ok(done?),
        Err(_) => Err(Refusal("this is a bug in pipeline; please report it with the input".into())),
    }
}
