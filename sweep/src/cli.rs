//! The command line of `sweep`: its arguments, and the work that they request.

mod format;
mod report;
mod resolution;

use clap::Parser;
use files::exit::{Exit, Failure, Report, say, wrote};
use files::json::Document;
use files::progress::Progress;
use files::watch::PipeError;
use files::{Batch, CommonArguments, Ledger, Output, Setting, extension, input, setting};
use format::Format;
use resolution::ResolutionArguments;
use std::io::{self, IsTerminal, Write};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use sweep::grid::file::Encoding;
use sweep::{Object, Spent, Sweep, check, preview, schema};
use thiserror::Error;

const EXAMPLES: &str = "\
Examples, of specs that `pipeline new vase` and `pipeline new knot` write:
  sweep vase.json -o vase.grid
  sweep knot.json --rows 1000 --cols 64 --stats -o knot.grid
  sweep vase.json --tol 1e-3 --angle 5 --stats -o vase.grid
  sweep vase.json -D trajectory.rotation.angle_deg=270 -o part.grid
  sweep --emit-schema > tb-sweep.schema.json
  sweep --format json < knot.json | head -3
  sweep vase.json | triangulate > vase.obj
  sweep --check vase.json
  sweep --preview knot.svg knot.json

No output replaces an input. The extension of an output must not belong to another format: a grid is
.grid (or .json with --format json), a preview .svg; unknown extensions are allowed.
The grid and the preview are replaced together.

sweep completions SHELL prints completions for bash, elvish, fish, powershell or zsh.
sweep man prints a page for man.

Exit codes:
  2 bad use, 3 malformed input
  4 impossible geometry, or --check found something wrong
  5 cannot read or write, 6 too large
  70 a bug, 130 interrupted, 143 terminated, 141 closed pipe";

/// Sweep a contour along a trajectory: a JSON spec in, a grid of points and normals out.
#[derive(Debug, Parser)]
#[command(name = "sweep", version, after_help = EXAMPLES)]
pub struct Arguments {
    /// The spec, a JSON file; - is standard input
    #[arg(default_value = "-", value_name = "SPEC")]
    spec: PathBuf,

    /// The grid file; - is standard output, and the default without --check and --preview
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Print what is wrong or suspicious on standard output; the exit code is 4 if something is wrong
    #[arg(long)]
    check: bool,

    /// Check also whether distant parts of a surface cross each other
    #[arg(long)]
    check_self: bool,

    /// Draw contour, trajectory, frames, laws and surface into an SVG file
    #[arg(long, value_name = "FILE")]
    preview: Option<PathBuf>,

    /// Format of the grid
    #[arg(long, value_enum, default_value_t = Format::Bin)]
    format: Format,

    /// Set a value of the spec: -D contour.circle=2; may be given several times
    #[arg(short = 'D', value_name = "PATH=VALUE")]
    settings: Vec<Setting>,

    #[command(flatten)]
    resolution: ResolutionArguments,

    /// Print the JSON Schema of specs and do nothing else
    #[arg(long, exclusive = true)]
    emit_schema: bool,

    /// Print sizes and times on standard error
    #[arg(long)]
    stats: bool,

    /// Do the work again whenever the spec or a file that it names changes, until Ctrl-C
    #[arg(long, conflicts_with = "no_clobber")]
    watch: bool,

    #[command(flatten)]
    common: CommonArguments,
}

#[derive(Debug, Error)]
enum UseError {
    #[error("the binary grid is not for a terminal: name a file with -o, or use --format json")]
    Terminal,
    #[error(
        "found two outputs for standard output, expected one: name files with -o and --preview"
    )]
    Crowded,
    #[error("{name}: number of findings marked `wrong`: {count}")]
    Wrong { name: String, count: NonZeroUsize },
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        match self {
            Self::Terminal | Self::Crowded => Exit::Use,
            Self::Wrong { .. } => Exit::Geometry,
        }
    }
}

impl Arguments {
    /// Returns whether the work is done again after each change of an input.
    pub fn watches(&self) -> bool {
        self.watch
    }

    /// Returns the ledger of the files of one run.
    pub fn ledger(&self) -> Ledger {
        self.common.ledger()
    }
}

