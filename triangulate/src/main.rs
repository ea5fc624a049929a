//! The program `triangulate`: a grid of `sweep` to triangles, as OBJ, STL or PLY.

mod cli;

use clap::{CommandFactory, Parser};
use std::process::ExitCode;

fn main() -> ExitCode {
    if let Some(code) = files::shell::answer(cli::Arguments::command()) {
        return code;
    }
    let arguments = cli::Arguments::parse();
    files::exit::run("triangulate", || cli::run(&arguments))
}
