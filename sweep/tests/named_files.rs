//! Contours and trajectories from files: drawings, tables and neurites; units, positions and copies.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::made::{measured, read};
use files::{Exit, Failure};
use glam::DVec3;
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::path::Path;
use sweep::check::measures::{Kind, Measures};
use sweep::grid::Unit;
use sweep::grid::file::{Encoding, GridReader};

/// Returns a straight bar of a contour, closed at both ends.
fn bar(contour: &Value) -> Value {
    json!({
        "format": "tb-sweep", "version": 1, "name": "bar", "unit": "mm", "contour": contour,
        "trajectory": {"line": [[0, 0, 0], [0, 0, 3]]}, "caps": {"start": "flat", "end": "flat"},
        "mesh": {"tol": 1e-4},
    })
}

fn with_file(name: &str, text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), text).unwrap();
    folder
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn drawings_have_the_area_of_their_formulas(
        w in 5.0..20.0_f64, h in 5.0..20.0_f64, r in 0.5..2.0_f64, turn in 0.0..360.0_f64, scale in 0.3..3.0_f64,
        unit in 0..3_usize,
    ) {
        let page = [("100mm", 1.0), ("10cm", 1.0), ("200mm", 2.0)][unit];
        let text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{0}' viewBox='0 0 100 100'>\
             <g id='plate' transform='translate(50 50) rotate({turn}) scale({scale})'>\
             <rect x='{1}' y='{2}' width='{w}' height='{h}' rx='1'/><circle r='{r}'/></g></svg>",
            page.0, -0.5 * w, -0.5 * h
        );
        let folder = with_file("plate.svg", &text);
        let spec = bar(&json!({"svg": {"file": "plate.svg", "id": "plate"}, "center": true}));
        let found = measured(folder.path(), &spec);
        prop_assert_eq!(found.kind, Kind::Watertight);
        let area = (w * h - (4.0 - PI) - PI * r * r) * (scale * page.1).powi(2);
        // Chords within 1e-4 of arcs that are at least 0.15 round.
        prop_assert!((found.volume / (3.0 * area) - 1.0).abs() < 1e-3, "{} for {}", found.volume, 3.0 * area);
        let middle = 0.5 * (found.bounds[0] + found.bounds[1]);
        prop_assert!(middle.truncate().length() < 1e-3);
    }

    /// A rod through collinear points, whose radii change evenly between them: frustums.
    #[test]
    fn rods_from_tables_hold_the_volume_of_their_frustums(
        rows in prop::collection::vec((0.5..3.0_f64, 0.3..1.0_f64), 2..12), semicolon in any::<bool>(),
    ) {
        let mark = if semicolon { ';' } else { ',' };
        let mut text = format!("name{mark}x{mark}radius{mark}y{mark}z\n# a comment\n");
        let mut x = 0.0;
        let mut expected = 0.0;
        let mut before: Option<f64> = None;
        for (step, r) in &rows {
            if let Some(last) = before {
                x += step;
                expected += PI / 3.0 * step * (last * last + last * r + r * r);
            }
            text += &format!("\"a{mark}b\"{mark}{x}{mark}{r}{mark}{}{mark}{}\n", 0.5 * x, -x);
            before = Some(*r);
        }
        let folder = with_file("rod.csv", &text);
        let mut spec = bar(&json!({"circle": 1}));
        spec["trajectory"] = json!({"polyline": {"csv": {"file": "rod.csv", "radius": "radius"}}});
        let found = measured(folder.path(), &spec);
        prop_assert_eq!(found.kind, Kind::Watertight);
        // A step of 1 along x is 1.5 long. A tolerance of 1e-4 is a thousandth of the least radius, 0.3, over three.
        expected *= 1.5;
        prop_assert!((found.volume / expected - 1.0).abs() < 1e-3, "{} for {expected}", found.volume);
    }

    #[test]
    fn a_fit_passes_within_its_tolerance_of_noisy_points(seed in 0..1000_u32, count in 20..200_usize) {
        let noise = |i: usize, k: f64| ((i as f64 + f64::from(seed)) * 78.233 * k).sin() * 0.02;
        let at = |i: usize| {
            let t = 3.0 * i as f64 / count as f64;
            [t + noise(i, 1.0), t.sin() + noise(i, 1.7), 0.5 * t * t + noise(i, 2.3)]
        };
        let points: Vec<[f64; 3]> = (0..=count).map(at).collect();
        let radii: Vec<f64> = (0..=count).map(|i| 0.1 + 0.1 * i as f64 / count as f64).collect();
        let mut spec = bar(&json!({"circle": 1}));
        spec["trajectory"] = json!({"free": {"points": points, "radii": radii, "fit": 0.08}});
        spec["mesh"] = json!({"rows": 60, "cols": 16});
        // A cap would contract the rows at the ends.
        spec.as_object_mut().unwrap().remove("caps");
        let object = read(Path::new(""), &spec).unwrap_or_else(|error| panic!("{error}"));
        let sweep = &object.parts()[0];
        // The middle of a row is the mean of its points, because the contour is a circle about the trajectory.
        let row = |v: f64| {
            let ring: Vec<DVec3> = (0..16).map(|i| sweep.at(f64::from(i) / 16.0, v).0).collect();
            let middle = ring.iter().sum::<DVec3>() / 16.0;
            (middle, ring[0].distance(middle))
        };
        let curve: Vec<(DVec3, f64)> = (0..=2000).map(|i| row(f64::from(i) / 2000.0)).collect();
        for (point, radius) in points.iter().zip(&radii) {
            let point = DVec3::from_array(*point);
            let near = curve.iter().min_by(|a, b| a.0.distance(point).total_cmp(&b.0.distance(point))).unwrap();
            // Samples of the curve are 3e-3 apart.
            prop_assert!(near.0.distance(point) < 0.083, "{}", near.0.distance(point));
            // Radii change by 0.03 per unit of length, and noise moves a point by at most 0.1 along the curve.
            prop_assert!((near.1 - radius).abs() < 5e-3, "{} for {radius}", near.1);
        }
        // Few cubics: a spline through all points has one for each of them.
        let pieces = sweep.trajectory().fewest_cells();
        prop_assert!(pieces < 10);
    }
}

