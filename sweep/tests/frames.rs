//! Frames fixed by a direction: their axes, their closing, and positions without a frame.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::Failure;
use files::json::Document;
use glam::DVec3;
use serde_json::{Value, json};
use sweep::frame::Frame;
use sweep::{Sweep, SweepError};

fn read(trajectory: &Value, frame: &Value) -> Result<Sweep, SweepError> {
    let spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test", "contour": {"circle": 0.1},
        "trajectory": trajectory, "frame": frame, "mesh": {"rows": 24, "cols": 16},
    });
    Sweep::read(&Document::new("test", spec.to_string().as_bytes()).unwrap())
}

fn frame_at(trajectory: &Value, frame: &Value, v: f64) -> Frame {
    let sweep = read(trajectory, frame).unwrap_or_else(|error| panic!("{error}"));
    sweep.trajectory().station(v).frame
}

/// Returns one trajectory of each kind. None is parallel to `up` anywhere, and only the first is
/// straight.
fn kinds() -> [Value; 6] {
    [
        json!({"line": [[0, 0, 0], [1, 3, 0.5]]}),
        json!({"circle": {"radius": 2, "angle_deg": 200}}),
        json!({"circle": {"radius": 2, "axis": [1, 1, 3]}}),
        json!({"helix": {"radius": 2, "rise": 1.5, "turns": -1.2}}),
        json!({"bezier": {"segments": [[[0, 0, 0], [1, 0, 0.3], [2, 0.6, 0.2], [2.8, 1.4, 0.8]]]}}),
        json!({"free": {"closed": true, "points": [[2, 0, 0], [0, 0.5, 1], [-2, 0, 0], [0, 0.5, -1]]}}),
    ]
}

fn places() -> impl Iterator<Item = f64> {
    (0..=20).map(|i| f64::from(i) / 20.0)
}

#[test]
fn an_upright_frame_is_nowhere_nearer_to_its_direction() {
    let up = DVec3::new(0.2, 1.0, -0.3);
    for trajectory in kinds() {
        for v in places() {
            let frame = frame_at(&trajectory, &json!({"up": up.to_array()}), v);
            // The normal is perpendicular to `up`, and the binormal is as close to it as possible.
            assert!(frame.normal.dot(up).abs() < 1e-14, "{trajectory} {v}");
            assert!(frame.binormal.dot(up) > 0.0);
            assert!((frame.normal.cross(frame.binormal) - frame.tangent).length() < 1e-14);
        }
    }
}

#[test]
fn a_guide_lies_in_the_half_plane_of_w1() {
    for trajectory in kinds() {
        let guide = json!({"circle": {"radius": 7, "center": [0, 6, 0], "axis": [0, 2, 1]}});
        let there = read(&guide, &json!({"frenet": {}})).unwrap();
        for v in places() {
            let frame = frame_at(&trajectory, &json!({"guide": guide}), v);
            let toward = there.trajectory().station(v).frame.origin - frame.origin;
            assert!(toward.dot(frame.binormal).abs() < 1e-13, "{trajectory} {v}");
            assert!(toward.dot(frame.normal) > 0.0);
        }
    }
}

#[test]
fn frenet_points_to_the_axis_of_a_helix_and_a_circle() {
    for trajectory in &kinds()[1..4] {
        let axis = if trajectory["circle"]["axis"].is_null() {
            DVec3::Y
        } else {
            DVec3::new(1.0, 1.0, 3.0).normalize()
        };
        for v in places() {
            let frame = frame_at(trajectory, &json!({"frenet": {}}), v);
            let inward = frame.origin - axis * frame.origin.dot(axis);
            assert!((frame.normal + inward / 2.0).length() < 1e-14, "{trajectory} {v}");
        }
    }
}

#[test]
fn a_natural_spline_has_frenet_frames_up_to_its_straight_ends() {
    let points = json!({"free": {"points": [[0, 0, 0], [2, 1, 0.4], [3, 3, 2]]}});
    let frame = json!({"frenet": {}});
    for (end, near) in [(0.0, 1e-6), (1.0, 1.0 - 1e-6)] {
        let (end, near) = (frame_at(&points, &frame, end), frame_at(&points, &frame, near));
        // A continuous frame moves in proportion to the step, here not ten times as fast.
        assert!((end.normal - near.normal).length() < 10.0 * 1e-6);
    }
}

#[test]
fn closed_trajectories_close_by_themselves() {
    let guide = json!({"guide": {"circle": {"radius": 1, "center": [0, 9, 0]}}});
    for frame in [json!({"up": [0, 1, 0]}), json!({"frenet": {}}), guide] {
        for trajectory in [&kinds()[2], &kinds()[5]] {
            let (start, end) =
                (frame_at(trajectory, &frame, 0.0), frame_at(trajectory, &frame, 1.0));
            assert!((start.normal - end.normal).length() < 1e-12, "{trajectory} {frame}");
        }
    }
}

