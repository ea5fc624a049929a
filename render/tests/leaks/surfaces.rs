//! The meshes: a tube along a lifted figure eight, a cube on a lattice, and needles.

use glam::DVec3;
use render::shape::mesh::{Mesh, NONE, Triangle};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Radius of the tube.
const RADIUS: f64 = 0.4;

/// A mesh of `rows` x `cols` corners, closed in both directions.
#[derive(Debug, Clone)]
pub struct Surface {
    pub mesh: Mesh,
    pub rows: u32,
    pub cols: u32,
}

/// Point of the figure eight at the angle `v`.
pub fn middle_line(v: f64) -> DVec3 {
    DVec3::new(3.0 * v.sin(), 3.0 * v.sin() * v.cos(), 0.6 * v.cos())
}

/// A mesh without texture coordinates and normals.
pub fn mesh(positions: Vec<DVec3>, triangles: impl Iterator<Item = [u32; 3]>) -> Mesh {
    let triangle = |position| Triangle { position, uv: [NONE; 3], normal: [NONE; 3], surface: 0 };
    Mesh {
        positions: positions.into_iter().map(|p| p.as_vec3().to_array()).collect(),
        triangles: triangles.map(triangle).collect(),
        surfaces: vec![String::new()],
        ..Mesh::default()
    }
}

/// Two triangles for each cell; the last row of corners is followed by the first, whose columns run
/// backwards if `mirrored`.
pub fn cells(rows: u32, cols: u32, mirrored: bool) -> impl Iterator<Item = [u32; 3]> {
    let at = move |row: u32, col: u32| {
        let col = if row == rows && mirrored { (cols - col % cols) % cols } else { col % cols };
        (row % rows) * cols + col
    };
    let cells = (0..rows).flat_map(move |row| (0..cols).map(move |col| (row, col)));
    cells.flat_map(move |(row, col)| {
        let [a, b, c, d] = [at(row, col), at(row + 1, col), at(row + 1, col + 1), at(row, col + 1)];
        [[a, b, c], [a, c, d]]
    })
}

/// The angles of all corners, along the rows and the columns.
pub fn angles(rows: u32, cols: u32) -> impl Iterator<Item = (f64, f64)> {
    let angle = |k: u32, of: u32| TAU * f64::from(k) / f64::from(of);
    (0..rows).flat_map(move |r| (0..cols).map(move |c| (angle(r, rows), angle(c, cols))))
}

/// A circle swept along the figure eight, moved by `shift`.
pub fn tube(rows: u32, cols: u32, shift: DVec3) -> Surface {
    let place = |(v, u): (f64, f64)| {
        let tangent = DVec3::new(3.0 * v.cos(), 3.0 * (2.0 * v).cos(), -0.6 * v.sin()).normalize();
        let side = tangent.cross(DVec3::Z).normalize();
        let up = side.cross(tangent);
        shift + middle_line(v) + RADIUS * (u.cos() * side + u.sin() * up)
    };
    let positions = angles(rows, cols).map(place).collect();
    Surface { mesh: mesh(positions, cells(rows, cols, false)), rows, cols }
}

/// The surface of a cube of `2 half` squares along each edge, with whole coordinates.
pub fn lattice_cube(half: i32) -> Mesh {
    let mut numbers: HashMap<[i32; 3], u32> = HashMap::new();
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [-half, half] {
            for (i, j) in (-half..half).flat_map(|i| (-half..half).map(move |j| (i, j))) {
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(di, dj)| {
                    let mut place = [side; 3];
                    place[(axis + 1) % 3] = i + di;
                    place[(axis + 2) % 3] = j + dj;
                    *numbers.entry(place).or_insert_with(|| {
                        positions.push(DVec3::from(place.map(f64::from)));
                        positions.len() as u32 - 1
                    })
                });
                let [a, b, c, d] = corners;
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    mesh(positions, triangles.into_iter())
}

/// A closed spindle of `sides` needles from pole to pole, 10 000 times as long as wide.
pub fn spindle(sides: u32) -> Mesh {
    let mut positions = vec![DVec3::new(0.0, 0.0, 1.0), DVec3::new(0.0, 0.0, -1.0)];
    positions.extend((0..sides).map(|k| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(sides)).sin_cos();
        DVec3::new(1e-4 * cos, 1e-4 * sin, 0.37 * cos)
    }));
    let needles = (0..sides).flat_map(move |k| {
        let [a, b] = [2 + k, 2 + (k + 1) % sides];
        [[0, a, b], [1, b, a]]
    });
    mesh(positions, needles)
}
