//! Closed surfaces, each with the expected result in the name of its test.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use glam::DVec3;
use serde_json::{Value, json};
use sweep::grid::Seam;
use sweep::{Sweep, SweepError};

fn read(keys: &Value) -> Result<Sweep, SweepError> {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test", "mesh": {"rows": 36, "cols": 24},
    });
    for (key, value) in keys.as_object().unwrap() {
        spec[key] = value.clone();
    }
    Sweep::read(&Document::new("test", spec.to_string().as_bytes()).unwrap())
}

fn swept(keys: &Value) -> Sweep {
    read(keys).unwrap_or_else(|error| panic!("{error}\n{keys}"))
}

fn example(name: &str) -> Value {
    let path = format!("{}/../examples/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let mut spec: Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    // Areas count cells, and the cells here differ.
    spec.as_object_mut().unwrap().remove("areas");
    spec
}

/// Returns the largest distance from a column's end to the point of the start with which it joins,
/// in units of eps x (size + |position|). The size is that of the bounding box, and the position
/// that of the farthest point.
fn gap(sweep: &Sweep) -> f64 {
    let grid = sweep.grid();
    assert_ne!(grid.seam_v, Seam::Open);
    let (low, high) = grid
        .positions
        .iter()
        .fold((DVec3::MAX, DVec3::MIN), |(low, high), &p| (low.min(p), high.max(p)));
    let size =
        (high - low).length() + grid.positions.iter().map(|p| p.length()).fold(0.0, f64::max);
    let off = (0..grid.cols()).map(|col| {
        let led = grid.seam_v.leads_to(col, grid.shift, grid.cols());
        // A crease is two columns at one point.
        (sweep.at(grid.u[col], 1.0).0 - grid.positions[led]).length()
    });
    off.fold(0.0, f64::max) / (f64::EPSILON * size)
}

/// Returns a closed spline through the points of a torus knot.
fn knot(count: u32, p: f64, q: f64) -> Value {
    let point = |i: u32| {
        let t = std::f64::consts::TAU * f64::from(i) / f64::from(count);
        let r = 2.0 + (q * t).cos();
        [r * (p * t).cos(), r * (p * t).sin(), -(q * t).sin()]
    };
    json!({"free": {"closed": true, "points": (0..count).map(point).collect::<Vec<_>>()}})
}

/// Returns a clover of three leaves: six cubics, each the preceding one rotated by a sixth of a
/// turn and mirrored.
fn clover() -> Value {
    let [tip, dent] = [0.4, 0.2];
    let polar = |r: f64, turn: f64, side: f64| {
        let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
        [r * cos - side * sin, r * sin + side * cos]
    };
    let segments: Vec<Value> = (0..6)
        .map(|i| {
            let (from, to) = (f64::from(i) / 6.0, f64::from(i + 1) / 6.0);
            let (a, b) = if i % 2 == 0 { (tip, dent) } else { (dent, tip) };
            json!([polar(a, from, 0.0), polar(a, from, 0.1), polar(b, to, -0.1), polar(b, to, 0.0)])
        })
        .collect();
    json!({"bezier": {"closed": true, "segments": segments}})
}

fn eight() -> Value {
    example("figure-eight-klein")["contour"].clone()
}

fn seams() -> Vec<Value> {
    let round = json!({"circle": 0.2});
    let square = json!({"polyline": {"closed": true, "points": [[0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2], [0.2, -0.2]]}});
    let strip = json!({"svg": "M-.3 0H.3"});
    let mut all = Vec::new();
    let ring = json!({"free": {"closed": true, "points":
        [[4, 0, 0], [1, 2, 4], [-4, 0.5, -1], [-2, -2, -4], [3, 1, -3]]}});
    let bezier = example("trefoil")["trajectory"].clone();
    let circle = json!({"circle": {"radius": 2, "center": [0.1, 0.2, 0.3], "axis": [1, 2, 3]}});
    let mitred = json!({"polyline": {"closed": true, "points": [[2, 0, 0], [4, 0, 0], [4, 3, 0.5], [0, 3, 0], [0, 0, 0]],
        "corners": {"mitre": 9}}});
    let rounded = json!({"polyline": {"closed": true, "points": [[2, 0, 0], [4, 0, 0], [4, 3, 0.5], [0, 3, 0], [0, 0, 0]],
        "corners": {"round": 0.7}}});
    let flat = json!({"flat": {"curve": {"svg": "M0 0C2 -3 5 -3 5 0S2 3 0 0S-5 -3 -5 0S-2 3 0 0Z"},
        "z": {"keys": [[0, 0.5], [0.5, -0.5], [1, 0.5]], "ease": "smooth"}}});
    for trajectory in [&ring, &bezier, &circle, &mitred, &rounded, &flat, &knot(40, 2.0, 5.0)] {
        for contour in [&round, &square] {
            all.push(json!({"contour": contour, "trajectory": trajectory}));
            all.push(json!({"contour": contour, "trajectory": trajectory, "twist": {"total": 720},
                "scale": {"keys": [[0, 1], [0.5, 0.7], [1, 1]], "ease": "smooth"}, "position": [100, 3, -7]}));
            all.push(json!({"contour": contour, "trajectory": trajectory, "seam": "shift"}));
        }
        all.push(json!({"contour": clover(), "trajectory": trajectory, "seam": "shift"}));
        all.push(json!({"contour": eight(), "trajectory": trajectory, "seam": "mirror"}));
        all.push(json!({"contour": strip, "trajectory": trajectory, "seam": "mirror"}));
    }
    all.push(
        json!({"contour": square, "trajectory": circle, "seam": "shift", "twist": {"total": 450}}),
    );
    all.push(json!({"contour": clover(), "trajectory": circle, "seam": "shift", "twist": {"total": 120}}));
    for name in
        ["klein-bottle", "figure-eight-klein", "moebius-band", "trefoil", "figure-eight", "vase"]
    {
        all.push(example(name));
    }
    all
}

#[test]
fn closed_shifted_and_mirrored_surfaces_meet_within_four_ulp_of_their_size() {
    let mut worst = 0.0_f64;
    for spec in seams() {
        let gap = gap(&swept(&spec));
        assert!(gap <= 4.0, "{gap:.2} {spec}");
        worst = worst.max(gap);
    }
    println!("the worst gap is {worst:.2} eps x (size + |position|)");
}

/// Returns a path along edges of cubes whose frame returns rotated by exactly half a turn. Each
/// corner is a quarter turn about an axis. The path starts in the middle of an edge.
fn half_turned(off: f64) -> Vec<[f64; 3]> {
    vec![
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 2.0, off],
        [4.0, 2.0, 0.0],
        [4.0, 0.0, 0.0],
        [3.0, 0.0, off],
        [3.0, 0.0, 3.0],
        [0.0, 0.0, 3.0],
        [0.0, 0.0, 0.0],
    ]
}

