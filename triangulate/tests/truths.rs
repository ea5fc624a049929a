//! Shapes with known triangles.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::shapes;

use fixtures::rounding::UNIT;
use glam::DVec3;
use shapes::{cylinder, grid_of, sphere, torus};
use std::f64::consts::{PI, TAU};
use sweep::GridMesh;
use sweep::grid::{Across, Seam, UvLayout};
use triangulate::{Options, TriMesh, mesh, write_obj};

fn made(grid: &GridMesh) -> TriMesh {
    let mesh = mesh(grid, &Options::default()).unwrap();
    assert_eq!(mesh.validate(), Vec::<String>::new());
    mesh
}

fn corners(mesh: &TriMesh) -> impl Iterator<Item = [DVec3; 3]> {
    mesh.triangles.iter().map(|triangle| {
        triangle.position.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)))
    })
}

/// Returns the volume, the sum of signed tetrahedra from the origin. It is positive if faces point
/// outward.
fn volume(mesh: &TriMesh) -> f64 {
    corners(mesh).map(|[a, b, c]| a.dot(b.cross(c))).sum::<f64>() / 6.0
}

/// Returns the Euler number: vertices - edges + faces.
fn euler(mesh: &TriMesh) -> i64 {
    let mut edges = mesh.directed_edges();
    edges.iter_mut().for_each(|edge| edge.sort_unstable());
    edges.sort_unstable();
    edges.dedup();
    mesh.positions.len() as i64 - edges.len() as i64 + mesh.triangles.len() as i64
}

/// Returns the number of directed edges without an opposite directed edge.
fn rim(mesh: &TriMesh) -> usize {
    let mut edges = mesh.directed_edges();
    edges.sort_unstable();
    edges.iter().filter(|[a, b]| edges.binary_search(&[*b, *a]).is_err()).count()
}

/// Returns the smallest cosine of the angle between a triangle and the normals at its corners.
fn worst_normal(mesh: &TriMesh) -> f64 {
    let of_corners = mesh.triangles.iter().map(|triangle| {
        triangle.normal.map(|i| DVec3::from(mesh.normals[i as usize].map(f64::from)))
    });
    corners(mesh)
        .zip(of_corners)
        .map(|([a, b, c], normals)| {
            let face = (b - a).cross(c - a).normalize();
            normals.iter().map(|n| n.dot(face)).fold(1.0, f64::min)
        })
        .fold(1.0, f64::min)
}

#[test]
fn a_torus_is_closed_and_has_one_hole() {
    let mesh = made(&torus(60, 40));
    assert_eq!((mesh.positions.len(), mesh.uvs.len(), mesh.triangles.len()), (2400, 2501, 4800));
    assert_eq!((euler(&mesh), rim(&mesh)), (0, 0));
    let truth = 2.0 * PI * PI * 3.0;
    // Chords of a circle cut in n lose (2 pi / n)^2 / 6 of its area: 0.18 % around the axis, 0.41 % around the
    // tube.
    assert!((volume(&mesh) / truth - 1.0).abs() < 0.006, "{} against {truth}", volume(&mesh));
    assert!(worst_normal(&mesh) > 0.99);
}

#[test]
fn a_sphere_is_closed_and_each_pole_is_one_vertex() {
    let (rows, cols) = (48, 25);
    let mesh = made(&sphere(rows, cols));
    assert_eq!(mesh.positions.len(), rows * (cols - 2) + 2);
    assert_eq!(mesh.triangles.len(), rows * (2 * (cols - 1) - 2));
    assert_eq!((euler(&mesh), rim(&mesh)), (2, 0));
    // Chords of 7.5 degrees lose 0.29 % around the axis and 0.43 % from pole to pole.
    assert!((volume(&mesh) / (4.0 / 3.0 * PI) - 1.0).abs() < 0.0072);
    assert!(worst_normal(&mesh) > 0.99);
    // Columns without poles, including v = 1, and half a cell for each row at each pole.
    assert_eq!(mesh.uvs.len(), (rows + 1) * (cols - 2) + 2 * rows);
    // The poles have one normal each, for all rows.
    assert_eq!(mesh.normals.len(), mesh.positions.len());
}

