//! Vessels: rotations given a wall, with a relief on their outer side.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::made::read;
use files::{Exit, Failure};
use glam::{DVec2, DVec3};
use image::{ImageBuffer, Luma};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::path::Path;
use sweep::check::measures::{Kind, Measures};
use sweep::check::{Finding, Severity, merging};

fn measured(folder: &Path, spec: &Value) -> Measures {
    let object = read(folder, spec).unwrap_or_else(|error| panic!("{error}\n{spec}"));
    let grids = object.grids().unwrap();
    for grid in &grids {
        assert_eq!(merging::findings(grid), None, "{spec}");
    }
    Measures::of(&object, &grids)
}

fn vessel(contour: &Value, wall: &Value, mesh: &Value) -> Value {
    json!({
        "format": "tb-sweep", "version": 1, "name": "vessel", "contour": contour,
        "trajectory": {"rotation": {}}, "wall": wall, "mesh": mesh,
    })
}

/// Returns the volume of a polygon turned about the y axis: Pappus' theorem, the first moment of each side.
fn turned(polygon: &[DVec2]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    let of = |(a, b): (&DVec2, &DVec2)| a.perp_dot(*b) * (a.x + b.x) / 6.0;
    TAU * polygon.iter().zip(next).map(of).sum::<f64>()
}

/// Returns the point where two lines meet, each moved to its left by a distance.
fn met(a: [DVec2; 2], b: [DVec2; 2], by: [f64; 2]) -> DVec2 {
    let [u, v] = [a, b].map(|[from, to]| (to - from).normalize());
    let (p, q) = (a[0] + u.perp() * by[0], b[0] + v.perp() * by[1]);
    p + u * ((q - p).perp_dot(v) / u.perp_dot(v))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    /// A cup whose sides turn to the left at every corner, so that the inner sides meet in mitres.
    #[test]
    fn cups_of_straight_sides_hold_the_volume_of_their_mitred_outline(
        base in 1.0..3.0_f64, steps in prop::collection::vec((0.6..2.0_f64, 10.0..30.0_f64), 1..4),
        thickness in 0.02..0.12_f64, floor in prop::option::of(0.02..0.3_f64),
    ) {
        let mut points = vec![DVec2::ZERO, DVec2::new(base, 0.0)];
        let mut angle: f64 = 25.0;
        for (length, turn) in steps {
            angle += turn;
            let (sin, cos) = angle.to_radians().sin_cos();
            points.push(points[points.len() - 1] + DVec2::new(cos, sin) * length);
        }
        let bottom = floor.unwrap_or(thickness);
        let sides: Vec<[DVec2; 2]> = points.windows(2).map(|ends| [ends[0], ends[1]]).collect();
        let by = |i: usize| if i == 0 { bottom } else { thickness };
        let last = sides[sides.len() - 1];
        let mut outline = points.clone();
        outline.push(last[1] + (last[1] - last[0]).normalize().perp() * thickness);
        for i in (1..sides.len()).rev() {
            outline.push(met(sides[i - 1], sides[i], [by(i - 1), by(i)]));
        }
        outline.push(DVec2::new(0.0, bottom));
        let contour = json!({"polyline": {"points": points.iter().map(DVec2::to_array).collect::<Vec<_>>()}});
        let mut wall = json!({"thickness": thickness});
        if let Some(floor) = floor {
            wall["floor"] = json!(floor);
        }
        let rows = 256;
        let mesh = json!({"rows": rows, "cols": 4 * points.len()});
        let found = measured(Path::new(""), &vessel(&contour, &wall, &mesh));
        prop_assert_eq!(found.kind, Kind::Watertight);
        // Chords of 256 rows lie within the circle by a known factor.
        let part = TAU / f64::from(rows);
        let expected = turned(&outline) * part.sin() / part;
        prop_assert!((found.volume / expected - 1.0).abs() < 1e-9, "{} for {expected}", found.volume);
    }

    /// A smooth profile whose wall is thinner than its bends. With the curvature k, the wall holds
    /// `2 pi` times the integral of `(x - d n_x) (1 - d k)` over the length and the distance d from it.
    #[test]
    fn bowls_hold_the_volume_of_their_wall(
        wide in 1.5..3.0_f64, high in 1.0..4.0_f64, belly in 0.7..1.4_f64, thickness in 0.02..0.12_f64,
        round in any::<bool>(),
    ) {
        // A cubic that leaves the axis level.
        let p = [DVec2::ZERO, DVec2::new(wide * belly, 0.0), DVec2::new(wide, 0.4 * high), DVec2::new(wide, high)];
        let contour = json!({"bezier": {"segments": [p.map(|p| p.to_array())]}});
        let mut wall = json!({"thickness": thickness});
        if round {
            wall["rim"] = json!("round");
        }
        let found = measured(Path::new(""), &vessel(&contour, &wall, &json!({"rows": 96, "cols": 400})));
        prop_assert_eq!(found.kind, Kind::Watertight);
        let steps = 4000;
        let mut expected = 0.0;
        for i in 0..steps {
            let t = (f64::from(i) + 0.5) / f64::from(steps);
            let s = 1.0 - t;
            let point = p[0] * (s * s * s) + p[1] * (3.0 * s * s * t) + p[2] * (3.0 * s * t * t) + p[3] * (t * t * t);
            let v = (p[1] - p[0]) * (3.0 * s * s) + (p[2] - p[1]) * (6.0 * s * t) + (p[3] - p[2]) * (3.0 * t * t);
            let a = (p[2] - p[1] * 2.0 + p[0]) * (6.0 * s) + (p[3] - p[2] * 2.0 + p[1]) * (6.0 * t);
            let speed = v.length();
            let (k, n) = (v.perp_dot(a) / speed.powi(3), -v.perp() / speed);
            let h = thickness;
            let inner = point.x * h - (point.x * k + n.x) * h * h / 2.0 + n.x * k * h * h * h / 3.0;
            expected += TAU * inner * speed / f64::from(steps);
        }
        if round {
            // The half circle of the rim stands on the end, which is upright.
            let radius = 0.5 * thickness;
            expected += TAU * (wide - radius) * 0.5 * PI * radius * radius;
        }
        // Chords of 96 rows lie within the circle by a known factor. Those of 400 columns move both sides of the wall alike.
        // Only two of them lie on a round rim, which is a hundredth of the wall.
        let part = TAU / 96.0;
        expected *= part.sin() / part;
        prop_assert!((found.volume / expected - 1.0).abs() < if round { 5e-3 } else { 1e-3 }, "{} for {expected}", found.volume);
    }
}

