//! Properties of every sweep: closed forms, symmetries, and results of extreme specs.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use fixtures::rounding::{NORMAL, UNIT};
use glam::{DQuat, DVec2, DVec3};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use sweep::grid::Seam;
use sweep::spec::Resolution;
use sweep::{GridMesh, Object, Sweep, SweepError};

fn read(contour: &Value, trajectory: &Value, extra: &Value) -> Result<Sweep, SweepError> {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test",
        "contour": contour, "trajectory": trajectory,
        "mesh": {"rows": 24, "cols": 16},
    });
    for (key, value) in extra.as_object().unwrap() {
        spec[key] = value.clone();
    }
    let text = spec.to_string();
    Sweep::read(&Document::new("test", text.as_bytes()).unwrap())
}

fn grid(contour: &Value, trajectory: &Value) -> GridMesh {
    read(contour, trajectory, &json!({})).unwrap_or_else(|error| panic!("{error}")).grid()
}

/// Returns every point of a grid: u, v, position, normal.
fn points(grid: &GridMesh) -> impl Iterator<Item = (f64, f64, DVec3, DVec3)> + '_ {
    grid.positions.iter().zip(&grid.normals).enumerate().map(|(i, (&position, normal))| {
        let (row, col) = (i / grid.cols(), i % grid.cols());
        (grid.u[col], grid.v[row], position, normal.as_dvec3())
    })
}

#[test]
fn a_cylinder() {
    let grid = grid(&json!({"circle": 2}), &json!({"line": [[1, 0, 0], [1, 5, 0]]}));
    assert_eq!((grid.rows(), grid.cols()), (25, 16));
    assert_eq!((grid.seam_u, grid.seam_v), (Seam::Closed, Seam::Open));
    assert_eq!((grid.v[0], grid.v[24]), (0.0, 1.0));
    for (u, v, position, normal) in points(&grid) {
        let (sin, cos) = (TAU * u).sin_cos();
        let outward = DVec3::new(cos, 0.0, -sin);
        assert!((position - DVec3::new(1.0, 5.0 * v, 0.0) - 2.0 * outward).length() < 1e-14);
        assert!((normal - outward).length() < NORMAL);
    }
}

#[test]
fn a_torus() {
    let grid = grid(
        &json!({"circle": 0.5}),
        &json!({"circle": {"radius": 2, "center": [1, 2, 3], "axis": [0, 7, 0]}}),
    );
    assert_eq!((grid.seam_u, grid.seam_v), (Seam::Closed, Seam::Closed));
    assert_eq!((grid.rows(), grid.cols()), (24, 16));
    for (u, v, position, normal) in points(&grid) {
        let radial = DVec3::new((TAU * v).cos(), 0.0, (TAU * v).sin());
        let outward = radial * (TAU * u).cos() + DVec3::Y * (TAU * u).sin();
        let expected = DVec3::new(1.0, 2.0, 3.0) + radial * 2.0 + outward * 0.5;
        assert!((position - expected).length() < 1e-14);
        assert!((normal - outward).length() < NORMAL);
    }
}

#[test]
fn a_half_circle_rotated_is_a_sphere_with_poles() {
    let half = json!({"svg": "M0 1A1 1 0 0 0 0 -1"});
    let grid = grid(&half, &json!({"rotation": {}}));
    assert_eq!((grid.seam_u, grid.seam_v), (Seam::Open, Seam::Closed));
    for (u, v, position, normal) in points(&grid) {
        let (sin, cos) = (PI * u).sin_cos();
        let expected = DVec3::new(sin * (TAU * v).cos(), -cos, sin * (TAU * v).sin());
        // Cubics approximate arcs to a billionth of the radius.
        assert!((position - expected).length() < 1e-8);
        assert!((normal - position).length() < 1e-6, "{normal} at {position}");
    }
    let cols = grid.cols();
    for end in [0, cols - 1] {
        let pole = grid.positions[end].to_array().map(f64::to_bits);
        for row in 0..grid.rows() {
            assert_eq!(grid.positions[row * cols + end].to_array().map(f64::to_bits), pole);
        }
    }
}

