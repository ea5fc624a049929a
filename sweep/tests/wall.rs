//! Walls around one-sided surfaces.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use glam::DVec3;
use serde_json::{Value, json};
use sweep::check::{self, Severity};
use sweep::grid::Seam;
use sweep::grid::file::{Encoding, GridReader};
use sweep::{GridMesh, Object, Sweep};

fn example(name: &str, rows: usize, cols: usize) -> Value {
    let path = format!("{}/../examples/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let mut spec: Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    spec.as_object_mut().unwrap().remove("areas");
    spec["mesh"] = json!({"rows": rows, "cols": cols});
    spec
}

fn with_wall(mut spec: Value, wall: f64) -> Value {
    spec["wall"] = json!(wall);
    spec
}

fn object(spec: &Value) -> Object {
    let text = spec.to_string();
    let document = Document::new("test", text.as_bytes()).unwrap();
    Object::read(
        &document,
        std::path::Path::new(""),
        &files::Disk,
        &sweep::spec::Resolution::default(),
    )
    .unwrap()
}

fn grid(spec: &Value) -> GridMesh {
    object(spec).grids().unwrap().pop().unwrap()
}

/// Returns the corners of all cells, counter-clockwise as seen from the side of the normals.
fn cells(grid: &GridMesh) -> impl Iterator<Item = [DVec3; 4]> + '_ {
    let (rows, cols) = (grid.rows(), grid.cols());
    (0..rows * cols).map(move |i| {
        let (row, col) = (i / cols, i % cols);
        let next = (col + 1) % cols;
        let above = |col: usize| match row + 1 == rows {
            true => grid.seam_v.leads_to(col, grid.shift, cols),
            false => (row + 1) * cols + col,
        };
        let corners = [row * cols + col, row * cols + next, above(next), above(col)];
        corners.map(|at| grid.positions[at])
    })
}

fn area(grid: &GridMesh) -> f64 {
    cells(grid).map(|[a, b, c, d]| 0.5 * (c - a).cross(d - b).length()).sum()
}

/// Returns the enclosed volume by the divergence theorem, over the two triangles of each cell.
fn volume(grid: &GridMesh) -> f64 {
    let of = |[a, b, c, d]: [DVec3; 4]| (a.dot(b.cross(c)) + a.dot(c.cross(d))) / 6.0;
    cells(grid).map(of).sum()
}

/// Checks Weyl's tube formula. The region within t/2 of a surface has the volume `A t + K t^3 /
/// 12`, where K is the integral of the Gaussian curvature. On a Klein bottle K is 2 pi times the
/// Euler number, 0. The area of the sheet and the volume of the wall must therefore agree.
#[test]
fn the_wall_of_a_klein_bottle_holds_its_area_times_its_thickness() {
    for (name, thickness) in [("klein-bottle", 0.06), ("figure-eight-klein", 0.04)] {
        let sheet = example(name, 900, 180);
        let wall = grid(&with_wall(sheet.clone(), thickness));
        let expected = area(&grid(&sheet)) * thickness;
        let off = volume(&wall) / expected - 1.0;
        // Chords of 180 columns cut (pi / 180)^2 / 2 off a circle, and rows slightly more.
        assert!(off.abs() < 1e-3, "{name}: {off:e}");
    }
}

#[test]
fn a_wall_is_the_sheet_on_both_sides_and_closes_after_twice_the_way() {
    let spec = example("klein-bottle", 90, 40);
    let (sheet, wall) = (grid(&spec), grid(&with_wall(spec, 0.05)));
    assert_eq!((sheet.seam_v, wall.seam_v, wall.shift), (Seam::Mirror, Seam::Closed, 0));
    assert_eq!((wall.rows(), wall.cols()), (2 * sheet.rows(), sheet.cols()));
    assert!(wall.v.is_sorted() && wall.v[0] == 0.0 && *wall.v.last().unwrap() < 1.0);
    let cols = sheet.cols();
    for row in 0..sheet.rows() {
        for col in 0..cols {
            let (near, led) = (row * cols + col, sheet.seam_v.leads_to(col, sheet.shift, cols));
            let far = (sheet.rows() + row) * cols + led;
            let (p, q) = (wall.positions[near], wall.positions[far]);
            assert_eq!(wall.normals[near], -wall.normals[far]);
            // The normals are unit in f32, which has seven digits.
            assert!((p.distance(q) - 0.05).abs() < 1e-8);
            assert!((0.5 * (p + q) - sheet.positions[near]).length() < 1e-14);
        }
    }
}

/// From the side of the normals every cell runs counter-clockwise, also at both ends of the first
/// side, where a sheet alone flips.
#[test]
fn a_wall_faces_outward_everywhere() {
    let wall = grid(&with_wall(example("klein-bottle", 400, 60), 0.06));
    for ([a, b, c, d], normal) in cells(&wall).zip(&wall.normals) {
        let across = (c - a).cross(d - b).normalize();
        assert!(across.dot(normal.as_dvec3()) > 0.8, "{a}: {across} {normal}");
    }
}

#[test]
fn a_wall_written_row_by_row_is_the_wall_in_memory() {
    let object = object(&with_wall(example("klein-bottle", 300, 120), 0.05));
    let mut bytes = Vec::new();
    object.write(Encoding::Binary, &mut bytes).unwrap();
    let read = GridReader::open("wall", &bytes[..]).unwrap().read_rest().unwrap();
    assert_eq!(read, object.grids().unwrap());
}

#[test]
fn a_wall_thicker_than_the_bottle_is_round_is_wrong() {
    let findings = |wall: f64| {
        let text = with_wall(example("klein-bottle", 240, 40), wall).to_string();
        let sweep = Sweep::read(&Document::new("test", text.as_bytes()).unwrap()).unwrap();
        check::of_sweep(&sweep, &sweep.grid())
    };
    // The neck has a radius of 0.19.
    let found = findings(0.5);
    let wrong = found.iter().find(|finding| finding.path == "wall").unwrap();
    assert_eq!(wrong.severity, Severity::Wrong);
    assert!(wrong.message.contains("cells are turned over: half the wall, 0.25"), "{wrong}");
    assert!(findings(0.1).iter().all(|finding| finding.path != "wall"));
}