fn hills(folder: &Path) {
    let picture: ImageBuffer<Luma<u16>, Vec<u16>> = ImageBuffer::from_fn(12, 9, |x, y| {
        Luma([((x * x * 7 + y * 13 + x * y * 5) % 97) as u16 * 600])
    });
    picture.save(folder.join("hills.png")).unwrap();
}

fn vase(wall: Option<f64>, fade: Option<f64>) -> Value {
    let contour = json!({"svg": "M0 0H2C4 -2 3 -5 2 -6C1.7 -6.5 2 -7 2.5 -7.5"});
    let mut spec = vessel(&contour, &json!(wall), &json!({"rows": 240, "cols": 200}));
    if wall.is_none() {
        spec.as_object_mut().unwrap().remove("wall");
    }
    spec["depth"] = json!({"mode": "offset", "image": {"file": "hills.png", "amp": 0.1, "repeat": [5, 4], "zero": 0}});
    spec["uv"] = json!({"across": "trajectory"});
    if let Some(fade) = fade {
        spec["depth"]["fade"] = json!(fade);
    }
    spec
}

#[test]
fn a_vase_with_a_relief_and_a_wall_is_one_volume() {
    let folder = tempfile::tempdir().unwrap();
    hills(folder.path());
    let raised = measured(folder.path(), &vase(Some(0.2), Some(0.3)));
    assert_eq!((raised.kind, raised.bodies), (Kind::Watertight, 1));
    let mut plain = vase(Some(0.2), None);
    plain.as_object_mut().unwrap().remove("depth");
    let plain = measured(folder.path(), &plain);
    // Heights from 0 to 0.1 lie on an outer side of some 100.
    let raise = (raised.volume - plain.volume) / plain.area;
    assert!(raise > 0.01 && raise < 0.05, "{raise}");
}

