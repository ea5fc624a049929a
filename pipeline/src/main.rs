//! The program `pipeline`: from curves to pictures in one process.

use std::process::ExitCode;

fn main() -> ExitCode {
    pipeline::cli::main(None)
}
