//! Walls of tubes with a relief on their outer side.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::made::{measured, read};
use files::{Exit, Failure};
use glam::DVec3;
use image::{ImageBuffer, Luma};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::path::Path;
use sweep::Object;
use sweep::check::measures::Kind;
use sweep::check::{Severity, merging};

fn tube(keys: &Value) -> Value {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "tube", "contour": {"circle": 1},
        "trajectory": {"line": [[0, 0, 0], [0, 4, 0]]}, "wall": 0.3,
        "depth": {"mode": "offset", "terms": [{"amp": 0.1, "u": 6}]},
        "mesh": {"rows": 24, "cols": 240},
    });
    for (key, value) in keys.as_object().unwrap() {
        spec[key] = value.clone();
    }
    spec
}

/// Returns the volume of a closed object, which merging of vertices does not break.
fn volume(spec: &Value) -> f64 {
    let object = read(Path::new(""), spec).unwrap_or_else(|error| panic!("{error}\n{spec}"));
    for grid in object.grids().unwrap() {
        assert_eq!(merging::findings(&grid), None, "{spec}");
    }
    let found = measured(Path::new(""), spec);
    assert_eq!(found.kind, Kind::Watertight, "{spec}");
    found.volume
}

/// Chords of `cells` columns on a circle enclose this part of its area.
fn chords(cells: usize) -> f64 {
    let turn = TAU / cells as f64;
    turn.sin() / turn
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    /// The outer side has the radius `s (1 + wave) + outer` and the inner side `s - inner`. The mean of a squared sine
    /// is a half. The scale `s` is linear along the tube, and the area is of the second degree in it.
    #[test]
    fn a_relief_adds_the_mean_of_its_square_to_the_area(
        amp in 0.02..0.1_f64, waves in 2..7_i32, end in 0.8..1.5_f64, thickness in 0.2..0.4_f64, side in 0..3_usize,
        turn in -90.0..90.0_f64, factor in any::<bool>(),
    ) {
        let mode = if factor { "factor" } else { "offset" };
        let named = ["inward", "outward", "center"][side];
        let spec = tube(&json!({
            "wall": {"thickness": thickness, "side": named},
            "scale": {"keys": [[0, 1], [1, end]]}, "twist": {"total": turn},
            "depth": {"mode": mode, "terms": [{"amp": amp, "u": waves}]},
            "mesh": {"rows": 48, "cols": 480},
        }));
        let outer = [0.0, thickness, 0.5 * thickness][side];
        let inner = thickness - outer;
        let area = |s: f64| PI * ((s + outer).powi(2) + 0.5 * (s * amp).powi(2) - (s - inner).powi(2));
        let expected = 4.0 / 6.0 * (area(1.0) + 4.0 * area(0.5 * (1.0 + end)) + area(end));
        let found = volume(&spec);
        prop_assert!((found / expected - 1.0).abs() < 1e-3, "{found} for {expected}");
    }
}

/// Without a relief the same tube has the same inner side, point for point.
#[test]
fn a_relief_does_not_show_on_the_inner_side() {
    let with = tube(&json!({}));
    let mut without = with.clone();
    without.as_object_mut().unwrap().remove("depth");
    let grids = |spec: &Value| read(Path::new(""), spec).unwrap().grids().unwrap();
    let (with, without) = (grids(&with), grids(&without));
    assert_eq!(with.len(), 2);
    assert_eq!(with[1].positions, without[1].positions);
    assert_ne!(with[0].positions, without[0].positions);
    // The relief moves the outer side of a wall as it moves a tube without a wall.
    let solid = {
        let mut spec = tube(&json!({}));
        spec.as_object_mut().unwrap().remove("wall");
        grids(&spec)
    };
    assert_eq!(with[0].positions, solid[0].positions);
}

/// Pappus' theorem: waves of more than three a turn leave the centre of the section in its middle.
#[test]
fn a_hollow_ring_with_a_relief_holds_its_section_times_the_length_of_its_middle() {
    let ring = json!({
        "trajectory": {"circle": {"radius": 5}}, "mesh": {"rows": 400, "cols": 400},
        "depth": {"mode": "offset", "terms": [{"amp": 0.1, "u": 5}]},
    });
    let expected = TAU * 5.0 * PI * (1.0 + 0.5 * 0.01 - 0.49) * chords(400).powi(2);
    let found = volume(&tube(&ring));
    assert!((found / expected - 1.0).abs() < 2e-4, "{found} for {expected}");
}

/// A square pipe with a picture on its sides, which fades at the edges of the pipe: the edges stay straight.
#[test]
fn a_picture_on_a_square_pipe_fades_at_its_edges() {
    let folder = tempfile::tempdir().unwrap();
    let picture: ImageBuffer<Luma<u8>, Vec<u8>> =
        ImageBuffer::from_fn(8, 5, |x, y| Luma([((x * 37 + y * 91 + x * y * 11) % 251) as u8]));
    picture.save(folder.path().join("grey.png")).unwrap();
    for side in ["inward", "outward", "center"] {
        let spec = tube(&json!({
            "contour": {"polyline": {"closed": true, "points": [[1, 1], [-1, 1], [-1, -1], [1, -1]]}},
            "wall": {"thickness": 0.3, "side": side},
            "depth": {"mode": "offset", "image": {"file": "grey.png", "amp": 0.1, "repeat": [4, 2], "zero": 0}},
            "mesh": {"rows": 60, "cols": 160},
        }));
        let found = measured(folder.path(), &spec);
        let mut plain = spec.clone();
        plain.as_object_mut().unwrap().remove("depth");
        let plain_found = measured(folder.path(), &plain);
        assert_eq!((found.kind, found.bodies), (Kind::Watertight, 1));
        // Heights from 0 to 0.1 on an area of some 8 x 4.
        let raise = found.volume - plain_found.volume;
        assert!(raise > 0.5 && raise < 3.2, "{side}: {raise}");
        let grids = |spec: &Value| read(folder.path(), spec).unwrap().grids().unwrap().remove(0);
        let (with, without) = (grids(&spec), grids(&plain));
        let edge = |col: usize| col > 0 && with.u[col] == with.u[col - 1];
        for col in (0..with.cols()).filter(|&col| edge(col)) {
            for row in 0..with.rows() {
                let i = row * with.cols() + col;
                assert!(with.positions[i].distance(without.positions[i]) < 1e-12);
            }
        }
    }
}

