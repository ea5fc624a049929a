//! Meshes in STL, PLY and glTF: the same mesh is the same picture in every format.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench;

use bench::{Bench, encoded, ending};
use image::{ImageFormat, RgbImage};
use serde_json::{Value, json};

/// A tetrahedron that shows three of its faces.
const CORNERS: [[f32; 3]; 4] =
    [[-0.5, -0.5, 0.0], [0.75, -0.5, 0.25], [0.0, 0.75, 0.0], [0.0, 0.0, 0.5]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

/// A scene that shows a mesh without a name of its own.
fn scene(file: &str, keys: &str) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, "ambient": 0.2, "background": [0, 0, 0.25],
        "camera": {{ "eye": [0.2, 0.3, 1.5], "target": [0, 0, 0], "fov_deg": 60 }},
        "lights": [ {{ "directional": {{ "direction": [-1, -2, -3], "color": 1 }} }} ],
        "materials": {{ "clay": {{ "color": [0.8, 0.6, 0.4] }},
          "glass": {{ "transparency": 1, "diffuse": 0, "ambient": 0, "index_of_refraction": 1.5 }} }},
        "objects": [ {{ "mesh": {{ "name": "shape", "file": "{file}"{keys} }} }} ] }}"#
    )
}

const CLAY: &str = r#", "material": "clay""#;

/// Renders a mesh file. Returns the picture's bytes and what was said.
fn rendered(name: &str, bytes: &[u8], keys: &str, others: &[(&str, Vec<u8>)]) -> (Vec<u8>, String) {
    let bench = Bench::with_scene(&scene(name, keys));
    bench.write(name, bytes);
    for (name, bytes) in others {
        bench.write(name, bytes);
    }
    let run = bench.run(&["scene.json", "-o", "out.png", "--size", "24x18"], b"");
    let (code, said) = ending(&run);
    assert_eq!(code, Some(0), "{name}: {said}");
    (bench.read("out.png"), said)
}

fn obj() -> Vec<u8> {
    let vertices = CORNERS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
    let faces = FACES.map(|face| {
        let [a, b, c] = face.map(|index| index + 1);
        format!("f {a} {b} {c}\n")
    });
    (vertices + &faces.concat()).into_bytes()
}

fn stl_text() -> String {
    let facet = |face: [u32; 3]| {
        let vertex = |index: u32| {
            let [x, y, z] = CORNERS[index as usize];
            format!("    vertex {x:e} {y:e} {z:e}\n")
        };
        let vertices = face.map(vertex).concat();
        format!("  facet normal 0 0 0\n  outer loop\n{vertices}  endloop\n  endfacet\n")
    };
    format!("solid shape\n{}endsolid shape\n", FACES.map(facet).concat())
}

fn stl_bytes(header: &[u8]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes[..header.len()].copy_from_slice(header);
    bytes.extend((FACES.len() as u32).to_le_bytes());
    for face in FACES {
        bytes.extend([0; 12]);
        let numbers = face.iter().flat_map(|&index| CORNERS[index as usize]);
        bytes.extend(numbers.flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ply_text(end: &str) -> Vec<u8> {
    let mut lines = vec!["ply".to_string(), "format ascii 1.0".into(), "element vertex 4".into()];
    lines.extend(["x", "y", "z"].map(|name| format!("property double {name}")));
    lines.extend(
        ["element face 4", "property list uchar int vertex_index", "end_header"].map(Into::into),
    );
    lines.extend(CORNERS.map(|[x, y, z]| format!("{x} {y} {z}")));
    lines.extend(FACES.map(|[a, b, c]| format!("3 {a} {b} {c}")));
    (lines.join(end) + end).into_bytes()
}

fn ply_bytes(is_big: bool) -> Vec<u8> {
    let order = if is_big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\ncomment by hand\nelement vertex 4\n\
         property float32 x\nproperty float32 y\nproperty float32 z\nelement face 4\n\
         property list uint8 uint32 vertex_indices\nend_header\n"
    )
    .into_bytes();
    let bits = |x: f32| x.to_bits();
    let mut word = |word: u32| {
        bytes.extend(if is_big { word.to_be_bytes() } else { word.to_le_bytes() });
    };
    CORNERS.iter().flatten().copied().map(bits).for_each(&mut word);
    for face in FACES {
        bytes.push(3);
        for index in face {
            bytes.extend(if is_big { index.to_be_bytes() } else { index.to_le_bytes() });
        }
    }
    bytes
}

/// Returns the binary chunk of the tetrahedron: positions, then indices of 16 bits.
fn chunk() -> Vec<u8> {
    let mut bytes: Vec<u8> = CORNERS.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend(FACES.iter().flatten().flat_map(|&index| (index as u16).to_le_bytes()));
    bytes
}

/// Returns the JSON of the tetrahedron, without buffers.
fn gltf() -> Value {
    json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 24 },
        ],
        "buffers": [{ "byteLength": 72 }],
    })
}

