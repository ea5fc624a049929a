//! Areas with their own pictures: their triangles, and the position of the picture on them.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::shapes;

use fixtures::program;
use glam::DVec3;
use proptest::prelude::*;
use shapes::{grid_of, sphere, torus};
use std::fs;
use std::path::Path;
use std::process::Output;
use sweep::GridMesh;
use sweep::grid::file::{Encoding, GridReader, write};
use sweep::grid::{Across, Area, Seam, UvLayout};
use triangulate::{Material, Options, TriMesh, mesh, write_obj};

fn area(rows: [usize; 2], cols: [usize; 2], texture: u32, repeat: [f64; 2]) -> Area {
    Area { rows, cols, texture: Some(texture), surface: None, repeat }
}

/// Returns a flat sheet whose points are their own `(u, v)`, unevenly spaced.
fn sheet(rows: usize, cols: usize) -> GridMesh {
    let bent = |x: f64| x * (0.5 + 0.5 * x);
    let mut grid = grid_of([rows + 1, cols + 1], [Seam::Open; 2], |u, v| {
        (DVec3::new(bent(u), bent(v), 0.0), DVec3::Z)
    });
    grid.u.iter_mut().chain(&mut grid.v).for_each(|x| *x = bent(*x));
    grid
}

/// Returns the material and the picture coordinates at a position of a sheet, found by brute force.
fn truth(grid: &GridMesh, middle: [f64; 2], place: [f64; 2]) -> (u32, [f64; 2]) {
    let within = |x: f64, places: &[f64], [from, to]: [usize; 2]| {
        (places[from] < x && x < places[to]).then(|| [places[from], places[to] - places[from]])
    };
    let found = grid.areas.iter().rev().find_map(|area| {
        let u = within(middle[0], &grid.u, area.cols)?;
        let v = within(middle[1], &grid.v, area.rows)?;
        let [s, t] = [(place[0] - u[0]) / u[1], (place[1] - v[0]) / v[1]];
        Some((area.texture.unwrap(), [s, t], area.repeat))
    });
    let (texture, [u, v], repeat) =
        found.unwrap_or((grid.texture.unwrap_or(0), place, grid.uv.repeat));
    let [s, t] = if grid.uv.across == Across::Contour { [u, v] } else { [1.0 - v, u] };
    (texture, [s * repeat[0], t * repeat[1]])
}

/// Compares every triangle of a sheet with [`truth`].
fn check(grid: &GridMesh) -> TriMesh {
    let mesh = mesh(grid, &Options::default()).unwrap();
    assert_eq!(mesh.validate(), Vec::<String>::new());
    let materials = mesh.materials();
    for (triangle, number) in mesh.triangles.iter().zip(mesh.material_numbers()) {
        let places = triangle.position.map(|i| mesh.positions[i as usize].map(f64::from));
        let middle = [0, 1].map(|k| places.iter().map(|place| place[k] / 3.0).sum());
        for (place, uv) in places.iter().zip(triangle.uv) {
            let (texture, expected) = truth(grid, middle, [place[0], place[1]]);
            assert_eq!(materials[number as usize], Material { texture, surface: 0 });
            for (found, expected) in mesh.uvs[uv as usize].iter().zip(expected) {
                // Positions are f32, and an area may be a hundredth of the sheet.
                assert!((f64::from(*found) - expected).abs() < 1e-4, "{found} for {expected}");
            }
        }
    }
    mesh
}

#[test]
fn a_picture_is_fitted_to_its_area() {
    let areas = vec![area([1, 3], [2, 5], 7, [2.0, 1.0])];
    let mesh = check(&GridMesh { areas: areas.clone(), ..sheet(4, 6) });
    assert_eq!(mesh.materials().len(), 2);
    // Points and normals are shared across the border of the area, picture coordinates are not.
    assert_eq!((mesh.positions.len(), mesh.normals.len()), (5 * 7, 1));
    assert_eq!(mesh.uvs.len(), 5 * 7 - 2 + 3 * 4);
    let uv = UvLayout { across: Across::Trajectory, repeat: [3.0, 2.0], ..UvLayout::default() };
    check(&GridMesh { areas, uv, texture: Some(9), ..sheet(4, 6) });
}

