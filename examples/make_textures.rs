//! Draws the textures of the example scenes: `cargo run --release --example make-textures -- DIR`.

#[path = "textures/make/mod.rs"]
mod make;

use clap::Parser;
use files::{Output, Report};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, RgbImage};
use std::path::PathBuf;
use std::process::ExitCode;

/// Draws the textures of the example scenes.
#[derive(Debug, Parser)]
#[command(name = "make-textures")]
struct Arguments {
    /// The folder, which must exist, in which to write or replace them.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    files::exit::run("make-textures", || write_all(&arguments))
}

fn write_all(arguments: &Arguments) -> Result<(), Report> {
    for texture in make::TEXTURES {
        let output = Output::create(&arguments.folder.join(texture.file), true)?;
        output.commit_all(&smallest_png(&(texture.draw)()))?;
    }
    Ok(())
}

/// The picture as PNG, by whichever row filter makes the smallest file.
fn smallest_png(picture: &RgbImage) -> Vec<u8> {
    let encode = |filter| {
        let mut bytes = Vec::new();
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, filter)
            .write_image(picture, picture.width(), picture.height(), ExtendedColorType::Rgb8)
            .expect("a vector takes every byte, and the picture has its own size");
        bytes
    };
    [FilterType::NoFilter, FilterType::Sub, FilterType::Up, FilterType::Paeth, FilterType::Adaptive]
        .map(encode)
        .into_iter()
        .min_by_key(Vec::len)
        .expect("there are five of them")
}
