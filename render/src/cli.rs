//! The arguments of the program `render`, and its run. Each group of flags has its own file.

mod accuracy;
mod display;
mod input;
mod loaded;
mod mesh;
mod output;
mod sampling;
mod textures;
mod work;

use clap::Parser;
use display::Display;
use files::memory::of_process;
use files::progress::Progress;
use files::watch::PipeError;
use files::{Exit, Failure, Ledger, Report, Setting};
use render::film::course::Shown;
use render::film::{self, BasePicture, Crop, Layer, alpha, memory};
use render::scene::{self, schema};
use render::shade::View;
use render::{Prepared, Sampling, Settings, inspect};
use std::time::Instant;
use thiserror::Error;

const EXAMPLES: &str = "\
Examples, of a scene that `pipeline new scene -o scene.json` writes, and of a mesh of yours (OBJ, STL, PLY or glTF):
  render scene.json -o scene.png
  render mesh.ply -o mesh.png
  render mesh.stl --color '#b8352d' --view 30,20 --size 1920x1080 --alpha -o mesh.png
  render mesh.ply --view front --scene-out mine.json -o mesh.png
  render mine.json --mesh mesh=other.ply --size 1024x768 --samples 3 -o other.png
  sweep vase.json | triangulate | render - -o vase.png
  render scene.json --error 0.01 -o scene.png
  render scene.json --jobs-from variants.csv -o variant.png
  render scene.json -D camera.fov_deg=35 -D objects[1].sphere.radius=0.7 -o variant.png
  render scene.json --sampling thesis --filter tent --audit -o scene.png
  render scene.json --filter point --stats -o - --format exr > picture.exr
  render scene.json --pixel 256,300
  render --check scene.json
  render --emit-schema > tb-scene.schema.json
  render scene.json --error 0.01 --display 127.0.0.1:14158
  render scene.json --crop 200,250,100x100 --layers normal,depth -o part.exr

The picture never replaces an input (the scene, its parts, meshes, materials, pictures).

render completions SHELL prints completions for bash, elvish, fish, powershell or zsh.
render man prints a page for man.

Exit codes:
  2 bad use, 3 malformed input, 4 --check found something wrong
  5 cannot read or write, or no viewer listens for --display
  6 too large, 7 --error was not reached
  70 a bug, 130 interrupted, 143 terminated, 141 closed pipe";

/// Renders a JSON scene, or a mesh alone, with area sampled textures.
#[derive(Debug, Parser)]
#[command(name = "render", version, after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    input: input::InputArguments,
    #[command(flatten)]
    output: output::OutputArguments,
    #[command(flatten)]
    sampling: sampling::SamplingArguments,
    #[command(flatten)]
    accuracy: accuracy::AccuracyArguments,
    #[command(flatten)]
    textures: textures::TextureArguments,
    #[command(flatten)]
    work: work::WorkArguments,
}

