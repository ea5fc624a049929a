//! `fuzz`: mutated inputs for every reader of the workspace.
//!
//! The parent process hands out cases, and child processes of the same program try them. So an
//! input that ends a process (a stack overflow, missing memory) or stalls it ends or stalls a child
//! only. A case depends on the seed, the reader and its number alone, so the case can be tried
//! again.
//!
//! | module       | what                                                             |
//! |--------------|------------------------------------------------------------------|
//! | [`cli`]      | the flags                                                        |
//! | [`error`]    | the error of the program                                         |
//! | [`dice`]     | random numbers of a case                                         |
//! | [`seeds`]    | the inputs from which mutation starts                            |
//! | [`mutate`]   | the mutations of inputs                                          |
//! | [`reader`]   | the readers, and the work on an input                            |
//! | [`verdict`]  | the definition of a fault                                        |
//! | [`worker`]   | the child's side: tries inputs, and measures them                |
//! | [`watch`]    | ends a child that takes too long                                 |
//! | [`child`]    | the parent's side of one child                                   |
//! | [`protocol`] | the lines that parent and child exchange                         |
//! | [`schedule`] | the selection of the next cases                                  |
//! | [`run`]      | all children, until the cases or the seconds are used up         |
//! | [`tally`]    | the results, as a table                                          |
//! | [`minimize`] | a small input with the same fault                                |

mod child;
mod cli;
mod dice;
mod error;
mod minimize;
mod mutate;
mod protocol;
mod reader;
mod run;
mod schedule;
mod seeds;
mod tally;
mod verdict;
mod watch;
mod worker;

use clap::Parser;
use files::exit::say;
use peak_alloc::PeakAlloc;
use std::process::ExitCode;

/// Counts the memory that a case takes.
#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// The exit code when a fault was found.
const FOUND: u8 = 1;

/// The exit code when the fuzzer itself could not work.
const FAILED: u8 = 5;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    match cli::run(&arguments) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::from(FOUND),
        Err(error) => {
            say(format_args!("fuzz: {error}"));
            ExitCode::from(FAILED)
        }
    }
}