/// The relief is 0 with its slope at the axis, at corners and at the rim, so points and normals there are those of the
/// profile alone.
#[test]
fn a_relief_fades_at_the_axis_at_corners_and_at_rims() {
    let folder = tempfile::tempdir().unwrap();
    hills(folder.path());
    let grids = |spec: &Value| read(folder.path(), spec).unwrap().grids().unwrap().remove(0);
    let raised = grids(&vase(None, None));
    let mut bare = vase(None, None);
    bare.as_object_mut().unwrap().remove("depth");
    let plain = grids(&bare);
    let same = |col: usize| {
        (0..raised.rows()).all(|row| {
            let i = row * raised.cols() + col;
            raised.positions[i].distance(plain.positions[i]) < 1e-12
                && raised.normals[i].dot(plain.normals[i]) > 1.0 - 1e-6
        })
    };
    let corner = (1..raised.cols()).find(|&col| raised.u[col] == raised.u[col - 1]).unwrap();
    for (col, expected) in [
        (0, true),
        (corner - 1, true),
        (corner, true),
        (raised.cols() - 2, false),
        (corner / 2, false),
        (corner + 40, false),
    ] {
        assert_eq!(same(col), expected, "column {col} of {}", raised.cols());
    }
    let faded = grids(&vase(None, Some(0.2)));
    let last = raised.cols() - 1;
    assert!((0..faded.rows()).all(|row| {
        let i = row * faded.cols() + last;
        faded.positions[i].distance(plain.positions[i]) < 1e-12
    }));
}

#[test]
fn normals_on_a_fading_relief_agree_with_differences() {
    let folder = tempfile::tempdir().unwrap();
    hills(folder.path());
    for wall in [None, Some(0.2)] {
        let object = read(folder.path(), &vase(wall, Some(0.4))).unwrap();
        let sweep = &object.parts()[0];
        let h = 1e-5;
        for i in 0..60 {
            let (u, v) =
                (0.02 + 0.9 * f64::from(i) / 60.0, (f64::from(i) * 0.377).fract() * 0.9 + 0.05);
            let slope =
                |f: &dyn Fn(f64) -> DVec3| (f(h) - f(-h)) * 8.0 - (f(2.0 * h) - f(-2.0 * h));
            let along_u = slope(&|d| sweep.at(u + d, v).0);
            let along_v = slope(&|d| sweep.at(u, v + d).0);
            let error = (along_u.cross(along_v).normalize() - sweep.at(u, v).1).length();
            // Third derivatives of splines and of cubics of the moved side jump at their ends, times h^2.
            assert!(error < 1e-5, "{wall:?} at {u} {v}: {error:e}");
        }
    }
}

#[test]
fn a_ball_has_a_hollow() {
    let contour = json!({"svg": "M0 2A2 2 0 0 0 0 -2"});
    let found = measured(Path::new(""), &vessel(&contour, &json!(0.5), &json!({"tol": 2e-4})));
    assert_eq!((found.kind, found.bodies), (Kind::Watertight, 1));
    let expected = 4.0 / 3.0 * PI * (8.0 - 1.5_f64.powi(3));
    // The tolerance of 2e-4 over a wall of 0.5, on two sides.
    assert!((found.volume / expected - 1.0).abs() < 1e-3, "{} for {expected}", found.volume);
}

