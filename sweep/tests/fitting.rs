//! Curves fitted to points: their distance, their number of segments, and their smoothness.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::Disk;
use files::json::Document;
use glam::DVec2;
use kurbo::{CubicBez, ParamCurveNearest, Point};
use std::path::Path;
use sweep::Object;
use sweep::curve::fit::{Fit, within};
use sweep::curve::vector::angle_between;
use sweep::curve::{Cubic, turn};
use sweep::spec::Resolution;

/// Largest angle at a smooth joint, in radians. Handles of a fit have one direction; the rest is
/// the rounding of control points.
const SMOOTH: f64 = 1e-9;

fn circle(count: u32) -> Vec<DVec2> {
    (0..count).map(|i| turn(f64::from(i) / f64::from(count))).collect()
}

/// Returns a number from -1 to 1 that depends on `i` alone and has no pattern (a scattered Weyl
/// sequence).
fn noise(i: usize) -> f64 {
    let scattered = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (scattered ^ (scattered >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

fn rough(points: Vec<DVec2>, most: f64) -> Vec<DVec2> {
    let off = |i| DVec2::new(noise(2 * i), noise(2 * i + 1)) * (most / std::f64::consts::SQRT_2);
    points.into_iter().enumerate().map(|(i, point)| point + off(i)).collect()
}

fn figure_eight(count: u32) -> Vec<DVec2> {
    let at = |i| turn(f64::from(i) / f64::from(count));
    (0..count).map(|i| DVec2::new(2.0 * at(i).x, at(2 * i).y)).collect()
}

/// Returns points along lines and arcs: a rectangle of 4 x 2 whose right side is a half circle.
fn arch(step: f64) -> Vec<DVec2> {
    let mut points = Vec::new();
    let corners = [[3.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [3.0, -1.0]].map(DVec2::from_array);
    for ends in corners.windows(2) {
        let count = (ends[0].distance(ends[1]) / step).round() as u32;
        points.extend((0..count).map(|i| ends[0].lerp(ends[1], f64::from(i) / f64::from(count))));
    }
    let count = (std::f64::consts::PI / step).round() as u32;
    let arc = |i: u32| DVec2::new(3.0, 0.0) + turn(f64::from(i) / f64::from(2 * count) - 0.25);
    points.extend((0..count).map(arc));
    points
}

/// Returns the distance of a point from cubics.
fn distance(cubics: &[Cubic<DVec2>], point: DVec2) -> f64 {
    let at = |p: DVec2| Point::new(p.x, p.y);
    cubics
        .iter()
        .map(|cubic| {
            let [a, b, c, d] = cubic.0.map(at);
            CubicBez::new(a, b, c, d).nearest(at(point), 1e-9).distance_sq.sqrt()
        })
        .fold(f64::INFINITY, f64::min)
}

/// Returns the angles, in radians, at the joints of cubics that meet end to end.
fn angles(fit: &Fit<DVec2>, closed: bool) -> Vec<f64> {
    let count = fit.cubics.len();
    let joints = if closed { 0..count } else { 1..count };
    joints
        .map(|i| {
            let (before, after) = (&fit.cubics[(i + count - 1) % count], &fit.cubics[i]);
            assert_eq!(before.0[3], after.0[0]);
            angle_between(before.tangent(1.0), after.tangent(0.0))
        })
        .collect()
}

/// Fits points and asserts that every `step`th point is near the fit, since the measurement is
/// slow.
fn near(points: &[DVec2], closed: bool, tolerance: f64, step: usize) -> Fit<DVec2> {
    let fit = within(points, closed, tolerance);
    assert!(fit.reached <= tolerance, "reached {}", fit.reached);
    for &point in points.iter().step_by(step) {
        let off = distance(&fit.cubics, point);
        // `reached` is measured at parameters close to the nearest point, not exactly at it.
        assert!(off <= fit.reached * (1.0 + 1e-6) + 1e-9, "{point} is {off} off");
    }
    fit
}

#[test]
fn few_cubics_meet_a_circle_and_none_has_a_corner() {
    for (count, tolerance, most) in
        [(12, 1e-2, 6), (200, 1e-3, 6), (1000, 1e-6, 24), (1000, 1e-9, 100)]
    {
        let fit = near(&circle(count), true, tolerance, 1);
        println!("circle of {count}: {} cubics, {:e}", fit.cubics.len(), fit.reached);
        assert!(fit.cubics.len() <= most, "{count}, {tolerance}: {}", fit.cubics.len());
        assert!(angles(&fit, true).iter().all(|&angle| angle < SMOOTH));
    }
}

#[test]
fn noise_within_half_the_tolerance_costs_little() {
    for (count, tolerance) in [(300, 0.02), (5000, 0.01), (5000, 0.1)] {
        let fit = near(&rough(circle(count), 0.5 * tolerance), true, tolerance, 1);
        println!("rough circle of {count}: {} cubics, {:e}", fit.cubics.len(), fit.reached);
        assert!(fit.cubics.len() <= 16, "{}", fit.cubics.len());
        assert!(angles(&fit, true).iter().all(|&angle| angle < SMOOTH));
    }
}

#[test]
fn corners_stay_where_they_are() {
    for (points, tolerance) in [(arch(0.05), 1e-3), (rough(arch(0.01), 0.002), 0.005)] {
        let fit = near(&points, true, tolerance, 1);
        println!("arch of {}: {} cubics, {:e}", points.len(), fit.cubics.len(), fit.reached);
        assert!(fit.cubics.len() <= 16, "{}", fit.cubics.len());
        let angles = angles(&fit, true);
        let corners: Vec<usize> = (0..angles.len()).filter(|&i| angles[i] > 0.1).collect();
        assert_eq!(corners.len(), 2, "{angles:?}");
        for (i, corner) in corners.into_iter().zip([[-1.0, 1.0], [-1.0, -1.0]]) {
            // Each side of a corner is straight for at least one unit. A fit that is off by 0.005
            // at half a unit from the corner has turned by 0.01 there.
            assert!((angles[i] - std::f64::consts::FRAC_PI_2).abs() < 0.02, "{}", angles[i]);
            let off = fit.cubics[i].0[0].distance(DVec2::from_array(corner));
            assert!(off <= 2.0 * tolerance, "{off}");
        }
        assert!(angles.iter().all(|&angle| !(SMOOTH..0.1).contains(&angle)));
    }
}

#[test]
fn a_figure_of_eight_passes_its_crossing_straight() {
    let fit = near(&figure_eight(400), true, 1e-3, 1);
    println!("figure of eight: {} cubics, {:e}", fit.cubics.len(), fit.reached);
    assert!(fit.cubics.len() <= 16, "{}", fit.cubics.len());
    assert!(angles(&fit, true).iter().all(|&angle| angle < SMOOTH));
}

#[test]
fn two_and_three_points_are_enough() {
    let three = [DVec2::ZERO, DVec2::new(1.0, 0.2), DVec2::new(2.0, 1.0)];
    let fit = near(&three, false, 1e-3, 1);
    assert_eq!((fit.cubics[0].0[0], fit.cubics[fit.cubics.len() - 1].0[3]), (three[0], three[2]));
    let line = within(&three[..2], false, 1e-3).cubics;
    assert!(line.len() == 1 && line[0].is_straight(1e-15), "{line:?}");
    let loop_of = near(&three, true, 1e-3, 1);
    assert!(angles(&loop_of, true).iter().all(|&angle| angle < SMOOTH));
    assert!(within(&three[..1], false, 1.0).cubics.is_empty());
    assert!(within(&three[..2], true, 1.0).cubics.is_empty());
}

#[test]
fn a_tolerance_wider_than_the_points_is_kept_and_one_of_nothing_too() {
    near(&circle(100), true, 50.0, 1);
    near(&rough(circle(300), 0.1), true, 1e-13, 1);
}

#[test]
fn the_curve_grows_with_its_points() {
    let grow = 1_048_576.0;
    let points = rough(arch(0.02), 0.002);
    let grown: Vec<DVec2> = points.iter().map(|&point| point * grow).collect();
    let (fit, large) = (within(&points, true, 0.005), within(&grown, true, 0.005 * grow));
    let expected: Vec<_> =
        fit.cubics.iter().map(|cubic| Cubic(cubic.0.map(|p| p * grow))).collect();
    assert_eq!(large, Fit { cubics: expected, reached: fit.reached * grow, places: fit.places });
}

#[test]
fn a_hundred_thousand_points_are_no_trouble() {
    let points = rough(figure_eight(100_000), 0.004);
    let fit = near(&points, true, 0.01, 97);
    assert!(fit.cubics.len() <= 40, "{}", fit.cubics.len());
    assert!(angles(&fit, true).iter().all(|&angle| angle < SMOOTH));
}

/// Reads a spec with this contour. Returns the number of segments of its fit and their distance
/// from the points, or the error message.
fn read(contour: &str, trajectory: &str) -> Result<(usize, f64), String> {
    let text = format!(
        r#"{{"format": "tb-sweep", "version": 1, "name": "a", "contour": {contour},
        "trajectory": {trajectory}, "mesh": {{"rows": 4, "cols": 60}}}}"#
    );
    let document = Document::new("a.json", text.as_bytes()).unwrap();
    let object = Object::read(&document, Path::new(""), &Disk, &Resolution::default());
    let object = object.map_err(|error| error.to_string())?;
    Ok(object.parts()[0].contour().fits().next().unwrap())
}

#[test]
fn a_spec_asks_for_a_fit_of_free_points_only() {
    let mut points: Vec<[f64; 2]> = circle(60).into_iter().map(DVec2::into).collect();
    points.insert(7, points[7]);
    let free = |keys: &str| format!(r#"{{"free": {{"points": {points:?}, {keys}}}}}"#);
    let line = r#"{"line": [[0, 0, 0], [0, 0, 1]]}"#;
    let (segments, reached) = read(&free(r#""closed": true, "fit": 1e-3"#), line).unwrap();
    assert!(segments <= 8 && reached <= 1e-3, "{segments}, {reached}");
    let message = read(&free(r#""closed": true, "fit": 0"#), line).unwrap_err();
    assert!(
        message.contains("contour.free.fit: found 0.0, expected a number above 0"),
        "{message}"
    );
    let trajectory = r#"{"free": {"points": [[0, 0, 0], [0, 0, 1]], "fit": 1}}"#;
    assert!(read(&free(r#""fit": 1e-3"#), trajectory).is_ok());
    let message = read(r#"{"circle": 1}"#, &trajectory.replace("free", "polyline")).unwrap_err();
    assert!(
        message.contains("trajectory.polyline.fit: found a fit of straight lines"),
        "{message}"
    );
}
