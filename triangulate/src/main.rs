//! `triangulate`: a grid of `sweep` to triangles, as OBJ.

use clap::Parser;
use files::exit::say;
use files::{Output, Report, exit, input};
use std::io::{IsTerminal, stdin};
use std::path::PathBuf;
use std::process::ExitCode;
use sweep::grid::file::GridReader;
use triangulate::{Counts, Options, TriangulateError, write_obj};

const EXAMPLES: &str = "\
Examples:
  sweep vase.json -o vase.grid            a grid from a curve spec, then
  triangulate vase.grid -o vase.obj       its triangles
  sweep vase.json | triangulate --texture 2 | render scene.json --mesh vase=- -o vase.png

An output file is replaced only when the whole grid was read and found undamaged. An OBJ on
standard output is whole when its last line is `# end V F` (numbers of v and f lines).";

/// Makes triangles of a grid that `sweep` wrote, as OBJ.
#[derive(Debug, Parser)]
#[command(version, after_help = EXAMPLES)]
struct Arguments {
    /// The grid file; - is standard input
    #[arg(default_value = "-")]
    grid: PathBuf,
    /// The OBJ file; - is standard output
    #[arg(short, long, value_name = "MESH.obj", default_value = "-")]
    output: PathBuf,
    /// Texture id, which a scene binds to a picture; 0 is none
    #[arg(long, value_name = "ID", default_value_t = 0)]
    texture: u32,
    /// Surface id, which a scene binds to a material
    #[arg(long, value_name = "ID", default_value_t = 0)]
    surface: u32,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
    /// Print how many vertices and triangles were made, to standard error
    #[arg(long)]
    stats: bool,
    /// Do not replace an existing output file
    #[arg(long)]
    no_clobber: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    exit::run("triangulate", || work(&arguments))
}

fn work(arguments: &Arguments) -> Result<(), Report> {
    let options = Options { texture: arguments.texture, surface: arguments.surface };
    if input::is_stdin(&arguments.grid) && stdin().is_terminal() {
        return Err(TriangulateError::Terminal.into());
    }
    // Before any reading, so that a folder that cannot be written is told at once.
    let mut output = Output::create(&arguments.output, !arguments.no_clobber)?;
    let name = input::name_of(&arguments.grid);
    let mut reader =
        GridReader::open(&name, input::open(&arguments.grid)?).map_err(TriangulateError::Grid)?;
    let counts = match write_obj(&mut reader, &options, &mut output) {
        Ok(counts) => counts,
        Err(TriangulateError::Write(source)) => return Err(output.failed(source).into()),
        Err(error) => return Err(error.into()),
    };
    output.commit()?;
    report(arguments, &name, &counts);
    Ok(())
}

/// Coordinates moved by more than this fraction of the object's size are worth a word: a tenth of
/// a pixel where the object fills a picture of a thousand.
const MOVED: f64 = 1e-4;

/// Words for people, on standard error.
fn report(arguments: &Arguments, grid: &str, counts: &Counts) {
    let Counts { positions, uvs, normals, triangles, collapsed, slivers, moved } = counts;
    if arguments.stats {
        say(format_args!(
            "triangles {triangles}\npositions {positions}\nnormals {normals}\n\
             picture_coordinates {uvs}\nleft_out_at_poles_and_creases {collapsed}\n\
             left_out_slivers {slivers}\nmoved_by_rounding {moved:.1e}"
        ));
    }
    if arguments.quiet {
        return;
    }
    if *triangles == 0 {
        say(format_args!(
            "triangulate: note: {grid}: the mesh has no triangles: all its points lie on a line, or \
             are one point"
        ));
    } else if *slivers > 0 {
        say(format_args!(
            "triangulate: note: {grid}: left out {slivers} triangles whose corners lie on a line; \
             the mesh has slits of no width there"
        ));
    }
    if *moved > MOVED {
        say(format_args!(
            "triangulate: note: {grid}: the seven digits of an OBJ moved points by up to {moved:.0e} \
             of the object's size; it would keep its shape nearer to the origin"
        ));
    }
}
