//! Surfaces that are hard for modelers, from a spec to triangles: their topology and shape.

use crate::made::{made, walked_twice};
use files::json::Document;
use glam::DVec3;
use proptest::prelude::*;
use serde_json::{Value, json};
use sweep::{GridMesh, Sweep, SweepError};
use triangulate::TriMesh;

fn read(keys: &Value) -> Result<Sweep, SweepError> {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test", "mesh": {"rows": 48, "cols": 24},
    });
    for (key, value) in keys.as_object().expect("keys") {
        spec[key] = value.clone();
    }
    Sweep::read(&Document::new("test", spec.to_string().as_bytes()).expect("it is JSON"))
}

fn swept(keys: &Value) -> GridMesh {
    read(keys).unwrap_or_else(|error| panic!("{error}\n{keys}")).grid()
}

fn example(name: &str) -> Value {
    let path = format!("{}/../examples/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read(path).expect("the example is there");
    let mut spec: Value = serde_json::from_slice(&text).expect("it is JSON");
    // Areas count cells, and the cells here differ.
    spec.as_object_mut().expect("keys").remove("areas");
    spec
}

fn corners(mesh: &TriMesh) -> impl Iterator<Item = ([DVec3; 3], [DVec3; 3])> {
    let vector = |p: [f32; 3]| DVec3::from(p.map(f64::from));
    mesh.triangles.iter().map(move |triangle| {
        let places = triangle.position.map(|i| vector(mesh.positions[i as usize]));
        (places, triangle.normal.map(|i| vector(mesh.normals[i as usize])))
    })
}

fn volume(mesh: &TriMesh) -> f64 {
    corners(mesh).map(|([a, b, c], _)| a.dot(b.cross(c)) / 6.0).sum()
}

fn ring() -> Value {
    json!({"circle": {"radius": 2}})
}

fn trefoil() -> Value {
    example("trefoil")["trajectory"].clone()
}

#[test]
fn the_klein_bottle_is_closed_one_sided_and_turns_over_along_one_ring() {
    for (rows, cols) in [(70, 70), (31, 33), (48, 9)] {
        let mut spec = example("klein-bottle");
        spec["mesh"] = json!({"rows": rows, "cols": cols});
        let grid = swept(&spec);
        let even = cols + cols % 2;
        assert_eq!(grid.cols(), even);
        let (mesh, counts, report) = made(&grid);
        assert_eq!((report.euler, report.boundary_loops), (0, 0));
        assert!(report.closed && report.manifold && !report.orientable);
        assert_eq!(walked_twice(&mesh), even);
        assert_eq!(counts.collapsed, 0);
    }
}

#[test]
fn a_moebius_band_has_one_rim_also_where_it_closes_with_an_edge() {
    // Keys with different slopes give the seam an edge. A twist of more half turns also gives a
    // band.
    let edge = json!({"keys": [[0, 0], [0.3, 20], [1, 180]]});
    for twist in [json!({"total": 180}), json!({"total": -540}), edge] {
        let band = json!({"contour": {"svg": "M-.4 0H.4"}, "trajectory": ring(), "seam": "mirror", "twist": twist});
        let (mesh, counts, report) = made(&swept(&band));
        assert_eq!((report.euler, report.boundary_loops), (0, 1));
        assert!(!report.closed && report.manifold && !report.orientable);
        // Edges are no longer than steps of the twist, so that no cell is torn across the band.
        assert!(
            report.edge_length.is_some_and(|length| length.max < 0.6),
            "{:?}",
            report.edge_length
        );
        assert_eq!(walked_twice(&mesh), 24);
        assert_eq!(counts.slivers, 0);
    }
}

#[test]
fn the_figure_of_eight_immersion_is_a_klein_bottle_on_any_ring() {
    let eight = example("figure-eight-klein")["contour"].clone();
    let mitred = json!({"polyline": {"closed": true, "points": [[2, 0, 0], [4, 0, 0], [4, 3, 0.5], [0, 3, 0], [0, 0, 0]],
        "corners": {"mitre": 9}}});
    for trajectory in [ring(), trefoil(), mitred] {
        let grid = swept(
            &json!({"contour": eight, "trajectory": trajectory, "seam": "mirror", "scale": 0.5}),
        );
        let (_, _, report) = made(&grid);
        assert!(report.closed && !report.orientable, "{trajectory}");
        // Where the figure of eight crosses itself, two columns share a position but not a point.
        assert_eq!(report.euler, 0, "{trajectory}");
    }
}

#[test]
fn tubes_along_knots_and_an_eight_are_tori() {
    let knot = |p: f64, q: f64| {
        let point = |i: u32| {
            let t = std::f64::consts::TAU * f64::from(i) / 60.0;
            let r = 2.0 + (q * t).cos();
            [r * (p * t).cos(), r * (p * t).sin(), -(q * t).sin()]
        };
        json!({"free": {"closed": true, "points": (0..60).map(point).collect::<Vec<_>>()}})
    };
    let eight = |i: u32| {
        let t = std::f64::consts::TAU * f64::from(i) / 24.0;
        [3.0 * t.sin(), 0.0, (2.0 * t).sin()]
    };
    // The planar eight intersects itself and stays two sheets there.
    let eight = json!({"free": {"closed": true, "points": (0..24).map(eight).collect::<Vec<_>>()}});
    for trajectory in [knot(2.0, 5.0), knot(2.0, 3.0), trefoil(), eight] {
        let tube = json!({"contour": {"circle": 0.15}, "trajectory": trajectory, "mesh": {"rows": 200, "cols": 12}});
        let (mesh, _, report) = made(&swept(&tube));
        assert_eq!((report.euler, report.vertices), (0, 2400));
        assert!(report.closed && report.orientable && report.oriented && report.manifold);
        // The volume is the area of the section times the length of the path (Pappus).
        let length = read(&tube).expect("it is a spec").trajectory().length();
        let section = 0.5 * 12.0 * 0.15_f64.powi(2) * (std::f64::consts::TAU / 12.0).sin();
        assert!((volume(&mesh) / (section * length) - 1.0).abs() < 0.01, "{}", volume(&mesh));
    }
}

#[test]
fn a_three_fold_star_on_a_trefoil_is_a_torus_that_is_not_torn() {
    let points = [[0.3, 0.0], [-0.15, 0.259_807_621_135_331_6], [-0.15, -0.259_807_621_135_331_6]];
    let star = json!({"polyline": {"closed": true, "points": points}});
    let tube = json!({"contour": star, "trajectory": trefoil(), "seam": "shift", "mesh": {"rows": 240, "cols": 24}});
    let grid = swept(&tube);
    assert_eq!(3 * grid.shift % grid.cols(), 0);
    let (mesh, _, report) = made(&grid);
    assert_eq!((report.euler, report.boundary_loops), (0, 0));
    assert!(report.closed && report.orientable && report.oriented && report.manifold);
    assert!(report.edge_length.is_some_and(|length| length.max < 0.3), "{:?}", report.edge_length);
    assert!(volume(&mesh) > 0.0);
}

fn contours() -> impl Strategy<Value = Value> {
    let blob = |points: [[f64; 2]; 4]| json!({"free": {"closed": true, "points": points}});
    let drawn = |reversed: bool, mut points: [[f64; 2]; 4]| {
        if reversed {
            points.reverse();
        }
        points
    };
    prop_oneof![
        (0.1..0.3).prop_map(|r| json!({"circle": r})),
        (0.1..0.25, 0.1..0.25, any::<bool>()).prop_map(move |(a, b, reversed): (f64, f64, bool)| blob(drawn(
            reversed,
            [[a, 0.0], [0.0, b], [-b, 0.02], [0.01, -a]]
        ))),
        (0.1..0.25, 0.1..0.25, any::<bool>()).prop_map(move |(a, b, reversed): (f64, f64, bool)| {
            let points = drawn(reversed, [[a, -b], [a, b], [-a, b], [-b, -a]]);
            json!({"polyline": {"closed": true, "points": points}})
        }),
        (0.1..0.25, 0.1..0.25).prop_map(|(a, b): (f64, f64)| json!({"sections": [
            {"at": 0.1, "contour": {"circle": a}}, {"at": 0.6, "contour": {"polyline": {"closed": true,
                "points": [[b, -b], [b, b], [-b, b], [-b, -b]]}}}], "blend": "smooth"})),
    ]
}

/// Draws open and closed trajectories, whose bends are wider than the contours.
fn trajectories() -> impl Strategy<Value = (Value, bool)> {
    let bent = json!([[[0, 0, 0], [2, 0.4, 0.3], [1.9, 2.1, 0.2], [0.2, 1.9, 0.8]]]);
    prop::sample::select(vec![
        (json!({"line": [[0, 0, 0], [0.3, 2, 0.1]]}), false),
        (json!({"bezier": {"segments": bent}}), false),
        (json!({"helix": {"radius": 1.5, "rise": 1, "turns": -1.4}}), false),
        (json!({"circle": {"radius": 1.5, "angle_deg": 250}}), false),
        (
            json!({"polyline": {"points": [[0, 0, 0], [2, 0, 0], [2, 2, 0.4], [0, 3, 1]], "corners": {"mitre": 4}}}),
            false,
        ),
        (ring(), true),
        (trefoil(), true),
        (
            json!({"free": {"closed": true, "points": [[2, 0.5, 0], [0, -0.5, 2], [-2, 0.5, 0], [0, -0.5, -2]]}}),
            true,
        ),
        (
            json!({"polyline": {"closed": true, "points": [[0, 0, 0], [3, 0, 0], [3, 2, 0.4], [0, 2, 0]], "corners": {"mitre": 4}}}),
            true,
        ),
    ])
}

fn laws() -> impl Strategy<Value = Value> {
    let scale = prop::sample::select(vec![
        Value::Null,
        json!(-0.8),
        json!([-1, 0.8]),
        json!([0.7, -1]),
        json!({"keys": [[0, 1], [0.5, 0.6], [1, 1]], "ease": "smooth"}),
    ]);
    let twist = prop::sample::select(vec![
        Value::Null,
        json!({"total": 360}),
        json!({"total": -360}),
        json!(77),
    ]);
    let depth = prop::sample::select(vec![
        Value::Null,
        json!({"mode": "factor", "terms": [{"amp": 0.1, "u": 2, "v": 1}]}),
    ]);
    let deform = prop::sample::select(vec![
        Value::Null,
        json!([{"taper": {"from": -1, "to": 3, "factor": {"keys": [[0, 1], [1, 0.5]], "ease": "smooth"}}}]),
        json!([{"twist": {"from": -1, "to": 3, "degrees": {"total": 40}}}, {"bend": {"from": 0, "to": 3, "degrees": 15, "toward": [1, 0, 0]}}]),
    ]);
    (scale, twist, depth, deform).prop_map(|(scale, twist, depth, deform)| {
        let keys = [("scale", scale), ("twist", twist), ("depth", depth), ("deform", deform)];
        keys.into_iter()
            .filter(|(_, value)| !value.is_null())
            .map(|(key, value)| (key.to_owned(), value))
            .collect()
    })
}

fn caps() -> impl Strategy<Value = [Value; 2]> {
    let cap = prop::sample::select(vec![
        json!("flat"),
        json!("round"),
        json!({"dome": 0.2}),
        json!({"pole": 0.3}),
    ]);
    [cap.clone(), cap]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn closed_surfaces_have_their_outside_outside(
        contour in contours(),
        (trajectory, closed) in trajectories(),
        laws in laws(),
        [start, end] in caps(),
    ) {
        let mut spec = json!({"contour": contour, "trajectory": trajectory, "mesh": {"rows": 96, "cols": 32}});
        for (key, value) in laws.as_object().expect("keys") {
            spec[key] = value.clone();
        }
        if !closed {
            spec["caps"] = json!({"start": start, "end": end});
        }
        let Ok(sweep) = read(&spec) else {
            return Err(TestCaseError::reject("a contour that does not come back to itself"));
        };
        let threads = |count: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("threads");
            pool.install(|| sweep.grid())
        };
        let grid = threads(1);
        prop_assert_eq!(&grid, &threads(3));
        for places in [&grid.u, &grid.v] {
            prop_assert!(places.windows(2).all(|pair| pair[0] <= pair[1]));
        }
        prop_assert!(grid.positions.iter().all(|p| p.is_finite()));
        let (mesh, _, report) = made(&grid);
        prop_assert_eq!(report.euler, if closed { 0 } else { 2 }, "{}", &spec);
        prop_assert!(report.closed && report.manifold && report.orientable && report.oriented, "{}", &spec);
        prop_assert!(volume(&mesh) > 0.0, "{}: {}", volume(&mesh), &spec);
        if sweep.folded_rows() == 0 {
            // At a pole the normals of a cone's tip are tilted, but none points to the other side.
            for ([a, b, c], normals) in corners(&mesh) {
                let across = (b - a).cross(c - a);
                // A triangle as thin as the rounding of its coordinates has no reliable normal.
                if across.length() < 1e-9 {
                    continue;
                }
                let least = normals.map(|n| n.dot(across.normalize())).into_iter().fold(1.0, f64::min);
                prop_assert!(least > 0.0, "{least} at {a} {b} {c}, {} {normals:?}: {}", across.length(), &spec);
            }
        }
    }
}
