//! Arguments of every command that renders.

use clap::Args;
use clap::builder::TypedValueParser;
use files::{Exit, Failure, Ledger};
use rayon::ThreadPool;
use thiserror::Error;

/// The system does not provide the requested threads.
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

/// Arguments of every command that renders.
#[derive(Debug, Args)]
pub struct CommonArguments {
    /// Most memory to use, in bytes or with k, M or G. A larger request is refused before the work
    /// starts [default: 90 % of the free memory]
    #[arg(long, value_name = "BYTES", value_parser = files::memory::bytes)]
    max_memory: Option<u64>,
    /// Worker threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024).map(usize::from))]
    threads: Option<usize>,
    /// Progress on standard error
    #[arg(
        long,
        value_enum,
        default_value_t,
        hide_possible_values = true,
        value_name = "bar|plain|json|none"
    )]
    progress: files::progress::Mode,
    /// Print only errors
    #[arg(short, long)]
    pub quiet: bool,
    /// Fail if an output exists
    #[arg(long)]
    no_clobber: bool,
}

impl CommonArguments {
    /// Sets the memory limit and the form of progress of this process. Call this function before any file is read.
    pub fn limit_memory(&self) {
        files::progress::choose(self.progress);
        files::memory::allow(self.max_memory);
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

    /// Starts the number of threads that the arguments request, or one for each core.
    ///
    /// # Errors
    /// When the system does not provide the threads.
    pub fn pool(&self) -> Result<ThreadPool, ThreadsError> {
        let threads = self.threads.unwrap_or(0);
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|source| ThreadsError { threads, source })
    }
}
