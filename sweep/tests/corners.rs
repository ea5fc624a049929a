//! Corners of trajectories: mitred, rounded or refused.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use fixtures::rounding::NORMAL;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};
use sweep::curve::cut::Stop;
use sweep::{Sweep, SweepError};

fn read(trajectory: &Value, more: &Value) -> Result<Sweep, SweepError> {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test",
        "contour": {"bezier": {"segments": [[[0.4, -0.2], [0.3, 0.3], [-0.2, 0.5], [-0.4, 0.1]]]}},
        "trajectory": trajectory, "mesh": {"rows": 24, "cols": 16},
    });
    for (key, value) in more.as_object().unwrap() {
        spec[key] = value.clone();
    }
    Sweep::read(&Document::new("test", spec.to_string().as_bytes()).unwrap())
}

fn swept(trajectory: &Value, more: &Value) -> Sweep {
    read(trajectory, more).unwrap_or_else(|error| panic!("{error}"))
}

fn polyline(closed: bool, corners: &Value) -> Value {
    let points = json!([[0, 0, 0], [4, 0, 0], [4, 3, 1], [0, 4, -1]]);
    json!({"polyline": {"closed": closed, "points": points, "corners": corners}})
}

#[test]
fn both_legs_of_a_mitre_have_the_same_ring_in_the_halving_plane() {
    for closed in [false, true] {
        let trajectory = polyline(closed, &json!({"mitre": 4}));
        for (twist, scale) in [(0.0, 1.0), (360.0, 0.5)] {
            let sweep = swept(&trajectory, &json!({"twist": {"total": twist}, "scale": scale}));
            let trajectory = sweep.trajectory();
            assert_eq!(trajectory.breaks().len(), if closed { 4 } else { 2 });
            for &at in trajectory.breaks() {
                let (before, after) = (
                    trajectory.station_at(Stop::before(at)),
                    trajectory.station_at(Stop::after(at)),
                );
                let corner = before.frame.origin;
                let plane = (before.frame.tangent + after.frame.tangent).normalize();
                for q in [DVec2::X, DVec2::new(-0.3, 0.4), DVec2::NEG_Y] {
                    let (one, other) = (before.point(q), after.point(q));
                    assert!(
                        (one - other).length() < 1e-14,
                        "{at} {q}: {:e}",
                        (one - other).length()
                    );
                    assert!((one - corner).dot(plane).abs() < 1e-14);
                }
            }
        }
    }
}

#[test]
fn a_square_frame_is_a_box_with_a_hole() {
    // Closed form: the outer side of a rectangle of 4 x 3 whose section is 0.4 wide.
    let points = json!([[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0]]);
    let ring = json!({"polyline": {"closed": true, "points": points, "corners": {"mitre": 2}}});
    let square = json!({"svg": "M.2 .1H-.2V-.1H.2Z"});
    let grid = swept(&ring, &json!({"contour": square, "frame": {"up": [0, 0, 1]}})).grid();
    let on = |x: f64, faces: [f64; 2]| faces.iter().any(|face| (x - face).abs() < 1e-14);
    for (p, n) in grid.positions.iter().zip(&grid.normals) {
        assert!(p.z.abs() <= 0.1 + 1e-14);
        let sides = on(p.x, [-0.2, 4.2])
            || on(p.x, [0.2, 3.8])
            || on(p.y, [-0.2, 3.2])
            || on(p.y, [0.2, 2.8]);
        assert!(sides || on(p.z, [-0.1, 0.1]), "{p}");
        assert!(f64::from((n.abs().max_element() - 1.0).abs()) < NORMAL, "{n}");
    }
}

#[test]
fn normals_on_mitred_legs_agree_with_differences() {
    for (closed, more) in [
        (false, json!({"twist": {"keys": [[0, 0], [1, 100]], "ease": "smooth"}})),
        (
            true,
            json!({"twist": {"total": 360}, "scale": [{"keys": [[0, 1], [0.5, 0.6], [1, 1]], "ease": "smooth"}, 0.7],
            "depth": {"mode": "factor", "terms": [{"amp": 0.1, "u": 2, "v": 3}]}}),
        ),
        (true, json!({})),
    ] {
        let sweep = swept(&polyline(closed, &json!({"mitre": 4})), &more);
        let breaks = sweep.trajectory().breaks().to_vec();
        let h = 1e-3;
        let slope = |f: &dyn Fn(f64) -> DVec3| {
            let pair = |i: f64| f(i * h) - f(-i * h);
            (pair(1.0) * 0.8 - pair(2.0) * 0.2 + pair(3.0) * (4.0 / 105.0) - pair(4.0) / 280.0) / h
        };
        for i in 0..200 {
            let (u, v) = (
                0.01 + 0.98 * (f64::from(i) * 0.755).fract(),
                0.01 + 0.98 * (f64::from(i) * 0.57).fract(),
            );
            if breaks.iter().chain(&[0.5]).any(|at| (at - v).abs() < 0.005) {
                continue;
            }
            let along_u = slope(&|d| sweep.at(u + d, v).0);
            let along_v = slope(&|d| sweep.at(u, v + d).0);
            let error = (along_u.cross(along_v).normalize() - sweep.at(u, v).1).length();
            assert!(error < 1e-9, "{more} {u} {v}: {error:e}");
        }
    }
}

