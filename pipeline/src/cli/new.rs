//! `pipeline new`: writes an example to start from.

use crate::start::Start;
use clap::Args;
use files::exit::say;
use files::{Exit, Failure, Ledger, Report, input};
use std::path::PathBuf;
use thiserror::Error;

/// Arguments of `pipeline new`.
#[derive(Debug, Args)]
pub struct NewArguments {
    /// The example
    #[arg(value_enum)]
    example: Start,
    /// The file; - is standard output. A file that exists is never replaced [default: the example's name and .json]
    #[arg(short, long, value_name = "FILE.json")]
    output: Option<PathBuf>,
    /// Print only errors
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Error)]
enum UseError {
    #[error("{0} exists, and an example replaces no file: name another one with -o")]
    Exists(String),
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

/// Writes the example.
pub fn new(arguments: &NewArguments) -> Result<(), Report> {
    let NewArguments { example, output, quiet } = arguments;
    let file = output.clone().unwrap_or_else(|| format!("{}.json", example.name()).into());
    let to_stdout = input::is_stdin(&file);
    if !to_stdout && file.exists() {
        return Err(UseError::Exists(input::name_of(&file)).into());
    }
    let named = if to_stdout { format!("{}.json", example.name()).into() } else { file.clone() };
    let text = example.text(&named)?;
    Ledger::new(false).create(&file)?.commit_all(text.as_bytes())?;
    if !quiet && !to_stdout {
        say(format_args!("wrote {}", file.display()));
        say(format_args!("make its picture: {}", example.command(&file)));
    }
    Ok(())
}
