//! Reads OBJ files: vertices, texture coordinates, normals, faces, the names that `usemtl` gives,
//! smoothing groups and the names of material libraries.
//!
//! | in the file | becomes |
//! |---|---|
//! | a face of four or more corners | triangles inside of it (`polygon.rs`) |
//! | corners of a face that lack a part which others have | a face without this part |
//! | a normal that is not finite | no normal, as one of length 0 |
//! | texture coordinates that are not finite | none |
//! | a vertex that is not finite | a fault if a face uses it |
//! | three numbers behind a vertex | its colour (`colors.rs`) |
//! | vertices far from the origin | vertices from an offset (`far.rs`) |
//! | `s` other than 0 and `off`, faces without normals | mean normals ([`crate::shape::smooth`]) |
//! | points, lines, curves and unknown keywords | counted in [`ObjFile::unused`] |
//!
//! A file of `triangulate` must end with the comment `# end V F`. If the comment is missing, the file is
//! incomplete.

mod colors;
mod far;
mod polygon;
mod reader;

use super::mtl::Entry;
use super::text;
use crate::shape::Mesh;
use crate::shape::mesh::{MeshError, Triangle};
use crate::shape::smooth::smooth;
use files::{Exit, Failure};
pub use polygon::divide;
use reader::Reader;
use std::collections::BTreeMap;
use std::path::PathBuf;
use thiserror::Error;

/// Beginning of the first line of an OBJ that `triangulate` wrote.
const OURS: &str = "# topobook triangulate";

/// The reason why a file cannot be read as a mesh.
#[derive(Debug, Error)]
pub enum ObjError {
    /// The file is empty.
    #[error("{file}: found nothing, expected an OBJ mesh; did the program before the pipe fail?")]
    Empty {
        /// Name of the file.
        file: String,
    },
    /// The file has another format.
    #[error(
        "{file}: found JSON or a grid, expected an OBJ mesh; `triangulate` makes a mesh from a grid"
    )]
    Json {
        /// Name of the file.
        file: String,
    },
    /// The file is not text.
    #[error("{file}:{line}: found a byte 0, expected the text of {kind}")]
    NotText {
        /// Name of the file.
        file: String,
        /// Number of the line, from 1.
        line: usize,
        /// The expected kind of file, with its article.
        kind: &'static str,
    },
    /// The file was written by `triangulate` and is incomplete.
    #[error(
        "{file}: found {found}, expected the closing comment `# end V F`; the program that wrote it stopped early"
    )]
    NotFinished {
        /// Name of the file.
        file: String,
        /// The last line, or a description of its fault.
        found: String,
    },
    /// A line is not a valid statement.
    #[error("{file}:{line}: found `{found}`, expected {expected}")]
    Line {
        /// Name of the file.
        file: String,
        /// Number of the line, from 1.
        line: usize,
        /// The text of the line, shortened.
        found: String,
        /// The expected statement.
        expected: &'static str,
    },
    /// The file is valid, but its arrays are not a mesh.
    #[error("{file}: {source}")]
    Mesh {
        /// Name of the file.
        file: String,
        /// The fault of the arrays.
        source: MeshError,
    },
}

impl Failure for ObjError {
    fn exit(&self) -> Exit {
        Exit::Malformed
    }
}

/// The contents of an OBJ file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ObjFile {
    /// Name of the file in messages; empty for a mesh that was made and not read.
    pub file: String,
    /// Folder to which the paths of the libraries are relative.
    pub folder: PathBuf,
    /// The mesh as it stands in the file.
    pub mesh: Mesh,
    /// Number of the vertices that have a colour.
    pub colored: usize,
    /// The smoothing group of each triangle, 0 for none; empty if the file names no group.
    pub groups: Vec<u32>,
    /// The texts behind `mtllib`: the path of a file, or of several.
    pub libraries: Vec<String>,
    /// Keywords and values that are not used, each with its count.
    pub unused: Vec<(String, usize)>,
    /// Materials that the file itself holds, by the names of its surfaces; an OBJ file holds none.
    pub materials: Vec<Entry>,
    /// Pictures that the file itself holds, by the paths that its materials name.
    pub pictures: BTreeMap<String, Vec<u8>>,
    /// Sentences about the file.
    pub remarks: Vec<String>,
}

impl From<Mesh> for ObjFile {
    fn from(mesh: Mesh) -> Self {
        Self { mesh, ..Self::default() }
    }
}

