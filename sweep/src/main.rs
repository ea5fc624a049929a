//! The program `sweep`: a spec of curves in, a contour x trajectory grid out.

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
            "sweep",
            || arguments.ledger(),
            |ledger| cli::run(&arguments, ledger),
        );
    }
    files::exit::run("sweep", || cli::run(&arguments, &arguments.ledger()))
}
