//! The arguments of the program `triangulate`, and its run.

mod grid;
mod note;
mod write;

use clap::Parser;
use files::exit::{say, wrote};
use files::extension::{self, WrongExtension};
use files::{Batch, CommonArguments, Exit, Failure, Ledger, Output, Report, Setting, input};
use grid::{Grid, Place};
use std::io::{IsTerminal, Write, stdin, stdout};
use std::path::{Path, PathBuf};
use std::time::Instant;
use sweep::grid::file::GridReader;
use thiserror::Error;
use triangulate::mtl::{is_map_name, mtl};
use triangulate::obj::object_name;
use triangulate::up::Up;
use triangulate::{Format, MeshReport, Options, TriangulateError, Unit};
use write::Written;

const EXAMPLES: &str = "\
Examples:
  pipeline new vase -o vase.json          a curve spec,
  sweep vase.json -o vase.grid            its grid,
  triangulate vase.grid -o vase.obj       and its triangles
  sweep vase.json | triangulate | render - -o vase.png
  triangulate vase.grid -o vase.3mf --unit centimeter --up z      for a printer
  triangulate vase.grid -o vase.obj --report -                    is it closed?
  triangulate vase.grid -o vase.obj --mtl --map marble.png        for other renderers

An output file is replaced only when the whole grid was read and found undamaged. An OBJ on
standard output is whole when its last line is `# end V F` (numbers of v and f lines).
Mesh, material file and report are replaced together. No output replaces an input.
The extension of an output must not belong to another format (a.fbx), unless --format is given;
unknown extensions are allowed.

triangulate completions SHELL prints completions for bash, elvish, fish, powershell or zsh.
triangulate man prints a page for man.

Exit codes:
  2 bad use, 3 malformed input
  5 cannot read or write, 6 too large
  70 a bug, 130 interrupted, 143 terminated, 141 closed pipe";

/// Makes triangles of a grid that `sweep` wrote, as OBJ, STL, PLY, GLB or 3MF.
#[derive(Debug, Parser)]
#[command(name = "triangulate", version, after_help = EXAMPLES)]
pub struct Arguments {
    /// The grid file; - is standard input
    #[arg(default_value = "-")]
    pub grid: PathBuf,
    /// The mesh file; - is standard output
    #[arg(short, long, value_name = "MESH", default_value = "-")]
    pub output: PathBuf,
    /// Format of the mesh [default: the format of the output's extension (.stl, .ply, .glb, .3mf), or
    /// else OBJ]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Unit of the grid's lengths, which a 3MF states and a GLB converts to meters [default: the unit of
    /// the spec, or else millimeter in a 3MF and meter in a GLB]
    #[arg(long, value_enum)]
    pub unit: Option<Unit>,
    /// Texture id, which a scene binds to a picture; 0 is none. Replaces the ids in the grid
    #[arg(long, value_name = "ID")]
    texture: Option<u32>,
    /// Surface id, which a scene binds to a material. Replaces the ids in the grid
    #[arg(long, value_name = "ID")]
    surface: Option<u32>,
    /// Axis that points up in the mesh
    #[arg(long, value_enum, default_value_t)]
    up: Up,
    /// Texture areas (tb-areas JSON) that cover the areas of the grid. Keeps the grid in memory
    #[arg(long, value_name = "FILE.json")]
    pub areas: Option<PathBuf>,
    /// Set a value of the areas: -D areas[0].texture=2; may be given several times
    #[arg(short = 'D', value_name = "PATH=VALUE", requires = "areas")]
    pub settings: Vec<Setting>,
    /// Write a material file beside the OBJ, under its name with .mtl
    #[arg(long)]
    mtl: bool,
    /// Picture that the MTL names, exactly as given; readers look for it beside the MTL
    #[arg(long, value_name = "FILE", requires = "mtl", value_parser = map_name)]
    pub map: Option<String>,
    /// Write a report about the mesh (Euler number, rims, sides, measures) as JSON; - is standard
    /// output. Keeps the mesh in memory
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// Print the numbers of vertices and triangles on standard error
    #[arg(long)]
    pub stats: bool,
    #[command(flatten)]
    pub common: CommonArguments,
}

