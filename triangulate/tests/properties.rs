//! Shapes whose triangles are known, and the same mesh two ways.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use glam::{DVec3, Vec3};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use sweep::GridMesh;
use sweep::grid::file::{Encoding, GridReader, write};
use sweep::grid::{Across, Seam, UvLayout};
use triangulate::{Options, TriMesh, mesh, write_grid_obj, write_obj};

/// A grid of a surface given by point and normal at `(u, v)`, evenly spaced.
fn grid_of(
    [rows, cols]: [usize; 2],
    [seam_v, seam_u]: [Seam; 2],
    surface: impl Fn(f64, f64) -> (DVec3, DVec3),
) -> GridMesh {
    let even = |count: usize, seam: Seam| -> Vec<f64> {
        let last = if seam == Seam::Closed {
            count
        } else {
            count - 1
        };
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
    GridMesh {
        name,
        seam_u,
        seam_v,
        uv: UvLayout::default(),
        u,
        v,
        positions,
        normals,
    }
}

/// Radii 3 and 1. Along `u` around the tube, along `v` around the hole.
fn torus(rows: usize, cols: usize) -> GridMesh {
    grid_of([rows, cols], [Seam::Closed; 2], |u, v| {
        let ((a_sin, a_cos), (b_sin, b_cos)) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
        // Counter-clockwise around the tube seen along the trajectory, so that S_u x S_v points out.
        let normal = DVec3::new(a_cos * b_cos, a_cos * b_sin, -a_sin);
        (3.0 * DVec3::new(b_cos, b_sin, 0.0) + normal, normal)
    })
}

/// Radius 1: a half circle from pole to pole, rotated.
fn sphere(rows: usize, cols: usize) -> GridMesh {
    grid_of([rows, cols], [Seam::Closed, Seam::Open], |u, v| {
        // From the upper pole to the lower one, so that S_u x S_v points out.
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

/// Radius 1, height 2, from row to row upward.
fn cylinder(rows: usize, cols: usize) -> GridMesh {
    grid_of([rows, cols], [Seam::Open, Seam::Closed], |u, v| {
        let (sin, cos) = (TAU * u).sin_cos();
        (DVec3::new(cos, sin, 2.0 * v), DVec3::new(cos, sin, 0.0))
    })
}

fn made(grid: &GridMesh) -> TriMesh {
    let mesh = mesh(grid, &Options::default()).unwrap();
    assert_eq!(mesh.validate(), Vec::<String>::new());
    mesh
}

fn corners(mesh: &TriMesh) -> impl Iterator<Item = [DVec3; 3]> {
    mesh.triangles.iter().map(|triangle| {
        triangle
            .position
            .map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)))
    })
}

/// Six times the volume, by the signed tetrahedra from the origin: positive when faces face out.
fn volume(mesh: &TriMesh) -> f64 {
    corners(mesh)
        .map(|[a, b, c]| a.dot(b.cross(c)))
        .sum::<f64>()
        / 6.0
}

/// Vertices - edges + faces.
fn euler(mesh: &TriMesh) -> i64 {
    let mut edges = mesh.directed_edges();
    edges.iter_mut().for_each(|edge| edge.sort_unstable());
    edges.sort_unstable();
    edges.dedup();
    mesh.positions.len() as i64 - edges.len() as i64 + mesh.triangles.len() as i64
}

/// Edges that no triangle runs along the other way.
fn rim(mesh: &TriMesh) -> usize {
    let mut edges = mesh.directed_edges();
    edges.sort_unstable();
    edges
        .iter()
        .filter(|[a, b]| edges.binary_search(&[*b, *a]).is_err())
        .count()
}

/// The smallest cosine between a triangle and the normals at its corners.
fn worst_normal(mesh: &TriMesh) -> f64 {
    let of_corners = mesh.triangles.iter().map(|triangle| {
        triangle
            .normal
            .map(|i| DVec3::from(mesh.normals[i as usize].map(f64::from)))
    });
    corners(mesh)
        .zip(of_corners)
        .map(|([a, b, c], normals)| {
            let face = (b - a).cross(c - a).normalize();
            normals.iter().map(|n| n.dot(face)).fold(1.0, f64::min)
        })
        .fold(1.0, f64::min)
}

fn obj_of(grid: &GridMesh, options: &Options) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_grid_obj(grid, options, &mut bytes).unwrap();
    bytes
}