const TREE: &str = "1 1 0 0 0 5 -1\n2 3 6 0 0 1 1\n3 3 12 0 0 1 2\n4 3 18 0 0 1 3\n5 3 12 6 0 0.5 3\n6 3 12 9 0 0.5 5\n";

#[test]
fn neurites_are_tubes_that_start_in_each_other() {
    let folder = with_file("cell.swc", TREE);
    let spec = json!({
        "format": "tb-sweep", "version": 1, "name": "cell", "contour": {"circle": 1},
        "trajectory": {"swc": {"file": "cell.swc"}}, "mesh": {"tol": 2e-3},
    });
    let object = read(folder.path(), &spec).unwrap();
    let names: Vec<&str> = object.parts().iter().map(sweep::Sweep::name).collect();
    assert_eq!(names, ["cell", "cell-2", "cell-3"]);
    assert_eq!(object.unit(), Some(Unit::Um));
    let found = Measures::of(&object, &object.grids().unwrap());
    assert_eq!((found.kind, found.bodies), (Kind::Watertight, 3));
    // A sphere, and tubes with half spheres at both ends. Branches start in the middle of what they leave.
    let tube = |length: f64, r: f64| PI * r * r * length + 4.0 / 3.0 * PI * r.powi(3);
    let expected = 4.0 / 3.0 * PI * 125.0 + tube(18.0, 1.0) + tube(9.0, 0.5);
    assert!((found.volume / expected - 1.0).abs() < 2e-3, "{} for {expected}", found.volume);
    let only = json!({"file": "cell.swc", "types": [2]});
    let error = read(
        folder.path(),
        &json!({
            "format": "tb-sweep", "version": 1, "name": "cell", "contour": {"circle": 1},
            "trajectory": {"swc": only}, "mesh": {"tol": 2e-3},
        }),
    );
    assert!(error.unwrap_err().to_string().contains("found no neurites of these types"));
}