/// Arguments that contradict each other.
#[derive(Debug, Error)]
enum UseError {
    #[error("cannot tell the kind of picture from {0}: name it .png or .exr, or add --format")]
    UnknownFormat(String),
    #[error("{0} is a PNG and cannot hold --layers: name it .exr, or leave them out")]
    LayersInPng(String),
    #[error("standard input (-) can be read once: found - for {0} and {1}")]
    TwoFromStdin(String, String),
    #[error(
        "{0} is for a mesh without a scene, and {1} is a scene: change the scene, or set its values with -D"
    )]
    LookOfScene(String, String),
    #[error("--jobs-from makes several pictures, and -o is standard output: name a file with -o")]
    VariantsToStdout,
    #[error("--mesh {0} was given twice")]
    SameMesh(String),
    #[error("a picture is binary and standard output is a terminal: add -o FILE or pipe it on")]
    BinaryToTerminal,
    #[error("--pixel prints on standard output: name a file for the picture, or leave -o out")]
    PixelAndPicture,
    #[error("--crop {0} reaches out of the picture of {1}x{2} pixels")]
    CropOutside(String, u32, u32),
    #[error("--tile {0}/{1} has no rows: the picture has {2}, so ask for at most {2} parts")]
    ThinTiles(u32, u32, u32),
    #[error("--pixel {0},{1} is not in the picture of {2}x{3} pixels, whose first is 0,0")]
    PixelOutside(u32, u32, u32, u32),
    #[error("--seed chooses a jitter: add --pattern jitter, or leave it out")]
    SeedOfNothing,
    #[error(
        "--pixel-filter {0} needs rays between the middles of pixels: add --samples 2 or more, or \
         leave out --sampling thesis"
    )]
    WideFilterOfOne(String),
    #[error("{0} belongs to --sampling {1}: add --sampling {1}, or leave {0} out")]
    OfOtherSampling(&'static str, &'static str),
    #[error("--error {text}: {expected}", text = files::words::shown(.0), expected = .1)]
    Request(String, String),
    #[error("{0} chooses the rays, and {1} chooses them too: leave one of the two out")]
    Accuracies(&'static str, String),
    #[error("{0} is about a whole picture: leave --pixel out")]
    AccuracyOfPixel(&'static str),
    #[error("--layers error shows an estimate that --sampling thesis does not make: leave it out")]
    ErrorOfThesis,
    #[error("{0}: number of findings marked `wrong`: {1}")]
    Wrong(String, usize),
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        match self {
            Self::Wrong(..) => Exit::Geometry,
            Self::UnknownFormat(_)
            | Self::LayersInPng(_)
            | Self::TwoFromStdin(..)
            | Self::LookOfScene(..)
            | Self::VariantsToStdout
            | Self::SameMesh(_)
            | Self::BinaryToTerminal
            | Self::PixelAndPicture
            | Self::CropOutside(..)
            | Self::ThinTiles(..)
            | Self::PixelOutside(..)
            | Self::SeedOfNothing
            | Self::WideFilterOfOne(_)
            | Self::OfOtherSampling(..)
            | Self::Request(..)
            | Self::Accuracies(..)
            | Self::AccuracyOfPixel(_)
            | Self::ErrorOfThesis => Exit::Use,
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

impl Arguments {
    /// Returns whether the picture is made again after each change of an input.
    pub fn watches(&self) -> bool {
        self.output.watch
    }

    /// Returns the ledger of the files of one run.
    pub fn ledger(&self) -> Ledger {
        self.work.common.ledger()
    }
}

/// Renders or checks the scene, or prints the text that the arguments request.
pub fn run(arguments: &Arguments, ledger: &Ledger) -> Result<(), Report> {
    let Arguments { input, output, sampling, accuracy, textures, work } = arguments;
    if input.emit_schema {
        return Ok(output::print(&format!("{:#}\n", schema::of_scene()))?);
    }
    work.common.begin();
    input.check()?;
    if output.watch && (input.reads_stdin() || output.is_stdout()) {
        return Err(PipeError("name them, and the picture with -o FILE").into());
    }
    if input.check {
        return check(arguments, ledger);
    }
    sampling.check()?;
    accuracy.check(sampling)?;
    let target = output.target(sampling.pixel.is_some(), ledger)?;
    input.expect(ledger)?;
    let variants = input.variants(ledger)?;
    let targets = match (&variants, &target) {
        (Some(variants), Some(target)) => target.of_variants(variants, ledger)?,
        _ => Vec::new(),
    };
    let (width, height) = sampling.size;
    let settings = Settings {
        sampling: sampling.sampling()?,
        crop: sampling.crop(),
        layers: output.layers(),
        accel: work.accel,
        ..Settings::new(width, height, textures.filter)
    };
    if settings.layers.contains(&Layer::Error)
        && !matches!(settings.sampling, Sampling::Area { .. })
    {
        return Err(UseError::ErrorOfThesis.into());
    }
    let display = output.display.as_deref().map(Display::connect).transpose()?;
    let begun = Instant::now();
    let mut loaded = input.load(ledger, &staging(sampling.size, output))?;
    if let Some(path) =
        input.scene_out.as_ref().filter(|path| work.tells() && !files::input::is_stdin(path))
    {
        files::exit::wrote(path, None, begun.elapsed());
    }
    let Some(variants) = variants else {
        return picture(
            arguments,
            &mut loaded,
            input.settings(),
            (target, display.as_ref(), true),
            (settings, begun),
        );
    };
    for (k, (variant, target)) in variants.iter().zip(targets).enumerate() {
        let begun = if k == 0 { begun } else { Instant::now() };
        let (target, last) = (Some(target), k + 1 == variants.len());
        let target = (target, display.as_ref(), last);
        let timed = (settings.clone(), begun);
        picture(arguments, &mut loaded, &variant.settings, target, timed)?;
    }
    Ok(())
}

/// Makes the picture of the scene with these values, or prints a pixel of it. No further picture follows if `last`.
fn picture(
    arguments: &Arguments,
    loaded: &mut loaded::Loaded<'_>,
    set: &[Setting],
    (target, display, last): (Option<output::Target>, Option<&Display>, bool),
    (mut settings, begun): (Settings, Instant),
) -> Result<(), Report> {
    let Arguments { input, output, sampling, accuracy, work, .. } = arguments;
    let (width, height) = sampling.size;
    let ledger = loaded.ledger;
    let scene = loaded.scene(set, last, |_, scene| Ok(scene))?;
    work.print_remarks(&scene);
    let is_made = target.is_some() || display.is_some();
    let is_transparent = is_made && (output.alpha || scene.is_transparent);
    if is_transparent {
        settings.view = View::Foreground;
    }
    // A pixel alone is a complete picture.
    let of_pixel =
        |(x, y)| Settings { crop: Some(Crop { x, y, width: 1, height: 1 }), ..settings.clone() };
    let _memory = match (&target, sampling.pixel) {
        (None, Some(pixel)) if !is_made => {
            memory::reserve(&scene, &of_pixel(pixel), None, of_process())?
        }
        (target, _) => {
            let format = target.as_ref().map(output::Target::format);
            memory::reserve(&scene, &settings, format, of_process())?
        }
    };
    let pixels = u64::from(width) * u64::from(height);
    let first = pixels.saturating_mul(BasePicture::of_pixel(sampling.pixel_filter));
    let first = if accuracy.chooses() { first } else { 0 };
    // The coverage and its picture, and the wider codes of a PNG.
    let more = if is_transparent { 16 + 4 } else { 0 } + output.more_bytes();
    let _more = of_process().reserve(pixels.saturating_mul(more), || "the picture".into())?;
    let _first = of_process().reserve(first, || "the first rays of all pixels".into())?;
    let read_time = begun.elapsed();

    accuracy.hold_signals();
    let pool = work.common.pool()?;
    let prepared = Prepared::new(&scene);
    if is_made {
        let progress = Progress::new("render", work.common.quiet);
        let name = target.as_ref().map_or_else(|| input.file_name(), output::Target::name);
        let image = display.map(|display| display.begin(&name, &settings, is_transparent));
        let shown =
            image.as_ref().map(|image| |tile: &Crop, pixels: &[[f32; 3]]| image.show(tile, pixels));
        let shown = shown.as_ref().map(|shown| shown as &Shown<'_>);
        let (mut picture, mut stats, statement) = pool.install(|| {
            accuracy.render(&prepared, &mut settings, sampling.pixel_filter, &progress, shown)
        });
        drop(progress);
        if is_transparent {
            let (view, layers) = (View::Coverage, Vec::new());
            let settings = Settings { view, layers, ..settings.clone() };
            let (open, _) = pool.install(|| film::render(&prepared, &settings, &|_, _| {}));
            alpha::add(&mut picture, &open);
        }
        if let Some(image) = &image {
            image.complete(&picture);
        }
        let started = Instant::now();
        let (scene, meshes) = (input.file_name(), input.mesh_names());
        let set: Vec<String> = set.iter().map(Setting::text).collect();
        let look = input.look.flags();
        let named = output.named(&scene, (&meshes, &set, &look), accuracy.error(), is_transparent);
        if let Some(target) = &target {
            output.write(target, &picture, &settings, &named, ledger)?;
        }
        stats.read_time = read_time;
        stats.write_time = started.elapsed();
        work.print_stats(&stats);
        if let Some(target) = target.filter(|_| work.tells()) {
            target.wrote((picture.width, picture.height), begun.elapsed());
        }
        accuracy.state_unfinished(&stats, &picture);
        accuracy.state(statement, work.common.quiet)?;
    }
    if let Some(pixel) = sampling.pixel {
        let (encoding, all) = (output.gamma, sampling.all_samples);
        let text = pool.install(|| inspect::pixel(&prepared, &settings, pixel, encoding, all));
        output::print(&text)?;
    }
    Ok(())
}

/// Returns what the scene of a mesh without one depends on besides its own flags.
fn staging((width, height): (u32, u32), output: &output::OutputArguments) -> mesh::Staging {
    mesh::Staging { aspect: f64::from(width) / f64::from(height), alone: output.alpha }
}

/// Prints the inventory and the findings of `--check`.
fn check(arguments: &Arguments, ledger: &Ledger) -> Result<(), Report> {
    let Arguments { input, output, sampling, textures, .. } = arguments;
    let (width, height) = sampling.size;
    let aspect = f64::from(width) / f64::from(height);
    let filter = textures.filter;
    let tables = |texture: &_| filter.bytes_for(texture);
    let staging = staging(sampling.size, output);
    let mut loaded = input.load(ledger, &staging)?;
    let report = loaded.scene(input.settings(), true, |draft, scene| {
        Ok(scene::check::check(draft, &scene, aspect, &tables)?)
    })?;
    output::print(&report.to_string())?;
    match report.wrong() {
        0 => Ok(()),
        count => Err(UseError::Wrong(input.name(), count).into()),
    }
}