/// The bits of position, picture coordinates and normal of each corner of each triangle.
fn corner_bits(mesh: &TriMesh) -> Vec<[u32; 8]> {
    let of_one = |position: u32, uv: u32, normal: u32| {
        let [x, y, z] = mesh.positions[position as usize];
        let [s, t] = mesh.uvs[uv as usize];
        let [l, m, n] = mesh.normals[normal as usize];
        [x, y, z, s, t, l, m, n].map(f32::to_bits)
    };
    let of_three =
        |t: &triangulate::Triangle| [0, 1, 2].map(|i| of_one(t.position[i], t.uv[i], t.normal[i]));
    mesh.triangles.iter().flat_map(of_three).collect()
}

/// The same, as an independent reader of OBJ sees it.
fn corner_bits_by_tobj(obj: &[u8]) -> Vec<[u32; 8]> {
    let no_materials = |_: &std::path::Path| tobj::load_mtl_buf(&mut &b""[..]);
    let (models, _) =
        tobj::load_obj_buf(&mut &*obj, &tobj::LoadOptions::default(), no_materials).unwrap();
    assert!(models.len() <= 1, "one object");
    let mut bits = Vec::new();
    for tobj::Model { mesh, .. } in &models {
        let indices = mesh
            .indices
            .iter()
            .zip(&mesh.texcoord_indices)
            .zip(&mesh.normal_indices);
        for ((&p, &t), &n) in indices {
            let (p, t, n) = (3 * p as usize, 2 * t as usize, 3 * n as usize);
            let (p, t, n) = (
                &mesh.positions[p..p + 3],
                &mesh.texcoords[t..t + 2],
                &mesh.normals[n..n + 3],
            );
            bits.push([p[0], p[1], p[2], t[0], t[1], n[0], n[1], n[2]].map(f32::to_bits));
        }
    }
    bits
}

#[test]
fn a_torus_is_closed_and_has_one_hole() {
    let mesh = made(&torus(60, 40));
    assert_eq!(
        (mesh.positions.len(), mesh.uvs.len(), mesh.triangles.len()),
        (2400, 2501, 4800)
    );
    assert_eq!((euler(&mesh), rim(&mesh)), (0, 0));
    let truth = 2.0 * PI * PI * 3.0;
    assert!(
        (volume(&mesh) / truth - 1.0).abs() < 0.01,
        "{} against {truth}",
        volume(&mesh)
    );
    assert!(worst_normal(&mesh) > 0.99);
}

#[test]
fn a_sphere_is_closed_and_each_pole_is_one_vertex() {
    let (rows, cols) = (48, 25);
    let mesh = made(&sphere(rows, cols));
    assert_eq!(mesh.positions.len(), rows * (cols - 2) + 2);
    assert_eq!(mesh.triangles.len(), rows * (2 * (cols - 1) - 2));
    assert_eq!((euler(&mesh), rim(&mesh)), (2, 0));
    assert!((volume(&mesh) / (4.0 / 3.0 * PI) - 1.0).abs() < 0.01);
    assert!(worst_normal(&mesh) > 0.99);
    // Columns without poles, with v = 1; and a half cell for each row at each pole.
    assert_eq!(mesh.uvs.len(), (rows + 1) * (cols - 2) + 2 * rows);
    // The poles have one normal each, for all rows.
    assert_eq!(mesh.normals.len(), mesh.positions.len());
}