#[test]
fn walls_have_their_complaints() {
    let mesh = json!({"rows": 12, "cols": 40});
    for (contour, wall, message, exit) in [
        ("M0 0H1V-3", json!(0), "wall: found 0.0, expected a number above 0", Exit::Malformed),
        ("M0 0H1V-3", json!(1.2), "wall: found a wall that reaches the axis", Exit::Geometry),
        (
            "M1 0V-3",
            json!({"thickness": 0.1, "floor": 0.2}),
            "wall.floor: found a floor of a profile",
            Exit::Geometry,
        ),
        (
            "M0 0H1V-3",
            json!({"thickness": {"total": 1}}),
            "wall.thickness: found 0.0",
            Exit::Malformed,
        ),
    ] {
        let spec = vessel(&json!({"svg": contour}), &wall, &mesh);
        let error = read(Path::new(""), &spec).unwrap_err();
        assert!(error.to_string().contains(message), "{contour}: {error}");
        assert_eq!(error.exit(), exit, "{contour}");
    }
    let folder = tempfile::tempdir().unwrap();
    hills(folder.path());
    let mut deep = vase(Some(0.05), None);
    deep["depth"]["image"]["zero"] = json!(1);
    let error = read(folder.path(), &deep).unwrap_err().to_string();
    assert!(error.contains("deep in a wall of 0.05"), "{error}");
}

/// Returns the findings about the wall of a vessel.
fn about_wall(contour: &str, wall: &Value) -> Vec<Finding> {
    let spec = vessel(&json!({"svg": contour}), wall, &json!({"rows": 12, "cols": 200}));
    let object = read(Path::new(""), &spec).unwrap();
    let mut found = sweep::check::check(&object, &object.grids().unwrap(), None);
    found.retain(|finding| finding.path == "wall");
    found
}

/// A rim turned down beside the vessel, at a distance of 1.2: walls of more than half of it, on the outer sides, cross.
#[test]
fn a_wall_that_crosses_itself_is_found_with_the_thickest_one_that_does_not() {
    let lip = "M0 0H2V-4H3.2V-2";
    let outward = |thickness: f64| json!({"thickness": thickness, "side": "outward"});
    let found = about_wall(lip, &outward(0.8));
    let [wrong] = &found[..] else { panic!("{found:?}") };
    assert_eq!(wrong.severity, Severity::Wrong);
    let (_, remedy) = wrong.message.split_once("a wall of ").unwrap();
    let thickest: f64 = remedy.split(' ').next().unwrap().parse().unwrap();
    assert!(thickest > 0.599 && thickest <= 0.6, "{wrong}");
    assert!(wrong.message.contains("from the axis at the height 2"), "{wrong}");
    assert_eq!(about_wall(lip, &outward(thickest)), []);
    assert_eq!(about_wall(lip, &json!(0.3)), []);
    // A law has no one thickness, and the part of it is stated.
    let law = json!({"thickness": {"keys": [[0, 0.8], [1, 0.9]]}, "side": "outward"});
    let found = about_wall(lip, &law);
    assert!(found[0].message.contains(" of this thickness does not"), "{found:?}");
}

#[test]
fn a_bend_tighter_than_its_wall_is_named_with_its_radius() {
    let rounded = "M0 0H1A0.5 0.5 0 0 0 1.5 -0.5V-3";
    let found = about_wall(rounded, &json!(0.6));
    let [hint] = &found[..] else { panic!("{found:?}") };
    assert_eq!(hint.severity, Severity::Hint);
    assert!(
        hint.message.contains("0.6 thick where the profile bends with a radius of 0.5,"),
        "{hint}"
    );
    for fitting in [json!(0.49), json!({"thickness": 2, "side": "outward"})] {
        assert_eq!(about_wall(rounded, &fitting), []);
    }
    // The hollow of a ball is drawn downward, which is no fault.
    let ball = vessel(
        &json!({"svg": "M0 2A2 2 0 0 0 0 -2"}),
        &json!(0.5),
        &json!({"rows": 12, "cols": 40}),
    );
    let object = read(Path::new(""), &ball).unwrap();
    let found = sweep::check::check(&object, &object.grids().unwrap(), None);
    assert!(!found.iter().any(|finding| finding.message.contains("downward")), "{found:?}");
}
