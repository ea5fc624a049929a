//! The program `pipeline`: from curves to pictures in one process.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    files::exit::run("pipeline", || cli::run(&arguments))
}