impl ObjFile {
    /// Returns the mesh with normals for the triangles that lack them: those in a smoothing group, and
    /// with a `crease` all. `crease` is the largest angle between two faces, in degrees, that still
    /// shade as one.
    #[must_use]
    pub fn smoothed(self, crease: Option<f64>) -> Mesh {
        let Self { mut mesh, groups, .. } = self;
        if !groups.is_empty() || crease.is_some() {
            smooth(&mut mesh, &groups, crease.map(f64::to_radians));
        }
        mesh
    }
}

/// Reads the bytes of an OBJ file as one mesh, with normals for smoothing groups. `file` is the name of
/// the file in messages. Objects, groups and runs of `usemtl` are joined in the order of the file.
///
/// # Errors
/// As those of [`read_file`].
pub fn read(file: &str, bytes: &[u8]) -> Result<Mesh, ObjError> {
    Ok(read_file(file, bytes)?.smoothed(None))
}

/// Reads the bytes of an OBJ file. `file` is the name of the file in messages.
///
/// # Errors
/// If the file is empty, incomplete, not an OBJ, or not a mesh. The error names the line if one line is
/// at fault.
pub fn read_file(file: &str, bytes: &[u8]) -> Result<ObjFile, ObjError> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // No line of an OBJ begins with these characters, but our grids and all JSON files do.
    if start.starts_with(b"{") {
        return Err(ObjError::Json { file: file.into() });
    }
    let not_text =
        |text::NotText(line)| ObjError::NotText { file: file.into(), line, kind: "an OBJ mesh" };
    let text = text::of(bytes).map_err(not_text)?;
    if text.trim().is_empty() {
        return Err(ObjError::Empty { file: file.into() });
    }
    let mut reader = Reader::new(file, &text, text.starts_with(OURS));
    let end = closing_comment(file, &text)?;
    reader.read()?;
    let (vertices, faces) = (reader.vertices(), reader.faces);
    if let Some(end) = end.filter(|end| *end != format!("# end {vertices} {faces}")) {
        let found = format!("`{end}` after {vertices} vertices and {faces} faces");
        return Err(ObjError::NotFinished { file: file.into(), found });
    }
    let read = reader.finish();
    read.mesh.check().map_err(|source| ObjError::Mesh { file: file.into(), source })?;
    Ok(read)
}

/// Returns an upper bound of the bytes that the mesh of this text takes while it is read. Vertices and
/// triangles are counted by the lines that begin them, and twice, since lists grow by doubling.
#[must_use]
pub fn needed(bytes: &[u8]) -> u64 {
    // A position, in `f64` too where the mesh lies far from the origin, a color, and whether it is used.
    const VERTEX: u64 = 2 * size_of::<[f32; 3]>() as u64 + 1;
    const COLOR: u64 = size_of::<[f32; 3]>() as u64;
    const TRIANGLE: u64 = size_of::<Triangle>() as u64 + size_of::<u32>() as u64;
    const NAME: u64 = size_of::<String>() as u64 + 32;
    // A face has at most as many corners as blanks. Bytes are counted faster than words.
    let blanks = |bytes: &[u8]| bytes.iter().filter(|&&byte| byte <= b' ').count() as u64;
    let lines = bytes.split(|&byte| byte == b'\n').map(|line| match line.trim_ascii_start() {
        // A face has two triangles less than corners.
        [b'f', corners @ ..] => TRIANGLE * blanks(corners).max(1),
        [b'v', b' ', ..] if blanks(line) >= 6 => VERTEX + COLOR,
        [b'v', ..] => VERTEX,
        [b'u', ..] => NAME + line.len() as u64,
        _ => 0,
    });
    2 * lines.sum::<u64>()
}

/// Returns the texture id and the surface id of a name such as `tex2_surf0`; `None` for other names.
#[must_use]
pub fn ids(name: &str) -> Option<[&str; 2]> {
    let (texture, surface) = name.strip_prefix("tex")?.split_once("_surf")?;
    let number = |id: &str| !id.is_empty() && id.bytes().all(|byte| byte.is_ascii_digit());
    (number(texture) && number(surface)).then_some([texture, surface])
}

/// Returns the last line of a file that `triangulate` wrote, which begins with `# end`. Returns `None`
/// for a file of another program.
fn closing_comment<'a>(file: &str, text: &'a str) -> Result<Option<&'a str>, ObjError> {
    if !text.starts_with(OURS) {
        return Ok(None);
    }
    let last = text.lines().next_back().unwrap_or_default();
    if last.starts_with("# end ") && text.ends_with('\n') {
        return Ok(Some(last));
    }
    let found = format!("`{}` as the last line", shortened(last));
    Err(ObjError::NotFinished { file: file.into(), found })
}