#[test]
fn the_unit_is_kept_in_the_grid_file() {
    let object = read(Path::new(""), &bar(&json!({"circle": 1}))).unwrap();
    assert_eq!(object.unit(), Some(Unit::Mm));
    for encoding in [Encoding::Binary, Encoding::Json] {
        let mut bytes = Vec::new();
        object.write(encoding, &mut bytes).unwrap();
        let read = GridReader::open("bar", &bytes[..]).unwrap().read_rest().unwrap();
        assert_eq!(read[0].unit, Some(Unit::Mm));
    }
}

#[test]
fn copies_are_moved_once_more_each() {
    let mut spec = bar(&json!({"circle": 1}));
    spec["mesh"] = json!({"rows": 3, "cols": 12});
    let one = measured(Path::new(""), &spec);
    spec["place"] = json!([{"rotate_deg": {"axis": [1, 0, 0], "angle": 90}}, {"scale": 2}]);
    spec["copies"] = json!({"count": 3, "step": [{"translate": [10, 0, 0]}]});
    let object = read(Path::new(""), &spec).unwrap();
    let names: Vec<&str> = object.parts().iter().map(sweep::Sweep::name).collect();
    assert_eq!(names, ["bar", "bar-copy2", "bar-copy3"]);
    let all = Measures::of(&object, &object.grids().unwrap());
    assert!((all.volume / (3.0 * 8.0 * one.volume) - 1.0).abs() < 1e-12);
    // The bar along z lies along -y after the turn, twice as large.
    let near = |a: DVec3, b: [f64; 3]| assert!((a - DVec3::from_array(b)).length() < 1e-12, "{a}");
    near(all.bounds[0], [-2.0, -6.0, -2.0]);
    near(all.bounds[1], [22.0, 0.0, 2.0]);
    // One step with several keys and a matrix mean the same.
    spec["place"] = json!({"rotate_deg": [90, 0, 0], "scale": 2});
    spec["copies"] =
        json!({"count": 3, "step": {"matrix": [[1, 0, 0, 10], [0, 1, 0, 0], [0, 0, 1, 0]]}});
    let again = read(Path::new(""), &spec).unwrap();
    assert_eq!(Measures::of(&again, &again.grids().unwrap()).bounds, all.bounds);
}

