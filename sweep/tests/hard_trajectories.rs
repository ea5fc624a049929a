//! Trajectories that are hard for modelers, each with the expected result in the name of its test.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use glam::DVec3;
use serde_json::{Value, json};
use sweep::frame::Frame;
use sweep::{GridMesh, Sweep, SweepError};

fn read(trajectory: &Value, more: &Value) -> Result<Sweep, SweepError> {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test", "contour": {"circle": 0.125},
        "trajectory": trajectory, "mesh": {"rows": 48, "cols": 16},
    });
    for (key, value) in more.as_object().unwrap() {
        spec[key] = value.clone();
    }
    Sweep::read(&Document::new("test", spec.to_string().as_bytes()).unwrap())
}

fn swept(trajectory: &Value) -> Sweep {
    read(trajectory, &json!({})).unwrap_or_else(|error| panic!("{error}"))
}

fn bezier(points: [[f64; 3]; 4]) -> Value {
    json!({"bezier": {"segments": [points]}})
}

fn frames(sweep: &Sweep) -> Vec<Frame> {
    (0..=200).map(|i| sweep.trajectory().station(f64::from(i) / 200.0).frame).collect()
}

fn finite(grid: &GridMesh) -> bool {
    grid.positions.iter().all(|p| p.is_finite()) && grid.normals.iter().all(|n| n.is_finite())
}

const O: [f64; 3] = [0.0; 3];

#[test]
fn a_zero_length_handle_gives_the_frames_of_the_same_curve_by_length() {
    // The length of (t^2, t^3) in a plane has a closed form, which gives t for each length.
    let sweep = swept(&bezier([O, O, [1.0 / 3.0, 0.0, 0.0], [1.0, 1.0, 0.0]]));
    let length = (13_f64.powf(1.5) - 8.0) / 27.0;
    assert!((sweep.trajectory().length() / length - 1.0).abs() < 1e-12);
    for (i, frame) in frames(&sweep).iter().enumerate() {
        let s = length * i as f64 / 200.0;
        let t = ((((27.0 * s + 8.0).powf(2.0 / 3.0)) - 4.0).max(0.0) / 9.0).sqrt();
        assert!((frame.origin - DVec3::new(t * t, t * t * t, 0.0)).length() < 1e-12);
        let tangent = DVec3::new(2.0, 3.0 * t, 0.0).normalize();
        // Near the handle, t is the root of a number computed from s. The direction is as precise
        // as t.
        let close = if i == 0 { 1e-7 } else { 1e-12 };
        assert!((frame.tangent - tangent).length() < close, "{i}");
        assert!(
            (frame.normal - DVec3::Z).length().min((frame.binormal - DVec3::Z).length()) < 1e-12
        );
    }
}

