//! A Klein bottle, and a floor below a mesh.

use crate::leaks::surfaces::{Surface, angles, cells, mesh};
use glam::DVec3;
use render::shape::mesh::{Mesh, Triangle};

/// The Klein bottle whose contour is a figure eight that makes half a turn.
pub fn klein(rows: u32, cols: u32) -> Surface {
    let place = |(v, u): (f64, f64)| {
        let (sin, cos) = (0.5 * v).sin_cos();
        let out = 2.2 + cos * u.sin() - sin * (2.0 * u).sin();
        DVec3::new(out * v.cos(), out * v.sin(), sin * u.sin() + cos * (2.0 * u).sin())
    };
    let positions = angles(rows, cols).map(place).collect();
    Surface { mesh: mesh(positions, cells(rows, cols, true)), rows, cols }
}

/// Adds a floor of two triangles, 60 x 60, just below the mesh.
pub fn with_floor(mut mesh: Mesh) -> Mesh {
    let low = mesh.positions.iter().fold(f32::INFINITY, |low, p| low.min(p[2])) - 0.05;
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([[-30., -30., low], [30., -30., low], [30., 30., low], [-30., 30., low]]);
    for position in [[0, 1, 2], [0, 2, 3]] {
        let position = position.map(|k| first + k);
        mesh.triangles.push(Triangle { position, ..mesh.triangles[0] });
    }
    mesh
}
