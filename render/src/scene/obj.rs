//! Reads OBJ files through tobj, and refuses what tobj would take silently.
//!
//! tobj passes over numbers that are not finite, gives a face without texture coordinates those of
//! its neighbour, and loses names given by `usemtl` that no material file declares. So the text is
//! looked through once before: for the names, for what each face has, and, when it is one of
//! `triangulate`'s, for the closing comment `# end V F`, without which the program that wrote it
//! has died.

use crate::shape::Mesh;
use crate::shape::mesh::{MeshError, NONE, Triangle};
use files::{Exit, Failure};
use std::collections::HashMap;
use std::io::{BufReader, Read};
use thiserror::Error;

/// How the first line of `triangulate`'s OBJ begins.
const OURS: &str = "# topobook triangulate";

/// Why a file is not a mesh.
#[derive(Debug, Error)]
pub enum ObjError {
    /// Nothing there.
    #[error("{file}: found nothing, expected an OBJ mesh; did the program before the pipe fail?")]
    Empty {
        /// The file.
        file: String,
    },
    /// A file of another kind.
    #[error(
        "{file}: found JSON or a grid, expected an OBJ mesh; `triangulate` makes one of a grid"
    )]
    Json {
        /// The file.
        file: String,
    },
    /// Not text.
    #[error("{file}:{line}: found bytes that are not UTF-8, expected the text of an OBJ mesh")]
    NotText {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
    },
    /// One of ours that stops early.
    #[error(
        "{file}: found {found}, expected the closing comment `# end V F`; the program that wrote it stopped early"
    )]
    NotFinished {
        /// The file.
        file: String,
        /// Its last line, or what is wrong with it.
        found: String,
    },
    /// A line that cannot be read.
    #[error("{file}:{line}: found `{found}`, expected {expected}")]
    Line {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// The line, shortened.
        found: String,
        /// What would be right.
        expected: &'static str,
    },
    /// tobj refused it and no line was found that is to blame.
    #[error("{file}: {source}")]
    Refused {
        /// The file.
        file: String,
        /// What tobj said.
        source: tobj::LoadError,
    },
    /// Read, but no mesh.
    #[error("{file}: {source}")]
    Mesh {
        /// The file.
        file: String,
        /// What is wrong.
        source: MeshError,
    },
}

impl Failure for ObjError {
    fn exit(&self) -> Exit {
        Exit::Malformed
    }
}

/// Reads the bytes of an OBJ file as one mesh; `file` is its name in messages. Objects, groups and
/// runs of `usemtl` are joined in the order of the file. Quads are split; larger faces are refused.
///
/// # Errors
/// With the line that is to blame wherever it can be told.
pub fn read(file: &str, bytes: &[u8]) -> Result<Mesh, ObjError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // No line of an OBJ begins so; our grids, and JSON of any kind, do.
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
    check_finished(file, text)?;
    let (names, kinds) = look_through(file, text)?;

    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    // A first line makes tobj ask for materials; it gets the names that the text uses.
    let declared = BufReader::new(b"mtllib names\n".chain(text.as_bytes()));
    let (models, _) = tobj::load_obj_buf(&mut { declared }, &options, |_| Ok(materials(&names)))
        .map_err(|source| ObjError::Refused { file: file.into(), source })?;
    let mesh = joined(&models, names, &kinds);
    mesh.check().map_err(|source| ObjError::Mesh { file: file.into(), source })?;
    Ok(mesh)
}

/// The texture id and the surface id in a name like `tex2_surf0`, if it is one.
#[must_use]
pub fn ids(name: &str) -> Option<[&str; 2]> {
    let (texture, surface) = name.strip_prefix("tex")?.split_once("_surf")?;
    let number = |id: &str| !id.is_empty() && id.bytes().all(|byte| byte.is_ascii_digit());
    (number(texture) && number(surface)).then_some([texture, surface])
}