#[test]
fn half_a_turn_of_holonomy_is_undone_the_same_way_whatever_rounding_says_and_whichever_way_it_runs()
{
    let frames = |points: &[[f64; 3]]| {
        let sweep = swept(&json!({
            "contour": {"circle": 0.1}, "frame": {"start": [0.1, 0.7, 0.2]},
            "trajectory": {"polyline": {"closed": true, "points": points, "corners": {"round": 0.4}}},
        }));
        (0..=200)
            .map(|i| sweep.trajectory().station(f64::from(i) / 200.0).frame)
            .collect::<Vec<_>>()
    };
    let along = frames(&half_turned(0.0));
    // There is a half turn to undo: after transport along the path, the last frame is opposite to
    // the first one.
    let middle = along[100];
    assert!(middle.normal.is_finite());
    for off in [0.0, 1e-15, -1e-15, 1e-12, -1e-12] {
        let points = half_turned(off);
        let mut back = points.clone();
        back[1..].reverse();
        for (a, b) in along.iter().zip(frames(&points)) {
            assert!((a.normal - b.normal).length() < 1e-9, "{off:e}");
        }
        for (a, b) in along.iter().zip(frames(&back).iter().rev()) {
            assert!((a.normal - b.normal).length() < 1e-9, "{off:e} reversed");
        }
    }
}

#[test]
fn an_odd_number_of_columns_of_a_klein_bottle_is_made_even() {
    for cols in [7, 33, 69, 70] {
        let mut spec = example("klein-bottle");
        spec["mesh"] = json!({"rows": 40, "cols": cols});
        let sweep = swept(&spec);
        assert_eq!(sweep.cols(), cols + cols % 2);
        assert!(gap(&sweep) <= 4.0);
    }
}

#[test]
fn a_klein_bottle_of_an_asymmetric_contour_is_refused_with_its_mismatch() {
    let mut spec = example("klein-bottle");
    spec["contour"] = json!({"free": {"closed": true, "points": [[1, 0], [0.3, 0.9], [-0.8, 0.2], [-0.1, -0.5]]}});
    let error = read(&spec).unwrap_err().to_string();
    assert!(error.contains("seam: found a contour that differs by"), "{error}");
    assert!(
        error.contains("of its size from the contour at the start when turned and mirrored"),
        "{error}"
    );
}

#[test]
fn a_clover_on_a_trefoil_closes_with_a_shift_of_thirds_and_turns_a_sixth_at_most() {
    for (rows, cols) in [(60, 24), (41, 30)] {
        let sweep = swept(&json!({
            "contour": clover(), "trajectory": example("trefoil")["trajectory"], "seam": "shift",
            "mesh": {"rows": rows, "cols": cols},
        }));
        let grid = sweep.grid();
        assert_eq!(grid.seam_v, Seam::Closed);
        assert_eq!(3 * grid.shift % grid.cols(), 0, "a third or two, or none");
        assert!(gap(&sweep) <= 4.0);
    }
}

#[test]
fn nearly_closed_trajectories_are_closed_below_a_millionth_of_their_size_and_refused_above() {
    for exponent in 3..=15 {
        let off = 10_f64.powi(-exponent);
        // A seam, and a curve declared as closed.
        let mut klein = example("klein-bottle");
        klein["trajectory"]["bezier"]["segments"][3][3] = json!([0, off, 0]);
        let half = [[0.0, 0.0, 0.0], [0.0, 2.0, 1.0], [3.0, 2.0, 0.0], [3.0, 0.0, 0.0]];
        let back = [[3.0, 0.0, 0.0], [3.0, -2.0, 0.0], [0.0, -2.0, -1.0], [off, 0.0, 0.0]];
        let ring = json!({"contour": {"circle": 0.1}, "trajectory": {"bezier": {"closed": true, "segments": [half, back]}}});
        for (spec, complaint) in [(klein, "from its start"), (ring, "where a closed curve starts")]
        {
            match read(&spec) {
                Ok(sweep) => {
                    // The limit is a millionth of the extent, which is between 1 and 10.
                    assert!(off < 1e-5, "{off:e}");
                    let torn = gap(&sweep) * f64::EPSILON;
                    assert!(torn <= off + 4.0 * f64::EPSILON, "{torn:e} at {off:e}");
                }
                Err(error) => {
                    assert!(off > 1e-7, "{off:e}");
                    assert!(error.to_string().contains(complaint), "{error}");
                }
            }
        }
    }
}
