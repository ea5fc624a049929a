//! Contours that are hard to sweep, and their surfaces.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use fixtures::rounding::{NORMAL, NORMALS, STEP, UNIT};
use glam::{DVec2, DVec3};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use sweep::check::resolution::aliases;
use sweep::{GridMesh, Sweep, SweepError};

fn read(contour: &Value, extra: &Value) -> Result<Sweep, SweepError> {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test", "contour": contour,
        "trajectory": {"line": [[0, 0, 0], [0, 0, 1]]}, "mesh": {"rows": 20, "cols": 600},
    });
    for (key, value) in extra.as_object().unwrap() {
        spec[key] = value.clone();
    }
    let text = spec.to_string();
    Sweep::read(&Document::new("test", text.as_bytes()).unwrap())
}

fn swept(contour: &Value, extra: &Value) -> Sweep {
    read(contour, extra).unwrap_or_else(|error| panic!("{error}"))
}

fn grid(contour: &Value) -> GridMesh {
    swept(contour, &json!({})).grid()
}

/// Returns a contour with the sections `a` at 0 and `b` at 1.
fn between(a: &Value, b: &Value) -> Value {
    json!({"sections": [{"at": 0, "contour": a}, {"at": 1, "contour": b}]})
}

/// Returns the points of a row, in the plane of the contour.
fn row(grid: &GridMesh, row: usize) -> Vec<DVec2> {
    grid.positions[row * grid.cols()..][..grid.cols()].iter().map(|p| p.truncate()).collect()
}

/// Returns the area that a row encloses.
fn area(points: &[DVec2]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| 0.5 * a.perp_dot(*b)).sum()
}

/// Returns points of a circle of radius 1, starting at a fraction of a turn.
fn ring(count: u32, from: f64) -> Vec<[f64; 2]> {
    (0..count)
        .map(|i| (TAU * (f64::from(i) / f64::from(count) + from)).sin_cos())
        .map(|(sin, cos)| [cos, sin])
        .collect()
}

fn polygon(points: &[[f64; 2]]) -> Value {
    json!({"polyline": {"closed": true, "points": points}})
}

fn free(points: &[[f64; 2]]) -> Value {
    json!({"free": {"closed": true, "points": points}})
}

/// Returns the largest distance between two grids with equal columns.
fn apart(a: &GridMesh, b: &GridMesh) -> f64 {
    assert_eq!(a.positions.len(), b.positions.len());
    a.positions.iter().zip(&b.positions).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max)
}

fn sound(grid: &GridMesh) {
    assert!(grid.positions.iter().all(|p| p.is_finite()));
    assert!(grid.normals.iter().all(|n| (n.length() - 1.0).abs() < UNIT));
}

#[test]
fn contours_of_3_and_300_points_with_opposed_starts_do_not_wring_the_surface() {
    // Blended without aligned starts, the middle would shrink to a tenth.
    for (few, many) in [
        (polygon(&ring(3, 0.5)), polygon(&ring(300, 0.0))),
        (free(&ring(3, 0.5)), free(&ring(300, 0.0))),
        (free(&ring(300, 0.5)), polygon(&ring(3, 0.0))),
    ] {
        let blended = grid(&between(&few, &many));
        let [first, middle, last] = [0, 10, 20].map(|at| area(&row(&blended, at)));
        assert!(middle > first.min(last) && middle < first.max(last), "{first} {middle} {last}");
    }
}

#[test]
fn halfway_from_a_polygon_to_its_circle_lies_the_circle_nearly() {
    for from in [0.0, 0.5, 0.123] {
        let blended = grid(&between(&polygon(&ring(60, from)), &json!({"circle": 1})));
        let middle = area(&row(&blended, 10));
        // A polygon of 60 sides is smaller than its circle by (2 pi / 60)^2 / 6.
        assert!((middle / PI - 1.0).abs() < (2.0 * PI / 60.0).powi(2) / 6.0, "{middle}");
        // Without alignment, opposed starts meet in the middle, up to half the height of a side's
        // arc.
        let mut wrung = between(&polygon(&ring(60, from)), &json!({"circle": 1}));
        wrung["align"] = json!(false);
        let middle = area(&row(&grid(&wrung), 10));
        let off = 0.5 * (1.0 - (PI / 60.0).cos());
        assert!(from != 0.5 || middle < PI * off * off, "{middle}");
    }
}

