//! The files of meshes that the command line names, and their scene if they have none.

use files::memory::{Reserved, of_process};
use files::{JsonError, Ledger, Report, input};
use render::scene::mesh_file::{self, Near};
use render::scene::obj::ObjFile;
use std::path::Path;

/// The circumstances on which the scene of a mesh depends, besides its flags.
#[derive(Debug, Clone, Copy)]
pub struct Staging {
    /// Width of the picture over its height.
    pub aspect: f64,
    /// True if nothing but the mesh is shown.
    pub alone: bool,
}

/// Files of other kinds that are given as scenes, by their formats, and the commands for them.
const OTHERS: [(&str, &str); 4] = [
    ("tb-sweep", "`pipeline show SPEC.json -o FILE.png` makes a picture of a spec"),
    ("tb-grid", "`pipeline show FILE.grid -o FILE.png` makes a picture of a grid"),
    ("tb-job", "`pipeline run JOB.json` makes the pictures of a job"),
    ("tb-scene-part", "a scene that includes the part shows it"),
];

/// Reads a mesh file, and keeps the reserved memory in `kept`.
pub fn read_mesh(
    file: &Path,
    bytes: &[u8],
    ledger: &Ledger,
    kept: &mut Vec<Reserved<'static>>,
) -> Result<ObjFile, Report> {
    let name = input::name_of(file);
    let folder = match file.parent() {
        Some(folder) if !input::is_stdin(file) => folder,
        _ => Path::new(""),
    };
    let reserve = &mut |bytes| {
        kept.push(of_process().reserve(bytes, || format!("mesh {name}"))?);
        Ok(())
    };
    Ok(mesh_file::read(&name, bytes, Near { folder, source: ledger, reserve })?)
}

/// Adds to an error about a file that is no scene which command takes a file of its kind, if one does.
pub fn hinted(text: &[u8], mut error: JsonError) -> JsonError {
    let start = String::from_utf8_lossy(&text[..text.len().min(500)]);
    let is_named = |format: &str| start.contains(&format!("\"{format}\""));
    if let Some((_, hint)) = OTHERS.iter().find(|(format, _)| is_named(format)) {
        error.message.push_str("; ");
        error.message.push_str(hint);
    }
    error
}
