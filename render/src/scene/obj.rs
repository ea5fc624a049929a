//! Reads OBJ files: vertices, texture coordinates, normals, faces of three or four corners, and the
//! names that `usemtl` gives. Objects, groups, lines, points and material files are ignored.
//!
//! The reader passes through a file once. It refuses numbers that are not finite, indices without a
//! vertex, and faces whose corners differ in kind; the error names the line. A file of `triangulate`
//! must end with the comment `# end V F`. If the comment is missing, the file is incomplete.

mod reader;

use crate::shape::Mesh;
use crate::shape::mesh::{MeshError, Triangle};
use files::{Exit, Failure};
use reader::Reader;
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
    #[error("{file}:{line}: found bytes that are not UTF-8, expected the text of an OBJ mesh")]
    NotText {
        /// Name of the file.
        file: String,
        /// Number of the line, from 1.
        line: usize,
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

/// Reads the bytes of an OBJ file as one mesh. `file` is the name of the file in messages. Objects,
/// groups and runs of `usemtl` are joined in the order of the file. A face of four corners becomes two
/// triangles; larger faces are refused.
///
/// # Errors
/// If the file is empty, incomplete, not an OBJ, or not a mesh. The error names the line if one line is
/// at fault.
pub fn read(file: &str, bytes: &[u8]) -> Result<Mesh, ObjError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // No line of an OBJ begins with these characters, but our grids and all JSON files do.
    if bytes.starts_with(b"{") {
        return Err(ObjError::Json { file: file.into() });
    }
    let text = std::str::from_utf8(bytes).map_err(|error| ObjError::NotText {
        file: file.into(),
        line: 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count(),
    })?;
    if text.trim().is_empty() {
        return Err(ObjError::Empty { file: file.into() });
    }
    let mut reader = Reader::new(file, text);
    let end = closing_comment(file, text)?;
    reader.read()?;
    let (vertices, faces) = (reader.vertices(), reader.faces);
    if let Some(end) = end.filter(|end| *end != format!("# end {vertices} {faces}")) {
        let found = format!("`{end}` after {vertices} vertices and {faces} faces");
        return Err(ObjError::NotFinished { file: file.into(), found });
    }
    let mesh = reader.mesh();
    mesh.check().map_err(|source| ObjError::Mesh { file: file.into(), source })?;
    Ok(mesh)
}

/// Returns an upper bound of the bytes that the mesh of this text takes while it is read. Vertices and
/// triangles are counted by the lines that begin them, and twice, since lists grow by doubling.
#[must_use]
pub fn needed(bytes: &[u8]) -> u64 {
    const VERTEX: u64 = size_of::<[f32; 3]>() as u64 + 1;
    // A quadrangle is two triangles.
    const FACE: u64 = 2 * size_of::<Triangle>() as u64;
    const NAME: u64 = size_of::<String>() as u64 + 32;
    let lines = bytes.split(|&byte| byte == b'\n').map(|line| match line.trim_ascii_start() {
        [b'f', ..] => FACE,
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
pub(super) fn shortened(line: &str) -> String {
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
            ("v 0 nan 0", "three finite numbers"),
            ("v 0 1e400 0", "three finite numbers"),
            ("v 0 1", "three finite numbers"),
            ("vt 0.5", "two finite numbers"),
            ("f 1 2", "three or four corners"),
            ("f 1 2 3 4 1", "three or four corners"),
            ("f 1 2/2 3", "three or four corners"),
            ("f 0 1 2", "three or four corners"),
            ("f 1 2 \\", "backslash"),
            ("f 1 2 5", "corners that the file has"),
            ("f -5 1 2", "corners that the file has"),
            ("f 1/1 2/2 3/5", "corners that the file has"),
            ("f 1//1 2//1 3//1", "corners that the file has"),
        ] {
            let complaint = complaint(&format!("{SQUARE}{line}\n"));
            assert!(complaint.starts_with("a.obj:9: found `"), "{complaint}");
            assert!(complaint.contains(expected), "{complaint}");
        }
    }

    #[test]
    fn faces_of_all_kinds_may_follow_each_other_and_name_what_comes_later() {
        let text = format!("f 1/1 2/2 3/3\n{SQUARE}f 1 3 4\nf -4//-1 -3//-1 -2//1\nvn 0 0 1\n");
        let bad = complaint(&text);
        assert!(bad.starts_with("a.obj:11: found `f -4//-1") && bad.contains("back from"), "{bad}");
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
        let error = read("a.obj", b"v 0 0 0\n\xff").unwrap_err().to_string();
        assert!(error.starts_with("a.obj:2: found bytes"), "{error}");
        let mesh = read("a.obj", format!("\u{feff}{SQUARE}f 1 2 3\n").as_bytes()).unwrap();
        assert_eq!(mesh.triangles.len(), 1);
    }
}
