//! `pipeline textures`: the textures of the examples.

use super::{OTHER_FOLDER, make_folder};
use clap::Args;
use files::exit::say;
use files::{Batch, Ledger, Report};
use pipeline::textures::{TEXTURES, Texture};
use std::io::Write;
use std::path::PathBuf;

/// What `pipeline textures` is asked.
#[derive(Debug, Args)]
pub struct TexturesArguments {
    /// The folder for the pictures; made if it is missing
    #[arg(short, long, value_name = "DIR", default_value = "textures")]
    output: PathBuf,
    /// Refuse to replace existing files
    #[arg(long)]
    no_clobber: bool,
}

/// Draws the textures.
pub fn textures(arguments: &TexturesArguments) -> Result<(), Report> {
    make_folder(&arguments.output)?;
    let ledger = Ledger::new(!arguments.no_clobber);
    let path = |texture: &Texture| arguments.output.join(texture.file);
    for texture in &TEXTURES {
        ledger.claim(&path(texture), OTHER_FOLDER)?;
    }
    let files: Vec<PathBuf> = TEXTURES.iter().map(path).collect();
    let batch = Batch::new(&arguments.output, "textures", &files)?;
    if let Some(remark) = batch.remark() {
        say(format_args!("pipeline: note: {remark}"));
    }
    for texture in &TEXTURES {
        let mut output = ledger.create(&path(texture))?;
        output.write_all(&texture.png()?).map_err(|source| output.failed(source))?;
        batch.replace(output)?;
        say(path(texture).display());
    }
    Ok(batch.finish()?)
}
