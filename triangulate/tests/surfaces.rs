//! Surfaces with known topology, and their reports.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::shapes;

use glam::DVec3;
use shapes::{cylinder, grid_of, sphere, torus};
use std::f64::consts::{PI, TAU};
use sweep::GridMesh;
use sweep::grid::Seam;
use sweep::grid::file::{Encoding, GridReader, write};
use triangulate::{Counts, MeshReport, Options, Patches, Topology, TriMesh, Triangle};

/// Returns the report of a grid's mesh, after the grid was written and read back.
fn report(grid: &GridMesh) -> MeshReport {
    let mut file = Vec::new();
    write(grid, Encoding::Binary, &mut file).unwrap();
    let mut reader = GridReader::open("a", file.as_slice()).unwrap();
    let (mesh, counts) = reader.run(&Options::default(), TriMesh::default()).unwrap();
    MeshReport::of(&mesh, &counts)
}

/// Returns a strip of `rows` x `cols` vertices whose last row joins the first one in reverse order:
/// with `closed` columns a Klein bottle, otherwise a Moebius band.
fn one_sided(rows: usize, cols: usize, closed: bool) -> TriMesh {
    let number = |row: usize, col: usize| {
        let col = if closed { col % cols } else { col };
        let col = if row < rows { col } else { (2 * cols - 1 - col) % cols };
        (row % rows * cols + col) as u32
    };
    let mut mesh = TriMesh::default();
    for row in 0..rows {
        for col in 0..cols {
            // The positions do not matter, as long as no two are equal.
            mesh.positions.push([row as f32, col as f32, 0.0]);
        }
        for col in 0..cols - usize::from(!closed) {
            let [a, b, c, d] = [(row, col), (row, col + 1), (row + 1, col + 1), (row + 1, col)]
                .map(|(row, col)| number(row, col));
            for position in [[a, b, c], [a, c, d]] {
                mesh.triangles.push(Triangle { position, uv: [0; 3], normal: [0; 3] });
            }
        }
    }
    mesh
}

/// Returns whether triangles use each directed edge at most once, which is the rule of `validate`.
fn directed_edges_are_used_once(mesh: &TriMesh) -> bool {
    let mut edges = mesh.directed_edges();
    edges.sort_unstable();
    edges.windows(2).all(|pair| pair[0] != pair[1])
}

/// Largest relative error of lengths and areas. Positions up to 1 are rounded by half a step of
/// `f32` in each coordinate, `2^-25`, at either end of an edge. The relative error of the shortest
/// edge, 0.13, is less than this.
const RELATIVE: f64 = 1e-6;

#[test]
fn a_torus_is_closed_and_orientable_with_euler_number_0() {
    let found = report(&torus(20, 12));
    assert_eq!((found.vertices, found.edges, found.faces), (240, 720, 480));
    assert_eq!((found.euler, found.boundary_loops, found.unused_vertices), (0, 0, 0));
    assert!(found.closed && found.orientable && found.oriented && found.manifold);
    assert_eq!((found.left_out.collapsed, found.left_out.slivers, found.quads), (0, 0, 240));
    let bounds = found.bounds.unwrap();
    assert_eq!((bounds.low[0], bounds.high), (-4.0, [4.0, 4.0, 1.0]));
}

#[test]
fn a_sphere_with_poles_is_closed_and_orientable_with_euler_number_2() {
    let (rows, cols) = (24, 13);
    let found = report(&sphere(rows, cols));
    assert_eq!((found.euler, found.boundary_loops), (2, 0));
    assert!(found.closed && found.orientable && found.oriented && found.manifold);
    assert_eq!(found.quads as usize, rows * (cols - 3));
    // Half of each cell at a pole is left out.
    assert_eq!(found.left_out.collapsed, 2 * rows as u64);
    // The shortest edges lie on the circles next to the poles, the longest are diagonals.
    let circle = 2.0 * (PI / 12.0).sin() * (PI / rows as f64).sin();
    let length = found.edge_length.unwrap();
    assert!((length.min / circle - 1.0).abs() < RELATIVE, "{} against {circle}", length.min);
    assert!(length.max > 2.0 * (PI / 24.0).sin() && length.max < TAU / 24.0 * 2.0_f64.sqrt());
}

