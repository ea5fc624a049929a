//! What the program `render` is asked, and how it does it.

use clap::builder::TypedValueParser;
use clap::{Parser, ValueEnum};
use files::exit::say;
use files::json::Document;
use files::{Disk, Exit, Failure, Output, Report, input};
use render::accel::Structure;
use render::color::Encoding;
use render::film::encode::{self, Format};
use render::progress::Progress;
use render::scene::{MeshSource, obj, read};
use render::{Settings, filter::Filter, stats::Stats};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::time::Instant;
use thiserror::Error;

const EXAMPLES: &str = "\
Examples:
  render examples/scenes/glass-sphere.json -o glass.png
  render scene.json --mesh vase=vase.obj --size 1024x768 --samples 3 -o vase.png
  sweep vase.json | triangulate --texture 2 | render scene.json --mesh vase=- -o vase.png
  render scene.json --filter point --stats -o - --format exr > picture.exr

Exit codes: 2 bad use, 3 malformed input, 5 cannot read or write, 6 too large, 70 a bug,
141 closed pipe.";

/// Renders a JSON scene with area sampled textures.
#[derive(Debug, Parser)]
#[command(version, after_help = EXAMPLES)]
pub struct Arguments {
    /// The scene: a JSON file, or - for standard input
    scene: PathBuf,
    /// A mesh for the scene: its name there, and an OBJ file or - for standard input
    #[arg(long = "mesh", value_name = "NAME=FILE", value_parser = mesh_argument)]
    meshes: Vec<MeshArgument>,
    /// The picture: a .png or .exr file, or - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The kind of file, if the extension does not tell
    #[arg(long)]
    format: Option<FormatName>,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = render::film::size)]
    size: (u32, u32),
    /// How textures are averaged
    #[arg(long, default_value = "tent")]
    filter: FilterName,
    /// What finds the surfaces that rays hit; the picture is the same
    #[arg(long, value_name = "STRUCTURE", default_value = "bvh")]
    accel: AccelName,
    /// Rays along each side of a pixel: N times N in each
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..=i64::from(render::film::MOST_SAMPLES)))]
    samples: u32,
    /// How a PNG is encoded: srgb, or a gamma such as 2.2
    #[arg(long, value_name = "srgb|G", default_value = "srgb", value_parser = gamma_argument)]
    gamma: Encoding,
    /// Worker threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024).map(usize::from))]
    threads: Option<usize>,
    /// Print counts of rays, hits and texels and the time of each stage on standard error
    #[arg(long, value_name = "AS", num_args = 0..=1, require_equals = true, default_missing_value = "text")]
    stats: Option<StatsForm>,
    /// No progress bar
    #[arg(short, long)]
    quiet: bool,
    /// Refuse to replace an existing file
    #[arg(long)]
    no_clobber: bool,
}

