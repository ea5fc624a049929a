//! The mesh as a binary glTF 2.0 file (GLB), for viewers and web pages.
//!
//! ```text
//! glTF  u32 2  u32 length of the file
//! u32 length  JSON      one node with one mesh, and for each material a primitive and a material
//! u32 length  BIN       positions, normals, picture coordinates, indices of all primitives
//! ```
//!
//! Vertices are split as in a PLY ([`crate::split`]). A material is matt grey and has the name that an OBJ
//! gives it, such as `tex2_surf0`. Picture coordinates start at the upper left corner, as glTF asks for.
//!
//! A length of 1 is one meter in glTF. With another unit the node scales the mesh; the positions stay
//! those of an OBJ to the last bit.
//!
//! Source: "glTF 2.0 Specification", Khronos Group, 2021.

use crate::split::{SplitMesh, SplitVertex};
use crate::{TriMesh, Unit};
use serde_json::{Value, json};
use std::io::{self, BufWriter, Write};

/// The generator that the file names.
pub const GENERATOR: &str = "topobook triangulate GLB 1";

/// Codes of glTF: 32-bit numbers, and the uses of a view.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Bytes of the header of the file, and of the header of a chunk.
const HEADER: usize = 12;
const CHUNK: usize = 8;

/// Writes a mesh as GLB to `out`, which need not be buffered. `unit` is the unit of the positions; without
/// one they are meters.
///
/// # Errors
/// When the output fails, or the file would be longer than the 2^32 - 1 bytes that a GLB can hold.
///
/// # Panics
/// See [`SplitMesh::of`].
pub fn write_glb(mesh: &TriMesh, unit: Option<Unit>, out: impl Write) -> io::Result<()> {
    let split = SplitMesh::of(mesh);
    let (materials, numbers) = (mesh.materials(), mesh.material_numbers());
    // The triangles of each material, in their order.
    let mut groups: Vec<Vec<[u32; 3]>> = vec![Vec::new(); materials.len()];
    for (&corners, number) in split.triangles.iter().zip(numbers) {
        groups[number as usize].push(corners);
    }
    let names: Vec<String> = materials.iter().map(|material| material.name()).collect();
    let mut text = content(mesh, &split, &names, &groups, unit).to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let binary = binary_length(&split);
    let chunk = if binary > 0 { CHUNK + binary } else { 0 };
    let length = HEADER + CHUNK + text.len() + chunk;
    let length = u32::try_from(length).map_err(|_| {
        io::Error::other(format!("found {length} bytes, expected at most 4294967295 in a GLB"))
    })?;
    let mut out = BufWriter::new(out);
    out.write_all(b"glTF")?;
    out.write_all(&2_u32.to_le_bytes())?;
    out.write_all(&length.to_le_bytes())?;
    out.write_all(&(text.len() as u32).to_le_bytes())?;
    out.write_all(b"JSON")?;
    out.write_all(&text)?;
    if binary > 0 {
        out.write_all(&(binary as u32).to_le_bytes())?;
        out.write_all(b"BIN\0")?;
        let vertices = || split.vertices.iter();
        let positions = vertices().flat_map(|vertex| vertex.position);
        let normals = vertices().flat_map(|vertex| vertex.normal);
        let uvs = vertices().flat_map(|SplitVertex { uv: [s, t], .. }| [*s, flipped(*t)]);
        for number in positions.chain(normals).chain(uvs) {
            out.write_all(&number.to_le_bytes())?;
        }
        for index in groups.iter().flatten().flatten() {
            out.write_all(&index.to_le_bytes())?;
        }
    }
    out.flush()
}

/// Turns a picture coordinate that counts up into one that counts down.
fn flipped(t: f32) -> f32 {
    (1.0 - f64::from(t)) as f32
}

/// Bytes of a vertex: position, normal and picture coordinates.
const VERTEX: usize = 12 + 12 + 8;

fn binary_length(split: &SplitMesh) -> usize {
    VERTEX * split.vertices.len() + 12 * split.triangles.len()
}

/// Returns the JSON of the file.
fn content(
    mesh: &TriMesh,
    split: &SplitMesh,
    names: &[String],
    groups: &[Vec<[u32; 3]>],
    unit: Option<Unit>,
) -> Value {
    let asset = json!({ "version": "2.0", "generator": GENERATOR });
    if split.triangles.is_empty() {
        return json!({ "asset": asset });
    }
    let count = split.vertices.len();
    let mut node = json!({ "mesh": 0, "name": mesh.name });
    if let Some(unit) = unit.filter(|&unit| unit != Unit::Meter) {
        let meters = unit.meters();
        node["scale"] = json!([meters, meters, meters]);
    }
    let view = |offset: usize, length: usize, target: u32| json!({ "buffer": 0, "byteOffset": offset, "byteLength": length, "target": target });
    let (low, high) = bounds(split);
    let mut accessors = vec![
        json!({ "bufferView": 0, "componentType": FLOAT, "count": count, "type": "VEC3",
            "min": low, "max": high }),
        json!({ "bufferView": 1, "componentType": FLOAT, "count": count, "type": "VEC3" }),
        json!({ "bufferView": 2, "componentType": FLOAT, "count": count, "type": "VEC2" }),
    ];
    let mut primitives = Vec::new();
    let mut offset = 0;
    for (number, group) in groups.iter().enumerate() {
        primitives.push(json!({
            "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 },
            "indices": accessors.len(), "material": number,
        }));
        accessors
            .push(json!({ "bufferView": 3, "byteOffset": offset, "componentType": UNSIGNED_INT,
            "count": 3 * group.len(), "type": "SCALAR" }));
        offset += 12 * group.len();
    }
    let material = |name: &String| {
        json!({ "name": name, "doubleSided": true, "pbrMetallicRoughness": {
            "baseColorFactor": [0.8, 0.8, 0.8, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0 } })
    };
    json!({
        "asset": asset,
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [node],
        "meshes": [{ "name": mesh.name, "primitives": primitives }],
        "materials": names.iter().map(material).collect::<Vec<_>>(),
        "accessors": accessors,
        "bufferViews": [
            view(0, 12 * count, VERTICES),
            view(12 * count, 12 * count, VERTICES),
            view(24 * count, 8 * count, VERTICES),
            view(VERTEX * count, 12 * split.triangles.len(), INDICES),
        ],
        "buffers": [{ "byteLength": binary_length(split) }],
    })
}

/// Returns the smallest and the largest coordinates.
fn bounds(split: &SplitMesh) -> ([f32; 3], [f32; 3]) {
    let start = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    split.vertices.iter().fold(start, |(low, high), vertex| {
        let least = [0, 1, 2].map(|k| low[k].min(vertex.position[k]));
        (least, [0, 1, 2].map(|k| high[k].max(vertex.position[k])))
    })
}
