//! `sweep`: a spec of curves in, a contour x trajectory grid out.

use clap::{Parser, ValueEnum};
use files::exit::{Exit, Failure, Report, say};
use files::json::Document;
use files::progress::Progress;
use files::{Batch, Ledger, Output, exit, extension, input, memory, words};
use std::io::{self, IsTerminal, Write};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use sweep::check::resolution::aliases;
use sweep::check::{self, Finding, Severity};
use sweep::grid::file::Encoding;
use sweep::spec::Mesh;
use sweep::{GridMesh, Object, Spent, Sweep, preview, schema};
use thiserror::Error;

/// Sweep a contour along a trajectory: a JSON spec in, a grid of points and normals out.
#[derive(Debug, Parser)]
#[command(name = "sweep", version, after_help = EXAMPLES)]
struct Arguments {
    /// The spec, a JSON file; - is standard input
    #[arg(default_value = "-", value_name = "SPEC")]
    spec: PathBuf,

    /// The grid file; - is standard output, and the default without --check and --preview
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Say what is wrong or suspicious on standard output; ends with 4 if something is wrong
    #[arg(long)]
    check: bool,

    /// Check also where parts of a surface meet far from each other
    #[arg(long)]
    check_self: bool,

    /// Draw contour, trajectory, frames, laws and surface: an SVG file
    #[arg(long, value_name = "FILE")]
    preview: Option<PathBuf>,

    /// How the rows of the grid are written
    #[arg(long, value_enum, default_value_t = Format::Bin)]
    format: Format,

    /// Cells along the trajectory, in place of the spec's
    #[arg(long, value_name = "N")]
    rows: Option<usize>,

    /// Cells along the contour, in place of the spec's
    #[arg(long, value_name = "N")]
    cols: Option<usize>,

    /// The largest distance between triangles and surface, in place of the spec's resolution
    #[arg(long, value_name = "LENGTH", conflicts_with_all = ["rows", "cols", "pixels"])]
    tol: Option<f64>,

    /// The largest angle between triangles and surface, in degrees
    #[arg(long, value_name = "DEGREES", conflicts_with_all = ["rows", "cols"])]
    angle: Option<f64>,

    /// The largest distance in pixels of the spec's camera
    #[arg(long, value_name = "N", conflicts_with_all = ["rows", "cols"])]
    pixels: Option<f64>,

    /// Cells at most where a tolerance is asked for [default: 2000000]
    #[arg(long, value_name = "N", conflicts_with_all = ["rows", "cols"])]
    max_quads: Option<usize>,

    /// Memory to take at most, in bytes or with k, M or G; what needs more is refused before it is
    /// begun [default: 90 % of what is free]
    #[arg(long, value_name = "BYTES", value_parser = files::memory::bytes)]
    max_memory: Option<u64>,
    /// Threads to use, up to 1024; all cores by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Print the JSON Schema of specs and do nothing else
    #[arg(long, exclusive = true)]
    emit_schema: bool,

    /// Print no notes
    #[arg(short, long)]
    quiet: bool,

    /// Print sizes and times on standard error
    #[arg(long)]
    stats: bool,

    /// Fail if the output file exists
    #[arg(long)]
    no_clobber: bool,
}

const EXAMPLES: &str = "\
Examples:
  sweep examples/curves/vase.json -o vase.grid
  sweep examples/curves/trefoil.json --rows 1000 --cols 64 --stats -o trefoil.grid
  sweep examples/curves/vase.json --tol 1e-3 --angle 5 --stats -o vase.grid
  sweep --emit-schema > tb-sweep.schema.json
  sweep --format json < examples/curves/cup-handle.json | head -3
  sweep examples/curves/vase.json | triangulate --texture 2 > vase.obj
  sweep --check examples/curves/klein-bottle.json
  sweep --preview trefoil.svg examples/curves/trefoil.json

An output is never a file that the spec is read from, and its name does not end as another format
does: a grid is .grid (or .json with --format json), a preview .svg; other endings are free.
The grid and the preview are replaced together.";

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Format {
    /// Little-endian numbers: small and fast
    Bin,
    /// One JSON array a row, for people and diffs
    Json,
}

impl Format {
    /// What the name of a grid's file may end with.
    fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Bin => &["grid"],
            Self::Json => &["grid", "json"],
        }
    }
}

#[derive(Debug, Error)]
enum UseError {
    #[error("the binary grid is not for a terminal: name a file with -o, or use --format json")]
    Terminal,
    #[error("cannot start {threads} threads: {source}")]
    Threads { threads: u16, source: rayon::ThreadPoolBuildError },
    #[error("found two things for standard output, expected one: name files with -o and --preview")]
    Crowded,
    #[error("{name}: the check found {count} wrong")]
    Wrong { name: String, count: NonZeroUsize },
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        match self {
            Self::Terminal | Self::Crowded => Exit::Use,
            Self::Wrong { .. } => Exit::Geometry,
            Self::Threads { .. } => Exit::Resource,
        }
    }
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    exit::run("sweep", || work(&arguments))
}

impl Arguments {
    /// The keys of `mesh` that stand in place of the spec's.
    fn mesh(&self) -> Mesh {
        Mesh {
            rows: self.rows,
            cols: self.cols,
            tol: self.tol,
            angle_deg: self.angle,
            pixels: self.pixels,
            camera: None,
            max_quads: self.max_quads,
        }
    }
}