/// One of ours ends with `# end V F`, and has as many vertices and faces as that says.
fn check_finished(file: &str, text: &str) -> Result<(), ObjError> {
    if !text.starts_with(OURS) {
        return Ok(());
    }
    let last = text.lines().next_back().unwrap_or_default();
    let count = |keyword: &str| text.lines().filter(|line| line.starts_with(keyword)).count();
    let not_finished = |found| Err(ObjError::NotFinished { file: file.into(), found });
    if !last.starts_with("# end ") || !text.ends_with('\n') {
        return not_finished(format!("`{}` as the last line", shortened(last)));
    }
    let (vertices, faces) = (count("v "), count("f "));
    if last != format!("# end {vertices} {faces}") {
        return not_finished(format!("`{last}` after {vertices} vertices and {faces} faces"));
    }
    Ok(())
}

/// Which of texture coordinates and normals the corners of a face have.
type FaceKind = (bool, bool);

/// Runs of triangles whose faces are of one kind.
type Runs = Vec<(FaceKind, usize)>;

/// Checks each line that carries geometry and collects the names that `usemtl` gives, in order of
/// first use; the first name is empty, for faces before any `usemtl`. Also tells what kinds of
/// faces there are, since tobj makes up what they do not have as soon as others have it.
fn look_through(file: &str, text: &str) -> Result<(Vec<String>, Runs), ObjError> {
    let mut names = vec![String::new()];
    let mut runs = Runs::new();
    // Faces between two of these lines become one model of tobj and must be of one kind.
    let mut kind: Option<FaceKind> = None;
    // Vertices, texture coordinates and normals: in the whole text, and up to this line.
    let all = ["v", "vt", "vn"].map(|keyword| {
        text.lines().filter(|line| line.split_whitespace().next() == Some(keyword)).count()
    });
    let mut before = [0; 3];
    for (number, line) in text.lines().enumerate() {
        let line = line.trim();
        let wrong = |expected| {
            Err(ObjError::Line {
                file: file.into(),
                line: number + 1,
                found: shortened(line),
                expected,
            })
        };
        if line.ends_with('\\') {
            return wrong("one line per statement, without a backslash at its end");
        }
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match keyword {
            "v" if !numbers(rest, 3..=7) => return wrong("`v` and three finite numbers"),
            "vn" if !numbers(rest, 3..=3) => return wrong("`vn` and three finite numbers"),
            "vt" if !numbers(rest, 2..=3) => return wrong("`vt` and two finite numbers"),
            "v" => before[0] += 1,
            "vt" => before[1] += 1,
            "vn" => before[2] += 1,
            "usemtl" => {
                kind = None;
                if !names.iter().any(|name| name == rest.trim()) {
                    names.push(rest.trim().into());
                }
            }
            "o" | "g" => kind = None,
            "f" => {
                let Some((found, triangles)) = face_kind(rest) else {
                    return wrong("`f` and three or four corners, each v, v/vt, v//vn or v/vt/vn");
                };
                if *kind.get_or_insert(found) != found {
                    return wrong("corners like those of the faces before, with the same parts");
                }
                if !corners_are_there(rest, all, before) {
                    return wrong("corners that the file has, counted from 1, or back from -1");
                }
                match runs.last_mut() {
                    Some((kind, count)) if *kind == found => *count += triangles,
                    _ => runs.push((found, triangles)),
                }
            }
            _ => {}
        }
    }
    Ok((names, runs))
}

fn numbers(text: &str, count: std::ops::RangeInclusive<usize>) -> bool {
    let mut found = 0;
    for word in text.split_whitespace() {
        if !word.parse::<f32>().is_ok_and(f32::is_finite) {
            return false;
        }
        found += 1;
    }
    count.contains(&found)
}

/// What the corners of a face have, and how many triangles it is.
fn face_kind(text: &str) -> Option<(FaceKind, usize)> {
    let mut corners = 0;
    let mut kind = None;
    for corner in text.split_whitespace() {
        let parts: Vec<&str> = corner.split('/').collect();
        let index = |part: &str| part.parse::<i64>().is_ok_and(|index| index != 0);
        let this = match parts[..] {
            [v] if index(v) => (false, false),
            [v, vt] if index(v) && index(vt) => (true, false),
            [v, "", vn] if index(v) && index(vn) => (false, true),
            [v, vt, vn] if index(v) && index(vt) && index(vn) => (true, true),
            _ => return None,
        };
        if *kind.get_or_insert(this) != this {
            return None;
        }
        corners += 1;
    }
    kind.filter(|_| (3..=4).contains(&corners)).map(|kind| (kind, corners - 2))
}