#[derive(Debug, Clone)]
struct MeshArgument {
    name: String,
    file: PathBuf,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FormatName {
    Png,
    Exr,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FilterName {
    /// The texel at the point
    Point,
    /// Four texels interpolated at the point
    Bilinear,
    /// The average under a box over the footprint (summed areas)
    Box,
    /// The average under a tent over the footprint (repeated integration, n = 2)
    Tent,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum AccelName {
    /// A tree of boxes, the fastest
    Bvh,
    /// A uniform grid for each object, as in the thesis
    Grid,
    /// Nothing: every ray tries every triangle
    None,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum StatsForm {
    /// A table
    Text,
    /// One JSON object
    Json,
}

/// Bad use that only shows when arguments are put together.
#[derive(Debug, Error)]
enum UseError {
    #[error("cannot tell the kind of picture from {0}: name it .png or .exr, or add --format")]
    UnknownFormat(String),
    #[error("standard input (-) can be read once, found it for {0} and {1}")]
    TwoFromStdin(String, String),
    #[error("--mesh {0} was given twice")]
    SameMesh(String),
    #[error("a picture is binary and standard output is a terminal: add -o FILE or pipe it on")]
    BinaryToTerminal,
    #[error("cannot start {0} threads: {1}")]
    Threads(usize, rayon::ThreadPoolBuildError),
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        match self {
            Self::Threads(..) => Exit::Resource,
            _ => Exit::Use,
        }
    }
}

/// The picture does not fit its file format.
#[derive(Debug, Error)]
#[error("cannot encode the picture: {0}")]
struct EncodeError(#[from] image::ImageError);

impl Failure for EncodeError {
    fn exit(&self) -> Exit {
        Exit::Resource
    }
}

/// Renders what the arguments ask for.
pub fn run(arguments: &Arguments) -> Result<(), Report> {
    let format = format(arguments)?;
    check_stdin(arguments)?;
    let clobber = !arguments.no_clobber;
    Output::check(&arguments.output, clobber)?;

    let started = Instant::now();
    let scene = read_scene(arguments)?;
    let read_time = started.elapsed();

    let (width, height) = arguments.size;
    let filter = match arguments.filter {
        FilterName::Point => Filter::Point,
        FilterName::Bilinear => Filter::Bilinear,
        FilterName::Box => Filter::Box,
        FilterName::Tent => Filter::Tent,
    };
    let accel = match arguments.accel {
        AccelName::Bvh => Structure::Bvh,
        AccelName::Grid => Structure::Grid,
        AccelName::None => Structure::None,
    };
    let settings = Settings { width, height, samples: arguments.samples, filter, accel };
    let progress = Progress::new("render", arguments.quiet);
    let threads = arguments.threads.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| UseError::Threads(threads, error))?;
    let (picture, mut stats) = pool
        .install(|| render::render(&scene, &settings, &|done, total| progress.tell(done, total)));
    drop(progress);

    let started = Instant::now();
    let bytes = encode::encode(&picture, format, arguments.gamma).map_err(EncodeError)?;
    Output::create(&arguments.output, clobber)?.commit_all(&bytes)?;
    stats.read_time = read_time;
    stats.write_time = started.elapsed();
    print_stats(arguments, &stats);
    Ok(())
}

fn read_scene(arguments: &Arguments) -> Result<render::Scene, Report> {
    let name = input::name_of(&arguments.scene);
    let text = input::read(&arguments.scene)?;
    let document = Document::new(&name, &text)?;
    let file = read::parse(&document)?;
    read::check_mesh_names(&file, arguments.meshes.iter().map(|mesh| mesh.name.as_str()))?;
    let mut given = MeshSource::new();
    for mesh in &arguments.meshes {
        let bytes = input::read(&mesh.file)?;
        given.insert(mesh.name.clone(), obj::read(&input::name_of(&mesh.file), &bytes)?);
    }
    let folder = match arguments.scene.parent() {
        Some(folder) if !input::is_stdin(&arguments.scene) => folder,
        _ => Path::new(""),
    };
    Ok(read::resolve(&document, &file, folder, &Disk, given)?)
}

fn format(arguments: &Arguments) -> Result<Format, UseError> {
    let to_stdout = input::is_stdin(&arguments.output);
    if to_stdout && std::io::stdout().is_terminal() {
        return Err(UseError::BinaryToTerminal);
    }
    match (arguments.format, Format::of(&arguments.output)) {
        (Some(FormatName::Png), _) => Ok(Format::Png),
        (Some(FormatName::Exr), _) => Ok(Format::Exr),
        (None, Some(format)) => Ok(format),
        (None, None) => Err(UseError::UnknownFormat(arguments.output.display().to_string())),
    }
}

fn check_stdin(arguments: &Arguments) -> Result<(), UseError> {
    let scene = std::iter::once(("the scene".to_string(), &arguments.scene));
    let meshes = arguments.meshes.iter().map(|mesh| (format!("--mesh {}", mesh.name), &mesh.file));
    let mut from_stdin = scene.chain(meshes).filter(|(_, file)| input::is_stdin(file));
    if let (Some((first, _)), Some((second, _))) = (from_stdin.next(), from_stdin.next()) {
        return Err(UseError::TwoFromStdin(first, second));
    }
    for (k, mesh) in arguments.meshes.iter().enumerate() {
        if arguments.meshes[..k].iter().any(|other| other.name == mesh.name) {
            return Err(UseError::SameMesh(mesh.name.clone()));
        }
    }
    Ok(())
}

/// Says what `--stats` asks for.
fn print_stats(arguments: &Arguments, stats: &Stats) {
    if stats.not_finite > 0 {
        let count = stats.not_finite;
        say(format_args!("render: {count} pixels came out not finite and are black"));
    }
    match arguments.stats {
        Some(StatsForm::Text) => say(stats.to_string().trim_end()),
        Some(StatsForm::Json) => say(serde_json::to_string(stats).unwrap_or_default()),
        None => {}
    }
}

fn mesh_argument(text: &str) -> Result<MeshArgument, String> {
    match text.split_once('=') {
        Some((name, file)) if !name.is_empty() && !file.is_empty() => {
            Ok(MeshArgument { name: name.into(), file: file.into() })
        }
        _ => Err("expected NAME=FILE, or NAME=- for standard input".into()),
    }
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
