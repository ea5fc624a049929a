//! Mesh files that are broken: one sentence with the line or the byte.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench::Bench;
use crate::formats::glb;
use serde_json::json;

/// Refuses `bytes` as the file of a mesh, with a sentence that has all parts.
fn refuse(name: &str, bytes: &[u8], parts: &[&str]) {
    let scene = r#"{ "format": "tb-scene", "version": 1,
        "camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 }, "materials": { "m": {} },
        "objects": [ { "mesh": { "name": "mesh", "file": "NAME", "material": "m" } } ] }"#;
    let bench = Bench::with_scene(&scene.replace("NAME", name));
    bench.write(name, bytes);
    bench.refuse(&["scene.json"], b"", 3, parts);
}

fn header(count: u32) -> Vec<u8> {
    [&[b' '; 80][..], &count.to_le_bytes()].concat()
}

#[test]
fn a_broken_stl_is_refused_with_its_byte_or_line() {
    let one = [header(1), vec![0; 50]].concat();
    let two = [header(2), vec![0; 50]].concat();
    let ends =
        ["a.stl: at byte 134: found the end of the file", "expected 184 bytes for the 2 facets"];
    refuse("a.stl", &two, &ends);
    refuse("a.stl", b"short", &["a.stl: at byte 5: found the end of the file", "expected an STL"]);
    refuse("a.stl", &header(0), &["a.stl: found no triangles"]);
    let mut bad = one;
    bad[84 + 12 + 4..84 + 12 + 8].copy_from_slice(&f32::NAN.to_le_bytes());
    refuse("a.stl", &bad, &["a.stl: at byte 100: found NaN, expected three finite numbers"]);
    for (text, parts) in [
        (
            "solid\nfacet\nvertex 0 0\n",
            ["a.stl:3: found `vertex 0 0`", "`vertex` and three finite"],
        ),
        ("solid\nfacet\nvertex 0 0 inf\n", ["a.stl:3: found `vertex 0 0 inf`", "three finite"]),
        (
            "solid\nfacet\nvertex 0 0 1\nendloop",
            ["a.stl:4: found `endloop` after 1 vertices", "of three"],
        ),
        (
            "solid\nfacet\nvertex 0 0 1\n",
            ["a.stl:3: found the end of the file", "expected `endloop`"],
        ),
    ] {
        refuse("a.stl", text.as_bytes(), &parts);
    }
}

