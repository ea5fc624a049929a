//! The option `--emit-schema`: prints the JSON Schema of a file format.

use clap::ValueEnum;
use files::{Output, Report};
use std::io::Write;
use std::path::Path;

/// A file format with a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Specs of curves, tb-sweep
    Spec,
    /// Scenes, tb-scene
    Scene,
    /// Jobs, tb-job
    Job,
    /// Header lines of grids, tb-grid
    Grid,
}

/// Prints a schema on standard output.
pub(super) fn emit(format: Format) -> Result<(), Report> {
    let schema = match format {
        Format::Spec => sweep::schema::of_spec(),
        Format::Scene => render::scene::schema::of_scene(),
        Format::Job => crate::job::schema(),
        Format::Grid => sweep::grid::file::schema(),
    };
    let mut output = Output::create(Path::new("-"), true)?;
    writeln!(output, "{schema:#}").map_err(|source| output.failed(source))?;
    Ok(output.commit()?)
}