#[test]
fn a_pole_takes_the_middle_of_its_share_of_the_picture() {
    let mesh = made(&sphere(8, 5));
    let mut at_pole: Vec<f32> = mesh
        .uvs
        .iter()
        .filter(|uv| uv[0] == 0.0)
        .map(|uv| uv[1])
        .collect();
    at_pole.sort_by(f32::total_cmp);
    assert_eq!(
        at_pole,
        [
            0.0625, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125, 0.9375
        ]
    );
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
        .filter_map(|t| {
            t.position
                .iter()
                .position(|&p| p == 0)
                .map(|corner| t.normal[corner])
        })
        .map(|normal| mesh.normals[normal as usize])
        .collect();
    assert_eq!(tips.len(), rows);
    for (row, tip) in tips.iter().enumerate() {
        let (sin, cos) = (TAU * (row as f64 + 0.5) / rows as f64).sin_cos();
        let middle = DVec3::new(cos, sin, 1.0).normalize();
        // The mean of two unit normals is a little steeper than the cone.
        assert!(DVec3::from(tip.map(f64::from)).dot(middle) > 0.999);
        assert!((f64::from(tip[1]) * cos - f64::from(tip[0]) * sin).abs() < 1e-6);
    }
}

#[test]
fn a_row_drawn_together_is_a_pole_too() {
    let cone = grid_of([4, 6], [Seam::Open, Seam::Closed], |u, v| {
        let (sin, cos) = (TAU * u).sin_cos();
        (
            DVec3::new((1.0 - v) * cos, (1.0 - v) * sin, v),
            DVec3::new(cos, sin, 1.0),
        )
    });
    let mesh = made(&cone);
    assert_eq!(
        (mesh.positions.len(), mesh.triangles.len()),
        (3 * 6 + 1, 5 * 6)
    );
    assert_eq!((euler(&mesh), rim(&mesh)), (1, 6));
    let mut at_tip: Vec<f32> = mesh
        .uvs
        .iter()
        .filter(|uv| uv[1] == 1.0)
        .map(|uv| uv[0])
        .collect();
    at_tip.sort_by(f32::total_cmp);
    assert_eq!(
        at_tip,
        [1.0, 3.0, 5.0, 7.0, 9.0, 11.0].map(|twelfth: f32| twelfth / 12.0)
    );
}

#[test]
fn a_cylinder_has_two_rims_and_its_picture_goes_once_around() {
    let mesh = made(&cylinder(5, 32));
    assert_eq!((euler(&mesh), rim(&mesh)), (0, 64));
    assert_eq!((mesh.positions.len(), mesh.uvs.len()), (5 * 32, 5 * 33));
    // The normals of a column are all the same, so they are told once.
    assert_eq!(mesh.normals.len(), 32);
    for [x, y, _] in &mesh.positions {
        assert!((x.hypot(*y) - 1.0).abs() < 1e-6);
    }
    let area: f64 = corners(&mesh)
        .map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0)
        .sum();
    let truth = 2.0 * 32.0 * 2.0 * (PI / 32.0).sin();
    assert!((area / truth - 1.0).abs() < 1e-6, "{area} against {truth}");
    // No triangle spans more than one cell of the picture, at the seam either.
    for triangle in &mesh.triangles {
        let s = triangle.uv.map(|i| mesh.uvs[i as usize][0]);
        let width = s
            .iter()
            .fold(0.0, |w: f32, a| s.iter().fold(w, |w, b| w.max(a - b)));
        assert!((width - 1.0 / 32.0).abs() < 1e-6, "{width}");
    }
}

#[test]
fn a_turned_and_repeated_picture_stays_whole_at_the_seams() {
    let mut grid = torus(16, 8);
    grid.uv = UvLayout {
        across: Across::Trajectory,
        repeat: [3.0, 2.0],
    };
    let mesh = made(&grid);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.uv.map(|i| mesh.uvs[i as usize].map(f64::from));
        // Half a cell of the picture, with the winding of the triangle: not mirrored.
        let area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0;
        assert!(
            (area - 0.5 * (3.0 / 16.0) * (2.0 / 8.0)).abs() < 1e-6,
            "{area}"
        );
    }
    let highest = mesh
        .uvs
        .iter()
        .fold([0.0_f32; 2], |m, t| [m[0].max(t[0]), m[1].max(t[1])]);
    assert_eq!(highest, [3.0, 2.0]);
}

