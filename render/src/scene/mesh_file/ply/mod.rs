//! Reads PLY files: polygons over vertices with properties of any names and types, as text or as bytes.
//!
//! | in the file | becomes |
//! |---|---|
//! | `x y z`, `nx ny nz` of a vertex | position and normal |
//! | `s t`, `u v` or `texture_u texture_v` of a vertex | texture coordinates |
//! | `red green blue` of a vertex, as sRGB | colour of the vertex, linear |
//! | `vertex_indices` or `vertex_index` of a face | triangles inside the polygon |
//! | `texcoord` of a face | texture coordinates of its corners |
//! | `vertex_indices` of `tristrips`, separated by -1 | triangles, every other one turned over |
//! | the comment `TextureFile NAME` | the picture of all faces |
//! | ids of a file of `triangulate` | surfaces by the names that its OBJ has |
//! | other elements and properties | counted in [`ObjFile::unused`] |
//!
//! Source: G. Turk, "The PLY Polygon File Format", 1994; names of properties as mesh editors write them.

mod body;
mod faces;
mod header;

use super::Placed;
use super::error::MeshFileError;
use crate::color::Encoding as ColorEncoding;
use crate::scene::mtl::{Entry, Map, plain};
use crate::scene::obj::ObjFile;
use crate::shape::Mesh;
use crate::shape::mesh::Triangle;
use body::{Body, Fault, Position};
use faces::Faces;
use files::MemoryError;
use glam::DVec3;
use header::{Element, Encoding, Header, Property};
use std::collections::BTreeMap;

/// First bytes of a PLY file.
const MAGIC: &[u8] = b"ply";

/// Returns whether a file begins as a PLY file does.
pub(super) fn is_ply(bytes: &[u8]) -> bool {
    let rest = bytes.strip_prefix(MAGIC);
    rest.is_some_and(|rest| matches!(rest.first(), Some(b'\n' | b'\r' | b' ')))
}

/// Reads the bytes of a PLY file. Asks for memory first.
pub(super) fn read(
    file: &str,
    bytes: &[u8],
    reserve: &mut dyn FnMut(u64) -> Result<(), MemoryError>,
) -> Result<Placed, MeshFileError> {
    let header = Header::read(bytes).map_err(|(number, found, expected)| MeshFileError::Line {
        file: file.into(),
        line: number + 1,
        found,
        expected: expected.into(),
    })?;
    let mut body = Body::new(bytes, &header);
    reserve(needed(&header, body.left()))?;
    let mut reader = Reader::new(&header);
    for element in &header.elements {
        reader.element(element, &mut body).map_err(|Wrong { fault, expected }| {
            let (file, found) = (file.into(), fault.found);
            match fault.position {
                Position::Line(line) => MeshFileError::Line { file, line, found, expected },
                Position::Byte(offset) => MeshFileError::Byte { file, offset, found, expected },
            }
        })?;
    }
    reader.pass_over("lines of the header that are no statement", header.strange);
    let longer = reader.longer;
    reader.pass_over("lines with more numbers than their element has", longer);
    let rest = body.left().trim_ascii().len();
    if rest > 0 {
        reader.pass_over("bytes behind the last element", rest);
    }
    reader.finish(file, &header)
}

/// A fault, and the expected value.
#[derive(Debug)]
struct Wrong {
    fault: Fault,
    expected: String,
}

/// Largest numbers of bytes for each vertex and triangle while they are read. Lists grow by doubling.
const VERTEX: u64 = 2 * (12 + 24 + 12 + 8 + 12);
const TRIANGLE: u64 = 2 * size_of::<Triangle>() as u64;

