//! The program `sweep`: a spec of curves in, a contour x trajectory grid out.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    files::exit::run("sweep", || cli::run(&arguments))
}