/// Returns the line for a message: shortened if it is long, with invisible characters spelled out.
pub fn shortened(line: &str) -> String {
    let start: String = line.chars().take(60).collect();
    let end = if start.len() < line.len() { "..." } else { "" };
    format!("{}{end}", files::words::shown(&start))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::mesh::NONE;

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

    fn complaint(text: &str) -> String {
        read("a.obj", text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn a_quad_becomes_two_triangles_and_names_are_kept() {
        let text =
            format!("{SQUARE}usemtl tex2_surf0\nf 1/1 2/2 3/3 4/4\nusemtl wood\nf 1/1 2/2 4/4\n");
        let mesh = read("a.obj", text.as_bytes()).unwrap();
        assert_eq!(mesh.surfaces, ["tex2_surf0", "wood"]);
        assert_eq!(mesh.triangles.iter().map(|t| t.surface).collect::<Vec<_>>(), [0, 0, 1]);
        assert_eq!(mesh.corners(1), [[0., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
        assert_eq!(mesh.triangles[0].normal, [NONE; 3]);
    }

    #[test]
    fn material_files_are_passed_over() {
        let text = format!(
            "mtllib a.mtl b.mtl\n{SQUARE}usemtl wood\nf 1/1 2/2 3/3\nmtllib names\nusemtl tex1_surf0\nf 1/1 3/3 4/4\n"
        );
        let mesh = read("a.obj", text.as_bytes()).unwrap();
        assert_eq!(mesh.surfaces, ["wood", "tex1_surf0"]);
        assert_eq!(mesh.triangles.iter().map(|t| t.surface).collect::<Vec<_>>(), [0, 1]);
    }

    #[test]
    fn ids_are_told_from_other_names() {
        assert_eq!(ids("tex2_surf10"), Some(["2", "10"]));
        for other in ["wood", "tex_surf1", "tex2surf1", "tex2_surf1b", ""] {
            assert_eq!(ids(other), None);
        }
    }

    #[test]
    fn one_of_ours_must_be_finished() {
        let ours =
            |end: &str| format!("# topobook triangulate OBJ 1\n{SQUARE}f 1/1 2/2 3/3\n{end}");
        assert!(read("a.obj", ours("# end 4 1\n").as_bytes()).is_ok());
        for end in ["", "# end 4 2\n", "# end 4 1", "# en"] {
            assert!(complaint(&ours(end)).contains("stopped early"), "{end}");
        }
    }

    #[test]
    fn bad_lines_are_named() {
        for (line, expected) in [
            ("v 0 1", "three numbers"),
            ("v 0 1 x", "three numbers"),
            ("vt", "two numbers"),
            ("f 0 1 2", "three or more corners"),
            ("f 1 2 3/1/1/1", "three or more corners"),
            ("f 1 2 5", "corners that the file has"),
            ("f -5 1 2", "corners that the file has"),
        ] {
            let complaint = complaint(&format!("{SQUARE}{line}\n"));
            assert!(complaint.starts_with("a.obj:9: found `"), "{complaint}");
            assert!(complaint.contains(expected), "{complaint}");
        }
    }

    #[test]
    fn numbers_that_are_not_finite_matter_only_where_they_are_used() {
        let faces =
            |face: &str| format!("{SQUARE}v 0 nan 0\nvt 1 inf\nvn nan 0 0\nf 1 2 3\n{face}\n");
        let read = |face: &str| read("a.obj", faces(face).as_bytes());
        assert!(read("").is_ok());
        let bad = read("f 1 2 5").unwrap_err().to_string();
        assert!(bad.starts_with("a.obj:9: found `v 0 nan 0`") && bad.contains("finite"), "{bad}");
        let mesh = read("f 1/5/1 2/2/1 3/3/1").unwrap();
        assert_eq!((mesh.triangles[1].uv, mesh.normals[0]), ([NONE; 3], [0.0; 3]));
    }

    #[test]
    fn what_is_not_used_is_counted() {
        let more = "v 0 0 0 1 0 0\nv 1 0 0 1 0 1 0\nl 1 2\np 1\nl 2 3\ng a\no b\nvp 1\nf 1 2 3\n";
        let read = read_file("a.obj", format!("{SQUARE}{more}").as_bytes()).unwrap();
        let counts: Vec<(&str, usize)> =
            read.unused.iter().map(|(what, count)| (what.as_str(), *count)).collect();
        assert_eq!((counts, read.colored), (vec![("l", 2), ("p", 1), ("vp", 1)], 2));
    }

    #[test]
    fn corners_that_lack_a_part_take_it_from_their_face() {
        let text =
            format!("{SQUARE}vn 0 0 1\nf 1/1/1 2/2/1 3//1\nf 1/1/ 2/2 3/3//\nf 1/1 2/2 3/3/1\n");
        let error = complaint(&text);
        assert!(error.starts_with("a.obj:11:"), "a third slash: {error}");
        let mesh = read("a.obj", text.replace("3/3//", "3/3/").as_bytes()).unwrap();
        let has = |part: fn(&Triangle) -> [u32; 3]| {
            mesh.triangles.iter().map(|triangle| part(triangle) != [NONE; 3]).collect::<Vec<_>>()
        };
        assert_eq!(has(|triangle| triangle.uv), [false, true, true]);
        assert_eq!(has(|triangle| triangle.normal), [true, false, false]);
    }

    /// One square in six dialects of OBJ.
    #[test]
    fn the_same_square_in_many_dialects() {
        let plain = read("a.obj", format!("{SQUARE}f 1/1 2/2 3/3 4/4\n").as_bytes()).unwrap();
        let lines = format!("{SQUARE}f 1/1 2/2 3/3 4/4\n");
        let latin1: Vec<u8> = [b"# gr\xfcn\n", lines.as_bytes()].concat();
        for text in [
            lines.replace('\n', "\r").into_bytes(),
            lines.replace('\n', "\r\n").into_bytes(),
            lines.replace('\n', " # remark\n").into_bytes(),
            lines.replace(" 0 0\n", " \\\n 0 \\\r\n0\n").into_bytes(),
            [b"\xef\xbb\xbf", lines.as_bytes()].concat(),
            latin1,
        ] {
            let shown = String::from_utf8_lossy(&text).into_owned();
            assert_eq!(read("a.obj", &text).unwrap(), plain, "{shown}");
        }
    }

    #[test]
    fn faces_of_all_kinds_may_follow_each_other_and_name_what_comes_later() {
        let text = format!("f 1/1 2/2 3/3\n{SQUARE}f 1 3 4\nf -4//-1 -3//-1 -2//1\nvn 0 0 1\n");
        // There is no normal before the face.
        let early = read("a.obj", text.as_bytes()).unwrap();
        assert_eq!(early.triangles[2].normal, [NONE; 3]);
        let text = text.replace("-1", "1");
        let mesh = read("a.obj", text.as_bytes()).unwrap();
        assert_eq!(mesh.triangles.iter().map(|t| t.uv[0]).collect::<Vec<_>>(), [0, NONE, NONE]);
        assert_eq!(mesh.triangles.iter().map(|t| t.normal[2]).collect::<Vec<_>>(), [NONE, NONE, 0]);
        let lost = complaint(&text.replace("f 1 3 4", "f 1 3 5"));
        assert!(lost.starts_with("a.obj:10: found `f 1 3 5`"), "{lost}");
    }

    #[test]
    fn vertices_that_no_face_has_are_left_out() {
        let text = format!("v 9 9 9\n{SQUARE}v 1e30 0 0\nf 2 3 4\n");
        let mesh = read("a.obj", text.as_bytes()).unwrap();
        assert_eq!(mesh.positions, [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.]]);
        assert_eq!(mesh.triangles[0].position, [0, 1, 2]);
    }

    #[test]
    fn files_that_are_no_mesh_are_refused() {
        assert!(complaint("").contains("found nothing"));
        assert!(complaint("# only a comment\n").contains("no triangles"));
        assert!(complaint(SQUARE).contains("no triangles"));
        assert!(complaint("{\"format\":\"tb-grid\"}").contains("`triangulate` makes a mesh"));
        let error = read("a.obj", b"v 0 0 0\n\0").unwrap_err().to_string();
        assert!(error.starts_with("a.obj:2: found a byte 0"), "{error}");
        let mesh = read("a.obj", format!("\u{feff}{SQUARE}f 1 2 3\n").as_bytes()).unwrap();
        assert_eq!(mesh.triangles.len(), 1);
    }
}
