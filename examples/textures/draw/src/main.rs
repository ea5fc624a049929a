//! The program `draw-textures`: writes the textures of the examples.

use clap::Parser;
use draw_textures::{TEXTURES, Texture};
use files::exit::{self, say};
use files::{FileError, Output, Report};
use std::path::PathBuf;
use std::process::ExitCode;

/// Draw the textures of the examples again.
#[derive(Debug, Parser)]
#[command(version)]
struct Arguments {
    /// The folder for the pictures; made if it is missing
    #[arg(short, long, value_name = "DIR", default_value = "textures")]
    output: PathBuf,
    /// Refuse to replace existing files
    #[arg(long)]
    no_clobber: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    exit::run("draw-textures", || draw(&arguments))
}

fn draw(arguments: &Arguments) -> Result<(), Report> {
    let folder = &arguments.output;
    std::fs::create_dir_all(folder)
        .map_err(|source| FileError::Write { name: folder.display().to_string(), source })?;
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
