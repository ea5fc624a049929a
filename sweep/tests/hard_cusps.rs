//! Curves whose speed nearly vanishes: their lengths by an independent quadrature, and finite
//! surfaces.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use fixtures::rounding::UNIT;
use glam::DVec3;
use serde_json::{Value, json};
use sweep::{Sweep, SweepError};

fn read(trajectory: &Value) -> Result<Sweep, SweepError> {
    let spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test", "contour": {"circle": 0.01},
        "trajectory": trajectory, "mesh": {"rows": 64, "cols": 8},
    });
    Sweep::read(&Document::new("test", spec.to_string().as_bytes()).unwrap())
}

/// Returns the length by Simpson's rule on panels that halve toward `slow`, where the speed is
/// least. Each panel is as wide as its distance from that point, so that the speed is smooth on the
/// panel, however small the speed is.
fn length(points: [[f64; 3]; 4], slow: f64) -> f64 {
    let p = points.map(DVec3::from_array);
    let [a, b, c] = [p[1] - p[0], p[2] - p[1], p[3] - p[2]];
    let speed = |t: f64| {
        let s = 1.0 - t;
        3.0 * (a * (s * s) + b * (2.0 * s * t) + c * (t * t)).length()
    };
    let side = |span: f64| {
        let panel = |k: i32| {
            let (near, far) = (2_f64.powi(-k - 1), 2_f64.powi(-k));
            let near = if k == 50 { 0.0 } else { near };
            let steps = 256;
            let h = (far - near) / f64::from(steps);
            let at = |i: i32| speed(slow + span * (near + h * f64::from(i)));
            let inner: f64 = (1..steps).map(|i| at(i) * if i % 2 == 1 { 4.0 } else { 2.0 }).sum();
            (at(0) + inner + at(steps)) * h.abs() / 3.0
        };
        span.abs() * (0..=50).rev().map(panel).sum::<f64>()
    };
    side(-slow) + side(1.0 - slow)
}

#[test]
fn near_cusps_from_a_hundredth_to_a_billionth_of_a_thousandth_have_their_length_to_1e_9() {
    for exponent in 1..=12 {
        let gap = 10_f64.powi(-exponent);
        for z in [0.0, 0.5 * gap] {
            // The velocity in the middle is (1.5 gap, 0, z). The ends of the curve are far from
            // this point.
            let curve = [[0.0, 0.0, 0.0], [1.0 - gap, 1.0, 0.0], [gap, 1.0, z], [1.0, 0.0, z]];
            let truth = length(curve, 0.5);
            match read(&json!({"bezier": {"segments": [curve]}})) {
                Ok(sweep) => {
                    let error = sweep.trajectory().length() / truth - 1.0;

                    assert!(error.abs() < 1e-9, "{gap:e}: {error:e}");
                    let grid = sweep.grid();
                    assert!(grid.positions.iter().all(|p| p.is_finite()));
                    assert!(grid.normals.iter().all(|n| (n.length() - 1.0).abs() < UNIT));
                }
                // Below a limit of the gap the curve has a cusp, which the error names.
                Err(error) => {
                    assert!(gap < 1e-8 && error.to_string().contains("found a cusp"), "{error}");
                }
            }
            // With rounded corners the spec is valid for any gap.
            let rounded = json!({"bezier": {"segments": [curve], "corners": {"round": 0.05}}});
            let sweep = read(&rounded).unwrap_or_else(|error| panic!("{gap:e}: {error}"));
            assert!(sweep.grid().positions.iter().all(|p| p.is_finite()));
        }
    }
}

#[test]
fn slow_ends_have_their_length_to_1e_9() {
    for exponent in 1..=15 {
        let gap = 10_f64.powi(-exponent);
        let curve = [[0.0, 0.0, 0.0], [gap, 0.0, 0.0], [1.0, 1.0, 0.3], [2.0, 0.0, 1.0]];
        let sweep = read(&json!({"bezier": {"segments": [curve]}})).unwrap();
        let error = sweep.trajectory().length() / length(curve, 0.0) - 1.0;
        assert!(error.abs() < 1e-9, "{gap:e}: {error:e}");
    }
}