#[test]
fn places_that_a_sweep_cannot_have_are_refused() {
    for (key, place, message) in [
        (
            "place",
            json!([{"rotate_deg": {"axis": [0, 0, 0], "angle": 1}}]),
            "place[0].rotate_deg.axis: found an axis without length",
        ),
        ("place", json!({"scale": 0}), "place.scale: found 0, expected any other number"),
        (
            "place",
            json!({"scale": [1, 2, 1]}),
            "place: found a place that stretches directions differently",
        ),
        ("place", json!({"scale": [1, 1, -1]}), "place: found a place that mirrors"),
        ("place", json!({"scale": 1e200}), "place: found"),
        (
            "place",
            json!({"matrix": [[1, 0, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0]]}),
            "place: found a place that stretches",
        ),
        (
            "copies",
            json!({"count": 2, "step": [{"scale": [1, 0, 1]}]}),
            "copies.step[0].scale[1]: found 0",
        ),
    ] {
        let mut spec = bar(&json!({"circle": 1}));
        spec[key] = place;
        let error = read(Path::new(""), &spec).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}

/// The contour's x points away from the axis everywhere, for a right-handed and a left-handed helix.
#[test]
fn a_frame_points_away_from_the_axis_for_both_hands() {
    for turns in [3.0, -3.0] {
        let spec = json!({
            "format": "tb-sweep", "version": 1, "name": "thread", "contour": {"polyline": {"points": [[1, -0.2], [1, 0.2]]}},
            "trajectory": {"helix": {"radius": 5, "rise": 2, "turns": turns}},
            "frame": {"away": {"axis": [0, 1, 0]}}, "mesh": {"rows": 90, "cols": 2},
        });
        let object = read(Path::new(""), &spec).unwrap();
        for i in 0..=40 {
            let v = f64::from(i) / 40.0;
            // The middle of the contour lies 1 further from the axis than the trajectory.
            let middle = object.parts()[0].at(0.5, v).0;
            assert!((middle.with_y(0.0).length() - 6.0).abs() < 1e-9, "{turns} at {v}: {middle}");
            let ends = [0.0, 1.0].map(|u| object.parts()[0].at(u, v).0.with_y(0.0).length());
            assert!((ends[0] - ends[1]).abs() < 1e-9, "{turns} at {v}");
        }
    }
}

#[test]
fn files_have_their_complaints() {
    let folder =
        with_file("a.svg", "<svg><rect id='r' width='1' height='1'/><path d='M0 0H9'/></svg>");
    std::fs::write(folder.path().join("a.csv"), "x,y\n1,2\n").unwrap();
    std::fs::write(folder.path().join("b.csv"), "x,y,z\n1,2,3\n1,two,3\n").unwrap();
    let contour = |svg: Value| bar(&json!({ "svg": svg }));
    let table = |csv: Value| {
        let mut spec = bar(&json!({"circle": 1}));
        spec["trajectory"] = json!({"free": {"csv": csv}});
        spec
    };
    for (spec, message, exit) in [
        (contour(json!({"file": "none.svg"})), "contour.svg.file: cannot read", Exit::ReadWrite),
        (
            contour(json!({"file": "a.svg", "id": "q"})),
            "contour.svg.id: a.svg: found no element",
            Exit::Malformed,
        ),
        (
            contour(json!({"file": "a.svg"})),
            "found an open curve beside other loops",
            Exit::Geometry,
        ),
        (contour(json!({"id": "q"})), "missing key `file`", Exit::Malformed),
        (contour(json!(3)), "expected the text of an SVG path", Exit::Malformed),
        (
            table(json!({"file": "a.csv"})),
            "found no columns named x, y and z in a.csv",
            Exit::Malformed,
        ),
        (table(json!({"file": "b.csv"})), "found \"two\" in line 3, column 2", Exit::Malformed),
        (
            table(json!({"file": "b.csv", "columns": [1, 2, 9]})),
            "csv.columns[2]: found column 9",
            Exit::Malformed,
        ),
        (
            table(json!({"file": "b.csv", "radius": "r"})),
            "csv.radius: found no column \"r\"",
            Exit::Malformed,
        ),
    ] {
        let error = read(folder.path(), &spec).unwrap_err();
        let text = error.to_string().replace(&format!("{}/", folder.path().display()), "");
        assert!(text.contains(message), "{text}");
        assert_eq!(error.exit(), exit, "{text}");
    }
}

/// Returns the area of the section that the shapes of a drawing bound.
fn area_of(shapes: &str) -> f64 {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='-50 -50 100 100'>{shapes}</svg>"
    );
    let folder = with_file("a.svg", &text);
    let found = measured(folder.path(), &bar(&json!({"svg": {"file": "a.svg"}})));
    assert_eq!(found.kind, Kind::Watertight, "{shapes}");
    found.volume / 3.0
}

/// Squares of 10, 8, 6 and 4, one inside the other. `backward` ones run in the other direction.
fn squares(backward: [bool; 4]) -> String {
    let one = |(half, backward): (i32, bool)| {
        let (x, y) = if backward { ('V', 'H') } else { ('H', 'V') };
        format!("M-{half} -{half}{x}{half}{y}{half}{x}-{half}Z")
    };
    [5, 4, 3, 2].into_iter().zip(backward).map(one).collect()
}

