//! `pipeline show`: makes a picture of a spec, a grid or a mesh.

use crate::PipelineError;
use crate::show::Showing;
use clap::Args;
use files::exit::{say, wrote};
use files::memory::of_process;
use files::progress::Progress;
use files::{CommonArguments, Exit, Failure, Report, Setting, input};
use render::accuracy::{self, Request};
use render::color::Encoding;
use render::film::command::{Named, command};
use render::film::encode::{self, Bits, Coding, Format};
use render::film::{BasePicture, MOST_SAMPLES, PixelFilter, THRESHOLD, alpha, memory};
use render::filter::Filter;
use render::shade::View;
use render::showcase::look::HEADING;
use render::showcase::{self, Look};
use render::{Picture, Prepared, Sampling, Settings};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Instant;
use thiserror::Error;

/// Arguments of `pipeline show`.
#[derive(Debug, Args)]
pub struct ShowArguments {
    /// A curve spec, a grid, or a mesh (OBJ, STL, PLY, glTF); - is standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The picture: a .png or .exr file, or - for a PNG on standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = render::film::size)]
    size: (u32, u32),
    /// Rays along each side of a pixel, 1 to 256
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SAMPLES)))]
    samples: u32,
    /// Make a picture whose error is below this: a number between 0 and 1, root mean square in linear
    /// light, or 8bit for half a code of an 8-bit picture
    #[arg(long, value_name = "E|8bit", value_parser = accuracy::error, conflicts_with = "samples")]
    error: Option<f64>,
    /// Make the background transparent, and leave out the ground
    #[arg(long)]
    alpha: bool,
    /// Set a value of the spec, or of the scene that shows it: -D scene.ambient=0.5; may be given several
    /// times
    #[arg(short = 'D', value_name = "PATH=VALUE")]
    settings: Vec<Setting>,
    #[command(flatten)]
    look: Look,
    /// Write the scene that shows the mesh, as a starting point for a scene of your own
    #[arg(long, value_name = "FILE.json", help_heading = HEADING)]
    scene_out: Option<PathBuf>,
    /// Write a job of the spec and of the scene of --scene-out, as a starting point for modes, variants and
    /// frames
    #[arg(long, value_name = "FILE.json", requires = "scene_out", help_heading = HEADING)]
    job_out: Option<PathBuf>,
    #[command(flatten)]
    common: CommonArguments,
}

#[derive(Debug, Error)]
enum UseError {
    #[error("cannot tell the kind of picture from {0}: name it .png or .exr")]
    Format(String),
    #[error(
        "--job-out names a spec, and {0} is none: `pipeline run` takes the scene of --scene-out as a job"
    )]
    JobOfNoSpec(String),
    #[error(
        "--job-out names {0} as it is: set its values with -D specs.mesh... of `pipeline run`, and leave {1} out"
    )]
    JobOfValues(String, String),
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