#[test]
fn a_cusp_is_refused_by_name_or_rounded_and_near_cusps_are_finite() {
    let near = |gap: f64| [O, [1.0 - gap, 1.0, 0.1], [gap, 1.0, 0.2], [1.0, 0.0, 0.3]];
    for exponent in 1..=12 {
        let gap = 10_f64.powi(-exponent);
        let sweep = swept(&bezier(near(gap)));
        assert!(finite(&sweep.grid()), "{gap:e}");
    }
    let cusp = [O, [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let refused = read(&bezier(cusp), &json!({})).unwrap_err().to_string();
    assert!(refused.contains("found a cusp of 180.0 degrees inside segment 0"), "{refused}");
    let round = json!({"bezier": {"segments": [cusp], "corners": {"round": 0.1}}});
    assert!(finite(&swept(&round).grid()));
}

#[test]
fn an_inflection_and_a_planar_s_do_not_turn_the_frame_over() {
    let wave = bezier([O, [1.0, 2.0, 0.0], [2.0, -2.0, 0.0], [3.0, 0.0, 0.0]]);
    let frames = frames(&swept(&wave));
    let first = frames[0];
    // One axis of the frame stays perpendicular to the plane. The seed determines which axis.
    let across =
        if first.normal.z.abs() > 0.5 { |f: &Frame| f.normal } else { |f: &Frame| f.binormal };
    assert!(frames.iter().all(|frame| (across(frame) - across(&first)).length() < 1e-14));
}

#[test]
fn a_straight_piece_keeps_its_frame_to_one_ulp_before_a_bend_and_alone() {
    let line = [[1.0, 2.0, 3.0], [2.0, 2.5, 3.5], [3.0, 3.0, 4.0], [4.0, 3.5, 4.5]];
    let bend = [[4.0, 3.5, 4.5], [5.0, 4.0, 5.0], [6.0, 6.0, 5.0], [6.0, 8.0, 4.0]];
    for trajectory in [bezier(line), json!({"bezier": {"segments": [line, bend]}})] {
        let sweep = swept(&trajectory);
        let first = sweep.trajectory().station(0.0).frame;
        for i in 0..=50 {
            let frame = sweep.trajectory().station(f64::from(i) / 50.0).frame;
            if frame.origin.x <= 4.0 {
                let off = (frame.normal - first.normal).abs().max_element();
                assert!(off <= f64::EPSILON, "{trajectory} {i}: {off:e}");
            }
        }
    }
}

#[test]
fn a_hairpin_whose_radius_goes_to_nothing_is_swept_or_refused_in_bounded_work() {
    for exponent in 0..=15 {
        let gap = 10_f64.powi(-exponent);
        let points = json!([[0, 0, 0], [4, 0, 0], [4, gap, 0], [0, gap, 0]]);
        let cut = json!({"round": 0.5 * gap});
        match read(&json!({"polyline": {"points": points, "corners": cut}}), &json!({})) {
            Ok(sweep) => {
                assert!(finite(&sweep.grid()), "{gap:e}");
                assert!(gap > 0.5 || sweep.folded_rows() > 0, "the fold is told");
            }
            // The radius of its bend is a billionth of its legs.
            Err(error) => assert!(gap < 1e-8, "{gap:e}: {error}"),
        }
        let bent = bezier([O, [4.0, 0.0, 0.0], [4.0, gap, 0.0], [0.0, gap, 0.0]]);
        match read(&bent, &json!({})) {
            Ok(sweep) => assert!(finite(&sweep.grid())),
            Err(error) => assert!(gap < 1e-8 && error.to_string().contains("found a cusp")),
        }
    }
}

#[test]
fn coincident_points_and_repeated_knots_count_once_and_all_equal_are_refused() {
    let p = [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [1.2, 1.0, 0.4], [3.0, 1.0, 1.0]];
    let free = |points: Vec<[f64; 3]>| swept(&json!({"free": {"points": points}})).grid();
    assert_eq!(free(p.to_vec()), free(vec![p[0], p[0], p[1], p[2], p[2], p[2], p[3]]));
    let one = json!({"bezier": {"segments": [p]}});
    let segments = [[p[0]; 4], p, [p[3]; 4]];
    let two = json!({"bezier": {"segments": segments}});
    assert_eq!(swept(&one).grid(), swept(&two).grid());
    for trajectory in [bezier([p[1]; 4]), json!({"polyline": {"points": [p[1], p[1]]}})] {
        let error = read(&trajectory, &json!({})).unwrap_err().to_string();
        assert!(error.contains("trajectory.") && error.contains("found"), "{error}");
    }
}

#[test]
fn a_nearly_closed_bezier_is_closed_below_a_millionth_and_refused_above() {
    for exponent in 3..=15 {
        let gap = 10_f64.powi(-exponent);
        let half = [[0.0, 0.0, 0.0], [0.0, 2.0, 1.0], [3.0, 2.0, 0.0], [3.0, 0.0, 0.0]];
        let back = [[3.0, 0.0, 0.0], [3.0, -2.0, 0.0], [0.0, -2.0, -1.0], [gap, 0.0, 0.0]];
        let spec = json!({"bezier": {"closed": true, "segments": [half, back]}});
        match read(&spec, &json!({})) {
            Ok(sweep) => {
                // The limit is a millionth of the extent, which is between 1 and 10.
                assert!(gap < 1e-5);
                let (start, end) =
                    (sweep.trajectory().station(0.0), sweep.trajectory().station(1.0));
                assert!((start.frame.normal - end.frame.normal).length() < 1e-12);
            }
            Err(error) => {
                assert!(gap > 1e-6);
                assert!(error.to_string().contains("where a closed curve starts"), "{error}");
            }
        }
    }
}

/// Returns a closed spline through points of a torus knot, such as the trefoil or the knot of 2 and
/// 5.
fn knot(count: u32, p: f64, q: f64) -> Value {
    let points: Vec<[f64; 3]> = (0..count)
        .map(|i| {
            let t = std::f64::consts::TAU * f64::from(i) / f64::from(count);
            let r = 2.0 + (q * t).cos();
            [r * (p * t).cos(), r * (p * t).sin(), -(q * t).sin()]
        })
        .collect();
    json!({"free": {"closed": true, "points": points}})
}

#[test]
fn knots_and_a_flat_eight_close_within_four_ulp_of_their_size() {
    let eight: Vec<[f64; 3]> = (0..24)
        .map(|i| {
            let t = std::f64::consts::TAU * f64::from(i) / 24.0;
            [3.0 * t.sin(), 0.0, (2.0 * t).sin()]
        })
        .collect();
    for trajectory in
        [knot(40, 2.0, 3.0), knot(60, 2.0, 5.0), json!({"free": {"closed": true, "points": eight}})]
    {
        let sweep = swept(&trajectory);
        assert!(finite(&sweep.grid()));
        for u in [0.0, 0.3, 0.8] {
            let gap = sweep.at(u, 0.0).0 - sweep.at(u, 1.0).0;
            assert!(gap.length() <= 4.0 * f64::EPSILON * 8.0, "{:e}", gap.length());
        }
    }
}

#[test]
fn a_closed_trajectory_reversed_has_the_same_frames() {
    let more = json!({"frame": {"start": [0.3, 0.2, 1]}});
    for z in [0.1, 1.0, 3.0] {
        let ring = vec![[2.0, 0.0, z], [0.0, 2.0, -z], [-2.0, 0.0, z], [0.0, -2.0, -z]];
        let mut back = ring.clone();
        back[1..].reverse();
        let sweep = |points| read(&json!({"free": {"closed": true, "points": points}}), &more);
        let (along, against) = (sweep(ring).unwrap(), sweep(back).unwrap());
        for (a, b) in frames(&along).iter().zip(frames(&against).iter().rev()) {
            assert!((a.normal - b.normal).length() < 1e-11, "{z}");
        }
    }
}

#[test]
fn a_power_of_two_in_scale_changes_no_mantissa_for_any_kind_of_frame() {
    let points = [[4.0, 0.0, 0.0], [1.0, 2.0, 4.0], [-4.0, 0.5, -1.0], [-2.0, -2.0, -4.0]];
    for frame in [Value::Null, json!({"up": [0.2, 1, 0.1]})] {
        for corners in [None, Some(json!({"mitre": 9})), Some(json!({"round": 0.5}))] {
            let grid = |scale: f64| {
                let points = points.map(|p| p.map(|x| x * scale));
                let trajectory = match &corners {
                    None => json!({"free": {"closed": true, "points": points}}),
                    Some(Value::Object(way)) if way.contains_key("round") => json!({"polyline":
                        {"closed": true, "points": points, "corners": {"round": 0.5 * scale}}}),
                    Some(corners) => json!({"polyline":
                        {"closed": true, "points": points, "corners": corners}}),
                };
                let mut more = json!({"contour": {"circle": 0.125 * scale}});
                if corners.is_none() && !frame.is_null() {
                    more["frame"] = frame.clone();
                }
                read(&trajectory, &more).unwrap_or_else(|error| panic!("{error}")).grid()
            };
            let one = grid(1.0);
            for exponent in [-30, 30] {
                let scale = 2_f64.powi(exponent);
                let other = grid(scale);
                assert!(one.positions.iter().zip(&other.positions).all(|(&a, &b)| a * scale == b));
            }
        }
    }
}
