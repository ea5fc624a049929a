//! A mesh of `triangulate` in each of its formats is read by `render` as the same mesh.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::input::Disk;
use glam::{DVec3, Vec3};
use render::scene::mesh_file::{self, Near};
use render::scene::obj::ObjFile;
use std::path::Path;
use sweep::GridMesh;
use sweep::grid::{Seam, UvLayout};
use triangulate::{Options, TriMesh, write_glb, write_obj, write_ply, write_stl};

fn read(name: &str, bytes: &[u8]) -> ObjFile {
    let reserve = &mut |_| Ok(());
    let near = Near { folder: Path::new(""), source: &Disk, reserve };
    mesh_file::read(name, bytes, near).unwrap_or_else(|error| panic!("{error}"))
}

/// A tube that is closed around, with picture coordinates and normals.
fn tube(rows: usize, cols: usize) -> GridMesh {
    let v: Vec<f64> = (0..rows).map(|i| i as f64 / (rows - 1) as f64).collect();
    let u: Vec<f64> = (0..cols).map(|j| j as f64 / cols as f64).collect();
    let outward = |u: f64| {
        let (sin, cos) = (std::f64::consts::TAU * u).sin_cos();
        DVec3::new(cos, 0.0, -sin)
    };
    let points = || v.iter().flat_map(|&v| u.iter().map(move |&u| (u, v)));
    GridMesh {
        name: "tube".into(),
        seam_u: Seam::Closed,
        seam_v: Seam::Open,
        uv: UvLayout::default(),
        positions: points().map(|(u, v)| outward(u) + 3.0 * v * DVec3::Y).collect(),
        normals: points().map(|(u, _)| outward(u).as_vec3()).collect::<Vec<Vec3>>(),
        u: u.clone(),
        v: v.clone(),
        ..GridMesh::default()
    }
}

/// Returns the surface, and of each corner position, normal and texture coordinates, for all triangles.
fn parts(read: &ObjFile) -> Vec<(String, [[f32; 8]; 3])> {
    let mesh = &read.mesh;
    let triangle = |triangle: &render::shape::mesh::Triangle| {
        let corner = |k: usize| {
            let [x, y, z] = mesh.positions[triangle.position[k] as usize];
            let [nx, ny, nz] = mesh.normals[triangle.normal[k] as usize];
            let [s, t] = mesh.uvs[triangle.uv[k] as usize];
            [x, y, z, nx, ny, nz, s, t]
        };
        (mesh.surfaces[triangle.surface as usize].clone(), [0, 1, 2].map(corner))
    };
    mesh.triangles.iter().map(triangle).collect()
}

#[test]
fn a_mesh_of_triangulate_is_the_same_in_every_format() {
    let options = Options { texture: Some(2), surface: Some(5) };
    let grid = tube(4, 7);
    let mesh: TriMesh = triangulate::mesh(&grid, &options).unwrap();
    let (mut obj, mut ply, mut glb, mut stl) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    write_obj(&grid, &options, &mut obj).unwrap();
    write_ply(&mesh, &mut ply).unwrap();
    write_glb(&mesh, None, &mut glb).unwrap();
    write_stl(&mesh, &mut stl).unwrap();
    let truth = parts(&read("a.obj", &obj));
    assert_eq!((truth.len(), truth[0].0.as_str()), (2 * 3 * 7, "tex2_surf5"));
    assert_eq!(parts(&read("a.ply", &ply)), truth);
    let found = parts(&read("a.glb", &glb));
    assert_eq!(found.len(), truth.len());
    for ((name, corners), (true_name, true_corners)) in found.iter().zip(&truth) {
        assert_eq!(name, true_name);
        for (found, truth) in corners.as_flattened().iter().zip(true_corners.as_flattened()) {
            // Normals are normalized again, and coordinates up become coordinates down: two roundings.
            assert!((found - truth).abs() < 3e-7, "{found} {truth}");
        }
    }
    let stl = read("a.stl", &stl).mesh;
    let corners: Vec<[[f32; 3]; 3]> =
        (0..stl.triangles.len() as u32).map(|k| stl.corners(k)).collect();
    let expected = truth.iter().map(|(_, corners)| corners.map(|[x, y, z, ..]| [x, y, z]));
    assert!(corners.into_iter().eq(expected));
    // Seven corners in each of four rows.
    assert_eq!(stl.positions.len(), 4 * 7);
}
