//! Cells for a tolerance: the tolerance is kept, by an independent measurement too, with few cells.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use glam::DVec3;
use serde_json::{Value, json};
use sweep::resolution::{Reached, Resolution};
use sweep::{Sweep, SweepError};

fn read(spec: &Value) -> Result<Sweep, SweepError> {
    let text = spec.to_string();
    Sweep::read(&Document::new("test", text.as_bytes()).unwrap())
}

fn spec(contour: Value, trajectory: Value, laws: Value, mesh: Value) -> Value {
    let mut spec = json!({"format": "tb-sweep", "version": 1, "name": "test"});
    for (key, value) in [("contour", contour), ("trajectory", trajectory), ("mesh", mesh)] {
        spec[key] = value;
    }
    for (key, value) in laws.as_object().unwrap() {
        spec[key] = value.clone();
    }
    spec
}

fn example(name: &str, mesh: Value) -> Value {
    let file = format!("{}/../examples/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let mut spec: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    spec["mesh"] = mesh;
    spec
}

/// Returns the distance of a point from a triangle: the least distance from its chords along one
/// side, by a convex search.
fn distance(point: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_chord = |s: f64| {
        let (from, to) = (a + (b - a) * s, a + (c - a) * s);
        let (along, off) = (to - from, point - from);
        let t = off.dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        (off - along * t.clamp(0.0, 1.0)).length()
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..48 {
        let third = (high - low) / 3.0;
        if to_chord(low + third) <= to_chord(high - third) { high -= third } else { low += third }
    }
    to_chord(0.5 * (low + high))
}

/// Returns the largest distance of points scattered over the surface from the triangles of their
/// cell and its neighbours. The better of both diagonals counts, since the rule of the cut is not
/// known here.
fn strewn(sweep: &Sweep, places: u32) -> f64 {
    let grid = sweep.grid();
    let (rows, cols) = (grid.rows(), grid.cols());
    let around = sweep.contour().closed();
    let along = sweep.trajectory().closed();
    let mut worst = 0.0_f64;
    for i in 0..places {
        let place = |golden: f64| (f64::from(i) * golden + 0.37).fract();
        let (u, v) = (place(0.754_877_666_246_692_7), place(0.569_840_290_998_053_2));
        let (point, _) = sweep.at(u, v);
        let col = grid.u.partition_point(|&at| at <= u) - 1;
        let row = grid.v.partition_point(|&at| at <= v) - 1;
        let mut nearest = f64::INFINITY;
        for (down, left) in (0..9).map(|k| (k / 3, k % 3)) {
            let near = |at: usize, off: usize, count: usize, closed: bool| {
                let at = (at + off).checked_sub(1);
                match at {
                    None => closed.then_some(count - 1),
                    Some(at) if closed => Some(at % count),
                    Some(at) => (at + 1 < count).then_some(at),
                }
            };
            let (Some(r), Some(c)) = (near(row, down, rows, along), near(col, left, cols, around))
            else {
                continue;
            };
            let (r1, c1) = ((r + 1) % rows, (c + 1) % cols);
            let at = |r: usize, c: usize| grid.positions[r * cols + c];
            let [a, b, c, d] = [at(r, c), at(r, c1), at(r1, c1), at(r1, c)];
            let pair = |p, q| distance(point, p).min(distance(point, q));
            // The smaller distance for either diagonal.
            let far = pair([a, b, c], [a, c, d]).min(pair([a, b, d], [b, c, d]));
            nearest = nearest.min(far);
        }
        worst = worst.max(nearest);
    }
    worst
}

/// Reads a spec and checks that its tolerance is kept, by the reported value and by scattered
/// points.
fn kept(spec: &Value) -> (Sweep, Reached) {
    let sweep = read(spec).unwrap_or_else(|error| panic!("{error}"));
    let reached = sweep.reached().unwrap();
    assert!(reached.kept, "{reached:?}");
    assert_eq!(sweep.missed(), None);
    assert_eq!(reached.quads, sweep.rows() * sweep.cols());
    let tol = spec["mesh"]["tol"].as_f64().unwrap();
    assert!(reached.tol <= tol);
    let Resolution::Tolerance(asked) = sweep.resolution() else { panic!("not a tolerance") };
    let again = sweep.measure(asked);
    assert_eq!(Reached { rounds: reached.rounds, ..again }, reached);
    // A surface that is not of second order may be farther off within a cell than at the middles,
    // where it is measured: by up to a ninth for these specs.
    let strewn = strewn(&sweep, 3000);
    // The convex search ends within a root of the rounding.
    let positions = sweep.grid().positions;
    let size = positions.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    assert!(strewn <= 1.2 * reached.tol + 1e-8 * size, "{strewn:e} against {reached:?}");
    (sweep, reached)
}

fn tol(tol: f64) -> Value {
    json!({ "tol": tol })
}

#[test]
fn the_examples_keep_what_is_asked() {
    for name in ["trefoil", "fluted-vase", "figure-eight", "vase", "horn", "cup-handle", "spring"] {
        for asked in [2e-2, 2e-3] {
            println!("{name}");
            kept(&example(name, tol(asked)));
        }
    }
}

#[test]
fn a_cone_and_a_cylinder_have_one_row() {
    let line = json!({"line": [[0, 0, 0], [0, 3, 0]]});
    let circle = json!({"circle": 1});
    let (cylinder, reached) = kept(&spec(circle.clone(), line.clone(), json!({}), tol(1e-3)));
    assert_eq!(cylinder.rows(), 1);
    // A chord over 2 pi / n is 1 - cos(pi / n) off.
    let fewest = (1..).find(|&n| 1.0 - (std::f64::consts::PI / f64::from(n)).cos() <= 1e-3);
    assert_eq!(Some(cylinder.cols() as i32), fewest);
    let sagitta = 1.0 - (std::f64::consts::PI / cylinder.cols() as f64).cos();
    assert!((reached.tol - sagitta).abs() < 1e-12);
    assert_eq!(
        cylinder.grid().u,
        read(&spec(
            circle.clone(),
            line.clone(),
            json!({}),
            json!({"rows": 1, "cols": cylinder.cols()})
        ))
        .unwrap()
        .grid()
        .u
    );
    let cone = json!({"scale": {"keys": [[0, 1], [1, 0]]}});
    assert_eq!(kept(&spec(circle, line, cone, tol(1e-3))).0.rows(), 1);
}

#[test]
fn what_is_flat_is_one_cell_for_each_piece() {
    let line = json!({"line": [[0, 0, 0], [0, 3, 0]]});
    let sheet = spec(json!({"svg": "M0 0H2"}), line.clone(), json!({}), tol(1e-9));
    let (sheet, reached) = kept(&sheet);
    assert_eq!((sheet.rows(), sheet.cols()), (1, 1));
    assert!(reached.tol < 1e-15);
    let (bar, _) = kept(&spec(json!({"svg": "M0 0H2V-1H0Z"}), line, json!({}), tol(1e-9)));
    assert_eq!((bar.rows(), bar.cols()), (1, 4));
}

#[test]
fn a_hundred_turns_of_twist_have_their_rows() {
    let square = json!({"svg": "M1 1H-1V-1H1Z"});
    let line = json!({"line": [[0, 0, 0], [0, 4, 0]]});
    let twist = json!({"twist": {"total": 36000}});
    let (column, reached) = kept(&spec(square, line, twist, tol(2e-2)));
    assert!(column.rows() > 100 * 8, "{}", column.rows());
    assert!(reached.quads < 500_000);
}

#[test]
fn a_thousand_lobes_are_all_seen() {
    let line = json!({"line": [[0, 0, 0], [0, 1, 0]]});
    let lobes = json!({"depth": {"mode": "factor", "terms": [{"amp": 0.001, "u": 1000}]}});
    let (lobed, reached) = kept(&spec(json!({"circle": 1}), line, lobes, tol(2e-4)));
    assert!(lobed.cols() > 4000 && lobed.rows() == 1, "{} {}", lobed.rows(), lobed.cols());
    // At least half of the tolerance is used: the cells are not finer than the lobes need.
    assert!(reached.tol > 1e-4);
}

#[test]
fn a_sharp_bend_gets_cells_where_it_is() {
    let bend = json!({"bezier": {"segments": [[[1, 0], [1, 1.2], [1, 0.98], [2, 1]]]}});
    let bent = spec(bend, json!({"rotation": {}}), json!({}), tol(1e-3));
    let (bent, _) = kept(&bent);
    let grid = bent.grid();
    let widths: Vec<f64> = grid.u.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let [least, most] = [f64::min, f64::max].map(|f| widths.iter().copied().reduce(f).unwrap());
    assert!(most > 5.0 * least, "{least} to {most}");
}

#[test]
fn the_unit_does_not_matter() {
    let scaled = |by: f64| {
        let points = [[0.3, 0.0], [0.9, 0.4], [0.5, 1.1], [0.7, 1.5]];
        let points = points.map(|p| p.map(|x| x * by));
        let contour = json!({"free": {"points": points}});
        let (sweep, reached) =
            kept(&spec(contour, json!({"rotation": {}}), json!({}), tol(1e-3 * by)));
        (sweep.rows(), sweep.cols(), reached.tol / by)
    };
    let one = scaled(1.0);
    for by in [2f64.powi(-30), 2f64.powi(30)] {
        assert_eq!(scaled(by), one);
    }
    // Other factors round the curves themselves, and other cells, nearly as good, may be found.
    for by in [1e-9, 1e9] {
        let other = scaled(by);
        let ratio = (other.0 * other.1) as f64 / (one.0 * one.1) as f64;
        assert!((0.95..1.05).contains(&ratio), "{by:e}: {other:?} against {one:?}");
    }
}

#[test]
fn angles_are_kept_too() {
    let mesh = json!({"tol": 1e-2, "angle_deg": 4});
    for name in ["trefoil", "horn", "vase"] {
        let (_, reached) = kept(&example(name, mesh.clone()));
        assert!(reached.angle_deg <= 4.0 && reached.angle_deg > 3.0, "{name}: {reached:?}");
    }
    let alone = read(&example("trefoil", json!({"angle_deg": 4}))).unwrap();
    assert!(alone.reached().unwrap().kept);
    // A cylinder's facets are half a step off its normals.
    let line = json!({"line": [[0, 0, 0], [0, 3, 0]]});
    let cylinder =
        read(&spec(json!({"circle": 1}), line, json!({}), json!({"angle_deg": 10.5}))).unwrap();
    assert_eq!((cylinder.rows(), cylinder.cols()), (1, 18));
}

#[test]
fn an_edge_with_one_normal_keeps_the_angle_on_both_sides() {
    let line = json!({"line": [[0, 0, 0], [0, 3, 0]]});
    let spool = json!({"scale": {"keys": [[0, 1], [0.3, 0.5], [0.7, 0.5], [1, 1]]}});
    let mesh = json!({"tol": 1e-3, "angle_deg": 12});
    let (spool, _) = kept(&spec(json!({"circle": 1}), line, spool, mesh));
    assert_eq!(spool.grid().v, [0.0, 0.3, 0.7, 1.0]);
}

#[test]
fn too_few_quads_come_as_near_as_they_can() {
    let asked = json!({"tol": 1e-5, "max_quads": 5000});
    let few = read(&example("trefoil", asked)).unwrap();
    let reached = few.reached().unwrap();
    assert!(!reached.kept && reached.quads <= 5000 && reached.quads > 4500, "{reached:?}");
    assert!(few.missed().unwrap().contains("of at most 5000 quads"));
    // A spec with the reached value as its tolerance takes about as many cells.
    let (_, again) = kept(&example("trefoil", tol(reached.tol * 1.001)));
    assert!(again.quads as f64 > 0.9 * reached.quads as f64, "{again:?} against {reached:?}");
}

#[test]
fn adaptive_cells_are_never_more_than_even_ones() {
    for name in ["trefoil", "fluted-vase", "figure-eight", "vase", "horn", "cup-handle"] {
        let (sweep, reached) = kept(&example(name, tol(5e-3)));
        let Resolution::Tolerance(asked) = sweep.resolution().clone() else { panic!() };
        // Even grids with slightly fewer cells, in all proportions.
        for tilt in -12..=12 {
            let aspect = sweep.rows() as f64 / sweep.cols() as f64 * 1.2_f64.powi(tilt);
            let cols = (0.97 * reached.quads as f64 / aspect).sqrt();
            let (rows, cols) = ((cols * aspect) as usize, cols as usize);
            let even = sweep.clone().with_resolution(Some(rows.max(3)), Some(cols.max(3)));
            let even = even.unwrap().measure(&asked);
            assert!(!even.kept || even.quads >= reached.quads, "{name}: {even:?} {reached:?}");
        }
    }
}

#[test]
fn what_a_camera_does_not_see_is_coarser() {
    let camera = |target: f64| json!({"eye": [0, 0, 6], "target": [target, 0, 0], "fov_deg": 40, "size": [512, 512]});
    let ring = |camera: Value| {
        let mesh = json!({"pixels": 0.5, "camera": camera});
        let torus = json!({"circle": {"radius": 1, "axis": [0, 0, 1]}});
        read(&spec(json!({"circle": 0.3}), torus, json!({}), mesh)).unwrap()
    };
    let (seen, unseen) = (ring(camera(0.0)), ring(camera(60.0)));
    let [a, b] = [&seen, &unseen].map(|sweep| sweep.reached().unwrap());
    assert!(a.kept && b.kept && a.pixels.unwrap() <= 0.5 && a.pixels.unwrap() > 0.4);
    assert!(8 * b.quads < a.quads, "{a:?} {b:?}");
    assert!(b.quads >= 3 * 3 && b.tol < 16.0 * 2.0 * a.tol, "not dropped: {b:?}");
}

#[test]
fn any_number_of_threads_cuts_alike() {
    let spec = example("fluted-vase", tol(1e-2));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| read(&spec).unwrap().grid())
    };
    assert_eq!(with(1), with(3));
}