#[test]
fn a_crease_has_one_vertex_and_two_normals() {
    // A square prism: each corner of the contour is two columns.
    let corner = |i: usize| [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]][i % 4];
    let mut prism = grid_of([3, 8], [Seam::Open, Seam::Closed], |u, v| {
        let col = (u * 8.0).round() as usize;
        let [x, y] = corner(col / 2);
        // The first of the two belongs to the side before the corner, the second to the one after.
        let [p, q] = [corner((col + 7) / 2 % 4), corner(col.div_ceil(2))];
        (
            DVec3::new(x, y, v),
            DVec3::new(p[0] + q[0], p[1] + q[1], 0.0),
        )
    });
    prism.u = vec![0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75];
    let mesh = made(&prism);
    // One normal a side for all rows; that of the side over the seam is told at both its ends.
    assert_eq!((mesh.positions.len(), mesh.normals.len()), (3 * 4, 4 + 1));
    assert_eq!(mesh.uvs.len(), 3 * 5);
    assert_eq!(mesh.triangles.len(), 2 * 4 * 2);
    assert_eq!((euler(&mesh), rim(&mesh)), (0, 8));
    assert!(worst_normal(&mesh) > 1.0 - 1e-12);
}

#[test]
fn a_cell_with_three_corners_on_a_line_is_cut_so_that_nothing_is_lost() {
    let mut sheet = grid_of([2, 2], [Seam::Open; 2], |u, v| {
        (DVec3::new(u, v, 0.0), DVec3::Z)
    });
    sheet.positions[1] = DVec3::new(1.0, 0.0, 0.0);
    sheet.positions[3] = DVec3::new(2.0, 0.0, 0.0);
    sheet.positions[2] = DVec3::new(0.0, 3.0, 0.0);
    let mesh = made(&sheet);
    assert_eq!(mesh.triangles.len(), 2);
}

#[test]
fn a_line_instead_of_a_surface_gives_no_triangles() {
    let line = grid_of([3, 3], [Seam::Open; 2], |u, v| {
        (DVec3::X * (u + v), DVec3::Z)
    });
    let mut obj = Vec::new();
    let counts = write_grid_obj(&line, &Options::default(), &mut obj).unwrap();
    assert_eq!(
        (counts.triangles, counts.slivers + counts.collapsed),
        (0, 8)
    );
}

#[test]
fn what_f32_cannot_hold_is_refused() {
    for wild in [1e39, f64::NAN] {
        let mut grid = torus(3, 3);
        grid.positions[4].y = wild;
        let message = mesh(&grid, &Options::default()).unwrap_err().to_string();
        assert!(
            message.starts_with("row 2, column 2: found the position"),
            "{message}"
        );
    }
    let mut grid = torus(3, 3);
    grid.positions.pop();
    let message = mesh(&grid, &Options::default()).unwrap_err().to_string();
    assert_eq!(
        message,
        "found a grid with 8 positions and 9 normals, expected 9 of each"
    );
}

#[test]
fn an_obj_says_what_it_is_and_that_it_is_whole() {
    let mut grid = cylinder(2, 3);
    grid.name = "a tube".into();
    let text = String::from_utf8(obj_of(
        &grid,
        &Options {
            texture: 2,
            surface: 7,
        },
    ))
    .unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[..3],
        [
            "# topobook triangulate OBJ 1",
            "o a_tube",
            "usemtl tex2_surf7"
        ]
    );
    assert_eq!(lines.last(), Some(&"# end 6 6"));
    assert!(text.ends_with('\n'));
    let count = |keyword| {
        lines
            .iter()
            .filter(|line| line.starts_with(keyword))
            .count()
    };
    assert_eq!(
        (count("v "), count("vt "), count("vn "), count("f ")),
        (6, 8, 3, 6)
    );
}

