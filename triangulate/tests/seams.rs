//! Surfaces whose last row joins the first one shifted or mirrored: tori, Klein bottles and Moebius
//! bands.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::made;
use crate::shapes;

use glam::DVec3;
use made::{made, walked_twice};
use shapes::{grid_of, klein_bottle, moebius_band, torus};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use sweep::GridMesh;
use sweep::grid::Seam;
use triangulate::TriMesh;

/// Returns two normals for each position that has more than one.
fn two_sided(mesh: &TriMesh) -> Vec<[DVec3; 2]> {
    let mut sides: HashMap<u32, Vec<[f32; 3]>> = HashMap::new();
    for triangle in &mesh.triangles {
        for (position, normal) in triangle.position.iter().zip(triangle.normal) {
            let (known, normal) =
                (sides.entry(*position).or_default(), mesh.normals[normal as usize]);
            if !known.contains(&normal) {
                known.push(normal);
            }
        }
    }
    let vector = |n: [f32; 3]| DVec3::from(n.map(f64::from));
    sides.values().filter(|n| n.len() > 1).map(|n| [vector(n[0]), vector(n[1])]).collect()
}

/// Returns the smallest cosine of the angle between a triangle and the normals at its corners.
fn worst_normal(mesh: &TriMesh) -> f64 {
    let vector = |n: [f32; 3]| DVec3::from(n.map(f64::from));
    let of_one = |triangle: &triangulate::Triangle| {
        let [a, b, c] = triangle.position.map(|i| vector(mesh.positions[i as usize]));
        let face = (b - a).cross(c - a).normalize();
        triangle.normal.map(|i| vector(mesh.normals[i as usize]).dot(face))
    };
    mesh.triangles.iter().flat_map(of_one).fold(1.0, f64::min)
}

#[test]
fn a_klein_bottle_is_closed_and_one_sided() {
    for (rows, cols) in [(48, 64), (31, 33)] {
        let (mesh, counts, report) = made(&klein_bottle(rows, cols));
        assert_eq!((report.vertices, report.faces), (rows * cols, 2 * rows * cols));
        assert_eq!((report.euler, report.boundary_loops), (0, 0));
        assert!(report.closed && report.manifold && !report.orientable && !report.oriented);
        assert_eq!((counts.collapsed, counts.slivers), (0, 0));
        assert_eq!(walked_twice(&mesh), cols);
        // The triangles of a coarse mesh are tilted against its normals where it bends; a flipped
        // triangle would give -1.
        assert!(worst_normal(&mesh) > 0.8, "{}", worst_normal(&mesh));
        // The first row has the normals of both sides, and no other row does.
        let sides = two_sided(&mesh);
        assert_eq!(sides.len(), cols);
        assert!(sides.iter().all(|[one, other]| *one == -*other));
        assert_eq!(mesh.normals.len(), (rows + 1) * cols);
        assert_eq!(mesh.uvs.len(), (rows + 1) * (cols + 1));
    }
}

#[test]
fn a_moebius_band_is_one_sided_with_one_rim() {
    for (rows, cols) in [(40, 5), (31, 2)] {
        let (mesh, counts, report) = made(&moebius_band(rows, cols));
        assert_eq!((report.vertices, report.faces), (rows * cols, 2 * rows * (cols - 1)));
        assert_eq!((report.euler, report.boundary_loops), (0, 1));
        assert!(!report.closed && report.manifold && !report.orientable);
        assert_eq!((counts.collapsed, counts.slivers), (0, 0));
        assert_eq!(walked_twice(&mesh), cols - 1);
        assert!(worst_normal(&mesh) > 0.9, "{}", worst_normal(&mesh));
        assert_eq!(two_sided(&mesh).len(), cols);
    }
}

#[test]
fn the_picture_runs_on_over_a_mirrored_seam() {
    let (rows, cols) = (24, 12);
    let (mesh, ..) = made(&klein_bottle(rows, cols));
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.uv.map(|i| mesh.uvs[i as usize].map(f64::from));
        // Half a cell of the picture, not mirrored.
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        assert!((area * (2 * rows * cols) as f64 - 1.0).abs() < 1e-4, "{area}");
    }
}

