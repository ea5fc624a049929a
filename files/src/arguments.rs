//! Arguments that all programs have: limits of memory and threads, and what is printed and replaced.

use crate::exit::{Exit, Failure};
use crate::{Ledger, memory, progress};
use clap::Args;
use clap::builder::TypedValueParser;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::sync::atomic::{AtomicBool, Ordering};
use thiserror::Error;

/// Arguments of every command that works on files. `#[command(flatten)]` adds them to a program.
#[derive(Debug, Args)]
pub struct CommonArguments {
    /// Most memory to use, in bytes or with k, M or G. A larger request is refused before the work
    /// starts [default: 90 % of the free memory]
    #[arg(long, value_name = "BYTES", value_parser = memory::bytes)]
    max_memory: Option<u64>,
    /// Worker threads, 1 to 1024; the result does not depend on them [default: one for each core]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024).map(usize::from))]
    threads: Option<usize>,
    /// Progress on standard error
    #[arg(
        long,
        value_enum,
        default_value_t,
        hide_possible_values = true,
        value_name = "bar|plain|json|none"
    )]
    progress: progress::Mode,
    /// Print only errors: no notes, no progress and no lines about written files
    #[arg(short, long)]
    pub quiet: bool,
    /// Fail if an output exists
    #[arg(long)]
    no_clobber: bool,
}

/// The system does not provide the requested threads.
#[derive(Debug, Error)]
#[error("cannot start {threads} threads: {source}")]
pub struct ThreadsError {
    threads: usize,
    source: ThreadPoolBuildError,
}

impl Failure for ThreadsError {
    fn exit(&self) -> Exit {
        Exit::Resource
    }
}

/// True once [`CommonArguments::start_threads`] has started the threads of the process.
static STARTED: AtomicBool = AtomicBool::new(false);

impl CommonArguments {
    /// Sets the memory limit and the form of progress of this process. Call this function before any file is read.
    pub fn begin(&self) {
        progress::choose(self.progress);
        memory::allow(self.max_memory);
    }

    /// Returns whether existing files may be replaced.
    #[must_use]
    pub fn clobber(&self) -> bool {
        !self.no_clobber
    }

    /// Makes the ledger of the files that the command reads and writes.
    #[must_use]
    pub fn ledger(&self) -> Ledger {
        Ledger::new(self.clobber())
    }

    /// Returns a pool of as many threads as the arguments request, or of one for each core.
    ///
    /// # Errors
    /// When the system does not provide the threads.
    pub fn pool(&self) -> Result<ThreadPool, ThreadsError> {
        let threads = self.threads.unwrap_or(0);
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|source| ThreadsError { threads, source })
    }

    /// Starts as many threads for the whole process as the arguments request. Of several calls the first counts.
    ///
    /// # Errors
    /// When the system does not provide the threads.
    pub fn start_threads(&self) -> Result<(), ThreadsError> {
        let Some(threads) = self.threads.filter(|_| !STARTED.swap(true, Ordering::Relaxed)) else {
            return Ok(());
        };
        let started = ThreadPoolBuilder::new().num_threads(threads).build_global();
        started.map_err(|source| ThreadsError { threads, source })
    }
}
