//! The command line of the program `pipeline`, with a file for each command.

mod bar;
mod book;
mod calibrate;
mod compare;
mod export;
mod farm;
mod flicker;
mod frames;
mod join;
mod list;
mod named;
mod new;
mod pack;
mod report;
mod run;
mod schema;
mod show;
#[cfg(feature = "studio")]
mod studio;

use crate::report::measure::Memory;
use clap::{CommandFactory, Parser, Subcommand};
use files::{FileError, Report};
use std::path::Path;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  pipeline list
  pipeline run glass-sphere vase -o out
  pipeline run A.11 -o out
  pipeline run all -o out --size 1024x1024 --keep
  pipeline new vase -o vase.json
  pipeline show vase.json -o vase.png
  pipeline show vase.json --view front --color teal -D scene.camera.fov_deg=20 -o front.png
  pipeline export vase -o my-vase
  pipeline run my-vase/pages/vase.json -o out --stats
  pipeline run vase -D scene.camera.fov_deg=30 -D specs.vase.mesh.cols=40 -o out
  pipeline run vase --error 0.005 -o out
  pipeline run frontispiece --mode exact --size 4096x4096 -o poster
  pipeline run turntable.json --frames 1-24 --film turntable.gif -o frames
  pipeline report glass-sphere -o report --quick
  pipeline report --calibrate --scenes 50 -o report
  pipeline report --flicker -o report
  pipeline book -o book
  pipeline farm turntable.json --engine slurm --chunk 10 --film turntable.mp4 --script frames.sh
  pipeline pack my-vase/pages/vase.json -o for-cluster
  pipeline join part-1.exr part-2.exr -o whole.exr
  pipeline studio vase
  pipeline compare a.png b.png --map difference.png --rmse 0.01
  pipeline --emit-schema job > tb-job.schema.json

pipeline completions SHELL prints completions for bash, elvish, fish, powershell or zsh; pipeline man
prints a page for man.

No output replaces an input: a job, a scene and its parts, a spec, a mesh, a picture.
Files that belong together (those of a job; with --sheet of all jobs; those of a report; textures)
are replaced one after another. Meanwhile the file NAME.incomplete in their folder lists the
files. NAME.incomplete remains if the program stops between two of the files, until the next
complete run.

Exit codes:
  1 pictures that differ by more than is allowed, 2 bad use, 3 malformed input
  4 impossible geometry, 5 cannot read or write
  6 too large, 7 a requested error was not reached
  70 a bug, 130 interrupted, 143 terminated, 141 closed pipe";

/// From curves to pictures: sweep, triangulate and render in one process.
#[derive(Debug, Parser)]
#[command(name = "pipeline", version, after_help = EXAMPLES, arg_required_else_help = true)]
struct Arguments {
    /// Print the JSON Schema of a file format and do nothing else
    #[arg(long, value_name = "FORMAT", num_args = 0..=1, default_missing_value = "job")]
    emit_schema: Option<schema::Format>,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// List the built-in pages, and the figures of the thesis that each page shows
    List,
    /// Write an example of a curve spec or a scene, with notes on its keys, as a starting point
    New(new::NewArguments),
    /// Write the files of a built-in page into a folder, as a starting point for your own job
    Export(export::ExportArguments),
    /// Make a picture of a curve spec, a grid or a mesh, without a scene and a job
    Show(show::ShowArguments),
    /// Make the pictures of built-in pages or of your own jobs
    Run(run::RunArguments),
    /// Write a script for Slurm, GNU parallel or make, by which many machines make the frames of an animation
    Farm(farm::FarmArguments),
    /// Collect all files that a job reads in a folder, for another machine
    Pack(pack::PackArguments),
    /// Put the parts of a picture together, which `render --tile` made
    Join(join::JoinArguments),
    /// Measure the cost of each rendering method and the error of its pictures
    Report(report::ReportArguments),
    /// Make the picture book: pages with their modes, costs and errors, as one file of HTML
    Book(book::BookArguments),
    /// Measure the differences between two pictures, in linear light
    Compare(compare::CompareArguments),
    /// Edit curves and scenes beside their picture, on a page of a local address
    #[cfg(feature = "studio")]
    Studio(studio::StudioArguments),
}

/// Runs the program with the arguments of the process, and prints an error if there is one.
///
/// `memory` counts the memory of the process, which only the report needs. Without `memory`, this
/// process continues a report as the program that counts.
#[must_use]
pub fn main(memory: Option<&dyn Memory>) -> ExitCode {
    if let Some(code) = files::shell::answer(Arguments::command()) {
        return code;
    }
    let arguments = Arguments::parse();
    files::exit::run("pipeline", || match (&arguments.command, arguments.emit_schema) {
        (_, Some(format)) => schema::emit(format),
        (Some(command), None) => run(command, memory),
        (None, None) => Ok(()),
    })
}

fn run(command: &Command, memory: Option<&dyn Memory>) -> Result<(), Report> {
    match command {
        Command::List => list::list(),
        Command::New(arguments) => new::new(arguments),
        Command::Export(arguments) => export::export(arguments),
        Command::Show(arguments) => show::show(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Farm(arguments) => farm::farm(arguments),
        Command::Pack(arguments) => pack::pack(arguments),
        Command::Join(arguments) => join::join(arguments),
        Command::Report(arguments) if arguments.calibrate => report::calibrate(arguments),
        Command::Report(arguments) if arguments.flicker => report::flicker(arguments),
        Command::Report(arguments) => match memory {
            Some(memory) => report::report(arguments, memory),
            None => Ok(report::hand_over()?),
        },
        Command::Book(arguments) => book::book(arguments),
        Command::Compare(arguments) => compare::compare(arguments),
        #[cfg(feature = "studio")]
        Command::Studio(arguments) => studio::studio(arguments),
    }
}

/// The remedy for an output that is also an input.
const OTHER_FOLDER: &str = "choose another folder with -o";

/// Makes the folder for the files of a command.
fn make_folder(folder: &Path) -> Result<(), FileError> {
    let named = |source| FileError::Write { name: folder.display().to_string(), source };
    std::fs::create_dir_all(folder).map_err(named)
}