#[test]
fn the_fill_rule_decides_which_subpaths_are_holes() {
    let (all, none) = (100.0, [false; 4]);
    let evenly = 100.0 - 64.0 + 36.0 - 16.0;
    let holes = [false, true, false, true];
    let mirrored = |inside: &str| format!("<g transform='translate(3 2) scale(-1 1)'>{inside}</g>");
    let path =
        |backward: [bool; 4], keys: &str| format!("<path d='{}' {keys}/>", squares(backward));
    for (shape, expected) in [
        (path(none, ""), all),
        (path([true; 4], ""), all),
        (path(none, "fill-rule='evenodd'"), evenly),
        (path(none, "style='fill-rule:evenodd'"), evenly),
        (path(holes, ""), evenly),
        (path(holes, "fill-rule='evenodd'"), evenly),
        // Winding numbers of 1, 2, 1, 0: only the innermost square is a hole.
        (path([false, false, true, true], ""), 100.0 - 16.0),
        (path([false, true, true, true], ""), 100.0 - 64.0 + 36.0),
    ] {
        for shape in [shape.clone(), mirrored(&shape)] {
            let found = area_of(&shape);
            assert!((found / expected - 1.0).abs() < 1e-9, "{shape}: {found} for {expected}");
        }
    }
    let group = |rule: &str, inside: &str| format!("<g fill-rule='{rule}'>{inside}</g>");
    let inherited = group("evenodd", &mirrored(&path(none, "")));
    assert!((area_of(&inherited) - evenly).abs() < 1e-9);
    let stated = group("evenodd", &path(none, "fill-rule='nonzero'"));
    assert!((area_of(&stated) - all).abs() < 1e-9);
}

/// An `a` in an `O`, drawn as letters of a font are: the outer outlines run in one direction and the counters in the
/// other. A mirror reverses all of them.
#[test]
fn letters_inside_letters_keep_their_counters() {
    let ring = |r: f64, hole: f64| {
        let circle = |r: f64, sweep: i32| {
            format!("M{r} 0A{r} {r} 0 0 {sweep} -{r} 0A{r} {r} 0 0 {sweep} {r} 0Z")
        };
        format!("{}{}", circle(r, 1), circle(hole, 0))
    };
    let expected = PI * (400.0 - 225.0 + 64.0 - 25.0);
    let (o, a) = (ring(20.0, 15.0), ring(8.0, 5.0));
    for keys in
        ["", "transform='scale(1 -1)'", "fill-rule='evenodd' transform='matrix(-1 0 0 1 4 0)'"]
    {
        // Both letters in one path, and each in its own.
        for shapes in [
            format!("<path d='{o}{a}' {keys}/>"),
            format!("<g {keys}><path d='{o}'/><path d='{a}'/></g>"),
        ] {
            let found = area_of(&shapes);
            assert!((found / expected - 1.0).abs() < 1e-4, "{shapes}: {found} for {expected}");
        }
    }
}

#[test]
fn a_rule_beside_a_drawing_replaces_those_of_its_elements() {
    let text = format!("<svg><path d='{}'/><circle r='1'/></svg>", squares([false; 4]));
    let folder = with_file("a.svg", &text);
    for (rule, expected) in [
        (None, 100.0 - PI),
        (Some("nonzero"), 100.0),
        (Some("even_odd"), 100.0 - 64.0 + 36.0 - 16.0 + PI),
    ] {
        let mut contour = json!({"svg": {"file": "a.svg"}});
        if let Some(rule) = rule {
            contour["rule"] = json!(rule);
        }
        let found = measured(folder.path(), &bar(&contour)).volume / 3.0;
        // In inches a user unit is a pixel; the bar is in millimetres.
        let expected = expected * (25.4_f64 / 96.0).powi(2);
        assert!((found / expected - 1.0).abs() < 1e-3, "{rule:?}: {found} for {expected}");
    }
}
