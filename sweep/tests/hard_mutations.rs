//! Specs altered at random: numbers and keys of the examples are changed. Each spec gives a surface
//! of finite points, or one sentence with the position of the fault, and no panic. The fuzzer
//! limits the time of a case.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use fixtures::Dice;
use fixtures::alterations::{Alterations, cases, garble};
use fixtures::rounding::UNIT;
use fixtures::schema::documents;
use serde_json::{Value, json};
use sweep::spec::Resolution;
use sweep::{Object, SweepError};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves");

/// Returns the examples, and specs with the keys that the examples do not use.
fn seeds() -> Vec<Value> {
    let mut seeds: Vec<Value> =
        documents(FOLDER.as_ref()).into_iter().map(|(_, spec)| spec).collect();
    let head =
        json!({"format": "tb-sweep", "version": 1, "name": "seed", "mesh": {"rows": 9, "cols": 9}});
    let more = [
        json!({"contour": {"sections": [{"at": 0, "contour": {"circle": 0.5}},
                {"at": 0.7, "contour": {"polyline": {"closed": true, "points": [[1, 1], [-1, 1], [-1, -1], [1, -1]]}}}], "blend": "smooth"},
            "trajectory": {"line": [[0, 0, 0], [0, 3, 0]]}, "caps": {"start": "flat", "end": {"dome": 0.8}},
            "deform": [{"taper": {"from": 0, "to": 8, "factor": {"keys": [[0, 1], [1, 0.4]], "ease": "smooth"}}},
                {"twist": {"from": 2, "to": 6, "degrees": {"total": 90}}}, {"bend": {"from": 0, "to": 8, "degrees": 25, "toward": [1, 0, 0]}}]}),
        json!({"contour": {"free": {"closed": true, "points": [[0.2, 0], [0, 0.3], [-0.2, 0.1], [0, -0.2]]}},
            "trajectory": {"polyline": {"closed": true, "points": [[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 1]], "corners": {"round": 0.5}}},
            "seam": "shift", "mesh": {"tol": 0.01, "angle_deg": 20, "max_quads": 4000}}),
        json!({"contour": {"svg": "M.2 .1H-.2V-.1H.2Z"},
            "trajectory": {"polyline": {"points": [[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 1]], "corners": {"mitre": 4}}},
            "twist": {"total": 90}, "mesh": {"pixels": 0.5, "max_quads": 4000,
             "camera": {"eye": [0, 1, 9], "target": [0, 0.5, 0], "fov_deg": 40, "size": [128, 128]}}}),
        json!({"contour": {"svg": "M.2 0H-.2"}, "trajectory": {"helix": {"radius": 1, "rise": 0.5, "turns": 2, "axis": [0, 1, 0]}},
            "frame": {"up": [0, 1, 0]}, "areas": [{"rows": [0, 4], "cols": [1, 3], "texture": 2}]}),
        json!({"contour": {"circle": 0.1}, "trajectory": {"flat": {"curve": {"svg": "M0 0C2 -3 5 -3 5 0S2 3 0 0S-5 -3 -5 0S-2 3 0 0Z"},
            "z": {"keys": [[0, 0.5], [0.5, -0.5], [1, 0.5]], "ease": "smooth"}}}, "frame": {"guide": {"circle": {"radius": 9}}}}),
        json!({"contour": {"circle": 0.1}, "trajectory": {"circle": {"radius": 2, "angle_deg": 250}}, "frame": {"frenet": {}},
            "caps": {"start": "round", "end": {"pole": 1}}, "mesh": {"tol": 0.01, "max_quads": 3000}}),
    ];
    seeds.extend(more.into_iter().map(|keys| {
        let mut seed = head.clone();
        for (key, value) in keys.as_object().unwrap() {
            seed[key] = value.clone();
        }
        seed
    }));
    seeds.push(json!({"format": "tb-sweep", "version": 1, "name": "mug", "parts": [
        {"name": "a", "contour": {"svg": "M0 0H1V-2H.9V-.1H0"}, "trajectory": {"rotation": {}}, "mesh": {"rows": 6, "cols": 14}},
        {"name": "b", "contour": {"circle": 0.12}, "trajectory": {"line": [[1, 2, 3], [2, 3, 4]]}, "mesh": {"rows": 4, "cols": 6}}]}));
    seeds
}