#[test]
fn where_a_contour_is_drawn_from_does_not_matter() {
    let blob = [[1.0, 0.0], [0.7, 0.9], [-0.2, 0.8], [-1.2, 0.1], [-0.4, -0.9], [0.5, -0.6]];
    for draw in [free, polygon] {
        for other in [json!({"circle": 0.5}), free(&ring(5, 0.2)), polygon(&ring(4, 0.7))] {
            let one = grid(&between(&other, &draw(&blob)));
            for start in 1..blob.len() {
                let mut points = blob;
                points.rotate_left(start);
                let off = apart(&one, &grid(&between(&other, &draw(&points))));
                assert!(off < 1e-9, "{other} to {} from {start}: {off:e}", draw(&blob));
            }
        }
    }
}

#[test]
fn sections_of_one_contour_are_that_contour() {
    for one in [json!({"circle": 0.5}), polygon(&ring(5, 0.1)), free(&ring(7, 0.3))] {
        let sections = between(&one, &one);
        let (plain, blended) = (grid(&one), grid(&sections));
        assert!(apart(&plain, &blended) <= 1e-15);
        let off = |(a, b): (&glam::Vec3, &glam::Vec3)| (*a - *b).length();
        assert!(plain.normals.iter().zip(&blended.normals).map(off).fold(0.0, f32::max) < NORMALS);
    }
}

#[test]
fn sections_wrap_around_a_closed_trajectory() {
    let ring_of = |sections: Value| {
        let closed = json!({"trajectory": {"circle": {"radius": 4}}});
        swept(&json!({"sections": sections}), &closed)
    };
    let (a, b) = (json!({"circle": 1}), polygon(&ring(4, 0.1)));
    let wrapped = ring_of(json!([{"at": 0, "contour": a}, {"at": 0.5, "contour": b}]));
    let closed = ring_of(json!([
        {"at": 0, "contour": a}, {"at": 0.5, "contour": b}, {"at": 1, "contour": a},
    ]));
    assert_eq!(wrapped.grid(), closed.grid());
    for u in [0.0, 0.3, 0.8] {
        assert!((wrapped.at(u, 1.0 - 1e-12).0 - wrapped.at(u, 0.0).0).length() < 1e-10);
        // Both positions lie halfway between two sections.
        let [before, after] = [0.25, 0.75].map(|v| wrapped.at(u, v).0.with_y(0.0).length());
        assert!((before - after).abs() < 1e-12);
    }
}

#[test]
fn a_clockwise_contour_is_turned_round() {
    let mut points = ring(7, 0.0);
    let counter = grid(&polygon(&points));
    points[1..].reverse();
    assert!(apart(&counter, &grid(&polygon(&points))) < 1e-15);
    assert!(area(&row(&counter, 0)) > 0.0);
}

#[test]
fn a_figure_of_eight_and_a_contour_without_area_are_swept_as_drawn() {
    let eight = [[0.0, 0.0], [1.0, 1.0], [1.0, -1.0], [0.0, 0.0], [-1.0, 1.0], [-1.0, -1.0]];
    let there_and_back = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0]];
    for points in [&eight[..], &there_and_back[..]] {
        for draw in [free, polygon] {
            let drawn = grid(&draw(points));
            sound(&drawn);
            assert_eq!(drawn.positions[0], DVec3::ZERO);
            let second = row(&drawn, 0)[2];
            let toward = DVec2::from_array(points[1]);
            assert!(second.dot(toward) > 0.0, "{second}: the direction is kept");
        }
    }
}

