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
        prop_assert!((volume / expected - 1.0).abs() < 1e-5, "{} {}", volume, expected);
    }
}
