//! Meshes in memory equal those read back from files, by this project's reader and by an
//! independent one.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::shapes;

use glam::{DVec3, Vec3};
use proptest::prelude::*;
use shapes::{cylinder, grid_of, torus};
use sweep::GridMesh;
use sweep::grid::file::{Encoding, GridReader, write};
use sweep::grid::{Across, Seam, UvLayout};
use triangulate::{Options, TriMesh, mesh, write_obj};

fn obj_of(grid: &GridMesh, options: &Options) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_obj(grid, options, &mut bytes).unwrap();
    bytes
}

/// The bits of position, picture coordinates and normal of each corner of each triangle.
fn corner_bits(mesh: &TriMesh) -> Vec<[u32; 8]> {
    let of_one = |position: u32, uv: u32, normal: u32| {
        let [x, y, z] = mesh.positions[position as usize];
        let [s, t] = mesh.uvs[uv as usize];
        let [l, m, n] = mesh.normals[normal as usize];
        [x, y, z, s, t, l, m, n].map(f32::to_bits)
    };
    let of_three =
        |t: &triangulate::Triangle| [0, 1, 2].map(|i| of_one(t.position[i], t.uv[i], t.normal[i]));
    mesh.triangles.iter().flat_map(of_three).collect()
}

/// Returns these bits as an independent reader of OBJ finds them.
fn corner_bits_by_tobj(obj: &[u8]) -> Vec<[u32; 8]> {
    let no_materials = |_: &std::path::Path| tobj::load_mtl_buf(&mut &b""[..]);
    let (models, _) =
        tobj::load_obj_buf(&mut &*obj, &tobj::LoadOptions::default(), no_materials).unwrap();
    assert!(models.len() <= 1, "one object");
    let mut bits = Vec::new();
    for tobj::Model { mesh, .. } in &models {
        let indices = mesh.indices.iter().zip(&mesh.texcoord_indices).zip(&mesh.normal_indices);
        for ((&p, &t), &n) in indices {
            let (p, t, n) = (3 * p as usize, 2 * t as usize, 3 * n as usize);
            let (p, t, n) =
                (&mesh.positions[p..p + 3], &mesh.texcoords[t..t + 2], &mesh.normals[n..n + 3]);
            bits.push([p[0], p[1], p[2], t[0], t[1], n[0], n[1], n[2]].map(f32::to_bits));
        }
    }
    bits
}

#[test]
fn what_f32_cannot_hold_is_refused() {
    for wild in [1e300, f64::NAN] {
        let mut grid = torus(3, 3);
        grid.positions[4].y = wild;
        let message = mesh(&grid, &Options::default()).unwrap_err().to_string();
        assert!(message.starts_with("shape: row 2, column 2: found the position"), "{message}");
        assert!(message.len() < 200, "{message}");
    }
    let mut grid = torus(3, 3);
    grid.positions.pop();
    let message = mesh(&grid, &Options::default()).unwrap_err().to_string();
    assert_eq!(message, "shape: found a grid with 8 positions and 9 normals, expected 9 of each");
}

#[test]
fn an_obj_says_what_it_is_and_that_it_is_whole() {
    let mut grid = cylinder(2, 3);
    grid.name = "a tube".into();
    let text =
        String::from_utf8(obj_of(&grid, &Options { texture: Some(2), surface: Some(7) })).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[..3], ["# topobook triangulate OBJ 1", "o a_tube", "usemtl tex2_surf7"]);
    assert_eq!(lines.last(), Some(&"# end 6 6"));
    assert!(text.ends_with('\n'));
    let count = |keyword| lines.iter().filter(|line| line.starts_with(keyword)).count();
    assert_eq!((count("v "), count("vt "), count("vn "), count("f ")), (6, 8, 3, 6));
}

#[test]
fn a_cut_grid_gives_an_obj_without_its_end() {
    let mut bytes = Vec::new();
    write(&torus(5, 5), Encoding::Binary, &mut bytes).unwrap();
    bytes.truncate(bytes.len() - 1);
    let mut obj = Vec::new();
    let mut reader = GridReader::open("a", bytes.as_slice()).unwrap();
    let error = write_obj(&mut reader, &Options::default(), &mut obj).unwrap_err();
    assert!(error.to_string().contains("cut short"), "{error}");
    assert!(!String::from_utf8(obj).unwrap().contains("# end"));
}

/// Draws numbers whose decimals are hardest for f32.
fn nasty() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::sample::select(vec![
            0.0,
            -0.0,
            1e-45,
            -1e-45,
            1.2e-38,
            3e38,
            0.1,
            1e-300,
            16_777_217.0
        ]),
        any::<u32>()
            .prop_map(|bits| f64::from(f32::from_bits(bits)))
            .prop_filter("finite", |x| x.is_finite()),
        // There are few values, so that points coincide.
        (-1..=1).prop_map(f64::from),
        (-1..=1).prop_map(f64::from),
        -1.0..1.0,
    ]
}

fn any_grid() -> impl Strategy<Value = GridMesh> {
    let seam = || prop::sample::select(vec![Seam::Open, Seam::Closed]);
    (3_usize..6, 3_usize..6).prop_flat_map(move |shape| {
        let points = shape.0 * shape.1;
        let layout = (prop::bool::ANY, 0.001..1000.0, 0.001..1000.0);
        let all_positions = prop::collection::vec(prop::array::uniform3(nasty()), points);
        let all_normals = prop::collection::vec(prop::array::uniform3(-1.0..1.0_f32), points);
        (seam(), seam(), layout, all_positions, all_normals).prop_map(
            move |(seam_u, seam_v, (turned, across, up), positions, normals)| {
                let mut grid =
                    grid_of([shape.0, shape.1], [seam_v, seam_u], |_, _| (DVec3::X, DVec3::X));
                let across_what = if turned { Across::Trajectory } else { Across::Contour };
                grid.uv =
                    UvLayout { across: across_what, repeat: [across, up], ..UvLayout::default() };
                grid.positions = positions.into_iter().map(DVec3::from_array).collect();
                grid.normals = normals.into_iter().map(Vec3::from_array).collect();
                grid
            },
        )
    })
}

proptest! {
    #[test]
    fn file_and_memory_give_the_same_mesh_to_the_bit(grid in any_grid()) {
        let options = Options { texture: Some(3), surface: Some(1) };
        let obj = obj_of(&grid, &options);
        for encoding in [Encoding::Binary, Encoding::Json] {
            let mut file = Vec::new();
            write(&grid, encoding, &mut file).unwrap();
            let mut piped = Vec::new();
            let mut reader = GridReader::open("a", file.as_slice()).unwrap();
            write_obj(&mut reader, &options, &mut piped).unwrap();
            prop_assert!(piped == obj, "the OBJ differs through {encoding:?}");
        }
        let mesh = mesh(&grid, &options).unwrap();
        prop_assert_eq!(corner_bits(&mesh), corner_bits_by_tobj(&obj));
        let text = String::from_utf8(obj).unwrap();
        prop_assert!(!text.contains("-0 ") && !text.contains("-0\n"));
        let end = format!("# end {} {}\n", mesh.positions.len(), mesh.triangles.len());
        prop_assert!(text.ends_with(&end));
        // For any points, each triangle has an area and each index is valid.
        let complaints = mesh.validate().join("\n");
        prop_assert!(!complaints.contains("area") && !complaints.contains("less than"));
    }
}
