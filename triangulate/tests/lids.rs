//! Flat ends of sections with holes and of sections that no point sees whole: closed, manifold, and of the right volume.

use files::json::Document;
use glam::DVec3;
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::path::Path;
use sweep::grid::file::{Encoding, read_all, write_all};
use sweep::{GridMesh, Object, spec::Resolution};
use triangulate::{Merged, Options, Topology, TriMesh, mesh};

fn grids(keys: &Value) -> Vec<GridMesh> {
    let mut spec = json!({ "format": "tb-sweep", "version": 1, "name": "a" });
    for (key, value) in keys.as_object().unwrap() {
        spec[key] = value.clone();
    }
    let text = spec.to_string();
    let document = Document::new("a.json", text.as_bytes()).unwrap();
    let object = Object::read(&document, Path::new(""), &files::Disk, &Resolution::default());
    object.unwrap_or_else(|error| panic!("{error}: {text}")).grids().unwrap()
}

fn volume(mesh: &TriMesh) -> f64 {
    let part = |triangle: &triangulate::Triangle| {
        let [a, b, c] = triangle
            .position
            .map(|index| DVec3::from(mesh.positions[index as usize].map(f64::from)));
        a.dot(b.cross(c)) / 6.0
    };
    mesh.triangles.iter().map(part).sum()
}

/// Returns the volume and the Euler number of a mesh that must be closed and manifold, also after merging vertices.
fn solid(keys: &Value) -> (f64, i64) {
    let grids = grids(keys);
    let mesh = mesh(grids.as_slice(), &Options::default()).unwrap();
    let topology = Topology::of(&mesh);
    assert!(topology.closed && topology.manifold && topology.oriented, "{topology:?} {keys}");
    let merged = Merged::of(&mesh);
    assert!(merged.closed && merged.manifold, "{merged:?} {keys}");
    assert_eq!(mesh.validate(), Vec::<String>::new(), "{keys}");
    (volume(&mesh), topology.euler())
}

const FLAT: &str = r#"{"start": "flat", "end": "flat"}"#;

fn flat() -> Value {
    serde_json::from_str(FLAT).unwrap()
}

#[test]
fn a_channel_has_flat_ends() {
    let channel = json!({ "polyline": { "closed": true, "points":
        [[-3, 0], [3, 0], [3, 5], [2, 5], [2, 1], [-2, 1], [-2, 5], [-3, 5]] } });
    for mesh in [json!({ "tol": 0.01 }), json!({ "rows": 5, "cols": 61 })] {
        let (volume, euler) = solid(&json!({
            "contour": channel, "trajectory": { "line": [[0, 0, 0], [0, 0, 20]] }, "caps": flat(), "mesh": mesh,
        }));
        assert!((volume - 280.0).abs() < 1e-4 && euler == 2, "{volume} {euler}");
    }
}

/// The area of a section times the length, less the twelfth part that a bend of a polyline cuts off, is the volume.
#[test]
fn a_path_with_a_hole_is_a_pipe() {
    let (volume, euler) = solid(&json!({
        "contour": { "svg": "M0 0h4v4h-4z M1 1h2v2h-2z" },
        "trajectory": { "line": [[0, 0, 0], [0, 7, 9]] }, "caps": flat(), "mesh": { "rows": 3, "cols": 20 },
    }));
    assert!((volume - 12.0 * 130_f64.sqrt()).abs() < 1e-3 && euler == 0, "{volume} {euler}");
}

#[test]
fn an_end_of_a_partial_rotation_is_flat_to_the_axis() {
    let (volume, euler) = solid(&json!({
        "contour": { "svg": "M0 0H3V-2H2.5V-0.5H0" }, "trajectory": { "rotation": { "angle_deg": 90 } },
        "caps": flat(), "mesh": { "rows": 256, "cols": 5 },
    }));
    let whole = PI * (9.0 * 2.0 - 6.25 * 1.5);
    assert!((volume / (0.25 * whole) - 1.0).abs() < 1e-3 && euler == 2, "{volume} {euler}");
}

#[test]
fn a_hollow_ring_has_two_closed_surfaces() {
    let (volume, euler) = solid(&json!({
        "contour": { "circle": 1 }, "trajectory": { "circle": { "radius": 4 } }, "wall": 0.25,
        "mesh": { "rows": 200, "cols": 200 },
    }));
    let expected = 2.0 * PI * PI * 4.0 * (1.0 - 0.75 * 0.75);
    assert!((volume / expected - 1.0).abs() < 1e-3 && euler == 0, "{volume} {expected}");
}

/// The inner surface of a tapered wall is the outer one, moved in by the thickness in the plane of the section.
#[test]
fn a_wall_has_its_thickness_in_every_section() {
    for (side, inner, outer) in
        [("inward", -0.1, 0.0), ("outward", 0.0, 0.1), ("center", -0.05, 0.05)]
    {
        let grids = grids(&json!({
            "contour": { "circle": 1 }, "trajectory": { "line": [[0, 0, 0], [0, 0, 4]] },
            "scale": { "keys": [[0, 1], [1, 0.5]] }, "wall": { "thickness": 0.1, "side": side },
            "mesh": { "rows": 8, "cols": 24 },
        }));
        for (grid, moved) in grids.iter().zip([outer, inner]) {
            for point in &grid.positions {
                let radius = 1.0 - point.z / 8.0 + moved;
                assert!((point.truncate().length() - radius).abs() < 1e-12, "{side} {point}");
            }
        }
    }
}

