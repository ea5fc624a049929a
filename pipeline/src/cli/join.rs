//! `pipeline join`: puts the parts of a picture together.

use clap::Args;
use files::exit::wrote;
use files::{CommonArguments, Report, Source, input};
use render::film::join::join as joined;
use std::path::PathBuf;
use std::time::Instant;

/// Arguments of `pipeline join`.
#[derive(Debug, Args)]
pub struct JoinArguments {
    /// The parts, which `render --tile` or `render --crop` made of one picture: .png or .exr files
    #[arg(required = true, value_name = "FILE")]
    parts: Vec<PathBuf>,
    /// The whole picture, in the format of the parts
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    common: CommonArguments,
}

/// Joins the parts that the arguments name.
pub fn join(arguments: &JoinArguments) -> Result<(), Report> {
    let began = Instant::now();
    arguments.common.begin();
    let ledger = arguments.common.ledger();
    ledger.claim(&arguments.output, "name another file with -o")?;
    let read = |path: &PathBuf| Ok((input::name_of(path), ledger.read(path)?));
    let parts = arguments.parts.iter().map(read).collect::<Result<Vec<_>, Report>>()?;
    let bytes = joined(&parts)?;
    ledger.create(&arguments.output)?.commit_all(&bytes)?;
    if !arguments.common.quiet && !input::is_stdin(&arguments.output) {
        wrote(&arguments.output, None, began.elapsed());
    }
    Ok(())
}