/// Returns an upper bound of the bytes that the mesh takes while it is read. A face has two triangles less
/// than indices, and the indices are counted by the bytes or words that are left for them.
fn needed(header: &Header, body: &[u8]) -> u64 {
    let is_text = header.encoding == Encoding::Text;
    let size = |property: &Property| {
        let kind = property.list.unwrap_or(property.kind);
        if is_text { 1 } else { kind.size() as u64 }
    };
    let blanks = || body.iter().filter(|byte| byte.is_ascii_whitespace()).count() as u64 + 1;
    let mut left = if is_text { blanks() } else { body.len() as u64 };
    let (mut vertices, mut faces, mut index) = (0, 0, u64::MAX);
    for element in &header.elements {
        // No more elements than their bytes or words.
        let each = element.properties.iter().map(size).sum::<u64>().max(1);
        let count = element.count.min(left / each);
        left -= count * each;
        if element.name == "vertex" {
            vertices += count;
        }
        for property in element.properties.iter().filter(|property| property.list.is_some()) {
            index = index.min(if is_text { 1 } else { property.kind.size() as u64 });
            faces += if element.name == "face" { count } else { 0 };
        }
    }
    let triangles = (left / index).saturating_sub(2 * faces.min(left / index / 3));
    VERTEX.saturating_mul(vertices).saturating_add(TRIANGLE.saturating_mul(triangles))
}

/// The properties of a vertex that are read, by their number.
const SLOTS: [&[&str]; 11] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["s", "u", "texture_u", "texture_s"],
    &["t", "v", "texture_v", "texture_t"],
    &["red", "diffuse_red", "r"],
    &["green", "diffuse_green", "g"],
    &["blue", "diffuse_blue", "b"],
];

/// The first and the last number of the normal, the texture coordinates and the colour in [`SLOTS`].
const NORMAL: std::ops::Range<usize> = 3..6;
const UV: std::ops::Range<usize> = 6..8;
const COLOR: std::ops::Range<usize> = 8..11;

/// The mesh so far.
#[derive(Debug)]
struct Reader {
    mesh: Mesh,
    positions: Vec<DVec3>,
    faces: Faces,
    vertices: u64,
    /// Number of lines with more words than their element has numbers.
    longer: usize,
    unused: BTreeMap<String, usize>,
}

impl Reader {
    fn new(header: &Header) -> Self {
        let of_vertices = |element: &&Element| element.name == "vertex";
        Self {
            mesh: Mesh::default(),
            positions: Vec::new(),
            faces: Faces::new(header),
            vertices: header.elements.iter().filter(of_vertices).map(|element| element.count).sum(),
            longer: 0,
            unused: BTreeMap::new(),
        }
    }

    fn pass_over(&mut self, what: &str, count: usize) {
        if count > 0 {
            *self.unused.entry(crate::scene::obj::shortened(what)).or_default() += count;
        }
    }

    fn element(&mut self, element: &Element, body: &mut Body<'_>) -> Result<(), Wrong> {
        let wrong = |fault| {
            let expected =
                format!("{} times `{}`, as the header says", element.count, element.name);
            Wrong { fault, expected }
        };
        match element.name.as_str() {
            "vertex" => {
                let (slots, unused) = slots(element);
                if !slots.has(0..3) && element.count > 0 {
                    let fault = body.before("vertices without x, y and z".into());
                    return Err(Wrong { fault, expected: "all three in the header".into() });
                }
                for _ in 0..element.count {
                    self.vertex(&slots, element, body).map_err(wrong)?;
                    self.longer += usize::from(body.end_line());
                }
                for name in unused {
                    self.pass_over(&format!("property `{name}` of vertices"), 1);
                }
            }
            "face" | "tristrips" => {
                let mut faces = std::mem::take(&mut self.faces);
                faces.read(element, body, self.vertices, &mut self.mesh.triangles)?;
                self.longer += std::mem::take(&mut faces.longer);
                for (what, count) in faces.unused(element) {
                    self.pass_over(&what, count);
                }
                self.faces = faces;
            }
            other => {
                for _ in 0..element.count {
                    skip(element, body).map_err(wrong)?;
                    self.longer += usize::from(body.end_line());
                }
                self.pass_over(&format!("element `{other}`"), element.count as usize);
            }
        }
        Ok(())
    }