/// Returns the largest difference between the normals of a part and those of difference quotients.
fn off_normals(object: &Object, part: usize) -> f64 {
    let sweep = &object.parts()[part];
    let h = 1e-5;
    let at = |i: usize| {
        let (u, v) = (0.017 + 0.96 * (i as f64 / 80.0), (i as f64 * 0.377).fract() * 0.9 + 0.05);
        let slope = |f: &dyn Fn(f64) -> DVec3| (f(h) - f(-h)) * 8.0 - (f(2.0 * h) - f(-2.0 * h));
        let along_u = slope(&|d| sweep.at(u + d, v).0);
        let along_v = slope(&|d| sweep.at(u, v + d).0);
        (along_u.cross(along_v).normalize() - sweep.at(u, v).1).length()
    };
    (0..80).map(at).fold(0.0, f64::max)
}

#[test]
fn normals_on_both_sides_of_a_wall_agree_with_differences() {
    let smooth = json!({"keys": [[0, 1], [1, 1.3]], "ease": "smooth"});
    let narrow = json!({"keys": [[0, 1.2], [1, 0.7]], "ease": "smooth"});
    let square = json!({"polyline": {"closed": true, "points": [[1, 0.6], [-1, 0.8], [-1.1, -0.7], [0.9, -0.8]]}});
    let bean = json!({"free": {"closed": true, "points": [[1, 0], [0.4, 0.7], [-0.6, 0.6], [-1, -0.2], [0, -0.7]]}});
    for contour in [json!({"circle": 1}), square, bean] {
        for mode in [None, Some("offset"), Some("factor")] {
            for side in ["inward", "outward", "center"] {
                let mut spec = tube(&json!({
                    "contour": contour, "scale": [smooth, narrow], "twist": {"total": 60},
                    "trajectory": {"circle": {"radius": 9, "angle_deg": 80}},
                    "wall": {"thickness": {"keys": [[0, 0.05], [1, 0.08]], "ease": "smooth"}, "side": side},
                    "depth": {"mode": mode.unwrap_or("offset"), "terms": [{"amp": 0.02, "u": 4, "v": 2}]},
                }));
                if mode.is_none() {
                    spec.as_object_mut().unwrap().remove("depth");
                }
                let object = read(Path::new(""), &spec).unwrap();
                for part in 0..2 {
                    let off = off_normals(&object, part);
                    assert!(off < 1e-6, "{mode:?} {side} part {part} of {contour}: {off:e}");
                }
            }
        }
    }
}

#[test]
fn a_relief_deeper_than_its_wall_is_refused() {
    let complaint = |keys: &Value| {
        let error = read(Path::new(""), &tube(keys)).unwrap_err();
        assert_eq!(error.exit(), Exit::Geometry);
        error.to_string()
    };
    let deep = json!({"mode": "offset", "terms": [{"amp": 0.3, "u": 3}]});
    let message = complaint(&json!({"depth": deep}));
    assert!(message.contains("depth: found a relief up to 0.3 deep in a wall of 0.3"), "{message}");
    // The scale makes the relief deeper, and the wall is thinner at its end.
    let keys = json!({"scale": {"keys": [[0, 1], [1, 3.5]]}});
    assert!(complaint(&keys).contains("deep in a wall of 0.3"));
    let keys = json!({"wall": {"thickness": {"keys": [[0, 0.3], [1, 0.09]]}}});
    assert!(complaint(&keys).contains("deep in a wall of 0.09"));
    let factor = json!({"mode": "factor", "terms": [{"amp": 0.4, "u": 3}]});
    assert!(complaint(&json!({"depth": factor})).contains("found a relief up to 0.4 deep"));
}

#[test]
fn an_outer_side_that_folds_is_found() {
    // A bay of radius 0.25, filled by a wall of 0.3 on its outside.
    let bay = json!({"free": {"closed": true, "points": [
        [2, -1], [2, 1], [0.3, 1], [0.2, 0.8], [0, 0.75], [-0.2, 0.8], [-0.3, 1], [-2, 1], [-2, -1]]}});
    let wall = json!({"thickness": 0.6, "side": "outward"});
    let object = {
        // A closed trajectory has no ends, whose outlines would cross.
        let keys = json!({"contour": bay, "wall": wall, "trajectory": {"circle": {"radius": 9}}});
        read(Path::new(""), &tube(&keys)).unwrap()
    };
    let grids = object.grids().unwrap();
    let found = sweep::check::check(&object, &grids, None);
    assert!(found.iter().any(|finding| finding.severity == Severity::Wrong), "{found:?}");
}
