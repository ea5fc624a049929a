//! The scenes in `examples`, and what random hands make of them.

#![allow(dead_code, reason = "each test module uses its part of the examples")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::{FileError, Source};
use serde_json::{Value, json};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A small picture, and nothing else: what it is asked for is not looked at.
#[derive(Debug)]
pub struct Meshless;

impl Source for Meshless {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let is_picture = path.extension().is_some_and(|kind| kind == "png");
        let found = is_picture.then(|| {
            let texel = image::RgbImage::from_pixel(2, 2, image::Rgb([9, 90, 200]));
            let mut bytes = std::io::Cursor::new(Vec::new());
            texel.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
            bytes.into_inner()
        });
        let is_mesh = path.extension().is_some_and(|kind| kind == "obj");
        let tube = || b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n".to_vec();
        found.or(is_mesh.then(tube)).ok_or_else(|| FileError::Read {
            name: path.display().to_string(),
            source: ErrorKind::NotFound.into(),
        })
    }
}

/// The scenes by their names.
pub fn examples() -> Vec<(String, Value)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|kind| kind == "json"));
    files.sort();
    let read = |path: &PathBuf| serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    files.iter().map(|path| (path.display().to_string(), read(path))).collect()
}

/// All scenes that differ from one in one place: a key dropped or renamed, a value of another type.
pub fn mutations(scene: &Value) -> Vec<Value> {
    fn places(at: String, value: &Value, found: &mut Vec<String>) {
        match value {
            Value::Object(keys) => {
                for (key, value) in keys {
                    places(format!("{at}/{key}"), value, found);
                }
            }
            // Of many elements the first two and the last stand for all.
            Value::Array(items) => {
                for (i, item) in items.iter().enumerate() {
                    if i < 2 || i + 1 == items.len() {
                        places(format!("{at}/{i}"), item, found);
                    }
                }
            }
            _ => {}
        }
        found.push(at);
    }
    let mut found = Vec::new();
    places(String::new(), scene, &mut found);
    let mut mutated = Vec::new();
    for place in found {
        let others = [
            json!(true),
            json!("word"),
            json!({}),
            json!({"a": 1}),
            json!(-1.5),
            json!([[1, 2], 3]),
        ];
        for other in others {
            let mut scene = scene.clone();
            *scene.pointer_mut(&place).unwrap() = other;
            mutated.push(scene);
        }
        let Some((above, key)) = place.rsplit_once('/') else { continue };
        let mut dropped = scene.clone();
        match dropped.pointer_mut(above).unwrap() {
            Value::Object(keys) => {
                let value = keys.remove(key).unwrap();
                mutated.push(dropped.clone());
                let keys = dropped.pointer_mut(above).unwrap().as_object_mut().unwrap();
                keys.insert(format!("{key}x"), value);
            }
            Value::Array(items) => {
                items.remove(key.parse().unwrap());
            }
            _ => {}
        }
        mutated.push(dropped);
    }
    mutated
}

/// Random numbers that are the same in each run (`SplitMix64`).
pub struct Dice(pub u64);

impl Dice {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.next() % count as u64).unwrap()
    }

    pub fn one<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())].clone()
    }
}