#[test]
fn a_cut_grid_gives_an_obj_without_its_end() {
    let mut bytes = Vec::new();
    write(&torus(5, 5), Encoding::Binary, &mut bytes).unwrap();
    bytes.truncate(bytes.len() - 1);
    let mut obj = Vec::new();
    let mut reader = GridReader::open("a", bytes.as_slice()).unwrap();
    let error = write_obj(&mut reader, &Options::default(), &mut obj).unwrap_err();
    assert!(error.to_string().contains("cut short"), "{error}");
    assert!(!String::from_utf8(obj).unwrap().contains("# end"));
}

/// Numbers that decimals of f32 get wrong, if any do.
fn nasty() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::sample::select(vec![
            0.0,
            -0.0,
            1e-45,
            -1e-45,
            1.2e-38,
            3e38,
            0.1,
            1e-300,
            16_777_217.0
        ]),
        any::<u32>()
            .prop_map(|bits| f64::from(f32::from_bits(bits)))
            .prop_filter("finite", |x| x.is_finite()),
        // Few values, so that points coincide.
        (-1..=1).prop_map(f64::from),
        (-1..=1).prop_map(f64::from),
        -1.0..1.0,
    ]
}

fn any_grid() -> impl Strategy<Value = GridMesh> {
    let seam = || prop::sample::select(vec![Seam::Open, Seam::Closed]);
    (3_usize..6, 3_usize..6).prop_flat_map(move |shape| {
        let points = shape.0 * shape.1;
        let layout = (prop::bool::ANY, 0.001..1000.0, 0.001..1000.0);
        let all_positions = prop::collection::vec(prop::array::uniform3(nasty()), points);
        let all_normals = prop::collection::vec(prop::array::uniform3(-1.0..1.0_f32), points);
        (seam(), seam(), layout, all_positions, all_normals).prop_map(
            move |(seam_u, seam_v, (turned, across, up), positions, normals)| {
                let mut grid = grid_of([shape.0, shape.1], [seam_v, seam_u], |_, _| {
                    (DVec3::X, DVec3::X)
                });
                let across_what = if turned {
                    Across::Trajectory
                } else {
                    Across::Contour
                };
                grid.uv = UvLayout {
                    across: across_what,
                    repeat: [across, up],
                };
                grid.positions = positions.into_iter().map(DVec3::from_array).collect();
                grid.normals = normals.into_iter().map(Vec3::from_array).collect();
                grid
            },
        )
    })
}

proptest! {
    #[test]
    fn file_and_memory_give_the_same_mesh_to_the_bit(grid in any_grid()) {
        let options = Options { texture: 3, surface: 1 };
        let obj = obj_of(&grid, &options);
        for encoding in [Encoding::Binary, Encoding::Json] {
            let mut file = Vec::new();
            write(&grid, encoding, &mut file).unwrap();
            let mut piped = Vec::new();
            let mut reader = GridReader::open("a", file.as_slice()).unwrap();
            write_obj(&mut reader, &options, &mut piped).unwrap();
            prop_assert!(piped == obj, "the OBJ differs through {encoding:?}");
        }
        let mesh = mesh(&grid, &options).unwrap();
        prop_assert_eq!(corner_bits(&mesh), corner_bits_by_tobj(&obj));
        let text = String::from_utf8(obj).unwrap();
        prop_assert!(!text.contains("-0 ") && !text.contains("-0\n"));
        let end = format!("# end {} {}\n", mesh.positions.len(), mesh.triangles.len());
        prop_assert!(text.ends_with(&end));
        // Whatever the points are, no triangle lacks area and no index leads nowhere.
        let complaints = mesh.validate().join("\n");
        prop_assert!(!complaints.contains("area") && !complaints.contains("less than"));
    }
}
