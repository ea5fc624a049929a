//! Parts of PLY and glTF files, next to the same mesh as OBJ.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::formats::glb;
use files::{FileError, Source};
use glam::DVec3;
use render::scene::mesh_file::{self, Near};
use render::scene::obj::ObjFile;
use render::shape::Mesh;
use serde_json::json;
use std::io::ErrorKind;
use std::path::Path;

/// A folder without files.
#[derive(Debug)]
struct Empty;

impl Source for Empty {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let name = path.display().to_string();
        Err(FileError::Read { name, source: ErrorKind::NotFound.into() })
    }
}

fn read(name: &str, bytes: &[u8]) -> ObjFile {
    let reserve = &mut |_| Ok(());
    let near = Near { folder: Path::new(""), source: &Empty, reserve };
    mesh_file::read(name, bytes, near).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the corners of all triangles.
fn places(mesh: &Mesh) -> Vec<[DVec3; 3]> {
    (0..mesh.triangles.len() as u32).map(|triangle| mesh.places(triangle)).collect()
}

fn unused(read: &ObjFile) -> Vec<(&str, usize)> {
    read.unused.iter().map(|(what, count)| (what.as_str(), *count)).collect()
}

/// A PLY text of vertices with these properties, and of faces.
fn ply(properties: &[&str], vertices: &[&str], element: &str, faces: &[&str]) -> Vec<u8> {
    let properties: String = properties.iter().map(|name| format!("property {name}\n")).collect();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {}\n{properties}element {element} {}\n\
         property list uchar int vertex_indices\nend_header\n{}\n{}\n",
        vertices.len(),
        faces.len(),
        vertices.join("\n"),
        faces.join("\n")
    )
    .into_bytes()
}

const XYZ: [&str; 3] = ["double x", "double y", "double z"];

/// An L whose fan from its first corner would leave it.
#[test]
fn faces_of_a_ply_are_divided_inside_as_those_of_an_obj() {
    let vertices = ["2 1 0", "1 1 0", "1 2 0", "0 2 0", "0 0 0", "2 0 0"];
    let found = read("a.ply", &ply(&XYZ, &vertices, "face", &["6 0 1 2 3 4 5"]));
    let lines: String = vertices.iter().map(|vertex| format!("v {vertex}\n")).collect();
    let truth = read("a.obj", format!("{lines}f 1 2 3 4 5 6\n").as_bytes());
    assert_eq!(places(&found.mesh), places(&truth.mesh));
    let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).z / 2.0;
    let areas: Vec<f64> = places(&found.mesh).into_iter().map(area).collect();
    assert!(areas.iter().all(|&area| area > 0.0) && areas.iter().sum::<f64>() == 3.0);
}

#[test]
fn every_other_triangle_of_a_strip_is_turned_over() {
    let vertices = ["0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 2 0", "5 5 5"];
    let bytes = ply(&XYZ, &vertices, "tristrips", &["9 0 1 2 3 -1 2 3 4 -1"]);
    let mesh = read("a.ply", &bytes).mesh;
    let positions: Vec<[u32; 3]> = mesh.triangles.iter().map(|t| t.position).collect();
    assert_eq!(positions, [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
}

#[test]
fn colors_of_a_ply_are_codes_and_become_linear() {
    let names =
        ["float x", "float y", "float z", "uchar red", "uchar green", "uchar blue", "uchar alpha"];
    let vertices = ["0 0 0 255 0 188 9", "1 0 0 0 0 0 9", "0 1 0 255 255 255 9"];
    let found = read("a.ply", &ply(&names, &vertices, "face", &["3 0 1 2"]));
    assert_eq!(found.colored, 3);
    assert_eq!(
        (found.mesh.colors[0][..2].to_vec(), found.mesh.colors[1]),
        (vec![1.0, 0.0], [0.0; 3])
    );
    // The code 188 stands for half of the light, to a step of codes.
    assert!((found.mesh.colors[0][2] - 0.5).abs() < 0.004);
    assert_eq!(unused(&found), [("property `alpha` of vertices", 1)]);
}

/// Metres of a national grid: `f32` has steps of half a metre there.
#[test]
fn a_ply_in_double_precision_keeps_its_digits_far_from_the_origin() {
    let vertices =
        ["5843210.25 512340.125 3", "5843211.25 512340.125 3", "5843210.25 512341.375 3"];
    let mesh = read("a.ply", &ply(&XYZ, &vertices, "face", &["3 0 1 2"])).mesh;
    let [a, b, c] = mesh.places(0);
    let exact = [DVec3::new(5_843_210.25, 512_340.125, 3.0), DVec3::X, DVec3::new(0.0, 1.25, 0.0)];
    assert_eq!([a, b - a, c - a], exact);
}

#[test]
fn texture_coordinates_of_faces_are_those_of_corners() {
    let text = "ply\nformat ascii 1.0\ncomment TextureFile wood grain.png\nelement vertex 4\n\
        property float x\nproperty float y\nproperty float z\nelement face 2\n\
        property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n\
        0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n";
    let found = read("a.ply", text.as_bytes());
    let triangle = found.mesh.triangles[0];
    let uvs = triangle.uv.map(|index| found.mesh.uvs[index as usize]);
    assert_eq!(uvs, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    assert_eq!(found.mesh.triangles[1].uv, [render::shape::mesh::NONE; 3]);
    let picture = found.materials[0].picture.as_ref().unwrap();
    assert_eq!(picture.path, "wood grain.png");
}

/// Whole numbers of 16 bits with a stride, and two rows that a sparse array replaces, are the corners of
/// the plain array.
#[test]
fn accessors_may_be_whole_numbers_with_gaps_and_replacements() {
    let corners = [[0, 0, 0], [32767, 0, 0], [0, 32767, 0], [0, 0, -32767_i16]];
    let row = |row: [i16; 3]| [row.map(i16::to_le_bytes).concat(), vec![7, 7]].concat();
    let mut bytes = [row([5; 3]), row(corners[1]), row(corners[2]), row([9; 3])].concat();
    bytes.extend([0, 3, 0, 0]);
    bytes.extend([corners[0], corners[3]].iter().flatten().flat_map(|x| x.to_le_bytes()));
    let strip = [0, 1, 2, 3];
    bytes.extend(strip);
    let json = json!({
        "asset": { "version": "2.0" }, "extensionsRequired": ["KHR_mesh_quantization"],
        "nodes": [{ "mesh": 0, "scale": [2, 2, 2] }],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0 }, "indices": 1, "mode": 5 },
            { "attributes": { "POSITION": 0 }, "indices": 1, "mode": 6 },
            { "attributes": { "POSITION": 0 }, "mode": 0 } ] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5122, "normalized": true, "count": 4, "type": "VEC3",
              "sparse": { "count": 2, "indices": { "bufferView": 1, "componentType": 5121 },
                "values": { "bufferView": 2 } } },
            { "bufferView": 3, "componentType": 5121, "count": 4, "type": "SCALAR" } ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 32, "byteStride": 8 },
            { "buffer": 0, "byteOffset": 32, "byteLength": 2 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 12 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 4 } ],
        "buffers": [{ "byteLength": 52 }],
    });
    let found = read("a.glb", &glb(&json, &bytes));
    let [o, x, y, z] = [DVec3::ZERO, 2.0 * DVec3::X, 2.0 * DVec3::Y, -2.0 * DVec3::Z];
    assert_eq!(places(&found.mesh), [[o, x, y], [y, x, z], [o, x, y], [o, y, z]]);
    assert_eq!(unused(&found), [("points and lines", 1)]);
}