/// Returns a ring-shaped tube whose section rotates by one `sides`th of a turn along the ring. With
/// `creased`, the section is a polygon whose corners are two columns each.
fn turning(rows: usize, sides: usize, creased: bool) -> GridMesh {
    let cols = if creased { 2 * sides } else { 4 * sides };
    let mut ring = grid_of([rows, cols], [Seam::Closed; 2], |u, v| {
        let col = (u * cols as f64).round() as usize;
        let corner = if creased { col / 2 } else { col } as f64;
        let corners = if creased { sides } else { cols } as f64;
        let turn = v / sides as f64;
        let (sin, cos) = (TAU * (corner / corners + turn)).sin_cos();
        // The normals at a corner are those of the sides before and after it.
        let half = if creased { (col % 2) as f64 - 0.5 } else { 0.0 };
        let (n_sin, n_cos) = (TAU * ((corner + half) / corners + turn)).sin_cos();
        let (b_sin, b_cos) = (TAU * v).sin_cos();
        let on = |x: f64, y: f64| DVec3::new(x * b_cos, x * b_sin, -y);
        (on(3.0 + cos, sin), on(n_cos, n_sin))
    });
    if creased {
        ring.u = (0..cols).map(|col| (col / 2) as f64 / sides as f64).collect();
    }
    ring.shift = cols / sides;
    ring
}

#[test]
fn a_torus_whose_section_comes_back_turned_is_whole() {
    let (rows, sides) = (40, 5);
    let grid = turning(rows, sides, false);
    let (mesh, counts, report) = made(&grid);
    assert_eq!(mesh.validate(), Vec::<String>::new());
    assert_eq!((report.euler, report.boundary_loops), (0, 0));
    assert!(report.closed && report.orientable && report.oriented && report.manifold);
    assert_eq!((counts.collapsed, counts.slivers, mesh.normals.len()), (0, 0, rows * 4 * sides));
    // No edge is longer than the diagonal of a cell, so no cell spans the tube.
    let cell = (TAU * 4.0 / rows as f64).hypot(TAU * (1.0 / 20.0 + 1.0 / 200.0));
    assert!(report.edge_length.unwrap().max < cell);
    assert!(worst_normal(&mesh) > 0.95);
    // Without the shift, cells span the tube.
    let (_, _, straight) = made(&GridMesh { shift: 0, ..grid });
    assert!(straight.edge_length.unwrap().max > 1.0);
}

#[test]
fn creases_come_out_right_over_a_shifted_seam() {
    let (rows, sides) = (60, 4);
    let (mesh, counts, report) = made(&turning(rows, sides, true));
    assert_eq!((report.vertices, report.faces), (rows * sides, 2 * rows * sides));
    assert_eq!((counts.collapsed, counts.slivers), ((2 * rows * sides) as u64, 0));
    assert_eq!((report.euler, report.oriented, report.manifold), (0, true, true));
    // A side is twisted, so that its triangles are slightly tilted against the normals of the flat
    // section.
    assert!(worst_normal(&mesh) > 0.95, "{}", worst_normal(&mesh));
    assert_eq!(two_sided(&mesh).len(), rows * sides);
}

#[test]
fn creases_come_out_right_over_a_mirrored_seam() {
    // The section is a bow tie with two columns at each corner. Half a turn maps it to itself, in
    // reverse order.
    let (rows, cols) = (160, 8);
    let corner = |i: usize| [[1.0, 0.5], [1.0, -0.5], [-1.0, 0.5], [-1.0, -0.5]][i % 4];
    let mut bottle = grid_of([rows, cols], [Seam::Mirror, Seam::Closed], |u, v| {
        let col = (u * cols as f64).round() as usize;
        let (sin, cos) = (PI * v).sin_cos();
        let (b_sin, b_cos) = (TAU * v).sin_cos();
        let turned = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
        let on = |[x, y]: [f64; 2]| DVec3::new(x * b_cos, x * b_sin, -y);
        let [x, y] = turned(corner(col / 2));
        // The sides before and after the corner. A side's normal points to its right.
        let [from, to] = [corner((col + 7) / 2), corner(col.div_ceil(2))];
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        (on([6.0 + x, y]), on(turned([dy, -dx])))
    });
    bottle.u = (0..cols).map(|col| (col / 2) as f64 / 4.0).collect();
    bottle.shift = 7;
    let (mesh, counts, report) = made(&bottle);
    assert_eq!((report.vertices, report.faces), (rows * 4, 2 * rows * 4));
    assert_eq!((report.euler, report.boundary_loops), (0, 0));
    assert_eq!((counts.collapsed, counts.slivers), ((2 * rows * 4) as u64, 0));
    assert!(report.closed && report.manifold && !report.orientable);
    assert_eq!(walked_twice(&mesh), 4);
    assert!(worst_normal(&mesh) > 0.9, "{}", worst_normal(&mesh));
}

#[test]
fn a_torus_closed_as_it_is_stays_as_it_was() {
    let (mesh, _, report) = made(&torus(9, 8));
    assert_eq!((walked_twice(&mesh), two_sided(&mesh).len(), report.euler), (0, 0, 0));
}