#[test]
fn a_pole_takes_the_middle_of_its_share_of_the_picture() {
    let mesh = made(&sphere(8, 5));
    let mut at_pole: Vec<f32> = mesh.uvs.iter().filter(|uv| uv[0] == 0.0).map(|uv| uv[1]).collect();
    at_pole.sort_by(f32::total_cmp);
    assert_eq!(at_pole, [0.0625, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125, 0.9375]);
}

#[test]
fn the_tip_of_a_cone_takes_the_normal_between_its_neighbours() {
    let rows = 8;
    let cone = grid_of([rows, 3], [Seam::Closed, Seam::Open], |u, v| {
        let (sin, cos) = (TAU * v).sin_cos();
        (DVec3::new(u * cos, u * sin, -u), DVec3::new(cos, sin, 1.0))
    });
    let mesh = made(&cone);
    assert_eq!(mesh.positions.len(), 2 * rows + 1);
    let tips: Vec<[f32; 3]> = mesh
        .triangles
        .iter()
        .filter_map(|t| t.position.iter().position(|&p| p == 0).map(|corner| t.normal[corner]))
        .map(|normal| mesh.normals[normal as usize])
        .collect();
    assert_eq!(tips.len(), rows);
    for (row, tip) in tips.iter().enumerate() {
        let (sin, cos) = (TAU * (row as f64 + 0.5) / rows as f64).sin_cos();
        let middle = DVec3::new(cos, sin, 1.0).normalize();
        // The mean of two unit normals is slightly steeper than the cone.
        assert!(DVec3::from(tip.map(f64::from)).dot(middle) > 0.999);
        assert!((f64::from(tip[1]) * cos - f64::from(tip[0]) * sin).abs() < 1e-6);
    }
}

#[test]
fn a_row_drawn_together_is_a_pole_too() {
    let cone = grid_of([4, 6], [Seam::Open, Seam::Closed], |u, v| {
        let (sin, cos) = (TAU * u).sin_cos();
        (DVec3::new((1.0 - v) * cos, (1.0 - v) * sin, v), DVec3::new(cos, sin, 1.0))
    });
    let mesh = made(&cone);
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (3 * 6 + 1, 5 * 6));
    assert_eq!((euler(&mesh), rim(&mesh)), (1, 6));
    let mut at_tip: Vec<f32> = mesh.uvs.iter().filter(|uv| uv[1] == 1.0).map(|uv| uv[0]).collect();
    at_tip.sort_by(f32::total_cmp);
    assert_eq!(at_tip, [1.0, 3.0, 5.0, 7.0, 9.0, 11.0].map(|twelfth: f32| twelfth / 12.0));
}

#[test]
fn a_cylinder_has_two_rims_and_its_picture_goes_once_around() {
    let mesh = made(&cylinder(5, 32));
    assert_eq!((euler(&mesh), rim(&mesh)), (0, 64));
    assert_eq!((mesh.positions.len(), mesh.uvs.len()), (5 * 32, 5 * 33));
    // The normals of a column are equal, so the file lists them once.
    assert_eq!(mesh.normals.len(), 32);
    for [x, y, _] in &mesh.positions {
        assert!((x.hypot(*y) - 1.0).abs() < UNIT);
    }
    let area: f64 = corners(&mesh).map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum();
    let truth = 2.0 * 32.0 * 2.0 * (PI / 32.0).sin();
    // Rounding moves the ends of a side of 0.196 by 3e-8 in each direction.
    assert!((area / truth - 1.0).abs() < 5e-7, "{area} against {truth}");
    // No triangle spans more than one cell of the picture, even at the seam.
    for triangle in &mesh.triangles {
        let s = triangle.uv.map(|i| mesh.uvs[i as usize][0]);
        let width = s.iter().fold(0.0, |w: f32, a| s.iter().fold(w, |w, b| w.max(a - b)));
        assert_eq!(width, 1.0 / 32.0);
    }
}