#[test]
fn rounded_corners_are_arcs_between_straight_legs() {
    let points = json!([[0, 0, 0], [4, 0, 0], [4, 4, 0]]);
    let line = json!({"polyline": {"points": points, "corners": {"round": 1}}});
    let sweep = swept(&line, &json!({}));
    let trajectory = sweep.trajectory();
    assert!(trajectory.breaks().is_empty());
    let arc = std::f64::consts::FRAC_PI_2;
    // The cubic lies between the arc and 2.8e-4 outside it.
    assert!((trajectory.length() - (6.0 + arc)).abs() < 2.8e-4 * arc);
    for i in 0..=50 {
        let s = 3.0 + arc * f64::from(i) / 50.0;
        let p = trajectory.station(s / trajectory.length()).frame.origin;
        // The known error of a cubic for a quarter of a circle: 2.8e-4 of the radius.
        assert!((p.distance(DVec3::new(3.0, 1.0, 0.0)) - 1.0).abs() < 3e-4, "{p}");
    }
    // The tangent is continuous everywhere, also at the start.
    let closed = swept(&polyline(true, &json!({"round": 0.5})), &json!({}));
    assert!(closed.trajectory().closed() && closed.trajectory().breaks().is_empty());
    for i in 0..100 {
        let tangent = |v: f64| closed.trajectory().station(v).frame.tangent;
        let v = f64::from(i) / 100.0;
        // The curve is 16 long and bends by less than 6 radians per unit of length.
        assert!((tangent(v) - tangent((v + 1e-7).fract())).length() < 1e-7 * 16.0 * 6.0);
    }
}

#[test]
fn a_mitre_sharper_than_the_section_allows_folds() {
    let line = |x: f64| json!({"polyline": {"points": [[0, 0, 0], [x, 0, 0], [x, x, 0]], "corners": {"mitre": 2}}});
    let wide = json!({"contour": {"circle": 1}});
    assert_eq!(swept(&line(1.5), &wide).folded_rows(), 0);
    assert!(swept(&line(0.8), &wide).folded_rows() > 0);
}

#[test]
fn corners_have_their_complaints() {
    let sharp = |corners: Value| json!({"polyline": {"points": [[0, 0, 0], [4, 0, 0], [0, 1, 0]], "corners": corners}});
    let cusp = |corners: Value| json!({"bezier": {"segments": [[[0, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 0]]], "corners": corners}});
    let bent = json!({"bezier": {"segments": [[[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]],
        [[3, 0, 0], [3, 1, 0], [3, 2, 1], [3, 3, 3]]], "corners": {"mitre": 4}}});
    let hairpin =
        json!({"polyline": {"points": [[0, 0, 0], [4, 0, 0], [1, 0, 0]], "corners": {"round": 1}}});
    let tilted = polyline(false, &json!({"mitre": 4}));
    for (trajectory, more, message) in [
        (
            sharp(Value::Null),
            json!({}),
            "polyline.points[1]: found a corner of 166.0 degrees where segment 0 meets segment 1, expected a trajectory that bends smoothly, or `corners`",
        ),
        (
            sharp(json!({"mitre": 4})),
            json!({}),
            "expected a mitre of at most 4.0, where this corner needs 8.185",
        ),
        (
            sharp(json!({"mitre": 0.5})),
            json!({}),
            "corners.mitre: found 0.5, expected a limit of at least 1",
        ),
        (sharp(json!({"round": 0})), json!({}), "corners.round: found 0.0"),
        (
            sharp(json!({})),
            json!({}),
            "corners: found no corner style, expected one of round, mitre",
        ),
        (
            cusp(json!({"mitre": 4})),
            json!({}),
            "found a cusp of 180.0 degrees inside segment 0, expected straight segments",
        ),
        (
            bent,
            json!({}),
            "bezier.segments[1]: found a corner of 90.0 degrees where segment 0 meets segment 1, expected straight segments on both sides for a mitre; use `round`",
        ),
        (hairpin, json!({}), "whose legs lie on each other"),
        (
            tilted.clone(),
            json!({"frame": {"up": [0, 1, 3]}}),
            "frame.up: found a mitre at which the frame turns",
        ),
        (
            json!({"line": [[0, 0, 0], [0, 0, 9]]}),
            json!({"frame": {"guide": tilted}}),
            "frame.guide: found a guide with corners",
        ),
    ] {
        let error = read(&trajectory, &more).unwrap_err().to_string();
        assert!(error.contains(message), "{trajectory}: {error}");
    }
    assert!(
        swept(&cusp(json!({"round": 0.3})), &json!({}))
            .grid()
            .positions
            .iter()
            .all(|p| p.is_finite())
    );
}

/// A corner between short legs is cut by half of the shorter one; the others keep the cut that the spec gives.
#[test]
fn short_legs_reduce_the_cut_of_their_own_corners_only() {
    let corners = json!({"round": 0.5});
    let line = json!({"polyline": {"points": [[0, 0, 0], [4, 0, 0], [4, 0.2, 0], [8, 0.2, 0], [8, 4, 0]], "corners": corners}});
    let sweep = read(&line, &json!({})).unwrap();
    // Each rounding of a right angle by the cut d replaces 2 d by a quarter of a circle, to a thousandth.
    let saved = |cut: f64| cut * (2.0 - std::f64::consts::FRAC_PI_2);
    let expected = 12.0 - 2.0 * saved(0.1) - saved(0.5);
    assert!(
        (sweep.trajectory().length() - expected).abs() < 1e-3,
        "{}",
        sweep.trajectory().length()
    );
}
