//! GLB and 3MF, read back by small readers and, where it is installed, by trimesh.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::shapes;

use fixtures::program::{run, said};
use glam::DVec3;
use serde_json::Value;
use shapes::{cylinder, klein_bottle, sphere, torus};
use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;
use std::process::Command;
use sweep::GridMesh;
use sweep::grid::file::{Encoding, write_all};
use triangulate::{Options, TriMesh, Unit, mesh, write_3mf, write_glb};

fn made(grid: &GridMesh) -> TriMesh {
    mesh(grid, &Options { texture: Some(2), surface: Some(5) }).unwrap()
}

fn glb_of(mesh: &TriMesh, unit: Option<Unit>) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_glb(mesh, unit, &mut bytes).unwrap();
    bytes
}

fn threemf_of(mesh: &TriMesh, unit: Unit) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_3mf(mesh, unit, &mut bytes).unwrap();
    bytes
}

/// Splits a GLB into its JSON and its numbers.
fn parts(glb: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
    let (json, start) = (word(12), 20 + word(12));
    assert_eq!(
        (&glb[16..20], json % 4, &glb[start + 4..start + 8]),
        (&b"JSON"[..], 0, &b"BIN\0"[..])
    );
    assert_eq!(start + 8 + word(start), glb.len());
    (serde_json::from_slice(&glb[20..start]).unwrap(), &glb[start + 8..])
}

/// Returns the rows of an accessor of `f32`.
fn rows<const N: usize>(json: &Value, numbers: &[u8], accessor: usize) -> Vec<[f32; N]> {
    let accessor = &json["accessors"][accessor];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    let length = view["byteLength"].as_u64().unwrap() as usize;
    let four = numbers[start..start + length].as_chunks::<4>().0;
    let floats: Vec<f32> = four.iter().map(|four| f32::from_le_bytes(*four)).collect();
    assert_eq!(floats.len() / N, accessor["count"].as_u64().unwrap() as usize);
    floats.as_chunks::<N>().0.to_vec()
}

#[test]
fn a_glb_has_every_corner_of_the_mesh() {
    for grid in [torus(9, 8), sphere(12, 9), cylinder(3, 10)] {
        let mesh = made(&grid);
        let glb = glb_of(&mesh, None);
        let (json, numbers) = parts(&glb);
        let (positions, normals) = (rows::<3>(&json, numbers, 0), rows::<3>(&json, numbers, 1));
        let uvs = rows::<2>(&json, numbers, 2);
        let indices = numbers[32 * positions.len()..].as_chunks::<4>().0;
        assert_eq!(indices.len(), 3 * mesh.triangles.len());
        let corners = mesh.triangles.iter().flat_map(|t| [0, 1, 2].map(|k| (t, k)));
        for ((triangle, k), index) in corners.zip(indices) {
            let index = u32::from_le_bytes(*index) as usize;
            assert_eq!(positions[index], mesh.positions[triangle.position[k] as usize]);
            assert_eq!(normals[index], mesh.normals[triangle.normal[k] as usize]);
            let [s, t] = mesh.uvs[triangle.uv[k] as usize];
            // Two roundings to `f32`, each at most 6e-8 of a number below 2.
            assert!(uvs[index][0] == s && (uvs[index][1] - (1.0 - t)).abs() < 3e-7);
        }
        assert_eq!(json["materials"][0]["name"], "tex2_surf5");
        for (key, k) in [("min", 0), ("max", 1)] {
            let bound = |axis: usize| {
                let all = positions.iter().map(|position| position[axis]);
                all.fold(positions[0][axis], [f32::min, f32::max][k])
            };
            let stated: [f32; 3] =
                serde_json::from_value(json["accessors"][0][key].clone()).unwrap();
            assert_eq!(stated, [0, 1, 2].map(bound));
        }
    }
}

#[test]
fn a_glb_is_in_meters() {
    let mesh = made(&torus(5, 4));
    for (unit, scale) in [
        (None, Value::Null),
        (Some(Unit::Meter), Value::Null),
        (Some(Unit::Inch), serde_json::json!([0.0254, 0.0254, 0.0254])),
    ] {
        let glb = glb_of(&mesh, unit);
        assert_eq!(parts(&glb).0["nodes"][0]["scale"], scale);
    }
}