/// A mesh that two nodes show is there twice, with one material; a material without a name has one.
#[test]
fn nodes_may_share_a_mesh_and_parts_a_material() {
    let corners: Vec<u8> =
        [0., 0., 0., 1., 0., 0., 0., 1., 0.0_f32].iter().flat_map(|x| x.to_le_bytes()).collect();
    let json = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "children": [1, 2] }, { "mesh": 0 }, { "mesh": 0, "translation": [0, 0, 4] }],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0 }, "material": 1 }, { "attributes": { "POSITION": 0 } },
            { "attributes": { "POSITION": 0 }, "material": 0 } ] }],
        "materials": [{ "name": "a" }, { "name": "a", "alphaMode": "BLEND",
            "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.25] } }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }], "buffers": [{ "byteLength": 36 }],
    });
    let found = read("a.glb", &glb(&json, &corners));
    assert_eq!(found.mesh.surfaces, ["a", "default", "a (2)"]);
    assert_eq!(
        found.mesh.triangles.iter().map(|t| t.surface).collect::<Vec<_>>(),
        [0, 1, 2, 0, 1, 2]
    );
    assert_eq!(found.mesh.places(3)[0], DVec3::new(0.0, 0.0, 4.0));
    let transparencies = found.materials.iter().map(|entry| entry.material.transparency);
    assert_eq!(transparencies.collect::<Vec<_>>(), [0.75, 0.0, 0.0]);
}

#[test]
fn lost_parts_and_small_faces_of_an_obj_cost_only_themselves() {
    let lines = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n\
        f 1/1 2/2 3/5\nf 1//1 2//0 3//1\nf 1 2\nf 1/1 2/2 3/3\n";
    let found = read("a.obj", lines.as_bytes());
    let none = render::shape::mesh::NONE;
    let uvs: Vec<u32> = found.mesh.triangles.iter().map(|triangle| triangle.uv[2]).collect();
    assert_eq!(uvs, [none, none, 2]);
    assert!(found.mesh.triangles.iter().all(|triangle| triangle.normal == [none; 3]));
    let expected = [
        ("faces of fewer than three corners", 1),
        ("indices of vt or vn that the file does not have", 2),
    ];
    assert_eq!(unused(&found), expected);
}

/// Found by the fuzzer: a picture without any data, and colours below 0.
#[test]
fn a_picture_without_data_is_remarked_and_colors_are_within_their_range() {
    let rows = [0., 0., 0., 1., 0., 0., 0., 1., 0., -1., 0.5, 2., 1., 1., 1., 0., 0., 0.0_f32];
    let bytes: Vec<u8> = rows.iter().flat_map(|x| x.to_le_bytes()).collect();
    let json = json!({
        "asset": { "version": "2.0" }, "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0, "COLOR_0": 1 }, "material": 0 } ] }],
        "materials": [{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 },
            "metallicFactor": 0 } }],
        "textures": [{ "source": 0 }], "images": [{}],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3" } ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36, "byteLength": 36 } ],
        "buffers": [{ "byteLength": 72 }],
    });
    let found = read("a.glb", &glb(&json, &bytes));
    assert_eq!(found.mesh.colors[0], [0.0, 0.5, 1.0]);
    assert_eq!(unused(&found), [("textures without a picture that is read", 1)]);
}
