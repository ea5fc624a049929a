//! The flags for the file that is written, and its writing.

use super::display::address;
use super::{EncodeError, UseError};
use clap::Args;
use files::{FileError, Ledger, Output, Report, Variant, exit, input, words};
use render::color::Encoding;
use render::film::Layer;
use render::film::command::{Named, command};
use render::film::encode::{self, Bits, Coding, Format};
use render::{Picture, Settings};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::Duration;

#[derive(Debug, Args)]
pub struct OutputArguments {
    /// The picture: a .png or .exr file, or - for standard output
    #[arg(short, long, value_name = "FILE", required_unless_present_any = ["pixel", "check", "display", "emit_schema"])]
    output: Option<PathBuf>,
    /// Format of the file, if its extension is not .png or .exr
    #[arg(long)]
    format: Option<Format>,
    /// Encoding of a PNG and of the codes of --pixel: srgb, or a gamma from 0.1 to 10
    #[arg(long, value_name = "srgb|G", default_value = "srgb", value_parser = gamma_argument)]
    pub gamma: Encoding,
    /// Layers of an EXR besides the colour, for the first hit of each pixel's middle ray: some of
    /// normal, depth, uv, object, footprint, with commas between them; and for the whole pixel: error
    /// (estimated), rays (from the eye)
    #[arg(long, value_name = "LIST", value_delimiter = ',', requires = "output")]
    layers: Vec<Layer>,
    /// Bits of each channel of a PNG
    #[arg(long, value_name = "BITS", default_value = "8")]
    bits: Bits,
    /// Make the background transparent: a PNG with straight colours, or an EXR with multiplied ones. The
    /// picture shows it beside objects, through glass and through cut-outs; mirrors show it as it is
    #[arg(long)]
    pub alpha: bool,
    /// Make the picture again whenever the scene or a file that it names changes, until Ctrl-C
    #[arg(long, conflicts_with_all = ["no_clobber", "partial"])]
    pub watch: bool,
    /// Show each tile as it is finished in an image viewer that listens there: tev, or another with its protocol.
    /// tev listens on 127.0.0.1:14158
    #[arg(long, value_name = "HOST:PORT", value_parser = address, conflicts_with_all = ["check", "emit_schema"])]
    pub display: Option<String>,
}

/// A picture file that the run may write.
#[derive(Debug)]
pub struct Target {
    path: PathBuf,
    format: Format,
}

impl Target {
    /// Returns the targets of variants: the name of this one, a dash and the name of the variant. Each is checked.
    pub fn of_variants(&self, variants: &[Variant], ledger: &Ledger) -> Result<Vec<Self>, Report> {
        if input::is_stdin(&self.path) {
            return Err(UseError::VariantsToStdout.into());
        }
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy();
        let end = self.path.extension().map(|end| format!(".{}", end.to_string_lossy()));
        let end = end.unwrap_or_default();
        let targets = variants.iter().map(|variant| {
            let path = self.path.with_file_name(format!("{stem}-{}{end}", variant.name));
            ledger.claim(&path, "name another file with -o")?;
            Ok(Self { path, format: self.format })
        });
        targets.collect()
    }

    /// Name of the file without its folder.
    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or(self.path.as_os_str()).to_string_lossy().into_owned()
    }

    /// Format of the file.
    pub fn format(&self) -> Format {
        self.format
    }

    /// Prints the line about the written picture, unless the picture went to standard output.
    pub fn wrote(&self, (width, height): (u32, u32), time: Duration) {
        if !input::is_stdin(&self.path) {
            exit::wrote(&self.path, Some((width, height)), time);
        }
    }
}

impl OutputArguments {
    /// Returns the target of the picture, if there is one, after a check that the file can be written.
    /// `prints` tells whether text goes to standard output.
    pub fn target(&self, prints: bool, ledger: &Ledger) -> Result<Option<Target>, Report> {
        let Some(path) = &self.output else { return Ok(None) };
        let to_stdout = input::is_stdin(path);
        if to_stdout && prints {
            return Err(UseError::PixelAndPicture.into());
        }
        if to_stdout && std::io::stdout().is_terminal() {
            return Err(UseError::BinaryToTerminal.into());
        }
        let format = match (self.format, Format::of(path)) {
            (Some(format), _) | (None, Some(format)) => format,
            (None, None) => return Err(UseError::UnknownFormat(path.display().to_string()).into()),
        };
        if format == Format::Png && !self.layers.is_empty() {
            return Err(UseError::LayersInPng(path.display().to_string()).into());
        }
        ledger.claim(path, "name another file with -o")?;
        Ok(Some(Target { path: path.clone(), format }))
    }

    /// Returns the bytes per pixel that a PNG of 16 bits takes beyond those of one of 8 bits.
    pub fn more_bytes(&self) -> u64 {
        if self.bits == Bits::Sixteen { 3 * 4 } else { 0 }
    }

    /// Returns whether the picture goes to standard output.
    pub fn is_stdout(&self) -> bool {
        self.output.as_deref().is_some_and(input::is_stdin)
    }

    /// Returns the layers, each once, in the order of the help text.
    pub fn layers(&self) -> Vec<Layer> {
        let mut layers = self.layers.clone();
        layers.sort_unstable();
        layers.dedup();
        layers
    }

    pub fn write(
        &self,
        target: &Target,
        picture: &Picture,
        settings: &Settings,
        named: &Named<'_>,
        ledger: &Ledger,
    ) -> Result<(), Report> {
        let coding = Coding {
            encoding: self.gamma,
            bits: self.bits,
            part: settings.crop.map(|crop| (crop, [settings.width, settings.height])),
            command: Some(command(named, settings)),
            inputs: None,
        };
        let bytes = encode::encode_as(picture, target.format, &coding).map_err(EncodeError)?;
        Ok(ledger.create(&target.path)?.commit_all(&bytes)?)
    }

    /// Returns what the command in a file names, for a scene with this file name, these given meshes,
    /// these values that are set and these flags of a mesh without a scene.
    pub fn named<'a>(
        &self,
        scene: &'a str,
        (meshes, set, look): (&'a [&'a str], &'a [String], &'a [String]),
        error: Option<&'a str>,
        alpha: bool,
    ) -> Named<'a> {
        Named { scene, meshes, set, look, error, alpha, encoding: self.gamma, bits: self.bits }
    }
}

/// Prints text on standard output, with control characters spelled out.
pub fn print(text: &str) -> Result<(), FileError> {
    Output::create(Path::new("-"), true)?.commit_all(words::printed(text).as_bytes())
}

fn gamma_argument(text: &str) -> Result<Encoding, String> {
    if text.eq_ignore_ascii_case("srgb") {
        return Ok(Encoding::Srgb);
    }
    match text.parse() {
        Ok(gamma) if (0.1..=10.0).contains(&gamma) => Ok(Encoding::Gamma(gamma)),
        _ => Err("expected srgb, or a number from 0.1 to 10".into()),
    }
}
