//! Grids of shapes with known points and normals.

#![allow(dead_code, reason = "not every test uses every shape")]

use glam::DVec3;
use std::f64::consts::{PI, TAU};
use sweep::GridMesh;
use sweep::grid::Seam;

/// Returns the grid of a surface that is given by point and normal at `(u, v)`, evenly spaced.
pub fn grid_of(
    [rows, cols]: [usize; 2],
    [seam_v, seam_u]: [Seam; 2],
    surface: impl Fn(f64, f64) -> (DVec3, DVec3),
) -> GridMesh {
    let even = |count: usize, seam: Seam| -> Vec<f64> {
        let last = if seam.joins() { count } else { count - 1 };
        (0..count).map(|i| i as f64 / last as f64).collect()
    };
    let (v, u) = (even(rows, seam_v), even(cols, seam_u));
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for &v in &v {
        for &u in &u {
            let (position, normal) = surface(u, v);
            positions.push(position);
            normals.push(normal.normalize().as_vec3());
        }
    }
    let name = "shape".into();
    let shift = if seam_v == Seam::Mirror && seam_u == Seam::Open { cols - 1 } else { 0 };
    GridMesh { name, seam_u, seam_v, shift, u, v, positions, normals, ..GridMesh::default() }
}

/// Returns a torus with radii 3 and 1. `u` goes around the tube, `v` around the hole.
pub fn torus(rows: usize, cols: usize) -> GridMesh {
    grid_of([rows, cols], [Seam::Closed; 2], |u, v| {
        let ((a_sin, a_cos), (b_sin, b_cos)) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
        // Counter-clockwise around the tube as seen along the trajectory, so that S_u x S_v points
        // outward.
        let normal = DVec3::new(a_cos * b_cos, a_cos * b_sin, -a_sin);
        (3.0 * DVec3::new(b_cos, b_sin, 0.0) + normal, normal)
    })
}

/// Returns a sphere of radius 1: a half circle from pole to pole, rotated.
pub fn sphere(rows: usize, cols: usize) -> GridMesh {
    grid_of([rows, cols], [Seam::Closed, Seam::Open], |u, v| {
        // From the upper pole to the lower one, so that S_u x S_v points outward.
        let (height, radius) = if u == 0.0 || u == 1.0 {
            (1.0 - 2.0 * u, 0.0)
        } else {
            ((PI * u).cos(), (PI * u).sin())
        };
        let (b_sin, b_cos) = (TAU * v).sin_cos();
        let normal = DVec3::new(radius * b_cos, radius * b_sin, height);
        (normal, normal)
    })
}

/// Returns a cylinder of radius 1 and height 2, with rows going upward.
pub fn cylinder(rows: usize, cols: usize) -> GridMesh {
    grid_of([rows, cols], [Seam::Open, Seam::Closed], |u, v| {
        let (sin, cos) = (TAU * u).sin_cos();
        (DVec3::new(cos, sin, 2.0 * v), DVec3::new(cos, sin, 0.0))
    })
}

/// Returns the Klein bottle made of a figure of eight that makes half a turn while it goes around
/// an axis. It crosses itself along a circle of radius 3.
pub fn klein_bottle(rows: usize, cols: usize) -> GridMesh {
    grid_of([rows, cols], [Seam::Mirror, Seam::Closed], |u, v| {
        let (a, b) = (TAU * u, TAU * v);
        let (sin, cos) = (0.5 * b).sin_cos();
        // The figure of eight (sin a, sin 2a) in a plane, rotated by b/2, and its derivatives.
        let turned = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
        let around = |[r, z]: [f64; 2], b: f64| DVec3::new(r * b.cos(), r * b.sin(), z);
        let (eight, along) = ([a.sin(), (2.0 * a).sin()], [a.cos(), 2.0 * (2.0 * a).cos()]);
        let [r, z] = turned(eight[0], eight[1]);
        let s_u = around(turned(along[0], along[1]), b);
        let s_v = around([-0.5 * z, 0.5 * r], b) + (3.0 + r) * DVec3::new(-b.sin(), b.cos(), 0.0);
        (around([3.0 + r, z], b), s_u.cross(s_v))
    })
}

/// Returns the Moebius band made of a line of length 2 that makes half a turn while it goes around
/// an axis, at radius 3.
pub fn moebius_band(rows: usize, cols: usize) -> GridMesh {
    grid_of([rows, cols], [Seam::Mirror, Seam::Open], |u, v| {
        let (w, b) = (2.0 * u - 1.0, TAU * v);
        let (sin, cos) = (0.5 * b).sin_cos();
        let around = |[r, z]: [f64; 2]| DVec3::new(r * b.cos(), r * b.sin(), z);
        let s_v = around([-0.5 * w * sin, 0.5 * w * cos])
            + (3.0 + w * cos) * DVec3::new(-b.sin(), b.cos(), 0.0);
        (around([3.0 + w * cos, w * sin]), around([cos, sin]).cross(s_v))
    })
}