#[test]
fn part_of_a_rotation_about_any_axis_is_open() {
    let rotation = json!({"rotation": {"angle_deg": 90, "origin": [1, 1, 1], "axis": [0, 0, 2]}});
    let grid = grid(&json!({"svg": "M3 0V-2"}), &rotation);
    assert_eq!((grid.seam_v, grid.rows()), (Seam::Open, 25));
    for (u, v, position, _) in points(&grid) {
        let from = position - DVec3::ONE;
        assert!((from.truncate().length() - 3.0).abs() < 1e-14);
        assert!((from.z - 2.0 * u).abs() < 1e-14);
        // The angle starts at +x; w1 x w2 = T leads to -y.
        let angle = DVec2::new(from.x, -from.y).to_angle();
        assert!((angle - 2.0 * FRAC_PI_4 * v).abs() < 1e-14);
    }
}

#[test]
fn a_square_tube_has_flat_sides() {
    let square = json!({"svg": "M1 1H-1V-1H1Z"});
    let grid = grid(&square, &json!({"line": [[0, 0, 0], [0, 0, 9]]}));
    assert_eq!(grid.cols(), 16 + 4);
    for (i, pair) in grid.u.windows(2).enumerate() {
        if pair[0] == pair[1] {
            assert_eq!(grid.positions[i], grid.positions[i + 1]);
            assert!(grid.normals[i].dot(grid.normals[i + 1]).abs() < f32::EPSILON);
        }
    }
    for (_, _, position, normal) in points(&grid) {
        assert!((normal.abs().max_element() - 1.0).abs() < NORMAL);
        assert!((position.truncate().dot(normal.truncate()) - 1.0).abs() < 2.0 * NORMAL, "outward");
    }
}

const LOOP: [[f64; 3]; 5] =
    [[4.0, 0.0, 0.0], [1.0, 2.0, 4.0], [-4.0, 0.5, -1.0], [-2.0, -2.0, -4.0], [3.0, 1.0, -3.0]];

#[test]
fn a_closed_sweep_meets_its_start() {
    let sweep = read(
        &json!({"circle": 0.5}),
        &json!({"free": {"closed": true, "points": LOOP}}),
        &json!({}),
    );
    let sweep = sweep.unwrap();
    for q in [DVec2::X, DVec2::new(-0.3, 0.4)] {
        let gap =
            sweep.trajectory().station(1.0).point(q) - sweep.trajectory().station(0.0).point(q);
        assert!(gap.length() <= 4.0 * f64::EPSILON * (8.0 + 4.0), "{:e}", gap.length());
    }
}

#[test]
fn a_row_does_not_depend_on_the_number_of_rows() {
    let sweep = |rows| {
        let free = json!({"free": {"closed": true, "points": LOOP}});
        let sweep = read(&json!({"circle": 0.5}), &free, &json!({})).unwrap();
        sweep.with_resolution(Some(rows), None).unwrap().grid()
    };
    let (coarse, fine) = (sweep(10), sweep(30));
    for row in 0..10 {
        let at = |grid: &GridMesh, row: usize| grid.positions[row * 16..][..16].to_vec();
        for (a, b) in at(&coarse, row).iter().zip(at(&fine, 3 * row)) {
            assert!((*a - b).length() < 1e-14);
        }
    }
}

#[test]
fn a_power_of_two_in_size_changes_no_digit() {
    let scaled = |scale: f64| {
        let p = LOOP.map(|p| p.map(|x| x * scale));
        let ellipse = [[1.0, 0.0], [0.2, 0.7], [-1.1, 0.1], [0.0, -0.6]];
        let contour = json!({"free": {"closed": true, "points": ellipse.map(|p| p.map(|x| 0.4 * x * scale))}});
        grid(&contour, &json!({"free": {"closed": true, "points": p}}))
    };
    let one = scaled(1.0);
    for exponent in [-30, 30] {
        let scale = 2_f64.powi(exponent);
        let other = scaled(scale);
        assert_eq!(one.normals, other.normals);
        assert!(one.positions.iter().zip(&other.positions).all(|(&a, &b)| a * scale == b));
    }
}

#[test]
fn turning_a_closed_contour_round_changes_nothing() {
    let tube = |svg: &str| grid(&json!({"svg": svg}), &json!({"line": [[0, 0, 0], [0, 0, 9]]}));
    let (clockwise, counter) = (tube("M0 0C-2 -2 2 -3 1 -1Z"), tube("M0 0L1 -1C2 -3 -2 -2 0 0Z"));
    for (a, b) in points(&clockwise).zip(points(&counter)) {
        assert!((a.2 - b.2).length() < 1e-12);
        assert!((a.3 - b.3).length() < 2.0 * NORMAL);
    }
}

