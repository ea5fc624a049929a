//! OBJ files of other tools: the parts that are read, and the materials of their libraries.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench;

use bench::{Bench, checks};
use glam::DVec3;
use proptest::prelude::*;
use render::scene::obj;
use render::shape::mesh::NONE;
use std::collections::HashMap;

/// A triangle by the values of its corners: positions, texture coordinates, normals; and its
/// surface.
type Seen = (Vec<[f32; 3]>, Vec<[f32; 2]>, Vec<[f32; 3]>, String);

fn ours(text: &str) -> Vec<Seen> {
    let mesh = obj::read("a.obj", text.as_bytes()).unwrap();
    let seen = |number: u32| {
        let triangle = &mesh.triangles[number as usize];
        let there = |index: &u32| *index != NONE;
        let uvs = triangle.uv.iter().filter(|i| there(i)).map(|&i| mesh.uvs[i as usize]).collect();
        let normals = triangle.normal.iter().filter(|i| there(i));
        let normals = normals.map(|&i| mesh.normals[i as usize]).collect();
        let name = mesh.surfaces[triangle.surface as usize].clone();
        let places = mesh.places(number).map(|place| place.as_vec3().to_array());
        (places.to_vec(), uvs, normals, name)
    };
    (0..mesh.triangles.len() as u32).map(seen).collect()
}

/// Reads the triangles with `tobj`, with every name that the text uses declared.
fn theirs(text: &str, names: &[&str]) -> Vec<Seen> {
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    let text = format!("mtllib names\n{text}");
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| {
        let material =
            |name: &&str| tobj::Material { name: (*name).into(), ..tobj::Material::default() };
        let indices = names.iter().enumerate().map(|(k, name)| ((*name).to_string(), k));
        Ok((names.iter().map(material).collect(), indices.collect::<HashMap<_, _>>()))
    })
    .unwrap();
    let mut seen = Vec::new();
    for tobj::Model { mesh, .. } in models {
        let name = mesh.material_id.map_or("", |k| names[k]);
        for k in 0..mesh.indices.len() / 3 {
            let of = |indices: &[u32]| {
                indices
                    .get(3 * k..3 * k + 3)
                    .unwrap_or_default()
                    .iter()
                    .map(|&i| i as usize)
                    .collect()
            };
            let three = |values: &[f32], indices: Vec<usize>| -> Vec<[f32; 3]> {
                indices.into_iter().map(|i| [0, 1, 2].map(|j| values[3 * i + j])).collect()
            };
            let uvs: Vec<usize> = of(&mesh.texcoord_indices);
            seen.push((
                three(&mesh.positions, of(&mesh.indices)),
                uvs.into_iter().map(|i| [0, 1].map(|j| mesh.texcoords[2 * i + j])).collect(),
                three(&mesh.normals, of(&mesh.normal_indices)),
                name.to_string(),
            ));
        }
    }
    seen
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Faces of three and four corners of every kind, counted from the start and from the end.
    #[test]
    fn what_tobj_reads_is_read(
        points in prop::collection::vec(prop::array::uniform3(-1e3..1e3f32), 4..12),
        uvs in prop::collection::vec(prop::array::uniform2(-4.0..4.0f32), 1..9),
        normals in prop::collection::vec(prop::array::uniform3(-1.0..1.0f32), 1..9),
        runs in prop::collection::vec((0..4usize, 0..4u8, prop::collection::vec(
            (any::<bool>(), prop::array::uniform4(0..1000usize), any::<bool>()), 1..5)), 1..6),
    ) {
        const NAMES: [&str; 4] = ["wood", "tex2_surf0", "a b", "glass.001"];
        let mut text = String::new();
        points.iter().for_each(|[x, y, z]| text.push_str(&format!("v {x} {y} {z}\n")));
        uvs.iter().for_each(|[s, t]| text.push_str(&format!("vt  {s}\t{t}\n")));
        normals.iter().for_each(|[x, y, z]| text.push_str(&format!("vn {x} {y} {z}\r\n")));
        for (name, kind, faces) in runs {
            text.push_str(&format!("# a run\nusemtl {}\n", NAMES[name]));
            for (quad, corners, back) in faces {
                text.push('f');
                let place = |j: usize| {
                    let point = points[(corners[j] + 7 * j) % points.len()];
                    DVec3::from(point.map(f64::from))
                };
                // tobj divides along the first diagonal, and ours along one inside.
                let [a, b, c, d] = [0, 1, 2, 3].map(place);
                let is_inside = (b - a).cross(c - a).dot((c - a).cross(d - a)) >= 0.0;
                let count = if quad && is_inside { 4 } else { 3 };
                for (j, corner) in corners.into_iter().take(count).enumerate() {
                    let index = |count: usize, turn: usize| {
                        let index = (corner + turn) % count;
                        if back { index as i64 - count as i64 } else { index as i64 + 1 }
                    };
                    let v = index(points.len(), 7 * j);
                    let (vt, vn) = (index(uvs.len(), j), index(normals.len(), 2 * j));
                    text.push_str(&match kind {
                        0 => format!(" {v}"),
                        1 => format!(" {v}/{vt}"),
                        2 => format!(" {v}//{vn}"),
                        _ => format!(" {v}/{vt}/{vn}"),
                    });
                }
                text.push('\n');
            }
        }
        let (ours, mut theirs) = (ours(&text), theirs(&text, &NAMES));
        // tobj fills in the values of other corners where a corner has no texture coordinates or
        // normal.
        for (ours, theirs) in ours.iter().zip(&mut theirs) {
            if ours.1.is_empty() {
                theirs.1.clear();
            }
            if ours.2.is_empty() {
                theirs.2.clear();
            }
        }
        prop_assert_eq!(ours, theirs);
    }
}