/// Sweeps, checks or draws an object as the arguments request.
///
/// # Errors
/// When the arguments contradict each other, a file cannot be read or written, the spec is refused, or `--check`
/// finds something wrong.
pub fn run(arguments: &Arguments, ledger: &Ledger) -> Result<(), Report> {
    if arguments.emit_schema {
        return emit_schema();
    }
    let encoding = arguments.format.encoding();
    let checks = arguments.check || arguments.check_self;
    let stdout = Path::new("-");
    let output = match &arguments.output {
        None if checks || arguments.preview.is_some() => None,
        given => Some(given.as_deref().unwrap_or(stdout)),
    };
    let to_stdout = output == Some(stdout);
    let drawn_to_stdout = arguments.preview.as_deref() == Some(stdout);
    if [to_stdout, drawn_to_stdout, checks].into_iter().filter(|&uses| uses).count() > 1 {
        return Err(UseError::Crowded.into());
    }
    if to_stdout && encoding == Encoding::Binary && io::stdout().is_terminal() {
        return Err(UseError::Terminal.into());
    }
    let is_pipe = input::is_stdin(&arguments.spec) || to_stdout || drawn_to_stdout;
    if arguments.watch && is_pipe {
        return Err(PipeError("name the spec, and its outputs with -o or --preview").into());
    }
    arguments.common.start_threads()?;

    let start = Instant::now();
    arguments.common.begin();
    let file = output.map(|path| ledger.output(path, "name another file with -o")).transpose()?;
    let draw_to = |path| ledger.output(path, "name another file with --preview");
    let preview = arguments.preview.as_deref().map(draw_to).transpose()?;
    ledger.expect(&arguments.spec, "the spec")?;
    if let Some(output) = output {
        extension::check(output, "a grid", arguments.format.extensions())?;
    }
    if let Some(preview) = &arguments.preview {
        extension::check(preview, "an SVG drawing", &["svg"])?;
    }
    let bytes = ledger.argument_json(&arguments.spec, "the spec")?;
    let name = input::name_of(&arguments.spec);
    let bytes = setting::apply(&name, bytes, &arguments.settings)?;
    let name = setting::name(name, &arguments.settings);
    let folder = arguments.spec.parent().unwrap_or(Path::new(""));
    let document = Document::new(&name, &bytes)?;
    let fitting = Progress::new("cells", arguments.common.quiet);
    let tell = |done, most| fitting.tell(done, most);
    let overrides = arguments.resolution.overrides();
    let object = Object::read_telling(&document, folder, ledger, &overrides, &tell)?;
    drop(fitting);
    let read = Instant::now();
    let mut spent = Spent::default();
    let mut outputs = Vec::new();
    if let Some(mut file) = file {
        spent = object.write(encoding, &mut file).map_err(|source| file.failed(source))?;
        outputs.push(file);
    }
    // Whole grids are made only for the check and the preview.
    let grids = if checks || preview.is_some() { object.grids()? } else { Vec::new() };
    let findings = if grids.is_empty() {
        Vec::new()
    } else {
        let progress = Progress::new("check", arguments.common.quiet);
        let tell = |done, total| progress.tell(done, total);
        check::check(&object, &grids, arguments.check_self.then_some(&tell))
    };
    if let Some(mut file) = preview {
        let svg = preview::svg(&object, &grids, &findings);
        file.write_all(svg.as_bytes()).map_err(|source| file.failed(source))?;
        outputs.push(file);
    }
    let remark = Batch::commit(outputs)?;
    if let Some(remark) = remark.filter(|_| !arguments.common.quiet) {
        say(format_args!("sweep: note: {remark}"));
    }
    if !arguments.common.quiet {
        let files = [output, arguments.preview.as_deref()].into_iter().flatten();
        files
            .filter(|file| !input::is_stdin(file))
            .for_each(|file| wrote(file, None, start.elapsed()));
    }
    if !arguments.common.quiet && !checks {
        object.parts().iter().for_each(report::note);
    }
    if arguments.stats {
        object.parts().iter().for_each(report::stats);
        let search: Duration = object.parts().iter().map(Sweep::time_of_search).sum();
        let stages = [
            ("read", (read - start).saturating_sub(search)),
            ("cells", search),
            ("sweep", spent.sweeping),
            ("write", spent.writing),
        ];
        for (stage, time) in stages {
            say(format_args!("{stage:<11} {:.2} ms", 1e3 * time.as_secs_f64()));
        }
    }
    if checks { report::print_check(&name, &object, &grids, &findings) } else { Ok(()) }
}

/// Prints the schema of specs.
fn emit_schema() -> Result<(), Report> {
    let mut output = Output::create(Path::new("-"), true)?;
    writeln!(output, "{:#}", schema::of_spec()).map_err(|source| output.failed(source))?;
    Ok(output.commit()?)
}
