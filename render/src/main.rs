//! The program `render`: a scene and meshes to a picture.

mod cli;

use clap::{CommandFactory, Parser};
use std::process::ExitCode;

fn main() -> ExitCode {
    if let Some(code) = files::shell::answer(cli::Arguments::command()) {
        return code;
    }
    let arguments = cli::Arguments::parse();
    if arguments.watches() {
        return files::watch::repeat(
            "render",
            || arguments.ledger(),
            |ledger| cli::run(&arguments, ledger),
        );
    }
    files::exit::run("render", || cli::run(&arguments, &arguments.ledger()))
}