#[test]
fn a_turned_and_repeated_picture_stays_whole_at_the_seams() {
    let mut grid = torus(16, 8);
    grid.uv = UvLayout { across: Across::Trajectory, repeat: [3.0, 2.0], ..UvLayout::default() };
    let mesh = made(&grid);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.uv.map(|i| mesh.uvs[i as usize].map(f64::from));
        // Half a cell of the picture, with the winding of the triangle: not mirrored.
        let area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0;
        assert!((area - 0.5 * (3.0 / 16.0) * (2.0 / 8.0)).abs() < 1e-6, "{area}");
    }
    let highest = mesh.uvs.iter().fold([0.0_f32; 2], |m, t| [m[0].max(t[0]), m[1].max(t[1])]);
    assert_eq!(highest, [3.0, 2.0]);
}

#[test]
fn a_crease_has_one_vertex_and_two_normals() {
    // A square prism: each corner of the contour is two columns.
    let corner = |i: usize| [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]][i % 4];
    let mut prism = grid_of([3, 8], [Seam::Open, Seam::Closed], |u, v| {
        let col = (u * 8.0).round() as usize;
        let [x, y] = corner(col / 2);
        // The first column of a corner has the normal of the side before it, the second that of the
        // side after it.
        let [p, q] = [corner((col + 7) / 2 % 4), corner(col.div_ceil(2))];
        (DVec3::new(x, y, v), DVec3::new(p[0] + q[0], p[1] + q[1], 0.0))
    });
    prism.u = vec![0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75];
    let mesh = made(&prism);
    // Each side has one normal for all rows. The side across the seam has its normal listed at both
    // ends.
    assert_eq!((mesh.positions.len(), mesh.normals.len()), (3 * 4, 4 + 1));
    assert_eq!(mesh.uvs.len(), 3 * 5);
    assert_eq!(mesh.triangles.len(), 2 * 4 * 2);
    assert_eq!((euler(&mesh), rim(&mesh)), (0, 8));
    assert!(worst_normal(&mesh) > 1.0 - 1e-12);
}

#[test]
fn a_cell_with_three_corners_on_a_line_is_cut_so_that_nothing_is_lost() {
    let mut sheet = grid_of([2, 2], [Seam::Open; 2], |u, v| (DVec3::new(u, v, 0.0), DVec3::Z));
    sheet.positions[1] = DVec3::new(1.0, 0.0, 0.0);
    sheet.positions[3] = DVec3::new(2.0, 0.0, 0.0);
    sheet.positions[2] = DVec3::new(0.0, 3.0, 0.0);
    let mesh = made(&sheet);
    assert_eq!(mesh.triangles.len(), 2);
}

#[test]
fn a_line_instead_of_a_surface_gives_no_triangles() {
    let line = grid_of([3, 3], [Seam::Open; 2], |u, v| (DVec3::X * (u + v), DVec3::Z));
    let mut obj = Vec::new();
    let counts = write_obj(&line, &Options::default(), &mut obj).unwrap();
    assert_eq!((counts.triangles, counts.slivers + counts.collapsed), (0, 8));
}

/// The two sides of a thin twisted plate are cut along the same lines, so that the plate keeps its volume.
#[test]
fn a_thin_twisted_plate_keeps_its_volume() {
    for (rows, cols) in [(60, 4), (30, 12), (100, 4)] {
        let text = format!(
            r#"{{"format": "tb-sweep", "version": 1, "name": "plate",
            "contour": {{"polyline": {{"closed": true, "points": [[5,-0.1],[5,0.1],[-5,0.1],[-5,-0.1]]}}}},
            "trajectory": {{"line": [[0, 0, 0], [0, 0, 50]]}}, "twist": {{"total": 360}},
            "caps": {{"start": "flat", "end": "flat"}}, "mesh": {{"rows": {rows}, "cols": {cols}}}}}"#
        );
        let document = files::json::Document::new("plate.json", text.as_bytes()).unwrap();
        let mesh = mesh(&sweep::Sweep::read(&document).unwrap().grid(), &Options::default());
        let mesh = mesh.unwrap();
        let volume: f64 = mesh
            .triangles
            .iter()
            .map(|triangle| {
                let corner = |i: usize| {
                    DVec3::from(mesh.positions[triangle.position[i] as usize].map(f64::from))
                };
                corner(0).dot(corner(1).cross(corner(2))) / 6.0
            })
            .sum();
        assert!((volume - 100.0).abs() < 1.0, "{rows} x {cols}: {volume}");
    }
}
