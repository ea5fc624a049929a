//! Units and positions. Scaling a spec by a power of two changes no digit, whatever its keys. A
//! position far from the origin costs only the rounding of its coordinates.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use glam::DVec3;
use serde_json::{Value, json};
use sweep::spec::Resolution;
use sweep::{GridMesh, Object};

/// Returns the grids of a spec without its header, and of its parts.
fn grids(keys: &Value) -> Vec<GridMesh> {
    let mut spec = keys.clone();
    for (key, value) in
        [("format", json!("tb-sweep")), ("version", json!(1)), ("name", json!("test"))]
    {
        spec[key] = value;
    }
    if spec.get("mesh").is_none() && spec.get("parts").is_none() {
        spec["mesh"] = json!({"rows": 40, "cols": 24});
    }
    let text = spec.to_string();
    let document = Document::new("test", text.as_bytes()).unwrap();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/textures");
    let object = Object::read(&document, folder.as_ref(), &files::Disk, &Resolution::default())
        .unwrap_or_else(|error| panic!("{error}\n{keys}"));
    object.grids().unwrap()
}

/// Returns a value of a spec in another unit of length: lengths are multiplied by `unit`.
fn in_unit(key: &str, value: &Value, unit: f64) -> Value {
    let times = |number: &Value| json!(number.as_f64().unwrap() * unit);
    match (key, value) {
        ("twist", Value::Object(keys)) if keys.contains_key("degrees") => {
            in_unit("deform", value, unit)
        }
        // These keys hold laws of pure numbers, directions and counts.
        ("scale" | "twist" | "factor" | "degrees" | "along" | "axis" | "up" | "toward", _)
        | ("at" | "angle_deg" | "turns" | "mitre" | "fov_deg" | "size", _)
        | ("rows" | "cols" | "max_quads" | "pixels" | "u" | "v" | "phase_deg" | "uv", _)
        | ("repeat" | "zero", _)
        | ("start", Value::Array(_)) => value.clone(),
        ("z", Value::Object(law)) => {
            let (kind, numbers) = law.iter().next().unwrap();
            assert_eq!(kind, "bezier");
            let segments = numbers.as_array().unwrap().iter().map(|segment| {
                let points = segment.as_array().unwrap();
                json!(points.iter().map(|p| json!([p[0], times(&p[1])])).collect::<Vec<_>>())
            });
            json!({"bezier": segments.collect::<Vec<_>>()})
        }
        ("depth", Value::Object(depth)) if depth["mode"] == "factor" => value.clone(),
        (_, Value::Object(object)) => Value::Object(
            object.iter().map(|(key, value)| (key.clone(), in_unit(key, value, unit))).collect(),
        ),
        (_, Value::Array(list)) => list.iter().map(|value| in_unit(key, value, unit)).collect(),
        (_, Value::Number(_)) => times(value),
        _ => value.clone(),
    }
}

/// Returns a closed contour without any symmetry.
fn blob() -> Value {
    json!({"free": {"closed": true, "points": [[0.3, 0.01], [0.06, 0.2], [-0.3, 0.04], [0.02, -0.17]]}})
}

fn house() -> Value {
    json!({"polyline": {"closed": true, "points": [[0.2, -0.2], [0.21, 0.1], [0, 0.3], [-0.2, 0.1], [-0.2, -0.2]]}})
}

fn bent() -> Value {
    json!({"bezier": {"segments": [[[0, 0, 0], [2, 0.4, 0.3], [1.9, 1.1, 0.2], [0.2, 0.9, 0.8]],
                                   [[0.2, 0.9, 0.8], [-1.5, 0.7, 1.4], [-1, 2, 2], [0, 3, 2]]]}})
}

fn ring() -> Value {
    json!({"free": {"closed": true, "points":
        [[4, 0, 0], [1, 2, 4], [-4, 0.5, -1], [-2, -2, -4], [3, 1, -3]]}})
}

fn line() -> Value {
    json!({"line": [[0.1, 0.2, 0], [0.3, 3, -0.7]]})
}

fn legs(corners: &Value, closed: bool) -> Value {
    json!({"polyline": {"closed": closed, "points": [[0, 0, 0], [3, 0.1, 0], [3.2, 3, 0.4], [0, 2, 2.1]],
        "corners": corners}})
}