#[test]
fn a_contour_that_touches_itself_is_swept() {
    // Two squares that share a corner.
    let touching = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [0.0, 0.0],
        [-1.0, 0.0],
        [-1.0, -1.0],
        [0.0, -1.0],
    ];
    let drawn = grid(&polygon(&touching));
    sound(&drawn);
    assert!((area(&row(&drawn, 0)) - 2.0).abs() < 1e-12);
}

#[test]
fn points_given_twice_count_once() {
    let points = ring(5, 0.0);
    let twice: Vec<_> = points.iter().flat_map(|&p| [p, p]).chain([points[0]]).collect();
    assert_eq!(grid(&polygon(&points)), grid(&polygon(&twice)));
    assert_eq!(grid(&free(&points)), grid(&free(&twice)));
}

#[test]
fn two_points_are_a_line_and_one_is_refused() {
    let line = |points: Value| json!({"polyline": {"points": points}});
    let drawn = grid(&line(json!([[0, 0], [3, 4]])));
    let length = swept(&line(json!([[0, 0], [3, 4]])), &json!({})).contour().length();
    assert!((length - 5.0).abs() < 1e-14);
    assert!(drawn.normals.iter().all(|n| (n.x - 0.8).abs() < STEP && (n.y + 0.6).abs() < STEP));
    for (points, message) in [
        (json!([[1, 1]]), "found 1, expected at least 2 points"),
        (json!([[1, 1], [1, 1]]), "found 1 that differ, expected at least 2 points"),
    ] {
        let error = read(&line(points), &json!({})).unwrap_err().to_string();
        assert!(error.contains("contour.polyline.points") && error.contains(message), "{error}");
    }
}

/// Returns the largest angle, as a chord, between a normal and the direction from the axis of a
/// double cone.
fn off_cone(sweep: &Sweep, radius: f64) -> f64 {
    let grid = sweep.grid();
    let row = |i: usize| i / grid.cols();
    let off = |(i, normal): (usize, &glam::Vec3)| {
        let v = grid.v[row(i)];
        let half = if v == 0.5 { row(i) > 10 } else { v > 0.5 };
        // Both cones open away from the tip in the middle.
        let (sin, cos) = (TAU * grid.u[i % grid.cols()]).sin_cos();
        let side = if half { -1.0 } else { 1.0 };
        let outward = DVec3::new(cos * side, sin * side, side * 2.0 * radius).normalize();
        (normal.as_dvec3() - outward).length()
    };
    grid.normals.iter().enumerate().map(off).fold(0.0, f64::max)
}

#[test]
fn a_scale_through_zero_has_a_pole_inside_and_its_outside_stays_outside() {
    for keys in [json!([[0, 1], [1, -1]]), json!([[0, 1], [0.5, 0], [1, -1]])] {
        let scale = json!({"scale": {"keys": keys}});
        let sweep = swept(&json!({"circle": 2}), &scale);
        let grid = sweep.grid();
        sound(&grid);
        // The pole is two rows, each with the normals of its side.
        let poles: Vec<usize> = (0..grid.rows()).filter(|&row| grid.v[row] == 0.5).collect();
        assert_eq!(poles, [10, 11]);
        for at in 10 * grid.cols()..12 * grid.cols() {
            assert_eq!(grid.positions[at], DVec3::new(0.0, 0.0, 0.5));
        }
        let off = off_cone(&sweep, 2.0);
        assert!(off < NORMAL, "{off:e}");
        // Rows run counter-clockwise on both sides.
        assert!(area(&row(&grid, 0)) > 12.0 && area(&row(&grid, grid.rows() - 1)) > 12.0);
    }
}

#[test]
fn a_scale_of_zero_at_both_ends_has_two_poles() {
    let scale = json!({"scale": {"keys": [[0, 0], [0.5, 1], [1, 0]], "ease": "smooth"}});
    let grid = swept(&polygon(&ring(5, 0.0)), &scale).grid();
    sound(&grid);
    for row_of_pole in [0, grid.rows() - 1] {
        assert!(row(&grid, row_of_pole).iter().all(|p| *p == DVec2::ZERO));
    }
}

