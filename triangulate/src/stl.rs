//! The mesh as a binary STL file, for printers.
//!
//! ```text
//! 80 bytes     topobook triangulate STL 1, the object's name, zeros
//! u32          the number of triangles
//! and for each triangle, 50 bytes:
//!   3 x f32    its normal, of unit length
//!   9 x f32    its corners, counter-clockwise seen from outside
//!   u16        0
//! ```
//!
//! All numbers are little-endian. A triangle has its own normal, perpendicular to its plane. An STL
//! cannot hold the mesh's normals, picture coordinates and ids. Lengths stay in the grid's unit, which
//! printers take for millimetres.

use crate::TriMesh;
use glam::DVec3;
use std::io::{self, BufWriter, Write};

/// The first words of the header. A header must not start with `solid`, since readers take such a file
/// for text.
pub const FIRST_WORDS: &str = "topobook triangulate STL 1";
/// The length of the header in bytes.
const HEADER: usize = 80;

/// Writes a mesh as binary STL to `out`, which need not be buffered.
///
/// # Errors
/// When the output fails, or the mesh has more than the 2^32 - 1 triangles that an STL can count, which
/// no grid makes.
///
/// # Panics
/// When an index of the mesh is out of range (see [`TriMesh::validate`]).
pub fn write_stl(mesh: &TriMesh, out: impl Write) -> io::Result<()> {
    let count = u32::try_from(mesh.triangles.len()).map_err(|_| {
        io::Error::other(format!(
            "found {} triangles, expected at most {}, which is what an STL counts",
            mesh.triangles.len(),
            u32::MAX
        ))
    })?;
    let mut out = BufWriter::new(out);
    out.write_all(&header(&mesh.name))?;
    out.write_all(&count.to_le_bytes())?;
    for triangle in &mesh.triangles {
        let corners = triangle.position.map(|index| mesh.positions[index as usize]);
        for point in [unit_normal(corners)].iter().chain(&corners) {
            for number in point {
                out.write_all(&number.to_le_bytes())?;
            }
        }
        out.write_all(&[0; 2])?;
    }
    out.flush()
}

/// Returns the first words and as much of the name as fits, padded with zeros. The name is cut between
/// characters.
fn header(name: &str) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    let words = format!("{FIRST_WORDS} {name}");
    let length = (0..=HEADER).rfind(|&end| words.is_char_boundary(end)).unwrap_or(0);
    let words = &words.as_bytes()[..length.min(words.len())];
    header[..words.len()].copy_from_slice(words);
    header
}

/// Returns the unit normal of a triangle; zero for a triangle without area.
///
/// The products of f32 differences are taken in f64. There they neither vanish nor overflow, for
/// triangles of any f32 numbers.
fn unit_normal(corners: [[f32; 3]; 3]) -> [f32; 3] {
    let [a, b, c] = corners.map(|point| DVec3::from(point.map(f64::from)));
    let normal = (b - a).cross(c - a).normalize_or_zero();
    // Adding zero makes -0 into +0.
    normal.to_array().map(|x| x as f32 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_name_is_cut_between_characters() {
        assert_eq!(&header("vase")[..32], b"topobook triangulate STL 1 vase\0");
        for length in 0..80 {
            let name = "x".repeat(length) + "ä";
            let header = header(&name);
            let text = std::str::from_utf8(&header).unwrap().trim_end_matches('\0');
            assert!(format!("{FIRST_WORDS} {name}").starts_with(text));
            assert!(text.len() >= 79.min(FIRST_WORDS.len() + 1 + name.len()), "{length}");
        }
    }

    #[test]
    fn triangles_of_any_size_have_unit_normals() {
        for size in [1e-45_f32, 1e-30, 1.0, 3e38] {
            let corners = [[0.0; 3], [0.0, size, 0.0], [size, 0.0, 0.0]];
            let normal = unit_normal(corners);
            assert_eq!(normal, [0.0, 0.0, -1.0]);
            assert!(normal[0].is_sign_positive() && normal[1].is_sign_positive());
        }
        assert_eq!(unit_normal([[1.0; 3]; 3]), [0.0; 3]);
    }
}