#[test]
fn a_cylinder_has_two_rims() {
    let (rows, cols) = (5, 16);
    let found = report(&cylinder(rows, cols));
    assert_eq!((found.euler, found.boundary_loops), (0, 2));
    assert!(!found.closed && found.orientable && found.oriented && found.manifold);
    let side = 2.0 * (PI / cols as f64).sin();
    let (length, area) = (found.edge_length.unwrap(), found.triangle_area.unwrap());
    // The diagonal over the height on it, in a right triangle with the legs `side` and 1/2.
    let aspect = side.hypot(0.5).powi(2) / (0.5 * side);
    assert!((found.worst_aspect.unwrap() / aspect - 1.0).abs() < RELATIVE);
    assert!((found.edge_ratio.unwrap() / (side.hypot(0.5) / side) - 1.0).abs() < RELATIVE);
    for (found, truth) in [
        (length.min, side),
        (length.max, side.hypot(0.5)),
        (area.min, 0.25 * side),
        (area.max, 0.25 * side),
    ] {
        assert!((found / truth - 1.0).abs() < RELATIVE, "{found} against {truth}");
    }
}

#[test]
fn a_sheet_is_a_disk_and_a_torus_cut_once_is_a_tube() {
    let sheet = grid_of([3, 4], [Seam::Open; 2], |u, v| (DVec3::new(u, v, 0.0), DVec3::Z));
    let found = report(&sheet);
    assert_eq!((found.euler, found.boundary_loops, found.closed), (1, 1, false));
    let mut cut = torus(9, 8);
    cut.seam_v = Seam::Open;
    let found = report(&cut);
    assert_eq!((found.euler, found.boundary_loops, found.manifold), (0, 2, true));
}

#[test]
fn a_moebius_band_is_one_sided_with_one_rim() {
    for (rows, cols) in [(3, 2), (5, 2), (8, 5)] {
        let found = Topology::of(&one_sided(rows, cols, false));
        assert_eq!((found.euler(), found.boundary_loops), (0, 1), "{rows} x {cols}");
        assert!(!found.orientable && !found.oriented && found.manifold && !found.closed);
    }
}

#[test]
fn a_klein_bottle_is_closed_and_one_sided() {
    for (rows, cols) in [(4, 4), (9, 6), (6, 5)] {
        let mesh = one_sided(rows, cols, true);
        let found = Topology::of(&mesh);
        assert_eq!(found.edges * 2, found.faces * 3, "two faces to each edge");
        assert_eq!((found.euler(), found.boundary_loops), (0, 0), "{rows} x {cols}");
        assert!(!found.orientable && found.manifold && found.closed);
        assert!(!directed_edges_are_used_once(&mesh));
    }
}

#[test]
fn triangles_turned_over_at_random_are_still_orientable() {
    let mut mesh = triangulate::mesh(&torus(10, 9), &Options::default()).unwrap();
    for (i, triangle) in mesh.triangles.iter_mut().enumerate() {
        if i * i % 7 < 3 {
            triangle.position.swap(0, 1);
        }
    }
    let found = MeshReport::of(&mesh, &Counts::default());
    assert!(found.orientable && !found.oriented && found.closed && found.manifold);
}

#[test]
fn two_cones_tip_to_tip_are_no_manifold() {
    // A contour that crosses the axis of its rotation: a whole column is one point.
    let cones = grid_of([8, 5], [Seam::Closed, Seam::Open], |u, v| {
        let (radius, (sin, cos)) = (2.0 * u - 1.0, (TAU * v).sin_cos());
        (DVec3::new(radius * cos, radius * sin, radius), DVec3::new(cos, sin, -1.0))
    });
    let found = report(&cones);
    assert_eq!((found.euler, found.boundary_loops), (1, 2));
    assert!(!found.manifold && found.orientable && !found.closed);
}

#[test]
fn the_displacement_is_what_rounding_did() {
    let away = DVec3::new(1e6, -2e6, 3e6);
    let mut sheet = grid_of([3, 3], [Seam::Open; 2], |u, v| (DVec3::new(u, v, 0.0), DVec3::Z));
    sheet.positions.iter_mut().for_each(|point| *point += away + DVec3::new(0.0, 0.03, 0.03));
    let truth = sheet.positions.iter().map(|p| p.distance(p.as_vec3().as_dvec3()));
    let found = report(&sheet).displacement;
    assert_eq!(found, truth.fold(0.0, f64::max));
    // Near three million the steps of f32 are 0.25, so that 0.03 is lost completely.
    assert!(found > 0.01);
}

#[test]
fn a_surface_of_no_triangles_is_reported_too() {
    let line = grid_of([3, 3], [Seam::Open; 2], |u, v| (DVec3::X * (u + v), DVec3::Z));
    let found = report(&line);
    assert_eq!((found.vertices, found.unused_vertices, found.faces), (0, 9, 0));
    assert_eq!(found.left_out.collapsed + found.left_out.slivers, 8);
    assert!(!found.closed && found.edge_length.is_none() && found.bounds.is_some());
}