/// Returns a GLB of JSON and a binary chunk.
pub fn glb(json: &Value, chunk: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut parts = Vec::new();
    for (kind, part) in [(b"JSON", &text[..]), (b"BIN\0", chunk)] {
        parts.extend((part.len() as u32).to_le_bytes());
        parts.extend(kind);
        parts.extend(part);
    }
    let length = 12 + parts.len() as u32;
    [&b"glTF"[..], &2_u32.to_le_bytes(), &length.to_le_bytes(), &parts].concat()
}

/// Returns the URI of data.
fn data(bytes: &[u8]) -> String {
    use base64::Engine as _;
    let text = base64::engine::general_purpose::STANDARD.encode(bytes);
    format!("data:application/octet-stream;base64,{text}")
}

#[test]
fn a_mesh_is_the_same_picture_in_every_format() {
    let truth = rendered("shape.obj", &obj(), CLAY, &[]);
    assert_eq!(truth.1, "");
    let mut beside = gltf();
    beside["buffers"][0]["uri"] = json!("the%20numbers.bin");
    let mut inside = gltf();
    inside["buffers"][0]["uri"] = json!(data(&chunk()));
    let numbers = [("the numbers.bin", chunk())];
    for (name, bytes, others) in [
        ("shape.stl", stl_text().into_bytes(), &[][..]),
        ("shape.stl", stl_text().to_uppercase().replace('\n', "\r\n").into_bytes(), &[]),
        ("shape.STL", stl_bytes(b"made by hand"), &[]),
        // Many binary files begin like a text.
        ("shape.stl", stl_bytes(b"solid facet"), &[]),
        ("shape.ply", ply_text("\n"), &[]),
        ("shape.ply", ply_text("\r\n"), &[]),
        ("shape.ply", ply_text("\r"), &[]),
        ("shape.ply", ply_bytes(false), &[]),
        ("shape.ply", ply_bytes(true), &[]),
        ("shape.glb", glb(&gltf(), &chunk()), &[]),
        ("shape.gltf", inside.to_string().into_bytes(), &[]),
        ("shape.gltf", beside.to_string().into_bytes(), &numbers),
        // Without an ending the contents tell.
        ("shape", stl_bytes(b""), &[]),
        ("shape", ply_bytes(false), &[]),
        ("shape", glb(&gltf(), &chunk()), &[]),
    ] {
        let found = rendered(name, &bytes, CLAY, others);
        assert_eq!(found.1, "", "{name}");
        assert!(found.0 == truth.0, "{name}");
    }
}

#[test]
fn a_name_of_another_format_is_remarked() {
    let truth = rendered("shape.obj", &obj(), CLAY, &[]);
    for (name, bytes, contents, by_name) in [
        ("shape.obj", stl_bytes(b""), "an STL", "an OBJ"),
        ("shape.stl", obj(), "an OBJ", "an STL"),
        ("shape.glb", ply_bytes(true), "a PLY", "a glTF"),
        ("shape.ply", glb(&gltf(), &chunk()), "a glTF", "a PLY"),
    ] {
        let found = rendered(name, &bytes, CLAY, &[]);
        assert!(found.0 == truth.0, "{name}");
        let sentence = format!(
            "remark: {name}: the contents are those of {contents}, the name that of {by_name}"
        );
        assert!(found.1.contains(&sentence), "{}", found.1);
    }
}

#[test]
fn a_mesh_of_any_format_can_be_given_by_the_command_line() {
    // A picture states its command, so that the files differ.
    let texels = |png: &[u8]| image::load_from_memory(png).unwrap();
    let truth = texels(&rendered("shape.obj", &obj(), CLAY, &[]).0);
    let bench = Bench::with_scene(&scene("lost.obj", CLAY));
    bench.write("shape.glb", glb(&gltf(), &chunk()));
    for (mesh, input) in [("shape=shape.glb", Vec::new()), ("shape=-", stl_bytes(b""))] {
        bench.make(&["scene.json", "--mesh", mesh, "-o", "a.png", "--size", "24x18"], &input);
        assert!(texels(&bench.read("a.png")) == truth, "{mesh}");
    }
}

/// Glass shows an inside only if the mesh is closed, that is if its corners are joined.
#[test]
fn equal_corners_of_an_stl_are_one() {
    let keys = r#", "material": "glass""#;
    let truth = rendered("shape.obj", &obj(), keys, &[]);
    assert!(rendered("shape.stl", &stl_bytes(b""), keys, &[]).0 == truth.0);
}