proptest! {
    #[test]
    fn later_areas_lie_on_earlier_ones(
        picks in prop::collection::vec((0_usize..5, 1_usize..6, 0_usize..7, 1_usize..8), 0..6),
        turned in prop::bool::ANY,
    ) {
        let areas = picks.into_iter().zip(1..).map(|((row, rows, col, cols), texture)| {
            let (to_row, to_col) = ((row + rows).min(5), (col + cols).min(7));
            area([row, to_row], [col, to_col], texture, [f64::from(texture), 1.0])
        });
        let across = if turned { Across::Trajectory } else { Across::Contour };
        let uv = UvLayout { across, ..UvLayout::default() };
        let grid = GridMesh { areas: areas.collect(), uv, ..sheet(5, 7) };
        let mesh = check(&grid);
        prop_assert_eq!(mesh.triangles.len(), 2 * 5 * 7);

        let (mut from_memory, mut file, mut from_file) = (Vec::new(), Vec::new(), Vec::new());
        let options = Options { texture: Some(3), surface: None };
        write_obj(&grid, &options, &mut from_memory).unwrap();
        write(&grid, Encoding::Json, &mut file).unwrap();
        let mut reader = GridReader::open("a", file.as_slice()).unwrap();
        write_obj(&mut reader, &options, &mut from_file).unwrap();
        prop_assert!(from_memory == from_file);
    }
}

#[test]
fn an_obj_changes_its_material_once_in_each_row_that_has_two() {
    let grid = GridMesh { areas: vec![area([2, 6], [1, 3], 5, [1.0; 2])], ..sheet(9, 4) };
    let mut obj = Vec::new();
    write_obj(&grid, &Options::default(), &mut obj).unwrap();
    let text = String::from_utf8(obj).unwrap();
    let names: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("usemtl ")).collect();
    assert_eq!(names, ["tex0_surf0", "tex5_surf0", "tex0_surf0", "tex5_surf0", "tex0_surf0"]);
}

#[test]
fn the_cells_that_lead_back_to_the_start_are_the_last_ones() {
    let areas = vec![area([7, 8], [0, 6], 1, [1.0; 2]), area([0, 8], [5, 6], 2, [1.0; 2])];
    let mesh = mesh(&GridMesh { areas, ..torus(8, 6) }, &Options::default()).unwrap();
    let (materials, numbers) = (mesh.materials(), mesh.material_numbers());
    let count = |texture: u32| {
        let of_it = |number: &&u32| materials[**number as usize].texture == texture;
        numbers.iter().filter(of_it).count()
    };
    assert_eq!([0, 1, 2].map(count), [2 * 7 * 5, 2 * 5, 2 * 8]);
    // Each picture spans 0 to 1 on its area, also across the seam.
    for texture in [1, 2] {
        let of_it = numbers.iter().zip(&mesh.triangles);
        let of_it = of_it.filter(|(number, _)| materials[**number as usize].texture == texture);
        let uvs = of_it.flat_map(|(_, t)| t.uv).map(|i| mesh.uvs[i as usize]);
        let [low, high] = uvs.fold([[1.0_f32; 2], [0.0; 2]], |[low, high], uv| {
            [[0, 1].map(|k| low[k].min(uv[k])), [0, 1].map(|k| high[k].max(uv[k]))]
        });
        assert_eq!((low, high), ([0.0; 2], [if texture == 1 { 5.0 / 6.0 } else { 1.0 }, 1.0]));
    }
}