/// Arguments that contradict each other, or that do not suit the terminal.
#[derive(Debug, Error)]
pub enum UseError {
    /// A binary file for a terminal, which would take its bytes for commands.
    #[error("a binary {0} is not for a terminal: name a file with -o, or use --format obj")]
    Terminal(&'static str),
    /// Standard input for the grid and for the areas.
    #[error("--areas - would read from the grid's standard input: name a file for one of them")]
    AreasPlace,
    /// A material file for a format that names none.
    #[error("--mtl is for OBJ, and the format is {0}")]
    MtlFormat(&'static str),
    /// A unit for a format that states none.
    #[error("--unit is for 3MF and GLB, and the format is {0}")]
    UnitFormat(&'static str),
    /// A material file for an output that has no folder.
    #[error("--mtl found {0} as the output, expected a file to lie beside: name one with -o")]
    MtlPlace(String),
    /// Standard output for the mesh and for the report.
    #[error("--report - would write into the mesh on standard output: name a file for one of them")]
    ReportPlace,
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

/// Reads the grid, writes its triangles, and replaces all outputs together.
pub fn run(arguments: &Arguments) -> Result<(), Report> {
    let start = Instant::now();
    arguments.common.begin();
    arguments.check(stdout().is_terminal())?;
    if input::is_stdin(&arguments.grid) && stdin().is_terminal() {
        return Err(TriangulateError::Terminal.into());
    }
    let ledger = arguments.common.ledger();
    let mut outputs = Outputs::create(arguments, &ledger)?;
    ledger.expect(&arguments.grid, "the grid")?;
    if let Some(areas) = &arguments.areas {
        ledger.expect(areas, "the areas")?;
    }
    arguments.check_names()?;
    let name = input::name_of(&arguments.grid);
    let file = ledger.open(&arguments.grid, "the grid")?;
    let mut reader = GridReader::open(&name, file).map_err(TriangulateError::Grid)?;
    let written = match &arguments.areas {
        None => {
            let mut grid = Grid { source: Place::File(&mut reader), up: arguments.up };
            write::write(arguments, &mut grid, &mut outputs.mesh)
        }
        Some(areas) => {
            let grids = grid::with_areas((areas, &arguments.settings), &ledger, &mut reader)?;
            let source = Place::<&[u8]>::Memory(&grids);
            write::write(arguments, &mut Grid { source, up: arguments.up }, &mut outputs.mesh)
        }
    };
    let written = written.map_err(|error| outputs.mesh_failure(error))?;
    let counts = written.counts;
    let remark = outputs.commit(arguments, written)?;
    if let Some(remark) = remark.filter(|_| !arguments.common.quiet) {
        say(format_args!("triangulate: note: {remark}"));
    }
    if !arguments.common.quiet {
        let files = [Some(arguments.output.clone()), arguments.mtl(), arguments.report.clone()];
        let files = files.iter().flatten().filter(|file| !is_stdout(file));
        files.for_each(|file| wrote(file, None, start.elapsed()));
    }
    note::print(arguments, &name, &counts);
    Ok(())
}

/// The files that a run writes. None of them replaces its predecessor before [`Outputs::commit`].
struct Outputs {
    mesh: Output,
    mtl: Option<Output>,
    report: Option<Output>,
}

impl Outputs {
    /// Creates the files before any file is read, so that a folder without write permission is an
    /// error at once.
    fn create(arguments: &Arguments, ledger: &Ledger) -> Result<Self, Report> {
        let create = |path: &Path, flag: &str| -> Result<Output, Report> {
            Ok(ledger.output(path, &format!("name another file with {flag}"))?)
        };
        Ok(Self {
            mesh: create(&arguments.output, "-o")?,
            mtl: arguments.mtl().map(|path| create(&path, "-o")).transpose()?,
            report: arguments.report.as_deref().map(|path| create(path, "--report")).transpose()?,
        })
    }

    /// Turns a failure to make or write the mesh into a report that names the output.
    fn mesh_failure(&self, error: TriangulateError) -> Report {
        if let TriangulateError::Write(source) = error {
            return self.mesh.failed(source).into();
        }
        error.into()
    }

    /// Writes the material file and the report, and replaces all files together. Returns a remark about
    /// the replacement, if there is one.
    fn commit(self, arguments: &Arguments, written: Written) -> Result<Option<String>, Report> {
        let mut outputs = vec![self.mesh];
        if let Some(mut output) = self.mtl {
            let mtl = mtl(&written.materials, arguments.map.as_deref());
            output.write_all(mtl.as_bytes()).map_err(|source| output.failed(source))?;
            outputs.push(output);
        }
        if let (Some(mut output), Some(mesh)) = (self.report, written.mesh) {
            let report = MeshReport::of(&mesh, &written.counts);
            if !arguments.common.quiet {
                note::merged(&mesh.name, &report);
            }
            report.write(&mut output).map_err(|source| output.failed(source))?;
            outputs.push(output);
        }
        Ok(Batch::commit(outputs)?)
    }
}

impl Arguments {
    /// Returns the ids that the arguments give to the triangles.
    pub fn options(&self) -> Options {
        Options { texture: self.texture, surface: self.surface }
    }

    /// Returns the format of `--format`, or else that of the output's extension, or else OBJ.
    pub fn format(&self) -> Format {
        let by_name = || Format::of_extension(self.output.extension()?.to_str()?);
        self.format.or_else(by_name).unwrap_or(Format::Obj)
    }

    /// Refuses arguments that contradict each other. `terminal` is true if standard output is a
    /// terminal.
    pub fn check(&self, terminal: bool) -> Result<(), UseError> {
        let format = self.format();
        if terminal && !format.is_text() && is_stdout(&self.output) {
            return Err(UseError::Terminal(format.name()));
        }
        if self.areas.as_deref().is_some_and(is_stdout) && is_stdout(&self.grid) {
            return Err(UseError::AreasPlace);
        }
        if self.unit.is_some() && !format.has_unit() {
            return Err(UseError::UnitFormat(format.name()));
        }
        if self.mtl {
            if format != Format::Obj {
                return Err(UseError::MtlFormat(format.name()));
            }
            if is_stdout(&self.output) {
                return Err(UseError::MtlPlace("standard output".into()));
            }
            if self.output.exists() && !self.output.is_file() {
                return Err(UseError::MtlPlace(self.output.display().to_string()));
            }
        }
        if self.report.as_deref().is_some_and(is_stdout) && is_stdout(&self.output) {
            return Err(UseError::ReportPlace);
        }
        Ok(())
    }

    /// Refuses an output whose extension is that of another format. `--format` allows any extension of
    /// the mesh.
    pub fn check_names(&self) -> Result<(), WrongExtension> {
        let format = self.format();
        if self.format.is_none() {
            extension::check(&self.output, format.content(), &[format.extension()])?;
        }
        match &self.report {
            Some(report) => extension::check(report, "a JSON report", &["json"]),
            None => Ok(()),
        }
    }

    /// Returns the path of the material file, if `--mtl` is given.
    pub fn mtl(&self) -> Option<PathBuf> {
        self.mtl_name().map(|name| self.output.with_file_name(name))
    }

    /// Returns the name of the material file as the OBJ contains it: one word, since an OBJ has no
    /// quotation marks.
    pub fn mtl_name(&self) -> Option<String> {
        let path = self.output.with_extension("mtl");
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        self.mtl.then(|| object_name(&name))
    }
}

/// Checks that an MTL can name the picture.
fn map_name(argument: &str) -> Result<String, String> {
    if is_map_name(argument) {
        Ok(argument.into())
    } else {
        Err("expected a name without `#`, line breaks, a dash before it or blanks around it, which \
             an MTL cannot hold"
            .into())
    }
}

fn is_stdout(argument: &Path) -> bool {
    argument.as_os_str() == "-"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(words: &[&str]) -> Arguments {
        Arguments::try_parse_from([&["triangulate"], words].concat()).unwrap()
    }

    #[test]
    fn the_format_is_the_one_asked_for_or_the_one_of_the_name() {
        for (words, expected) in [
            (&[][..], Format::Obj),
            (&["-o", "a.stl"], Format::Stl),
            (&["-o", "b.a/a.PLY"], Format::Ply),
            (&["-o", "a.obj"], Format::Obj),
            (&["-o", "stl"], Format::Obj),
            (&["-o", "a.stl", "--format", "ply"], Format::Ply),
            (&["--format", "stl"], Format::Stl),
            (&["-o", "a.glb"], Format::Glb),
            (&["-o", "a.3mf", "--unit", "inch"], Format::ThreeMf),
        ] {
            assert_eq!(parsed(words).format(), expected, "{words:?}");
        }
    }

    #[test]
    fn bytes_are_not_sent_to_a_terminal() {
        for format in ["stl", "ply", "glb", "3mf"] {
            let arguments = parsed(&["--format", format]);
            let message = arguments.check(true).unwrap_err().to_string();
            assert!(message.contains("is not for a terminal"), "{message}");
            assert!(arguments.check(false).is_ok());
            assert!(parsed(&["--format", format, "-o", "a"]).check(true).is_ok());
        }
        assert!(parsed(&[]).check(true).is_ok());
        let message = parsed(&["--unit", "foot"]).check(false).unwrap_err().to_string();
        assert_eq!(message, "--unit is for 3MF and GLB, and the format is OBJ");
    }

    #[test]
    fn a_material_file_lies_beside_the_mesh_under_one_word() {
        for (output, expected) in [
            ("a.obj", "a.mtl"),
            ("some/my vase.v2.obj", "some/my_vase.v2.mtl"),
            ("#a", "_a.mtl"),
            ("../a.stl.obj", "../a.stl.mtl"),
        ] {
            let arguments = parsed(&["--mtl", "-o", output]);
            assert!(arguments.check(false).is_ok());
            assert_eq!(arguments.mtl(), Some(expected.into()));
            assert_eq!(parsed(&["-o", output]).mtl(), None);
        }
    }
}