/// Returns the text of the model in a 3MF.
fn model(bytes: &[u8]) -> String {
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
    let names: Vec<String> = archive.file_names().map(Into::into).collect();
    assert_eq!(names, ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]);
    let mut text = String::new();
    archive.by_name("3D/3dmodel.model").unwrap().read_to_string(&mut text).unwrap();
    text
}

/// Returns the numbers of all elements of a name, in the order of their attributes.
fn elements<const N: usize>(text: &str, name: &str) -> Vec<[f64; N]> {
    let start = format!("<{name} ");
    let lines = text.lines().filter(|line| line.starts_with(&start));
    let numbers = |line: &str| {
        let all: Vec<f64> =
            line.split('"').skip(1).step_by(2).map(|x| x.parse().unwrap()).collect();
        <[f64; N]>::try_from(all).unwrap()
    };
    lines.map(numbers).collect()
}

fn volume(corners: impl Iterator<Item = [DVec3; 3]>) -> f64 {
    corners.map(|[a, b, c]| a.dot(b.cross(c))).sum::<f64>() / 6.0
}

#[test]
fn a_3mf_has_the_triangles_of_the_mesh_and_its_unit() {
    for (grid, kind) in
        [(torus(9, 8), "model"), (sphere(12, 9), "model"), (cylinder(3, 10), "surface")]
    {
        let mesh = made(&grid);
        let text = model(&threemf_of(&mesh, Unit::Centimeter));
        assert!(text.contains("<model unit=\"centimeter\""), "{text}");
        assert!(text.contains(&format!("type=\"{kind}\"")), "{text}");
        let vertices = elements::<3>(&text, "vertex");
        let triangles = elements::<3>(&text, "triangle");
        let expected =
            mesh.triangles.iter().map(|t| t.position.map(|i| mesh.positions[i as usize]));
        let found = triangles.iter().map(|t| t.map(|i| vertices[i as usize].map(|x| x as f32)));
        assert!(found.eq(expected));
    }
}

#[test]
fn a_closed_surface_with_one_side_is_no_solid() {
    let text = model(&threemf_of(&made(&klein_bottle(24, 16)), Unit::Meter));
    assert!(text.contains("type=\"surface\""));
}

#[test]
fn the_same_mesh_gives_the_same_bytes() {
    let mesh = made(&sphere(12, 9));
    assert!(threemf_of(&mesh, Unit::Inch) == threemf_of(&mesh, Unit::Inch));
    assert!(glb_of(&mesh, None) == glb_of(&mesh, None));
    // An entry states the first time that a ZIP can: 1980-01-01.
    let bytes = threemf_of(&mesh, Unit::Inch);
    assert_eq!(bytes[10..14], [0, 0, 0x21, 0]);
}

#[test]
fn a_mesh_without_triangles_is_a_file_too() {
    let glb = glb_of(&TriMesh::default(), None);
    assert!(glb.starts_with(b"glTF") && glb.ends_with(b"} ") || glb.ends_with(b"}"));
    assert!(
        model(&threemf_of(&TriMesh::default(), Unit::Meter)).contains("<vertices>\n</vertices>")
    );
}

#[test]
fn the_program_writes_both_and_refuses_a_unit_that_no_file_states() {
    let folder = tempfile::tempdir().unwrap();
    let mut grid = Vec::new();
    write_all(&[torus(9, 8)], Encoding::Binary, &mut grid).unwrap();
    let run = |arguments: &[&str]| {
        run(env!("CARGO_BIN_EXE_triangulate").as_ref(), arguments, folder.path(), &grid)
    };
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    let ids = ["--texture", "2", "--surface", "5"];
    let mesh = made(&torus(9, 8));
    for (name, unit, expected) in [
        ("a.glb", &[][..], glb_of(&mesh, None)),
        ("a.3mf", &[], threemf_of(&mesh, Unit::Millimeter)),
        ("b.3mf", &["--unit", "foot"], threemf_of(&mesh, Unit::Foot)),
    ] {
        let ended = run(&[&["-o", name], unit, &ids].concat());
        assert_eq!((ended.status.code(), said(&ended).as_str()), (Some(0), ""), "{name}");
        assert!(read(name) == expected, "{name}");
    }
    let refused = run(&["-o", "a.stl", "--unit", "inch"]);
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(said(&refused), "triangulate: --unit is for 3MF and GLB, and the format is STL\n");
}

