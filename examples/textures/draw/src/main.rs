//! The program `draw-textures`: writes the textures of the examples.

use clap::Parser;
use draw_textures::{TEXTURES, Texture};
use files::exit::{self, say};
use files::{Batch, FileError, Ledger, Report};
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

/// Draw the textures of the examples again.
#[derive(Debug, Parser)]
#[command(version)]
struct Arguments {
    /// The folder for the pictures; created if it is missing
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
    let ledger = Ledger::new(!arguments.no_clobber);
    let path = |texture: &Texture| folder.join(texture.file);
    for texture in &TEXTURES {
        ledger.claim(&path(texture), "choose another folder with -o")?;
    }
    let files: Vec<PathBuf> = TEXTURES.iter().map(path).collect();
    let batch = Batch::new(folder, "textures", &files)?;
    if let Some(remark) = batch.remark() {
        say(format_args!("draw-textures: note: {remark}"));
    }
    for texture in &TEXTURES {
        let mut output = ledger.create(&path(texture))?;
        output.write_all(&texture.png()?).map_err(|source| output.failed(source))?;
        batch.replace(output)?;
        say(path(texture).display());
    }
    Ok(batch.finish()?)
}
