//! Numbers of cells that a tolerance needs on surfaces with edges, folds and warped sides, and rows that are one.

use files::json::Document;
use proptest::prelude::*;
use serde_json::{Value, json};
use sweep::Sweep;
use sweep::check::{Severity, strands};

fn sweep(keys: &Value) -> Sweep {
    let mut spec = json!({ "format": "tb-sweep", "version": 1, "name": "a" });
    for (key, value) in keys.as_object().unwrap() {
        spec[key] = value.clone();
    }
    let text = spec.to_string();
    Sweep::read(&Document::new("a.json", text.as_bytes()).unwrap()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// Points of the two rows of a mitre have the same bits, so that they become one vertex.
    #[test]
    fn both_rows_of_a_mitre_have_the_same_points(
        turns in prop::collection::vec((-1.2..1.2_f64, -1.2..1.2_f64, 2.0..5.0_f64), 2..6),
    ) {
        let (mut at, mut yaw, mut pitch) = ([0.0; 3], 0.3_f64, 0.2_f64);
        let mut points = vec![at];
        for (a, b, length) in turns {
            at[0] += length * yaw.cos() * pitch.cos();
            at[1] += length * pitch.sin();
            at[2] += length * yaw.sin() * pitch.cos();
            points.push(at);
            (yaw, pitch) = (yaw + a, f64::clamp(pitch + b, -1.0, 1.0));
        }
        let sweep = sweep(&json!({
            "contour": { "circle": 0.3 },
            "trajectory": { "polyline": { "points": points, "corners": { "mitre": 9 } } },
            "caps": { "start": "flat", "end": "flat" }, "mesh": { "rows": 12, "cols": 8 },
        }));
        let grid = sweep.grid();
        let cols = grid.cols();
        for row in 1..grid.rows() {
            let [before, here] = [row - 1, row].map(|row| &grid.positions[row * cols..(row + 1) * cols]);
            if grid.v[row] == grid.v[row - 1] {
                prop_assert_eq!(before, here);
            } else {
                prop_assert!(before.iter().zip(here).any(|(a, b)| a.distance(*b) > 1e-3));
            }
        }
    }
}

/// A cone between two cylinders needs one row for each and no more columns than a cylinder.
#[test]
fn a_linear_taper_is_cut_at_its_ends() {
    let sweep = sweep(&json!({
        "contour": { "circle": 1 }, "trajectory": { "line": [[0, -2, 0], [0, 4, 0]] },
        "deform": [{ "taper": { "from": 0, "to": 2, "factor": { "keys": [[0, 1], [1, 0.5]] } } }],
        "mesh": { "tol": 0.01, "angle_deg": 8 },
    }));
    let reached = sweep.reached().unwrap();
    assert!(reached.kept && sweep.rows() == 3 && sweep.cols() <= 40, "{reached:?}");
    let grid = sweep.grid();
    for height in [0.0, 2.0] {
        let on = |p: &&glam::DVec3| (p.y - height).abs() < 1e-12;
        assert_eq!(grid.positions.iter().filter(on).count(), grid.cols());
    }
}

/// On a rotation the heights of a taper are columns.
#[test]
fn a_taper_of_a_rotation_is_cut_along_columns() {
    let sweep = sweep(&json!({
        "contour": { "polyline": { "points": [[1, -2], [1, 4]] } }, "trajectory": { "rotation": {} },
        "deform": [{ "taper": { "from": 0, "to": 2, "factor": { "keys": [[0, 1], [1, 0.5]] } } }],
        "mesh": { "tol": 0.01, "angle_deg": 8 },
    }));
    let reached = sweep.reached().unwrap();
    assert!(reached.kept && sweep.cols() == 3 && sweep.rows() <= 50, "{reached:?}");
}

/// An edge across the cells cannot keep an angle: the search ends, and the check names the deformation.
#[test]
fn an_edge_across_the_cells_ends_the_search_and_is_named() {
    let sweep = sweep(&json!({
        "contour": { "circle": 0.5 }, "trajectory": { "circle": { "radius": 3, "axis": [0, 0, 1] } },
        "deform": [{ "taper": { "from": -1, "to": 1, "factor": { "keys": [[0, 1], [1, 0.5]] } } }],
        "mesh": { "tol": 0.01, "angle_deg": 6 },
    }));
    let reached = sweep.reached().unwrap();
    assert!(!reached.kept && reached.tol <= 0.01 && reached.quads < 20_000, "{reached:?}");
    let findings = sweep::check::of_sweep(&sweep, &sweep.grid());
    let named = |finding: &&sweep::check::Finding| finding.path == "deform[0]";
    assert_eq!(findings.iter().filter(named).count(), 1, "{findings:?}");
}

#[test]
fn folds_take_no_cells_for_an_angle() {
    let sweep = sweep(&json!({
        "contour": { "circle": 1.2 },
        "trajectory": { "free": { "points": [[0, 0, 0], [4, 0, 0], [4.5, 2, 0], [2, 3, 0]] } },
        "mesh": { "tol": 0.01, "angle_deg": 8 },
    }));
    let quads = sweep.reached().unwrap().quads;
    assert!(quads < 3000, "{quads}");
    let wrong = sweep.survey().findings();
    assert!(wrong.iter().any(|finding| finding.severity == Severity::Wrong), "{wrong:?}");
}

/// Radii at the corners of a track, whose positions are computed in another order than the corners'.
#[test]
fn a_key_within_rounding_of_a_corner_is_at_the_corner() {
    let points: Vec<[f64; 3]> = (0..60)
        .map(|i| {
            let i = f64::from(i);
            [i, 0.3 * (i * 1.7).sin(), 0.3 * (i * 2.9).cos()]
        })
        .collect();
    let length =
        |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt();
    let steps: Vec<f64> = points.windows(2).map(|ends| length(&ends[0], &ends[1])).collect();
    let whole: f64 = steps.iter().sum();
    for off in [0.0, 1e-16, 3e-8] {
        let keys: Vec<[f64; 2]> = (0..60)
            .map(|i| {
                let rest: f64 = steps[i..].iter().rev().sum();
                let at = (1.0 - rest / whole + off).clamp(0.0, 1.0);
                [at, 0.1 + 0.02 * (i as f64 * 0.9).sin()]
            })
            .collect();
        let sweep = sweep(&json!({
            "contour": { "circle": 1 },
            "trajectory": { "polyline": { "points": points, "corners": { "mitre": 4 } } },
            "scale": { "keys": keys }, "mesh": { "tol": 0.01 },
        }));
        let reached = sweep.reached().unwrap();
        assert!(reached.kept && sweep.rows() <= 80 && reached.quads < 1500, "{off} {reached:?}");
    }
}

/// A warped plate is split across as well as along. Split along only, it takes 668 x 4 cells. Cells of
/// w x h miss the plate by `w h` times a quarter of the turn per length, so that 79 x 22 cells suffice; the search finds 1840.
#[test]
fn a_warped_plate_is_split_in_both_directions() {
    let sweep = sweep(&json!({
        "contour": { "polyline": { "closed": true, "points": [[5, -0.1], [5, 0.1], [-5, 0.1], [-5, -0.1]] } },
        "trajectory": { "line": [[0, 0, 0], [0, 0, 50]] }, "twist": { "total": 360 },
        "caps": { "start": "flat", "end": "flat" }, "mesh": { "tol": 0.02 },
    }));
    let reached = sweep.reached().unwrap();
    assert!(reached.kept && reached.quads <= 1850, "{reached:?}");
}

#[test]
fn flat_sides_do_not_cross_and_strands_do() {
    let crossing = |keys: &Value| strands::findings(&sweep(keys).grid(), &|_, _| {}).is_some();
    for end in [[5, 3, 11], [4, 0, 7], [-3, 5, 2], [1000, 2, 3]] {
        for (rows, cols) in [(400, 12), (5, 24), (200, 48)] {
            for contour in [
                json!({ "polyline": { "closed": true, "points": [[-1, -2.9], [2, 0], [-1, 2.9]] } }),
                json!({ "circle": 0.7 }),
            ] {
                let spec = json!({
                    "contour": contour, "trajectory": { "line": [[4, 0, 0], end] },
                    "caps": { "start": "flat", "end": "flat" }, "mesh": { "rows": rows, "cols": cols },
                });
                assert!(!crossing(&spec), "{spec}");
            }
        }
    }
    let loop_of = |height: f64| {
        json!({
            "contour": { "circle": 0.4 },
            "trajectory": { "free": { "points": [[-4, 0, 0], [1, 0, 0], [3, 2, 0], [1, 3, 0], [0, 1, height], [0, -4, height]] } },
            "mesh": { "rows": 80, "cols": 16 },
        })
    };
    assert!(crossing(&loop_of(0.3)) && !crossing(&loop_of(2.0)));
}