#[test]
fn a_rotation_from_axis_to_axis_faces_outward_however_it_is_drawn() {
    for (up, down) in [
        ("M0 1A1 1 0 0 0 0 -1", "M0 -1A1 1 0 0 1 0 1"),
        ("M0 1H2V-1H0", "M0 -1H2V1H0"),
        ("M0 0H2V-3H1.9V-.1H0", "M0 -.1H1.9V-3H2V0H0"),
    ] {
        let swept =
            |svg: &str| grid(&json!({"svg": svg}), &json!({"rotation": {"angle_deg": 270}}));
        for (a, b) in points(&swept(up)).zip(points(&swept(down))) {
            assert!((a.2 - b.2).length() < 1e-12, "{up}");
            assert!((a.3 - b.3).length() < 2.0 * NORMAL, "{up}");
        }
    }
    // A contour from the axis to a rim has no inside, so its direction decides.
    let bowl = |svg: &str| grid(&json!({"svg": svg}), &json!({"rotation": {}}));
    let (from_axis, to_axis) = (bowl("M0 0H2V-1"), bowl("M2 -1V0H0"));
    assert_eq!(from_axis.normals[0], -to_axis.normals[to_axis.cols() - 1]);
}

#[test]
fn handles_of_no_length_change_nothing_but_the_parameter() {
    let (a, b) = ([1, 2, 3], [4, -2, 5]);
    let line = grid(&json!({"circle": 1}), &json!({"line": [a, b]}));
    let slow = grid(&json!({"circle": 1}), &json!({"bezier": {"segments": [[a, a, b, b]]}}));
    for (a, b) in points(&line).zip(points(&slow)) {
        assert!((a.2 - b.2).length() < 1e-12);
        assert!((a.3 - b.3).length() < 2.0 * NORMAL);
    }
}

#[test]
fn points_given_twice_count_once() {
    let tube = |points: Vec<[f64; 3]>| {
        grid(&json!({"circle": 0.5}), &json!({"free": {"closed": true, "points": points}}))
    };
    let mut twice = LOOP.to_vec();
    twice.insert(2, LOOP[1]);
    twice.push(LOOP[0]);
    assert_eq!(tube(twice), tube(LOOP.to_vec()));
}

#[test]
fn pictures_may_be_laid_by_the_curves_own_parameters() {
    let text = |by: &str| {
        format!(
            r#"{{"format": "tb-sweep", "version": 1, "name": "test",
            "contour": {{"bezier": {{"segments": [[[0,0],[0.1,0],[0.2,0],[0.3,0]], [[0.3,0],[0.5,0],[0.7,0],[0.9,0]]]}}}},
            "trajectory": {{"free": {{"points": [[0,0,0],[0,0,1],[0,0,4]]}}}},
            "uv": {{"by": "{by}"}}, "mesh": {{"rows": 8, "cols": 6}}}}"#
        )
    };
    let grid = |by| {
        let text = text(by);
        Sweep::read(&Document::new("test", text.as_bytes()).unwrap()).unwrap().grid()
    };
    let (even, own) = (grid("length"), grid("parameter"));
    assert_eq!((&even.positions, &even.normals), (&own.positions, &own.normals));
    assert!((even.u[2] - 1.0 / 3.0).abs() < 1e-15 && (own.u[2] - 0.5).abs() < 1e-14);
    assert_eq!((own.u[0], own.u[6], own.v[0], own.v[8]), (0.0, 1.0, 0.0, 1.0));
    // A quarter of the length is half of the points.
    assert!((even.v[2] - 0.25).abs() < 1e-15 && (own.v[2] - 0.5).abs() < 1e-12);
    sound(&own);
}

#[test]
fn every_example_is_a_spec() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "json") {
            continue;
        }
        let (name, bytes) = (path.display().to_string(), std::fs::read(&path).unwrap());
        let document = Document::new(&name, &bytes).unwrap();
        let object =
            Object::read(&document, path.parent().unwrap(), &files::Disk, &Resolution::default())
                .unwrap_or_else(|error| panic!("{error}"));
        for sweep in object.parts() {
            assert_eq!(sweep.folded_rows(), 0, "{name}");
            sound(&sweep.grid());
            if sweep.name() == "vase" {
                assert_eq!(sweep.contour().creases(), 1, "only the inner edge of the foot");
                let heights = || sweep.grid().positions.into_iter().map(|p| p.y);
                assert_eq!(heights().fold(f64::INFINITY, f64::min), 0.0);
                // The rim has its top at 2, between two columns. The nearer one is at most half a
                // column, 0.0155, away, and the curvature of the rim is at most 20.8: a sagitta of
                // 0.5 * 20.8 * 0.0155^2.
                assert!((heights().fold(0.0, f64::max) - 2.0).abs() < 2.5e-3);
            }
        }
        seen += 1;
    }
    assert!(seen >= 4);
}

