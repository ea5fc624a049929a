//! Reads mesh files: OBJ, STL, PLY and glTF, told apart by their contents.
//!
//! | format | recognized by |
//! |---|---|
//! | GLB | the first bytes `glTF` |
//! | glTF | JSON with the key `asset` |
//! | PLY | the first line `ply` |
//! | STL | a length that fits the count of facets; or `solid` and `facet` |
//! | OBJ | all others |
//!
//! A file whose name ends in `.stl` or `.gltf`, and whose contents are of no other format, is taken by its
//! name. A file whose name belongs to another format than its contents is read, with a remark.

mod error;
mod gltf;
mod ply;
mod stl;
mod tidy;

pub use error::MeshFileError;

use super::obj::{self, ObjError, ObjFile};
use files::{MemoryError, Source};
use glam::DVec3;
use std::fmt::{self, Debug};
use std::path::Path;

/// The surroundings of a mesh file while it is read.
pub struct Near<'a> {
    /// Folder of the file, to which its paths are relative.
    pub folder: &'a Path,
    /// Source of the files that it names.
    pub source: &'a dyn Source,
    /// Takes memory, in bytes, before the triangles are read.
    pub reserve: &'a mut dyn FnMut(u64) -> Result<(), MemoryError>,
}

impl Debug for Near<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Near").field("folder", &self.folder).finish_non_exhaustive()
    }
}

/// A format of mesh files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Obj,
    Stl,
    Ply,
    Gltf,
}

impl Format {
    /// Returns the format of a file's contents, if they begin as those of one format alone.
    fn of_contents(bytes: &[u8]) -> Option<Self> {
        if gltf::is_binary(bytes) || gltf::is_text(bytes) {
            Some(Self::Gltf)
        } else if ply::is_ply(bytes) {
            Some(Self::Ply)
        } else if stl::is_binary(bytes) || stl::is_text(bytes) {
            Some(Self::Stl)
        } else {
            None
        }
    }

    /// Returns the format of a file's name.
    fn of_name(file: &str) -> Option<Self> {
        let extension = Path::new(file).extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            "glb" | "gltf" => Some(Self::Gltf),
            _ => None,
        }
    }

    /// Returns the name of the format after its article.
    fn name(self) -> &'static str {
        match self {
            Self::Obj => "an OBJ",
            Self::Stl => "an STL",
            Self::Ply => "a PLY",
            Self::Gltf => "a glTF",
        }
    }
}

/// The contents of a file, and the positions of its mesh. The mesh itself has none yet.
type Placed = (ObjFile, Vec<DVec3>);

/// First bytes of formats that are not read, and their names.
const OTHERS: [(&[u8], &str); 7] = [
    (b"PK\x03\x04", "a ZIP archive, such as a 3MF"),
    (b"Kaydara FBX", "an FBX file"),
    (b"BLENDER", "a Blender file"),
    (b"\x1f\x8b", "a file packed by gzip"),
    (b"OFF", "an OFF mesh"),
    (b"<", "an XML file"),
    (b"#VRML", "a VRML scene"),
];

/// Returns whether a file is a mesh rather than a scene: by its contents, or else by its name. JSON is a scene unless it
/// is a glTF.
#[must_use]
pub fn is_mesh(file: &str, bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let is_named = || !start.starts_with(b"{") && Format::of_name(file).is_some();
    Format::of_contents(bytes).is_some() || is_obj(bytes) || is_named()
}

/// Reads the bytes of a mesh file. `file` is the name of the file in messages.
///
/// # Errors
/// If the file is of no format that is read, incomplete, or not a mesh. The error names the line or the
/// byte at fault. Also if a file that it names cannot be read, or there is no memory.
pub fn read(file: &str, bytes: &[u8], mut near: Near<'_>) -> Result<ObjFile, MeshFileError> {
    let by_name = Format::of_name(file);
    let by_contents = Format::of_contents(bytes);
    let format = match (by_contents, by_name) {
        (Some(format), _) => format,
        (None, Some(Format::Stl)) if !is_obj(bytes) => Format::Stl,
        (None, Some(Format::Gltf)) if bytes.starts_with(b"{") => Format::Gltf,
        (None, _) => Format::Obj,
    };
    if format == Format::Obj
        && let Some((_, found)) = OTHERS.iter().find(|(start, _)| bytes.starts_with(start))
    {
        let expected = "an OBJ, STL, PLY or glTF mesh".into();
        return Err(MeshFileError::Part { file: file.into(), found: (*found).into(), expected });
    }
    let placed = match format {
        Format::Obj => {
            (near.reserve)(obj::needed(bytes))?;
            (read_obj(file, bytes, by_name)?, Vec::new())
        }
        Format::Stl => stl::read(file, bytes, near.reserve)?,
        Format::Ply => ply::read(file, bytes, near.reserve)?,
        Format::Gltf => gltf::read(file, bytes, &mut near)?,
    };
    let (mut read, positions) = placed;
    if format != Format::Obj {
        tidy::tidy(file, &mut read, &positions)?;
    }
    if let Some(name) = by_name.filter(|&name| name != format) {
        let (contents, name) = (format.name(), name.name());
        read.remarks.push(format!("the contents are those of {contents}, the name that of {name}"));
    }
    read.folder = near.folder.into();
    Ok(read)
}

/// Reads an OBJ. A file that is named as another format is told to lack the beginning of that format.
fn read_obj(file: &str, bytes: &[u8], by_name: Option<Format>) -> Result<ObjFile, MeshFileError> {
    let wrong = |expected: &str| {
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(16)]).into_owned();
        let found = format!("`{}` as the first characters", obj::shortened(&start));
        Err(MeshFileError::Part { file: file.into(), found, expected: expected.into() })
    };
    match by_name {
        Some(Format::Ply) if !is_obj(bytes) && !bytes.is_empty() => {
            wrong("`ply`, with which a PLY begins")
        }
        Some(Format::Gltf) if !is_obj(bytes) && !bytes.is_empty() => {
            wrong("`glTF` of a GLB, or the JSON of a glTF")
        }
        _ => match obj::read_file(file, bytes) {
            Err(ObjError::NotText { line: _, .. }) if bytes.len() > 84 && by_name.is_none() => {
                wrong("an OBJ, STL, PLY or glTF mesh")
            }
            other => Ok(other?),
        },
    }
}

/// Returns whether a text begins as an OBJ does: with a comment or a statement.
fn is_obj(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(4096)];
    let mut lines = start.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"));
    let words = ["v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"];
    let keyword = |line: &[u8]| line.split(u8::is_ascii_whitespace).next().map(<[u8]>::to_vec);
    match first.and_then(keyword) {
        Some(word) => words.iter().any(|known| known.as_bytes() == word),
        None => start.starts_with(b"#"),
    }
}
