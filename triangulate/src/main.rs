//! `triangulate`: a grid of `sweep` to triangles, as OBJ, STL or PLY.

mod cli;

use clap::Parser;
use cli::{Arguments, Format};
use files::exit::say;
use files::json::Document;
use files::memory::{Reserved, of_process};
use files::{Batch, Ledger, MemoryError, Output, Report, exit, input};
use std::io::{BufRead, IsTerminal, Write, stdin, stdout};
use std::path::Path;
use std::process::ExitCode;
use sweep::GridMesh;
use sweep::grid::file::GridReader;
use triangulate::mtl::mtl;
use triangulate::{
    Counts, Material, MeshReport, ObjWriter, Options, Sink, TriMesh, TriangulateError, area_file,
    run_grids, run_rows, write_ply, write_stl,
};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    exit::run("triangulate", || work(&arguments))
}

fn work(arguments: &Arguments) -> Result<(), Report> {
    files::memory::allow(arguments.max_memory);
    arguments.check(stdout().is_terminal())?;
    if input::is_stdin(&arguments.grid) && stdin().is_terminal() {
        return Err(TriangulateError::Terminal.into());
    }
    // Before any reading, so that a folder that cannot be written is told at once.
    let ledger = Ledger::new(!arguments.no_clobber);
    let create = |path: &Path, flag: &str| -> Result<Output, Report> {
        Ok(ledger.output(path, &format!("name another file with {flag}"))?)
    };
    let mut output = create(&arguments.output, "-o")?;
    let mtl_output = arguments.mtl().map(|path| create(&path, "-o")).transpose()?;
    let report_output =
        arguments.report.as_deref().map(|path| create(path, "--report")).transpose()?;
    ledger.expect(&arguments.grid, "the grid")?;
    if let Some(areas) = &arguments.areas {
        ledger.expect(areas, "the areas")?;
    }
    arguments.check_names()?;
    let name = input::name_of(&arguments.grid);
    let grid = ledger.open(&arguments.grid, "the grid")?;
    let mut reader = GridReader::open(&name, grid).map_err(TriangulateError::Grid)?;
    let written = match &arguments.areas {
        None => write(arguments, &mut Grid::File(&mut reader), &mut output),
        Some(areas) => {
            let grids = with_areas(areas, &ledger, &mut reader)?;
            write(arguments, &mut Grid::<&[u8]>::Memory(&grids), &mut output)
        }
    };
    let Written { mesh, materials, counts } = written.map_err(|error| match error {
        TriangulateError::Write(source) => Report::from(output.failed(source)),
        error => error.into(),
    })?;
    let mut outputs = vec![output];
    if let Some(mut output) = mtl_output {
        let mtl = mtl(&materials, arguments.map.as_deref());
        output.write_all(mtl.as_bytes()).map_err(|source| output.failed(source))?;
        outputs.push(output);
    }
    if let (Some(mut output), Some(mesh)) = (report_output, mesh) {
        let report = MeshReport::of(&mesh, &counts);
        report.write(&mut output).map_err(|source| output.failed(source))?;
        outputs.push(output);
    }
    let remark = Batch::commit(outputs)?;
    if let Some(remark) = remark.filter(|_| !arguments.quiet) {
        say(format_args!("triangulate: note: {remark}"));
    }
    note(arguments, &name, &counts);
    Ok(())
}

/// All patches of a grid, with the areas of a file on them.
fn with_areas(
    areas: &Path,
    ledger: &Ledger,
    reader: &mut GridReader<impl BufRead>,
) -> Result<Vec<GridMesh>, Report> {
    let bytes = ledger.argument_json(areas, "the areas")?;
    let name = input::name_of(areas);
    let document = Document::new(&name, &bytes)?;
    let mut grids = reader.read_rest().map_err(TriangulateError::Grid)?;
    area_file::add(&document, &mut grids)?;
    Ok(grids)
}

/// Where rows come from.
enum Grid<'a, R> {
    /// One by one from a file.
    File(&'a mut GridReader<R>),
    /// From memory.
    Memory(&'a [GridMesh]),
}

impl<R: BufRead> Grid<'_, R> {
    fn run<S: Sink>(
        &mut self,
        options: &Options,
        sink: S,
    ) -> Result<(S, Counts), TriangulateError> {
        match self {
            Self::File(reader) => run_rows(reader, options, sink),
            Self::Memory(grids) => run_grids(grids, options, sink),
        }
    }
}

impl<R: BufRead> Grid<'_, R> {
    /// Takes the memory for a mesh of the first patch, or of all that are in memory.
    fn reserve_mesh(&self) -> Result<Reserved<'static>, MemoryError> {
        let points = match self {
            Self::File(reader) => {
                let header = reader.header();
                (header.rows as u64).saturating_mul(header.cols() as u64)
            }
            Self::Memory(grids) => grids.iter().map(|grid| grid.positions.len() as u64).sum(),
        };
        let what = || format!("a mesh of {points} points");
        of_process().reserve(TriMesh::bytes_for(points), what)
    }
}

/// What is known once the mesh is written.
struct Written {
    /// The mesh, where it was needed whole.
    mesh: Option<TriMesh>,
    /// The materials that it names.
    materials: Vec<Material>,
    counts: Counts,
}

/// Writes the mesh in the wanted format.
fn write(
    arguments: &Arguments,
    grid: &mut Grid<'_, impl BufRead>,
    out: &mut impl Write,
) -> Result<Written, TriangulateError> {
    let (options, format) = (arguments.options(), arguments.format());
    let whole = format != Format::Obj || arguments.report.is_some();
    let _reserved = if whole { Some(grid.reserve_mesh()?) } else { None };
    if format == Format::Obj {
        let writer = ObjWriter::with_materials(arguments.mtl_name().as_deref(), out);
        let (writer, mesh, counts) = if arguments.report.is_some() {
            let ((writer, mesh), counts) = grid.run(&options, (writer, TriMesh::default()))?;
            (writer, Some(mesh), counts)
        } else {
            let (writer, counts) = grid.run(&options, writer)?;
            (writer, None, counts)
        };
        let materials = writer.materials();
        writer.finish(&counts).map_err(TriangulateError::Write)?;
        return Ok(Written { mesh, materials, counts });
    }
    let (mesh, counts) = grid.run(&options, TriMesh::default())?;
    let done = if format == Format::Ply { write_ply(&mesh, out) } else { write_stl(&mesh, out) };
    done.map_err(TriangulateError::Write)?;
    Ok(Written { mesh: Some(mesh), materials: Vec::new(), counts })
}

/// Coordinates moved by more than this fraction of the object's size are worth a word: a tenth of
/// a pixel where the object fills a picture of a thousand.
const MOVED: f64 = 1e-4;

/// Words for people, on standard error.
fn note(arguments: &Arguments, grid: &str, counts: &Counts) {
    let Counts { positions, uvs, normals, triangles, collapsed, slivers, moved, .. } = counts;
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
    if counts.tolerance_used > 1.0 {
        say(format_args!(
            "triangulate: note: {grid}: rounding to the seven digits of {} moved points by up to {:.1e}, \
             {:.1} times the tolerance that the grid was made to",
            format.name(),
            counts.displacement,
            counts.tolerance_used
        ));
    } else if *moved > MOVED {
        say(format_args!(
            "triangulate: note: {grid}: the seven digits of {} {} moved points by up to {moved:.0e} \
             of the object's size; it would keep its shape nearer to the origin",
            if format == Format::Ply { "a" } else { "an" },
            format.name()
        ));
    }
}