/// Whether each index of a face leads to one of `all`, or counts back among those `before` it.
fn corners_are_there(text: &str, all: [usize; 3], before: [usize; 3]) -> bool {
    let is_there = |part: &str, k: usize| match part.parse::<i64>() {
        Ok(index) if index < 0 => index.unsigned_abs() <= before[k] as u64,
        Ok(index) => index as u64 <= all[k] as u64,
        Err(_) => true,
    };
    let mut corners = text.split_whitespace();
    corners.all(|corner| corner.split('/').enumerate().all(|(k, part)| is_there(part, k)))
}

/// Materials that are only names, so that tobj keeps them.
fn materials(names: &[String]) -> (Vec<tobj::Material>, HashMap<String, usize>) {
    let named = |name: &String| tobj::Material { name: name.clone(), ..tobj::Material::default() };
    let indices = names.iter().enumerate().map(|(index, name)| (name.clone(), index));
    (names.iter().map(named).collect(), indices.collect())
}

/// tobj's models as one mesh, in the order of the file, with only the surfaces that have faces.
fn joined(models: &[tobj::Model], names: Vec<String>, runs: &Runs) -> Mesh {
    let mut mesh = Mesh::default();
    let mut kinds = runs.iter().flat_map(|&(kind, count)| std::iter::repeat_n(kind, count));
    let mut surface_of = vec![NONE; names.len()];
    for tobj::Model { mesh: model, .. } in models {
        // Each `mtllib` line of the file gives tobj the same names once more.
        let name = model.material_id.unwrap_or(0) % names.len();
        if !model.indices.is_empty() && surface_of[name] == NONE {
            surface_of[name] = mesh.surfaces.len() as u32;
            mesh.surfaces.push(names[name].clone());
        }
        let first = [mesh.positions.len(), mesh.uvs.len(), mesh.normals.len()].map(|n| n as u32);
        mesh.positions.extend(model.positions.as_chunks::<3>().0);
        mesh.uvs.extend(model.texcoords.as_chunks::<2>().0);
        mesh.normals.extend(model.normals.as_chunks::<3>().0);
        let corners = |has: bool, indices: &[u32], triangle: usize, first: u32| match indices
            .get(3 * triangle..3 * triangle + 3)
        {
            Some(corners) if has => [corners[0] + first, corners[1] + first, corners[2] + first],
            _ => [NONE; 3],
        };
        mesh.triangles.extend((0..model.indices.len() / 3).map(|triangle| {
            let (has_uv, has_normal) = kinds.next().unwrap_or((false, false));
            Triangle {
                position: corners(true, &model.indices, triangle, first[0]),
                uv: corners(has_uv, &model.texcoord_indices, triangle, first[1]),
                normal: corners(has_normal, &model.normal_indices, triangle, first[2]),
                surface: surface_of[name],
            }
        }));
    }
    mesh
}

fn shortened(line: &str) -> String {
    let mut text: String = line.chars().take(60).collect();
    if text.len() < line.len() {
        text.push_str("...");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let mixed = complaint(&format!("{SQUARE}f 1/1 2/2 3/3\nf 1 3 4\n"));
        assert!(mixed.starts_with("a.obj:10:"), "{mixed}");
    }

    #[test]
    fn files_that_are_no_mesh_are_refused() {
        assert!(complaint("").contains("found nothing"));
        assert!(complaint("# only a comment\n").contains("no triangles"));
        assert!(complaint(SQUARE).contains("no triangles"));
        assert!(complaint("{\"format\":\"tb-grid\"}").contains("`triangulate` makes one"));
        let error = read("a.obj", b"v 0 0 0\n\xff").unwrap_err().to_string();
        assert!(error.starts_with("a.obj:2: found bytes"), "{error}");
        let mesh = read("a.obj", format!("\u{feff}{SQUARE}f 1 2 3\n").as_bytes()).unwrap();
        assert_eq!(mesh.triangles.len(), 1);
    }
}