/// Returns one spec for each feature of specs, and some specs with several features.
fn features() -> Vec<Value> {
    let smooth = json!({"keys": [[0, 1], [0.4, 0.6], [1, 1.2]], "ease": "smooth"});
    let cubic = json!({"bezier": [[[0, 0.7], [0.2, 1.2], [0.4, 0.3], [1, 0.9]]]});
    let waves = |mode: &str| json!({"mode": mode, "terms": [{"amp": 0.03, "u": 5, "v": 3, "phase_deg": 20, "along": {"total": 1}}]});
    let picture = |mode: &str| json!({"mode": mode, "image": {"file": "scales.png", "amp": 0.02, "repeat": [3, 2]}});
    let sections = |blend: &str| {
        json!({"blend": blend, "sections": [{"at": 0, "contour": blob()}, {"at": 0.6, "contour": {"circle": 0.3}},
            {"at": 0.9, "contour": house()}]})
    };
    let half = json!({"bezier": {"segments": [[[0.1, -1], [0.8, -1.1], [1.3, 0.9], [0.3, 1.2]]]}});
    let flat = json!({"flat": {"curve": {"bezier": {"segments": [[[0, 0], [1, 0.3], [2, 0.2], [1.9, 1.5]]]}},
        "z": {"bezier": [[[0, 0], [0.3, 1], [0.6, -0.4], [1, 0.3]]]}}});
    let deforms = json!([
        {"taper": {"from": 0.1, "to": 2.3, "factor": {"keys": [[0, 1], [1, 0.4]], "ease": "smooth"}, "origin": [0.1, 0, 0.2]}},
        {"twist": {"from": -0.3, "to": 2, "degrees": {"total": 90}, "axis": [0.1, 1, 0.3]}},
        {"bend": {"from": 0.2, "to": 2.7, "degrees": 70, "toward": [1, 0, 0.1]}},
    ]);
    let mut all = vec![
        json!({"contour": blob(), "trajectory": line(), "caps": {"start": "flat", "end": "round"}}),
        json!({"contour": house(), "trajectory": bent(), "caps": {"start": {"dome": 0.3}, "end": {"pole": 0.7}}}),
        json!({"contour": blob(), "trajectory": bent(), "deform": deforms}),
        json!({"contour": house(), "trajectory": line(), "deform": deforms, "caps": {"start": "round", "end": {"pole": 0.4}},
            "scale": [smooth, cubic], "twist": {"total": 200}, "position": [0.3, 0.1, 7]}),
        json!({"contour": blob(), "trajectory": bent(), "scale": smooth, "twist": cubic}),
        json!({"contour": blob(), "trajectory": line(), "scale": {"keys": [[0, 1], [1, -1]]}}),
        json!({"contour": blob(), "trajectory": bent(), "depth": waves("offset")}),
        json!({"contour": blob(), "trajectory": bent(), "depth": waves("factor")}),
        json!({"contour": blob(), "trajectory": bent(), "depth": picture("offset")}),
        json!({"contour": house(), "trajectory": bent(), "depth": picture("factor")}),
        json!({"contour": sections("linear"), "trajectory": bent()}),
        json!({"contour": sections("smooth"), "trajectory": ring(), "scale": 0.7}),
        json!({"contour": house(), "trajectory": ring()}),
        json!({"contour": blob(), "trajectory": flat}),
        json!({"contour": blob(), "trajectory": {"helix": {"radius": 1.3, "rise": 0.7, "turns": -2.2, "center": [0.1, 2, 3], "axis": [1, 2, 3]}}}),
        json!({"contour": blob(), "trajectory": {"circle": {"radius": 1.3, "center": [0.1, 2, 3], "axis": [1, 2, 3], "angle_deg": 200}}}),
        json!({"contour": half, "trajectory": {"rotation": {"origin": [0.3, 0.1, 0.7], "axis": [0, 1, 2]}}}),
        json!({"contour": half, "trajectory": {"rotation": {"angle_deg": 77}},
            "depth": {"mode": "offset", "terms": [{"amp": 0.01, "u": 3.5, "v": 2}]}}),
        json!({"contour": house(), "trajectory": legs(&json!({"mitre": 9}), false)}),
        json!({"contour": house(), "trajectory": legs(&json!({"round": 0.4}), true)}),
        json!({"contour": house(), "trajectory": legs(&json!({"mitre": 9}), false), "depth": waves("factor"),
            "scale": smooth, "twist": {"total": 77}, "caps": {"start": "flat"}}),
        json!({"contour": blob(), "trajectory": bent(), "frame": {"start": [0.3, -0.5, 0.7]}}),
        json!({"contour": blob(), "trajectory": bent(), "frame": {"up": [0.3, 0.5, -0.7]}}),
        json!({"contour": blob(), "trajectory": {"helix": {"radius": 1, "rise": 2, "turns": 1.2}}, "frame": {"frenet": {}}}),
        json!({"contour": blob(), "trajectory": line(), "frame": {"guide": {"helix": {"radius": 1, "rise": 3, "turns": 1}}}}),
        json!({"contour": {"bezier": {"segments": [[[-0.4, 0], [-0.1, 0.1], [0.1, -0.1], [0.4, 0]]]}},
            "trajectory": ring(), "seam": "mirror"}),
        json!({"contour": {"polyline": {"closed": true, "points": [[0.25, 0], [-0.125, 0.2165063509461097], [-0.125, -0.2165063509461097]]}},
            "trajectory": ring(), "seam": "shift"}),
        json!({"parts": [
            {"name": "a", "contour": blob(), "trajectory": line(), "mesh": {"rows": 5, "cols": 8}},
            {"name": "b", "contour": house(), "trajectory": ring(), "mesh": {"rows": 25, "cols": 18}}]}),
    ];
    for name in ["klein-bottle", "figure-eight-klein", "trefoil", "vase", "spring", "horn"] {
        let path = format!("{}/../examples/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let mut spec: Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
        for key in ["format", "version", "name", "mesh", "areas"] {
            spec.as_object_mut().unwrap().remove(key);
        }
        all.push(spec);
    }
    // Specs with a tolerance: of distance, of angle, and as seen by a camera.
    let camera =
        json!({"eye": [0, 1, 9], "target": [0, 0.5, 0], "fov_deg": 40, "size": [128, 128]});
    let meshes = [
        json!({"tol": 0.02}),
        json!({"tol": 0.05, "angle_deg": 30}),
        json!({"pixels": 1, "camera": camera}),
        json!({"tol": 1e-6, "max_quads": 700}),
    ];
    for i in (0..all.len()).step_by(4) {
        let mesh = &meshes[i / 4 % meshes.len()];
        if all[i].get("parts").is_none() {
            let mut spec = all[i].clone();
            spec["mesh"] = mesh.clone();
            all.push(spec);
        }
    }
    all
}

#[test]
fn a_power_of_two_in_size_changes_no_mantissa_whatever_is_asked_for() {
    for spec in features() {
        let ones = grids(&spec);
        for exponent in [-30, 30] {
            let unit = 2_f64.powi(exponent);
            let others = grids(&in_unit("", &spec, unit));
            assert_eq!(ones.len(), others.len());
            for (one, other) in ones.iter().zip(&others) {
                assert_eq!((&one.u, &one.v), (&other.u, &other.v), "2^{exponent}: {spec}");
                assert_eq!(one.normals, other.normals, "2^{exponent}: {spec}");
                let bits = |p: DVec3| p.to_array().map(f64::to_bits);
                let same = one.positions.iter().zip(&other.positions);
                let off = same.filter(|&(&a, &b)| bits(a * unit) != bits(b)).count();
                assert_eq!(off, 0, "2^{exponent}: {spec}");
                let reached = |grid: &GridMesh| grid.tolerance.as_ref().and_then(|t| t.reached);
                assert_eq!(reached(one).map(|tol| tol * unit), reached(other), "{spec}");
                assert_eq!(one.seam_v, other.seam_v);
            }
        }
    }
}

/// Moves all positions in a value.
fn moved(key: &str, value: &Value, by: f64) -> Value {
    match (key, value) {
        ("contour" | "scale" | "twist" | "depth" | "mesh" | "axis" | "toward", _)
        | ("factor" | "degrees" | "corners", _) => value.clone(),
        ("start" | "up", _) => value.clone(),
        ("center" | "origin", _) => {
            value.as_array().unwrap().iter().map(|x| json!(x.as_f64().unwrap() + by)).collect()
        }
        (_, Value::Object(object)) => Value::Object(
            object.iter().map(|(key, value)| (key.clone(), moved(key, value, by))).collect(),
        ),
        (_, Value::Array(list)) => list.iter().map(|value| moved("points", value, by)).collect(),
        ("points", Value::Number(x)) => json!(x.as_f64().unwrap() + by),
        _ => value.clone(),
    }
}

#[test]
fn far_from_the_origin_coordinates_are_within_four_ulp() {
    let shift = 2_f64.powi(30);
    let ulp = shift * f64::EPSILON;
    let o = [0.0; 3];
    // Positions are multiples of 1/64, so that a translation does not change the curve.
    let places = [
        json!({"line": [[0.125, 0.25, 0], [0.375, 3, -0.75]]}),
        json!({"bezier": {"segments": [[[0, 0, 0], [2, 0.5, 0.25], [1.875, 1.125, 0.25], [0.25, 0.875, 0.75]],
            [[0.25, 0.875, 0.75], [-1.375, 0.625, 1.25], [-1, 2, 2], [0, 3, 2]]]}}),
        json!({"free": {"closed": true, "points":
            [[4, 0, 0], [1, 2, 4], [-4, 0.5, -1], [-2, -2, -4], [3, 1, -3]]}}),
        json!({"circle": {"radius": 2, "center": o}}),
        json!({"helix": {"radius": 2, "rise": 1.5, "turns": -1.25, "center": o}}),
        json!({"rotation": {"origin": o}}),
        json!({"polyline": {"points": [[0, 0, 0], [3, 0.125, 0], [3.25, 3, 0.5], [0, 2, 2.125]], "corners": {"mitre": 9}}}),
        json!({"polyline": {"points": [[0, 0, 0], [3, 0.125, 0], [3.25, 3, 0.5], [0, 2, 2.125]], "corners": {"round": 0.5}}}),
    ];
    let laws = [
        json!({}),
        json!({"scale": {"keys": [[0, 1], [0.5, 0.5], [1, 1]], "ease": "smooth"}}),
        json!({"frame": {"start": [0.25, 0.5, 1]}, "depth": {"mode": "factor", "terms": [{"amp": 0.1, "u": 3, "v": 2}]}}),
        json!({"deform": [{"taper": {"from": 0, "to": 2, "factor": {"keys": [[0, 1], [1, 0.5]], "ease": "smooth"}, "origin": o}},
            {"bend": {"from": 0, "to": 2, "degrees": 40, "toward": [1, 0, 0], "origin": o}}]}),
    ];
    for place in &places {
        for law in &laws {
            let contour = match place.get("rotation") {
                Some(_) => {
                    json!({"bezier": {"segments": [[[0.25, -1], [0.75, -1], [1.25, 1], [0.5, 1.25]]]}})
                }
                None => json!({"bezier": {"closed": true, "segments": [
                    [[0.25, 0], [0.25, 0.25], [-0.25, 0.375], [-0.25, 0]], [[-0.25, 0], [-0.25, -0.375], [0.25, -0.25], [0.25, 0]]]}}),
            };
            let mut spec = json!({"contour": contour, "trajectory": place});
            for (key, value) in law.as_object().unwrap() {
                spec[key] = value.clone();
            }
            let mut far = spec.clone();
            far["position"] = json!([shift, shift, shift]);
            let (near, placed, there) =
                (grids(&spec), grids(&far), grids(&moved("", &spec, shift)));
            let off = |grid: &GridMesh| {
                let pairs = near[0].positions.iter().zip(&grid.positions);
                pairs.map(|(a, b)| (*a + shift - *b).abs().max_element()).fold(0.0, f64::max) / ulp
            };
            assert!(off(&placed[0]) == 0.0, "{spec}");
            assert!(off(&there[0]) <= 4.0, "{} ulp: {spec}", off(&there[0]));
        }
    }
}

/// Where a cap is so long that a tolerance asks for more cells than there are numbers, the allowed
/// number of cells is the limit.
#[test]
fn a_cap_of_any_height_stays_within_the_allowed_cells() {
    for power in (0..60).step_by(4) {
        let grids = grids(&json!({
            "contour": {"circle": 0.1}, "trajectory": {"circle": {"radius": 2, "angle_deg": 250}},
            "caps": {"start": "round", "end": {"pole": 10.0_f64.powi(power)}},
            "mesh": {"tol": 0.01, "max_quads": 300},
        }));
        let cells: usize = grids.iter().map(|grid| grid.rows() * grid.cols()).sum();
        assert!(cells <= 400, "1e{power}: {cells}");
    }
}

/// Lengths that differ by 1e29 leave no finite point of a relief. The message says so, and no grid
/// is made.
#[test]
fn a_surface_without_finite_points_is_refused() {
    let spec = json!({
        "format": "tb-sweep", "version": 1, "name": "test", "contour": {"circle": 1e29},
        "trajectory": {"line": [[0, 0, 0], [0, 2, 0]]}, "caps": {"start": "flat"},
        "scale": {"bezier": [[[0, 0.5], [0.1, 0.5], [0.3, 1.6], [0.55, 1.1]],
            [[0.55, 1.1], [0.75, 1.1], [0.85, 0.45], [1, 0.6]]]},
        "depth": {"mode": "factor", "image": {"file": "scales.png", "amp": 0.06,
            "repeat": [18, 10], "zero": 0}},
        "mesh": {"rows": 24, "cols": 24},
    });
    let text = spec.to_string();
    let document = Document::new("test", text.as_bytes()).unwrap();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/textures");
    let object = Object::read(&document, folder.as_ref(), &files::Disk, &Resolution::default());
    let error = object.unwrap().grids().unwrap_err().to_string();
    assert!(error.contains("a point of the surface is not finite"), "{error}");
}