#[test]
fn the_unit_of_the_spec_is_that_of_the_file_unless_the_command_line_states_another() {
    let folder = tempfile::tempdir().unwrap();
    let grid = GridMesh { unit: Some(sweep::grid::Unit::Cm), ..torus(9, 8) };
    let mesh = made(&torus(9, 8));
    let mut bytes = Vec::new();
    write_all(&[grid], Encoding::Binary, &mut bytes).unwrap();
    for (name, unit, expected) in [
        ("a.glb", &[][..], glb_of(&mesh, Some(Unit::Centimeter))),
        ("a.3mf", &[], threemf_of(&mesh, Unit::Centimeter)),
        ("b.3mf", &["--unit", "foot"], threemf_of(&mesh, Unit::Foot)),
    ] {
        let arguments = [&["-o", name, "--texture", "2", "--surface", "5"], unit].concat();
        let program = env!("CARGO_BIN_EXE_triangulate").as_ref();
        let ended = run(program, &arguments, folder.path(), &bytes);
        assert_eq!(ended.status.code(), Some(0), "{}", said(&ended));
        assert!(fs::read(folder.path().join(name)).unwrap() == expected, "{name}");
    }
}

/// A program of Python that prints for each file whether trimesh finds it watertight, and its volume.
const TRIMESH: &str = "
import sys, trimesh
for name in sys.argv[1:]:
    scene = trimesh.load_scene(name)
    mesh = scene.to_mesh()
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    print(mesh.is_watertight, mesh.is_winding_consistent, repr(float(mesh.volume)), scene.units)
";

/// Skipped, with a word on standard error, where Python or its packages trimesh, networkx and lxml are
/// not installed.
#[test]
fn another_program_opens_both_and_finds_the_same_closed_volume() {
    let python = std::env::var("TOPOBOOK_PYTHON").unwrap_or_else(|_| "python3".into());
    let probe = Command::new(&python).args(["-c", "import trimesh, networkx, lxml"]).output();
    if !probe.is_ok_and(|probe| probe.status.success()) {
        eprintln!("skipped: {python} with trimesh, networkx and lxml is not installed");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    for grid in [torus(30, 20), sphere(24, 13)] {
        let mesh = made(&grid);
        fs::write(folder.path().join("a.glb"), glb_of(&mesh, Some(Unit::Meter))).unwrap();
        fs::write(folder.path().join("a.3mf"), threemf_of(&mesh, Unit::Inch)).unwrap();
        let truth = volume(mesh.triangles.iter().map(|triangle| {
            triangle.position.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)))
        }));
        let said = opened(&python, folder.path(), &["a.glb", "a.3mf"]);
        let lines: Vec<Vec<&str>> = said.lines().map(|line| line.split(' ').collect()).collect();
        assert_eq!(lines.len(), 2, "{said}");
        for (line, unit) in lines.iter().zip(["meters", "inch"]) {
            assert_eq!((line[0], line[1]), ("True", "True"), "{said}");
            let found: f64 = line[2].parse().unwrap();
            // A decimal of a 3MF gives its `f32` back, and differs by half a unit in the last place.
            assert!((found - truth).abs() < 2e-7 * truth, "{found} against {truth}");
            assert!(line[3].starts_with(unit), "{said}");
        }
    }
}

fn opened(python: &str, folder: &Path, names: &[&str]) -> String {
    let run = Command::new(python)
        .args(["-c", TRIMESH])
        .args(names)
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    String::from_utf8(run.stdout).unwrap()
}
