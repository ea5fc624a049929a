//! The mesh as a binary PLY file, for viewers.
//!
//! ```text
//! ply
//! format binary_little_endian 1.0
//! comment topobook triangulate PLY 1
//! comment object vase
//! comment texture 2 surface 0         texture and surface id, as in an OBJ of ours; one for each material
//! element vertex 1024                 split where picture coordinates or normals differ
//! property float x
//! property float y
//! property float z
//! property float nx                   unit normal, outward
//! property float ny
//! property float nz
//! property float s                    picture coordinates from the lower left corner
//! property float t
//! element face 1856
//! property list uchar uint vertex_indices
//! end_header
//! ```
//!
//! After the header come the vertices, 32 bytes each, and the faces, 13 bytes each: the byte 3 and
//! three u32 indices from 0, counter-clockwise seen from outside. The header is ASCII; other characters
//! of the object's name become `_`. With several materials a face has two more properties, `texture`
//! and `surface`, each a u32 after the indices. With several patches there is a `comment object` for
//! each.

use crate::split::{SplitMesh, SplitVertex};
use crate::{Material, TriMesh};
use std::io::{self, BufWriter, Write};

/// The first comment of a PLY that `triangulate` writes.
pub const FIRST_COMMENT: &str = "topobook triangulate PLY 1";

/// Writes a mesh as binary PLY to `out`, which need not be buffered.
///
/// # Errors
/// When the output fails.
///
/// # Panics
/// See [`SplitMesh::of`].
pub fn write_ply(mesh: &TriMesh, out: impl Write) -> io::Result<()> {
    let split = SplitMesh::of(mesh);
    let mut out = BufWriter::new(out);
    out.write_all(header(mesh, &split).as_bytes())?;
    for SplitVertex { position, normal, uv } in &split.vertices {
        for number in position.iter().chain(normal).chain(uv) {
            out.write_all(&number.to_le_bytes())?;
        }
    }
    let (materials, numbers) = (mesh.materials(), mesh.material_numbers());
    for (corners, number) in split.triangles.iter().zip(numbers) {
        out.write_all(&[3])?;
        for index in corners {
            out.write_all(&index.to_le_bytes())?;
        }
        if materials.len() > 1 {
            let Material { texture, surface } = materials[number as usize];
            out.write_all(&texture.to_le_bytes())?;
            out.write_all(&surface.to_le_bytes())?;
        }
    }
    out.flush()
}

fn header(mesh: &TriMesh, split: &SplitMesh) -> String {
    let ascii = |c: char| if c.is_ascii_graphic() { c } else { '_' };
    let materials = mesh.materials();
    let mut header = format!("ply\nformat binary_little_endian 1.0\ncomment {FIRST_COMMENT}\n");
    for patch in &mesh.patches {
        header +=
            &format!("comment object {}\n", patch.name.chars().map(ascii).collect::<String>());
    }
    for Material { texture, surface } in &materials {
        header += &format!("comment texture {texture} surface {surface}\n");
    }
    header += &format!("element vertex {}\n", split.vertices.len());
    for property in ["x", "y", "z", "nx", "ny", "nz", "s", "t"] {
        header += &format!("property float {property}\n");
    }
    header += &format!(
        "element face {}\nproperty list uchar uint vertex_indices\n",
        split.triangles.len()
    );
    if materials.len() > 1 {
        header += "property uint texture\nproperty uint surface\n";
    }
    header + "end_header\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triangle;
    use crate::triangulator::Sink;
    use sweep::grid::file::Header;

    #[test]
    fn the_header_is_the_one_of_the_page_above() {
        let mut mesh = TriMesh {
            positions: vec![[0.0; 3]],
            uvs: vec![[0.0; 2]],
            normals: vec![[0.0, 0.0, 1.0]],
            ..TriMesh::default()
        };
        mesh.patch(&Header { name: "Väse".into(), ..Header::default() });
        mesh.material(Material { texture: 2, surface: 5 });
        mesh.triangle(&Triangle { position: [0; 3], uv: [0; 3], normal: [0; 3] });
        let mut bytes = Vec::new();
        write_ply(&mesh, &mut bytes).unwrap();
        bytes.truncate(bytes.len() - 32 - 13);
        let text = String::from_utf8(bytes).unwrap();
        // The lines on the module's page, without the remarks beside them.
        let page = include_str!("ply.rs").lines().filter_map(|line| line.strip_prefix("//! "));
        let lines = page.skip_while(|line| *line != "ply").take_while(|line| *line != "```");
        let lines = lines.map(|line| line.split("  ").next().unwrap_or_default());
        let expected = lines.collect::<Vec<_>>().join("\n") + "\n";
        let expected = expected
            .replace("object vase", "object V_se")
            .replace("surface 0", "surface 5")
            .replace("1024", "1")
            .replace("1856", "1");
        assert_eq!(text, expected);
    }
}