fn work(arguments: &Arguments) -> Result<(), Report> {
    if arguments.emit_schema {
        return emit_schema();
    }
    let encoding = match arguments.format {
        Format::Bin => Encoding::Binary,
        Format::Json => Encoding::Json,
    };
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
    if let Some(threads) = arguments.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global()
            .map_err(|source| UseError::Threads { threads, source })?;
    }

    let start = Instant::now();
    memory::allow(arguments.max_memory);
    let ledger = Ledger::new(!arguments.no_clobber);
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
    let folder = arguments.spec.parent().unwrap_or(Path::new(""));
    let document = Document::new(&name, &bytes)?;
    let object = Object::read(&document, folder, &ledger, &arguments.mesh())?;
    let read = Instant::now();
    let mut spent = Spent::default();
    let mut outputs = Vec::new();
    if let Some(mut file) = file {
        spent = object.write(encoding, &mut file).map_err(|source| file.failed(source))?;
        outputs.push(file);
    }
    // The grids as a whole only where they are looked at.
    let grids = if checks || preview.is_some() { object.grids()? } else { Vec::new() };
    let findings = if grids.is_empty() {
        Vec::new()
    } else {
        let progress = Progress::new("check", arguments.quiet);
        let tell = |done, total| progress.tell(done, total);
        check::check(&object, &grids, arguments.check_self.then_some(&tell))
    };
    if let Some(mut file) = preview {
        let svg = preview::svg(&object, &grids, &findings);
        file.write_all(svg.as_bytes()).map_err(|source| file.failed(source))?;
        outputs.push(file);
    }
    let remark = Batch::commit(outputs)?;
    if let Some(remark) = remark.filter(|_| !arguments.quiet) {
        say(format_args!("sweep: note: {remark}"));
    }
    if !arguments.quiet && !checks {
        object.parts().iter().for_each(note);
    }
    if arguments.stats {
        object.parts().iter().for_each(stats);
        let stages = [("read", read - start), ("sweep", spent.sweeping), ("write", spent.writing)];
        for (stage, time) in stages {
            say(format_args!("{stage:<11} {:.2} ms", 1e3 * time.as_secs_f64()));
        }
    }
    if checks { tell(&name, &object, &grids, &findings) } else { Ok(()) }
}

/// Says each part in a line and what was found in one each.
fn tell(
    name: &str,
    object: &Object,
    grids: &[GridMesh],
    findings: &[Finding],
) -> Result<(), Report> {
    let parts = object.parts().iter().zip(grids).map(|(part, grid)| check::summary(part, grid));
    let lines = parts.chain(findings.iter().map(Finding::to_string));
    let text: String = lines.map(|line| format!("{}\n", words::line(&line))).collect();
    Output::create(Path::new("-"), true)?.commit_all(text.as_bytes())?;
    let wrong = findings.iter().filter(|finding| finding.severity == Severity::Wrong).count();
    match NonZeroUsize::new(wrong) {
        Some(count) => Err(UseError::Wrong { name: name.into(), count }.into()),
        None => Ok(()),
    }
}

/// Prints the schema of specs.
fn emit_schema() -> Result<(), Report> {
    let mut output = Output::create(Path::new("-"), true)?;
    writeln!(output, "{:#}", schema::of_spec()).map_err(|source| output.failed(source))?;
    Ok(output.commit()?)
}

/// Says what is legal and most often not meant.
fn note(sweep: &Sweep) {
    let folds = sweep.survey().findings().into_iter();
    let folds = folds.filter(|finding| finding.severity == Severity::Wrong);
    for finding in folds.chain(aliases(sweep)) {
        say(format_args!("sweep: note: {}: {}", words::shown(sweep.name()), finding.message));
    }
    if let Some(missed) = sweep.missed() {
        say(format_args!("sweep: note: {}: {missed}", words::shown(sweep.name())));
    }
}

fn stats(sweep: &Sweep) {
    say(format_args!("object      {}", words::shown(sweep.name())));
    say(format_args!("cells       {} x {} (rows x cols)", sweep.rows(), sweep.cols()));
    let [rows, cols] = sweep.points();
    say(format_args!("points      {rows} x {cols}, {}", rows * cols));
    if let Some(reached) = sweep.reached() {
        say(format_args!("distance    {:.4e} to the surface", reached.tol));
        if let Some(pixels) = reached.pixels {
            say(format_args!("pixels      {pixels:.4} to the surface"));
        }
        say(format_args!("angle       {:.3} degrees to the normals", reached.angle_deg));
        say(format_args!("quads       {}, after {} rounds", reached.quads, reached.rounds));
    }
    say(format_args!("creases     {}", sweep.contour().creases()));
    say(format_args!("contour     {} long", sweep.contour().length()));
    for (segments, reached) in sweep.contour().fits() {
        say(format_args!("fit         {segments} segments, {reached:.4e} from the points"));
    }
    if sweep.trajectory().is_rotation() {
        say("trajectory  a rotation");
    } else {
        say(format_args!("trajectory  {} long", sweep.trajectory().length()));
    }
}