/// Nodes move, turn and mirror a mesh as the steps of a scene do.
#[test]
fn nodes_place_their_meshes() {
    let keys = r#", "material": "clay", "place": [ { "scale": [1, -0.5, 1] },
        { "rotate_deg": { "axis": [0, 0, 1], "angle": 90 } }, { "translate": [0.125, 0.25, 0] } ]"#;
    let truth = rendered("shape.obj", &obj(), keys, &[]);
    let half = 0.5_f64.sqrt();
    let mut nodes = gltf();
    nodes["nodes"] = json!([
        { "children": [1], "translation": [0.125, 0.25, 0.0], "rotation": [0.0, 0.0, half, half] },
        { "mesh": 0, "matrix": [1, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
    ]);
    let found = rendered("shape.glb", &glb(&nodes, &chunk()), CLAY, &[]).0;
    let [truth, found] =
        [truth.0, found].map(|png| image::load_from_memory(&png).unwrap().into_rgb8());
    // The square root of a half is rounded.
    for (a, b) in truth.iter().zip(found.iter()) {
        assert!(a.abs_diff(*b) <= 1, "{a} {b}");
    }
    assert!(truth.pixels().any(|pixel| pixel.0[0] > 100));
}

/// A square in the view, with texture coordinates of a picture whose first row is at v = 0.
fn square() -> (Value, Vec<u8>) {
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0_f32]];
    let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0_f32]];
    let mut bytes: Vec<u8> = corners.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend(uvs.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend([0, 1, 2, 0, 2, 3, 0, 0]);
    let json = json!({
        "asset": { "version": "2.0" }, "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0 } ] }],
        "materials": [{ "name": "shown", "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 }, "metallicFactor": 0, "roughnessFactor": 1 } }],
        "textures": [{ "source": 0 }],
        "images": [{ "bufferView": 3, "mimeType": "image/png" }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2" },
            { "bufferView": 2, "componentType": 5121, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 32 },
            { "buffer": 0, "byteOffset": 80, "byteLength": 6 },
        ],
        "buffers": [{ "byteLength": 88 }],
    });
    (json, bytes)
}

/// A picture of four colours: red and green above, blue and white below. Its texels are small beside the
/// quarters, so that no filter mixes colours in their middles.
fn four() -> Vec<u8> {
    let texel = |x, y| image::Rgb(FOUR[(x / 8 + 2 * (y / 8)) as usize]);
    encoded(RgbImage::from_fn(16, 16, texel), ImageFormat::Png)
}

/// Returns the colours in the middle of the four quarters, row by row.
fn quarters(name: &str, bytes: &[u8], others: &[(&str, Vec<u8>)]) -> ([[u8; 3]; 4], String) {
    let text = r#"{ "format": "tb-scene", "version": 1, "ambient": 1,
        "camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 },
        "objects": [ { "mesh": { "name": "square", "file": "NAME" } } ] }"#;
    let bench = Bench::with_scene(&text.replace("NAME", name));
    bench.write(name, bytes);
    for (name, bytes) in others {
        bench.write(name, bytes);
    }
    let run = bench.run(&["scene.json", "-o", "out.png", "--size", "16x16"], b"");
    let (code, said) = ending(&run);
    assert_eq!(code, Some(0), "{name}: {said}");
    let picture = image::load_from_memory(&bench.read("out.png")).unwrap().into_rgb8();
    ([[4, 4], [12, 4], [4, 12], [12, 12]].map(|[x, y]| picture.get_pixel(x, y).0), said)
}

const FOUR: [[u8; 3]; 4] = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]];

#[test]
fn the_picture_of_a_gltf_is_upright_wherever_it_lies() {
    let (mut json, mut bytes) = square();
    let picture = four();
    let view = json!({ "buffer": 0, "byteOffset": 88, "byteLength": picture.len() });
    json["bufferViews"].as_array_mut().unwrap().push(view);
    bytes.extend(&picture);
    assert_eq!(quarters("a.glb", &glb(&json, &bytes), &[]), (FOUR, String::new()));
    let (mut inside, bytes) = square();
    inside["images"][0] = json!({ "uri": data(&picture) });
    assert_eq!(quarters("a.glb", &glb(&inside, &bytes), &[]), (FOUR, String::new()));
    inside["images"][0] = json!({ "uri": "some%20colours.png" });
    let beside = [("some colours.png", picture)];
    assert_eq!(quarters("a.glb", &glb(&inside, &bytes), &beside), (FOUR, String::new()));
    // A transform that turns the picture by half a turn about its middle.
    inside["extensionsRequired"] = json!(["KHR_texture_transform"]);
    inside["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = json!({
        "KHR_texture_transform": { "offset": [1.0, 1.0], "rotation": std::f64::consts::PI } });
    let [a, b, c, d] = FOUR;
    assert_eq!(quarters("a.glb", &glb(&inside, &bytes), &beside), ([d, c, b, a], String::new()));
}

#[test]
fn a_base_color_is_linear_and_what_is_not_shown_is_named() {
    let (mut json, bytes) = square();
    json["materials"][0] = json!({
        "pbrMetallicRoughness": { "baseColorFactor": [1.0, 0.5, 0.0, 0.25] },
        "occlusionTexture": { "index": 0 }, "emissiveFactor": [1.0, 0.0, 0.0],
        "emissiveTexture": { "index": 0 } });
    json["images"][0] = json!({ "uri": "lost.png" });
    json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    json["nodes"][0]["skin"] = json!(0);
    json["skins"] = json!([{ "joints": [0] }]);
    let (found, said) = quarters("a.glb", &glb(&json, &bytes), &[]);
    // Half of the light has the code 188 in sRGB. The alpha counts only in a material that blends.
    assert_eq!(found, [[255, 188, 0]; 4]);
    let expected = "remark: a.glb: not used: emitted light with a picture, extension \
                    KHR_lights_punctual, metallic and roughness, occlusion textures, skins";
    assert!(said.contains(expected), "{said}");
}