#[test]
fn a_negative_scale_on_both_axes_is_half_a_turn() {
    let contour = free(&[[1.0, 0.0], [0.2, 0.7], [-0.8, 0.1], [0.0, -0.4]]);
    let turned = swept(&contour, &json!({"twist": 180})).grid();
    let negative = swept(&contour, &json!({"scale": -1})).grid();
    assert!(apart(&turned, &negative) < 1e-15);
    assert!(
        turned.normals.iter().zip(&negative.normals).all(|(a, b)| (*a - *b).length() < NORMALS)
    );
}

#[test]
fn a_negative_scale_on_one_axis_mirrors_the_contour_and_keeps_its_outside() {
    let points = [[1.0, 0.1], [0.2, 0.7], [-0.8, 0.1], [0.0, -0.4]];
    for (axis, scale) in [(0, json!([-1, 1])), (1, json!([1, -1]))] {
        for draw in [free, polygon] {
            let mirrored = swept(&draw(&points), &json!({"scale": scale})).grid();
            let mut drawn = points;
            drawn.iter_mut().for_each(|p| p[axis] = -p[axis]);
            let drawn = grid(&draw(&drawn));
            assert!(apart(&mirrored, &drawn) < 1e-12);
            let off = |(a, b): (&glam::Vec3, &glam::Vec3)| (*a - *b).length();
            assert!(
                mirrored.normals.iter().zip(&drawn.normals).map(off).fold(0.0, f32::max) < NORMALS
            );
            assert!(area(&row(&mirrored, 0)) > 0.0);
        }
    }
    // The outer side of an open contour is to the right of its direction, also when the contour is
    // mirrored.
    let bend = json!({"polyline": {"points": [[0, 0], [1, 0], [1, 2]]}});
    let mirrored = swept(&bend, &json!({"scale": [1, -1]})).grid();
    assert_eq!(row(&mirrored, 0)[0], DVec2::new(1.0, -2.0));
    assert!((mirrored.normals[0].x - 1.0).abs() < STEP);
}

#[test]
fn a_scale_that_turns_the_surface_inside_out_is_refused() {
    let scale = json!({"scale": [{"keys": [[0, 1], [1, -1]]}, 1]});
    let error = read(&json!({"circle": 1}), &scale).unwrap_err().to_string();
    assert!(error.contains("only one passes 0 at 0.5"), "{error}");
    assert!(error.contains("inside out"), "{error}");
}

#[test]
fn a_thousand_lobes_and_a_hundred_turns_want_cells_enough() {
    let laws = json!({
        "depth": {"mode": "factor", "terms": [{"amp": 0.1, "u": 1000, "v": 3}]},
        "twist": {"total": 36000},
    });
    let sweep = swept(&json!({"circle": 1}), &laws);
    sound(&sweep.grid());
    let paths = |sweep: &Sweep| aliases(sweep).into_iter().map(|a| a.path).collect::<Vec<_>>();
    assert_eq!(paths(&sweep), ["depth.terms[0].u", "twist"]);
    let twist = &aliases(&sweep)[1].message;
    assert!(twist.contains("by 1800 degrees") && twist.contains("600 rows would"), "{twist}");
    let fine = sweep.with_resolution(Some(600), Some(4000)).unwrap();
    assert_eq!(paths(&fine), [""; 0]);
    sound(&fine.grid());
}

#[test]
fn a_relief_deeper_than_the_contour_is_refused() {
    let deep = json!({"depth": {"mode": "factor", "terms": [{"amp": 1.5, "u": 3}]}});
    let error = read(&json!({"circle": 1}), &deep).unwrap_err().to_string();
    assert!(error.contains("depth.terms: found heights that add up to 1.5"), "{error}");
}
