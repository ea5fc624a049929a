//! `sweep`: a spec of curves in, a contour x trajectory grid out.

use clap::{Parser, ValueEnum};
use files::exit::{Exit, Failure, Report, say};
use files::input;
use files::json::Document;
use files::{Output, exit};
use std::io::{self, IsTerminal};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use sweep::check::fold::Survey;
use sweep::check::{self, Finding, Severity};
use sweep::grid::file::{self, Encoding};
use sweep::{GridMesh, Object, Sweep, preview};
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

    /// Threads to use, up to 1024; all cores by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

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
  sweep --format json < examples/curves/cup-handle.json | head -3
  sweep examples/curves/vase.json | triangulate --texture 2 > vase.obj
  sweep --check examples/curves/klein-bottle.json
  sweep --preview trefoil.svg examples/curves/trefoil.json";

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Format {
    /// Little-endian numbers: small and fast
    Bin,
    /// One JSON array a row, for people and diffs
    Json,
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

fn work(arguments: &Arguments) -> Result<(), Report> {
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
    let bytes = input::read(&arguments.spec)?;
    let name = input::name_of(&arguments.spec);
    let document = Document::new(&name, &bytes)?;
    let object = Object::read(&document)?.with_resolution(arguments.rows, arguments.cols)?;
    let read = Instant::now();
    let create = |path| Output::create(path, !arguments.no_clobber);
    let mut grid_file = output.map(create).transpose()?;
    let preview = arguments.preview.as_deref().map(create).transpose()?;
    let grids = object.grids()?;
    let swept = Instant::now();
    if let Some(mut file) = grid_file.take() {
        for grid in &grids {
            file::write(grid, encoding, &mut file).map_err(|source| file.failed(source))?;
        }
        file.commit()?;
    }
    let written = Instant::now();

    let findings = if checks || preview.is_some() {
        check::check(&document, &object, &grids, arguments.check_self)?
    } else {
        Vec::new()
    };
    if let Some(file) = preview {
        file.commit_all(preview::svg(&object, &grids, &findings).as_bytes())?;
    }
    if !arguments.quiet && !checks {
        object.parts().iter().for_each(note);
    }
    if arguments.stats {
        let stages = [("read", read - start), ("sweep", swept - read), ("write", written - swept)];
        for (sweep, grid) in object.parts().iter().zip(&grids) {
            stats(sweep, grid);
        }
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
    let text: String = lines.map(|line| format!("{line}\n")).collect();
    Output::create(Path::new("-"), true)?.commit_all(text.as_bytes())?;
    let wrong = findings.iter().filter(|finding| finding.severity == Severity::Wrong).count();
    match NonZeroUsize::new(wrong) {
        Some(count) => Err(UseError::Wrong { name: name.into(), count }.into()),
        None => Ok(()),
    }
}

/// Says what is legal and most often not meant.
fn note(sweep: &Sweep) {
    for finding in Survey::of(sweep).findings() {
        if finding.severity == Severity::Wrong {
            say(format_args!("sweep: note: {}: {}", sweep.name(), finding.message));
        }
    }
}

fn stats(sweep: &Sweep, grid: &GridMesh) {
    say(format_args!("object      {}", sweep.name()));
    say(format_args!("cells       {} x {} (rows x cols)", sweep.rows(), sweep.cols()));
    say(format_args!("points      {} x {}, {}", grid.rows(), grid.cols(), grid.positions.len()));
    say(format_args!("creases     {}", sweep.contour().creases()));
    say(format_args!("contour     {} long", sweep.contour().length()));
    if sweep.trajectory().is_rotation() {
        say("trajectory  a rotation");
    } else {
        say(format_args!("trajectory  {} long", sweep.trajectory().length()));
    }
}
