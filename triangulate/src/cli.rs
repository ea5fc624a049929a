//! The command line: what may be asked for, and what fits together.

use clap::{Parser, ValueEnum};
use files::extension::{self, WrongExtension};
use files::{Exit, Failure};
use std::path::{Path, PathBuf};
use thiserror::Error;
use triangulate::Options;
use triangulate::mtl::is_map_name;
use triangulate::obj::object_name;

const EXAMPLES: &str = "\
Examples:
  sweep vase.json -o vase.grid            a grid from a curve spec, then
  triangulate vase.grid -o vase.obj       its triangles
  sweep vase.json | triangulate --texture 2 | render scene.json --mesh vase=- -o vase.png
  triangulate vase.grid -o vase.stl       for a printer
  triangulate vase.grid -o vase.obj --report -                    is it closed?
  triangulate vase.grid -o vase.obj --mtl --map marble.png        for other renderers

An output file is replaced only when the whole grid was read and found undamaged. An OBJ on
standard output is whole when its last line is `# end V F` (numbers of v and f lines).
Mesh, material file and report are replaced together. None of them is ever a file that is read, and
none has a name that ends as another format does (a.glb), unless --format asks for it; endings of no
known format are free.";

/// Makes triangles of a grid that `sweep` wrote, as OBJ, STL or PLY.
#[derive(Debug, Parser)]
#[command(name = "triangulate", version, after_help = EXAMPLES)]
pub struct Arguments {
    /// The grid file; - is standard input
    #[arg(default_value = "-")]
    pub grid: PathBuf,
    /// The mesh file; - is standard output
    #[arg(short, long, value_name = "MESH", default_value = "-")]
    pub output: PathBuf,
    /// How the mesh is written; by default as the output's name ends (.stl, .ply), and else as OBJ
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Texture id, which a scene binds to a picture; 0 is none. In place of those in the grid
    #[arg(long, value_name = "ID")]
    texture: Option<u32>,
    /// Surface id, which a scene binds to a material. In place of those in the grid
    #[arg(long, value_name = "ID")]
    surface: Option<u32>,
    /// Texture areas (tb-areas JSON) to lay on the grid's own. Keeps the grid in memory
    #[arg(long, value_name = "FILE.json")]
    pub areas: Option<PathBuf>,
    /// Write a material file beside the OBJ, under its name with .mtl
    #[arg(long)]
    mtl: bool,
    /// The picture of the material, written as it stands here: readers look for it beside the MTL
    #[arg(long, value_name = "FILE", requires = "mtl", value_parser = map_name)]
    pub map: Option<String>,
    /// Write what the mesh is like (Euler number, rims, sides, measures) as JSON; - is standard output.
    /// Keeps the mesh in memory
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// Memory to take at most, in bytes or with k, M or G; what needs more is refused before it is
    /// begun [default: 90 % of what is free]
    #[arg(long, value_name = "BYTES", value_parser = files::memory::bytes)]
    pub max_memory: Option<u64>,
    /// Say nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
    /// Print how many vertices and triangles were made, to standard error
    #[arg(long)]
    pub stats: bool,
    /// Do not replace an existing output file
    #[arg(long)]
    pub no_clobber: bool,
}

/// How a mesh is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Text, written row by row; what render reads
    Obj,
    /// Binary STL: triangles only, for printers; needs the mesh in memory
    Stl,
    /// Binary PLY with normals and picture coordinates; needs the mesh in memory
    Ply,
}

/// Arguments that do not fit together, or not the place where the program runs.
#[derive(Debug, Error)]
pub enum UseError {
    /// Bytes that a terminal would take for commands.
    #[error("a binary {0} is not for a terminal: name a file with -o, or use --format obj")]
    Terminal(&'static str),
    /// Two things from standard input.
    #[error("--areas - would read from the grid's standard input: name a file for one of them")]
    AreasPlace,
    /// A material file for a mesh that names none.
    #[error("--mtl is for OBJ, and the format is {0}")]
    MtlFormat(&'static str),
    /// A material file beside nothing.
    #[error("--mtl found {0} as the output, expected a file to lie beside: name one with -o")]
    MtlPlace(String),
    /// Two things on standard output.
    #[error("--report - would write into the mesh on standard output: name a file for one of them")]
    ReportPlace,
}

impl Failure for UseError {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

impl Arguments {
    /// What the triangles are bound to, where it is said here.
    pub fn options(&self) -> Options {
        Options { texture: self.texture, surface: self.surface }
    }

    /// The format asked for, or the one that the output's name ends with.
    pub fn format(&self) -> Format {
        let by_name = || {
            let extension = self.output.extension()?.to_str()?;
            Format::value_variants()
                .iter()
                .find(|format| extension.eq_ignore_ascii_case(format.name()))
                .copied()
        };
        self.format.or_else(by_name).unwrap_or(Format::Obj)
    }

    /// Complains of what cannot be meant; `terminal` says that standard output is one.
    pub fn check(&self, terminal: bool) -> Result<(), UseError> {
        let format = self.format();
        if terminal && format != Format::Obj && is_stdout(&self.output) {
            return Err(UseError::Terminal(format.name()));
        }
        if self.areas.as_deref().is_some_and(is_stdout) && is_stdout(&self.grid) {
            return Err(UseError::AreasPlace);
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

    /// Complains of a name that ends as that of another format; a mesh's format that was asked for wins
    /// over its name.
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

    /// The material file, if one is wanted.
    pub fn mtl(&self) -> Option<PathBuf> {
        self.mtl_name().map(|name| self.output.with_file_name(name))
    }

    /// Its name, which the OBJ has too: one word, as an OBJ cannot quote it.
    pub fn mtl_name(&self) -> Option<String> {
        let path = self.output.with_extension("mtl");
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        self.mtl.then(|| object_name(&name))
    }
}

/// A picture that an MTL can name.
fn map_name(argument: &str) -> Result<String, String> {
    if is_map_name(argument) {
        Ok(argument.into())
    } else {
        Err("expected a name without `#`, line breaks, a dash before it or blanks around it, which \
             an MTL cannot hold"
            .into())
    }
}

impl Format {
    /// Its name, in capitals.
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Ply => "PLY",
        }
    }

    /// What its files hold, in words.
    fn content(self) -> &'static str {
        match self {
            Self::Obj => "an OBJ mesh",
            Self::Stl => "an STL mesh",
            Self::Ply => "a PLY mesh",
        }
    }

    /// The extension of its files.
    fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Ply => "ply",
        }
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
        ] {
            assert_eq!(parsed(words).format(), expected, "{words:?}");
        }
    }

    #[test]
    fn bytes_are_not_sent_to_a_terminal() {
        for format in ["stl", "ply"] {
            let arguments = parsed(&["--format", format]);
            let message = arguments.check(true).unwrap_err().to_string();
            assert!(message.contains("is not for a terminal"), "{message}");
            assert!(arguments.check(false).is_ok());
            assert!(parsed(&["--format", format, "-o", "a"]).check(true).is_ok());
        }
        assert!(parsed(&[]).check(true).is_ok());
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