/// The mean of a squared sine is a half.
#[test]
fn a_wall_with_a_relief_is_one_closed_body() {
    for side in ["inward", "outward", "center"] {
        let (volume, euler) = solid(&json!({
            "contour": { "circle": 2 }, "trajectory": { "line": [[0, 0, 0], [0, 0, 5]] },
            "wall": { "thickness": 0.4, "side": side },
            "depth": { "mode": "offset", "terms": [{ "amp": 0.2, "u": 5 }] },
            "mesh": { "rows": 4, "cols": 400 },
        }));
        let outer: f64 = match side {
            "inward" => 2.0,
            "outward" => 2.4,
            _ => 2.2,
        };
        let expected = 5.0 * PI * (outer * outer + 0.02 - (outer - 0.4).powi(2));
        assert!((volume / expected - 1.0).abs() < 1e-3 && euler == 0, "{side} {volume} {expected}");
    }
}

#[test]
fn a_wall_of_a_square_has_the_volume_of_the_difference() {
    for (side, area) in
        [("inward", 16.0 - 9.0), ("outward", 25.0 - 16.0), ("center", 20.25 - 12.25)]
    {
        let (volume, euler) = solid(&json!({
            "contour": { "polyline": { "closed": true, "points": [[2, 2], [-2, 2], [-2, -2], [2, -2]] } },
            "trajectory": { "line": [[0, 0, 0], [3, 0, 0]] }, "wall": { "thickness": 0.5, "side": side },
            "mesh": { "rows": 3, "cols": 24 },
        }));
        assert!((volume - 3.0 * area).abs() < 1e-5 && euler == 0, "{side} {volume}");
    }
}

#[test]
fn lids_pass_through_a_file() {
    let grids = grids(&json!({
        "contour": { "loops": [{ "circle": 2 }, { "circle": 0.5, "offset": [1, 0] }, { "circle": 0.5, "offset": [-1, 0] }] },
        "trajectory": { "line": [[0, 0, 0], [0, 0, 1]] }, "caps": flat(), "mesh": { "rows": 2, "cols": 16 },
    }));
    for encoding in [Encoding::Binary, Encoding::Json] {
        let mut bytes = Vec::new();
        write_all(&grids, encoding, &mut bytes).unwrap();
        let read = read_all("a.grid", bytes.as_slice()).unwrap();
        assert_eq!(read, grids);
        let options = Options::default();
        assert_eq!(
            mesh(read.as_slice(), &options).unwrap(),
            mesh(grids.as_slice(), &options).unwrap()
        );
    }
}

/// A chisel is a wedge of five faces: half the prism.
#[test]
fn a_scale_of_0_on_one_axis_makes_a_closed_edge() {
    for (contour, area) in [
        (
            json!({ "polyline": { "closed": true, "points": [[5, -3], [5, 3], [-5, 3], [-5, -3]] } }),
            60.0,
        ),
        (json!({ "circle": 2 }), 4.0 * PI),
    ] {
        for mesh in [json!({ "rows": 4, "cols": 200 }), json!({ "tol": 0.001, "angle_deg": 8 })] {
            let (volume, euler) = solid(&json!({
                "contour": contour, "trajectory": { "line": [[0, 0, 0], [0, 0, 5]] },
                "scale": [1, { "keys": [[0, 1], [1, 0]] }], "caps": { "start": "flat" }, "mesh": mesh,
            }));
            assert!((volume / (2.5 * area) - 1.0).abs() < 1e-3 && euler == 2, "{volume} {euler}");
        }
    }
}

/// A spring with closed ends, a conical spring, and a helix of the other hand.
#[test]
fn helices_with_laws_are_tubes_of_their_length() {
    let length = |helix: Value| {
        let grids = grids(&json!({
            "contour": { "circle": 0.1 }, "trajectory": { "helix": helix }, "caps": flat(),
            "mesh": { "rows": 600, "cols": 48 },
        }));
        let mesh = mesh(grids.as_slice(), &Options::default()).unwrap();
        let topology = Topology::of(&mesh);
        assert!(topology.closed && topology.manifold);
        volume(&mesh) / (PI * 0.01)
    };
    // The length of a conical helix by a sum of a million steps.
    let cone = |t: f64| {
        DVec3::new((TAU * 3.0 * t).cos() * (2.0 - t), (TAU * 3.0 * t).sin() * (2.0 - t), 6.0 * t)
    };
    let steps = 1_000_000;
    let sum: f64 = (0..steps)
        .map(|i| {
            cone(f64::from(i) / f64::from(steps))
                .distance(cone(f64::from(i + 1) / f64::from(steps)))
        })
        .sum();
    let found = length(json!({ "radius": { "keys": [[0, 2], [1, 1]] }, "rise": 2, "turns": 3 }));
    assert!((found / sum - 1.0).abs() < 5e-3, "{found} {sum}");
    let plain = [3.0, -3.0]
        .map(|turns| length(json!({ "radius": 2, "rise": 1, "turns": turns, "start_deg": 30 })));
    let expected = 3.0 * (4.0 * PI).hypot(1.0);
    assert!(
        plain.iter().all(|found| (found / expected - 1.0).abs() < 5e-3),
        "{plain:?} {expected}"
    );
}

