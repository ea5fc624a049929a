//! STL and PLY, read back by small independent readers.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::shapes;

use fixtures::rounding::NORMAL;
use glam::DVec3;
use shapes::{cylinder, sphere, torus};
use std::collections::HashSet;
use std::f64::consts::PI;
use sweep::GridMesh;
use triangulate::{Options, TriMesh, mesh, write_ply, write_stl};

/// The rest of a file, from which numbers are read.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> &'a [u8] {
        let (taken, rest) = self.0.split_at(count);
        self.0 = rest;
        taken
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take(4).try_into().unwrap())
    }

    fn f32s<const N: usize>(&mut self) -> [f32; N] {
        [(); N].map(|()| f32::from_le_bytes(self.take(4).try_into().unwrap()))
    }

    /// Reads a line of text, without its end.
    fn line(&mut self) -> &'a str {
        let end = self.0.iter().position(|&byte| byte == b'\n').unwrap();
        std::str::from_utf8(&self.take(end + 1)[..end]).unwrap()
    }
}

/// A triangle of an STL: its normal and its corners.
type Facet = ([f32; 3], [[f32; 3]; 3]);

fn read_stl(file: &[u8]) -> (String, Vec<Facet>) {
    let mut bytes = Bytes(file);
    let header = std::str::from_utf8(bytes.take(80)).unwrap().trim_end_matches('\0').into();
    let count = bytes.u32();
    let facet = |_| {
        let facet = (bytes.f32s(), [(); 3].map(|()| bytes.f32s()));
        assert_eq!(bytes.take(2), [0; 2]);
        facet
    };
    let facets = (0..count).map(facet).collect();
    assert!(bytes.0.is_empty(), "{} bytes too many", bytes.0.len());
    (header, facets)
}

/// A PLY with float properties for vertices and one list for faces.
#[derive(Default)]
struct Ply {
    comments: Vec<String>,
    properties: Vec<String>,
    vertices: Vec<[f32; 8]>,
    faces: Vec<[u32; 3]>,
}

fn read_ply(file: &[u8]) -> Ply {
    let mut bytes = Bytes(file);
    let (mut ply, mut counts) = (Ply::default(), [0; 2]);
    assert_eq!((bytes.line(), bytes.line()), ("ply", "format binary_little_endian 1.0"));
    loop {
        let line = bytes.line();
        match line.split(' ').collect::<Vec<_>>()[..] {
            ["end_header"] => break,
            ["comment", ..] => ply.comments.push(line["comment ".len()..].into()),
            ["element", "vertex", count] => counts[0] = count.parse().unwrap(),
            ["element", "face", count] => counts[1] = count.parse().unwrap(),
            ["property", "float", name] => ply.properties.push(name.into()),
            ["property", "list", "uchar", "uint", "vertex_indices"] => {}
            _ => panic!("{line}"),
        }
    }
    ply.vertices = (0..counts[0]).map(|_| bytes.f32s()).collect();
    let face = |_| {
        assert_eq!(bytes.take(1), [3]);
        [(); 3].map(|()| bytes.u32())
    };
    ply.faces = (0..counts[1]).map(face).collect();
    assert!(bytes.0.is_empty(), "{} bytes too many", bytes.0.len());
    ply
}

fn made(grid: &GridMesh) -> TriMesh {
    mesh(grid, &Options { texture: Some(2), surface: Some(5) }).unwrap()
}

fn stl_of(mesh: &TriMesh) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_stl(mesh, &mut bytes).unwrap();
    bytes
}

fn ply_of(mesh: &TriMesh) -> Ply {
    let mut bytes = Vec::new();
    write_ply(mesh, &mut bytes).unwrap();
    read_ply(&bytes)
}

fn volume(triangles: impl Iterator<Item = [[f32; 3]; 3]>) -> f64 {
    let six_fold = |corners: [[f32; 3]; 3]| {
        let [a, b, c] = corners.map(|point| DVec3::from(point.map(f64::from)));
        a.dot(b.cross(c))
    };
    triangles.map(six_fold).sum::<f64>() / 6.0
}

