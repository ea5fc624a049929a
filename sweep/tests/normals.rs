//! Normals of modulated sweeps, compared with differences and tested where differences fail.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use fixtures::rounding::{NORMAL, UNIT};
use glam::DVec3;
use proptest::prelude::*;
use serde_json::{Value, json};
use sweep::{Sweep, SweepError};

fn read(contour: &Value, trajectory: &Value, laws: &Value) -> Result<Sweep, SweepError> {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test",
        "contour": contour, "trajectory": trajectory, "mesh": {"rows": 24, "cols": 16},
    });
    for (key, value) in laws.as_object().unwrap() {
        spec[key] = value.clone();
    }
    let text = spec.to_string();
    Sweep::read(&Document::new("test", text.as_bytes()).unwrap())
}

fn swept(contour: &Value, trajectory: &Value, laws: &Value) -> Sweep {
    read(contour, trajectory, laws).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the derivative of `f` at 0 by differences of order 8.
fn slope(f: impl Fn(f64) -> DVec3, h: f64) -> DVec3 {
    let pair = |i: f64| f(i * h) - f(-i * h);
    (pair(1.0) * 0.8 - pair(2.0) * 0.2 + pair(3.0) * (4.0 / 105.0) - pair(4.0) / 280.0) / h
}

/// Steps of the differences. Rounding does not affect the wide steps, and a sharp bend or a fast
/// turn of the frame does not affect the narrow ones. A wrong normal differs from the results of
/// all steps.
const STEPS: [f64; 4] = [2e-3, 5e-4, 1e-4, 2e-5];

/// Largest distance between a correct normal and that of the differences.
///
/// Positions of a few units are rounded to 1e-15, so that a slope over a step of 1e-4 has an error
/// of 1e-11. Where `S_u x S_v` is a thousandth of its median, the error of a normal is a thousand
/// times that.
const WORST: f64 = 1e-8;

/// Returns the largest distance of a unit normal from that of differences with the best step. Only
/// positions with reliable differences count: those away from `joints` in both directions, where
/// `S_u x S_v` is at least 1e-3 of its median.
fn worst_normal(sweep: &Sweep, joints: &[f64]) -> f64 {
    let place = |i: i32, golden: f64| 0.01 + 0.98 * (f64::from(i) * golden).fract();
    let mut found: Vec<(f64, f64)> = (0..150)
        .map(|i| (place(i, 0.754_877_666), place(i, 0.569_840_291)))
        .filter(|(u, v)| joints.iter().all(|j| (u - j).abs() > 0.01 && (v - j).abs() > 0.01))
        .map(|(u, v)| {
            let error = |h: f64| {
                let along_u = slope(|d| sweep.at(u + d, v).0, h);
                let along_v = slope(|d| sweep.at(u, v + d).0, h);
                let across = along_u.cross(along_v);
                (across.length(), (across.normalize() - sweep.at(u, v).1).length())
            };
            let found = STEPS.map(error);
            (found[0].0, found.into_iter().map(|(_, off)| off).fold(f64::INFINITY, f64::min))
        })
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let median = found[found.len() / 2].0;
    found.iter().filter(|(size, _)| *size >= 1e-3 * median).map(|f| f.1).fold(0.0, f64::max)
}

/// Parameters at which the laws and curves below have joints.
const JOINTS: [f64; 7] = [0.0, 0.2, 0.25, 0.5, 0.75, 0.8, 1.0];

fn law(low: f64, high: f64, closed: bool) -> impl Strategy<Value = Value> {
    let values = prop::array::uniform5(low..high);
    (values, 0..4).prop_map(move |([a, b, c, d, e], kind)| {
        let end = if closed { a } else { e };
        match kind {
            0 => json!(a),
            1 => json!({"keys": [[0, a], [0.2, b], [0.8, c], [1, end]], "ease": "smooth"}),
            2 => json!({"keys": [[0, a], [0.5, b], [1, end]]}),
            _ => json!({"bezier": [[[0, a], [0.2, b], [0.4, c], [0.5, d]],
                                   [[0.5, d], [0.6, d], [0.8, c], [1, end]]]}),
        }
    })
}

fn contour() -> impl Strategy<Value = Value> {
    prop_oneof![
        (0.2..0.6).prop_map(|r| json!({"circle": r})),
        (0.1..0.4).prop_map(|y| json!({"bezier": {"segments":
            [[[0.4, -0.2], [0.3, y], [-0.2, 0.5], [-0.4, y]]]}})),
        (prop::array::uniform3((0.1..0.6, 0.1..0.6, 0.2..0.9)), any::<bool>())
            .prop_map(|(rings, smooth)| sections(rings.map(oval), smooth)),
        (prop::array::uniform3(0.1..0.4), any::<bool>()).prop_map(
            |(y, smooth): ([f64; 3], bool)| {
                sections(
                    y.map(|y| {
                        json!({"bezier": {"segments":
                [[[0.4, -y], [0.3, 0.6 * y], [-0.2, 0.5], [-0.4, y]]]}})
                    }),
                    smooth,
                )
            }
        ),
    ]
}

/// Returns a ring of four cubics whose joints lie at quarters of its length.
fn oval((a, b, handle): (f64, f64, f64)) -> Value {
    let (x, y) = (a * handle, b * handle);
    json!({"bezier": {"closed": true, "segments": [
        [[a, 0], [a, y], [x, b], [0, b]], [[0, b], [-x, b], [-a, y], [-a, 0]],
        [[-a, 0], [-a, -y], [-x, -b], [0, -b]], [[0, -b], [x, -b], [a, -y], [a, 0]],
    ]}})
}

/// Returns three sections. The last one equals the first, so that a trajectory may be closed.
fn sections([a, b, c]: [Value; 3], smooth: bool) -> Value {
    let blend = if smooth { "smooth" } else { "linear" };
    json!({"blend": blend, "sections": [
        {"at": 0.2, "contour": a}, {"at": 0.5, "contour": b}, {"at": 0.8, "contour": c},
    ]})
}

/// Returns trajectories, and for each whether it is closed.
fn trajectories() -> [(Value, bool); 9] {
    let bent = json!([[[0, 0, 0], [2, 0.4, 0.3], [1.9, 1.1, 0.2], [0.2, 0.9, 0.8]]]);
    // Symmetry puts the joints of both splines at quarters of their lengths.
    let points = json!([[-1.5, 0, -1], [0, 0.8, 0], [1.5, 0, 1]]);
    let ring = json!([[2, 0.5, 0], [0, -0.5, 2], [-2, 0.5, 0], [0, -0.5, -2]]);
    [
        (json!({"line": [[0, 0, 0], [1, 3, 0.5]]}), false),
        (json!({"circle": {"radius": 2, "angle_deg": 200}}), false),
        (json!({"circle": {"radius": 2}}), true),
        (json!({"helix": {"radius": 2, "rise": 1.5, "turns": -1.2}}), false),
        (
            json!({"bezier": {"segments": [[[0, 0, 0], [1, 0, 0.3], [2, 0.6, 0.2], [2.8, 1.4, 0.8]]]}}),
            false,
        ),
        (json!({"bezier": {"segments": bent}}), false),
        (json!({"free": {"points": points}}), false),
        (json!({"free": {"closed": true, "points": ring}}), true),
        (
            json!({"flat": {"curve": {"bezier": {"segments": [[[0, 0], [1, 0.3], [2, 0.2], [1.9, 1.5]]]}},
                            "z": {"bezier": [[[0, 0], [0.3, 1], [0.6, -0.4], [1, 0.3]]]}}}),
            false,
        ),
    ]
}

fn depth(closed: bool) -> impl Strategy<Value = Value> {
    let term = (-1.0..1.0, 0..9, 0..4, 0.0..360.0, law(0.0, 1.0, closed));
    let terms = prop::collection::vec(term, 0..3);
    (terms, any::<bool>()).prop_map(|(terms, factor)| {
        if terms.is_empty() {
            return Value::Null;
        }
        let (mode, size) = if factor { ("factor", 0.2) } else { ("offset", 0.03) };
        let terms: Vec<Value> = terms
            .into_iter()
            .map(|(amp, u, v, phase, along)| {
                json!({"amp": amp * size, "u": u, "v": v, "phase_deg": phase, "along": along})
            })
            .collect();
        json!({"mode": mode, "terms": terms})
    })
}

fn laws(closed: bool) -> impl Strategy<Value = Value> {
    let twist = if closed {
        prop_oneof![Just(json!({"total": 360})), Just(json!({"total": -720}))].boxed()
    } else {
        law(-200.0, 200.0, false).boxed()
    };
    let scale = (law(0.4, 1.2, closed), law(0.4, 1.2, closed), any::<bool>());
    (scale, twist, depth(closed)).prop_map(|((x, y, both), twist, depth)| {
        let scale = if both { x } else { json!([x, y]) };
        let laws = json!({"scale": scale, "twist": twist, "depth": depth});
        // Each law occurs alone and with the others.
        let keys = laws.as_object().unwrap().iter().filter(|(_, value)| !value.is_null());
        Value::Object(keys.map(|(key, value)| (key.clone(), value.clone())).collect())
    })
}

/// Returns frames for the open trajectories above. None comes near a position without a frame,
/// where it would turn too fast for differences.
fn frames() -> [Value; 5] {
    let wave = json!([[0.3, 6, 0], [1, 7, 1], [1, 8, -1], [2, 9, 0.4]]);
    [
        json!({"start": [0.3, -0.5, 0.7]}),
        json!({"up": [0.1, 1, -0.3]}),
        json!({"guide": {"line": [[0, 9, 0], [0, 9, 1]]}}),
        json!({"guide": {"bezier": {"segments": [wave]}}}),
        json!({"frenet": {}}),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn normals_agree_with_differences(
        contour in contour(),
        kind in 0..trajectories().len(),
        frame in prop::option::of(0..frames().len()),
        open in laws(false),
        closed in laws(true),
    ) {
        let (trajectory, is_closed) = trajectories()[kind].clone();
        let mut laws = if is_closed { closed } else { open };
        if let Some(frame) = frame
            && !is_closed
            && (frame < 4 || trajectory.get("line").is_none())
        {
            laws["frame"] = frames()[frame].clone();
        }
        let worst = worst_normal(&swept(&contour, &trajectory, &laws), &JOINTS);
        println!("{worst:.1e}");
        prop_assert!(worst < WORST, "{worst:e}");
    }
}

#[test]
fn normals_of_a_modulated_rotation_agree_with_differences() {
    let smooth = json!({"keys": [[0, 1], [0.5, 2], [1, 1]], "ease": "smooth"});
    let contour = json!({"bezier": {"segments": [[[0.3, 0], [0.9, 0.1], [0.7, 0.6], [0.5, 1]]]}});
    for mode in ["factor", "offset"] {
        let laws = json!({
            "scale": [smooth, {"keys": [[0, 2], [0.5, 1], [1, 2]]}],
            "depth": {"mode": mode, "terms": [{"amp": 0.1, "u": 1.5, "v": 5}]},
        });
        let worst = worst_normal(&swept(&contour, &json!({"rotation": {}}), &laws), &JOINTS);
        println!("{worst:.1e}");
        assert!(worst < WORST, "{worst:e}");
    }
}

#[test]
fn normals_of_a_rotation_of_sections_agree_with_differences() {
    let ring = |x: f64, a: f64| {
        let points = [[a, -0.4], [1.3 * a, 0.1], [0.6, 0.4], [0.4 * a, 0.9]];
        let points = points.map(|p| [p[0] + x, p[1]]);
        json!({"bezier": {"segments": [points]}})
    };
    let contours = [ring(0.5, 1.0), ring(0.8, 0.4), ring(0.2, 0.7)];
    for (smooth, mode) in [(true, "factor"), (false, "offset")] {
        let laws = json!({
            "scale": {"keys": [[0, 1], [0.5, 2], [1, 1]], "ease": "smooth"},
            "depth": {"mode": mode, "terms": [{"amp": 0.04, "u": 3.5, "v": 5}]},
        });
        let contour = sections(contours.clone(), smooth);
        for laws in [laws, json!({})] {
            let worst = worst_normal(&swept(&contour, &json!({"rotation": {}}), &laws), &JOINTS);
            println!("{worst:.1e}");
            assert!(worst < WORST, "{worst:e}");
        }
    }
}

#[test]
fn a_cone_has_a_normal_for_every_column_at_its_tip() {
    let line = json!({"line": [[0, 0, 0], [0, 0, 4]]});
    for (scale, tip) in [(json!({"total": 1}), 0), (json!({"keys": [[0, 1], [1, 0]]}), 24)] {
        let grid = swept(&json!({"circle": 3}), &line, &json!({"scale": scale})).grid();
        for (i, (point, normal)) in grid.positions.iter().zip(&grid.normals).enumerate() {
            let turn = std::f64::consts::TAU * grid.u[i % 16];
            let axial = if tip == 0 { -3.0 } else { 3.0 };
            let expected = DVec3::new(4.0 * turn.cos(), 4.0 * turn.sin(), axial) / 5.0;
            assert!((normal.as_dvec3() - expected).length() < NORMAL, "{normal} at {point}");
            if i / 16 == tip {
                let corner = grid.positions[tip * 16];
                assert_eq!(point.to_array().map(f64::to_bits), corner.to_array().map(f64::to_bits));
            }
        }
    }
}

#[test]
fn a_round_cap_ends_along_the_trajectory() {
    let cap = json!({"bezier": [[[0, 0], [0, 0.55], [0.2, 1], [0.5, 1]],
                                [[0.5, 1], [0.8, 1], [1, 0.55], [1, 0]]]});
    for trajectory in [&trajectories()[0].0, &trajectories()[4].0] {
        for scale in [cap.clone(), json!([cap, cap])] {
            let laws = json!({"scale": scale, "twist": {"total": 90}});
            let sweep = swept(&json!({"circle": 0.2}), trajectory, &laws);
            let grid = sweep.grid();
            assert!(grid.normals.iter().all(|n| (n.length() - 1.0).abs() < UNIT));
            let ends = [0.0, 1.0].map(|v| sweep.trajectory().station(v).frame.tangent);
            for (i, normal) in grid.normals.iter().enumerate() {
                match i / 16 {
                    0 => assert!((normal.as_dvec3() + ends[0]).length() < NORMAL),
                    24 => assert!((normal.as_dvec3() - ends[1]).length() < NORMAL),
                    _ => {}
                }
            }
        }
    }
}

#[test]
fn a_contour_pressed_flat_has_finite_normals() {
    for scale in [json!([{"total": 1}, 1]), json!([0, {"total": 1}])] {
        let laws = json!({"scale": scale, "twist": {"total": 100}});
        for (trajectory, closed) in trajectories() {
            let Ok(sweep) = read(&json!({"circle": 0.3}), &trajectory, &laws) else {
                assert!(closed || laws["scale"][0] == 0);
                continue;
            };
            assert!(sweep.grid().normals.iter().all(|n| (n.length() - 1.0).abs() < UNIT));
        }
    }
}

#[test]
fn a_twist_turns_right_handed_about_the_trajectory() {
    let line = json!({"line": [[0, 0, 0], [0, 0, 4]]});
    let sweep = swept(&json!({"circle": 1}), &line, &json!({"twist": {"total": 90}}));
    assert_eq!(sweep.at(0.0, 0.0).0, DVec3::X);
    assert_eq!(sweep.at(0.0, 1.0).0, DVec3::new(0.0, 1.0, 4.0));
}

#[test]
fn folds_are_counted_on_the_contour_as_it_is_scaled() {
    let ring = json!({"circle": {"radius": 1, "angle_deg": 180}});
    let contour = json!({"svg": "M-.9 -.1H.1V.1H-.9Z"});
    let folded = |laws: Value| swept(&contour, &ring, &laws).folded_rows();
    assert_eq!(folded(json!({})), 0);
    assert_eq!(folded(json!({"scale": 1.2})), 25);
    assert_eq!(folded(json!({"scale": {"keys": [[0, 1], [1, 2]]}})), 22);
    // Rotated by half a turn, the long side points outward.
    assert_eq!(folded(json!({"scale": 1.2, "twist": 180})), 0);
}

#[test]
fn a_relief_of_a_circle_is_the_wave_it_says() {
    let line = json!({"line": [[0, 0, 0], [0, 0, 1]]});
    let term = json!({"amp": 0.1, "u": 5, "v": 2, "phase_deg": 30, "along": {"total": 1}});
    for (mode, factor) in [("factor", 2.0), ("offset", 1.0)] {
        let laws = json!({"depth": {"mode": mode, "terms": [term]}});
        let sweep = swept(&json!({"circle": 2}), &line, &laws);
        for (u, v) in [(0.0, 0.0), (0.13, 0.4), (0.7, 1.0)] {
            let wave = (std::f64::consts::TAU * (5.0 * u + 2.0 * v + 1.0 / 12.0)).sin();
            let radius = sweep.at(u, v).0.truncate().length();
            assert!((radius - (2.0 + factor * 0.1 * v * wave)).abs() < 1e-14);
        }
    }
}

#[test]
fn an_offset_deeper_than_the_contour_bends_is_a_fold() {
    let line = json!({"line": [[0, 0, 0], [0, 0, 1]]});
    let folded = |amp: f64| {
        let laws = json!({"depth": {"mode": "offset", "terms": [{"amp": amp, "phase_deg": 90,
            "along": {"keys": [[0.5, 0], [1, 1]]}}]}});
        swept(&json!({"circle": 1}), &line, &laws).folded_rows()
    };
    assert_eq!([folded(2.0), folded(-0.9), folded(-2.0)], [0, 0, 6]);
}
