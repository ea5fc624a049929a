//! Specs that nobody meant to write: numbers and keys of the examples changed at random. Each gives a
//! surface of finite points, or a sentence with its place; soon, and without a panic.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use serde_json::{Map, Value, json};
use std::time::{Duration, Instant};
use sweep::spec::Resolution;
use sweep::{Object, SweepError};

/// Random numbers that are the same in each run (`SplitMix64`).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.next() % count as u64).unwrap()
    }

    fn one<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())].clone()
    }
}

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves");

/// The examples, and specs with what they do not use.
fn seeds() -> Vec<Value> {
    let mut files: Vec<_> =
        std::fs::read_dir(FOLDER).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let mut seeds: Vec<Value> = files
        .iter()
        .map(|path| serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap())
        .collect();
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

/// The number of values in a value, itself counted.
fn count(value: &Value) -> usize {
    match value {
        Value::Array(list) => 1 + list.iter().map(count).sum::<usize>(),
        Value::Object(object) => 1 + object.values().map(count).sum::<usize>(),
        _ => 1,
    }
}

/// The value of a number in the order of reading.
fn nth(value: &mut Value, n: usize) -> &mut Value {
    if n == 0 {
        return value;
    }
    let mut left = n - 1;
    let inner: Vec<&mut Value> = match value {
        Value::Array(list) => list.iter_mut().collect(),
        Value::Object(object) => object.values_mut().collect(),
        _ => Vec::new(),
    };
    for value in inner {
        let size = count(value);
        if left < size {
            return nth(value, left);
        }
        left -= size;
    }
    unreachable!("fewer values than were counted")
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

fn mutate(spec: &mut Value, dice: &mut Dice, seeds: &[Value]) {
    let at = dice.below(count(spec));
    let other = {
        let mut seed = dice.one(seeds);
        let at = dice.below(count(&seed));
        nth(&mut seed, at).clone()
    };
    let place = nth(spec, at);
    match place {
        Value::Number(number) => {
            let x = number.as_f64().unwrap();
            *place = match dice.below(9) {
                0..4 => json!(dice.one(&NUMBERS)),
                4 => json!(-x),
                5 => json!(x * 10_f64.powi(i32::try_from(dice.below(40)).unwrap() - 20)),
                6 => json!(x + 1e-9),
                7 => other,
                _ => json!(x.round() as i64),
            };
        }
        Value::Array(list) if !list.is_empty() => {
            let (a, b) = (dice.below(list.len()), dice.below(list.len()));
            match dice.below(6) {
                0 => list.swap(a, b),
                1 => drop(list.remove(a)),
                2 => list.insert(b, list[a].clone()),
                3 => list[a] = list[b].clone(),
                4 => list.reverse(),
                _ => list[a] = other,
            }
        }
        Value::Object(object) if !object.is_empty() => {
            let keys: Vec<String> = object.keys().cloned().collect();
            let (a, b) = (dice.one(&keys), dice.one(&keys));
            match dice.below(5) {
                0 => drop(object.remove(&a)),
                1 => object[&a] = object[&b].clone(),
                2 => object[&a] = other,
                3 => *place = json!({ a: object }),
                _ => {
                    // Keys of another spec.
                    let all: Map<String, Value> = dice.one(seeds).as_object().unwrap().clone();
                    let keys: Vec<String> = all.keys().cloned().collect();
                    let key = dice.one(&keys);
                    object.insert(key.clone(), all[&key].clone());
                }
            }
        }
        _ => {
            *place = dice.one(&[
                other,
                Value::Null,
                json!("NaN"),
                json!("M0 0C1 1 1e300 0 0 0Z"),
                json!(true),
                json!([]),
            ]);
        }
    }
}

/// Every `mesh` with few cells.
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

/// Reads and sweeps a text: whether there is a surface.
fn judged(text: &str) -> bool {
    let document = match Document::new("spec.json", text.as_bytes()) {
        Ok(document) => document,
        Err(error) => {
            assert!(error.to_string().starts_with("spec.json"), "{error}\n{text}");
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
                assert!(grid.positions.iter().all(|p| p.is_finite()), "points\n{text}");
                let unit = |n: &glam::Vec3| (n.length() - 1.0).abs() < 1e-5;
                assert!(grid.normals.iter().all(unit), "normals\n{text}");
                for places in [&grid.u, &grid.v] {
                    assert!(places.windows(2).all(|pair| pair[0] <= pair[1]), "places\n{text}");
                }
            }
            !grids.is_empty()
        }
        Err(error) => {
            let message = error.to_string();
            // A place: the file, a line and a column, and mostly a path.
            let placed = matches!(error, SweepError::Memory(_))
                || message.strip_prefix("spec.json:").is_some_and(|rest| {
                    rest.split(':').take(2).all(|number| number.parse::<u32>().is_ok())
                });
            assert!(placed, "{message}\n{text}");
            assert!(
                !message.contains('\n') && message.contains("found")
                    || message.contains("expected")
                    || message.contains("key")
                    || message.contains("cannot read"),
                "{message}\n{text}"
            );
            false
        }
    }
}

#[test]
fn thousands_of_mutated_specs_give_a_surface_or_a_sentence_in_time() {
    let seeds = seeds();
    let cases = 3000;
    let (mut made, mut slowest) = (0, (Duration::ZERO, String::new()));
    for case in 0..cases {
        let mut dice = Dice(case);
        let mut spec = dice.one(&seeds);
        bounded(&mut spec);
        for _ in 0..=dice.below(3) {
            mutate(&mut spec, &mut dice, &seeds);
        }
        bounded(&mut spec);
        let mut text = spec.to_string();
        if dice.below(20) == 0 {
            // Text that is no JSON: cut, or with a number that is none.
            let at = dice.below(text.len());
            text = match dice.below(3) {
                0 => text.chars().take(at).collect(),
                1 => text.replacen("0.", "NaN", 1),
                _ => text.replacen("0.", "1e400", 1),
            };
        }
        let start = Instant::now();
        made += usize::from(judged(&text));
        let took = start.elapsed();
        if took > slowest.0 {
            slowest = (took, text);
        }
    }
    println!("{made} of {cases} are surfaces; the slowest took {:?}\n{}", slowest.0, slowest.1);
    assert!(made > 300, "mutations are mild enough to be swept at times: {made}");
    // Generous, for a machine that does other work and a build that is not optimized.
    assert!(slowest.0 < Duration::from_secs(4), "{:?}: {}", slowest.0, slowest.1);
}