#[test]
fn an_stl_has_the_volume_of_its_shape_and_unit_normals_that_face_out() {
    for (grid, count, truth) in [
        (torus(120, 80), 2 * 120 * 80, 2.0 * PI * PI * 3.0),
        (sphere(120, 61), 120 * (2 * 60 - 2), 4.0 / 3.0 * PI),
    ] {
        let bytes = stl_of(&made(&grid));
        assert_eq!(bytes.len(), 84 + 50 * count);
        let (header, facets) = read_stl(&bytes);
        assert_eq!(header, "topobook triangulate STL 1 shape");
        assert_eq!(facets.len(), count);
        // Chords of 3 to 6 degrees lie within 0.3 % of the surface, in each of two directions.
        let found = volume(facets.iter().map(|facet| facet.1));
        assert!(found < truth && found > 0.995 * truth, "{found} against {truth}");
        for (normal, corners) in facets {
            let [n, a, b, c] = [normal, corners[0], corners[1], corners[2]]
                .map(|point| DVec3::from(point.map(f64::from)));
            assert!((n.length() - 1.0).abs() < NORMAL);
            assert!((b - a).cross(c - a).normalize().dot(n) > 1.0 - 1e-6);
        }
    }
}

#[test]
fn an_stl_has_the_triangles_of_the_mesh_in_their_order() {
    let mesh = made(&cylinder(4, 7));
    let (_, facets) = read_stl(&stl_of(&mesh));
    let expected = mesh.triangles.iter().map(|t| t.position.map(|i| mesh.positions[i as usize]));
    assert!(facets.iter().map(|facet| facet.1).eq(expected));
}

#[test]
fn a_ply_says_what_its_vertices_are() {
    let ply = ply_of(&made(&torus(5, 4)));
    assert_eq!(ply.comments[1..], ["object shape", "texture 2 surface 5"]);
    assert_eq!(ply.properties, ["x", "y", "z", "nx", "ny", "nz", "s", "t"]);
}

#[test]
fn a_ply_has_every_corner_of_the_mesh_with_its_normal_and_its_place_on_the_picture() {
    for grid in [torus(9, 8), sphere(12, 9), cylinder(3, 10)] {
        let mesh = made(&grid);
        let ply = ply_of(&mesh);
        assert_eq!(ply.faces.len(), mesh.triangles.len());
        for (triangle, face) in mesh.triangles.iter().zip(&ply.faces) {
            for (corner, &vertex) in face.iter().enumerate() {
                let [x, y, z] = mesh.positions[triangle.position[corner] as usize];
                let [nx, ny, nz] = mesh.normals[triangle.normal[corner] as usize];
                let [s, t] = mesh.uvs[triangle.uv[corner] as usize];
                assert_eq!(ply.vertices[vertex as usize], [x, y, z, nx, ny, nz, s, t]);
            }
        }
        let bits = |vertex: &[f32; 8]| vertex.map(f32::to_bits);
        let different: HashSet<[u32; 8]> = ply.vertices.iter().map(bits).collect();
        assert_eq!(different.len(), ply.vertices.len(), "no vertex is there twice");
    }
}

#[test]
fn a_ply_is_split_along_seams_and_at_poles_and_nowhere_else() {
    // There is one more row and column for the far edges of the picture.
    assert_eq!(ply_of(&made(&torus(9, 8))).vertices.len(), 10 * 9);
    assert_eq!(ply_of(&made(&cylinder(3, 10))).vertices.len(), 3 * 11);
    // A pole has one vertex for each of its triangles.
    assert_eq!(ply_of(&made(&sphere(12, 9))).vertices.len(), 13 * 7 + 2 * 12);
}

#[test]
fn a_mesh_without_triangles_is_a_file_too() {
    let empty = TriMesh::default();
    assert_eq!(stl_of(&empty).len(), 84);
    let ply = ply_of(&empty);
    assert!(ply.vertices.is_empty() && ply.faces.is_empty());
}