#[test]
fn places_without_a_frame_are_refused_wherever_they_lie() {
    let bezier = |points: Value| json!({"bezier": {"segments": [points]}});
    let place = |trajectory: &Value, frame: &Value| {
        let error = read(trajectory, frame).unwrap_err();
        assert_eq!(error.exit(), files::Exit::Geometry);
        let text = error.to_string();
        let at = text.split("no frame at ").nth(1).unwrap_or_else(|| panic!("{text}"));
        at.split(' ').next().unwrap().parse::<f64>().unwrap()
    };
    // A planar inflection off every regular sample, where the curvature changes its side.
    let wave = bezier(json!([[0, 0, 0], [1, 2, 0], [2.1, -2, 0], [3, 0.3, 0]]));
    let at = place(&wave, &json!({"frenet": {}}));
    assert!(at > 0.3 && at < 0.7, "{at}");
    // A line has no Frenet frame, and a line along `up` has no frame. Both are reported at the
    // start.
    assert_eq!(place(&kinds()[0], &json!({"frenet": {}})), 0.0);
    assert_eq!(place(&json!({"line": [[0, 0, 0], [0, 3, 0]]}), &json!({"up": [0, 1, 0]})), 0.0);
    // A circle is parallel to `up` at one position, where the frame would flip.
    let ring = json!({"circle": {"radius": 1, "axis": [0, 0, 1], "angle_deg": 100}});
    let up = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let Frame { normal, tangent, .. } = frame_at(&ring, &json!({"start": [1, 0, 0]}), 0.0);
        json!({"up": (tangent * cos - normal * sin).to_array()})
    };
    for degrees in [0.1, 33.3, 71.7] {
        // The message has six decimals.
        assert!((place(&ring, &up(degrees)) - degrees / 100.0).abs() < 5.1e-7);
    }
    assert!(read(&ring, &up(-1.0)).is_ok() && read(&ring, &up(101.0)).is_ok());
    // A cubic that is tangent to the direction without crossing it: (t - 0.37)^3 across, t along.
    let a = 0.37_f64;
    let cube = |x: f64, y: f64, z: f64| (x - a) * (y - a) * (z - a);
    let touching = bezier(json!([
        [cube(0.0, 0.0, 0.0), 0, 0],
        [cube(0.0, 0.0, 1.0), 1.0 / 3.0, 0],
        [cube(0.0, 1.0, 1.0), 2.0 / 3.0, 0],
        [cube(1.0, 1.0, 1.0), 1, 0],
    ]));
    let at = place(&touching, &json!({"up": [0, 1, 0]}));
    assert!(at > 0.3 && at < 0.4, "{at}");
    // The guide intersects the trajectory.
    let guide = json!({"guide": {"line": [[0, -1, 1], [0, 1, -1]]}});
    assert!((place(&json!({"line": [[0, 0, 1], [0, 0, -1]]}), &guide) - 0.5).abs() < 1e-6);
}

#[test]
fn frames_have_their_complaints() {
    let wire = &kinds()[4];
    let ring = &kinds()[2];
    let corner = json!({"bezier": {"segments": [
        [[0, 0, 0], [1, 0, 0.5], [2, 0, 0.5], [3, 0, 0]], [[3, 0, 0], [4, 0, -0.5], [5, 2, -0.5], [6, 2, 0]]]}});
    for (trajectory, frame, message, exit) in [
        (wire, json!({"up": [0, 0, 0]}), "frame.up: found a vector without length", 3),
        (wire, json!({"frenet": {"a": 1}}), "frame.frenet", 3),
        (wire, json!({}), "frame: found no frame, expected one of start, up, frenet, guide", 3),
        (wire, json!({"up": [0, 1, 0], "frenet": {}}), "found both `up` and `frenet`", 3),
        (wire, json!({"guide": {"rotation": {}}}), "frame.guide: found a rotation", 4),
        (
            wire,
            json!({"guide": {"line": [[1, 1, 1], [1, 1, 1]]}}),
            "frame.guide.line: found ends",
            4,
        ),
        (ring, json!({"guide": {"line": [[0, 1, 1], [1, 1, 1]]}}), "frame.guide: found an open", 4),
        (&corner, json!({"frenet": {}}), "found a frame that jumps by", 4),
        (
            &json!({"rotation": {}}),
            json!({"up": [0, 1, 0]}),
            "frame: found a frame for a rotation",
            4,
        ),
    ] {
        let error = read(trajectory, &frame).unwrap_err();
        assert!(error.to_string().contains(message), "{frame}: {error}");
        assert_eq!(error.exit() as i32, exit, "{frame}");
    }
}
