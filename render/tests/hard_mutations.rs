//! Scenes that nobody meant to write: keys, numbers and bytes of the examples changed at random. Each
//! gives a picture of finite colours, or a sentence with its place; soon, and without a panic.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::examples;

use examples::{Dice, Meshless, examples};
use files::json::Document;
use render::filter::Filter;
use render::scene::read::{self, Draft};
use render::scene::{MeshSource, check};
use render::shape::Mesh;
use render::shape::mesh::{NONE, Triangle};
use render::{Prepared, Settings, scene::SceneError};
use serde_json::{Map, Value, json};
use std::path::Path;
use std::time::{Duration, Instant};

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

const NUMBERS: [f64; 27] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-3,
    1e-9,
    -1e-9,
    1e-16,
    1e-29,
    1e-31,
    -1e-29,
    1e-320,
    5e-324,
    1e9,
    -1e9,
    1e15,
    1e29,
    -1e29,
    1e31,
    1e38,
    1e155,
    1e308,
    -1e308,
    64.0,
    180.0,
    0.999_999_999,
];

fn mutate(scene: &mut Value, dice: &mut Dice, seeds: &[Value]) {
    let mut at = dice.below(count(scene));
    // Most often a number: keys that are not known and values of other types end early.
    for _ in 0..dice.below(9) {
        if !nth(scene, at).is_number() {
            at = dice.below(count(scene));
        }
    }
    let other = {
        let mut seed = dice.one(seeds);
        let at = dice.below(count(&seed));
        nth(&mut seed, at).clone()
    };
    let place = nth(scene, at);
    match place {
        Value::Number(number) => {
            let x = number.as_f64().unwrap();
            *place = match dice.below(9) {
                0..5 => json!(dice.one(&NUMBERS)),
                5 => json!(-x),
                6 => json!(x * 10_f64.powi(i32::try_from(dice.below(60)).unwrap() - 30)),
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
                    // Keys of another scene.
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
                json!("../../../none"),
                json!(true),
                json!([]),
            ]);
        }
    }
}

/// Text that is most often no JSON: cut, with a byte flipped, with a number that is none, or deep.
fn garble(text: String, dice: &mut Dice) -> Vec<u8> {
    let mut bytes = text.into_bytes();
    let at = dice.below(bytes.len());
    match dice.below(7) {
        0 => bytes.truncate(at),
        1 => bytes[at] ^= 1 << dice.below(8),
        2 => bytes[at] = dice.next() as u8,
        3 => drop(bytes.remove(at)),
        4 => bytes.insert(at, dice.one(b"{}[],:\"\\eE-.0\n")),
        5 => {
            let digit = (0..bytes.len()).map(|k| (at + k) % bytes.len());
            let digit = digit.into_iter().find(|&k| bytes[k].is_ascii_digit()).unwrap();
            let number = dice.one(&["NaN", "1e400", "-1e-400", "1e99999999999", "0x1", "1e", "-"]);
            bytes.splice(digit..=digit, number.bytes());
        }
        _ => {
            let deep = dice.one(&["[", "{\"a\":"]).repeat(1000);
            bytes.splice(at..at, deep.bytes());
        }
    }
    bytes
}

/// A tetrahedron for every mesh that jobs would give.
fn tetrahedron() -> Mesh {
    let corner =
        |position: [u32; 3]| Triangle { position, uv: position, normal: [NONE; 3], surface: 0 };
    Mesh {
        positions: vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
        uvs: vec![[0., 0.], [1., 0.], [0., 1.], [1., 1.]],
        normals: vec![],
        triangles: [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(corner).to_vec(),
        surfaces: vec!["tex2_surf0".into()],
    }
}

/// Reads, checks and renders a text: whether there is a picture.
fn judged(text: &[u8]) -> bool {
    let shown = String::from_utf8_lossy(text);
    let made = Document::new("scene.json", text).map_err(SceneError::from).and_then(|document| {
        let file = read::parse(&document)?;
        let draft = Draft::gather(&document, &file, Path::new("examples/scenes"), &Meshless)?;
        let names = file.objects.iter().filter_map(|object| match object {
            render::scene::file::ObjectFile::Mesh(mesh) => Some(mesh.name.clone()),
            _ => None,
        });
        let given: MeshSource = names.map(|name| (name, tetrahedron())).collect();
        let scene = draft.resolve(&Meshless, given)?;
        let report = check::check(&draft, &scene, 1.0, &|_| 0)?;
        for line in report.to_string().lines() {
            assert!(!line.contains("NaN") || shown.contains("NaN"), "{line}\n{shown}");
        }
        Ok(scene)
    });
    match made {
        Ok(scene) => {
            let settings = Settings::new(5, 4, Filter::Tent);
            let (picture, stats) = render::render(&Prepared::new(&scene), &settings, &|_, _| {});
            let finite = |pixel: &[f32; 3]| pixel.iter().all(|x| x.is_finite() && *x >= 0.0);
            assert!(picture.pixels.iter().all(finite), "{:?}\n{shown}", picture.pixels);
            // Only where colours that are huge by themselves are multiplied.
            let huge = shown.contains("e29") || shown.contains("e+29");
            assert!(stats.not_finite == 0 || huge, "{shown}");
            true
        }
        Err(error) => {
            let message = error.to_string();
            // A place: the file, a line and a column, and mostly a path.
            let placed = message.strip_prefix("scene.json:").is_some_and(|rest| {
                rest.split(':').take(2).all(|number| number.parse::<u32>().is_ok())
            });
            assert!(placed, "{message}\n{shown}");
            let says = ["found", "expected", "key", "cannot read"];
            assert!(says.iter().any(|word| message.contains(word)), "{message}\n{shown}");
            false
        }
    }
}

#[test]
fn thousands_of_mutated_scenes_give_a_picture_or_a_sentence_in_time() {
    let seeds: Vec<Value> = examples().into_iter().map(|(_, scene)| scene).collect();
    let cases = 6000;
    let (mut made, mut slowest) = (0, (Duration::ZERO, String::new()));
    for case in 0..cases {
        let mut dice = Dice(case);
        let mut scene = dice.one(&seeds);
        for _ in 0..=dice.below(3) {
            mutate(&mut scene, &mut dice, &seeds);
        }
        let mut text = scene.to_string().into_bytes();
        if dice.below(5) == 0 {
            text = garble(String::from_utf8(text).unwrap(), &mut dice);
        }
        let start = Instant::now();
        made += usize::from(judged(&text));
        let took = start.elapsed();
        if took > slowest.0 {
            slowest = (took, String::from_utf8_lossy(&text).into_owned());
        }
    }
    println!("{made} of {cases} are pictures; the slowest took {:?}\n{}", slowest.0, slowest.1);
    assert!(made > 900, "mutations are mild enough to be rendered at times: {made}");
    // Generous, for a machine that does other work.
    assert!(slowest.0 < Duration::from_secs(4), "{:?}: {}", slowest.0, slowest.1);
}