#[test]
fn a_broken_ply_is_refused_with_its_byte_or_line() {
    const START: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let body = |text: &str| format!("{START}{text}").into_bytes();
    for (text, parts) in [
        ("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ["a.ply:13: found vertex 3", "expected 0 to 2"]),
        ("0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", ["a.ply:13: found vertex -1", "expected 0 to 2"]),
        ("0 0 0\n1 0 0\n0 1 0\n3 0 1\n", ["a.ply:14: found the end of the file", "1 times `face`"]),
        (
            "0 0 0\n1 x 0\n",
            ["a.ply:11: found `x`", "expected 3 times `vertex`, as the header says"],
        ),
        (
            "0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n",
            ["a.ply: found vertex 2 at (0.0, 1.0, NaN)", "a face uses it"],
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
            ["a.ply: found 3 vertices and no faces", "a mesh with faces"],
        ),
    ] {
        refuse("a.ply", &body(text), &parts);
    }
    let cut = START.replace("ascii", "binary_big_endian").into_bytes();
    let at = cut.len() + 10;
    let cut = [cut, vec![0; 10]].concat();
    refuse("a.ply", &cut, &[&format!("a.ply: at byte {at}: found the end of the file")]);
    for (text, parts) in [
        (
            "ply\nformat text 1.0\n",
            ["a.ply:2: found `format text 1.0`", "expected `format ascii 1.0`"],
        ),
        (
            "ply\nelement vertex 3\nend_header\n",
            ["a.ply:3: found `end_header`", "`format` before it"],
        ),
        (
            "ply\nformat ascii 1.0\n",
            ["a.ply:3: found the end of the file", "expected `end_header`"],
        ),
        ("ply\nproperty float x\n", ["a.ply:2: found `property float x`", "an `element` before"]),
        (
            "ply\nformat ascii 1.0\nelement vertex 9\nend_header\n",
            ["a.ply:4: found `end_header`", "properties of each element"],
        ),
    ] {
        refuse("a.ply", text.as_bytes(), &parts);
    }
    refuse("a.ply", b"nonsense", &["a.ply: found `nonsense` as the first characters", "`ply`"]);
}

#[test]
fn a_broken_gltf_is_refused_with_its_byte_or_json_path() {
    let whole = json!({
        "asset": { "version": "2.0" }, "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }], "buffers": [{ "byteLength": 36 }],
    });
    let corners: Vec<u8> =
        [0., 0., 0., 1., 0., 0., 0., 1., 0.0_f32].iter().flat_map(|x| x.to_le_bytes()).collect();
    let with = |path: &str, value: serde_json::Value| {
        let mut json = whole.clone();
        *json.pointer_mut(path).unwrap() = value;
        glb(&json, &corners)
    };
    for (path, value, parts) in [
        (
            "/accessors/0/count",
            json!(4),
            ["a.glb: found 4 rows at `accessors[0]`", "as many as fit"],
        ),
        (
            "/bufferViews/0/byteLength",
            json!(40),
            ["found 40 bytes from byte 0 on", "`bufferViews[0]`"],
        ),
        (
            "/nodes/0/mesh",
            json!(1),
            ["a.glb: found an index at `nodes[0].mesh`", "that the file has"],
        ),
        ("/nodes/0", json!({ "mesh": 0, "children": [0] }), ["found no triangles", "of triangles"]),
        (
            "/asset/version",
            json!("3.1"),
            ["found version `3.1` at `asset.version`", "expected 2.0"],
        ),
    ] {
        let parts: Vec<&str> = std::iter::once("a.glb: found").chain(parts).collect();
        refuse("a.glb", &with(path, value), &parts);
    }
    // Rows without a view cost nothing in the file.
    let mut huge = whole.clone();
    huge["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(1);
    let rows = json!({ "componentType": 5126, "count": 1_000_000_000, "type": "VEC3" });
    huge["accessors"].as_array_mut().unwrap().push(rows);
    let parts = [
        "a.glb: found 1000000000 rows of NORMAL at `meshes[0].primitives[0]`",
        "expected 3, as of POSITION",
    ];
    refuse("a.glb", &glb(&huge, &corners), &parts);
    let mut compressed = whole.clone();
    compressed["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let parts = ["a.glb: found the required extension `KHR_draco_mesh_compression`, "];
    refuse("a.glb", &glb(&compressed, &corners), &parts);
    let bytes = glb(&whole, &corners);
    let at = format!("a.glb: at byte {}: found the end of the file", bytes.len() - 1);
    refuse("a.glb", &bytes[..bytes.len() - 1], &[&at, "the file is cut off"]);
    refuse(
        "a.glb",
        &[&bytes[..4], &[1, 0, 0, 0], &bytes[8..]].concat(),
        &["a.glb: at byte 4: found version 1"],
    );
    refuse("a.gltf", b"{ \"asset\": 3 }", &["a.gltf: found a fault of the JSON at line 1"]);
    refuse("a.gltf", b"nonsense", &["a.gltf: found `nonsense` as the first characters"]);
}

#[test]
fn other_formats_are_named() {
    for (bytes, found) in [
        (&b"PK\x03\x04rest"[..], "a ZIP archive, such as a 3MF"),
        (b"Kaydara FBX Binary  ", "an FBX file"),
        (b"<?xml version='1.0'?>", "an XML file"),
        (b"OFF\n3 1 0\n", "an OFF mesh"),
    ] {
        let found = format!("a.mesh: found {found}, expected an OBJ, STL, PLY or glTF mesh");
        refuse("a.mesh", bytes, &[&found]);
    }
}
