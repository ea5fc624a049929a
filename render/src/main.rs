//! The program `render`: a scene and meshes to a picture.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    files::exit::run("render", || cli::run(&arguments))
}