    fn vertex(
        &mut self,
        slots: &Slots,
        element: &Element,
        body: &mut Body<'_>,
    ) -> Result<(), Fault> {
        let mut numbers = [0.0; SLOTS.len()];
        for (property, slot) in element.properties.iter().zip(&slots.of) {
            if let Some(count) = property.list {
                list(body, count, |body| body.number(property.kind).map(drop))?;
                continue;
            }
            let number = body.number(property.kind)?;
            if let Some(slot) = *slot {
                let is_color = COLOR.contains(&slot);
                numbers[slot] = if is_color { number / property.kind.white() } else { number };
            }
        }
        let single = numbers.map(|number| number as f32);
        let [_, _, _, nx, ny, nz, s, t, ..] = single;
        self.positions.push(DVec3::new(numbers[0], numbers[1], numbers[2]));
        if slots.has(NORMAL) {
            self.mesh.normals.push([nx, ny, nz]);
        }
        if slots.has(UV) {
            self.mesh.uvs.push([s, t]);
        }
        if slots.has(COLOR) {
            let channel = |k: usize| ColorEncoding::Srgb.decode(numbers[k].clamp(0.0, 1.0)) as f32;
            self.mesh.colors.push([channel(8), channel(9), channel(10)]);
        }
        Ok(())
    }

    fn finish(mut self, file: &str, header: &Header) -> Result<Placed, MeshFileError> {
        if self.mesh.triangles.is_empty() {
            let found = format!("{} vertices and no faces", self.positions.len());
            let expected = "a mesh with faces".into();
            return Err(MeshFileError::Part { file: file.into(), found, expected });
        }
        self.faces.finish(&mut self.mesh, &self.positions);
        let picture =
            header.comments.iter().find_map(|comment| comment.strip_prefix("TextureFile "));
        let material = picture.and_then(Map::read).map(|picture| {
            let [name] = &self.mesh.surfaces[..] else { return Vec::new() };
            vec![Entry { picture: Some(picture), ..Entry::new(name, plain()) }]
        });
        let read = ObjFile {
            file: file.into(),
            colored: self.mesh.colors.len(),
            mesh: self.mesh,
            materials: material.unwrap_or_default(),
            unused: self.unused.into_iter().collect(),
            ..ObjFile::default()
        };
        Ok((read, self.positions))
    }
}

/// The slot of each property of a vertex.
#[derive(Debug)]
struct Slots {
    of: Vec<Option<usize>>,
}

impl Slots {
    /// Returns whether vertices have all of these properties.
    fn has(&self, mut slots: std::ops::Range<usize>) -> bool {
        slots.all(|slot| self.of.contains(&Some(slot)))
    }
}

/// Returns the slots of the properties, and the names of those without one.
fn slots(element: &Element) -> (Slots, Vec<&str>) {
    let mut slots = Slots { of: Vec::new() };
    let mut unused = Vec::new();
    for property in &element.properties {
        let name = property.name.as_str();
        let slot = SLOTS.iter().position(|names| names.contains(&name));
        let slot = slot.filter(|slot| property.list.is_none() && !slots.of.contains(&Some(*slot)));
        if slot.is_none() {
            unused.push(name);
        }
        slots.of.push(slot);
    }
    (slots, unused)
}

/// Reads a list. Returns the count of its items.
fn list(
    body: &mut Body<'_>,
    count: header::Kind,
    mut item: impl FnMut(&mut Body<'_>) -> Result<(), Fault>,
) -> Result<u64, Fault> {
    let number = body.number(count)?;
    if number < 0.0 || number.fract() != 0.0 || !number.is_finite() {
        return Err(body.before(format!("a list of {number} items")));
    }
    for _ in 0..number as u64 {
        item(body)?;
    }
    Ok(number as u64)
}

/// Passes over the properties of an element.
fn skip(element: &Element, body: &mut Body<'_>) -> Result<(), Fault> {
    for property in &element.properties {
        match property.list {
            Some(count) => drop(list(body, count, |body| body.number(property.kind).map(drop))?),
            None => drop(body.number(property.kind)?),
        }
    }
    Ok(())
}