#[test]
fn cells_of_a_crease_are_not_counted_and_poles_take_the_middle_of_their_share() {
    let mut prism = grid_of([3, 8], [Seam::Open, Seam::Closed], |u, v| {
        let (sin, cos) = (std::f64::consts::TAU * (u - 0.5 / 8.0).max(0.0)).sin_cos();
        (DVec3::new(cos, sin, v), DVec3::new(cos, sin, 0.0))
    });
    prism.u = vec![0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75];
    for k in 0..24 {
        prism.positions[k] = prism.positions[k - k % 2];
    }
    prism.areas = vec![area([0, 2], [1, 2], 1, [1.0; 2])];
    let of_prism = mesh(&prism, &Options::default()).unwrap();
    assert_eq!(of_prism.material_numbers().iter().filter(|number| **number == 1).count(), 4);

    let ball = GridMesh { areas: vec![area([0, 4], [0, 4], 1, [1.0; 2])], ..sphere(8, 5) };
    let of_ball = mesh(&ball, &Options::default()).unwrap();
    let mut at_pole: Vec<f32> = Vec::new();
    for (triangle, number) in of_ball.triangles.iter().zip(of_ball.material_numbers()) {
        let uvs = triangle.uv.map(|i| of_ball.uvs[i as usize]);
        let material = of_ball.materials()[number as usize];
        at_pole
            .extend(uvs.iter().filter(|uv| uv[0] == 0.0 && material.texture == 1).map(|uv| uv[1]));
    }
    at_pole.sort_by(f32::total_cmp);
    assert_eq!(at_pole, [0.125, 0.375, 0.625, 0.875]);
}

#[test]
fn an_area_that_is_not_on_the_grid_is_refused() {
    let grid = GridMesh { areas: vec![area([0, 5], [0, 1], 1, [1.0; 2])], ..sheet(4, 6) };
    let expected = "areas[0].rows: found [0, 5], expected two rising numbers from 0 to 4";
    let message = mesh(&grid, &Options::default()).unwrap_err().to_string();
    assert!(message.starts_with("shape: ") && message.contains(expected), "{message}");
    let message = write(&grid, Encoding::Json, &mut Vec::new()).unwrap_err().to_string();
    assert!(message.contains("rows: found [0, 5], expected two rising numbers"), "{message}");
}

fn run(arguments: &[&str], folder: &Path) -> Output {
    program::run(env!("CARGO_BIN_EXE_triangulate").as_ref(), arguments, folder, b"")
}

#[test]
fn areas_of_a_file_are_those_of_the_grid() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let areas = vec![area([1, 3], [2, 5], 7, [2.0, 1.0])];
    let file_of = |grid: &GridMesh| {
        let mut file = Vec::new();
        write(grid, Encoding::Binary, &mut file).unwrap();
        file
    };
    fs::write(path("plain.grid"), file_of(&sheet(4, 6))).unwrap();
    fs::write(path("own.grid"), file_of(&GridMesh { areas, ..sheet(4, 6) })).unwrap();
    let text = |rows: &str| {
        format!(
            "{{\"format\": \"tb-areas\", \"version\": 1,\n \"areas\": [{{\"rows\": {rows}, \
             \"cols\": [2, 5], \"texture\": 7, \"repeat\": [2, 1]}}]}}"
        )
    };
    fs::write(path("areas.json"), text("[1, 3]")).unwrap();
    let with_file = run(
        &["plain.grid", "--areas", "areas.json", "--mtl", "-o", "a.obj", "--report", "-"],
        folder.path(),
    );
    assert_eq!(with_file.status.code(), Some(0), "{}", String::from_utf8_lossy(&with_file.stderr));
    let own = run(&["own.grid", "--mtl", "-o", "a2.obj", "--report", "-"], folder.path());
    assert_eq!(with_file.stdout, own.stdout);
    let [one, two] = ["a.obj", "a2.obj"].map(|name| fs::read_to_string(path(name)).unwrap());
    assert_eq!(one, two.replace("a2.mtl", "a.mtl"));
    let mtl = fs::read_to_string(path("a.mtl")).unwrap();
    let names: Vec<&str> = mtl.lines().filter_map(|line| line.strip_prefix("newmtl ")).collect();
    assert_eq!(names, ["tex0_surf0", "tex7_surf0"]);

    for (rows, grid, code, expected) in [
        ("[1, 9]", "plain.grid", 3, "areas.json:2:21: areas[0].rows: found [1, 9], expected"),
        ("[1, 3]", "-", 2, "--areas - would read from the grid's standard input"),
    ] {
        fs::write(path("areas.json"), text(rows)).unwrap();
        let areas = if grid == "-" { "-" } else { "areas.json" };
        let made = run(&[grid, "--areas", areas, "-o", "b.obj"], folder.path());
        let said = String::from_utf8(made.stderr).unwrap();
        assert_eq!(made.status.code(), Some(code), "{said}");
        assert!(said.contains(expected), "{said}");
        assert!(!path("b.obj").exists());
    }
}
