//! `pipeline textures`: the textures of the examples.

use super::make_folder;
use clap::Args;
use files::exit::say;
use files::{Output, Report};
use pipeline::textures::{TEXTURES, Texture};
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
    let clobber = !arguments.no_clobber;
    let path = |texture: &Texture| arguments.output.join(texture.file);
    for texture in &TEXTURES {
        Output::check(&path(texture), clobber)?;
    }
    for texture in &TEXTURES {
        Output::create(&path(texture), clobber)?.commit_all(&texture.png()?)?;
        say(path(texture).display());
    }
    Ok(())
}