/// Asserts finite points, unit normals, ascending u and v, and the counts that the grid states.
fn sound(grid: &GridMesh) {
    assert_eq!(grid.positions.len(), grid.rows() * grid.cols());
    assert_eq!(grid.normals.len(), grid.positions.len());
    assert!(grid.positions.iter().all(|p| p.is_finite()));
    assert!(grid.normals.iter().all(|n| (n.length() - 1.0).abs() < UNIT));
    for places in [&grid.u, &grid.v] {
        assert_eq!(places[0], 0.0);
        assert!(places.windows(2).all(|pair| pair[0] <= pair[1]));
        assert!(places[places.len() - 1] <= 1.0);
    }
}

fn vector() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..1.0).prop_map(DVec3::from_array)
}

/// Draws numbers that are often equal, almost equal, or very different in magnitude.
fn nasty() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => (-2..3).prop_map(f64::from),
        2 => (-2..3, -40..0).prop_map(|(n, e)| f64::from(n) + 2_f64.powi(e)),
        1 => (-1.0..1.0, -300..300).prop_map(|(x, e)| x * 2_f64.powi(e)),
        1 => -1.0..1.0,
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn rigid_motion_commutes_with_sweeping(
        path in prop::collection::vec(vector(), 4..8),
        closed: bool,
        start in vector(),
        turn in (vector(), 0.0..TAU),
        shift in vector(),
    ) {
        prop_assume!(turn.0.length() > 0.1 && start.length() > 0.1);
        let rotation = DQuat::from_axis_angle(turn.0.normalize(), turn.1);
        let sweep = |path: &[DVec3], start: DVec3| {
            let points: Vec<[f64; 3]> = path.iter().map(DVec3::to_array).collect();
            let contour = json!({"svg": "M.1 0C.1 .2 -.2 .1 -.1 0S.05 -.1 .1 0"});
            let trajectory = json!({"free": {"closed": closed, "points": points}});
            read(&contour, &trajectory, &json!({"frame": {"start": start.to_array()}}))
        };
        let moved: Vec<DVec3> = path.iter().map(|&p| rotation * p + shift).collect();
        let (Ok(here), Ok(there)) = (sweep(&path, start), sweep(&moved, rotation * start)) else {
            return Err(TestCaseError::reject("a start along the trajectory, or a cusp"));
        };
        let (here, there) = (here.grid(), there.grid());
        for (a, b) in points(&here).zip(points(&there)) {
            prop_assert!((rotation * a.2 + shift - b.2).length() < 1e-9);
        }
    }

    #[test]
    fn nasty_specs_give_sound_grids_or_a_sentence(
        flat in prop::collection::vec(prop::array::uniform2(nasty()), 1..9),
        deep in prop::collection::vec(prop::array::uniform3(nasty()), 1..9),
        closed: (bool, bool),
        kinds in (0..3, 0..4),
    ) {
        let flat_segments: Vec<_> = flat
            .chunks_exact(4)
            .scan(flat[0], |end, c| {
                let segment = [*end, c[1], c[2], c[3]];
                *end = c[3];
                Some(segment)
            })
            .collect();
        let deep_segments: Vec<_> = deep.chunks_exact(4).take(1).collect();
        let contour = match kinds.0 {
            0 => json!({"free": {"closed": closed.0, "points": flat}}),
            1 => json!({"bezier": {"segments": flat_segments}}),
            _ => json!({"circle": flat[0][0]}),
        };
        let trajectory = match kinds.1 {
            0 => json!({"free": {"closed": closed.1, "points": deep}}),
            1 => json!({"bezier": {"segments": deep_segments}}),
            2 => json!({"line": [deep[0], deep[deep.len() - 1]]}),
            _ => json!({"rotation": {"axis": deep[0]}}),
        };
        if let Ok(sweep) = read(&contour, &trajectory, &json!({})) {
            sound(&sweep.grid());
        }
    }
}
