//! The program `triangulate`: a grid of `sweep` to triangles, as OBJ, STL or PLY.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    files::exit::run("triangulate", || cli::run(&arguments))
}
