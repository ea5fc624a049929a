//! The program `pipeline`: from curves to pictures in one process.

mod cli;

use clap::Parser;
use peak_alloc::PeakAlloc;
use std::process::ExitCode;

/// Counts the memory that is held, for the report.
#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    files::exit::run("pipeline", || cli::run(&arguments))
}
