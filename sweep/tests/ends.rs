//! Caps and deformations: the ends of a sweep, and the last stage of its construction.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use fixtures::rounding::{NORMAL, UNIT};
use glam::DVec3;
use serde_json::{Value, json};
use sweep::grid::file::{self, Encoding};
use sweep::{Sweep, SweepError};

fn read(keys: &Value) -> Result<Sweep, SweepError> {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test",
        "contour": {"circle": 0.5}, "trajectory": {"line": [[0, 0, 0], [0, 0, 2]]},
        "mesh": {"rows": 40, "cols": 24},
    });
    for (key, value) in keys.as_object().unwrap() {
        spec[key] = value.clone();
    }
    let text = spec.to_string();
    Sweep::read(&Document::new("test", text.as_bytes()).unwrap())
}

fn swept(keys: &Value) -> Sweep {
    read(keys).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn round_caps_on_a_tube_are_half_spheres() {
    let sweep = swept(&json!({"caps": {"start": "round", "end": {"dome": 0.5}}}));
    let grid = sweep.grid();
    for (point, normal) in grid.positions.iter().zip(&grid.normals) {
        let axis = DVec3::Z * point.z.clamp(0.0, 2.0);
        let away = *point - axis;
        assert!((away.length() - 0.5).abs() < 1e-14, "{point}");
        assert!((away * 2.0 - normal.as_dvec3()).length() < NORMAL, "{point} {normal}");
    }
    let (first, last) = (grid.positions[0], *grid.positions.last().unwrap());
    assert!((first - DVec3::new(0.0, 0.0, -0.5)).length() < 1e-14);
    assert!((last - DVec3::new(0.0, 0.0, 2.5)).length() < 1e-14);
    assert!(grid.positions[..24].iter().all(|p| *p == first), "a pole is one point");
    // Arcs of pi / 4 beside a tube of 2: the rows are distributed by length.
    let cap = grid.v.iter().filter(|&&v| v > 0.0 && v < 0.2).count();
    assert!((8..=9).contains(&cap), "{cap}");
}

#[test]
fn flat_caps_and_poles_have_the_normals_of_disks_and_cones() {
    let sweep = swept(&json!({"caps": {"start": "flat", "end": {"pole": 1.2}}}));
    let grid = sweep.grid();
    for (i, (point, normal)) in grid.positions.iter().zip(&grid.normals).enumerate() {
        let normal = normal.as_dvec3();
        let out = DVec3::new(
            (std::f64::consts::TAU * grid.u[i % 24]).cos(),
            (std::f64::consts::TAU * grid.u[i % 24]).sin(),
            0.0,
        );
        if point.z > 2.0 {
            let cone = (out * 1.2 + DVec3::Z * 0.5) / 1.3;
            assert!((normal - cone).length() < NORMAL, "{point}: {normal}");
        } else if point.truncate().length() < 0.49 {
            assert!((normal + DVec3::Z).length() < NORMAL && point.z == 0.0, "{point}: {normal}");
        }
    }
    // Each rim has the normals of both sides.
    let rims = grid.v.windows(2).filter(|pair| pair[0] == pair[1]).count();
    assert_eq!(rims, 2);
}

#[test]
fn caps_stand_on_what_laws_have_made_of_the_contour() {
    let sweep = swept(&json!({
        "contour": {"svg": "M1 .2H-1V-.2H1Z"}, "scale": [{"keys": [[0, 1], [1, 0.5]]}, 1],
        "twist": {"total": 90}, "caps": {"end": {"dome": 0.3}},
        "deform": [{"bend": {"axis": [0, 0, 1], "from": 0, "to": 2, "degrees": 90, "toward": [1, 0, 0]}}],
    }));
    let grid = sweep.grid();
    let top = *grid.positions.last().unwrap();
    // A quarter of a circle of length 2, and a straight piece of 0.3.
    let radius = 4.0 / std::f64::consts::PI;
    assert!((top - DVec3::new(radius + 0.3, 0.0, radius)).length() < 1e-12, "{top}");
    assert!(grid.normals.iter().all(|n| (n.length() - 1.0).abs() < UNIT));
    assert!((grid.normals.last().unwrap().as_dvec3() - DVec3::X).length() < NORMAL);
}

#[test]
fn the_rim_of_a_cap_is_the_last_section_to_the_last_bit() {
    // A side cut in its middle has a corner near 0, where every bit of an added number remains.
    let half = 0.137_106_272_763_016_76;
    let sweep = swept(&json!({
        "contour": {"polyline": {"closed": true, "points":
            [[0.14, -half], [0.14, half], [-0.14, half], [-half, -0.14]]}},
        "trajectory": {"circle": {"angle_deg": 250, "radius": 1.5}}, "scale": -0.8,
        "caps": {"start": "flat", "end": {"dome": 0.1}},
    }));
    let grid = sweep.grid();
    let cols = grid.u.len();
    let rims = (1..grid.v.len()).filter(|&row| grid.v[row] == grid.v[row - 1]);
    let mut seen = 0;
    for row in rims {
        let [before, after] = [row - 1, row].map(|row| &grid.positions[row * cols..][..cols]);
        assert_eq!(before, after);
        seen += 1;
    }
    assert_eq!(seen, 2);
}

#[test]
fn caps_are_refused_where_they_would_not_close_anything() {
    for (keys, message) in [
        (json!({"trajectory": {"circle": {"radius": 2}}}), "caps: found a closed trajectory"),
        (
            json!({"trajectory": {"rotation": {}}, "contour": {"svg": "M1 0V1"}}),
            "caps: found a rotation",
        ),
        (json!({"contour": {"svg": "M1 0V1"}}), "caps: found an open contour"),
        (
            json!({"scale": {"total": 1}}),
            "caps.start: found a cap on a section that is not star-shaped",
        ),
        (json!({"contour": {"svg": "M0 0L2 2V0L0 2Z"}}), "caps.start: found a cap on a section"),
        (json!({"caps": {"start": {"dome": -1}}}), "caps.start.dome: found -1.0"),
        (json!({"caps": {"start": "roof"}}), "caps.start: found `roof`, expected one of"),
        (
            json!({"mesh": {"rows": 2, "cols": 24}}),
            "rows: found 2, expected at least 3 one for each",
        ),
    ] {
        let mut keys = keys;
        if keys.get("caps").is_none() {
            keys["caps"] = json!({"start": "flat", "end": "flat"});
        }
        let found = read(&keys).unwrap_err().to_string();
        assert!(found.contains(message), "{found}");
    }
}

#[test]
fn an_end_that_is_pressed_to_an_edge_has_no_lid() {
    let keys = json!({
        "contour": {"circle": 0.045}, "scale": [1, {"keys": [[0, 1.6], [1, 0]]}],
        "caps": {"start": "flat", "end": "flat"}, "mesh": {"rows": 24, "cols": 24},
    });
    let sweep = swept(&keys);
    let grid = sweep.grid();
    assert!(grid.lids.is_empty(), "the edge closes its end");
    assert!(sweep::check::summary(&sweep, &grid).contains("closed at both ends"));
    file::write(&grid, Encoding::Binary, &mut Vec::new()).unwrap();
}

#[test]
fn deformations_follow_one_another() {
    let taper = json!({"taper": {"axis": [0, 0, 1], "from": 0, "to": 2, "factor": {"keys": [[0, 1], [1, 0.5]]}}});
    let turn = json!({"twist": {"axis": [0, 0, 1], "from": 0, "to": 2, "degrees": {"total": 90}}});
    let sweep = swept(&json!({"deform": [taper, turn], "position": [0, 0, 7]}));
    let (point, _) = sweep.at(0.0, 0.5);
    let expected = DVec3::new(0.375, 0.375, 0.0) * std::f64::consts::FRAC_1_SQRT_2;
    assert!((point - expected - DVec3::Z * 8.0).length() < 1e-15, "{point}");
    // A bend tighter than the tube's radius turns the tube inside out.
    let tight = |degrees: f64| {
        let bend = json!({"bend": {"axis": [0, 0, 1], "from": 0, "to": 2, "degrees": degrees, "toward": [1, 0, 0]}});
        swept(&json!({"deform": [bend]})).folded_rows()
    };
    // The bend's radius is 2 / angle, against a tube of radius 0.5.
    assert_eq!(tight(220.0), 0);
    assert_eq!(tight(240.0), 41);
}
