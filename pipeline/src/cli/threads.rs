//! The threads that a command works with.

use files::{Exit, Failure};
use rayon::ThreadPool;
use thiserror::Error;

/// The threads asked for cannot be had.
#[derive(Debug, Error)]
#[error("cannot start {threads} threads: {source}")]
pub struct ThreadsError {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

impl Failure for ThreadsError {
    fn exit(&self) -> Exit {
        Exit::Resource
    }
}

/// As many threads as were asked for, or one for each core.
///
/// # Errors
/// When the system does not give them.
pub fn pool(asked: Option<usize>) -> Result<ThreadPool, ThreadsError> {
    let threads = asked.unwrap_or(0);
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|source| ThreadsError { threads, source })
}
