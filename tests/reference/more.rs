//! Documents with keys that no file in `examples/` uses.

use crate::support;
use files::Disk;
use files::json::Document;
use render::scene::read;
use serde_json::Value;
use std::fs;
use sweep::Object;
use sweep::spec::Resolution;

/// The file of the documents, from the root of the project.
const FILE: &str = "tests/reference/more.json";

/// Returns the documents of a format.
pub fn documents(format: &str) -> Vec<(String, Value)> {
    let text = fs::read_to_string(support::root().join(FILE)).unwrap();
    let all: Vec<Value> = serde_json::from_str(&text).unwrap();
    let of_format = |document: &Value| {
        document["format"].as_str().is_some_and(|found| found.starts_with(format))
    };
    all.into_iter().filter(of_format).map(|document| (FILE.to_owned(), document)).collect()
}

#[test]
fn readers_take_them() {
    let root = support::root();
    let files = root.join("tests/reference");
    for (_, document) in documents("tb-sweep") {
        let text = document.to_string();
        let document = Document::new(FILE, text.as_bytes()).unwrap();
        let object = Object::read(&document, &files, &Disk, &Resolution::default());
        object.unwrap_or_else(|error| panic!("{error}\n{text}"));
    }
    for (_, document) in documents("tb-scene") {
        if document["format"] == "tb-scene" {
            let text = document.to_string();
            let document = Document::new(FILE, text.as_bytes()).unwrap();
            read::parse(&document).unwrap_or_else(|error| panic!("{error}\n{text}"));
        }
    }
    let folder = tempfile::tempdir().unwrap();
    for (_, document) in documents("tb-job") {
        let path = folder.path().join("job.json");
        fs::write(&path, document.to_string()).unwrap();
        pipeline::job::Job::read(&path, &Disk).unwrap_or_else(|error| panic!("{error}"));
    }
}
