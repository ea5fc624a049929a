//! `pipeline join`: puts the parts of a picture together.

use clap::Args;
use files::{Ledger, Report, Source, input};
use render::film::join::join as joined;
use std::path::PathBuf;

/// Arguments of `pipeline join`.
#[derive(Debug, Args)]
pub struct JoinArguments {
    /// The parts, which `render --tile` or `render --crop` made of one picture: .png or .exr files
    #[arg(required = true, value_name = "FILE")]
    parts: Vec<PathBuf>,
    /// The whole picture, in the format of the parts
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Fail if the picture file exists
    #[arg(long)]
    no_clobber: bool,
}

/// Joins the parts that the arguments name.
pub fn join(arguments: &JoinArguments) -> Result<(), Report> {
    let ledger = Ledger::new(!arguments.no_clobber);
    ledger.claim(&arguments.output, "name another file with -o")?;
    let read = |path: &PathBuf| Ok((input::name_of(path), ledger.read(path)?));
    let parts = arguments.parts.iter().map(read).collect::<Result<Vec<_>, Report>>()?;
    let bytes = joined(&parts)?;
    Ok(ledger.create(&arguments.output)?.commit_all(&bytes)?)
}