const NUMBERS: [f64; 26] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-3,
    1e-9,
    -1e-9,
    1e-16,
    1e-70,
    5e-324,
    1e9,
    -1e9,
    1e30,
    1e59,
    1e61,
    1e155,
    1.7e308,
    -1.7e308,
    2.0,
    3.0,
    180.0,
    360.0,
    1e-30,
    0.999_999_999,
    1_000_000.0,
];

/// Limits every `mesh` to few cells.
fn bounded(spec: &mut Value) {
    let of = |part: &mut Value| {
        let Some(Value::Object(mesh)) = part.get_mut("mesh") else { return };
        for (key, most) in [("rows", 40.0), ("cols", 40.0), ("max_quads", 3000.0)] {
            if let Some(number) = mesh.get_mut(key)
                && number.as_f64().is_some_and(|x| x > most && x < 1e6)
            {
                *number = json!(most as u32);
            }
        }
        if mesh.contains_key("tol") || mesh.contains_key("angle_deg") || mesh.contains_key("pixels")
        {
            mesh.entry("max_quads").or_insert(json!(3000));
        }
    };
    of(spec);
    spec.get_mut("parts").and_then(Value::as_array_mut).into_iter().flatten().for_each(of);
}

/// Reads and sweeps a text. Returns whether it gives a surface.
fn judged(text: &[u8]) -> bool {
    let shown = String::from_utf8_lossy(text);
    let document = match Document::new("spec.json", text) {
        Ok(document) => document,
        Err(error) => {
            assert!(error.to_string().starts_with("spec.json"), "{error}\n{shown}");
            return false;
        }
    };
    let read = Object::read(&document, FOLDER.as_ref(), &files::Disk, &Resolution::default());
    match read.and_then(|object| {
        let cells = |sweep: &sweep::Sweep| sweep.rows().saturating_mul(sweep.cols());
        if object.parts().iter().map(cells).sum::<usize>() > 100_000 {
            return Ok(Vec::new());
        }
        object.grids()
    }) {
        Ok(grids) => {
            for grid in &grids {
                assert!(grid.positions.iter().all(|p| p.is_finite()), "points\n{shown}");
                let unit = |n: &glam::Vec3| (n.length() - 1.0).abs() < UNIT;
                assert!(grid.normals.iter().all(unit), "normals\n{shown}");
                for places in [&grid.u, &grid.v] {
                    assert!(places.windows(2).all(|pair| pair[0] <= pair[1]), "places\n{shown}");
                }
            }
            !grids.is_empty()
        }
        Err(error) => {
            let message = error.to_string();
            // The position is the file, a line and a column, and mostly a path.
            let placed = matches!(error, SweepError::Memory(_))
                || message.strip_prefix("spec.json:").is_some_and(|rest| {
                    rest.split(':').take(2).all(|number| number.parse::<u32>().is_ok())
                });
            assert!(placed, "{message}\n{shown}");
            assert!(
                !message.contains('\n') && message.contains("found")
                    || message.contains("expected")
                    || message.contains("key")
                    || message.contains("cannot read"),
                "{message}\n{shown}"
            );
            false
        }
    }
}

#[test]
fn thousands_of_altered_specs_give_a_surface_or_a_sentence() {
    let seeds = seeds();
    let alterations =
        Alterations { numbers: &NUMBERS, text: "M0 0C1 1 1e300 0 0 0Z", seeds: &seeds };
    let cases = cases(1500);
    let mut made: u64 = 0;
    for case in 0..cases {
        let mut dice = Dice::new(case);
        let mut spec = dice.one(&seeds).clone();
        bounded(&mut spec);
        for _ in 0..=dice.below(3) {
            alterations.alter(&mut spec, &mut dice);
        }
        bounded(&mut spec);
        let text = spec.to_string();
        let text = if dice.once_in(20) { garble(text, &mut dice) } else { text.into_bytes() };
        made += u64::from(judged(&text));
    }
    assert!(made > cases / 10, "alterations are mild enough to be swept at times: {made}");
}
