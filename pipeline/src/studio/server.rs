//! The server of the studio: its address, its token and its threads.

use super::board::Board;
use super::guard::{self, Guard};
use super::routes::{self, LARGEST, Studio};
use super::{assets, spec_check, worker};
use axum::extract::DefaultBodyLimit;
use axum::middleware;
use axum::routing::{Router, get};
use files::{Exit, Failure};
use rayon::ThreadPool;
use std::io;
use std::net::Ipv4Addr;
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;
use tokio::net::TcpListener;

/// Time between two looks at the opened files.
const LOOK: Duration = Duration::from_millis(500);

/// A reason why the server does not run.
#[derive(Debug, Error)]
pub enum ServerError {
    /// The port cannot be used.
    #[error(
        "cannot listen on port {port} of this machine: {source}; choose another one with --port"
    )]
    Port {
        /// The port; 0 for any.
        port: u16,
        /// The error of the system.
        source: io::Error,
    },
    /// The system gives no threads, no random numbers or no connections.
    #[error("cannot serve the page: {0}")]
    System(String),
}

impl Failure for ServerError {
    fn exit(&self) -> Exit {
        match self {
            Self::Port { .. } => Exit::Use,
            Self::System(_) => Exit::Resource,
        }
    }
}

/// Serves the page until the program ends. `announce` gets the address.
///
/// The server listens on the loopback address only. A `port` of 0 lets the system choose one.
///
/// # Errors
/// When the port cannot be used, or the system refuses threads.
pub fn serve(
    board: &Arc<Board>,
    pool: &Arc<ThreadPool>,
    port: u16,
    token: &str,
    announce: impl FnOnce(&str) -> Result<(), files::FileError>,
) -> Result<(), files::Report> {
    let system = |error: io::Error| ServerError::System(error.to_string());
    // The threads that render are those of `pool`; requests need one.
    let runtime =
        tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(system)?;
    let listener = runtime.block_on(TcpListener::bind((Ipv4Addr::LOCALHOST, port)));
    let listener = listener.map_err(|source| ServerError::Port { port, source })?;
    let port = listener.local_addr().map_err(system)?.port();
    for (name, work) in threads(board, pool) {
        std::thread::Builder::new().name(name.into()).spawn(work).map_err(system)?;
    }
    let instance = super::token::drawn()?;
    let studio = Studio { board: board.clone(), pool: pool.clone(), instance };
    let router = Router::new()
        .route(&format!("/{token}/"), get(|| async { assets::serve("index.html") }))
        .nest(&format!("/{token}"), routes::router(Arc::new(studio)))
        .layer(DefaultBodyLimit::max(LARGEST))
        .layer(middleware::from_fn_with_state(Guard::new(port), guard::check));
    announce(&format!("http://127.0.0.1:{port}/{token}/"))?;
    let served = runtime.block_on(async { axum::serve(listener, router).await });
    board.end();
    Ok(served.map_err(system)?)
}

type Work = Box<dyn FnOnce() + Send>;

/// Returns the threads beside the server, with their names.
fn threads(board: &Arc<Board>, pool: &Arc<ThreadPool>) -> [(&'static str, Work); 3] {
    let (own, threads) = (board.clone(), pool.clone());
    let pictures: Work = Box::new(move || worker::run(&own, &threads));
    let own = board.clone();
    let checks: Work = Box::new(move || spec_check::run(&own));
    let own = board.clone();
    let looks: Work = Box::new(move || {
        loop {
            std::thread::sleep(LOOK);
            let mut state = own.state();
            if state.texts.look(&own.folder) {
                own.changed(state);
            }
        }
    });
    [("pictures", pictures), ("checks", checks), ("files", looks)]
}
