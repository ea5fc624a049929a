//! `triangulate`: a grid of `sweep` to triangles, as OBJ, STL or PLY.

mod cli;

use clap::Parser;
use cli::{Arguments, Format};
use files::exit::say;
use files::{Output, Report, exit, input};
use std::io::{IsTerminal, stdin, stdout};
use std::process::ExitCode;
use sweep::grid::file::GridReader;
use triangulate::{Counts, TriangulateError, read_mesh, write_obj, write_ply, write_stl};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    exit::run("triangulate", || work(&arguments))
}

fn work(arguments: &Arguments) -> Result<(), Report> {
    arguments.check(stdout().is_terminal())?;
    let (options, format) = (arguments.options(), arguments.format());
    if input::is_stdin(&arguments.grid) && stdin().is_terminal() {
        return Err(TriangulateError::Terminal.into());
    }
    // Before any reading, so that a folder that cannot be written is told at once.
    let mut output = Output::create(&arguments.output, !arguments.no_clobber)?;
    let name = input::name_of(&arguments.grid);
    let mut reader =
        GridReader::open(&name, input::open(&arguments.grid)?).map_err(TriangulateError::Grid)?;
    let written = match format {
        Format::Obj => write_obj(&mut reader, &options, &mut output),
        Format::Stl | Format::Ply => read_mesh(&mut reader, &options).and_then(|(mesh, counts)| {
            let done = match format {
                Format::Ply => write_ply(&mesh, &mut output),
                _ => write_stl(&mesh, &mut output),
            };
            done.map(|()| counts).map_err(TriangulateError::Write)
        }),
    };
    let counts = written.map_err(|error| match error {
        TriangulateError::Write(source) => Report::from(output.failed(source)),
        error => error.into(),
    })?;
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
    let format = arguments.format();
    if *moved > MOVED {
        say(format_args!(
            "triangulate: note: {grid}: the seven digits of {} {} moved points by up to {moved:.0e} \
             of the object's size; it would keep its shape nearer to the origin",
            if format == Format::Ply { "a" } else { "an" },
            format.name()
        ));
    }
}