/// A wall of two halves with different materials, lit by ambient light and from the front.
const HALVES: &str = "mtllib halves.mtl\nv -2 -2 0\nv 0 -2 0\nv 2 -2 0\nv 2 2 0\nv 0 2 0\nv -2 2 0\n\
    vt 0 0\nvt 3 0\nvt 3 3\nvt 0 3\nusemtl brass\nf 1 2 5 6\nusemtl net\nf 2/1 3/2 4/3 5/4\n";

/// Returns a scene with the halves, these keys on their mesh, and these further keys.
fn halves(keys: &str, more: &str) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, {more}
        "camera": {{ "eye": [0, 0, 1.5], "target": [0, 0, 0], "fov_deg": 90 }}, "ambient": 0.25,
        "lights": [ {{ "point": {{ "position": [1, 2, 3] }} }} ],
        "objects": [ {{ "mesh": {{ "name": "halves", "file": "halves.obj", {keys} }} }} ] }}"#
    )
}

#[test]
fn a_library_is_what_it_says_in_the_scenes_own_words() {
    let bench = Bench::with_scene(&halves(r#""mtl": "lib/halves.mtl""#, ""));
    std::fs::create_dir(bench.path("lib")).unwrap();
    bench.write("halves.obj", HALVES);
    bench.write("lib/checks.png", checks());
    let library = "newmtl net\nmap_Kd checks.png\nKd 0.5 1 1\nnewmtl brass\nKd 0.75 0.5 0.25\n\
                   Ks 0.5 0.5 0.5\nNs 20\nd 0.75\nnewmtl unused\n";
    bench.write("lib/halves.mtl", library);
    let own = r#""textures": { "t": { "image": "lib/checks.png" } },
        "materials": { "net": { "color": [0.5, 1, 1], "diffuse": 1 },
          "brass": { "color": [0.75, 0.5, 0.25], "ambient": 0.75, "diffuse": 0.75, "specular": 0.5,
                     "shininess": 20, "transparency": 0.25, "index_of_refraction": 1 } },"#;
    let bound = r#""materials": { "net": "net", "brass": "brass" }, "textures": { "net": "t" }"#;
    bench.write("own.json", halves(bound, own));
    bench.make(&["scene.json", "-o", "library.png", "--size", "24x16"], b"");
    // The remark that the library of the OBJ is not used is left out.
    bench.make(&["own.json", "-q", "-o", "own.png", "--size", "24x16"], b"");
    let pixels = |name: &str| image::load_from_memory(&bench.read(name)).unwrap();
    assert_eq!(pixels("library.png"), pixels("own.png"));
    // The scene's own bindings take precedence over the library, and the library over `material`.
    let mixed = r#""mtl": "lib/halves.mtl", "materials": { "brass": "brass" }, "material": "gold""#;
    bench.write(
        "mixed.json",
        halves(mixed, &own.replace("\"materials\": {", "\"materials\": { \"gold\": {},")),
    );
    bench.make(&["mixed.json", "-o", "mixed.png", "--size", "24x16"], b"");
    assert_eq!(pixels("mixed.png"), pixels("own.png"));
}
