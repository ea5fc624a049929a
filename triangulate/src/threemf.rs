//! The mesh as a 3MF file, for printers: a ZIP archive with the triangles as XML and their unit.
//!
//! | entry | content |
//! |---|---|
//! | `[Content_Types].xml` | the types of the others |
//! | `_rels/.rels` | the path of the model |
//! | `3D/3dmodel.model` | unit, vertices and triangles of one object |
//!
//! A 3MF joins triangles by the numbers of their vertices, so vertices in one place are merged as in
//! [`crate::merged`], over all patches. An object that is then not closed, or has one side, has the type
//! `surface`, since a `model` must be a solid. Normals, picture coordinates and ids are left out.
//! Coordinates have the fewest digits that give their `f32` back.
//!
//! The same mesh gives the same bytes: every entry of the ZIP has the time 1980-01-01 00:00.
//!
//! Source: "3MF Core Specification" 1.3, 3MF Consortium, 2021.

use crate::merged::Merged;
use crate::{Topology, TriMesh, Unit};
use std::fmt::Write as _;
use std::io::{self, Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

const TYPES: &str = concat!(
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n",
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">",
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>",
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>",
    "</Types>\n",
);

const RELATIONS: &str = concat!(
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n",
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">",
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" ",
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>",
    "</Relationships>\n",
);

/// Path of the model in the archive.
const MODEL: &str = "3D/3dmodel.model";

/// Length of the text after which it is handed to the archive, in bytes.
const PIECE: usize = 1 << 16;

/// Writes a mesh as 3MF to `out`. The archive is held in memory until it is complete.
///
/// # Errors
/// When the output fails.
///
/// # Panics
/// When an index of the mesh is out of range (see [`TriMesh::validate`]).
pub fn write_3mf(mesh: &TriMesh, unit: Unit, mut out: impl Write) -> io::Result<()> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default())
        .large_file(mesh.triangles.len() > LARGE)
        .unix_permissions(0o644);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, text) in [("[Content_Types].xml", TYPES), ("_rels/.rels", RELATIONS)] {
        archive.start_file(path, options)?;
        archive.write_all(text.as_bytes())?;
    }
    archive.start_file(MODEL, options)?;
    model(mesh, unit, &mut archive)?;
    out.write_all(archive.finish()?.get_ref())?;
    out.flush()
}

/// Number of triangles from which on the text may have more than 2^32 bytes: each has less than 100, and
/// so has a vertex.
const LARGE: usize = 10_000_000;

fn model(mesh: &TriMesh, unit: Unit, out: &mut impl Write) -> io::Result<()> {
    let (merged, solid) = merged(mesh);
    let kind = if solid { "model" } else { "surface" };
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{}\" xml:lang=\"en-US\" \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n\
         <metadata name=\"Application\">topobook triangulate 3MF 1</metadata>\n\
         <resources>\n<object id=\"1\" type=\"{kind}\" name=\"{}\">\n<mesh>\n<vertices>\n",
        unit.name(),
        escaped(&mesh.name)
    );
    for [x, y, z] in &merged.positions {
        // Writing to a text cannot fail.
        let _ = writeln!(text, "<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>");
        pass_on(&mut text, out, PIECE)?;
    }
    text += "</vertices>\n<triangles>\n";
    for triangle in &merged.triangles {
        let [a, b, c] = triangle.position;
        let _ = writeln!(text, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
        pass_on(&mut text, out, PIECE)?;
    }
    text += "</triangles>\n</mesh>\n</object>\n</resources>\n<build>\n<item objectid=\"1\"/>\n</build>\n</model>\n";
    pass_on(&mut text, out, 0)
}

/// Hands the text to the output if it is at least this long.
fn pass_on(text: &mut String, out: &mut impl Write, least: usize) -> io::Result<()> {
    if text.len() >= least {
        out.write_all(text.as_bytes())?;
        text.clear();
    }
    Ok(())
}

/// Returns the triangles over merged vertices that triangles use, and whether they enclose a solid.
fn merged(mesh: &TriMesh) -> (TriMesh, bool) {
    let (merged, Topology { manifold, closed, oriented, .. }) = Merged::mesh(mesh);
    let mut numbers = vec![None; merged.positions.len()];
    let mut used = TriMesh::default();
    for mut triangle in merged.triangles {
        triangle.position = triangle.position.map(|index| {
            *numbers[index as usize].get_or_insert_with(|| {
                used.positions.push(merged.positions[index as usize]);
                used.positions.len() as u32 - 1
            })
        });
        used.triangles.push(triangle);
    }
    (used, manifold && closed && oriented)
}

/// Returns a name as the value of an XML attribute.
fn escaped(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        match c {
            '&' => text += "&amp;",
            '<' => text += "&lt;",
            '>' => text += "&gt;",
            '"' => text += "&quot;",
            // XML has no control characters.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => text.push('_'),
            c => text.push(c),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_becomes_the_value_of_an_attribute() {
        assert_eq!(escaped("a<\"b\">&\u{7}ä"), "a&lt;&quot;b&quot;&gt;&amp;_ä");
    }

    #[test]
    fn numbers_are_plain_decimals() {
        // An exponent would be allowed too, but some readers of XML numbers do not take it.
        assert_eq!(format!("{} {} {}", 1e-7_f32, 1e9_f32, 0.1_f32), "0.0000001 1000000000 0.1");
    }
}