/// Makes the picture.
pub fn show(arguments: &ShowArguments) -> Result<(), Report> {
    let ShowArguments { file, output, size: (width, height), look, common, .. } = arguments;
    common.begin();
    let to_stdout = input::is_stdin(output);
    let format = if to_stdout { Some(Format::Png) } else { Format::of(output) };
    let format = format.ok_or_else(|| UseError::Format(output.display().to_string()))?;
    let started = Instant::now();
    let ledger = common.ledger();
    ledger.claim(output, "name another file with -o")?;
    if let Some(path) = &arguments.scene_out {
        ledger.claim(path, "name another file with --scene-out")?;
    }
    if let Some(path) = &arguments.job_out {
        ledger.claim(path, "name another file with --job-out")?;
        let own = arguments.settings.iter().find(|setting| setting.below("scene").is_none());
        if let Some(setting) = own {
            let setting = format!("-D {}", setting.argument());
            return Err(UseError::JobOfValues(input::name_of(file), setting).into());
        }
    }
    let bytes = ledger.argument(file, "the file to show")?;
    let folder = arguments.scene_out.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
    let showing = Showing {
        path: file,
        bytes,
        source: &ledger,
        settings: &arguments.settings,
        look,
        folder,
        aspect: f64::from(*width) / f64::from(*height),
        alone: arguments.alpha,
    };
    let pool = common.pool()?;
    let shown = pool.install(|| showing.scene())?;
    if arguments.job_out.is_some() && !(shown.is_spec && file != Path::new("-")) {
        return Err(UseError::JobOfNoSpec(input::name_of(file)).into());
    }
    if !common.quiet {
        shown.scene.remarks.iter().for_each(|remark| say(format_args!("pipeline: {remark}")));
        shown.notes.iter().for_each(|note| say(format_args!("pipeline: note: {note}")));
    }
    let settings = arguments.rays(shown.scene.is_transparent);
    let _memory = memory::reserve(&shown.scene, &settings, Some(format), of_process())?;
    let first = if arguments.error.is_some() { BasePicture::of_pixel(PixelFilter::Box) } else { 0 };
    let pixels = u64::from(*width) * u64::from(*height);
    let more = || format!("a picture of {width}x{height} pixels");
    let _more = of_process().reserve(pixels.saturating_mul(first + 20), more)?;
    let prepared = Prepared::new(&shown.scene);
    let progress = Progress::new("show", common.quiet);
    let (picture, statement) = pool.install(|| {
        arguments.picture(&prepared, &settings, &|done, total| progress.tell(done, total))
    });
    drop(progress);
    let coding =
        Coding { command: Some(arguments.command(&settings)), ..Coding::new(Encoding::Srgb) };
    let bytes = encode::encode_as(&picture, format, &coding)
        .map_err(|source| PipelineError::Encode { name: output.display().to_string(), source })?;
    ledger.create(output)?.commit_all(&bytes)?;
    if let Some(path) = &arguments.scene_out {
        ledger.create(path)?.commit_all(&shown.text)?;
        if let Some(job) = &arguments.job_out {
            ledger.create(job)?.commit_all(job_text(job, file, path).as_bytes())?;
        }
    }
    if !common.quiet {
        let made = [&arguments.scene_out, &arguments.job_out];
        made.into_iter().flatten().for_each(|path| wrote(path, None, started.elapsed()));
        if let Some(job) = &arguments.job_out {
            say(format_args!("make its pictures: pipeline run {} -o out", job.display()));
        } else if let (Some(path), false) = (&arguments.scene_out, shown.names_mesh) {
            say(format_args!(
                "pipeline: {} takes its mesh with --mesh mesh=FILE, which sweep and triangulate make",
                path.display()
            ));
        }
        if let Some(statement) = &statement {
            say(statement);
        }
        if !to_stdout {
            wrote(output, Some((*width, *height)), started.elapsed());
        }
    }
    match statement {
        Some(statement) if statement.missed.is_some() => Err(PipelineError::ErrorMissed(1).into()),
        _ => Ok(()),
    }
}

/// Returns the text of a job file that makes a mesh of a spec for its scene.
fn job_text(job: &Path, spec: &Path, scene: &Path) -> String {
    let folder = job.parent().unwrap_or(Path::new(""));
    let named = |path: &Path| json!(showcase::seen_from(folder, path).to_string_lossy());
    let (spec, scene, mesh) = (named(spec), named(scene), showcase::MESH);
    format!(
        "{{\n  \"format\": \"tb-job\", \"version\": 1,\n  \"meshes\": {{ \"{mesh}\": {{ \"spec\": {spec} }} }},\n  \"scene\": {scene}\n}}\n"
    )
}

impl ShowArguments {
    /// Returns the settings of the picture.
    fn rays(&self, is_transparent: bool) -> Settings {
        let (width, height) = self.size;
        let sampling = Sampling::Area {
            samples: self.samples,
            pixel_filter: PixelFilter::Box,
            threshold: Some(THRESHOLD),
        };
        let mut settings = Settings { sampling, ..Settings::new(width, height, Filter::Exact) };
        if self.alpha || is_transparent {
            settings.view = View::Foreground;
        }
        settings
    }

    /// Makes the picture, with its coverage if the background is transparent.
    fn picture(
        &self,
        prepared: &Prepared<'_>,
        settings: &Settings,
        progress: &(dyn Fn(usize, usize) + Sync),
    ) -> (Picture, Option<accuracy::Statement>) {
        let told = |step: &str, done, total| {
            if step == "picture" {
                progress(done, total);
            }
        };
        let (mut picture, statement) = match self.error {
            Some(error) => {
                let request = Request::new(prepared, settings, PixelFilter::Box);
                let reached = Request { progress: &told, ..request }.reach(error);
                (reached.picture, Some(reached.statement))
            }
            None => (render::render(prepared, settings, progress).0, None),
        };
        if settings.view == View::Foreground {
            let settings = Settings { view: View::Coverage, ..settings.clone() };
            let (open, _) = render::render(prepared, &settings, &|_, _| {});
            alpha::add(&mut picture, &open);
        }
        (picture, statement)
    }

    /// Returns the command that makes the picture, for the text in its file.
    fn command(&self, settings: &Settings) -> String {
        let name = self.file.file_name().unwrap_or(self.file.as_os_str()).to_string_lossy();
        let error = self.error.map(|error| error.to_string());
        let (set, look): (Vec<String>, _) =
            (self.settings.iter().map(Setting::text).collect(), self.look.flags());
        let named = Named {
            scene: &name,
            meshes: &[],
            set: &set,
            look: &look,
            error: error.as_deref(),
            alpha: self.alpha,
            encoding: Encoding::Srgb,
            bits: Bits::Eight,
        };
        let command = command(&named, settings).replace(" --filter exact", "");
        command.replacen("render", "pipeline show", 1)
    }
}