/// Positive turns are right-handed: seen from the tip of the axis the helix runs counter-clockwise as it rises.
#[test]
fn positive_turns_are_right_handed() {
    for (turns, hand) in [(0.25, 1.0), (-0.25, -1.0)] {
        let grids = grids(&json!({
            "contour": { "circle": 0.1 },
            "trajectory": { "helix": { "radius": 1, "rise": 1, "turns": turns, "axis": [0, 0, 1] } },
            "mesh": { "rows": 8, "cols": 8 },
        }));
        let cols = grids[0].cols();
        let middle = |row: &[DVec3]| row.iter().sum::<DVec3>() / cols as f64;
        let rows: Vec<DVec3> = grids[0].positions.chunks(cols).map(middle).collect();
        let turn = rows[0].cross(rows[rows.len() - 1]).z;
        assert!(turn * hand > 0.9, "{turns}: {turn}");
    }
}

/// A knot by formulas has the length of its curve.
#[test]
fn a_knot_by_formulas_is_closed() {
    let (volume, euler) = solid(&json!({
        "contour": { "circle": 0.1 },
        "trajectory": { "formula": { "x": "(2 + cos(3*t)) * cos(2*t)", "y": "(2 + cos(3*t)) * sin(2*t)", "z": "sin(3*t)",
            "t": [0, TAU], "closed": true } },
        "mesh": { "rows": 800, "cols": 64 },
    }));
    let point = |t: f64| {
        let r = 2.0 + (3.0 * t).cos();
        DVec3::new(r * (2.0 * t).cos(), r * (2.0 * t).sin(), (3.0 * t).sin())
    };
    let steps = 100_000;
    let at = |i: i32| point(TAU * f64::from(i) / f64::from(steps));
    let length: f64 = (0..steps).map(|i| at(i).distance(at(i + 1))).sum();
    assert!((volume / (PI * 0.01 * length) - 1.0).abs() < 5e-3 && euler == 0, "{volume} {euler}");
}

/// Radii at the points of a polyline make cones between them.
#[test]
fn radii_at_points_are_those_of_the_sections() {
    let points = [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.0, 0.0, 2.5], [0.0, 0.0, 5.0]];
    let radii = [0.5, 0.25, 0.5, 0.125];
    let (volume, euler) = solid(&json!({
        "contour": { "circle": 1 }, "trajectory": { "polyline": { "points": points, "radii": radii } },
        "caps": flat(), "mesh": { "tol": 1e-4 },
    }));
    let cone = |a: f64, b: f64, h: f64| PI * h / 3.0 * (a * a + a * b + b * b);
    let expected = cone(0.5, 0.25, 2.0) + cone(0.25, 0.5, 0.5) + cone(0.5, 0.125, 2.5);
    assert!((volume / expected - 1.0).abs() < 1e-3 && euler == 2, "{volume} {expected}");
}

/// Returns a closed polygon with a random radius for each of its points.
fn ring(radii: &[f64], size: f64) -> Vec<[f64; 2]> {
    let count = radii.len() as f64;
    (0..radii.len())
        .map(|i| {
            let (sin, cos) = (TAU * i as f64 / count).sin_cos();
            [size * radii[i] * cos, size * radii[i] * sin]
        })
        .collect()
}

fn area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// An outline with a hole, swept along a line, has the volume of its area times its length.
    #[test]
    fn random_outlines_with_holes_are_closed_and_have_their_volume(
        outline in prop::collection::vec(0.55..1.0, 3..30),
        hole in prop::collection::vec(0.3..1.0, 3..12),
        end in (-3.0..3.0, -3.0..3.0, 1.0..5.0),
        cols in 1_usize..120,
    ) {
        // The chord between two points of the outline may lie at half their distance from the middle.
        let (outer, inner) = (ring(&outline, 2.0), ring(&hole, 0.25));
        let loops = json!([
            { "polyline": { "closed": true, "points": outer } },
            { "polyline": { "closed": true, "points": inner } },
        ]);
        let (x, y, z) = end;
        let length = f64::hypot(f64::hypot(x, y), z);
        let mesh = json!({ "rows": 4, "cols": cols.max(outline.len()).max(hole.len()) });
        let keys = json!({
            "contour": { "loops": loops }, "trajectory": { "line": [[0, 0, 0], [x, y, z]] },
            "caps": flat(), "mesh": mesh,
        });
        let (volume, euler) = solid(&keys);
        let expected = (area(&outer) - area(&inner)) * length;
        prop_assert_eq!(euler, 0);
        // A corner of less than a degree is no column, and a cell cuts it off.
        prop_assert!((volume / expected - 1.0).abs() < 1e-3, "{} {}", volume, expected);
    }
}
